// The artifacts that stages hand to each other: one struct and one read/write pair each.
//
// All values SI. Shapes are given with the axes in index order. Writers refuse values that are not finite,
// add units, long_name and axes to every dataset, /parameters and /provenance, and publish the file whole:
// temporary name in the same folder, fsync, rename. Readers check the content hash before HDF5 sees the file, then
// schema, version, shapes and finiteness, and throw Error(input) or Error(io) with the make target that rebuilds it.
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "files/scene.h"

namespace whine {

using MatrixRM = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixRMi = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// Where an artifact comes from; filled by the tool, completed by the writer.
struct Provenance {
  std::string tool;     // program name
  std::string command;  // as typed, paths relative to the working folder
  // "role=path"; each is hashed (SHA-256 of the file) and its history copied
  std::vector<std::string> inputs;
  // of the inputs before they were read; a writer refuses to publish what was made while one of them changed.
  // Empty: not known
  std::vector<std::string> sha256 = {};
};

// mesh.h5: one tooth sector; the tooth points along +y, sector edges at angle 90 deg -/+ 180 deg/teeth.
// The driving flank is the one that leads when the gear turns counter-clockwise (x < 0 side of the tooth).
struct MeshArtifact {
  GearDesign design;
  BodyDiscretisation discretisation;  // the file does not hold its near field: no mesh depends on it
  MatrixRM node_position;             // (node, 2) m
  MatrixRMi element_node;             // (element, 4 or 9): corners counter-clockwise, mid-sides, centre
  Eigen::VectorXi element_region;     // (element): 0 rim, 1 tooth (where the half-plane field is subtracted)
  Eigen::VectorXi bore_node;          // nodes on the rigid hub
  MatrixRMi side_node;  // (pair, 2): node on the clockwise edge (angle 90 deg - 180/teeth), its image on the
                        // counter-clockwise edge
  Eigen::VectorXi flank_node;        // nodes of the driving flank, root to tip
  Eigen::VectorXd flank_roll_angle;  // rad, of flank_node
  // None, or the sector of the cracked tooth, with the same node sets and sector edges. Nodes on the slit stand twice in
  // it, but for the tip; triangles are elements whose first corner stands also as fourth.
  std::vector<MeshArtifact> cracked_tooth;
  MatrixRMi slit_node;  // (pair, 2) in the cracked tooth's sector: the same point on the slit's two faces
};

// body.h5: all that the contact of a rolling gear needs of its solid. Per real mode (doublets: two columns,
// cosine then sine: on tooth j, counted counter-clockwise, the shape is Re and Im of exp(i n 2 pi j / teeth)
// phi).
struct BodyArtifact {
  GearDesign design;
  Material material;
  BodyDiscretisation discretisation;
  double inertia = 0;                // kg m2 of the meshed body about its axis (hub ring included)
  double mass = 0;                   // kg of the meshed body (hub ring included)
  Eigen::VectorXd eigenfrequency;    // (mode) Hz, hub fixed
  Eigen::VectorXi nodal_diameter;    // (mode)
  Eigen::VectorXi component;         // (mode) 0: cosine or single, 1: sine
  Eigen::VectorXd inertia_coupling;  // (mode) kg^1/2 m: gamma = phi^T M_fr, not zero for zero diameters only
  // (mode, 2) kg^1/2: phi^T M_fr of the hub's translations along x and y of the mesh, tooth 0 along +y; not zero for one
  // diameter only. With the column above it is the (mode, 3) coupling G to the rigid motions of the hub.
  MatrixRM translation_coupling;
  Eigen::VectorXd flank_position;  // (flank) rad: roll angle of the table points, ascending
  MatrixRM flank_mode;  // (flank, mode) kg^-1/2: outward normal displacement, M-normal modes, tooth 0
  int offsets = 0;      // tables hold tooth offsets 0 .. offsets
  // [offset] (flank, flank) m N-1: inward normal displacement of tooth `offset` (counter-clockwise of the
  // loaded one) per unit total normal force on tooth 0; offset 0: less the half-plane relative to
  // reference_depth
  std::vector<MatrixRM> compliance;
  double reference_depth = 0;  // m
  // The same between teeth that are farther apart, and between the two flanks of teeth: what joins the meshes of one gear with
  // several others. Pairs of one mesh take nothing of it.
  MatrixRM
      far_compliance;  // (offset flank, flank) m N-1: as compliance, offsets + 1 .. teeth / 2, one below the other
  MatrixRM
      back_compliance;  // (tooth flank, flank) m N-1: of the other flank of tooth 0 .. teeth - 1; no half-plane is taken off
  MatrixRM back_flank_mode;  // (flank, mode) kg^-1/2: as flank_mode, on the other flank
  // (tooth flank, tooth flank) m N-1, or empty: what the crack adds to the compliance between the teeth from `offsets`
  // clockwise of the cracked one to `offsets` counter-clockwise of it, tooth by tooth
  MatrixRM crack_compliance;
  double asymmetry = 0;         // relative, before symmetrisation
  double least_eigenvalue = 0;  // m N-1 of the compliance of all offsets less the stored modes
  // for looking: the whole gear with mode shapes and the displacement under a unit force at mid flank; written, never
  // read: no stage needs them, and they are most of the file
  MatrixRM vtk_point;                                            // (point, 2) m
  MatrixRMi vtk_cell;                                            // (cell, 4 or 9), node order as element_node
  std::vector<std::pair<std::string, MatrixRM>> vtk_point_data;  // name, (point, 2)
};

// static.h5
struct StaticArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  double torque = 0;  // N m on the driver
  double contact_ratio = 0;
  int hunting_periods =
      1;  // mesh periods after which the same teeth meet, as far as teeth differ; all are here
  Eigen::VectorXd mesh_phase;          // (phase) 1, 0 to hunting_periods
  Eigen::VectorXd transmission_error;  // (phase) m
  Eigen::VectorXd unloaded_error;      // (phase) m: the same without load, 0 for flanks as they are designed
  // (phase) N m-1, of the mesh without bearings; the secant is the load over what it adds to the transmission error; the tangent of contact "line" is off by
  // up to 0.6 % where contact comes near a tip edge
  Eigen::VectorXd stiffness_secant, stiffness_tangent;
  Eigen::VectorXi pair;  // (pair)
  MatrixRM tooth_load;   // (phase, pair) N
  // [gear] (phase, xy) N: what a gear presses its bearing with; empty for a rigid one. The driver's centre stands at the origin,
  // the driven gear's above it, the driver turns counter-clockwise.
  std::array<MatrixRM, 2> bearing_force;
  // (phase, pair) Pa, m: of contacts that stay inside the flank, 0 elsewhere
  MatrixRM contact_pressure, contact_half_width;
  Eigen::VectorXd transmission_error_harmonic;  // (harmonic 0..) m: mean, then amplitudes
  Eigen::VectorXd stiffness_harmonic;           // (harmonic 0..) N m-1, of the secant stiffness
  // (order 0..) m: mean, then amplitudes of the harmonics of the hunting frequency, up to those above; empty for teeth that
  // are all alike
  Eigen::VectorXd transmission_error_order;
  double mean_stiffness = 0;  // N m-1: mean over the period of the secant stiffness
  // certificate: worst over all positions
  double least_gap = 0;        // m, of strips without force
  double least_force = 0;      // N, of strips with force
  double torque_residual = 0;  // relative, |sum a p - T| / T
  double backlash_margin = 0;  // m left on the line of action; infinite backlash is not stored (see flag)
};

