#include "system/face_contact.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "gear/face_width.h"
#include "gear/helix.h"
#include "model/capabilities.h"
#include "results/static.h"
#include "solid/elements.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd between_sections(const FlankTable& table, const LineOnBody& a, const LineOnBody& b,
                          const MatrixXd& between, const GaussRule& rule) {
  MatrixXd out = MatrixXd::Zero(a.points.per_line, b.points.per_line);
  const auto ends = [](const LineOnBody& of) {
    const ContactLine& line = of.points.line[static_cast<size_t>(of.line)];
    return of.sense > 0 ? std::array{line.from, line.to} : std::array{-line.to, -line.from};
  };
  const double from = std::max(ends(a)[0], ends(b)[0]), to = std::min(ends(a)[1], ends(b)[1]);
  if (!(to > from)) return out;
  const auto own = [](const LineOnBody& of) {
    return Eigen::seqN(static_cast<Index>(of.line) * of.points.per_line, of.points.per_line);
  };
  const auto weights = [&](const LineOnBody& of, const Eigen::RowVectorXd& l) {
    return table.weights(std::clamp(l.dot(of.roll(own(of))), table.lowest(), table.highest()));
  };
  for (Index k = 0; k < rule.point.size(); ++k) {
    const double z = 0.5 * (from + to + (to - from) * rule.point[k]);
    const Eigen::RowVectorXd l = interpolation(a.points, a.line, a.sense * z),
                             r = interpolation(b.points, b.line, b.sense * z);
    out += 0.5 * (to - from) * rule.weight[k] * weights(a, l).dot(between * weights(b, r).transpose()) *
           l.transpose() * r;
  }
  out.array().colwise() /= a.points.weight(own(a)).array();
  out.array().rowwise() /= b.points.weight(own(b)).transpose().array();
  return out;
}

ReducedBody section_of(const ReducedBody& body, WidthModel width, double common) {
  ReducedBody out = body;
  out.design = transverse_section(body.design);
  if (width != WidthModel::body || body.design.face_width == common) return out;
  const double more = body.design.face_width / common;
  for (MatrixRM& table : out.compliance) table *= more;
  out.far_compliance *= more;
  out.back_compliance *= more;
  out.design.face_width = common;
  return out;
}

GearMeshSpec even(GearMeshSpec mesh) {
  mesh.misalignment = mesh.face_offset = 0;
  for (FlankModification& modification : mesh.modification) modification.lead = {};
  return mesh;
}

namespace {

const GearMeshSpec& taken(const GearMeshSpec& mesh, WidthModel width, const ReducedBody& driver,
                          const ReducedBody& driven) {
  Traits of = traits(mesh, driver.design, driven.design, width);
  const ReducedBody* const bodies[] = {&driver, &driven};
  for (size_t g = 0; g < kSides; ++g)
    if (bodies[g]->material.plane_stress && (width == WidthModel::body || bodies[g]->design.helical()))
      of.emplace_back(Trait::plane_stress, text("[gear.", mesh.gear[g], "], plane = \"stress\""));
  require_able("width", of);
  if (width != WidthModel::body) return mesh;
  require_able("width-body", of);
  for (size_t g = 0; g < kSides; ++g)
    if (bodies[g]->width.flexibility.empty())
      fail(
          Failure::input, "width = \"body\" and [gear.", mesh.gear[g],
          "] has a plane body: gear-reduce adds the third dimension by the polynomials of width_degree in [discretisation]; write it, or leave it to width = \"body\" in the scene");
  return mesh;
}

}  // namespace

FaceContact::FaceContact(const ReducedBody& driver, const ReducedBody& driven, const GearMeshSpec& mesh,
                         WidthModel width, int points, double depth)
    : gears_(driver.design, driven.design, mesh.centre_distance),
      section_(section_of(driver, width, gears_.face_width()), section_of(driven, width, gears_.face_width()),
               even(taken(mesh, width, driver, driven))),
      gap_(gears_, mesh),
      middle_(contact_middle(driver.design, driven.design, mesh.face_offset)),
      rule_(gauss_rule(points)),
      cosine_(std::cos(gears_.base_helix_angle())),
      depth_(depth > 0 ? depth : this->mesh().gear[0].contact_depth()) {
  for (size_t g = 0; g < kSides; ++g) {
    const ElasticGear& gear = this->mesh().gear[g];
    table_[g] = compliance_tables(gear, depth_);
    if (depth > 0)
      shallow_[g] = (gear.compliance(0, depth_) - gear.compliance(0, gear.contact_depth()))(0, 0);
  }
  if (width != WidthModel::body) return;
  const ReducedBody* const bodies[] = {&driver, &driven};
  for (size_t g = 0; g < kSides; ++g)
    kernel_[g] = std::make_shared<const WidthKernel>(gears_.gear(static_cast<int>(g)), bodies[g]->width);
}

