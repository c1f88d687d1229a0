#include "motion/rolling_mesh.h"

#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

ElasticGear::ElasticGear(const BodyArtifact& body)
    : body_(body),
      half_plane_(body.material, body.design.face_width),
      table_(ToothGeometry(body.design), static_cast<int>(body.flank_position.size())) {
  if ((table_.points() - body.flank_position).cwiseAbs().maxCoeff() > 1e-12)
    fail(Failure::input,
         "the body's flank positions are not those of this program's flank table; rebuild body.h5");
}

MatrixXd ElasticGear::compliance(int offset, double depth) const {
  const int distance = std::abs(offset);
  if (distance > body_.offsets) return MatrixXd::Zero(table_size(), table_size());
  MatrixXd r = body_.compliance[distance];
  if (offset < 0) r.transposeInPlace();  // reciprocity: R_-d = R_d^T
  if (offset == 0) r.array() += half_plane_.coefficient() * std::log(body_.reference_depth / depth);
  return r;
}

MatrixXd ElasticGear::residual(int offset, double depth, const std::vector<int>& kept) const {
  MatrixXd r = compliance(offset, depth);
  if (std::abs(offset) > body_.offsets) return r;
  for (int column : kept) {
    const double w = 2 * std::numbers::pi * body_.eigenfrequency[column];
    r -= mode_on_tooth(column, offset) * mode_on_tooth(column, 0).transpose() / (w * w);
  }
  return r;
}

int ElasticGear::partner(int column) const {
  const int n = body_.nodal_diameter[column];
  if (n == 0 || 2 * n == body_.design.teeth) return column;
  return body_.component[column] == 0 ? column + 1 : column - 1;
}

double ElasticGear::tooth_angle(int column) const {
  return 2 * std::numbers::pi * body_.nodal_diameter[column] / body_.design.teeth;
}

VectorXd ElasticGear::mode_on_tooth(int column, int tooth) const {
  const double angle = tooth_angle(column) * tooth;
  const int other = partner(column);
  if (other == column) return std::cos(angle) * body_.flank_mode.col(column);
  // exp(i n theta) (re + i im): the cosine column takes the real part, the sine column the imaginary part.
  const double sign = body_.component[column] == 0 ? -1 : 1;
  return std::cos(angle) * body_.flank_mode.col(column) +
         sign * std::sin(angle) * body_.flank_mode.col(other);
}

GearMeshModel::GearMeshModel(const BodyArtifact& driver, const BodyArtifact& driven, const GearMeshSpec& mesh)
    : kinematics(driver.design, driven.design, mesh.centre_distance),
      gear{ElasticGear(driver), ElasticGear(driven)},
      corner(mesh.corner) {}

VectorXd MeshPosition::to_strips(const Eigen::Ref<const VectorXd>& at_nodes) const {
  VectorXd out(strips());
  for (size_t j = 0; j < pairs.size(); ++j)
    out.segment(first_strip[j], pairs[j].size()).noalias() =
        pairs[j].interpolation * at_nodes.segment<kWindowNodes>(j * kWindowNodes);
  return out;
}

VectorXd MeshPosition::to_nodes(const Eigen::Ref<const VectorXd>& on_strips) const {
  VectorXd out(nodes());
  for (size_t j = 0; j < pairs.size(); ++j)
    out.segment<kWindowNodes>(j * kWindowNodes).noalias() =
        pairs[j].interpolation.transpose() * on_strips.segment(first_strip[j], pairs[j].size());
  return out;
}

void MeshPosition::add_to_strips(const MatrixXd& at_nodes, MatrixXd& a) const {
  for (size_t i = 0; i < pairs.size(); ++i)
    for (size_t j = 0; j < pairs.size(); ++j)
      a.block(first_strip[i], first_strip[j], pairs[i].size(), pairs[j].size()).noalias() +=
          pairs[i].interpolation *
          at_nodes.block<kWindowNodes, kWindowNodes>(i * kWindowNodes, j * kWindowNodes) *
          pairs[j].interpolation.transpose();
}

VectorXd MeshPosition::pair_loads(const Eigen::Ref<const VectorXd>& p) const {
  VectorXd loads(pairs.size());
  for (size_t j = 0; j < pairs.size(); ++j) loads[j] = p.segment(first_strip[j], pairs[j].size()).sum();
  return loads;
}

bool MeshPosition::reaches_window_end(const Eigen::Ref<const VectorXd>& p) const {
  for (size_t j = 0; j < pairs.size(); ++j) {
    if (!pairs[j].low_is_edge && p[first_strip[j]] > 0) return true;
    if (!pairs[j].high_is_edge && p[first_strip[j + 1] - 1] > 0) return true;
  }
  return false;
}