// What changing one thing alone changes in the static answer.
struct StaticChanges {
  std::string entry;                      // names of the entries, separated by ", "
  Eigen::VectorXd mean_stiffness_change;  // (entry) 1, relative
  Eigen::VectorXd peak_to_peak_change;    // (entry) 1, relative, of the transmission error
  // (entry) 1, relative, of the largest pressure inside a flank; empty: not known, or no contact stays inside
  Eigen::VectorXd pressure_change;
  MatrixRM harmonic_change;  // (entry, harmonic 1..5) 1, of the transmission error, over its first harmonic
};

// error_budget.h5
struct ErrorBudgetArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;  // the contact rung only
  ContactDiscretisation contact;
  double torque = 0;         // N m on the driver
  StaticChanges refinement;  // discretisations: their changes are errors and add up
  StaticChanges choice;      // models that could be chosen instead: for information, no errors and in no sum
  std::string choice_missing;  // which of them could not be computed, and why; "" if all were
};

// loaded_<phase>.h5: both gears at rest in one mesh position, loaded and deformed, with the pressure of their contact. Gears
// stand in their places: the driver's centre at the origin, the driven gear's above it. Strips are numbered pair after pair;
// teeth count counter-clockwise on both gears.
struct LoadedArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  ContactDiscretisation contact;
  double torque = 0;              // N m on the driver
  double mesh_phase = 0;          // 1, whole part: the mesh period, for teeth that differ
  double transmission_error = 0;  // m
  Eigen::VectorXi pair;           // (pair) those that carry load
  Eigen::VectorXd tooth_load;     // (pair) N
  MatrixRMi tooth;                // (pair, gear)
  MatrixRM
      root_stress;  // (pair, gear) Pa: largest principal stress at the nodes of the fillet below the loaded flank
  Eigen::VectorXi strip_pair;  // (strip)
  MatrixRM strip_roll;         // (strip, gear) rad, of the strip's middle
  Eigen::VectorXd strip_width, strip_force, strip_pressure, strip_separation;  // (strip) m, N, Pa, m
  MatrixRM strip_deflection;  // (strip, gear) m: inward, mean over the strip, by the whole field
  // (gear) N m: what holds the hub, by the elements about the bore, and the moment of the forces along the flanks' normals
  Eigen::Vector2d hub_torque = Eigen::Vector2d::Zero(), contact_torque = Eigen::Vector2d::Zero();
  // (gear) J: by quadrature of the stresses, and half of what forces times deflections are
  Eigen::Vector2d strain_energy = Eigen::Vector2d::Zero(), contact_work = Eigen::Vector2d::Zero();
  // for looking; written, never read. Cells: elements of the driver, of the driven gear, then two-node lines, the strips of
  // the driver's flanks and those of the driven gear's.
  MatrixRM vtk_point;            // (point, 2) m
  MatrixRMi vtk_cell, vtk_line;  // (cell, 4 or 9), (line, 2)
  struct Field {
    std::string name, units;
    MatrixRM values;  // (point, or cell and line; 1, 2 or 3)
  };
  std::vector<Field> vtk_point_data, vtk_cell_data;
};

