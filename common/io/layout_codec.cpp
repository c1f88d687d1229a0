#include "io/layout_codec.h"

#include <algorithm>
#include <type_traits>

#include "base/error.h"
#include "io/codec.h"
#include "io/keys.h"
#include "io/variant.h"
#include "system/rigid_system.h"

namespace whine {
namespace {

using namespace ranges;

// A number of each item of a list as one dataset; `member` gives a reference to it.
template <class Item, class Member>
void column(Codec& c, const Dataset& d, std::vector<Item>& items, const Member& member) {
  using Value = std::remove_reference_t<decltype(member(items.front()))>;
  Eigen::Matrix<std::conditional_t<std::is_same_v<Value, double>, double, int>, Eigen::Dynamic, 1> values(
      static_cast<Eigen::Index>(items.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = member(items[static_cast<size_t>(i)]);
  c.dataset(d, &values);
  if (!c.in()) return;
  items.resize(static_cast<size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    member(items[static_cast<size_t>(i)]) = static_cast<Value>(values[i]);
}

// The rotation of a body that a drive holds.
struct Hold {
  int held = 0;
  double stiffness = 0;
};

void describe_bodies(Codec& c, System& s) {
  using Body = System::Body;
  const Range count{-1, 10000}, mass{0, kKilograms};
  const auto number = [&](const char* name, const char* units, const char* meaning, const Range& range,
                          const auto& member) {
    column(c, {std::string("/body/") + name, units, meaning, "body_number", range}, s.bodies, member);
  };
  std::vector<std::string> names;
  std::vector<int> carrier;
  for (const Body& body : s.bodies) {
    names.push_back(body.name);
    carrier.push_back(body.kind == System::BodyKind::carrier);
  }
  c.dataset({"/body/name", "1", "name of the body", "body_number"}, &names);
  column(c, {"/body/is_carrier", "1", "1: a carrier, 0: a gear", "body_number", kFlag}, carrier,
         [](int& own) -> int& { return own; });
  number("teeth", "1", "number of teeth, 0 of a carrier", kTooth, [](Body& b) -> int& { return b.teeth; });
  for (size_t b = 0; c.in() && b < s.bodies.size(); ++b) {
    s.bodies[b].name = names[b];
    s.bodies[b].kind = carrier[b] ? System::BodyKind::carrier : System::BodyKind::gear;
  }
  number("sense", "1", "sense of rotation: 1 counter-clockwise, -1 clockwise", {-1, 1},
         [](Body& b) -> int& { return b.sense; });
  number("stands_on", "1", "number of the carrier that carries the axis, -1: the ground", count,
         [](Body& b) -> int& { return b.on; });
  MatrixRM centre(static_cast<Eigen::Index>(s.bodies.size()), 2);
  for (size_t b = 0; b < s.bodies.size(); ++b)
    centre.row(static_cast<Eigen::Index>(b)) << s.bodies[b].centre[0], s.bodies[b].centre[1];
  c.dataset({"/body/centre", "m", "place of the axis", "body_number xy", kPlace}, &centre);
  for (size_t b = 0; c.in() && b < s.bodies.size(); ++b)
    s.bodies[b].centre = {centre(static_cast<Eigen::Index>(b), 0), centre(static_cast<Eigen::Index>(b), 1)};
  number("angle", "rad", "angle of tooth 0 from +y at mesh phase 0, counter-clockwise", kSigned,
         [](Body& b) -> double& { return b.angle; });
  number("radius", "m", "base radius; of a carrier that of the pins", kRadius,
         [](Body& b) -> double& { return b.radius; });
  number("inertia", "kg m2", "inertia about the axis", mass, [](Body& b) -> double& { return b.inertia; });
  number("mass", "kg", "mass of what moves with the hub; 0: rigid bearing", mass,
         [](Body& b) -> double& { return b.bearing.mass; });
  number("bearing_stiffness", "N m-1", "radial stiffness of the bearing; 0: rigid", kStiff,
         [](Body& b) -> double& { return b.bearing.stiffness; });
  number("bearing_damping", "N s m-1", "radial damping of the bearing", {0, kStiffnesses},
         [](Body& b) -> double& { return b.bearing.damping; });
}

void describe_holds(Codec& c, System& s) {
  std::vector<Hold> holds(s.bodies.size());
  for (const System::Drive& drive : s.drives)
    if (drive.kind == System::DriveKind::held) holds[static_cast<size_t>(drive.body)] = {1, drive.stiffness};
  column(c, {"/body/held", "1", "1: a drive holds the rotation", "body_number", kFlag}, holds,
         [](Hold& hold) -> int& { return hold.held; });
  column(c,
         {"/body/hold_stiffness", "N m-1", "stiffness of what holds it, at the radius; 0: rigid",
          "body_number", kStiff},
         holds, [](Hold& hold) -> double& { return hold.stiffness; });
  for (size_t b = 0; c.in() && b < holds.size(); ++b)
    if (holds[b].held)
      s.drives.push_back({static_cast<int>(b), System::DriveKind::held, 0, holds[b].stiffness});
}

void describe_meshes(Codec& c, System& s) {
  using Mesh = System::Mesh;
  const auto number = [&](const char* name, const char* units, const char* meaning, const Range& range,
                          const auto& member) {
    column(c, {std::string("/mesh/") + name, units, meaning, "mesh_number", range}, s.meshes, member);
  };
  MatrixRMi side(static_cast<Eigen::Index>(s.meshes.size()), 2);
  for (size_t m = 0; m < s.meshes.size(); ++m)
    side.row(static_cast<Eigen::Index>(m)) << s.meshes[m].side[0].body, s.meshes[m].side[1].body;
  c.dataset({"/mesh/body_number",
             "1",
             "numbers of the driving and the driven body",
             "mesh_number gear",
             {0, 10000}},
            &side);
  number("ring_drives", "1", "1: the driving gear is internal", kFlag,
         [](Mesh& m) -> bool& { return m.ring_drives; });
  number("centre_distance", "m", "distance of the axes", kSize,
         [](Mesh& m) -> double& { return m.centre_distance; });
  number("direction", "rad", "from the driving body's axis to the pitch point, counter-clockwise from +x",
         kSigned, [](Mesh& m) -> double& { return m.direction; });
  number("phase", "1", "mesh periods that it is ahead of the first mesh", kShare,
         [](Mesh& m) -> double& { return m.phase; });
  number("pressure_angle", "rad", "working pressure angle", {0, 1.5},
         [](Mesh& m) -> double& { return m.pressure_angle; });
  number("stiffness", "N m-1", "mean stiffness along the line of action", kStiff,
         [](Mesh& m) -> double& { return m.stiffness; });
  if (!c.in()) return;
  require_indices(c, "/mesh/body_number", side, static_cast<Eigen::Index>(s.bodies.size()));
  for (size_t m = 0; m < s.meshes.size(); ++m)
    for (size_t k = 0; k < 2; ++k) {
      System::Side& own = s.meshes[m].side[k];
      own.body = side(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(k));
      own.sense = s.bodies[static_cast<size_t>(own.body)].sense;
    }
}

// What figures and the views of modes divide by, and what they look up.
void require_gears(const Codec& c, const System& s) {
  const auto reject = [&](const auto&... words) { c.in()->reject(text(words...)); };
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    const bool gear = body.kind == System::BodyKind::gear;
    if (!plain_name(body.name))
      reject("dataset /body/name holds '", body.name, "'; a name holds letters, digits, '_' and '-' only");
    if (body.sense == 0) reject("dataset /body/sense holds 0 of body ", b, "; allowed are -1 and 1");
    if (gear && body.teeth == 0) reject("dataset /body/teeth holds 0 of body ", b, ", which is a gear");
    if (!has_place(s, body))
      reject("dataset /body/stands_on holds ", body.on, " of body ", b,
             "; allowed are -1, the ground, and the number of a carrier on the ground");
  }
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const auto& [first, second] = s.meshes[m].side;
    for (const System::Side& side : {first, second})
      if (s.bodies[static_cast<size_t>(side.body)].kind == System::BodyKind::carrier ||
          first.body == second.body)
        reject("dataset /mesh/body_number holds ", first.body, ", ", second.body, " of mesh ", m,
               "; allowed are two gears that differ");
  }
}

}  // namespace

void describe_layout(Codec& c, System& layout) {
  if (c.in()) layout = {};
  describe_bodies(c, layout);
  describe_holds(c, layout);
  describe_meshes(c, layout);
  if (!c.in()) return;
  require_gears(c, layout);
}

void describe_errors(Codec& c, SystemStaticParameters& s) {
  if (c.in()) s.errors.resize(s.layout.bodies.size());
  bool differ = false;
  for (size_t b = 0; !c.lists() && b < s.layout.bodies.size(); ++b) {
    const std::string section = "error_" + s.layout.bodies[b].name;
    if (!c.optional("/parameters/" + section + "/iso_class", s.has_errors(b))) continue;
    differ = true;
    ToothErrors errors = b < s.errors.size() ? s.errors[b] : ToothErrors{};
    c.parameters(section, keys(errors));
    if (c.in()) s.errors[b] = errors;
  }
  if (!differ && !c.lists()) return;
  MatrixRMi tooth(static_cast<Eigen::Index>(s.layout.meshes.size()), 2);
  for (Eigen::Index m = 0; m < tooth.rows(); ++m)
    for (Eigen::Index side = 0; side < 2; ++side)
      tooth(m, side) = s.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(side)].first_tooth;
  c.dataset(
      {"/mesh/first_tooth",
       "1",
       "where teeth differ: tooth of each side in the reference pair of mesh period 0, counter-clockwise; in mesh period k pair p is that of first_tooth + sense (p - k)",
       "mesh_number side",
       {-(1 << 20), 1 << 20}},
      &tooth);
  if (!c.in()) return;
  for (Eigen::Index m = 0;
       m < std::min<Eigen::Index>(tooth.rows(), static_cast<Eigen::Index>(s.layout.meshes.size())); ++m)
    for (Eigen::Index side = 0; side < 2; ++side)
      s.layout.meshes[static_cast<size_t>(m)].side[static_cast<size_t>(side)].first_tooth = tooth(m, side);
}

}  // namespace whine
