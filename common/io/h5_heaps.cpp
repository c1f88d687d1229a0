#include "io/h5_heaps.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>
#include <vector>

namespace whine::h5 {
namespace {

std::uint64_t number_at(const std::string& bytes, std::size_t at, int length) {
  std::uint64_t out = 0;
  for (int i = length - 1; i >= 0; --i)
    out = out << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return out;
}

static_assert(std::endian::native == std::endian::little, "addresses in a file are read as they lie there");

// Where `mark` stands in `bytes`, ascending, as far as the address of that place stands somewhere in them, too. One pass for
// all marks: a file may consist of little else.
std::vector<std::size_t> referred(const std::string& bytes, const std::string& mark) {
  std::vector<std::size_t> places, out;
  for (std::size_t at = bytes.find(mark); at != std::string::npos; at = bytes.find(mark, at + 1))
    places.push_back(at);
  if (places.empty()) return out;
  std::vector<bool> found(places.size());
  const std::uint64_t first = places.front(), span = places.back() - first;
  for (std::size_t i = 0; i + 8 <= bytes.size(); ++i) {
    std::uint64_t address = 0;
    std::memcpy(&address, bytes.data() + i, 8);
    if (address - first > span) continue;  // below the first place, too: the difference wraps
    const auto place = std::lower_bound(places.begin(), places.end(), address);
    if (*place == address) found[static_cast<std::size_t>(place - places.begin())] = true;
  }
  for (std::size_t i = 0; i < places.size(); ++i)
    if (found[i]) out.push_back(places[i]);
  return out;
}

}  // namespace

bool heaps_are_sound(const std::string& bytes) {
  constexpr std::size_t kHeader = 16;      // of a heap and of an object in it
  std::vector<std::size_t> seen(1 << 16);  // index -> heap, counted from 1
  std::size_t heap = 0, free_from = 0;
  for (const std::size_t at : referred(bytes, "GCOL\1")) {
    if (at < free_from || bytes.size() - at < kHeader) return false;
    ++heap;
    std::size_t left = number_at(bytes, at + 8, 8);
    if (left < kHeader || left > bytes.size() - at) return false;
    free_from = at + left;
    std::size_t object = at + kHeader;
    for (left -= kHeader; left >= kHeader;) {
      const std::size_t index = number_at(bytes, object, 2), size = number_at(bytes, object + 8, 8);
      if (index == 0) {  // the rest is free
        if (size != left) return false;
        break;
      }
      if (seen[index] == heap || size > left - kHeader) return false;
      seen[index] = heap;
      const std::size_t whole = std::min(left, kHeader + (size + 7) / 8 * 8);
      object += whole;
      left -= whole;
    }
  }
  return true;
}

}  // namespace whine::h5
