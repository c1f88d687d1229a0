#include "base/visible.h"

#include <array>
#include <cstdio>

namespace whine {
namespace {

// First and last of ranges of code points.
constexpr std::array<std::array<unsigned, 2>, 14> kHidden{{
    {0x00, 0x08},  // control characters but for tabs and line ends
    {0x0b, 0x0c},
    {0x0e, 0x1f},
    {0x7f, 0x9f},
    {0xad, 0xad},        // soft hyphen
    {0x61c, 0x61c},      // Arabic letter mark
    {0x180e, 0x180e},    // Mongolian vowel separator
    {0x200b, 0x200f},    // zero width, marks of direction
    {0x2028, 0x202e},    // line and paragraph separators, embeddings and overrides of direction
    {0x2060, 0x206f},    // word joiner, isolates of direction
    {0xfeff, 0xfeff},    // byte order mark
    {0xfff9, 0xfffb},    // annotations
    {0xe0000, 0xe007f},  // tags
    {0xe0100, 0xe01ef},  // variation selectors
}};

// Bytes of the character of UTF-8 at `i`; 0: none begins there, it is cut off, longer than need be, a surrogate or above U+10FFFF.
size_t character_length(const std::string& text, size_t i) {
  const auto byte = [&](size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  unsigned point = first & (0xffu >> (length + 1));
  for (size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
    point = point << 6 | (byte(i + k) & 0x3f);
  }
  constexpr unsigned kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = point >= 0xd800 && point <= 0xdfff;
  return first < 0xc2 || first > 0xf4 || point < kLeast[length] || point > 0x10ffff || surrogate ? 0 : length;
}

bool is_hidden(unsigned point) {
  for (const auto& [first, last] : kHidden)
    if (point >= first && point <= last) return true;
  return false;
}

}  // namespace

std::string visible(const std::string& text) {
  std::string out;
  for (size_t i = 0; i < text.size();) {
    const size_t length = character_length(text, i);
    if (length == 0) {
      out += '?';
      ++i;
      continue;
    }
    const unsigned first = static_cast<unsigned char>(text[i]);
    unsigned point = length == 1 ? first : first & (0xffu >> (length + 1));
    for (size_t k = 1; k < length; ++k) point = point << 6 | (static_cast<unsigned char>(text[i + k]) & 0x3f);
    if (is_hidden(point)) {
      char name[16];
      std::snprintf(name, sizeof name, "<U+%04X>", point);
      out += name;
    } else {
      out.append(text, i, length);
    }
    i += length;
  }
  return out;
}

}  // namespace whine
