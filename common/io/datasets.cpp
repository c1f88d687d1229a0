#include "io/datasets.h"

#include <vector>

#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/codec.h"

namespace whine {
namespace {

template <class Artifact>
std::string lines(const std::string& kind) {
  std::vector<Dataset> list;
  Codec codec(list);
  Artifact any;
  ArtifactFile<Artifact>::walk(codec, any);
  std::string out;
  for (const Dataset& d : list) {
    if (d.name.starts_with("/parameters/")) continue;
    out += kind + "  " + d.name + " (" + d.axes + (d.axes.empty() ? "" : "; ") + d.units + "): " + d.meaning +
           (d.equation.empty() ? "" : " [" + d.equation + "]") + "\n";
  }
  return out;
}

}  // namespace

std::string dataset_list() {
  std::string all;
  for_each_kind([&]<class A>(const ArtifactKind<A>& kind) { all += lines<A>(kind.file); });
  return all;
}

}  // namespace whine
