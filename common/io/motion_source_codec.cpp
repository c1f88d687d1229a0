#include "io/system_motion_codec.h"

#include "io/codec.h"
#include "io/keys.h"

namespace whine {

using namespace ranges;

void describe_source(Codec& c, MotionSource& a, bool time) {
  describe_layout(c, a.layout, {"/layout", ""});
  c(a.drive, "/layout/body/torque", "N m", kMoment, "body",
    "torque of the drive in the body's sense; 0 where none gives a torque");
  c.parameters("fidelity", keys(a.fidelity));
  c.parameters("damping", keys(a.damping));
  if (time) c.parameters("discretisation", keys(a.time));
  describe_names(c, a.mesh_names, a.body_names);
  if (c.lists() || a.of_train())
    c(a.axis_frequency, "/axis_frequency", "Hz", kFrequency, "",
      "highest natural frequency of the rigid train on its mean stiffnesses, to which the dampers of the axes refer");
  if (a.of_train()) return;
  describe_pair(c, a, false);
  for (size_t g = 0; g < kSides; ++g) c.parameters(kRole[g], inertia_key(a.inertia[g]));
  describe_torque(c, a.torque);
}

void describe_names(Codec& c, std::vector<std::string>& meshes, std::vector<std::string>& bodies) {
  c(meshes, "/mesh", "mesh", "meshes by the names of their bodies, driving-driven");
  c(bodies, "/body", "body", "bodies by name; of a pair the driver, then the driven gear");
}

void describe_face_load(Codec& c, MatrixRM& load_factor, MatrixRM& line_load) {
  if (!c.optional("/face_load_factor", load_factor.size() > 0)) return;
  c(load_factor, "/face_load_factor", "1", ranges::kPositive, "mesh_frequency mesh",
    "face load factor in motion: largest line load over its mean, ends of the line included, of the tooth pair and the instant of the largest tooth load; left out of one slice",
    "K_Hbeta = w_max / w_mean");
  c(line_load, "/line_load_max", "N m-1", ranges::kStiff, "mesh_frequency mesh",
    "largest line load of all instants within the inner 90 % of face and path of contact; left out of one slice");
}

}  // namespace whine
