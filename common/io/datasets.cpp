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
#include "io/modes_codec.h"
#include "io/readings_codec.h"
#include "io/response_codec.h"
#include "io/runup_codec.h"
#include "io/static_codec.h"
#include "io/study_codec.h"
#include "io/sweep_codec.h"
#include "io/system_branch_codec.h"
#include "io/system_impact_codec.h"
#include "io/system_static_codec.h"
#include "io/system_sweep_codec.h"
#include "io/variant_codec.h"

namespace whine {
namespace {

template <class Artifact>
std::string lines(const std::string& kind) {
  std::vector<Dataset> list;
  Codec codec(list);
  Artifact any;
  describe(codec, any);
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
  return lines<SectorGrid>("mesh.h5") + lines<ReducedBody>("body.h5") + lines<StaticResult>("static.h5") +
         lines<ErrorBudgetResult>("error_budget.h5") + lines<LoadedResult>("loaded_<phase>.h5") +
         lines<ImpactResult>("impact.h5") + lines<SweepResult>("sweep.h5") +
         lines<ResponseResult>("response.h5") + lines<BranchResult>("branch.h5") +
         lines<RunupResult>("runup_<rate>.h5") + lines<FoldCurvesResult>("fold_curves_*.h5") +
         lines<JumpMapResult>("jump_map_*.h5") + lines<HarrisMapResult>("harris_map.h5") +
         lines<VariantResult>("ab12....h5") + lines<StudyResult>("study.h5") +
         lines<ModesResult>("modes.h5") + lines<SystemStaticResult>("system_static.h5") +
         lines<SystemSweepResult>("system_sweep.h5") + lines<SystemImpactResult>("system_impact.h5") +
         lines<SystemBranchResult>("system_branch.h5") + lines<ReadingsResult>("readings.h5");
}

}  // namespace whine
