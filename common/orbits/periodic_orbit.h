// Periodic orbits of a period map: y = P^m(y; parameter) by Newton's method with the exact tangent.
//
// P is piecewise smooth. Where the contacts on the way stay, the method converges quadratically; of a piecewise affine map it
// ends within one step of the piece that holds the orbit. A step that does not bring the residual down is halved. Of long
// states the tangent is that on its slow directions (orbits/monodromy_matrix.h), kept as long as it brings the residual down, and the
// method converges linearly.
// Stability is read off the multipliers, the eigenvalues of dP^m/dy: all of them inside the unit circle.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "orbits/monodromy_matrix.h"
#include "orbits/period_map.h"

namespace whine {

struct PeriodicOrbit {
  Eigen::VectorXd start;
  double parameter = 0;
  int multiple = 1;                  // periods after which it repeats
  double residual = 0;               // |P^m(y) - y| / max(1, |y|)
  int iterations = 0;                // tangents that were needed
  MonodromyMatrix slow;              // of P^m
  std::vector<ContactEvent> events;  // of its periods in turn, phases from 0 to `multiple`
  Eigen::VectorXd observable;        // of its periods in turn
  Eigen::VectorXd peaks;             // (quantity) the map's, of all its periods

  // Descending modulus; of a long state the largest ones. Throws Error(numerical) if they cannot be found.
  Eigen::VectorXcd multipliers() const { return slow.multipliers(); }
};

struct OrbitSettings {
  double tolerance = 1e-11;  // of the residual
  int most_iterations = 25;
};

// P^m(y) at the map's parameter. Given, `passed` takes what happened on the way, and `directions`, (size, direction), are
// multiplied by the tangent of P^m.
Eigen::VectorXd image(PeriodMap& map, const Eigen::VectorXd& y, int multiple, PeriodicOrbit* passed = nullptr,
                      Eigen::MatrixXd* directions = nullptr);

// What became of a search: the last iterate, and in words why it is no orbit; empty if it is one.
struct OrbitSearch {
  PeriodicOrbit orbit;
  std::string failure;
  bool found() const { return failure.empty(); }
};

// From `start`, at the map's parameter. Round-off may keep the residual up to 1000 times above the tolerance: an iterate below
// that counts if a step no longer halves the residual. Never throws for a state at which the model does not hold: the failure
// says so.
OrbitSearch newton_orbit(PeriodMap& map, const Eigen::VectorXd& start, int multiple = 1,
                         const OrbitSettings& settings = {});

}  // namespace whine
