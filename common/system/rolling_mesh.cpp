#include "system/rolling_mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/model_range.h"
#include "contact/lanes.h"
#include "gear/face_width.h"
#include "gear/train.h"
#include "model/capabilities.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

GearMeshModel::GearMeshModel(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh)
    : GearMeshModel({std::make_shared<const ElasticGear>(driver, mesh.contact_plane),
                     std::make_shared<const ElasticGear>(driven, mesh.contact_plane)},
                    mesh, pair_system(mesh, driver.design, driven.design).meshes[0]) {}

namespace {

// Of the mesh: a gear that is wider than its mate carries on a part of its width.
SideGears in_mesh(const SideGears& gears) {
  const double width = contact_width(gears[0].body().design, gears[1].body().design);
  const auto own = [&](size_t side) {
    return gears[side].body().design.face_width > width
               ? std::make_shared<const ElasticGear>(gears[side].in_mesh(width))
               : gears.shared(side);
  };
  return {own(0), own(1)};
}

}  // namespace

GearMeshModel::GearMeshModel(const SideGears& gears, const GearMeshSpec& mesh, const System::Mesh& placed)
    : kinematics(gears[0].body().design, gears[1].body().design, mesh.centre_distance),
      gear(in_mesh(gears)),
      corner(mesh.corner),
      deviation{
          FlankDeviation(kinematics.gear(0), mesh.modification[0], mesh.errors[0], placed.side[0].flank),
          FlankDeviation(kinematics.gear(1), mesh.modification[1], mesh.errors[1], placed.side[1].flank)},
      bearing(mesh.bearing),
      friction(mesh.friction),
      layout(placed) {
  require_able("one-slice", traits(mesh, kinematics.gear(0).design(), kinematics.gear(1).design()));
}

Vec2 GearMeshModel::outward_in_system(int g, const PairContact& contact) const {
  Vec2 own = outward(g, contact);
  if (layout.side[0].sense < 0) own.x() = -own.x();
  return Eigen::Rotation2Dd(layout.direction - 0.5 * std::numbers::pi) * own;
}

VectorXd MeshPosition::to_strips(const Eigen::Ref<const VectorXd>& at_nodes) const {
  if (!law.empty()) return at_nodes;
  VectorXd out(strips());
  for (size_t j = 0; j < pairs.size(); ++j)
    out.segment(first_strip[j], pairs[j].size()).noalias() =
        pairs[j].interpolation * at_nodes.segment<kZoneNodes>(j * kZoneNodes);
  return out;
}

VectorXd MeshPosition::to_nodes(const Eigen::Ref<const VectorXd>& on_strips) const {
  if (!law.empty()) return on_strips;
  VectorXd out(nodes());
  for (size_t j = 0; j < pairs.size(); ++j)
    out.segment<kZoneNodes>(j * kZoneNodes).noalias() =
        pairs[j].interpolation.transpose() * on_strips.segment(first_strip[j], pairs[j].size());
  return out;
}

void MeshPosition::add_to_strips(const MatrixXd& at_nodes, MatrixXd& a) const {
  if (!law.empty()) {
    a += at_nodes;
    return;
  }
  Eigen::Matrix<double, Eigen::Dynamic, kZoneNodes> half;
  for (size_t i = 0; i < pairs.size(); ++i)
    for (size_t j = 0; j < pairs.size(); ++j) {
      half.setZero(pairs[i].size(), kZoneNodes);
      for (int k = 0; k < kZoneNodes; ++k)
        add_six_columns(half.col(k).data(), half.col(k).data(), pairs[i].interpolation.data(),
                        pairs[i].size(), &at_nodes(i * kZoneNodes, j * kZoneNodes + k), 1, pairs[i].size());
      for (int c = 0; c < pairs[j].size(); ++c) {
        double* column = &a(first_strip[i], first_strip[j] + c);
        add_six_columns(column, column, half.data(), pairs[i].size(), &pairs[j].interpolation(c, 0),
                        pairs[j].size(), pairs[i].size());
      }
    }
}

bool MeshPosition::reaches_zone_end(const Eigen::Ref<const VectorXd>& p) const {
  for (size_t j = 0; j < pairs.size(); ++j) {
    if (!pairs[j].low_is_edge && p[first_strip[j]] > 0) return true;
    if (!pairs[j].high_is_edge && p[first_strip[j + 1] - 1] > 0) return true;
  }
  return false;
}

