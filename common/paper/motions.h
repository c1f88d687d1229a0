// Motions of a scene at a speed, and what claims look at in them: branches, jumps, loss of contact.
#pragma once
#include <limits>
#include <string>
#include <vector>

#include "paper/claims.h"
#include "paper/results.h"
#include "report/figures.h"
#include "results/impact.h"
#include "results/static.h"
#include "signal/branches.h"
#include "signal/response.h"

namespace whine::paper {

using Eigen::Index;

inline constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// P2000 gives two speeds for one pair of branches: those of captions and those of its text.
inline constexpr double kPrimary = 2400, kPrimaryText = 2500;      // Hz: captions of Figs 8 and 10; text
inline constexpr double kSecondary = 1300, kSecondaryText = 1350;  // Hz: captions of Figs 9 and 11; text
inline constexpr double kSecondaryEnd = 0.575;  // of f_n: 15 % above f_n / 2, where `summit` looks

// A motion at a speed: one row of one direction.
struct Motion {
  const ResponseResult* sweep = nullptr;
  Index row = -1;

  double speed() const { return sweep->mesh_frequency[row]; }
  double rms() const { return sweep->dte_rms(row, 0); }
  bool loses_contact() const { return sweep->separation_fraction(row, 0) > 0; }
  double losses() const { return sweep->separations_per_period(row, 0); }
  int largest_harmonic() const {
    Index largest;
    sweep->dte_harmonic[static_cast<size_t>(row)].col(0).maxCoeff(&largest);
    return static_cast<int>(largest) + 1;
  }
  // RMS of the harmonic over that of all that oscillates
  double share(int harmonic) const {
    return harmonic > sweep->harmonics()
               ? 0
               : sweep->dte_harmonic[static_cast<size_t>(row)](harmonic - 1, 0) / std::numbers::sqrt2 / rms();
  }
};

// The two motions at a speed; equal in size where there is one branch. Empty if the sweeps do not reach the speed.
struct Pair {
  Motion upper, lower;
  int order = 1;  // of the resonance that P2000's branches at this speed belong to: f_n / order
  bool there() const { return upper.sweep != nullptr; }
  // Whether both are there, and the upper one belongs to this resonance: the upper branch of f_n may reach down to f_n / 2.
  bool two() const {
    return there() && like_a_jump(upper.rms(), lower.rms()) &&
           (order == 1 || upper.largest_harmonic() == order);
  }
};

// The largest change between neighbouring samples of a period, the last of which is followed by the first.
struct Step {
  double before = 0, after = 0;
  double beside = 0;  // the larger of the changes to either side of it: a steep slope has such ones, too
};

// The row whose speed is nearest to f, the lower one of two; -1 if the sweep does not come within 1 % of it.
Index row_at(const ResponseResult& r, double f);
Pair motions(const Branches& b, double f);
// The motions at a speed that P2000 prints for 150 N m; where there are not two, those of the nearest speed that has two
// between caption and text.
Pair printed_branches(const SceneResults& s, double f);
std::string speeds_text(std::vector<double> speeds, double step);
double step_of(const ResponseResult& r);
std::vector<double> speeds_with_loss(const Branches& b);
std::vector<double> speeds_with_two(const Branches& b);
double largest_rms(const Branches& b);
bool jumps(const Branches& b);
std::string jumps_text(const Branches& b);
double first_harmonic_share(const StaticResult& s);
// What decides whether contact is lost: how strongly the stiffness varies, and the damping.
std::string excitation(const SceneResults& s, int torque);
std::string loss_text(const Branches& b);
Step largest_step(const Eigen::Ref<const Eigen::VectorXd>& period);

}  // namespace whine::paper
