// All figures: each a function from results to the tables and panels of one picture. figure_registry.cpp gives them names and inputs.
#pragma once
#include <string>
#include <vector>

#include "io/study_result.h"
#include "report/figures.h"
#include "report/printed_jumps.h"
#include "report/sweep_panels.h"
#include "results/branch.h"
#include "results/error_budget.h"
#include "results/fold_curves.h"
#include "results/harris_map.h"
#include "results/impact.h"
#include "results/jump_map.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/runup.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "results/sweep_errors.h"

namespace whine {

// --- Gears as they are drawn, and at rest.

// The whole pair and a close-up of the teeth in mesh, edges of elements in mm. Driver's centre at the origin,
// driven gear's above it at the centre distance, both unloaded and turned to mesh phase 0: the reference pair
// touches at the pitch point. Throws Error(input) if the meshes are not those of the static artifact's gears.
Figure mesh_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& pair);

// The contact zone of the reference pair at mesh phase 0: the teeth with the region in which the half-plane joins the finite
// elements, the candidate zone of strips with a candidate pair of points in the middle of each (P on the driver, G on the
// driven gear) on the unloaded flanks, and pressure and separation under load. Lengths along the flank grow to the driver's
// tip. Throws Error(input) as mesh_figure, and for statics without that contact.
Figure contact_zone_figure(const SectorGrid& driver, const SectorGrid& driven, const StaticResult& pair);

// What is taken off the driving flanks of both gears, as an inspection sheet shows it: material against the roll angle, the
// tip to the right, the designed involute a straight line, plus upwards. Marks: start of the active profile, lowest and
// highest point of single-pair contact, pitch point, tip.
Figure profile_figure(const StaticResult& pair);

// Static transmission error over a mesh period and its spectrum, one curve per torque in the order given. Throws
// Error(input) for no input or two of the same torque.
Figure transmission_error_figure(const std::vector<StaticResult>& statics);

// Mesh stiffness k = (T / r_b1) / transmission error over a mesh period and its spectrum, with the
// rectangular wave.
// The rectangular wave is that of the first artifact given.
Figure mesh_stiffness_figure(const std::vector<StaticResult>& statics);

// The share of the load that a tooth pair carries on its way through the mesh, one curve per torque in the order
// given, and the loads of all pairs over a mesh period at the first torque given. Throws Error(input) as transmission_error_figure.
Figure load_sharing_figure(const std::vector<StaticResult>& statics);

// Teeth that differ: static transmission error over the hunting period, its spectrum in orders of the mesh frequency, and that
// of the dynamic one at the speed of the sweep with the largest RMS. Orders 1 / teeth and their multiples are those of a shaft;
// beside a harmonic of the mesh frequency they are its sidebands. Throws Error(input) if the teeth are all alike, or the two
// are not of one torque and one hunting period.
Figure sidebands_figure(const StaticResult& statics, const ResponseResult& motion);

// A cracked tooth: static transmission error about the mesh periods in which it works, beside that of teeth without a crack,
// what it adds, and the spectrum in orders of the mesh frequency. Without a crack is what the pair shows while the cracked
// tooth is on the far side of its gear. Throws Error(input) for a pair without a crack or with errors tooth by tooth, which
// nothing tells from its mark.
Figure crack_figure(const StaticResult& statics);

// Line load on a tooth over face and path of contact, as the tooth passes through the mesh, as colours; beside it the line load of each
// tooth pair over the face at mesh phase 0. Throws Error(input) for a pair in one slice.
Figure flank_load_figure(const SystemStaticResult& statics);

// Changes of the static answer by each refinement, as bars, in per cent; apart from them those by another choice of near field or
// contact.
Figure error_budget_figure(const ErrorBudgetResult& budget);

// --- In motion.

// Damping ratio over natural frequency: of each mode the decays (mean and range over the mesh phases) and the eigenvalues,
// Rayleigh's damping alone; of a pair the decays of its contact states, of a train the natural frequencies of rigid gears. Throws
// Error(input) if no mode oscillates.
Figure impact_figure(const ImpactResult& a);

// RMS of the dynamic transmission error of each mesh along the branch, stable and unstable, with the motions of the sweeps, and the
// largest modulus of the multipliers. sweeps: of the same pair or train, none, one or both directions. Throws Error(input) for a branch
// without orbits and sweeps of another number of meshes.
Figure branch_figure(const BranchResult& branch, const std::vector<ResponseResult>& sweeps);

// The steady motions at one mesh frequency (Hz): a column each, for each set of choices the upper branch and the lower one
// where the sweeps up and down differ there, by RMS, else the only one; then its title says so. Oscillating DTE over time
// and its spectrum. Throws Error(input) as response_figure, and for a frequency that is not a speed of every sweep.
Figure vibration_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency,
                        const CaptionSources& background = {});

