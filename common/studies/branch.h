// The branch of periodic orbits of a pair or a train of elastic gears over the mesh frequencies of a scene, stable or not.
//
// It begins with the orbit into which the motion settles at the highest speed and is followed towards lower ones, round its
// folds, until it leaves the speeds of the scene or ends; or with the motion of a sweep at a speed, from which it is followed both
// ways. Beyond period doublings branches of orbits of twice the periods are followed, if asked for. Steps per period change with
// the speed, as in a sweep (min_sample_rate_kHz): there the orbit is found anew with the other number of steps, and its change
// is measured. Where an orbit needs a wider candidate contact zone, or tip edges that are farther off, it is computed again with those, as in
// a sweep; zones only grow.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/branch.h"
#include "results/reduced_body.h"
#include "results/static.h"
#include "studies/branch_follower.h"

namespace whine {

using BranchReport = std::function<void(long, long, const std::string&)>;

// statics, mean_stiffness, settings: as of sweep(). report(done, total, note) is called after each point, in
// steps of the scene's speeds. Throws Error(input) for teeth
// that differ, Error(numerical) if the pair does not settle into an orbit of one mesh period at the highest speed or contact
// leaves the flanks.
BranchResult pair_branch(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double mean_stiffness, const SweepParameters& settings, const BranchReport& report,
                         const BranchPlan& plan = {});

// bodies: [gear] of settings.body; report likewise. Throws as BranchFollower; else as system_sweep().
BranchResult system_branch(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                           const BranchReport& report, const BranchPlan& plan = {});

}  // namespace whine
