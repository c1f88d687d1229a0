// Two elastic gears that roll at constant mean speed: modes, lagged residual flexibility, contact at every
// step.
//
// Coordinates (unit modal mass, z'' + c z' + w^2 z = force):
// - one rigid rotation of the pair, along the line of action; the other, r1 theta1 - r2 theta2, is projected
// out;
// - per gear the elastic modes. Those with zero diameters couple with the hub rotation through gamma and are
//   diagonalised with it: M0 = [[I, gamma^T], [gamma, 1]], K0 = diag(0, w^2);
// - what the modes leave of the flanks' flexibility relaxes with the Rayleigh time: eta U' + U = R p. Every
// truncated
//   mode has the same time, so the loads on the flank tables are relaxed instead and U = R (lagged loads).
// Gap of a strip: d = e - h z + U + A_local p >= 0 with p >= 0, p . d = 0 at the end of each step (Eq. 18).
#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "files/schemas.h"
#include "motion/propagator.h"
#include "motion/rolling_mesh.h"

namespace whine {

struct DynamicParameters {
  double torque = 0;                // N m on the driver; the driven gear resists with torque r_b2 / r_b1
  std::array<double, 2> inertia{};  // kg m2, total, per gear
  double mean_stiffness = 0;        // N m-1, sets the bearing dampers
  Damping damping;
  Fidelity fidelity;
};

class RollingDynamics {
 public:
  // Throws Error(input) if a total inertia is not above what the body's modes carry.
  RollingDynamics(const GearMeshModel& model, const DynamicParameters& parameters);

  // State at the start of a mesh period; lag fields per pair -reach..reach.
  struct State {
    Eigen::VectorXd z, v;   // (coordinate) kg^1/2 m, kg^1/2 m s-1
    Eigen::VectorXd force;  // (coordinate) contact and torque at this instant
    Eigen::VectorXd p, d;   // (strip) N, m: at the phase of this instant
    std::array<Eigen::MatrixXd, 2> lag,
        load;  // (flank, pair) N: lagged and present loads on the flank tables
  };
  // What one mesh period showed, sampled at each step: sample i at phase i / steps.
  struct Period {
    Eigen::VectorXd transmission_error;  // (step) m
    Eigen::MatrixXd pair_load;           // (pair, step) N, pairs -reach..reach
    double drift_force = 0;  // N: largest force that the output must supply to hold the mean speed
    double least_gap = 0, least_force = 0;  // m, N: worst of the steps' certificates
    int fallbacks = 0;                      // steps that block pivoting alone could not solve
  };

  // Where the energy goes, J, summed over the steps of a period. Every line is computed by itself, none as
  // what is left of the others. With mean forces p' = (p_n + p_n+1)/2:
  //   d(storage) + modal_damping + lag_damping = torque + rolling + switching + cutting - averaging.
  struct Ledger {
    double storage = 0;  // change of kinetic, modal, half-plane and residual energy
    double torque = 0;   // work of the constant torques on the vibration
    double rolling =
        0;  // work of the prescribed rolling: gaps, participation and compliance change with phase
    double modal_damping = 0;  // Rayleigh and bearing dampers of the kept coordinates, by quadrature of v^2
    double lag_damping = 0;    // of the residual flexibility, by quadrature
    // The scheme's own: strips that open or close within a step, (p_n d_n+1 - p_n+1 d_n) / 2.
    double switching = 0;
    double cutting = 0;     // pairs that a corner rule takes out, or lets in, while they carry force
    double averaging = 0;   // the scheme's own: mean load times change of the lag, less the exact work
    double throughput = 0;  // sum of |torque| + |rolling| per step
    double imbalance = 0;   // largest |sum of the imbalance so far|
  };

