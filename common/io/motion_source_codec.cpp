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

}  // namespace whine