int hunting_periods(const GearMeshModel& model) {
  int periods = 1;
  for (int g = 0; g < kSides; ++g) {
    periods = std::lcm(periods, model.deviation[g].repeats());
    if (model.cracked(g)) periods = std::lcm(periods, model.kinematics.gear(g).design().teeth);
  }
  return periods;
}

PairsInReach pairs_in_reach(const GearMeshModel& model, double phase, double corner_gap) {
  PairsInReach reach;
  const GearPair& gears = model.kinematics;
  // More than a contact ratio of 4 and corners could need; the tips of a pinion in a ring stay near its flanks for longer.
  const int farthest = gears.internal() ? 5 : 3;
  for (int pair = -farthest; pair <= farthest; ++pair) {
    if (!gears.in_reach(phase + pair)) continue;
    const PairContact contact = gears.contact(phase + pair);
    if (contact.corner) {
      if (!model.corner.enabled || contact.normal_angle > model.corner.largest_angle) continue;
      const PairDeviation flanks = model.common_flanks();
      const double nearer = flanks.between_teeth();  // other teeth, at most
      if (!contact.on_flank) {
        reach.lost_corner_gap =
            std::min(reach.lost_corner_gap, contact.gap + flanks.at(contact.roll) - nearer);
        continue;
      }
      const double gap =
          (flanks.none() ? contact.gap : gears.gap_at(contact, gears.nearest(contact, flanks), flanks)) -
          nearer;
      if (gap > corner_gap) {
        reach.next_corner_gap = std::min(reach.next_corner_gap, gap);
        continue;
      }
    }
    reach.pair.push_back(pair);
    reach.contact.push_back(contact);
  }
  return reach;
}

double unloaded_transmission_error(const GearMeshModel& model, double phase, int period) {
  const GearPair& gears = model.kinematics;
  if (model.flanks().none()) return 0;
  // A pair on the line of action, which there always is, has no larger gap.
  const double largest = std::max(0.0, model.deviation[0].largest() + model.deviation[1].largest());
  constexpr double kLever = 1.1;  // over the lever of a tip edge
  const PairsInReach reach = pairs_in_reach(model, phase, kLever * largest);
  double least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < reach.size(); ++j) {
    const PairContact& contact = reach.contact[j];
    const PairDeviation flanks = model.flanks(reach.pair[j], period);
    const double gap = gears.gap_at(contact, gears.nearest(contact, flanks), flanks);
    least = std::min(least, gap * gears.gear(0).base_radius() / contact.lever[0]);
  }
  return least;
}

VectorXd flank_gaps(const GearMeshModel& model, const MeshPosition& position, int period) {
  VectorXd gap(position.first_strip.back());
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const PairStrips& s = position.pairs[j];
    gap.segment(position.first_strip[j], s.size()) = s.gap;
    const PairDeviation own = model.flanks(s.pair, period), common = model.common_flanks();
    if (!own.differs()) continue;
    const auto places = static_cast<int>(s.gap_roll[0].size()) / s.size();
    for (int i = 0; i < s.size(); ++i) {
      double sum = 0;
      for (int k = i * places; k < (i + 1) * places; ++k) {
        const std::array<double, 2> roll{s.gap_roll[0][k], s.gap_roll[1][k]};
        sum += own.at(roll) - common.at(roll);
      }
      gap[position.first_strip[j] + i] += sum / places;
    }
  }
  return gap;
}

MeshPosition make_position(const GearMeshModel& model, double phase, const CandidateZone& range, int period) {
  MeshPosition position;
  position.phase = phase;
  const PairsInReach reach = pairs_in_reach(model, phase, range.corner_gap);
  position.next_corner_gap = reach.next_corner_gap;
  position.lost_corner_gap = reach.lost_corner_gap;
  for (int j = 0; j < reach.size(); ++j)
    position.pairs.push_back(
        make_strips(model.kinematics, reach.pair[j], reach.contact[j], range, model.common_flanks()));

  position.first_strip.push_back(0);
  for (const PairStrips& s : position.pairs)
    position.first_strip.push_back(position.first_strip.back() + s.size());
  position.gap = flank_gaps(model, position, period);
  for (int g = 0; g < kSides; ++g) {
    position.strip_lever[g].resize(position.strips());
    position.node_lever[g].resize(position.nodes());
    position.table_weights[g].resize(position.nodes(), model.gear[g].table_size());
  }
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const PairStrips& s = position.pairs[j];
    for (int g = 0; g < kSides; ++g) {
      position.strip_lever[g].segment(position.first_strip[j], s.size()).setConstant(s.contact.lever[g]);
      position.node_lever[g].segment<kZoneNodes>(j * kZoneNodes).setConstant(s.contact.lever[g]);
      for (int k = 0; k < kZoneNodes; ++k)
        position.table_weights[g].row(j * kZoneNodes + k) = model.gear[g].table().weights(s.node_roll[g][k]);
    }
  }
  return position;
}

