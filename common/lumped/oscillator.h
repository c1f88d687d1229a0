// One degree of freedom with unilateral springs that change at known phases of the mesh period (Eq. 23):
//
//   m x'' + c x' + sum_i k_i max(x - g_i, 0) = F,   k_i, g_i constant in each cell of the period.
//
// Between two events - a cell ends, a spring touches or parts - the motion is that of a linear oscillator, so its closed
// form takes the state from event to event. Cells end at known times; where x reaches a gap is found to round-off: in a
// piece no longer than a quarter of the oscillator's own period the velocity changes sign once at most, so a piece has
// one extremum at most and on either side of it a crossing shows in the signs at the ends. Nothing is lost between steps
// because there are none.
//
// The force is continuous where a spring touches or parts, so the state's derivatives pass through unchanged, and the
// derivative of the period map is the product of the pieces' (saltation matrix 1). Only a damper that acts in contact
// alone steps there; its saltation matrix (Leine and Nijmeijer, Dynamics and Bifurcations of Non-Smooth Mechanical
// Systems, 2004) differs from 1 by the step of c / m.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "results/sweep.h"

namespace whine {

// Energy over the recorded periods, J: kinetic + spring = force + switching - damping, but for the imbalance.
struct LumpedEnergyBalance {
  double kinetic = 0, spring = 0;  // changes of what is stored
  double force = 0;                // work of F
  double switching = 0;            // work of the springs' change from cell to cell, at fixed x
  double damping = 0;              // taken by the damper: c times the integral of v^2, by quadrature
  double throughput = 0;           // sum of |works|
  double imbalance() const { return kinetic + spring + damping - force - switching; }
};

// Over one mesh period.
struct LumpedRecord {
  Eigen::VectorXd x;       // (sample) m
  MatrixRM load;           // (sample, spring) N
  double mean = 0;         // m: mean of x
  double mean_square = 0;  // m2: mean of (x - reference())^2
  double least = 0;        // m: least x at ends of pieces
  double largest_exit =
      0;                // m: how far an end of a piece lies outside the interval in which its springs hold
  int separations = 0;  // times at which x falls below all gaps
};

// x rises above, or falls below, border `border` of its cell's gaps, the lowest being 1, at a phase of the mesh period.
struct LumpedCrossing {
  int border;
  bool rises;
  double phase;
};

class LumpedOscillator {
 public:
  using State = Eigen::Vector2d;   // x in m, x' in m s-1
  using Matrix = Eigen::Matrix2d;  // of derivatives, in the units of the state

  // parameters: mass, damper, damper_acts, cells; force F in N, > 0; samples of a record per period, >= 1. newmark_steps:
  // 0 for the closed form; otherwise Newmark's method with gamma = 1/2, beta = 1/4 (Eq. 8) in at least that many steps a
  // period, cells and samples being whole numbers of steps. Throws Error(input) for values that make no such oscillator.
  LumpedOscillator(const LumpedParameters& parameters, double force, int samples, int newmark_steps = 0);

  // Mesh frequency in Hz, > 0. Error(input) if not.
  void set_speed(double mesh_frequency);

  // Takes the state through one mesh period from phase 0. If derivative is given it is multiplied from the left by that of
  // the period map.
  void integrate(State& state, Matrix* derivative = nullptr);
  // The same, and what happens in between; energy balance is added to.
  LumpedRecord record(State& state, LumpedEnergyBalance& energy_balance);

  // Borders that the motion of one mesh period from this state crosses, in their order; where cells change also those that
  // move across x.
  std::vector<LumpedCrossing> crossings(State state);

  // At rest under F in the springs of phase 0.
  State rest() const;
  // Size of a difference of states: m over F / mean stiffness, m s-1 over that times the natural frequency.
  double size(const State& difference) const;
  State unit() const { return State(length_, length_ * rate_); }  // of size
  double reference() const { return length_; }                    // m: F / mean_stiffness()
  double mean_stiffness() const { return stiffness_; }     // N m-1: mean of F / x, x at rest in each cell
  double natural_frequency() const { return frequency_; }  // Hz: sqrt(mean stiffness / mass) / 2 pi
  double mean_frequency() const {
    return mean_frequency_;
  }  // Hz: mean of the same of each cell, springs as at rest
  double first_harmonic() const {
    return first_harmonic_;
  }                                         // N m-1: amplitude, of F / x, x at rest in each cell
  double frequency_at(double phase) const;  // Hz: of the springs that touch at rest in the cell of the phase

 private:
  // x from low to high touches the same springs: x'' + d x' + k x = b (in units of length_, 1 / rate_ and F).
  struct Region {
    double k, d, b, low, high;
    double slope;    // sqrt(|k - d^2 / 4|)
    double longest;  // a piece this long holds one extremum at most
  };
  struct Flow {
    double a11, a12, a21, a22, px, pv;
  };
  // Of an undisturbed piece: the whole, and the part that is watched for crossings.
  struct Cached {
    bool has_whole = false, has_part = false;
    Flow whole, part;
  };
  struct Cell {
    double end;
    std::vector<Region> regions;  // ascending in x
  };
  struct Piece {
    int cell;
    double begin, end;          // phases
    int sample;                 // that stands at its begin; -1: none
    std::vector<Cached> cache;  // (region)
  };

  static Flow flow(const Region& region, double time);
  static int region_of(const Cell& cell, double x, double v);
  static double rest_in(const Cell& cell);
  double potential(int cell, double x) const;
  std::vector<Piece> pieces(bool with_samples) const;
  template <class Visit>
  void run_exact(Piece& piece, double& x, double& v, Matrix* derivative, const Visit& visit);
  template <class Visit>
  void run_newmark(const Piece& piece, double& x, double& v, Matrix* derivative, const Visit& visit) const;

  LumpedParameters parameters_;
  double force_;
  int samples_, newmark_steps_;
  double stiffness_ = 0, length_ = 0, rate_ = 0, frequency_ = 0, mean_frequency_ = 0, first_harmonic_ = 0;
  std::vector<double> cell_frequency_;  // Hz, springs as at rest
  double period_ = 0;                   // of the mesh, in units of 1 / rate_
  std::vector<Cell> cells_;
  std::vector<Piece> integrating_, recording_;
};

}  // namespace whine