MeshPosition make_position(const GearMeshModel& model, double phase, const ContactRange& range) {
  MeshPosition position;
  position.phase = phase;
  const GearPair& gears = model.kinematics;
  const double tangent = std::tan(gears.working_pressure_angle()), pitch = gears.base_pitch();
  for (int pair = -3; pair <= 3; ++pair) {  // more than a contact ratio of 4 and corners could need
    const double path = (phase + pair) * pitch;
    // Beyond the tangent points of the base circles there is no contact of these flanks.
    if (gears.gear(0).base_radius() * tangent + path <= 0 ||
        gears.gear(1).base_radius() * tangent - path <= 0)
      continue;
    const PairContact contact = gears.contact(phase + pair);
    if (contact.corner) {
      if (!model.corner.enabled || contact.normal_angle > model.corner.largest_angle) continue;
      if (!contact.on_flank) {
        position.lost_corner_gap = std::min(position.lost_corner_gap, contact.gap);
        continue;
      }
      if (contact.gap > range.corner_gap) {
        position.next_corner_gap = std::min(position.next_corner_gap, contact.gap);
        continue;
      }
    }
    position.pairs.push_back(make_strips(gears, pair, contact, range));
  }

  position.first_strip.push_back(0);
  for (const PairStrips& s : position.pairs)
    position.first_strip.push_back(position.first_strip.back() + s.size());
  position.gap.resize(position.first_strip.back());
  for (int g = 0; g < 2; ++g) {
    position.strip_lever[g].resize(position.strips());
    position.node_lever[g].resize(position.nodes());
    position.table_weights[g].resize(position.nodes(), model.gear[g].table_size());
  }
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const PairStrips& s = position.pairs[j];
    position.gap.segment(position.first_strip[j], s.size()) = s.gap;
    for (int g = 0; g < 2; ++g) {
      position.strip_lever[g].segment(position.first_strip[j], s.size()).setConstant(s.contact.lever[g]);
      position.node_lever[g].segment<kWindowNodes>(j * kWindowNodes).setConstant(s.contact.lever[g]);
      for (int k = 0; k < kWindowNodes; ++k)
        position.table_weights[g].row(j * kWindowNodes + k) =
            model.gear[g].table().weights(s.node_roll[g][k]);
    }
  }
  return position;
}

MatrixXd local_compliance(const GearMeshModel& model, const MeshPosition& position, double depth) {
  MatrixXd a = MatrixXd::Zero(position.strips(), position.strips());
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const int first = position.first_strip[j], n = position.pairs[j].size();
    a.block(first, first, n, n) = half_plane_compliance(position.pairs[j], model.gear[0].half_plane(),
                                                        model.gear[1].half_plane(), depth);
  }
  return a;
}

MatrixXd body_compliance(const MeshPosition& position, int g, const std::vector<MatrixXd>& tables) {
  const int max = static_cast<int>(tables.size()) / 2;
  MatrixXd c = MatrixXd::Zero(position.nodes(), position.nodes());
  const MatrixXd& s = position.table_weights[g];
  for (size_t i = 0; i < position.pairs.size(); ++i)
    for (size_t j = 0; j < position.pairs.size(); ++j) {
      const int offset = GearMeshModel::tooth(g, position.pairs[i].pair - position.pairs[j].pair);
      if (std::abs(offset) > max) continue;
      c.block<kWindowNodes, kWindowNodes>(i * kWindowNodes, j * kWindowNodes) =
          s.middleRows<kWindowNodes>(i * kWindowNodes) * tables[offset + max] *
          s.middleRows<kWindowNodes>(j * kWindowNodes).transpose();
    }
  return c;
}

Equilibrium equilibrium(const MatrixXd& a, const VectorXd& gap, const VectorXd& approach, double load,
                        double start, ActiveSet& active, ComplementaritySolver& solver) {
  const int n = static_cast<int>(gap.size());
  Equilibrium result;
  result.p.resize(n);
  VectorXd e(n), d(n), reduced, response;
  double touch = std::numeric_limits<double>::infinity();  // where the first strip touches
  for (int k = 0; k < n; ++k)
    if (approach[k] > 0) touch = std::min(touch, gap[k] / approach[k]);
  if (!std::isfinite(touch)) fail(Failure::numerical, "no strip can carry the load: no pair is in reach");
  double low = touch, high = std::numeric_limits<double>::infinity();
  double x = std::max(start, touch + 1e-3 * std::abs(touch) + 1e-9);
  for (int iteration = 0; iteration < 200; ++iteration) {
    e = gap - x * approach;
    result.certificate = solver.solve(a, e, active, result.p, d);
    const double excess = approach.dot(result.p) - load;
    const int k = static_cast<int>(active.strips.size());
    reduced.resize(k);
    for (int i = 0; i < k; ++i) reduced[i] = approach[active.strips[i]];
    response = active.inverse * reduced;
    result.stiffness = reduced.dot(response);
    result.x = x;
    result.residual = std::abs(excess) / load;
    if (result.residual < 1e-12) return result;
    (excess > 0 ? high : low) = x;
    double next = result.stiffness > 0 ? x - excess / result.stiffness : x;
    // The set may be right and only round-off left.
    if (result.residual < 1e-10 && (next == x || high - low < 4e-16 * std::abs(x))) return result;
    if (!(next > low && next < high)) next = std::isfinite(high) ? 0.5 * (low + high) : 2 * x - touch + 1e-9;
    x = next;
  }
  fail(Failure::numerical, "static equilibrium did not converge: residual ", result.residual, " of the load ",
       load, " after 200 steps at x = ", result.x);
}

}  // namespace whine
