// One gear of a rolling mesh: its flexibility and its modes at the flanks.
#include "system/rolling_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/face_width.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// A number that is none would reach some loads and not others.
const ReducedBody& finite(const ReducedBody& body) {
  const auto require = [](const auto& numbers, const std::string& name) {
    if (!numbers.allFinite())
      fail(Failure::input, "the body's ", name, " holds a number that is not finite; rebuild body.h5");
  };
  require(body.flank_position, "flank_position");
  require(body.flank_mode, "flank_mode");
  require(body.eigenfrequency, "eigenfrequency");
  require(body.inertia_coupling, "inertia_coupling");
  require(body.far_compliance, "compliance between teeth far apart");
  require(body.back_compliance, "compliance of the back flanks");
  require(body.crack_compliance, "compliance of its crack");
  require(body.crack_root_stress, "root stress of its crack");
  for (size_t d = 0; d < body.compliance.size(); ++d)
    require(body.compliance[d], text("compliance at tooth offset ", d));
  return body;
}

}  // namespace

ElasticGear::ElasticGear(const ReducedBody& body, ContactPlane contact_plane)
    : body_(std::make_shared<const ReducedBody>(finite(body))),
      half_plane_(in_contact_plane(body.material, contact_plane), body.design.face_width),
      body_half_plane_(body.material, body.design.face_width),
      contact_material_(in_contact_plane(body.material, contact_plane)),
      own_surface_(contact_material_.plane_stress != body.material.plane_stress),
      table_(ToothGeometry(body.design), static_cast<int>(body.flank_position.size())) {
  if ((table_.points() - body.flank_position).cwiseAbs().maxCoeff() > 1e-12)
    fail(Failure::input,
         "the body's flank positions are not those of this program's flank table; rebuild body.h5");
}

ElasticGear ElasticGear::in_mesh(double contact_width) const {
  const GearDesign& design = body_->design;
  ElasticGear out = *this;
  if (contact_width >= design.face_width) return out;
  out.half_plane_ = HalfPlaneSurface(contact_material_, contact_width);
  out.own_surface_ = true;
  out.concentration_ = design.face_width / carrying_width(design, contact_width);
  return out;
}

double ElasticGear::contact_depth() const {
  return body_->discretisation.near_field == NearField::matching
             ? body_->discretisation.matching_depth
             : 0.25 * std::numbers::pi * body_->design.module;
}

double ElasticGear::plane_change(double x, double half_width, double reading) const {
  if (!own_surface_) return 0;
  return half_plane_.mean_over_strip(x, half_width, reading, contact_depth()) -
         body_half_plane_.mean_over_strip(x, half_width, reading, contact_depth());
}

MatrixXd ElasticGear::compliance(int offset, double depth) const {
  const int distance = std::abs(offset), n = table_size();
  const bool near = distance <= body_->offsets;
  const auto far = static_cast<Eigen::Index>(distance - body_->offsets - 1) * n;  // first row there
  if (!near && far + n > body_->far_compliance.rows()) return MatrixXd::Zero(n, n);
  MatrixXd r =
      near ? body_->compliance[static_cast<size_t>(distance)] : body_->far_compliance.middleRows(far, n);
  if (offset < 0) r.transposeInPlace();  // reciprocity: R_-d = R_d^T
  if (offset != 0) return r;
  const double from = own_surface_ ? contact_depth() : body_->reference_depth;
  if (own_surface_) r.array() += body_half_plane_.coefficient() * std::log(body_->reference_depth / from);
  if (concentration_ > 1) r += narrow_change();
  r.array() += half_plane_.coefficient() * std::log(from / depth);
  return r;
}

MatrixXd ElasticGear::narrow_change() const {
  const int n = table_size();
  if (!(concentration_ > 1)) return MatrixXd::Zero(n, n);
  const MatrixXd next = compliance(1, contact_depth());
  MatrixXd tooth = body_->compliance[0] - 0.5 * (next + next.transpose());
  tooth.array() += body_half_plane_.coefficient() * std::log(body_->reference_depth / contact_depth());
  return (concentration_ - 1) * tooth;
}

MatrixXd ElasticGear::compliance(const ToothFlank& read, const ToothFlank& loaded, double depth) const {
  const int teeth = body_->design.teeth, n = table_size();
  // Seen in a mirror, a force on a trailing flank is one on a leading flank, and offsets count the other way.
  const int turn = loaded.side == FlankSide::leading ? 1 : -1;
  const int ahead = ((turn * (read.tooth - loaded.tooth)) % teeth + teeth) % teeth;
  if (read.side != loaded.side) return body_->back_compliance.middleRows(ahead * n, n);
  return compliance(2 * ahead > teeth ? ahead - teeth : ahead, depth);
}

MatrixXd ElasticGear::residual(int offset, double depth, const std::vector<int>& kept) const {
  if (std::abs(offset) > body_->offsets) return MatrixXd::Zero(table_size(), table_size());
  MatrixXd r = compliance(offset, depth);
  for (int column : kept) {
    const double w = 2 * std::numbers::pi * body_->eigenfrequency[column];
    r -= mode_on_tooth(column, offset) * mode_on_tooth(column, 0).transpose() / (w * w);
  }
  return r;
}

MatrixXd ElasticGear::of_crack(const MatrixRM& table, Eigen::Index rows, int read, int loaded) const {
  const int teeth = body_->design.teeth, n = table_size();
  const auto place = [&](int tooth) {  // among the stored teeth; beyond their number if not there
    const int from = (tooth - body_->design.crack.tooth + body_->offsets) % teeth;
    return from < 0 ? from + teeth : from;
  };
  const int row = place(read), column = place(loaded);
  if (table.size() == 0 || row > 2 * body_->offsets || column > 2 * body_->offsets) return {};
  // The crack is in the tooth.
  return concentration_ * table.block(row * rows, column * n, rows, n);
}

MatrixXd ElasticGear::crack_compliance(int read, int loaded) const {
  return of_crack(body_->crack_compliance, table_size(), read, loaded);
}

MatrixXd ElasticGear::crack_root_stress(int read, int loaded) const {
  return of_crack(body_->crack_root_stress, body_->root_angle.size(), read, loaded);
}

int ElasticGear::partner(int column) const {
  const int n = body_->nodal_diameter[column];
  if (n == 0 || 2 * n == body_->design.teeth) return column;
  return body_->component[column] == 0 ? column + 1 : column - 1;
}

double ElasticGear::tooth_angle(int column) const {
  return 2 * std::numbers::pi * body_->nodal_diameter[column] / body_->design.teeth;
}

VectorXd ElasticGear::mode_on_tooth(int column, int tooth) const {
  const double angle = tooth_angle(column) * tooth;
  const int other = partner(column);
  if (other == column) return std::cos(angle) * body_->flank_mode.col(column);
  // exp(i n theta) (re + i im): the cosine column takes the real part, the sine column the imaginary part.
  const double sign = body_->component[column] == 0 ? -1 : 1;
  return std::cos(angle) * body_->flank_mode.col(column) +
         sign * std::sin(angle) * body_->flank_mode.col(other);
}

}  // namespace whine