namespace {

// What a line contact takes in place of the gap of two flanks: a parabola, cut off at the tip edge that is near.
struct LineGap {
  double gap = 0;         // m, at the touching point
  double radius = 0;      // m
  double edge_slope = 0;  // 1, see HertzLine
  double touch = 0;       // m: tangential coordinate of the touching point, of the edge if that touches
};

// tip: m, distances of the tip edges of driver and driven gear; near: whose the law knows of. half_width: m, of the
// contact over which flanks that deviate are averaged. cosine: as make_line_point, along whose normal the gap is.
LineGap line_gap(const GearPair& gears, const PairContact& contact, const PairDeviation& deviation,
                 const double tip[2], int near, double half_width, double cosine) {
  LineGap line;
  line.gap = cosine * contact.gap;
  line.radius = gears.relative_curvature_radius(contact) / cosine;
  line.edge_slope = contact.corner ? cosine * std::tan(contact.normal_angle) : -tip[near] / line.radius;
  if (deviation.none()) return line;

  // Gap of the flanks as designed, to the side on which both exist: contact.gap + leaning x + x^2 / (2 R).
  const double side = near == 0 ? -1 : 1;  // the driver's tip edge is where x is largest
  const double leaning = contact.corner ? side * cosine * std::tan(contact.normal_angle) : 0,
               curvature = 1 / line.radius;
  // Pressure that is bounded at both ends weighs a gap by 1 / sqrt(a^2 - x^2) (Johnson, Contact Mechanics, section 2.7):
  // what it feels of the deviation are the first Chebyshev coefficients over its width.
  struct Parabola {
    double value, slope, curvature;  // m, 1, m-1 at the middle
  };
  const auto felt = [&](double middle) {
    constexpr int kNodes = 24;
    double mean = 0, first = 0, second = 0;
    for (int k = 0; k < kNodes; ++k) {
      const double angle = (k + 0.5) * std::numbers::pi / kNodes, cosine = std::cos(angle);
      const double x = middle + half_width * cosine;
      std::array<double, 2> roll;
      for (int g = 0; g < kSides; ++g) {  // along the flank's arc: x to 1e-4 of itself
        // Of gears of an internal pair both roll angles grow the same way.
        const double rb = gears.gear(g).base_radius(),
                     sign = gears.nominal_roll(g, rb) > gears.nominal_roll(g, 0) ? 1 : -1;
        roll[g] = std::sqrt(std::max(0.0, contact.roll[g] * contact.roll[g] + 2 * sign * x / rb));
      }
      const double d = deviation.at(roll) / kNodes;
      mean += d;
      first += d * cosine;
      second += d * std::cos(2 * angle);
    }
    return Parabola{mean - 2 * second, 2 * first / half_width, 8 * second / (half_width * half_width)};
  };
  // The middle of the contact, where the slopes add up to nothing, or the end of the flanks that it is pushed against.
  double low = contact.x_min, high = contact.x_max;
  const auto slope = [&](double x) { return leaning + curvature * x + felt(x).slope; };
  double middle = low;
  if (slope(high) < 0)
    middle = high;
  else if (slope(low) < 0)
    while (high - low > 1e-6 * half_width) {
      middle = 0.5 * (low + high);
      if (middle == low || middle == high) break;
      (slope(middle) < 0 ? low : high) = middle;
    }
  const Parabola p = felt(middle);
  // A hollow that is as narrow as the flanks' own curvature holds no single contact; the law stops short of it.
  constexpr double kLeastCurvature = 0.1;
  const double whole = std::max(curvature + p.curvature, kLeastCurvature * curvature);
  const double slope_there = leaning + curvature * middle + p.slope;
  double touch = middle - slope_there / whole;
  const double edge = -side * tip[near];
  line.radius = 1 / whole;
  if (std::isfinite(edge) && side * (touch - edge) < 0) touch = edge;
  const double off = touch - middle;
  line.gap = cosine * contact.gap + (leaning + 0.5 * curvature * middle) * middle + p.value +
             (slope_there + 0.5 * whole * off) * off;
  line.edge_slope = touch == edge ? side * (slope_there + whole * off) : -side * (touch - edge) * whole;
  line.touch = touch;
  return line;
}

}  // namespace

