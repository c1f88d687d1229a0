#include "io/artifacts.h"

#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_strips(Codec& c, LoadedResult& a) {
  const std::string at = "/strip/";
  c(a.strip_pair, at + "tooth_pair", "1", kPair, "strip", "number of the tooth pair of each strip");
  c(a.strip_roll, at + "roll_angle", "rad", kRoll, "strip gear",
    "roll angles of the strip's middle on both gears");
  c(a.strip_width, at + "width", "m", kSize, "strip", "width of the strips along the flank");
  c(a.strip_force, at + "force", "N", kForce, "strip", "normal force of the strips", "p of Eq. 18");
  c(a.strip_pressure, at + "pressure", "Pa", kPressure, "strip", "force over width and face width");
  c(a.strip_separation, at + "separation", "m", kLength, "strip",
    "gap of the loaded flanks, by the flank tables", "d of Eq. 18");
  c(a.strip_deflection, at + "deflection", "m", kLength, "strip gear",
    "how far the flank of each gear gives way, mean over the strip, by the whole field");
}

void describe_loaded_certificate(Codec& c, LoadedResult& a) {
  const std::string at = "/certificate/";
  c(a.hub_torque, at + "hub_torque", "N m", kMoment, "gear",
    "moment that holds the hub, by the elements about the bore");
  c(a.contact_torque, at + "contact_torque", "N m", kMoment, "gear",
    "moment of the strips' forces along the normals of the gear's own flanks");
  c(a.strain_energy, at + "strain_energy", "J", kEnergy, "gear",
    "strain energy, by quadrature of the stresses");
  c(a.contact_work, at + "contact_work", "J", kEnergy, "gear", "half of the sum of forces times deflections");
}

}  // namespace

void describe(Codec& c, LoadedResult& a) {
  describe_pair(c, a, false);
  describe_torque(c, a.torque);
  c(a.mesh_phase, "/parameters/operation/mesh_phase", "1", kPhase, "",
    "mesh phase; 0: reference pair at the pitch point, 1: one mesh period");
  c(a.transmission_error, "/transmission_error", "m", kLength, "",
    "transmission error along the line of action, positive when the driver is ahead",
    "r1 theta1 + r2 theta2");
  c(a.pair, "/tooth_pair", "1", kPair, "tooth_pair",
    "number of the tooth pairs that carry load: -1 following, 0 reference, +1 preceding");
  c(a.tooth_load, "/tooth_load", "N", kForce, "tooth_pair", "normal force of each tooth pair");
  c(a.tooth, "/tooth", "1", kTooth, "tooth_pair gear", "teeth of the pairs, counter-clockwise from tooth 0");
  c(a.root_stress, "/root_stress", "Pa", kStress, "tooth_pair gear",
    "largest principal stress at the nodes of the fillet below the loaded flank; static.h5 has the tangential stress, fitted along the root");
  describe_strips(c, a);
  describe_loaded_certificate(c, a);
  c.picture({a.vtk_point, a.vtk_cell, {}, {}, a.vtk_line, a.vtk_point_data, a.vtk_cell_data, true});
}

std::string title(const LoadedResult& a) {
  return "Loaded gears: " + pair_title(a.mesh, a.torque);
}

template struct ArtifactFile<LoadedResult>;

}  // namespace whine
