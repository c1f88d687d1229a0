// Figures of motions: at one speed, their tooth loads, their spectra against speed.
#pragma once
#include "report/sweep_panels.h"

namespace whine {

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

// Spectra of the DTE, one above the other by mesh frequency (40 at most), and the amplitudes of the first orders of the mesh
// frequency at every speed, of one sweep or of both directions of one. Amplitudes below 1e-4 of the largest are left out of the
// spectra. Throws Error(input) for more sweeps, or two that are not of one torque and set of choices.
Figure waterfall_figure(const std::vector<SweepResult>& sweeps);

// Net mesh force over two mesh periods of lumped models, a panel for each of one or two mesh frequencies (Hz) at the stored
// speed nearest to it. Throws Error(input) for sweeps of elastic gears, of two torques, or another number of frequencies.
Figure mesh_force_figure(const std::vector<SweepResult>& sweeps, const std::vector<double>& mesh_frequencies);

}  // namespace whine
