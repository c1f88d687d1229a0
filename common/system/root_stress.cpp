#include "system/root_stress.h"

#include <algorithm>
#include <cmath>

namespace whine {

RootStresses::RootStresses(const GearMeshModel& model, std::vector<double> phases)
    : model_(model), phases_(std::move(phases)), known_(true) {
  for (size_t g = 0; g < kSides; ++g) {
    const BodyArtifact& body = model.gear[g].body();
    known_ = known_ && static_cast<int>(body.root_stress.size()) == 2 * body.offsets + 1 &&
             body.root_angle.size() > 2 && body.design.crack.depth == 0;
  }
}

const Eigen::MatrixXd& RootStresses::per_force(int g, size_t phase, int pair) {
  const auto [at, added] = per_force_[static_cast<size_t>(g)].try_emplace({phase, pair});
  if (!added) return at->second;
  const ElasticGear& gear = model_.gear[static_cast<size_t>(g)];
  const FlankTable& table = gear.table();
  const double roll =
      std::clamp(model_.kinematics.contact(phases_[phase] + pair).roll[static_cast<size_t>(g)],
                 table.lowest(), table.highest());
  const Eigen::VectorXd weights = table.weights(roll).transpose();
  const BodyArtifact& body = gear.body();
  at->second.resize(body.root_angle.size(), 2 * body.offsets + 1);
  for (int d = 0; d <= 2 * body.offsets; ++d)
    at->second.col(d) = body.root_stress[static_cast<size_t>(d)].topRows(body.root_angle.size()) * weights;
  return at->second;
}

std::vector<RootStress> RootStresses::of_teeth(int g, size_t phase, const Eigen::VectorXi& numbers,
                                               const Eigen::Ref<const Eigen::VectorXd>& load) {
  const BodyArtifact& body = model_.gear[static_cast<size_t>(g)].body();
  std::vector<RootStress> out;
  Eigen::VectorXd along(body.root_angle.size());
  for (const int of : numbers) {
    along.setZero();
    for (Eigen::Index k = 0; k < numbers.size(); ++k) {
      const int offset = GearMeshModel::tooth(g, of) - GearMeshModel::tooth(g, numbers[k]);
      if (load[k] > 0 && std::abs(offset) <= body.offsets)
        along += load[k] * per_force(g, phase, numbers[k]).col(offset + body.offsets);
    }
    Eigen::Index top = 0;
    RootStress stress{along.maxCoeff(&top), of, body.root_angle[top]};
    if (top > 0 && top + 1 < along.size()) {
      const double left = stress.stress - along[top - 1], right = stress.stress - along[top + 1];
      if (left + right > 0) {
        const double move = 0.5 * (left - right) / (left + right);
        stress.stress += (left - right) * (left - right) / (8 * (left + right));
        stress.angle +=
            move * (body.root_angle[top + (move > 0 ? 1 : -1)] - stress.angle) * (move > 0 ? 1 : -1);
      }
    }
    out.push_back(stress);
  }
  return out;
}

RootStress RootStresses::largest(int g, size_t phase, const Eigen::VectorXi& numbers,
                                 const Eigen::Ref<const Eigen::VectorXd>& load) {
  RootStress most;
  for (const RootStress& stress : of_teeth(g, phase, numbers, load))
    if (stress.stress > most.stress) most = stress;
  return most;
}

}  // namespace whine
