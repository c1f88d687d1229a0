// What is taken off a driving flank, as a function of the roll angle and of the tooth: modifications that a designer
// wants, and errors that a machine makes.
//
// A deviation is measured along the flank's normal, positive where material is missing, so that it adds to the gap of two
// flanks. It stays on its flank: neither the mesh nor the body of a gear knows of it. Neglected against the exact offset
// curve: 1 - cos of the angle between the flank's normal and that of the contact (2e-4 of the deviation at the end of a
// candidate zone of strips), and the turn of the normal by the deviation's own slope (3 mrad for 10 micrometres over 3 mm).
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "gear/tooth_errors.h"
#include "model/gear.h"

namespace whine {

// Cubic through points that rises and falls only where they do: continuous with its first derivative, slopes by the weighted
// harmonic mean of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5 (1984) 300-304). Constant outside its points.
class MonotoneCubic {
 public:
  MonotoneCubic() = default;  // 0 everywhere
  // At least two points, x ascending; throws Error(input) otherwise.
  explicit MonotoneCubic(const std::vector<std::array<double, 2>>& points);
  Eigen::Vector2d at(double x) const;  // value and slope

 private:
  std::vector<double> x_, y_, slope_;
};

// In place of a tooth's number: what all teeth have in common.
inline constexpr int kEveryTooth = std::numeric_limits<int>::min();

class FlankDeviation {
 public:
  FlankDeviation() = default;  // none
  // Throws Error(input), by the keys of a scene, for a relief that does not start on the flank, points beyond it, more
  // taken off than half the tooth's thickness, and errors that tooth_deviations rejects. An eccentric toothing moves flanks by
  // its displacement e along their normals, to second order: what is left out is e^3 / rho^2, rho the radius of curvature.
  // side: the flank that works; of tooth t it is the one whose pitch deviation tooth_deviations() has for t.
  FlankDeviation(const ToothGeometry& gear, const FlankModification& modification,
                 const ToothErrors& errors = {}, FlankSide side = FlankSide::leading);

  // True if nothing deviates on any tooth.
  bool none() const { return none_; }
  bool none(int tooth) const { return none_ || (tooth == kEveryTooth && !modified_); }
  // Teeth after which the flanks repeat: 1 if they are all alike, else all of them.
  int repeats() const { return repeats_; }
  // m; roll: rad; tooth: its number, counter-clockwise, any whole number, or kEveryTooth. Beyond the ends of the involute the
  // value goes on with its slope.
  double at(double roll, int tooth) const { return value_and_slope(roll, tooth)[0]; }
  // m and m per rad.
  Eigen::Vector2d value_and_slope(double roll, int tooth) const;

  // Over the whole flank of every tooth. m; 1: slope against the arc length of the flank, unsigned.
  double least() const { return least_; }
  double largest() const { return largest_; }
  double steepest() const { return steepest_; }
  double spread() const { return spread_; }  // m: largest less least on one tooth, largest of all teeth
  double between_teeth() const {
    return between_teeth_;
  }  // m: the same at one roll angle, from tooth to tooth and the common part

 private:
  struct Part {  // grows from 0 at `start` to `amount` at `end`
    double start, end, amount;
    bool parabolic;
  };
  std::vector<Part> parts_;
  double within(double roll) const {  // the involute; a ring's begins at the tip
    return std::clamp(roll, std::min(form_, tip_), std::max(form_, tip_));
  }
  double form_ = 0, tip_ = 1, middle_ = 0, crowning_ = 0, slope_ = 0;  // rad, m
  MonotoneCubic points_;
  bool none_ = true, modified_ = false;
  double least_ = 0, largest_ = 0, steepest_ = 0, spread_ = 0, between_teeth_ = 0;
  int repeats_ = 1;
  Eigen::Vector2d of_tooth(double roll, int tooth) const;
  struct Tooth {  // m taken off: everywhere, at the tip less at the foot, from peak to valley
    double offset, slope, form;
  };
  std::vector<Tooth> teeth_;
  int outwards_ = 1;
  double base_radius_ = 0, reference_roll_ = 0, waves_ = 0;                             // m, rad, 1
  double eccentricity_ = 0, eccentric_angle_ = 0, normal_angle_ = 0, tooth_angle_ = 0;  // m, rad
};

// The two flanks of one pair of teeth. Default: none.
struct PairDeviation {
  std::array<const FlankDeviation*, 2> gear{};  // driver, driven gear; nullptr: none
  std::array<int, 2> tooth{};

  bool none() const { return (!gear[0] || gear[0]->none(tooth[0])) && (!gear[1] || gear[1]->none(tooth[1])); }
  // Whether pairs differ from each other.
  bool differs() const { return (gear[0] && gear[0]->repeats() > 1) || (gear[1] && gear[1]->repeats() > 1); }
  // m: how far pairs of other teeth may differ from each other.
  double between_teeth() const {
    double sum = 0;
    for (const FlankDeviation* flank : gear)
      if (flank) sum += flank->between_teeth();
    return sum;
  }
  // m, of both flanks at their roll angles (rad).
  double at(const std::array<double, 2>& roll) const {
    double sum = 0;
    for (int g = 0; g < kSides; ++g)
      if (gear[g] && !gear[g]->none(tooth[g])) sum += gear[g]->at(roll[g], tooth[g]);
    return sum;
  }
};

}  // namespace whine
