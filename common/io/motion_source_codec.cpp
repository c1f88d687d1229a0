#include "io/system_motion_codec.h"

#include "io/codec.h"
#include "io/keys.h"

namespace whine {

using namespace ranges;

void describe_system(Codec& c, SystemSweepParameters& s, Eigen::VectorXd& torque, const LayoutPlace& place) {
  describe_layout(c, s.layout, place);
  c(torque, place.group + "/body/torque", "N m", kMoment, "body" + place.axis_end,
    "torque of the drive in the body's sense; 0 where none gives a torque");
  c.parameters("fidelity", keys(s.fidelity));
  c.parameters("damping", keys(s.damping));
}

void describe_source(Codec& c, MotionSource& a, bool time) {
  if (c.optional("/layout/body/name", a.of_train())) {
    describe_system(c, a.train, a.drive, {"/layout", ""});
    c(a.axis_frequency, "/axis_frequency", "Hz", kFrequency, "",
      "highest natural frequency of the rigid train on its mean stiffnesses, to which the dampers of the axes refer");
    if (time) c.parameters("discretisation", keys(a.train.time));
  }
  if (a.of_train()) return;
  describe_pair(c, a);
  describe_motion(c, a, time);
  describe_torque(c, a.torque);
}

void describe_names(Codec& c, bool of_train, std::vector<std::string>& meshes,
                    std::vector<std::string>& bodies) {
  if (!of_train && !c.lists()) {
    c.axis("mesh", 1);
    c.axis("body", kSides);
  }
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
