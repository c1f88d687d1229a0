// What a motion was computed from: two gears in mesh, or a train.
#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model/stages.h"
#include "model/system.h"

namespace whine {

// Drawings, mesh and contact discretisation are those of a pair; of a train they stay empty: its static.h5 has them.
struct MotionSource : MotionParameters {
  double torque = 0;          // N m on the driver of a pair
  System layout;              // with the inertias and masses that were used
  Eigen::VectorXd drive;      // (body) N m: torque of its drive; 0 where none gives a torque
  double axis_frequency = 0;  // Hz, of a train: see axis_frequency() of dynamics/system_coordinates.h
  // (mesh) "sun-planet1", names of the driving and the driven body; (body)
  std::vector<std::string> mesh_names, body_names;

  bool of_train() const { return layout.load == System::Load::drives; }
  Eigen::Index meshes() const { return static_cast<Eigen::Index>(layout.meshes.size()); }
  Eigen::Index bodies() const { return static_cast<Eigen::Index>(layout.bodies.size()); }
  // Name of the body on a side of a mesh; number: 2 mesh + side.
  const std::string& name_of_side(Eigen::Index number) const {
    const auto mesh = static_cast<size_t>(number / kSides), side = static_cast<size_t>(number % kSides);
    return body_names[static_cast<size_t>(layout.meshes[mesh].side[side].body)];
  }
  // " of sun-planet1"; of a pair, which has one mesh, nothing.
  std::string of_mesh(Eigen::Index m) const {
    return of_train() ? " of " + mesh_names[static_cast<size_t>(m)] : "";
  }
  // Layout, drive and names of a pair, by its pair_system().
  void place_pair(System pair) {
    layout = std::move(pair);
    drive = Eigen::Vector2d(torque, 0);
    name_parts();
  }
  void name_parts() {
    mesh_names = mesh_names_of(layout);
    body_names = body_names_of(layout);
  }
};

}  // namespace whine
