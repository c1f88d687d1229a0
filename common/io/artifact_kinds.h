// The list of all kinds of artifacts. Programs that treat each of them alike walk it.
#pragma once
#include <string>
#include <tuple>

#include "io/readings_result.h"
#include "io/study_result.h"
#include "results/branch.h"
#include "results/error_budget.h"
#include "results/fold_curves.h"
#include "results/harris_map.h"
#include "results/impact.h"
#include "results/jump_map.h"
#include "results/loaded.h"
#include "results/modes.h"
#include "results/reduced_body.h"
#include "results/response.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "results/sweep.h"
#include "results/sweep_errors.h"
#include "results/variant.h"
#include "studies/runup.h"

namespace whine {

template <class A>
struct ArtifactKind {
  using Artifact = A;
  const char* name;  // "static" for the schema "whine/static"
  int version;       // raised whenever a dataset is new or changes its name, shape or meaning
  const char* file;  // how the list of datasets calls its files
  const char*
      stems;  // names of its files in out/<scene>/ without .h5, blank between; "runup_*" for all that begin so

  std::string schema() const { return std::string("whine/") + name; }
};

inline constexpr std::tuple kArtifactKinds{
    ArtifactKind<SectorGrid>{"mesh", 1, "mesh.h5", "mesh"},
    ArtifactKind<ReducedBody>{"body", 7, "body.h5", "body"},
    ArtifactKind<SystemStaticResult>{"static", 13, "static.h5", "static"},
    ArtifactKind<ErrorBudgetResult>{"error_budget", 7, "error_budget.h5", "error_budget"},
    ArtifactKind<LoadedResult>{"loaded", 3, "loaded_<phase>.h5", "loaded_*"},
    ArtifactKind<ImpactResult>{"impact", 5, "impact.h5", "impact"},
    ArtifactKind<SweepResult>{"sweep", 11, "sweep.h5", "sweep"},
    ArtifactKind<SweepErrorsResult>{"sweep_errors", 4, "sweep_errors.h5", "sweep_errors"},
    ArtifactKind<ResponseResult>{"response", 13, "response.h5", "response"},
    ArtifactKind<BranchResult>{"branch", 10, "branch.h5", "branch"},
    ArtifactKind<RunupResult>{"runup", 8, "runup_<rate>.h5", "runup_*"},
    ArtifactKind<FoldCurvesResult>{"fold_curves", 3, "fold_curves_*.h5", "fold_curves*"},
    ArtifactKind<JumpMapResult>{"jump_map", 3, "jump_map_*.h5", "jump_map* branches*"},
    ArtifactKind<HarrisMapResult>{"harris_map", 2, "harris_map.h5", "harris_*"},
    ArtifactKind<VariantResult>{"variant", 5, "ab12....h5", ""},
    ArtifactKind<StudyResult>{"study", 4, "study.h5", ""},
    ArtifactKind<ModesResult>{"modes", 2, "modes.h5", "modes"},
    ArtifactKind<ReadingsResult>{"readings", 1, "readings.h5", ""}};

template <class Artifact>
constexpr const ArtifactKind<Artifact>& kind_of() {
  return std::get<ArtifactKind<Artifact>>(kArtifactKinds);
}

// Calls visit(kind) for each of the list.
template <class Visit>
void for_each_kind(const Visit& visit) {
  std::apply([&](const auto&... kind) { (visit(kind), ...); }, kArtifactKinds);
}

}  // namespace whine
