// Folds of a branch over a second parameter, and the cusps in which two of them meet.
//
// A fold is where the parameter component of the unit tangent, the turn, changes its sign. Near one the turn is linear in the
// arc: a secant method brackets the fold, regula falsi and halvings narrow the bracket, also where a piecewise affine map turns at
// a kink. The parameter is extremal there, and an error of the arc goes into it by its square, at a kink times the turn. From one
// value of the second parameter to the next orbits are predicted along the secant. Two folds that meet in a cusp at value c are
// apart by an arc that goes as the square root of c - value (Kuznetsov, Elements of Applied Bifurcation Theory, 2004, chapter 9).
#pragma once
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orbits/curve.h"
#include "orbits/named_parameter.h"

namespace whine {

struct Fold {
  double value = 0;      // of the second parameter
  double parameter = 0;  // of the map
  Eigen::VectorXd start;
  Eigen::VectorXd tangent;  // in u; empty: not known
  double bend = 0;          // of the turn, per arc: below 0 at a largest parameter; 0: not known
  double before = 0,
         after = 0;  // real multiplier nearest to 1 on either side, towards a rising and a falling parameter
};

struct FoldCurveSettings {
  int multiple = 1;
  NamedParameter parameter{"parameter", ""}, value{"value", ""};  // the second: of the family
  double scale = 1;                                               // of the parameter in the arc length
  // Of the parameter: a fold beyond is none of those that are looked for.
  double low = 0, high = std::numeric_limits<double>::infinity();
  double tolerance = 1e-7;  // of the parameter, relative
  double farthest = 0.1;    // arc on which a fold is looked for at once
  OrbitSettings orbit{};
  // Whether a family has the same map near two parameters, such as one number of steps per period; empty: it always has.
  std::function<bool(double one, double other)> one_map{};
};

// The fold of the map near a guess, by its turn. Nothing if there is none within some steps of `farthest`, or none between `low` and
// `high`; `failure` says why.
std::optional<Fold> find_turn(PeriodMap& map, const Fold& guess, const FoldCurveSettings& settings,
                              std::string& failure);

// The map of a value of the second parameter, for motions near a parameter.
using MapFamily = std::function<std::unique_ptr<PeriodMap>(double value, double parameter)>;

// Two folds of one branch from value to value as long as both are found.
struct FoldPair {
  std::vector<Fold> low, high;  // by parameter at the first value; entries of one index have one value
  bool cusp = false;            // they meet
  double cusp_value = 0, cusp_parameter = 0;
  std::string end;  // why they were followed no further
};

// From two folds at one value through `values`, in their order. A step at which a fold is not found is halved a few times; where
// the arc between the two shows a cusp ahead they are followed up to 0.2 % of its value, or up to 2 % where kinks part the last
// folds in front of it: `end` says how far. Folds that leave the parameters end it.
FoldPair follow_folds(const MapFamily& family, const Fold& one, const Fold& other,
                      const std::vector<double>& values, const FoldCurveSettings& settings,
                      const std::function<void(double value)>& report = {});

}  // namespace whine
