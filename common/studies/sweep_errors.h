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

// The order p of an error c h^p, from the changes of h twice as large to h and of h to half of it: log2 of their ratio. 0 where
// none shows: outside 0.5 to 6, or where the finer change is 0.
double order_of(double coarser_change, double finer_change);

// The error of h that a change from h to h / 2 stands for, |change| / (1 - 2^-p); order 0: |change|.
double error_of(double change, double order);

// Of a pair: time steps, finite elements, points of the flank table, strips of contact, kept modes, periodicity. As sweep() takes
// the rest; reference gives the mean stiffness of the dampers. At most kJudgedSpeeds speeds from end to end of the scene's, so that
// branches are followed as in a sweep. report(done, total, note) counts sweeps. Errors as of sweep(), make_sector_mesh(), reduce().
SweepErrorsResult sweep_errors(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticResult& statics, const StaticResult& reference,
                               const SweepParameters& settings, Direction direction,
                               const std::function<void(long, long, const std::string&)>& report);
// Of a train, which has no strips. Errors as of system_sweep().
SweepErrorsResult sweep_errors(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                               Direction direction,
                               const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
