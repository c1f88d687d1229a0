// What a motion was computed from: two gears in mesh, or a train.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/stages.h"
#include "model/system_stages.h"

namespace whine {

struct MotionSource : MotionParameters {
  double torque = 0;  // N m on the driver of a pair
  // Of a train its layout, damping, model levels and steps, with the inertias and masses that were used, in place of what
  // MotionParameters say of a pair; of a pair no bodies.
  SystemSweepParameters train;
  Eigen::VectorXd drive;      // (body) N m, of a train: torque of its drive; 0 where none gives a torque
  double axis_frequency = 0;  // Hz, of a train: see axis_frequency() of dynamics/system_coordinates.h
  // (mesh) "sun-planet1", names of the driving and the driven body; (body), of a pair driver and driven gear
  std::vector<std::string> mesh_names, body_names;

  bool of_train() const { return !train.layout.bodies.empty(); }
  const Damping& damping_used() const { return of_train() ? train.damping : damping; }
  const Fidelity& fidelity_used() const { return of_train() ? train.fidelity : fidelity; }
  int steps_per_period() const { return of_train() ? train.time.steps_per_period : time.steps_per_period; }
  Eigen::Index meshes() const {
    return of_train() ? static_cast<Eigen::Index>(train.layout.meshes.size()) : 1;
  }
  Eigen::Index bodies() const {
    return of_train() ? static_cast<Eigen::Index>(train.layout.bodies.size()) : kSides;
  }
  // Name of the body on a side of a mesh; number: 2 mesh + side.
  const std::string& name_of_side(Eigen::Index number) const {
    const auto mesh = static_cast<size_t>(number / kSides), side = static_cast<size_t>(number % kSides);
    return body_names[of_train() ? static_cast<size_t>(train.layout.meshes[mesh].side[side].body) : side];
  }
  void name_parts() {
    mesh_names.clear();
    body_names.clear();
    for (size_t m = 0; m < train.layout.meshes.size(); ++m) mesh_names.push_back(mesh_name(train.layout, m));
    for (const System::Body& body : train.layout.bodies) body_names.push_back(body.name);
    if (of_train()) return;
    mesh_names = {mesh.gear[0] + "-" + mesh.gear[1]};
    body_names = {mesh.gear[0], mesh.gear[1]};
  }
};

}  // namespace whine
