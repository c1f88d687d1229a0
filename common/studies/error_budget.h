// Error budget of the static stage: refine one discretisation at a time; the change of each result is its error. Beside it, the change
// by another near field, another contact model, and by the next model level of contact at each position.
#pragma once
#include "results/error_budget.h"
#include "results/reduced_body.h"
#include "results/static.h"

namespace whine {

// The bodies are meshed and reduced again where an entry needs it. Entries: strips (twice as many), flank table (twice
// the points), elements (half the size, but on sharp roots, whose elements follow their radius), order (only for first-order
// elements: second), search range twice as wide (how far from the touching point contact is looked for), positions (twice as
// many). The pressure is that of contacts clear of ridges (system/flank_pressure.h). The largest root stress is also
// computed with elements on the roots once, half, a quarter and an eighth as large, for its error and its order of convergence.
// One contact line per pair has neither strips nor a search range. Of contact over the face in points: twice the points and, of bodies in
// three dimensions, elements of their section half the size and two degrees less. Choices, of which none is an error of the other: the other
// near field (matching at the body's matching_depth, or subtraction) and the other model level of contact; of slices over the face
// bodies in three dimensions alone. One that cannot be computed is named in choice_missing with its reason.
// Errors of all else as static_transmission, make_sector_mesh and reduce.
ErrorBudgetResult error_budget(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticParameters& settings, double torque);

// The same of a train, but for the choice of bodies in three dimensions, which trains do not have; bodies: as system_at_rest() takes them.
// Changes are the largest of all meshes that carry a load, orders are those of all meshes together.
ErrorBudgetResult error_budget(const SystemStaticParameters& settings,
                               const std::vector<ReducedBody>& bodies);

// Difference of two static results over some of the positions.
struct StaticDifference {
  int positions = 0;
  double error_largest = 0, error_rms = 0;  // of the transmission error, over its mean
  double load_largest = 0, load_rms = 0;    // of the pair load that differs most, over the load T / r_b
};

// Positions where a pair carries load off the line of action, and all others.
struct NextLevel {
  StaticDifference corner, elsewhere;
};

// What contact = "strips" changes in `result`, computed with contact = "line" at the same stage parameters; relative to the
// strips. Throws Error(input) if the stage parameters' contact is another, errors as static_transmission.
NextLevel next_contact_level(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& settings, const StaticResult& result);

}  // namespace whine
