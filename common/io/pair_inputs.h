// What the programs of a pair read in the same way: the bodies of its gears, its results at rest, and what its sweeps say.
#pragma once
#include <array>
#include <string>

#include "io/named_files.h"
#include "results/branch.h"
#include "results/impact.h"
#include "results/reduced_body.h"
#include "results/response.h"
#include "results/static.h"
#include "results/sweep.h"

namespace whine {

using PairBodies = std::array<ReducedBody, kSides>;  // driver, driven

// Bodies of the gears of stage parameters. Throws Error(input), with the make target, for a body of other ones; errors of
// NamedFiles::of.
PairBodies read_bodies(const NamedFiles& files, const StaticParameters& settings);

// Two gears at rest that are a pair, or one mesh of a train, whose teeth are alike and whose bearings are rigid.
struct MeshInputs {
  StaticParameters settings;
  PairBodies body;
  double torque = 0;  // N m on the driver: what the mesh of a train carries, 0 of a pair
};

// mesh: its name in a train, "sun-planet1". Throws Error(usage) for one that is not there, of a pair for any, Error(input) for trains that
// Harris maps do not take, and errors of read_bodies().
MeshInputs read_mesh_inputs(const std::string& params, const std::string& mesh, const NamedFiles& files);

// Of a pair in motion.
struct PairInputs {
  PairBodies body;
  StaticResult at_torque,
      at_reference;  // the second is of the torque whose mean stiffness sets the bearing dampers
};

// Inertias of `settings` that the scene leaves to the drawing become those of the bodies. Throws Error(input), with the make
// target, unless both results at rest were made from these bodies with the contact and at the reference torque of `settings`.
PairInputs read_pair_inputs(const NamedFiles& files, const std::string& statics, const std::string& reference,
                            SweepParameters& settings);

// Throw Error(input) for files of a train.
StaticResult read_pair_statics(const std::string& path);
ResponseResult read_pair_response(const std::string& path);
SweepResult read_pair_sweep(const std::string& path);
ImpactResult read_pair_impact(const std::string& path);
BranchResult read_pair_branch(const std::string& path);

}  // namespace whine
