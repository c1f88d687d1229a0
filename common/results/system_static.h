// A system of elastic gears at rest, over a mesh period; where teeth differ, over the hunting period.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "model/system_stages.h"
#include "results/remark.h"

namespace whine {

// What a body's rotation and hub, a mesh, a pair of teeth and a bearing do at each phase. Frame: that of the carriers, which
// do not turn in it.
struct SystemStaticResult {
  SystemStaticParameters
      settings;  // inertias and masses of the layout that the scene leaves out are those of the bodies
  std::vector<BodyParameters> drawing;  // [gear] of settings.body
  Eigen::VectorXd contact_ratio;        // (mesh) 1
  int hunting_periods = 1;            // mesh periods after which the same teeth meet, as far as teeth differ
  Eigen::VectorXd mesh_phase;         // (phase) 1, of the first mesh: 0 to the hunting periods
  MatrixRM rotation;                  // (phase, body) m: r theta in the body's own sense; 0 of held ones
  std::vector<MatrixRM> translation;  // [phase] (body, xy) m, of its hub
  MatrixRM transmission_error;        // (phase, mesh) m
  MatrixRM mesh_deflection;           // (phase, mesh) m: the same without what bearings give way
  MatrixRM mesh_force;                // (phase, mesh) N: torque on the driving body over its base radius
  MatrixRM load_share;                // (phase, mesh) 1: of the meshes of one [[mesh]]
  Eigen::VectorXi pair;               // -1 following, 0 reference, 1 preceding
  std::vector<MatrixRM> tooth_load;   // [phase] (mesh, pair) N
  std::vector<MatrixRM> contact_pressure;  // [phase] (mesh, pair) Pa; 0 where a tip edge touches
  std::vector<MatrixRM> bearing_force;  // [phase] (body, xy) N: what a body presses its bearing or pin with
  MatrixRM torque;  // (phase, body) N m in the body's own sense: drives, and what holds a body
  std::vector<MatrixRM> mesh_stiffness;  // [phase] (mesh, mesh) N m-1, see SystemStatics::mesh_stiffness()
  // Certificate of each solution: (phase) m, N and 1
  Eigen::VectorXd least_gap, least_force, torque_residual;
  // Of flanks with friction, else none: (mesh) 1; (phase, mesh) J that friction takes in a mesh period at the position; (body) 1: power
  // out over power in while the body is at rest, 0 of planets; of trains without a carrier all are that of the train
  Eigen::VectorXd friction_coefficient;
  MatrixRM friction_work;
  Eigen::VectorXd efficiency;
  MatrixRM transmission_error_harmonic;  // (harmonic, mesh) m; the first row is the mean
  MatrixRM
      transmission_error_order;  // (order, mesh) m: of the hunting frequency; empty where teeth are alike
  std::vector<Remark> remarks;   // of the drawings in mesh
};

// Of the gear that a body is; nullptr: of a carrier.
inline const BodyParameters* drawing_of(const SystemStaticResult& a, int body) {
  const std::string& gear = a.settings.gear[static_cast<size_t>(body)];
  for (size_t g = 0; g < a.settings.body.size() && g < a.drawing.size(); ++g)
    if (a.settings.body[g].first == gear) return &a.drawing[g];
  return nullptr;
}

// [body] nullptr: of a carrier.
inline std::vector<const GearDesign*> designs_of(const SystemStaticResult& a) {
  std::vector<const GearDesign*> out;
  out.reserve(a.settings.layout.bodies.size());
  for (size_t b = 0; b < a.settings.layout.bodies.size(); ++b) {
    const BodyParameters* drawing = drawing_of(a, static_cast<int>(b));
    out.push_back(drawing ? &drawing->design : nullptr);
  }
  return out;
}

}  // namespace whine
