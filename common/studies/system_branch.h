// The branch of periodic orbits of a system of elastic gears over the mesh frequencies of a scene, stable or not.
//
// As that of a pair (studies/pair_branch.h), of the period map of dynamics/system_period_map.h. Where an orbit needs tip edges that are
// farther off, it is computed again with those.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/system_branch.h"
#include "studies/branch_follower.h"

namespace whine {

// bodies: [gear] of settings.body. report(done, total, note) is called after each point, in steps of the scene's speeds. Throws
// as BranchFollower; else as system_sweep().
SystemBranchResult system_branch(const SystemSweepParameters& settings,
                                 const std::vector<ReducedBody>& bodies,
                                 const std::function<void(long, long, const std::string&)>& report,
                                 const BranchPlan& plan = {});

}  // namespace whine