LinePoint make_line_point(const GearMeshModel& model, const PairContact& contact,
                          const std::array<HalfPlaneSurface, 2>& surface, double depth, double pair_force,
                          double cosine) {
  const GearPair& gears = model.kinematics;
  const double coefficient = surface[0].coefficient() + surface[1].coefficient();
  const double tip[2] = {gears.edge_distance(contact, 0), gears.edge_distance(contact, 1)};
  const int near = contact.corner ? contact.end() : tip[0] < tip[1] ? 0 : 1;
  const double half_width =
      std::sqrt(2 * gears.relative_curvature_radius(contact) / cosine * pair_force * coefficient);
  const LineGap flanks = line_gap(gears, contact, model.common_flanks(), tip, near, half_width, cosine);
  LinePoint point{flanks.gap, flanks.touch,
                  HertzLine(surface[0], surface[1], flanks.radius, depth, flanks.edge_slope)};
  // The driver's tip edge is where x is largest.
  const double edge = contact.corner ? 0 : near == 0 ? tip[0] : -tip[1];
  const HertzLine& law = point.law;
  point.roll =
      gears
          .gap_at(contact, law.at_edge(pair_force) ? edge + (near == 0 ? -1 : 1) * law.centroid(pair_force)
                                                   : flanks.touch)
          .roll;
  return point;
}

MeshPosition make_line_position(const GearMeshModel& model, double phase, double corner_gap, double depth,
                                double pair_force, int period) {
  const GearPair& gears = model.kinematics;
  MeshPosition position;
  position.phase = phase;
  position.nodes_per_pair = 1;
  const PairsInReach reach = pairs_in_reach(model, phase, corner_gap);
  position.next_corner_gap = reach.next_corner_gap;
  position.lost_corner_gap = reach.lost_corner_gap;
  const int n = reach.size();
  const std::array<HalfPlaneSurface, 2> surface{model.gear[0].half_plane(), model.gear[1].half_plane()};
  position.first_strip = {0};
  for (int g = 0; g < kSides; ++g) {
    position.strip_lever[g].resize(n);
    position.table_weights[g].resize(n, model.gear[g].table_size());
  }
  for (int j = 0; j < n; ++j) {
    const PairContact& contact = reach.contact[j];
    PairStrips line;
    line.pair = reach.pair[j];
    line.contact = contact;
    const LinePoint point = make_line_point(model, contact, surface, depth, pair_force);
    line.gap = VectorXd::Constant(1, point.gap);
    if (model.common_flanks().differs()) {
      const FlankGap touch = gears.gap_at(contact, point.touch);
      for (int g = 0; g < kSides; ++g) line.gap_roll[g] = VectorXd::Constant(1, touch.roll[g]);
    }
    position.pairs.push_back(line);
    position.first_strip.push_back(j + 1);
    position.law.push_back(point.law);
    for (int g = 0; g < kSides; ++g) {
      position.strip_lever[g][j] = contact.lever[g];
      position.table_weights[g].row(j) = model.gear[g].table().weights(point.roll[g]);
    }
  }
  position.node_lever = position.strip_lever;
  position.gap = flank_gaps(model, position, period);
  return position;
}

void require_above_roots(const GearMeshModel& model, const MeshPosition& position,
                         const Eigen::Ref<const VectorXd>& p) {
  constexpr double kSame = 1e-12;  // m
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const PairStrips& s = position.pairs[j];
    const bool low =
        !s.low_is_edge && s.border[0] <= s.contact.x_min + kSame && p[position.first_strip[j]] > 0;
    const bool high = !s.high_is_edge && s.border[s.size()] >= s.contact.x_max - kSame &&
                      p[position.first_strip[j + 1] - 1] > 0;
    if (!low && !high) continue;
    const ToothGeometry& gear = model.kinematics.gear(low ? 0 : 1);
    const double form = 2e3 * std::hypot(1.0, gear.form_roll_angle()) * gear.base_radius();
    fail_outside_range(Failure::numerical, "contact reaches the end of the involute near the root of the ",
                       low ? "driver" : "driven gear", ", whose form diameter is ", form,
                       " mm; lower the torque or the response (damping, speeds), shorten the tips of the ",
                       low ? "driven gear" : "driver", " (addendum) or enlarge centre_distance_mm");
  }
}

