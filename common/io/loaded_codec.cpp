#include "io/loaded_codec.h"

#include "io/codec.h"
#include "io/vtk.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kLoadedSchema{"loaded", 1};

void describe_strips(Codec& c, LoadedResult& a) {
  const std::string at = "/strip/";
  c.dataset({at + "pair", "1", "number of the tooth pair of each strip", "strip", kPair}, &a.strip_pair);
  c.dataset(
      {at + "roll_angle", "rad", "roll angles of the strip's middle on both gears", "strip gear", kRoll},
      &a.strip_roll);
  c.dataset({at + "width", "m", "width of the strips along the flank", "strip", kSize}, &a.strip_width);
  c.dataset({at + "force", "N", "normal force of the strips", "strip", kForce, "p of Eq. 18"},
            &a.strip_force);
  c.dataset({at + "pressure", "Pa", "force over width and face width", "strip", kPressure},
            &a.strip_pressure);
  c.dataset({at + "separation", "m", "gap of the loaded flanks, by the flank tables", "strip", kLength,
             "d of Eq. 18"},
            &a.strip_separation);
  c.dataset({at + "deflection", "m",
             "how far the flank of each gear gives way, mean over the strip, by the whole field",
             "strip gear", kLength},
            &a.strip_deflection);
}

void describe_loaded_certificate(Codec& c, LoadedResult& a) {
  const std::string at = "/certificate/";
  c.dataset({at + "hub_torque", "N m", "moment that holds the hub, by the elements about the bore", "gear",
             kMoment},
            &a.hub_torque);
  c.dataset({at + "contact_torque", "N m",
             "moment of the strips' forces along the normals of the gear's own flanks", "gear", kMoment},
            &a.contact_torque);
  c.dataset({at + "strain_energy", "J", "strain energy, by quadrature of the stresses", "gear", kEnergy},
            &a.strain_energy);
  c.dataset({at + "contact_work", "J", "half of the sum of forces times deflections", "gear", kEnergy},
            &a.contact_work);
}

}  // namespace

void describe(Codec& c, LoadedResult& a) {
  describe_pair(c, a, false);
  describe_torque(c, a.torque);
  c.dataset({"/parameters/operation/mesh_phase", "1",
             "mesh phase; 0: reference pair at the pitch point, 1: one mesh period", "", kPhase},
            &a.mesh_phase);
  c.dataset({"/transmission_error", "m",
             "transmission error along the line of action, positive when the driver is ahead", "", kLength,
             "r1 theta1 + r2 theta2"},
            &a.transmission_error);
  c.dataset(
      {"/pair", "1", "number of the tooth pairs that carry load: -1 following, 0 reference, +1 preceding",
       "pair", kPair},
      &a.pair);
  c.dataset({"/tooth_load", "N", "normal force of each tooth pair", "pair", kForce}, &a.tooth_load);
  c.dataset({"/tooth", "1", "teeth of the pairs, counter-clockwise from tooth 0", "pair gear", kTooth},
            &a.tooth);
  c.dataset(
      {"/root_stress", "Pa",
       "largest principal stress at the nodes of the fillet below the loaded flank; static.h5 has the tangential stress, fitted along the root",
       "pair gear", kStress},
      &a.root_stress);
  describe_strips(c, a);
  describe_loaded_certificate(c, a);
  if (c.out() && a.vtk_point.rows() > 0)
    put_vtk(c.out()->file(),
            {a.vtk_point, a.vtk_cell, {}, {}, a.vtk_line, a.vtk_point_data, a.vtk_cell_data, true});
}

void write(const std::string& path, const LoadedResult& a, const Provenance& provenance) {
  write_artifact(path, kLoadedSchema, "Loaded gears: " + pair_title(a.mesh, a.torque), a, provenance);
  link_for_paraview(path);
}

LoadedResult read_loaded(const std::string& path) {
  return read_artifact<LoadedResult>(path, kLoadedSchema);
}

}  // namespace whine