// impact.h5: free decay of the transmission error about the static equilibrium, gears held at a mesh phase. A
// natural frequency is Im s / 2 pi, that of the decaying oscillation, and a damping ratio -Re s / |s| of the lowest
// oscillating root s.
struct ImpactArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  Damping damping;
  double torque = 0;                              // N m on the driver
  double torque_step = 0;                         // 1: what is let go at the start, over the torque
  double driver_inertia = 0, driven_inertia = 0;  // kg m2
  double mean_stiffness = 0;                      // N m-1 that sets the bearing dampers
  double driver_bearing_damper = 0, driven_bearing_damper = 0;  // N m s
  // (state) number of loaded pairs in words, fewest first, each amid the longest part of the period that has it;
  // "mean" last: over the period
  std::vector<std::string> contact_state;
  Eigen::VectorXd natural_frequency, damping_ratio;              // (state) Hz, 1
  Eigen::VectorXd undamped_frequency;                            // (state) Hz: contact frozen, no damping
  Eigen::VectorXd state_phase;                                   // (state but the mean) 1: mesh phase
  Eigen::VectorXd time;                                          // (time) s
  MatrixRM transmission_error;                                   // (state but the mean, time) m
  Eigen::VectorXd mesh_phase;                                    // (phase) 1
  Eigen::VectorXi loaded_pairs;                                  // (phase) in static equilibrium
  Eigen::VectorXd phase_natural_frequency, phase_damping_ratio;  // (phase) Hz, 1: of the decay
  Eigen::VectorXd phase_undamped_frequency;                      // (phase) Hz: contact frozen, no damping
  Eigen::VectorXd eigen_frequency, eigen_damping_ratio;  // (phase) Hz, 1: eigenvalues with contact frozen
  Eigen::VectorXd fit_residual;                          // (phase) RMS of decay less fit over RMS of decay
  // (phase, mode) Hz, ascending: of gears on bearings the lowest natural frequencies with the contact frozen, no damping: those
  // of the hubs on their bearings, and the mesh's, which is phase_undamped_frequency. Empty for rigid axes
  MatrixRM frozen_frequency;
  double least_mesh_force = 0;  // 1: least mesh force of all decays, over the static one
};

