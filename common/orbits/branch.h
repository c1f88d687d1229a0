// Branches of periodic orbits over a parameter: pseudo-arclength continuation, and what happens on the way.
//
// Unknowns u = (y, parameter / scale) with P^m(y) = y; the parameter is positive. From a point the branch is predicted along
// its unit tangent t and corrected by Newton's method in the plane across t, so that it passes folds without special treatment
// (Keller 1977; Allgower and Georg, Introduction to Numerical Continuation Methods, 2003, chapters 6 and 10). The step follows
// the number of corrections and the angle between tangents.
//
// The map is piecewise smooth, so a branch has kinks. There it keeps the sign of det [dF; t^T], F = P^m(y) - y, as piecewise
// linear paths do (Eaves and Scarf 1976): it may turn sharply, and where it turns in the parameter it ends as at a fold,
// although no multiplier passes through 1.
//
// Located between two points, each by a search along the arc:
//   fold      the parameter turns: at a smooth one a multiplier is 1; at a kink, the multipliers of both sides are given
//   flip      a real multiplier passes -1 (period doubling)
//   torus     the modulus of a complex pair passes 1 (Neimark and Sacker)
//   crossing  a real multiplier passes 1 where the parameter does not turn: another branch crosses
//   grazing   the sequence of contacts that open and close changes
#pragma once
#include <complex>
#include <functional>
#include <string>
#include <vector>

#include "orbits/named_parameter.h"
#include "orbits/periodic_orbit.h"

namespace whine {

enum class Special { fold, flip, torus, crossing, grazing };
const char* name(Special kind);

struct BranchPosition {
  double parameter = 0, arc = 0;  // arc: length from the first point, in u
  Eigen::VectorXd start;
  double residual = 0;
  double turn = 0;  // parameter component of the unit tangent, in u; changes its sign at a fold
  Eigen::VectorXcd multipliers;
  std::vector<ContactEvent> events;
  Eigen::VectorXd observable, peaks;
  bool stable() const { return multipliers.size() == 0 || std::abs(multipliers[0]) < 1; }
};

struct SpecialPoint {
  Special kind = Special::fold;
  double parameter = 0, arc = 0;
  Eigen::VectorXd start;
  bool smooth = true;  // false: at a kink of the map
  // Of the parameter: of the interval in which it lies; 0 for grazing. At a kink that in which a smooth map through the same two
  // points would have it: the places of kinks depend on time steps and strips.
  double width = 0;
  // The multiplier that makes it what it is, on either side; not of grazing.
  std::complex<double> before, after;
  ContactEvent event;      // of grazing: the contact that is about to come or go
  bool comes = false;      // of grazing: it opens and closes from here on
  size_t after_point = 0;  // it lies between this point of the branch and the next
};

// (special point of a kind); least: width of a parameter, relative
Eigen::VectorXd parameters_of(const std::vector<SpecialPoint>& special, Special kind);
Eigen::VectorXd widths_of(const std::vector<SpecialPoint>& special, Special kind, double least);

struct BranchSettings {
  int multiple = 1;
  double low = 0, high = 0;  // of the parameter: the branch is followed as long as it lies between
  NamedParameter parameter{"parameter", ""};
  double scale = 1;                                                 // of the parameter in the arc length
  double first_step = 0.02, least_step = 1e-7, largest_step = 0.1;  // of the arc
  double straight = 0.97;  // cosine between the tangents of a step above which the next one may be longer
  int most_points = 5000;
  OrbitSettings orbit;
  double location = 1e-12;          // of the arc step: to what special points are located
  double fold_location = 1e-15;     // the same of folds, relative to their parameter
  double grazing_location = 1e-12;  // the same of grazing orbits; 1: they are not looked for
  // Asked after each step, of its two points: in words why the branch is followed no further; "": it goes on.
  std::function<std::string(const BranchPosition& last, const BranchPosition& next)> stop{};
};

// Whether the branch comes through a point `start`, at a parameter, between two of its points that are neighbours: nearer to the
// chord than a part of its length. scale: of the parameter. Of states of other lengths false.
bool passes(const BranchPosition& last, const BranchPosition& next, const Eigen::VectorXd& start,
            double parameter, double scale);
// Whether orbits of an even number of periods become orbits of half as many between two points that are neighbours: by their
// observable, whose halves change sides.
bool becomes_half(const BranchPosition& last, const BranchPosition& next);

struct OrbitBranch {
  std::vector<BranchPosition> points;
  std::vector<SpecialPoint> special;  // in the order of the arc
  std::string end;                    // why it was followed no further
  int reached_limit = 0;              // the parameter left [low, high]: -1 through low, 1 through high
  bool stopped = false;               // by settings.stop
};

// From an orbit at its parameter, first towards a rising parameter (direction 1) or a falling one (-1). report(point) is called
// after each. Throws Error(numerical) only if `from` is no orbit.
OrbitBranch follow_branch(PeriodMap& map, const PeriodicOrbit& from, int direction,
                          const BranchSettings& settings,
                          const std::function<void(const BranchPosition&)>& report = {});

// Branch switching at a flip of orbits of `multiple` periods: an orbit of twice as many beside it, about `distance` away along the
// eigenvector of -1 and across that (Kuznetsov, Elements of Applied Bifurcation Theory, 2004, section 10.4). scale: of the
// parameter. From it follow_branch() goes on with settings.multiple doubled; at a flip of that branch again to four times, and so
// on. Leaves the map at the orbit's parameter.
OrbitSearch orbit_beyond_flip(PeriodMap& map, const SpecialPoint& flip, int multiple, double scale,
                              double distance = 0.02);

// The fold of a smooth map near a point that need not be an orbit: P^m(y) = y and no parameter component of the tangent, by
// Newton's method along the arc. scale: of the parameter. Leaves the map at the fold's parameter.
struct FoldSearch {
  Eigen::VectorXd start;
  double parameter = 0;
  std::string failure;  // empty if found
  bool found() const { return failure.empty(); }
};
FoldSearch locate_fold(PeriodMap& map, const Eigen::VectorXd& start, int multiple, double scale);

}  // namespace whine
