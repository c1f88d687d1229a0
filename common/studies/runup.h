// Run-ups and run-downs: the speed changes with time, and the motion is integrated through jumps, contact loss and transients.
//
// Steps stay at fixed phases of the mesh period, as everything that a step looks up is of a phase. With phase(t) = f0 t + a t^2/2
// the time of phase k is t_k = 2 k / (f0 + sqrt(f0^2 + 2 a k)). The speed is constant within a block of m mesh periods, which
// takes the exact time t_(k+m) - t_k: within it the phase is off by a (m T)^2 / 8 periods at most, at its ends it is exact. m is
// the largest with |a| m / f^2 <= speed_change, 1 to 64.
//
// The torque is constant: what accelerates the gears is put on each shaft by its own machine and does not go through the mesh.
#pragma once
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "results/reduced_body.h"
#include "results/runup.h"
#include "results/static.h"

namespace whine {

// Where samples go as they come, so that memory does not grow with the duration.
class RunupSink {
 public:
  virtual ~RunupSink() = default;
  // Before all else: everything but samples, periods and certificate; what will come.
  virtual void begin(const RunupResult& head, Eigen::Index samples, Eigen::Index periods) = 0;
  virtual void take(const RunupSamples& samples) = 0;  // blocks of kRunupBlock, the last one shorter
  virtual void take(const RunupPeriods& periods) = 0;  // the same
  virtual void end(const RunupResult& tail) = 0;       // with the certificate
};
inline constexpr Eigen::Index kRunupBlock = 16384;

struct RunupSettings {
  SpeedRamp ramp;
  double sample_rate = 48000;  // Hz
  double speed_change = 2e-4;  // relative, within a block of one speed
};

// N m: what accelerates the inertias of driver and driven gear of a pair.
std::array<double, kSides> acceleration_torque(const RunupResult& a);

// From the periodic motion at the start into which the pair settles from rest. statics, mean_stiffness, settings: as for
// sweep(), whose speeds are not used. report(done, total, note) is called after each block of samples. Throws Error(input) for a
// ramp that is empty, a sample rate above that of the steps, parameters that do not fit; Error(numerical), with the speed, if no
// periodic motion is found at the start, and with speed and mesh phase, if contact leaves the flanks or has no certified solution.
void runup(const ReducedBody& driver, const ReducedBody& driven, const StaticResult& statics,
           double mean_stiffness, const SweepParameters& settings, const RunupSettings& wanted,
           RunupSink& sink, const std::function<void(long, long, const std::string&)>& report);
// The same of a train, whose input is the body of the first drive that gives power. bodies: as of system_sweep(). Throws
// Error(input) where nothing turns.
void runup(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
           const RunupSettings& wanted, RunupSink& sink,
           const std::function<void(long, long, const std::string&)>& report);

}  // namespace whine
