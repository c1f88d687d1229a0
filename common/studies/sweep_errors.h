// Discretisation errors of a sweep, measured on the scene itself: each discretisation is refined alone, and made coarser to see the
// order with which its error falls.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/static.h"
#include "results/sweep_errors.h"

namespace whine {

inline constexpr int kJudgedSpeeds = 40;  // most speeds of a sweep that are judged

// Of a pair: time steps, finite elements, points of the flank table, strips of contact, points over the face, kept modes, periodicity. As
// sweep() takes the rest; reference gives the mean stiffness of the dampers. At most kJudgedSpeeds speeds from end to end of the scene's,
// so that branches are followed as in a sweep. report(done, total, note) counts sweeps. Errors as of sweep(), make_sector_mesh(), reduce().
SweepErrorsResult sweep_errors(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticResult& statics, const StaticResult& reference,
                               const SweepParameters& settings, Direction direction,
                               const std::function<void(long, long, const std::string&)>& report);
// Of a train, which has no strips. Errors as of system_sweep().
SweepErrorsResult sweep_errors(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                               Direction direction,
                               const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
