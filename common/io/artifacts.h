// Writing and reading of artifacts, the same two functions for each kind in io/artifact_kinds.h. Include the struct beside this
// header: results/static.h and its like.
#pragma once
#include <string>

#include "io/provenance.h"

namespace whine {

class Codec;

// Compiled in common/io/<kind>_codec.cpp.
template <class Artifact>
struct ArtifactFile {
  static void write(const std::string& path, const Artifact& a, const Provenance& provenance);
  static Artifact read(const std::string& path);
  static void walk(Codec& codec, Artifact& a);  // describe(), for lists of datasets and tests
};

// Writes the file whole or not at all. Error(numerical) for a number that is not finite and for lengths that differ along an axis;
// Error(input) if an input has changed since the stage read it.
template <class Artifact>
void write(const std::string& path, const Artifact& a, const Provenance& provenance) {
  ArtifactFile<Artifact>::write(path, a, provenance);
}

// Error(input) if the file is of another kind or version, if its bytes are not those that were written, or if a value is out of range.
template <class Artifact>
Artifact read(const std::string& path) {
  return ArtifactFile<Artifact>::read(path);
}

}  // namespace whine
