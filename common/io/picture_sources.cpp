#include "io/picture_sources.h"

#include <zlib.h>

#include <cstdint>
#include <filesystem>

#include "base/error.h"
#include "base/tool.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene_words.h"

namespace whine {
namespace {

constexpr size_t kSignature = 8, kFrame = 12;  // bytes: before the chunks; length, kind and checksum of one
const std::string kText = "tEXt", kSourceKey("whine source\0", 13);

std::uint32_t checksum(const std::string& bytes) {
  return static_cast<std::uint32_t>(crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

std::string big_endian(std::uint32_t value) {
  std::string out;
  for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>((value >> shift) & 0xff);
  return out;
}

size_t length_at(const std::string& png, size_t at) {
  size_t value = 0;
  for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(png[at + i]);
  return value;
}

}  // namespace

std::string with_sources(const std::string& png, const std::vector<std::string>& paths) {
  std::string chunks;
  for (const std::string& path : paths) {
    const std::string data = kText + kSourceKey + sha256_of_file(path) + ' ' + recorded_path(path);
    chunks += big_endian(static_cast<std::uint32_t>(data.size() - kText.size())) + data +
              big_endian(checksum(data));
  }
  // Behind the header, the first chunk.
  std::string out = png;
  return out.insert(kSignature + kFrame + length_at(png, kSignature), chunks);
}

std::vector<PictureSource> picture_sources(const std::string& name, const std::string& png) {
  std::vector<PictureSource> out;
  for (size_t at = kSignature; at < png.size();) {
    const size_t left = png.size() - at;
    if (left < kFrame || length_at(png, at) > left - kFrame)
      fail(Failure::input, name, ": is no whole PNG; delete it and make the figure again");
    const std::string data = png.substr(at + 4, 4 + length_at(png, at));
    at += kFrame + data.size() - 4;
    if (data.rfind(kText + kSourceKey, 0) != 0) continue;
    const std::string source = data.substr(kText.size() + kSourceKey.size());
    const size_t space = source.find(' ');
    if (space != std::string::npos) out.push_back({source.substr(space + 1), source.substr(0, space)});
  }
  return out;
}

void require_fresh_picture(const std::string& path, const std::string& png, const std::string& scene) {
  const std::vector<PictureSource> sources = picture_sources(path, png);
  if (sources.empty())
    fail(Failure::input, path, ": does not say what it was drawn from; delete it and make the figure again");
  for (const PictureSource& source : sources) {
    const std::string own = scene_words(source.path);
    if (!scene.empty() && !own.empty() && own != scene)
      fail(Failure::input, path, ": was drawn from ", source.path, ", of the scene ", own,
           "; the report is of ", scene, "; delete it and make the figure again");
    std::error_code ignored;
    if (std::filesystem::is_regular_file(source.path, ignored) &&
        sha256_of_file(source.path) != source.sha256)
      fail(Failure::input, path, ": was drawn from another ", source.path,
           " than there is; delete it and make the figure again");
  }
}

}  // namespace whine
