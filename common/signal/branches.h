// What sweeps up and down say of the two branches of a resonance: where both are, where contact is lost on either, what the
// teeth carry. A map of jumps is a series of such cases at one torque, of elastic gears or of a lumped model.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "results/jump_map.h"
#include "results/sweep.h"

namespace whine {

// A motion on a branch that the sweep had left too early, met on the way to the branch's end.
struct BranchPoint {
  double mesh_frequency = 0;  // Hz
  double dte_rms = 0;         // m
  double tooth_load_max = 0;  // N
  double sustained_load = 0;  // N, see sustained_load()
  bool parted = false;        // contact is lost during the period
};

// Sustained, here and in all results: what lasts for 1/64 of a mesh period without a break.
inline constexpr int kSustainedParts = 64;

// Largest sustained load (N) of one tooth pair: the least of ceil(samples / 64) + 1 samples in a row, which span 1/64 or, where 64
// does not divide `samples`, up to one sample more. load: (sample, pair), whole
// periods of `samples`. multiple: periods after which the motion repeats; only these count, and their end is followed by their
// begin; not for loads of pairs, which go on in another column there. 0: it does not repeat.
double sustained_load(const Eigen::Ref<const MatrixRM>& load, int samples, int multiple = 0);
// (row) 0 up to the rows that count: where sustained_load() of one column occurs, the row of its largest sample; the first of equals.
Eigen::Index sustained_row(const Eigen::Ref<const Eigen::VectorXd>& load, int samples, int multiple = 0);

// Samples in a row that it looks at.
constexpr int sustained_samples(int samples) {
  return (samples + kSustainedParts - 1) / kSustainedParts + 1;
}

struct MapSpeeds {
  double from = 0, to = 0;    // Hz; 0: 0.57 and 1.2 of the natural frequency
  double step = 50;           // Hz
  double load_frequency = 0;  // Hz, a speed whose loads are stored apart; speeds fall on it. 0: none
};

// Mesh frequencies in Hz, ascending. natural_frequency: Hz, for the default range. Throws Error(input) for an empty range,
// one without load_frequency, a step that is not above 0.
Eigen::VectorXd map_speeds(const MapSpeeds& speeds, double natural_frequency);

// Sizes what a map holds per case; all values of no case yet. load_frequency: Hz, one of the speeds, or 0.
void start_cases(JumpMapResult& map, Eigen::Index cases, const Eigen::VectorXd& speeds,
                 double load_frequency);

// Fills in what the two sweeps of case c say: ends of branches, contact loss, loads, jumps, responses. sweep(direction, beyond)
// goes through the speeds of the map, first up, then down, and adds to beyond the motions on branches past the speed
// at which it left them. step: Hz, between the speeds.
void add_case(JumpMapResult& map, Eigen::Index c, double step,
              const std::function<SweepResult(Direction, std::vector<BranchPoint>&)>& sweep);

}  // namespace whine