  // Builds the strips at `steps` phases; keeps nothing of an earlier range.
  void set_range(const ContactRange& range, int steps);
  // mesh frequency: Hz; steps per period must divide the steps of the range.
  void set_speed(double mesh_frequency, int steps);
  // Static equilibrium at phase 0, at rest.
  State rest();
  // Marches one mesh period and renames teeth, so that the state can be compared with the one before.
  // False if contact wanted more than the range holds; the state is then spoiled. A ledger costs several
  // times the march itself.
  bool march(State& state, Period& period, Ledger* ledger = nullptr);
  // Lowest natural frequency, Hz, with the contact frozen as the static load leaves it at phase i / (steps of
  // the range): undamped, the residual flexibility follows at once.
  double frozen_frequency(int i);
  // Renames teeth after a mesh period: what was pair j becomes pair j + 1, doublets turn by one tooth.
  void advance_tooth(State& state) const;
  // (node, coordinate): outward displacement of the flanks, hub rotation included, per unit coordinate; h of
  // the gap d = e - h z + ...
  Eigen::MatrixXd participation(const MeshPosition& mesh) const;
  // Distance of two states in the energy norm, relative to the static state's.
  double distance(const State& a, const State& b) const;

  int reach() const { return reach_; }                             // largest |pair| that can touch
  double bearing_damper(int g) const;                              // N m s
  double static_deflection() const { return static_deflection_; }  // m, transmission error of rest()

 private:
  struct Coordinate {
    int gear = -1;                                // -1: the rigid rotation
    double frequency = 0;                         // rad s-1
    double damping = 0;                           // s-1
    double torque = 0;                            // constant force of the torques
    std::array<double, 2> hub{};                  // rotation of each hub per unit, rad
    std::vector<std::pair<int, double>> columns;  // body modes and their shares
    int partner = -1;                             // other half of a doublet
    double turn = 0;                              // rad: its turn per mesh period (0 if single)
  };
  struct Step {                  // one position at one speed
    Eigen::MatrixXd compliance;  // (strip, strip)
    ActiveSet active;
  };
  struct Position {
    MeshPosition mesh;
    Eigen::MatrixXd local;                   // (strip, strip)
    Eigen::MatrixXd participation;           // (node, coordinate)
    Eigen::MatrixXd residual;                // (node, node): S R S^T of both gears
    std::array<Eigen::MatrixXd, 2> reading;  // (node, flank x pair): S R
    Eigen::VectorXd drift_lever;             // (node) 1: a1 / r1 - a2 / r2
  };
  struct Instant {  // what the ledger keeps of a step, per pair and strip in the order of mesh.pairs
    const Position* position = nullptr;
    int renamed = 0;  // added to its pair numbers since
    State state;
    Eigen::VectorXd modal, lagged;  // (strip) m: h z, U
    Eigen::MatrixXd pair_force;     // (coordinate, pair) h^T p of each pair
  };
  Instant instant(const Position& position, const State& state) const;
  void turn_doublets(Eigen::Ref<Eigen::VectorXd> y) const;
  void record_step(const Instant& before, const Instant& after, double& balance, Ledger& ledger) const;
  void add_modes(int g, const std::vector<int>& columns);
  Eigen::VectorXd flexibility() const;  // (coordinate) s2: 1 / w^2, 0 for the rigid rotation
  Eigen::MatrixXd static_compliance(const Position& position) const;

  const GearMeshModel& model_;
  DynamicParameters parameters_;
  std::array<std::vector<int>, 2> kept_;
  std::vector<Coordinate> coordinates_;
  Eigen::VectorXd error_weight_, torque_force_, frequency_squared_;
  double rigid_frequency_ = 0;  // rad s-1: sqrt(mean stiffness / reduced mass)
  int reach_ = 1, steps_ = 0, stride_ = 1;
  std::vector<Position> positions_;
  std::vector<Step> step_data_;
  std::vector<Propagator> propagators_;
  Lag lag_{};
  double step_ = 0;                          // s
  std::array<Eigen::MatrixXd, 2> residual_;  // (flank x pair, flank x pair) m N-1
  double static_deflection_ = 0, energy_scale_ = 1;
  ComplementaritySolver solver_;
};

}  // namespace whine
