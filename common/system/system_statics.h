// A system at rest: which contact each phase has under the torques of its drives.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "system/axial_loads.h"
#include "system/system.h"

namespace whine {

struct LoadedSegment {
  int mesh = 0, pair = 0;
  double force = 0;  // N
  ContactPatch patch;
};

struct SystemSolution {
  SystemEquilibrium equilibrium;
  std::vector<LoadedSegment> loads;
  std::vector<Vec2> bearing_force;  // [body] N, see bearing_force(); of rigid bearings, too
  std::vector<double> driving_force,
      driven_force;  // [mesh] N: torque on the first side over its base radius, on the second
  std::vector<double>
      friction_work;  // [mesh] J: that friction takes in a mesh period at this position; 0 without
  std::vector<double> transmission_error, deflection;    // [mesh] m; see mesh_deflection
  std::vector<double> next_corner_gap, lost_corner_gap;  // [mesh] m, see PairsInReach
  AxialLoads axial;                                      // of slices, else empty
  bool leaves_zone = false;                              // a wider range may do
  std::string
      at_root;  // body with pressure at the start of its involute, which a wider range does not change; "": none
  Eigen::MatrixXd
      mesh_stiffness;  // (mesh, mesh) N m-1, see SystemStatics; of rest_over_period() and system_at_rest() alone
};

// One pair of a position that is loaded.
struct ContactZone {
  PairStrips strips;
  Eigen::VectorXd force;       // (strip) N
  Eigen::VectorXd separation;  // (strip) m, of the loaded flanks (d of Eq. 18)
  double approach = 0;         // m: the transmission error at this phase
};

// A range that contact has left is tried again so many times, each for this many times the load and the gap of tip edges; its
// half-width goes with the root of the load.
inline constexpr int kWidenings = 6;
inline constexpr double kWidening = 1.6;

// m: gap up to which tip edges are looked for at first under a load (N) of the mesh.
double reach_of_edges(const GearMeshModel& mesh, double load);

// [mesh] How far contact is looked for under the mesh loads; zone: that of the strips is this many times as
// wide as the load alone asks for; widening: of the load that it is for, 1 unless contact has left it.
std::vector<CandidateZone> static_zones(const SystemModel& system, int strips, double zone, double widening);

// In words, where and by how much contact exceeds the range; empty if it does not. Throws Error(numerical) where a tip
// edge would leave the other's involute.
std::string outside_zone(const SystemSolution& solution, double phase);

class SystemStatics;

// A position of a walk over the hunting period: how many came before it, row (mesh period after mesh period), mesh period, phase 0 to 1.
struct RestStep {
  int step = 0, row = 0, period = 0;
  double phase = 0;
};
// Takes one position: its solution, and the statics that have just solved it.
using TakeRest = std::function<void(const RestStep&, const SystemSolution&, const SystemStatics&)>;

// Solves the positions of the hunting period of hunting_periods(system) mesh periods, which is one where teeth are alike; all mesh periods
// at one position, then the next position. Where contact leaves the range it begins again, at step 0, with a wider one. strips: across the
// contact width, of contact "strips"; zone: as in static_zones(). Throws as static_transmission.
void over_period(const SystemModel& system, ContactModel contact, int strips, int positions, double zone,
                 const TakeRest& take);

// (mesh period, position) from phase 0 on, of over_period().
std::vector<SystemSolution> rest_over_period(const SystemModel& system, ContactModel contact, int strips,
                                             int positions);

class SystemStatics {
 public:
  // range: of each mesh.
  SystemStatics(const SystemModel& system, ContactModel contact, std::vector<CandidateZone> range);

  // At a phase, 0 to 1, of a mesh period; start: (body) m. One phase after the other: what all mesh periods have in common
  // there is kept. Throws Error(numerical) where there is no equilibrium within the flanks.
  const SystemSolution& solve(double phase, int period, const Eigen::VectorXd& start);
  // (mesh, mesh) N m-1, of the position that was solved last: K = W^T C^-1 W, contact frozen: C the compliance without bearings
  // of what carries load, of lines with the slopes of their laws; W by how much each mesh's approach closes it, 1 on the line of
  // action and at a tip edge the mean of the lever arms over the base radii. Off-diagonal entries are due to bodies that take part
  // in several meshes join. A mesh without load has the stiffness 0.
  Eigen::MatrixXd mesh_stiffness() const;
  const SystemPosition& position() const { return *position_; }  // that was solved last
  // (strip, strip) m N-1, of that position, see contact_compliance().
  const Eigen::MatrixXd& compliance() const { return compliance_; }
  // [mesh], of strips, of the position that was solved last.
  std::vector<std::vector<ContactZone>> zones() const;

 private:
  void take_position(double phase, int period);
  // Throws ModelRangeError for displacements that are not small against the teeth.
  void require_small(const SystemSolution& solution) const;
  bool stated(const ContactSegment& segment) const;  // the pressure of a line's point
  // side: of mesh m with force at its root; -1: none.
  void note_root(SystemSolution& solution, size_t m, int side) const;
  void take_strips(SystemSolution& solution) const;
  void take_lines(SystemSolution& solution) const;
  const SystemModel& system_;
  bool lines_, alike_;
  std::vector<CandidateZone> range_;
  std::vector<double> depth_;  // [mesh] m
  std::vector<double> load_;   // [mesh] N, transverse
  SystemTables tables_;
  std::optional<SystemPosition> position_;
  int period_ = 0;
  Eigen::MatrixXd compliance_, with_cracks_;
  bool cracked_here_ = false;
  SystemSolution solution_;
  bool repeats_ = false;  // solution_ holds in all mesh periods
  ComplementaritySolver solver_;
};

}  // namespace whine
