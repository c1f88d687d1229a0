#include "system/root_stress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace whine {

RootStress largest_along(const Eigen::Ref<const Eigen::VectorXd>& stress, const Eigen::VectorXd& angle,
                         int of) {
  Eigen::Index top = 0;
  RootStress out{stress.maxCoeff(&top), of, angle[top]};
  if (top == 0 || top + 1 == stress.size()) return out;
  const double left = out.stress - stress[top - 1], right = out.stress - stress[top + 1];
  if (left + right > 0) {
    const double move = 0.5 * (left - right) / (left + right);  // points, towards the larger neighbour
    out.stress += (left - right) * (left - right) / (8 * (left + right));
    out.angle += std::abs(move) * (angle[top + (move > 0 ? 1 : -1)] - out.angle);
  }
  return out;
}

RootStresses::RootStresses(const GearMeshModel& model, std::vector<double> phases)
    : model_(model), phases_(std::move(phases)), known_(true) {
  for (size_t g = 0; g < kSides; ++g) {
    per_force_[g].resize(phases_.size());
    const ReducedBody& body = model.gear[g].body();
    known_ = known_ && static_cast<int>(body.root_stress.size()) == 2 * body.offsets + 1 &&
             body.root_angle.size() > 2 &&
             (body.crack_root_stress.size() > 0 || !model.cracked(static_cast<int>(g)));
  }
}

const RootStresses::PerForce& RootStresses::per_force(int g, size_t phase, int pair) {
  std::vector<PerForce>& known = per_force_[static_cast<size_t>(g)][phase];
  for (const PerForce& at : known)
    if (at.pair == pair) return at;
  const ElasticGear& gear = model_.gear[static_cast<size_t>(g)];
  const FlankTable& flank = gear.table();
  const double roll =
      std::clamp(model_.kinematics.contact(phases_[phase] + pair).roll[static_cast<size_t>(g)],
                 flank.lowest(), flank.highest());
  const ReducedBody& body = gear.body();
  PerForce at{pair, flank.weights(roll).transpose(),
              Eigen::MatrixXd(body.root_angle.size(), 2 * body.offsets + 1)};
  for (int d = 0; d <= 2 * body.offsets; ++d)
    at.table.col(d) = gear.concentration() *
                      (body.root_stress[static_cast<size_t>(d)].topRows(body.root_angle.size()) * at.weights);
  known.push_back(std::move(at));
  return known.back();
}

RootStress RootStresses::of_tooth(int g, size_t phase, int of, const Eigen::VectorXi& numbers,
                                  const Eigen::Ref<const Eigen::VectorXd>& load, int period) {
  const ElasticGear& gear = model_.gear[static_cast<size_t>(g)];
  const ReducedBody& body = gear.body();
  const auto tooth = [&](int pair) { return GearMeshModel::tooth(g, pair); };
  along_.setZero(body.root_angle.size());
  for (Eigen::Index k = 0; k < numbers.size(); ++k) {
    if (!(load[k] > 0)) continue;
    const int offset = tooth(of) - tooth(numbers[k]);
    if (std::abs(offset) > body.offsets) continue;
    const PerForce& at = per_force(g, phase, numbers[k]);
    along_ += load[k] * at.table.col(offset + body.offsets);
    if (!model_.cracked(g)) continue;
    const Eigen::MatrixXd crack = gear.crack_root_stress(model_.tooth_at_crack(g, of - period),
                                                         model_.tooth_at_crack(g, numbers[k] - period));
    if (crack.size() > 0) along_ += load[k] * (crack * at.weights);
  }
  return largest_along(along_, body.root_angle, of);
}

RootStress RootStresses::largest(int g, size_t phase, const Eigen::VectorXi& numbers,
                                 const Eigen::Ref<const Eigen::VectorXd>& load, int period) {
  RootStress most;
  for (Eigen::Index k = 0; k < numbers.size(); ++k) {
    if (!(load[k] > 0)) continue;
    const RootStress stress = of_tooth(g, phase, numbers[k], numbers, load, period);
    if (stress.stress > most.stress) most = stress;
  }
  return most;
}

}  // namespace whine