void require_line_range(const MeshPosition& position, const Eigen::Ref<const VectorXd>& force) {
  require_hertz_range(position.law, force);
  for (size_t j = 0; j < position.pairs.size(); ++j) {
    const PairContact& contact = position.pairs[j].contact;
    const double width = position.law[j].width(force[j]);
    if (width > contact.x_max - contact.x_min)
      fail_outside_range(Failure::numerical, "at mesh phase ", position.phase,
                         " contact leaves the flanks: a pair carries ", force[j], " N on a width of ",
                         1e3 * width, " mm, and its flanks face each other over ",
                         (contact.x_max - contact.x_min) * 1e3, " mm; lower the torque");
  }
}

namespace {

// kNodes rows of weights per pair.
template <int kNodes>
MatrixXd between_nodes(const MatrixXd& weights, const std::vector<int>& pair, int g,
                       const std::vector<MatrixXd>& tables) {
  const int max = static_cast<int>(tables.size()) / 2;
  MatrixXd c = MatrixXd::Zero(weights.rows(), weights.rows());
  for (size_t i = 0; i < pair.size(); ++i)
    for (size_t j = 0; j < pair.size(); ++j) {
      const int offset = GearMeshModel::tooth(g, pair[i] - pair[j]);
      if (std::abs(offset) > max) continue;
      c.block<kNodes, kNodes>(i * kNodes, j * kNodes) = weights.middleRows<kNodes>(i * kNodes) *
                                                        tables[offset + max] *
                                                        weights.middleRows<kNodes>(j * kNodes).transpose();
    }
  return c;
}

}  // namespace

MatrixXd body_compliance(const MeshPosition& position, int g, const std::vector<MatrixXd>& tables) {
  std::vector<int> pair;
  for (const PairStrips& strips : position.pairs) pair.push_back(strips.pair);
  return (position.law.empty() ? between_nodes<kZoneNodes> : between_nodes<1>)(position.table_weights[g],
                                                                               pair, g, tables);
}

std::vector<MatrixXd> compliance_tables(const ElasticGear& gear, double depth) {
  constexpr int kFarthestOfMesh = 6;
  std::vector<MatrixXd> tables;
  // The zone of a mesh with twice the range of search reaches 7 teeth at most.
  const int most = std::max(gear.body().offsets, std::min(gear.body().design.teeth / 2, kFarthestOfMesh));
  for (int offset = -most; offset <= most; ++offset) tables.push_back(gear.compliance(offset, depth));
  return tables;
}

MatrixXd contact_compliance(const GearMeshModel& model, const MeshPosition& position,
                            const std::array<std::vector<MatrixXd>, 2>& tables, double depth) {
  MatrixXd a = local_compliance(model, position, depth);
  position.add_to_strips(body_compliance(position, 0, tables[0]) + body_compliance(position, 1, tables[1]),
                         a);
  return a;
}

MatrixXd crack_compliance(const GearMeshModel& model, const MeshPosition& position, int period) {
  const auto pairs = static_cast<Eigen::Index>(position.pairs.size());
  MatrixXd c;
  for (int g = 0; g < kSides; ++g) {
    if (!model.cracked(g)) continue;
    const auto tooth = [&](Eigen::Index pair) {
      return model.tooth_at_crack(g, position.pairs[static_cast<size_t>(pair)].pair - period);
    };
    for (Eigen::Index i = 0; i < pairs; ++i)
      for (Eigen::Index j = 0; j < pairs; ++j) {
        const MatrixXd share = model.gear[g].crack_compliance(tooth(i), tooth(j));
        if (share.size() == 0) continue;
        if (c.size() == 0) c.setZero(position.nodes(), position.nodes());
        const auto rows = position.nodes_of(static_cast<size_t>(i)),
                   columns = position.nodes_of(static_cast<size_t>(j));
        c(rows, columns) += position.table_weights[g](rows, Eigen::all) * share *
                            position.table_weights[g](columns, Eigen::all).transpose();
      }
  }
  return c;
}

}  // namespace whine
