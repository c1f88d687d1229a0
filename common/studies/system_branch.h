// The branch of periodic orbits of a system of elastic gears over the mesh frequencies of a scene, stable or not.
//
// It begins with the orbit into which the system settles at the highest speed and is followed towards lower ones, round its folds,
// until it leaves the speeds of the scene or ends: pseudo-arclength continuation (orbits/branch.h) of the period map of
// dynamics/system_period_map.h. Steps per period change with the speed, as in a sweep: there the orbit is found anew with the other
// number of steps, and its change is measured. Where an orbit needs tip edges that are farther off, it is computed again with those.
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