FaceContact FaceContact::with(int points, int degree) const {
  FaceContact out = *this;
  out.rule_ = gauss_rule(points);
  for (size_t g = 0; g < kSides; ++g)
    if (out.kernel_[g] && out.kernel_[g]->degree() > degree)
      out.kernel_[g] = std::make_shared<const WidthKernel>(gears_.gear(static_cast<int>(g)),
                                                           cut_to_degree(kernel_[g]->tables(), degree));
  return out;
}

bool FaceContact::inside(double path, double z) const {
  const double middle = 0.5 * (gears_.path_start() + gears_.path_end()),
               reach = 0.5 * kClearOfCorners * (gears_.path_end() - gears_.path_start());
  return std::abs(z) <= 0.5 * kClearOfCorners * gears_.face_width() && std::abs(path - middle) <= reach;
}

// Of a spur pair all pairs in reach, tip edges off the line of action too: every section is at the same place of its path.
std::vector<ContactLine> FaceContact::lines(double phase, double corner_gap, PairsInReach& reach) const {
  if (gears_.base_helix_angle() != 0) return contact_lines(gears_, phase);
  reach = pairs_in_reach(mesh(), phase, corner_gap);
  std::vector<ContactLine> out;
  out.reserve(reach.pair.size());
  const double half = 0.5 * gears_.face_width();
  for (const int pair : reach.pair) out.push_back({pair, -half, half});
  return out;
}

PairContact FaceContact::contact(const PairsInReach& reach, const ContactLine& line, double path) const {
  for (size_t i = 0; i < reach.pair.size(); ++i)
    if (reach.pair[i] == line.pair) return reach.contact[i];
  // Gauss points lie inside the line, a line within the path of contact.
  return mesh().kinematics.contact(std::clamp(path, gears_.path_start(), gears_.path_end()) /
                                   gears_.base_pitch());
}

FacePosition FaceContact::at(double phase, double corner_gap, double load) const {
  FacePosition out;
  out.phase = phase;
  PairsInReach reach;
  const std::vector<ContactLine> lines = this->lines(phase, corner_gap, reach);
  out.next_corner_gap = reach.next_corner_gap;
  out.lost_corner_gap = reach.lost_corner_gap;
  FacePoints& points = out.points;
  points = face_points(gears_, gap_, lines, phase, rule_);
  const double width = gears_.face_width();
  const Index n = points.size();
  for (VectorXd& of : out.roll) of.resize(n);
  out.gap.resize(n);
  out.law.reserve(static_cast<size_t>(n));
  out.contact.reserve(static_cast<size_t>(n));
  for (Index q = 0; q < n; ++q) {
    const PairContact contact = this->contact(
        reach, points.line[static_cast<size_t>(points.line_of(static_cast<int>(q)))], points.path[q]);
    const double along = points.weight[q] / cosine_;  // m, along the line
    const std::array<HalfPlaneSurface, 2> surface{mesh().gear[0].half_plane().of_width(along),
                                                  mesh().gear[1].half_plane().of_width(along)};
    const LinePoint point = make_line_point(mesh(), contact, surface, depth_,
                                            shared_force(load) / cosine_ * points.weight[q] / width, cosine_);
    out.gap[q] = point.gap + points.gap[q];
    out.law.push_back(point.law);
    for (size_t g = 0; g < kSides; ++g) out.roll[g][q] = point.roll[g];
    out.contact.push_back(contact);
  }
  add_sections(out);
  if (kernel_[0]) add_width(out);
  return out;
}