// The same motions: loads of successive teeth and the mesh force over the phase of tooth i, with the phases at which contact
// is lost (every tooth without force).
Figure tooth_load_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency,
                         const CaptionSources& background = {});

// Largest tooth load against mesh frequency for both directions of the sweep, and the loads over the mesh period as
// tooth_load_figure shows them, at the speed at which the RMS of the DTE is largest. Throws Error(input) for sweeps of two
// torques or sets of choices, else as response_figure.
Figure dynamic_load_figure(const std::vector<SweepResult>& sweeps, CaptionSources background = {});

// Spectra of the DTE (160 at most) as colours along the rays of their orders over mesh frequency, of one sweep or of both directions of
// one. Amplitudes below 1e-4 of the largest are left out. Throws Error(input) for more sweeps, or two that are not of one torque and set of choices.
Figure waterfall_figure(const std::vector<SweepResult>& sweeps);

// Net mesh force over two mesh periods of lumped models, a panel for each of one or two mesh frequencies (Hz) at the stored
// speed nearest to it. Throws Error(input) for sweeps of elastic gears, of two torques, or another number of frequencies.
Figure mesh_force_figure(const std::vector<SweepResult>& sweeps, const std::vector<double>& mesh_frequencies);

// Amplitudes of the first five orders of the mesh frequency. Of a pair speed rising (a) and falling (b); Error(input) unless it is
// given one sweep up and one down of the same gears and torque. Of a train a panel for each mesh, of planets that are alike for those
// of the first; Error(input) unless the sweeps are of one train, one a direction at most.
Figure order_figure(const std::vector<ResponseResult>& sweeps);

// Root stress of both gears while a tooth passes through the mesh (a) and its largest value over speed, both sweep directions (b);
// dynamic factors of mesh force, tooth load and root stress beside K_v of ISO 6336-1, method B (c): over T / r_b or over the
// largest at rest. In motion all are what is sustained for 1/64 of a mesh period, and root stress is quasi-static in the tooth loads.
// External pairs also show sigma_F0 of ISO 6336-3, method B. What a formula of the standard cannot say is left out, and a note says
// why, as it does outside of the range in which the formula was tested. Tables: what is drawn, and loss factors. Throws
// Error(input) for artifacts without root stress, sustained loads or losses, of another torque, or that are not two sweeps, up and down.
Figure root_stress_figure(const StaticResult& statics, const std::vector<ResponseResult>& sweeps,
                          const std::vector<BranchResult>& branches = {});

// statics: at the torque of the sweeps. sweeps: up and down, with flank pressure (studies/sweep_pressure.h). The map of falling
// speed is drawn where it differs from that of rising speed by more than 1 % of the largest pressure. Throws Error(input) for
// sweeps of other torques or directions and for those without flank pressure.
Figure flank_pressure_figure(const StaticResult& statics, const std::vector<ResponseResult>& sweeps);

// Efficiency (a) and power lost (b) over mesh frequency at each torque, both sweep directions, with the efficiency at rest; the
// moments of friction about both axes over a mesh period at rest, at the first torque (c). A table of each sweep, and one at rest
// with the loss factor H_V apart from the coefficient of friction, and that of rigid teeth. Throws Error(input) for artifacts
// without friction, and unless there is one static.h5 and two sweeps, up and down, at each torque; of 6 torques at most.
// Speeds at which the motion goes beyond the backlash are marked, in the figure and in a column: friction of back flanks, which would
// touch there, is in no number.
Figure efficiency_figure(const std::vector<StaticResult>& statics, const std::vector<ResponseResult>& sweeps);

// sweeps: of the same torque, up and down or none: their first harmonics, at which a slow ramp must arrive, stand beside the
// orders. Throws Error(input) for a sweep of another torque or a ramp too short for a window.
Figure runup_figure(const RunupResult& a, const std::vector<ResponseResult>& sweeps);

// Of each orbit the multipliers of a modulus above 0.05. Notes name folds with the multipliers on either side.
Figure multiplier_figure(const BranchResult& branch);

// Teeth that differ, or of which one is cracked. Of a pair or a train, of a train the mesh with the largest residual signal: at the speed at
// which that is largest transmission error and residual signal over the hunting period and their orders; over speed RMS and kurtosis of the
// residual signal. Throws Error(input) unless both are of the same speeds and of teeth that differ or are cracked.
Figure residual_figure(const SweepResult& sweep, const ResponseResult& response);

// How large the discretisation errors of the motions over speed are, and what they come from. One sweep, or both directions of one
// operating point; throws Error(input) for two of one direction.
Figure sweep_errors_figure(const std::vector<SweepErrorsResult>& sweeps);

