#include "dynamics/turning_frame.h"

#include <Eigen/LU>
#include <algorithm>

#include "gear/layout.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

TurningFrame::TurningFrame(const System& layout, const SystemCoordinates& coordinates, double omega) {
  if (omega == 0) return;
  omega_ = omega;
  const auto bodies = static_cast<int>(layout.bodies.size());
  std::vector<int> row(static_cast<size_t>(bodies), -1);
  for (int b = 0; b < bodies; ++b) {
    const SystemCoordinates::Share& own = coordinates.body[static_cast<size_t>(b)];
    if (own.swaying == 0 && own.group < 0) continue;
    row[static_cast<size_t>(b)] = static_cast<int>(body_.size());
    body_.insert(body_.end(), 2, b);
  }
  std::vector<int> turning(coordinates.group.size(), -1);
  for (size_t g = 0; g < turning.size(); ++g) {
    turning[g] = static_cast<int>(body_.size());
    body_.push_back(coordinates.group[g].carrier);
  }
  const auto n = static_cast<Index>(body_.size());
  constant_.setZero(n);
  carried_.setZero(n);
  carrier_.assign(body_.size(), -1);
  for (MatrixXd* x : {&centrifugal_, &dragging_, &coriolis_, &half_turn_, &closing_}) x->setZero(n, n);
  std::vector<Block> blocks;
  for (int b = 0; b < bodies; ++b)
    if (row[static_cast<size_t>(b)] >= 0) take(layout, coordinates, b, row[static_cast<size_t>(b)], blocks);
  for (size_t g = 0; g < turning.size(); ++g) {
    const SystemCoordinates::Group& group = coordinates.group[g];
    const double radius = layout.bodies[static_cast<size_t>(group.carrier)].radius;
    carrier_[static_cast<size_t>(turning[g])] = group.carrier;
    carried_[turning[g]] = 1;
    blocks.push_back({turning[g], group.first, radius * group.hub.transpose()});
    blocks.push_back({turning[g], 0, radius * coordinates.rotation.row(group.carrier)});
    for (size_t i = 0; i + 1 < group.member.size(); ++i) {
      const auto planet = static_cast<size_t>(group.member[i].body);
      const Vec2 tangent = omega * omega * coordinates.mass[group.member[i].body] *
                           pin_direction(layout, layout.bodies[planet]);
      const auto couple = [&](int at, double sign) {
        centrifugal_.block<2, 1>(at, turning[g]) += sign * tangent;
        centrifugal_.block<1, 2>(turning[g], at) += sign * tangent.transpose();
      };
      couple(row[planet], -1);
      couple(row[static_cast<size_t>(group.carrier)], 1);
      centrifugal_(turning[g], turning[g]) += omega * omega * coordinates.mass[group.member[i].body];
    }
  }
  gather(blocks);
}

// Each range of coordinates once, however many motions it has.
void TurningFrame::gather(const std::vector<Block>& blocks) {
  int all = 0;
  const auto range_of = [&](const Block& block) {
    return std::find_if(touched_.begin(), touched_.end(),
                        [&](const Touched& range) { return range.first == block.first; });
  };
  for (const Block& block : blocks) {
    if (block.w.size() == 0 || range_of(block) != touched_.end()) continue;
    touched_.push_back({block.first, static_cast<int>(block.w.cols()), all});
    all += touched_.back().count;
  }
  w_.setZero(constant_.size(), all);
  for (const Block& block : blocks)
    if (block.w.size() > 0)
      w_.block(block.row, range_of(block)->at, block.w.rows(), block.w.cols()) = block.w;
}

