// The branch of periodic orbits of a pair of elastic gears over the mesh frequencies of a scene, stable or not.
//
// It begins with the orbit into which the pair settles at the highest speed and is followed towards lower ones, round its
// folds, until it leaves the speeds of the scene or ends; or with the motion of a sweep at a speed, from which it is followed both
// ways. Beyond period doublings branches of orbits of twice the periods are followed, if asked for. Steps per period change with
// the speed, as in a sweep (min_sample_rate_kHz): there the orbit is found anew with the other number of steps, and its change
// is measured. Where an orbit needs a wider candidate contact zone it is computed again with that, as in a sweep; zones only grow.
#pragma once
#include <functional>
#include <string>

#include "results/branch.h"
#include "results/reduced_body.h"
#include "results/static.h"
#include "studies/branch_follower.h"

namespace whine {

// statics, mean_stiffness, settings: as of sweep(). report(done, total, note) is called after each point, in
// steps of the scene's speeds. Throws Error(input) for teeth
// that differ, Error(numerical) if the pair does not settle into an orbit of one mesh period at the highest speed or contact
// leaves the flanks.
BranchResult pair_branch(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
                         double mean_stiffness, const SweepParameters& settings,
                         const std::function<void(long, long, const std::string&)>& report,
                         const BranchPlan& plan = {});

}  // namespace whine
