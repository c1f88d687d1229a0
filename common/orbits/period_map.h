// The period map y -> P(y; parameter) of a model that is forced periodically: a state at the start of a period, the state one
// period later.
//
// A state is one row of numbers, of everything that the next period depends on, in units of its own: the Euclidean norm of
// a difference is the distance of two states, and that of a state is of the order of 1. Steps per period and the contacts that
// are looked at do not change as long as a map lives, so that P is one function of y and of the parameter, which is the mesh
// frequency in Hz of the gear models.
//
// Where contacts open and close P is continuous and piecewise smooth; its tangent steps at most. Between two such borders it is
// exact to round-off.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace whine {

// Contact `contact` (the number of a tooth pair, or of a spring) opens or closes at a phase in [0, 1) of the period.
struct ContactEvent {
  int contact = 0;
  bool closes = false;
  double phase = 0;
  bool operator==(const ContactEvent&) const = default;
};

class PeriodMap {
 public:
  virtual ~PeriodMap() = default;
  virtual int size() const = 0;  // of a state
  virtual void set_parameter(double value) = 0;
  virtual double parameter() const = 0;
  // One period from y. Throws Error(numerical) where the model holds no further.
  virtual Eigen::VectorXd apply(const Eigen::VectorXd& y) = 0;
  // (size, size) dP/dy at the y of the last apply, of the contacts that it found.
  virtual Eigen::MatrixXd tangent() = 0;
  // (size, direction) dP/dy times directions, which costs less than the tangent where they are few.
  virtual Eigen::MatrixXd tangent_times(const Eigen::MatrixXd& directions) { return tangent() * directions; }
  // Of the period applied last, in the order of their phases.
  virtual std::vector<ContactEvent> events() const = 0;
  // Of the period applied last: (sample) the observable of the model, m of transmission error. Samples are evenly spaced.
  virtual Eigen::VectorXd observable() const = 0;
  // (quantity) maxima that the caller asked for beside the observable, with their positions, over the periods 0..number of the orbit
  // that repeats after `periods`; empty: none. To be called for number = 0, 1, ... in this order; the last result covers all periods.
  virtual Eigen::VectorXd peaks([[maybe_unused]] int number, [[maybe_unused]] int periods) { return {}; }
};

}  // namespace whine
