#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/system_motion_codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr const char* kPointMesh = "point mesh";
constexpr const char* kPointBody = "point body";
constexpr const char* kPointMeshSide = "point mesh side";

void describe_points(Codec& c, BranchResult& a) {
  c(a.mesh_frequency, "/mesh_frequency", "Hz", kSpeed, "point", "mesh frequency along the branch");
  c(a.dte_rms, "/dte_rms", "m", kSize, kPointMesh,
    "RMS of the oscillating part of the dynamic transmission error");
  c(a.dte_mean, "/dte_mean", "m", kLength, kPointMesh, "mean of the dynamic transmission error");
  c(a.dte_harmonic, "/dte_harmonic", "m", kSize, "point harmonic mesh",
    "amplitude of the harmonics 1, 2, ... of the mesh frequency");
  c.numbers("harmonic", 1, "number of the harmonic of the mesh frequency");
  c(a.mesh_force_max, "/mesh_force_max", "N", kForce, kPointMesh,
    "largest normal force of all tooth pairs together; of trains largest torque on the driving body over its base radius");
  c(a.tooth_load_max, "/tooth_load_max", "N", kLoad, kPointMesh, "largest normal force of one tooth pair");
  c(a.mesh_force_sustained, "/mesh_force_sustained", "N", kLoad, kPointMesh,
    "largest normal force of all tooth pairs together that is sustained for 1/64 of a mesh period");
  c(a.tooth_load_sustained, "/tooth_load_sustained", "N", kLoad, kPointMesh, "the same of one tooth pair");
  c(a.separation_fraction, "/separation_fraction", "1", kShare, kPointMesh,
    "share of the time steps without force");
  if (c.optional("/bearing_force_rms", a.bearing_force_rms.size() > 0))
    c(a.bearing_force_rms, "/bearing_force_rms", "N", kLoad, kPointBody,
      "RMS of the oscillating part of the force of the body on its bearing, pin or axis, x and y together; 0 of a gear of a pair whose bearing is rigid");
  if (!c.optional("/root_stress_sustained", a.root_stress_sustained.size() > 0)) return;
  c(a.root_stress_sustained, "/root_stress_sustained", "Pa", kStress, kPointMeshSide,
    "largest tangential stress along the roots beside the loaded flanks that is sustained for 1/64 of a mesh period, quasi-static in the tooth loads; 0 of a mesh of which it is not known");
  c(a.root_stress_angle, "/root_stress_angle", "1", kRoll, kPointMeshSide,
    "angle (rad) of the root's tangent there against the centre line of the tooth");
  c(a.root_stress_phase, "/root_stress_phase", "1", kPlace, kPointMeshSide,
    "mesh phase of the tooth's pair then, 0 at the pitch point");
}

void describe_stability(Codec& c, BranchResult& a) {
  c(a.floquet_multiplier, "/floquet_multiplier", "1", kMultiplier, "point multiplier part",
    "multipliers over the orbit, largest modulus first: real and imaginary part");
  c(a.stable, "/stable", "1", kFlag, "point", "1: all multipliers lie inside the unit circle");
  c(a.steps, "/steps", "1", kNumber, "point", "time steps per mesh period");
  c(a.period_multiple, "/period_multiple", "1", kNumber, "point",
    "mesh periods after which the orbit repeats");
  c(a.part, "/branch", "1", kNumber, "point",
    "number of the part: its points follow each other along the arc; parts begin at one orbit or beside a period doubling");
  c(a.residual, "/residual", "1", {0, 1e300}, "point", "relative change of the state over the orbit");
  c(a.segment_mismatch, "/segment_mismatch", "1", kPositive, "segment",
    "relative change of the orbit where the number of steps changes");
}

// Where the branch turns, orbits lose their stability and contacts begin to come or go.
void describe_folds(Codec& c, BranchResult& a) {
  c(a.fold_frequency, "/fold_frequency", "Hz", kFrequency, "fold",
    "mesh frequency at which the branch turns");
  c(a.fold_width, "/fold_width", "Hz", kFrequency, "fold",
    "of the interval in which it lies; at a kink that in which a smooth map would have it");
  c(a.fold_rms, "/fold_rms", "m", kSize, "fold mesh", "RMS of the oscillating transmission error there");
  c(a.fold_smooth, "/fold_smooth", "1", kFlag, "fold",
    "1: a multiplier is 1 there; 0: at a kink, where contacts of a step change");
  c(a.fold_multiplier, "/fold_multiplier", "1", kMultiplier, "fold side",
    "real multiplier nearest to 1, before and after the fold");
  c(a.flip_frequency, "/flip_frequency", "Hz", kFrequency, "flip",
    "mesh frequency at which a multiplier passes -1");
  c(a.flip_width, "/flip_width", "Hz", kFrequency, "flip", "as fold_width");
  c(a.torus_frequency, "/torus_frequency", "Hz", kFrequency, "torus",
    "mesh frequency at which the modulus of a complex pair of multipliers passes 1");
  c(a.torus_width, "/torus_width", "Hz", kFrequency, "torus", "as fold_width");
  c(a.grazing_frequency, "/grazing_frequency", "Hz", kFrequency, "grazing",
    "mesh frequency at which the sequence of contacts changes");
  c(a.grazing_phase, "/grazing_phase", "1", kShare, "grazing",
    "mesh phase of the contact that comes or goes");
  c(a.grazing_mesh, "/grazing_mesh", "1", kNumber, "grazing", "place of its mesh on the axis mesh, from 0");
  c(a.grazing_pair, "/grazing_pair", "1", kPair, "grazing", "its tooth pair");
  c(a.grazing_closes, "/grazing_closes", "1", kFlag, "grazing", "1: it closes, 0: it opens");
}

}  // namespace

void describe(Codec& c, BranchResult& a) {
  describe_source(c, a);
  describe_points(c, a);
  describe_stability(c, a);
  describe_folds(c, a);
  c(a.end, "/end", "", "why the branch was followed no further");
}

std::string title(const BranchResult& a) {
  if (a.of_train())
    return text("Branch of periodic orbits of a system: ", a.body_names.size(), " bodies, ",
                a.mesh_names.size(), " meshes");
  return "Branch of periodic orbits: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<BranchResult>;

}  // namespace whine
