// What io/artifacts.h declares, for the source of each kind: that has describe(), title() and, at its end,
// `template struct ArtifactFile<StaticResult>;`.
//
// Private to the codecs in io/.
#pragma once
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/codec.h"
#include "io/vtk.h"

namespace whine {

template <class Artifact>
void ArtifactFile<Artifact>::write(const std::string& path, const Artifact& a, const Provenance& provenance) {
  const ArtifactKind<Artifact>& kind = kind_of<Artifact>();
  ArtifactWriter out(path, kind.name, kind.version, title(a), provenance);
  Codec codec(out);
  describe(codec, const_cast<Artifact&>(a));  // a writer changes no member
  out.publish();
  if (codec.has_picture()) link_for_paraview(path);
}

template <class Artifact>
Artifact ArtifactFile<Artifact>::read(const std::string& path) {
  const ArtifactReader in(path, kind_of<Artifact>().name, kind_of<Artifact>().version);
  Codec codec(in);
  Artifact a;
  describe(codec, a);
  return a;
}

template <class Artifact>
void ArtifactFile<Artifact>::walk(Codec& codec, Artifact& a) {
  describe(codec, a);
}

}  // namespace whine