// Lines of a sweep's energy ledger: the changes of what is stored and what dampers take equal the works less
// averaging.
struct EnergyLine {
  const char *name, *meaning;
};
inline constexpr std::array<EnergyLine, 12> kEnergyLines{
    {{"kinetic", "change of the energy of motion"},
     {"modal", "change of the energy in the springs of the kept modes and of bearings"},
     {"residual", "change of the energy in the lagged flexibility"},
     {"local", "change of the energy in the half-planes and all that follows at once"},
     {"torque", "work of the constant torques on the vibration"},
     {"rolling", "work of the prescribed rolling"},
     {"modal_damping", "taken by the Rayleigh and bearing dampers of the kept coordinates"},
     {"lag_damping", "taken by the Rayleigh damping of the lagged flexibility"},
     {"switching", "work of the scheme itself where strips open or close within a step"},
     {"cutting", "work where a corner rule takes out or lets in a pair that carries force"},
     {"averaging", "mean load times change of the lag, less the exact work: of the scheme itself"},
     {"forgetting", "taken out with the lag of teeth that are no longer followed"}}};

// What a lumped model (Eq. 23) is made of, in place of elastic bodies: m x'' + c x' + sum_i k_i max(x - g_i, 0) = T / r,
// k_i and g_i constant in each cell of the mesh period.
struct LumpedParameters {
  double mass = 0;           // kg
  double damping_ratio = 0;  // 1: c / 2 sqrt(mean stiffness x mass)
  double damper = 0;         // N s m-1
  std::string damper_acts;   // "always" as in Eq. 23, or in "contact" only
  Eigen::VectorXd cell_end;  // (cell) mesh phase, ascending, last 1
  MatrixRM stiffness, gap;   // (cell, spring) N m-1, m; one spring for the whole mesh, or one per tooth pair
};

