// Figures of gears that run: responses to speed, motions at one speed, their tooth loads.
#pragma once
#include "motion/branch_result.h"
#include "motion/impact_result.h"
#include "plot/figures.h"
#include "signal/response_result.h"
#include "signal/sweep_result.h"

namespace whine {

// What figures of sweeps say about them that is in other artifacts.
struct Background {
  std::vector<std::string> scenes = {};       // of each sweep, "file: title"; or none
  std::vector<LumpedParameters> lumped = {};  // of each sweep, empty for elastic gears; or none
  std::vector<ImpactArtifact> impacts =
      {};  // for damping ratios, of any gears and torques; found by what they were made from
  std::vector<BranchArtifact> branches = {};  // for unstable orbits and folds; found likewise
};

// RMS and mean of the DTE against mesh frequency for both directions of the sweep, with jumps. A panel for each set of
// choices (damping, corner rule, fidelity, model) in the order in which they come, a curve for each torque (ascending) and
// each modification of the flanks. With branches the orbits that no sweep finds, unstable ones, and the folds at which branches turn.
// Throws Error(input) unless every sweep up has one sweep down of the same torque and choices.
Figure response_figure(const std::vector<ResponseArtifact>& sweeps, const Background& told = {});

// The steady motions at one mesh frequency (Hz): a column each, for each set of choices the upper branch and the lower one
// where the sweeps up and down differ there, by RMS, else the only one; then its title says so. Oscillating DTE over time
// and its spectrum. Throws Error(input) as response_figure, and for a frequency that is not a speed of every sweep.
Figure vibration_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                        const Background& told = {});

// The same motions: loads of successive teeth and the mesh force over the phase of tooth i, with the phases at which contact
// is lost (every tooth without force).
Figure tooth_load_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                         const Background& told = {});

// Largest tooth load against mesh frequency for both directions of the sweep, and the loads over the mesh period as
// tooth_load_figure shows them, at the speed at which the RMS of the DTE is largest. Throws Error(input) for sweeps of two
// torques or sets of choices, else as response_figure.
Figure dynamic_load_figure(const std::vector<SweepArtifact>& sweeps, Background told = {});

// Force of each gear on its elastic bearing against mesh frequency for both directions of the sweep: RMS of what of it oscillates,
// and the largest. Throws Error(input) for gears on rigid bearings, for sweeps of two torques or sets of choices, else as
// response_figure.
Figure bearing_force_figure(const std::vector<ResponseArtifact>& sweeps, const Background& told = {});

// Spectra of the DTE, one above the other by mesh frequency (40 at most), and the amplitudes of the first orders of the mesh
// frequency at every speed, of one sweep or of both directions of one. Amplitudes below 1e-4 of the largest are left out of the
// spectra. Throws Error(input) for more sweeps, or two that are not of one torque and set of choices.
Figure waterfall_figure(const std::vector<SweepArtifact>& sweeps);

// Net mesh force over two mesh periods of lumped models, a panel for each of one or two mesh frequencies (Hz) at the stored
// speed nearest to it. Throws Error(input) for sweeps of elastic gears, of two torques, or another number of frequencies.
Figure mesh_force_figure(const std::vector<SweepArtifact>& sweeps,
                         const std::vector<double>& mesh_frequencies);

// Ranges of neighbouring speeds at which either sweep loses contact, in Hz: "2820 to 2980, 3100", or "nowhere".
std::string loss_ranges(const ResponseArtifact& up, const ResponseArtifact& down);

}  // namespace whine
