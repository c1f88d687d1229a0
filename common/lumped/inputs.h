// What a lumped model is made from: statics at its torque and at the reference torque, and the slice of a scene.
#pragma once
#include <string>

#include "lumped/sweep.h"

namespace whine {

struct LumpedInputs {
  StaticArtifact at_torque, at_reference;  // equal where the levels are not those of another torque
};

// Reads what is given; params and reference may be "". With params `options` takes the scene's samples, speeds and the mass of the
// gears' inertias; with_speeds: params must hold speeds. Throws Error(input) for teeth that differ, elastic bearings or a crack, for a reference that is not of the scene's first torque or not of the
// same pair.
LumpedInputs read_lumped_inputs(const std::string& statics, const std::string& reference,
                                const std::string& params, bool with_speeds, LumpedOptions& options);

// Which springs stand for the mesh.
struct SpringChoice {
  std::string model;    // "rectangular", "secant", "tangent", "pairs"
  bool stated = false;  // rectangular: with these levels (N m-1) and this share of the second
  double fewer = 0, more = 0, duty = 0;
  int cells = 0;       // in a mesh period; 0: a multiple of the static positions, 1024 or more
  bool hertz = false;  // pairs: polygons of Hertz's law
};

// numbers: of the tooth pairs that the springs stand for, filled.
LumpedParameters springs_of(const LumpedInputs& inputs, const SpringChoice& choice, Eigen::VectorXi& numbers);

}  // namespace whine