// sweep.h5: rows in order of marching
struct SweepArtifact {
  std::string model =
      "finite elements";  // or a lumped model's name; then the fields of the bodies say where its
                          // stiffness comes from, and its damping is that of `lumped` alone
  LumpedParameters lumped;
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  TimeDiscretisation time;
  Damping damping;
  double torque = 0;                                            // N m on the driver
  double driver_inertia = 0, driven_inertia = 0;                // kg m2
  double mean_stiffness = 0;                                    // N m-1 that sets the bearing dampers
  double driver_bearing_damper = 0, driven_bearing_damper = 0;  // N m s
  double natural_frequency = 0;    // Hz: mean over the period with the contact frozen under the static load
  int hunting_periods = 1;         // mesh periods after which the same teeth meet, as far as teeth differ
  std::string direction;           // "up" or "down"
  Eigen::VectorXd mesh_frequency;  // (speed) Hz
  // (speed, sample) m: the first period_multiple mesh periods are one orbit, repeated to fill the row
  MatrixRM transmission_error;
  MatrixRM mesh_force;               // (speed, sample) N
  Eigen::VectorXi pair;              // (pair)
  std::vector<MatrixRM> tooth_load;  // [speed] (sample, pair) N
  // [gear][speed] (sample, xy) N: as in static.h5, with the bearing's damper; empty for a rigid bearing
  std::array<std::vector<MatrixRM>, 2> bearing_force;
  Eigen::VectorXi periods;   // (speed) mesh periods run
  Eigen::VectorXd residual;  // (speed) relative change of the state over a period at the end
  // (speed) mesh periods of the orbit: hunting_periods unless subharmonic; 0: not periodic within the limit
  Eigen::VectorXi period_multiple;
  Eigen::VectorXd energy_imbalance;  // (speed) relative to the input energy of the stored periods
  MatrixRM energy;                   // (speed, line of kEnergyLines) J over the stored periods
  // (speed) N: largest force that the output must supply to hold the mean speed
  Eigen::VectorXd drift_force;
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  // certificate: worst over all steps of the stored periods
  double least_gap = 0;        // m, of strips without force
  double least_force = 0;      // N, of strips with force
  int fallbacks = 0;           // contact solutions that needed Lawson and Hanson's method
  double backlash_margin = 0;  // m left on the line of action; infinite backlash is not stored (see flag)
};

// response.h5: what a sweep says, per speed
struct ResponseArtifact {
  double torque = 0;
  std::string direction, model;       // model: "finite elements" or a lumped model's name
  Eigen::VectorXd mesh_frequency;     // (speed) Hz
  Eigen::VectorXd dte_rms, dte_mean;  // (speed) m
  MatrixRM dte_harmonic;              // (speed, harmonic 1..) m, amplitude
  int hunting_periods = 1;            // as in the sweep
  // (speed, order 1..) m, amplitude of the harmonics of the hunting frequency, up to those above; empty if it is the mesh
  // frequency
  MatrixRM dte_order;
  Eigen::VectorXd tooth_load_max, mesh_force_max;  // (speed) N
  // [gear] (speed) N: largest force on its bearing, and RMS of what of it oscillates; empty for a rigid bearing
  std::array<Eigen::VectorXd, 2> bearing_force_max, bearing_force_rms;
  Eigen::VectorXd separation_fraction;         // (speed) share of the period without force
  Eigen::VectorXd separations_per_period;      // (speed) 1
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  Eigen::VectorXi period_multiple;             // (speed) 1; 0: not periodic within the limit
  // what the sweep was computed with, so that a figure needs no other file
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  double driver_inertia = 0, driven_inertia = 0;  // kg m2
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  TimeDiscretisation time;
  Damping damping;
  double natural_frequency = 0;  // Hz: as in the sweep
};

// branch.h5: periodic orbits of one mesh period along their branch, stable or not, points in the order of its arc
struct BranchArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  double driver_inertia = 0, driven_inertia = 0;  // kg m2
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  TimeDiscretisation time;
  Damping damping;
  double torque = 0;                                  // N m on the driver
  Eigen::VectorXd mesh_frequency, dte_rms, dte_mean;  // (point) Hz, m, m
  MatrixRM dte_harmonic;                              // (point, harmonic 1..) m, amplitude
  std::vector<MatrixRM>
      floquet_multiplier;    // (point) (multiplier, 2) 1: real and imaginary part, largest modulus first
  Eigen::VectorXi stable;    // (point) 1: all multipliers lie inside the unit circle
  Eigen::VectorXi steps;     // (point) 1: time steps per mesh period
  Eigen::VectorXd residual;  // (point) 1: change of the state over a period, relative
  Eigen::VectorXd segment_mismatch;          // (change of steps) 1: relative change of the orbit there
  Eigen::VectorXd fold_frequency, fold_rms;  // (fold) Hz, m: where the branch turns
  Eigen::VectorXi fold_smooth;               // (fold) 1: a multiplier is 1; 0: at a kink
  MatrixRM fold_multiplier;  // (fold, 2) 1: the real multiplier nearest to 1 before and after it
  Eigen::VectorXd flip_frequency, torus_frequency;   // Hz
  Eigen::VectorXd grazing_frequency, grazing_phase;  // (grazing) Hz, share of the mesh period
  Eigen::VectorXi grazing_pair,
      grazing_closes;  // (grazing) pair that comes into, or out of, contact; 1: it closes
  std::string end;     // why the branch was followed no further
};

