// A system: gears, the meshes that join them, drives. Lists; nothing knows how many there are.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

// A flank of a tooth: the one that leads in counter-clockwise rotation, and its mirror image.
enum class FlankSide { leading, trailing };

// The gears of a scene together: bodies that turn, meshes that join two of them each, drives. Gears stand in the order of the
// flow of power, so that the first side of a mesh pushes the second one.
struct System {
  struct Body {
    std::string name;                // of its gear
    int teeth = 0;                   // which shift by one, in the sense of rotation, in a mesh period
    int sense = 1;                   // of its rotation: 1 counter-clockwise, -1 clockwise
    double angle = 0;                // rad, counter-clockwise from +y: of tooth 0 at phase 0
    std::array<double, 2> centre{};  // m
    Bearing bearing = {};
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
  };
  enum class DriveKind { torque, held };
  struct Drive {
    int body = 0;
    DriveKind kind = DriveKind::torque;
    double torque = 0;  // N m, in the sense of the body's rotation
  };
  std::vector<Body> bodies;
  std::vector<Mesh> meshes;
  std::vector<Drive> drives;  // a body without one is free of torque

  bool held(int body) const {
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::held) return true;
    return false;
  }
  double torque(int body) const {  // N m
    double sum = 0;
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::torque) sum += drive.torque;
    return sum;
  }
};

}  // namespace whine