void FaceContact::add_sections(FacePosition& position) const {
  const std::array<VectorXd, 2>& roll = position.roll;
  const FacePoints& points = position.points;
  const int n = points.per_line, lines = static_cast<int>(points.line.size());
  position.compliance.setZero(points.size(), points.size());
  const double width = gears_.face_width(), unit = cosine_ * cosine_ * width;  // m
  const auto own = [&](int line) { return Eigen::seqN(static_cast<Index>(line) * n, n); };
  for (size_t g = 0; g < kSides; ++g) {
    const ElasticGear& gear = mesh().gear[g];
    const int most = static_cast<int>(table_[g].size()) / 2;
    // Of the width that a point stands for: m.
    const VectorXd plane = kernel_[g]
                               ? VectorXd(width * plane_share(gears_.gear(static_cast<int>(g)).base_radius(),
                                                              kernel_[g]->tables().helix, roll[g]))
                               : VectorXd::Constant(points.size(), unit);
    for (int q = 0; q < points.size(); ++q) {
      const Eigen::RowVectorXd row = gear.table().weights(roll[g][q]);
      position.compliance(q, q) +=
          plane[q] / points.weight[q] * row.dot(table_[g][static_cast<size_t>(most)] * row.transpose()) +
          (1 / cosine_ - 1) * plane[q] / points.weight[q] * shallow_[g];
    }
    if (kernel_[g]) continue;
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < i; ++j) {
        const int offset =
            GearMeshModel::tooth(static_cast<int>(g), points.line[static_cast<size_t>(i)].pair -
                                                          points.line[static_cast<size_t>(j)].pair);
        if (std::abs(offset) > most) continue;
        const int at = offset + most;
        const MatrixXd between =
            unit * between_sections(gear.table(), {points, i, roll[g]}, {points, j, roll[g]},
                                    table_[g][static_cast<size_t>(at)], rule_);
        position.compliance(own(i), own(j)) += between;
        position.compliance(own(j), own(i)) += between.transpose();
      }
  }
}

// Of all points on all lines.
void FaceContact::add_width(FacePosition& position) const {
  const std::array<VectorXd, 2>& roll = position.roll;
  const FacePoints& points = position.points;
  const int n = points.per_line, lines = static_cast<int>(points.line.size());
  const auto own = [&](int line) { return Eigen::seqN(static_cast<Index>(line) * n, n); };
  for (size_t g = 0; g < kSides; ++g) {
    const WidthKernel& kernel = *kernel_[g];
    MatrixXd functional;  // (functional, point)
    for (int q = 0; q < points.size(); ++q) {
      const VectorXd at = kernel.point(roll[g][q], points.z[q] + middle_[g]);
      if (q == 0) functional.resize(at.size(), points.size());
      functional.col(q) = at;
      position.compliance(q, q) += kernel.completion(roll[g][q], roll[g][q]) / points.weight[q];
    }
    for (int i = 0; i < lines; ++i)
      for (int j = 0; j < lines; ++j) {
        const int offset =
            GearMeshModel::tooth(static_cast<int>(g), points.line[static_cast<size_t>(i)].pair -
                                                          points.line[static_cast<size_t>(j)].pair);
        if (std::abs(offset) > kernel.offsets()) continue;
        position.compliance(own(i), own(j)) +=
            kernel.between(functional(Eigen::all, own(i)), functional(Eigen::all, own(j)), offset);
      }
  }
}

double FaceContact::unloaded_transmission_error(double phase, double corner_gap) const {
  const PairDeviation flanks = mesh().common_flanks();
  if (flanks.none() && gap_.none()) return 0;
  PairsInReach reach;
  double least = std::numeric_limits<double>::infinity();
  for (const ContactLine& line : lines(phase, corner_gap, reach)) {
    const auto closing = [&](double z) {  // m, of x
      const PairContact contact = this->contact(reach, line, path_at(gears_, phase + line.pair, z));
      const GearPair& section = mesh().kinematics;
      const double kinematic = section.gap_at(contact, section.nearest(contact, flanks), {});
      const double profile = section.gap_at(contact, section.nearest(contact, flanks), flanks) - kinematic;
      return (cosine_ * kinematic + profile + gap_.at(z)) * gears_.gear(0).base_radius() /
             (cosine_ * contact.lever[0]);
    };
    // The least of pieces of smooth functions: samples, then a search about the least of them.
    constexpr int kSamples = 32;
    const double step = line.length() / kSamples;
    double best = line.from, value = closing(best);
    for (int i = 1; i <= kSamples; ++i)
      if (const double here = closing(line.from + i * step); here < value) {
        value = here;
        best = line.from + i * step;
      }
    double low = std::max(line.from, best - step), high = std::min(line.to, best + step);
    for (int i = 0; i < 40; ++i) {
      const double a = low + (high - low) / 3, b = high - (high - low) / 3;
      (closing(a) < closing(b) ? high : low) = closing(a) < closing(b) ? b : a;
    }
    least = std::min({least, value, closing(0.5 * (low + high))});
  }
  return least;
}

}  // namespace whine