// jump_map.h5: where the primary resonance of a pair has two branches, and what its teeth then carry, at one torque for
// several dampings ("cases"). Speeds ascend; direction 0 is up, 1 down.
struct JumpMapArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  double driver_inertia = 0, driven_inertia = 0;  // kg m2
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  TimeDiscretisation time;
  Damping damping;  // its Rayleigh stiffness factor is 0: each case has its own
  std::string model = "finite elements";
  double torque = 0;              // N m on the driver
  double bearing_stiffness = 0;   // N m-1 that sets the bearing dampers
  double mean_stiffness = 0;      // N m-1: secant, at rest
  double first_harmonic = 0;      // N m-1: amplitude, of the secant stiffness at rest
  double two_pair_frequency = 0;  // Hz, contact frozen, undamped, amid the state of two pairs
  double one_pair_frequency = 0;  // Hz: the same for one pair; 0 if one pair alone never carries the load
  Eigen::VectorXd rayleigh_stiffness, damping_ratio;  // (case) s, 1: of two pairs, contact frozen
  Eigen::VectorXi two_branches;                       // (case) 1 if speeds with two motions were found
  Eigen::VectorXd branches_from, branches_to;         // (case) Hz: ends of that range; 0 without one
  Eigen::VectorXi open_below;                         // (case) 1: the range goes on below the least speed
  Eigen::VectorXd loss_from, loss_to;  // (case) Hz: speeds that lose contact, on any branch; 0 without
  Eigen::VectorXd excitation;          // (case) first harmonic / mean stiffness / (2 damping ratio)
  MatrixRM peak_tooth_load;            // (case, direction) N: largest of all speeds
  // (case, direction) N: the same held for 1/64 of a mesh period: without the spike of a pair that comes into contact at
  // once, whose height depends on the time step
  MatrixRM held_tooth_load;
  double load_frequency = 0;  // Hz: the one speed of the next three; 0: none was asked for
  MatrixRM tooth_load, held_load_there, dte_rms_there;  // (case, direction) N, N, m
  Eigen::VectorXi unsteady;  // (case) speeds and directions at which no steady motion was found
  Eigen::VectorXi jump_case, jump_direction;   // (jump)
  Eigen::VectorXd jump_frequency, jump_width;  // (jump) Hz
  Eigen::VectorXd mesh_frequency;              // (speed) Hz
  // [direction] (case, speed) m, N, 1: share of the period without force
  std::array<MatrixRM, 2> dte_rms, tooth_load_max, separation_fraction;
};

