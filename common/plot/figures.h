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

namespace whine {

struct FigureBlock {
  std::string name;                       // gnuplot finds it by `index "[name]"`
  std::vector<std::string> columns;       // with their unit: "mesh_frequency [Hz]"
  std::vector<std::vector<double>> rows;  // an empty row lifts the pen
};

struct Figure {
  std::string title;
  std::vector<std::string> notes;  // one line each: operating point, choices, rung
  std::vector<FigureBlock> blocks;
  std::vector<std::pair<std::string, double>> numbers;     // variables of the template
  std::vector<std::pair<std::string, std::string>> words;  // string variables of the template
};

// The whole pair and a close-up of the teeth in mesh, edges of elements in mm. Driver's centre at the origin,
// driven gear's above it at the centre distance, both unloaded and turned to mesh phase 0: the reference pair
// touches at the pitch point. Throws Error(input) if the meshes are not those of the static artifact's gears.
Figure mesh_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& pair);

// RMS of the oscillating DTE against mesh frequency for both directions of the sweep, with jumps. Inputs in
// either order. Throws Error(input) unless one is an up sweep, the other a down sweep, both of the same
// torque and choices.
Figure response_figure(const ResponseArtifact& one, const ResponseArtifact& other);

// Static transmission error over a mesh period and its spectrum, one curve per torque (ascending). Throws
// Error(input) for no input or two of the same torque.
Figure transmission_error_figure(std::vector<StaticArtifact> statics);

// Mesh stiffness k = (T / r_b1) / transmission error over a mesh period and its spectrum, with the
// rectangular wave.
Figure mesh_stiffness_figure(std::vector<StaticArtifact> statics);

// Changes of the static answer by each refinement, as bars, in per cent; apart from them those by another
// choice of near field or contact.
Figure error_budget_figure(const ErrorBudgetArtifact& budget);

// RMS of the oscillating DTE and its mean against mesh frequency, both directions at each torque (ascending), with jumps.
// Throws Error(input) unless every torque has one sweep up and one down, all of one lumped model.
Figure lumped_response_figure(std::vector<ResponseArtifact> responses);

// Net mesh force over two mesh periods of lumped models, at the stored speeds nearest to those at which P2000 shows the
// upper and the lower branch. Throws Error(input) for sweeps of elastic gears, or of two torques.
Figure mesh_force_figure(const std::vector<SweepArtifact>& sweeps);

// The TSV: '#' lines with title, notes, sources and columns, then the blocks, two empty lines between them.
std::string tsv(const Figure& figure, const std::vector<std::string>& sources);

}  // namespace whine
