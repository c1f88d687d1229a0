// The tables behind the figures: what is plotted, in the units that an engineer reads, before any drawing.
//
// A figure is a list of blocks of numbers (one curve or one set of marks each) and a list of words and
// numbers for its gnuplot template. Templates only draw: every conversion, selection and derived curve is
// made here and is in the TSV.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "files/schemas.h"
#include "motion/statics.h"

namespace whine {

struct FigureBlock {
  std::string name;                       // gnuplot finds it by `index "[name]"`
  std::vector<std::string> columns;       // with their unit: "mesh_frequency [Hz]"
  std::vector<std::vector<double>> rows;  // an empty row lifts the pen
};

struct Figure {
  std::string title;
  std::vector<std::string> scenes;  // "file: title" of those that all of it shows; filled by the caller
  std::vector<std::string> notes;   // one line each: operating point, choices, rung
  std::vector<FigureBlock> blocks;
  std::vector<std::pair<std::string, double>> numbers;     // variables of the template
  std::vector<std::pair<std::string, std::string>> words;  // string variables of the template
  int height = 1000;  // of the picture beside a width of 1600; also a variable
};

// The whole pair and a close-up of the teeth in mesh, edges of elements in mm. Driver's centre at the origin,
// driven gear's above it at the centre distance, both unloaded and turned to mesh phase 0: the reference pair
// touches at the pitch point. Throws Error(input) if the meshes are not those of the static artifact's gears.
Figure mesh_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& pair);

// The contact zone of the reference pair at mesh phase 0: the teeth with the region in which the half-plane joins the finite
// elements, the window of strips with a candidate pair of points in the middle of each (P on the driver, G on the driven gear)
// on the unloaded flanks, and pressure and separation under load. Lengths along the flank grow to the driver's tip. Throws
// Error(input) as mesh_figure.
Figure contact_zone_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& pair,
                           const ContactZone& zone);

// What figures of sweeps say about them that is in other artifacts.
struct Background {
  std::vector<std::string> scenes;       // of each sweep, "file: title"; or none
  std::vector<LumpedParameters> lumped;  // of each sweep, empty for elastic gears; or none
  std::vector<ImpactArtifact>
      impacts;  // for damping ratios, of any gears and torques; found by what they were made from
};

// RMS and mean of the DTE against mesh frequency for both directions of the sweep, with jumps. A panel for each set of
// choices (damping, corner rule, fidelity, model) in the order in which they come, a curve for each torque (ascending) and
// each modification of the flanks.
// Throws Error(input) unless every sweep up has one sweep down of the same torque and choices.
Figure response_figure(const std::vector<ResponseArtifact>& sweeps, const Background& told = {});

// What is taken off the driving flanks of both gears, as an inspection sheet shows it: material against the roll angle, the
// tip to the right, the designed involute a straight line, plus upwards. Marks: start of the active profile, lowest and
// highest point of single-pair contact, pitch point, tip.
Figure profile_figure(const StaticArtifact& pair);

// The steady motions at one mesh frequency (Hz): a column each, for each set of choices the upper branch and the lower one
// where the sweeps up and down differ there, by RMS, else the only one; then its title says so. Oscillating DTE over time
// and its spectrum. Throws Error(input) as response_figure, and for a frequency that is not a speed of every sweep.
Figure vibration_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                        const Background& told = {});

// The same motions: loads of successive teeth and the mesh force over the phase of tooth i, with the phases at which contact
// is lost (every tooth without force).
Figure tooth_load_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                         const Background& told = {});

// Static transmission error over a mesh period and its spectrum, one curve per torque (ascending). Throws
// Error(input) for no input or two of the same torque.
Figure transmission_error_figure(std::vector<StaticArtifact> statics);

// Mesh stiffness k = (T / r_b1) / transmission error over a mesh period and its spectrum, with the
// rectangular wave.
Figure mesh_stiffness_figure(std::vector<StaticArtifact> statics);

// Teeth that differ: static transmission error over the hunting period, its spectrum in orders of the mesh frequency, and that
// of the dynamic one at the speed of the sweep with the largest RMS. Orders 1 / teeth and their multiples are those of a shaft;
// beside a harmonic of the mesh frequency they are its sidebands. Throws Error(input) if the teeth are all alike, or the two
// are not of one torque and one hunting period.
Figure sidebands_figure(const StaticArtifact& statics, const ResponseArtifact& motion);

// A cracked tooth: static transmission error about the mesh periods in which it works, beside that of teeth without a crack,
// what it adds, and the spectrum in orders of the mesh frequency. Without a crack is what the pair shows while the cracked
// tooth is on the far side of its gear. Throws Error(input) for a pair without a crack or with errors tooth by tooth, which
// nothing tells from its mark.
Figure crack_figure(const StaticArtifact& statics);

// Natural frequencies by ring-down with few and with many pairs in contact and on the mean, a row for each torque
// (ascending). The mean stands there twice: over the phases of a mesh period, and over the two states, weighted by the
// shares of the period that the contact ratio gives them. published: a file of lines "torque <tab> contact <tab>
// frequency" in N m and Hz, contact one, two, .. or mean; deviations from it in percent; "" for none. Throws Error(input)
// for no artifact, two of one torque, or a state or a published value that is missing; Error(io) if the file cannot be read.
Figure natural_frequency_table(std::vector<ImpactArtifact> impacts, const std::string& published);

// The same as lines for a terminal.
std::string natural_frequency_text(const Figure& table);

// Changes of the static answer by each refinement, as bars, in per cent; apart from them those by another
// choice of near field or contact.
Figure error_budget_figure(const ErrorBudgetArtifact& budget);

// Net mesh force over two mesh periods of lumped models, a panel for each of one or two mesh frequencies (Hz) at the stored
// speed nearest to it. Throws Error(input) for sweeps of elastic gears, of two torques, or another number of frequencies.
Figure mesh_force_figure(const std::vector<SweepArtifact>& sweeps,
                         const std::vector<double>& mesh_frequencies);

// Words as they stand, in a text in which gnuplot reads marks such as '_' (subscript).
std::string without_markup(const std::string& words);

// The TSV: '#' lines with title, notes, sources and columns, then the blocks, two empty lines between them.
std::string tsv(const Figure& figure, const std::vector<std::string>& sources);

}  // namespace whine