// harris_map.h5: transmission error of a pair at rest, or its motion at the worst speed, against torque and tip relief. What
// else is taken off the flanks stands in `mesh`, whose tip reliefs are 0.
struct HarrisMapArtifact {
  GearDesign driver, driven;
  Material driver_material, driven_material;
  BodyDiscretisation driver_body, driven_body;
  GearMeshSpec mesh;
  Fidelity fidelity;  // of the map at rest the contact rung only, which is "strips"
  ContactDiscretisation contact;
  std::string relieved, shape;  // "driver", "driven" or "both" gears; "linear" or "parabolic"
  Eigen::VectorXd torque;       // (torque) N m, ascending
  Eigen::VectorXd relief;       // (relief) m, ascending
  Eigen::VectorXd length;       // (start) m: length of roll from where the relief starts to the tip edge
  MatrixRM start_roll;          // (start, gear) rad: the same as roll angles on driver and driven gear
  double design_torque = 0;     // N m
  std::vector<MatrixRM> peak_to_peak;             // [start] (torque, relief) m
  std::array<std::vector<MatrixRM>, 3> harmonic;  // first three, amplitudes: [start] (torque, relief) m
  // (start) m: least peak to peak at the design torque, and the relief that has it, between those of the map
  Eigen::VectorXd optimum_relief, optimum_peak_to_peak;
  MatrixRM cusp;               // (start, torque) m: peak to peak of that relief
  Eigen::VectorXd unrelieved;  // (torque) m: peak to peak without tip relief
  int checked = 0;             // points that were solved again with finer strips and at more positions
  double largest_error = 0;    // 1: largest difference from those, over the peak to peak there
  // On demand, empty otherwise: the larger of the sweeps up and down at the speed where it is largest.
  std::vector<MatrixRM> dynamic_rms, worst_frequency;  // [start] (torque, relief) m, Hz
  TimeDiscretisation time;                             // and what follows: of these motions
  Damping damping;
  double driver_inertia = 0, driven_inertia = 0;                    // kg m2
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;  // Hz
};

// What an artifact of a pair says of its two gears.
template <class Artifact>
void set_gears(Artifact& artifact, const BodyArtifact& driver, const BodyArtifact& driven) {
  artifact.driver = driver.design;
  artifact.driven = driven.design;
  artifact.driver_material = driver.material;
  artifact.driven_material = driven.material;
  artifact.driver_body = driver.discretisation;
  artifact.driven_body = driven.discretisation;
}

void write(const std::string& path, const MeshArtifact&, const Provenance&);
void write(const std::string& path, const BodyArtifact&, const Provenance&);
void write(const std::string& path, const StaticArtifact&, const Provenance&);
void write(const std::string& path, const ErrorBudgetArtifact&, const Provenance&);
void write(const std::string& path, const LoadedArtifact&, const Provenance&);
void write(const std::string& path, const ImpactArtifact&, const Provenance&);
void write(const std::string& path, const SweepArtifact&, const Provenance&);
void write(const std::string& path, const ResponseArtifact&, const Provenance&);
void write(const std::string& path, const BranchArtifact&, const Provenance&);
void write(const std::string& path, const JumpMapArtifact&, const Provenance&);
void write(const std::string& path, const HarrisMapArtifact&, const Provenance&);
MeshArtifact read_mesh(const std::string& path);
BodyArtifact read_body(const std::string& path);
StaticArtifact read_static(const std::string& path);
ErrorBudgetArtifact read_error_budget(const std::string& path);
LoadedArtifact read_loaded(const std::string& path);
ImpactArtifact read_impact(const std::string& path);
SweepArtifact read_sweep(const std::string& path);
ResponseArtifact read_response(const std::string& path);
BranchArtifact read_branch(const std::string& path);
JumpMapArtifact read_jump_map(const std::string& path);
HarrisMapArtifact read_harris_map(const std::string& path);

// A key of a scene with its value as a scene would have it, in the unit of its name. Keys of gears and materials have a value
// for driver and driven gear each, others one.
struct SceneKey {
  std::string section, name, driver, driven, meaning;
};

// What an artifact was made from, but for torques and speeds; of a static.h5 without what concerns motion. Sections that
// neither gear has (modification, error, crack) are left out.
std::vector<SceneKey> scene_keys_of(const StaticArtifact& artifact);
std::vector<SceneKey> scene_keys_of(const ResponseArtifact& artifact);

// What two maps were made from that differs, in a scene's keys and units: "bore_radius_mm 40 -> 35"; "" if nothing
// does. Gears by the driver's, if both gears changed alike.
std::string changed_keys(const JumpMapArtifact& from, const JumpMapArtifact& to);

}  // namespace whine
