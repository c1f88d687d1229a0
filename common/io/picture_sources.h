// What a picture was drawn from, kept in the picture: a figure of other artifacts is told from that of these.
#pragma once
#include <string>
#include <vector>

namespace whine {

struct PictureSource {
  std::string path, sha256;
};

// The PNG with the paths and hashes of these files in text chunks (tEXt), which viewers pass over.
std::string with_sources(const std::string& png, const std::vector<std::string>& paths);

// Throws Error(input) with the name of the picture for a PNG whose chunks are cut off.
std::vector<PictureSource> picture_sources(const std::string& name, const std::string& png);

// Throws Error(input) unless the picture says what it was drawn from, each source that is still there is what it was, and those whose
// scene is known (scene_words()) are of this scene; scene: "" for one that is not known.
void require_fresh_picture(const std::string& path, const std::string& png, const std::string& scene);

}  // namespace whine
