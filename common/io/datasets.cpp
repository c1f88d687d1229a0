#include "io/datasets.h"

#include <vector>

#include "io/body_codec.h"
#include "io/branch_codec.h"
#include "io/codec.h"
#include "io/error_budget_codec.h"
#include "io/fold_curves_codec.h"
#include "io/harris_map_codec.h"
#include "io/impact_codec.h"
#include "io/jump_map_codec.h"
#include "io/loaded_codec.h"
#include "io/mesh_codec.h"
#include "io/readings_codec.h"
#include "io/response_codec.h"
#include "io/runup_codec.h"
#include "io/static_codec.h"
#include "io/study_codec.h"
#include "io/sweep_codec.h"
#include "io/variant_codec.h"

namespace whine {
namespace {

template <class Artifact>
std::string row(const std::string& kind) {
  std::vector<Dataset> list;
  Codec codec(list);
  Artifact any;
  describe(codec, any);
  std::string out;
  for (const Dataset& d : list) {
    if (d.name.starts_with("/parameters/")) continue;
    out += (out.empty() ? "" : ", ") + ("`" + d.name + "` (") + d.axes + (d.axes.empty() ? "" : "; ") +
           d.units + ")";
  }
  return "| `" + kind + "` | " + out + " |\n";
}

}  // namespace

std::string dataset_table() {
  return "| artifact | datasets (axes; unit) |\n|---|---|\n" + row<MeshArtifact>("mesh.h5") +
         row<BodyArtifact>("body.h5") + row<StaticArtifact>("static.h5") +
         row<ErrorBudgetArtifact>("error_budget.h5") + row<LoadedArtifact>("loaded_<phase>.h5") +
         row<ImpactArtifact>("impact.h5") + row<SweepArtifact>("sweep.h5") +
         row<ResponseArtifact>("response.h5") + row<BranchArtifact>("branch.h5") +
         row<RunupArtifact>("runup_<rate>.h5") + row<FoldCurvesArtifact>("fold_curves_*.h5") +
         row<JumpMapArtifact>("jump_map_*.h5") + row<HarrisMapArtifact>("harris_map.h5") +
         row<VariantArtifact>("ab12....h5") + row<StudyArtifact>("study.h5") +
         row<ReadingsArtifact>("readings.h5");
}

}  // namespace whine
