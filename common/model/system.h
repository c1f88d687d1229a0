// A system: gears and carriers, the meshes and bearings that join them, drives. Lists; nothing knows how many there are.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "model/gear.h"

namespace whine {

// A flank of a tooth: the one that leads in counter-clockwise rotation, and its mirror image.
enum class FlankSide { leading, trailing };

// The gears of a scene together: bodies that turn, meshes that join two of them each, drives. Gears are in the order of the
// flow of power, so that the first side of a mesh pushes the second one. A planetary train is described in the frame of its
// carrier, in which the axes of the planets are fixed.
struct System {
  static constexpr int kGround = -1;
  enum class BodyKind { gear, carrier };
  struct Body {
    std::string name;                // of its gear
    int teeth = 0;                   // which shift by one, in the sense of rotation, in a mesh period
    int sense = 1;                   // of its rotation: 1 counter-clockwise, -1 clockwise
    double angle = 0;                // rad, counter-clockwise from +y: of tooth 0 at phase 0
    std::array<double, 2> centre{};  // m
    Bearing bearing = {};            // on the ground or, of a planet, on its carrier
    BodyKind kind = BodyKind::gear;
    int on = kGround;                // carrier of its axis
    double radius = 0;               // m: base circle of a gear, circle of the pins of a carrier
    double inertia = 0;              // kg m2; of rigid bodies only
    std::array<double, 2> offset{};  // m: error of position, by which its axis stands beside `centre`
  };
  struct Side {
    int body = 0;
    FlankSide flank = FlankSide::leading;
    int sense = 1;  // of its body's rotation
    int first_tooth =
        0;  // of the reference pair, in the mesh period that begins with that pair at the pitch point

    // Number of the tooth, counter-clockwise, that works in a pair; pairs count in the sense of motion.
    int tooth(int pair) const { return first_tooth + sense * pair; }
  };
  struct Mesh {
    std::array<Side, 2> side;
    double centre_distance = 0;  // m
    double direction = 0;  // rad, counter-clockwise from +x: from the first side's centre to the pitch point
    double phase = 0;      // 0 to 1, mesh periods: what this mesh is ahead of the first one
    double pressure_angle = 0;  // rad, working
    bool ring_drives = false;   // the first side is an internal gear
    double stiffness = 0;       // N m-1 along the line of action, mean; of rigid bodies only
  };
  enum class DriveKind { torque, held, free };
  struct Drive {
    int body = 0;
    DriveKind kind = DriveKind::torque;
    double torque = 0;  // N m, in the sense of the body's rotation
    double stiffness =
        0;  // N m-1 at the body's radius: what holds a rotation; 0: rigid. Of rigid bodies only
  };
  std::vector<Body> bodies;
  std::vector<Mesh> meshes;
  std::vector<Drive> drives;  // a body without one is free of torque, as one of kind free is
  // What loads the gears: a torque on the driver of a pair, given to the program, while the driven gear is held; or the drives.
  enum class Load { torque, drives };
  Load load = Load::torque;

  bool held(int body) const {
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::held) return true;
    return false;
  }
  bool held_rigidly(int body) const {
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::held && drive.stiffness == 0) return true;
    return false;
  }
  double torque(int body) const {  // N m
    double sum = 0;
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::torque) sum += drive.torque;
    return sum;
  }
};

// "sun-planet1": a mesh by its bodies.
inline std::string mesh_name(const System& system, size_t m) {
  const auto& side = system.meshes[m].side;
  return system.bodies[static_cast<size_t>(side[0].body)].name + "-" +
         system.bodies[static_cast<size_t>(side[1].body)].name;
}

inline std::vector<std::string> mesh_names_of(const System& system) {
  std::vector<std::string> out;
  out.reserve(system.meshes.size());
  for (size_t m = 0; m < system.meshes.size(); ++m) out.push_back(mesh_name(system, m));
  return out;
}
inline std::vector<std::string> body_names_of(const System& system) {
  std::vector<std::string> out;
  out.reserve(system.bodies.size());
  for (const System::Body& body : system.bodies) out.push_back(body.name);
  return out;
}

template <>
inline constexpr const char* kWordsOf<System::DriveKind> = "torque held free";

}  // namespace whine