// The rows of the translation of body b.
void TurningFrame::take(const System& layout, const SystemCoordinates& coordinates, int b, int row,
                        std::vector<Block>& blocks) {
  const SystemCoordinates::Share& own = coordinates.body[static_cast<size_t>(b)];
  const System::Body& body = layout.bodies[static_cast<size_t>(b)];
  if (own.swaying > 0) blocks.push_back({row, own.first + own.torsional, own.shift});
  if (own.carried.size() > 0) blocks.push_back({row, 0, own.carried});
  if (own.group >= 0) {
    const SystemCoordinates::Group& group = coordinates.group[static_cast<size_t>(own.group)];
    blocks.push_back({row, group.first, group.member[static_cast<size_t>(own.member)].shift});
  }
  const Eigen::Matrix2d quarter_turn{{0, -1}, {1, 0}};
  const double mass = coordinates.mass[b];
  centrifugal_.block<2, 2>(row, row).diagonal().setConstant(mass * omega_ * omega_);
  coriolis_.block<2, 2>(row, row) = 2 * mass * omega_ * quarter_turn;
  if (body.on == System::kGround) {
    if (body.bearing.elastic())
      dragging_.block<2, 2>(row, row) = -body.bearing.damping * omega_ * quarter_turn;
    return;
  }
  carrier_[static_cast<size_t>(row)] = carrier_[static_cast<size_t>(row) + 1] = body.on;
  carried_.segment<2>(row) = pin_direction(layout, body);
  const auto& centre = layout.bodies[static_cast<size_t>(body.on)].centre;
  constant_.segment<2>(row) =
      mass * omega_ * omega_ * Vec2(body.centre[0] - centre[0], body.centre[1] - centre[1]);
}

void TurningFrame::set_step(double seconds, const Eigen::Ref<const VectorXd>& bq) {
  const Index n = constant_.size(), size = bq.size();
  MatrixXd w = MatrixXd::Zero(size, n);  // W^T
  add(MatrixXd::Identity(n, n), w);
  const MatrixXd one = MatrixXd::Identity(n, n), a = 0.25 * seconds * coriolis_, kappa = stiffness();
  half_turn_ = -2 * a * (one + w.transpose() * w * a).inverse();
  closing_ = kappa * (one - 0.5 * w.transpose() * bq.asDiagonal() * w * kappa).inverse();
}

MatrixXd TurningFrame::motions(const Eigen::Ref<const MatrixXd>& z) const {
  MatrixXd own(w_.cols(), z.cols());
  for (const Touched& range : touched_)
    own.middleRows(range.at, range.count) = z.middleRows(range.first, range.count);
  return w_ * own;
}

void TurningFrame::add(const Eigen::Ref<const MatrixXd>& f, Eigen::Ref<MatrixXd> z) const {
  const MatrixXd own = w_.transpose() * f;
  for (const Touched& range : touched_)
    z.middleRows(range.first, range.count) += own.middleRows(range.at, range.count);
}

void TurningFrame::add(const Eigen::Ref<const MatrixXd>& f, const Eigen::Ref<const VectorXd>& weight,
                       Eigen::Ref<MatrixXd> z) const {
  const MatrixXd own = w_.transpose() * f;
  for (const Touched& range : touched_)
    z.middleRows(range.first, range.count) +=
        weight.segment(range.first, range.count).asDiagonal() * own.middleRows(range.at, range.count);
}

Vec2 TurningFrame::inertia_force(int b, const Vec2& x, const Vec2& v) const {
  const Index row = std::find(body_.begin(), body_.end(), b) - body_.begin();
  return coriolis_.block<2, 2>(row, row) * v - constant_.segment<2>(row) -
         centrifugal_.block<2, 2>(row, row) * x;
}

VectorXd TurningFrame::on_carriers(const VectorXd& force, Index bodies) const {
  VectorXd out = VectorXd::Zero(bodies);
  for (size_t i = 0; i < carrier_.size(); ++i)
    if (carrier_[i] >= 0) out[carrier_[i]] += carried_[static_cast<Index>(i)] * force[static_cast<Index>(i)];
  return out;
}

// The symmetric part of kappa has a potential; the antisymmetric one has none.
TurningFrame::Work TurningFrame::work(const VectorXd& z0, const VectorXd& z1) const {
  Work out;
  const VectorXd y0 = motions(z0), y1 = motions(z1);
  out.centrifugal = constant_.dot(y1 - y0) + 0.5 * (y1.dot(centrifugal_ * y1) - y0.dot(centrifugal_ * y0));
  const VectorXd dragged = -y0.cwiseProduct(dragging_ * y1);
  out.dragging.setZero(body_.empty() ? 0 : *std::max_element(body_.begin(), body_.end()) + 1);
  for (size_t i = 0; i < body_.size(); ++i) out.dragging[body_[i]] += dragged[static_cast<Index>(i)];
  return out;
}

}  // namespace whine