// --- Maps and studies.

// Peak-to-peak transmission error against torque and tip relief, with the best relief of each torque and the optimum for the
// design torque; beside it, against torque, that relief of each start and no relief (the Harris cusp). The map is that of
// the start whose optimum is least. With a dynamic part its map of the RMS at the worst speed stands below.
Figure harris_map_figure(const HarrisMapResult& map);

// A colour for each artifact, all of one quantity; marks for jumps of the sweeps of maps, of elastic pairs over damping at the same
// torque and corner rule. Notes count the sweeps' jumps within 1 Hz of a curve, and the cells of the maps that lie on the
// right side of the cusps. Throws Error(input) for no artifact, more than six or different quantities.
Figure fold_curve_figure(const std::vector<FoldCurvesResult>& curves, const std::vector<JumpMapResult>& maps);

// One panel per corner rule or lumped model: torque against damping ratio, with the cells that have two branches or lose
// contact, and lines of the largest tooth load (sustained for 1/64 of a mesh period). What is printed of
// their gears stands beside. Throws Error(input) for no map, for two of the same torque and panel, and unless all have
// the same damping ratios and gears and each panel the same torques.
// curves: over damping, whose last cusps are drawn over the cells of the panel with their corner rule: to the left of them
// there are two branches.
Figure jump_map_figure(std::vector<JumpMapResult> maps, const std::vector<FoldCurvesResult>& curves = {},
                       PrintedJumps printed = {});

// The same of lumped models, a column each, with the damper always on above and in contact only below; beside them the elastic
// pair, of whose maps those with the corner rule of the lumped models' statics are taken. In words: which models jump at every
// torque at the printed damping, or that amid the map, which lose contact at the printed low torque only, in how many cells they
// answer as the elastic pair, what decides. Throws Error(input) without a lumped model, else as jump_map_figure.
Figure lumped_jump_map_figure(std::vector<JumpMapResult> maps, PrintedJumps printed = {});

// What each variant changes against the base, in the last case of the maps: mean
// stiffness, natural frequencies, ends of the branches, tooth load (sustained). Every case stands in the table. Throws Error(input)
// for no variant, one that differs in torque or cases, or one in which no key differs.
Figure sensitivity_figure(const JumpMapResult& base, const std::vector<JumpMapResult>& variants);

// A row of panels for each response quantity of the plan's figure, a column for each of its keys; the block [variants] is the
// table of all response quantities that were gathered. In a grid lines join the variants that differ in the panel's key alone;
// of a sample there are points, the rank correlation (Spearman) of response quantity and key, and the distribution with its
// 5th, 50th and 95th percentile. Variants outside the model's range are in the table, marked, and in no panel. Throws
// Error(input) if all lie outside the model's range.
Figure study_figure(const StudyResult& study);

// Spearman's rank correlation, ties at their mean rank; 0 if one of the two does not vary.
double rank_correlation(const std::vector<double>& x, const std::vector<double>& y);

// --- Systems of several meshes.

// Transmission error and force of each mesh, size of the force on each bearing, pin and axis; the notes say how planets share
// the load. Throws Error(input) for a pair.
Figure system_static_figure(const SystemStaticResult& a);

// One speed of a train: transmission error and force of each mesh, force on each bearing, over the mesh periods of the motion, and their
// harmonics; where rising and falling speed lead to two motions, of both. Throws Error(input) for a speed that a sweep does not hold.
Figure train_history_figure(const std::vector<SweepResult>& sweeps, double mesh_frequency);

// Of each [[mesh]] of planets the share of each over the mesh period, and the loads of the tooth pairs of its first mesh. Throws
// Error(input) for a system without planets.
Figure system_load_sharing_figure(const SystemStaticResult& a);

// The first kMostShapes shapes that are no free motions, one of each pair of equal frequencies, magnified. A body is drawn as its
// pitch circle with one radius, by which its rotation is seen; a carrier as the polygon of its pins with spokes.
inline constexpr size_t kMostShapes = 15;
Figure modes_figure(const ModesResult& modes);

// Crossings f_mesh = f_n / l of the harmonics l = 1 .. kCampbellHarmonics are in a table of their own; of elastic gears a band
// spans the frequencies of all mesh phases.
inline constexpr int kCampbellHarmonics = 5;
Figure campbell_figure(const ModesResult& modes);

// sweeps: of one system, one or both directions. RMS of the dynamic transmission error, share of the time without contact and
// largest force of each mesh, oscillating force of each bearing, over mesh frequency.
Figure system_sweep_figure(const std::vector<ResponseResult>& sweeps);

}  // namespace whine
