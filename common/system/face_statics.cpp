#include "system/face_statics.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/format.h"
#include "base/model_range.h"
#include "base/progress.h"
#include "gear/hertz.h"
#include "system/compliance_split.h"
#include "system/face_contact.h"
#include "system/flank_pressure.h"
#include "system/rectangular_wave.h"
#include "system/statics.h"
#include "system/system_statics.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// One phase that is solved.
struct FaceSolution {
  FacePosition position;
  Equilibrium equilibrium;
  double unloaded = 0;  // m
};

// Where and by how much contact exceeds the range; "" if it does not.
std::string outside(const FaceSolution& at) {
  const double x = at.equilibrium.x, phase = at.position.phase;
  if (x > at.position.lost_corner_gap)
    fail_outside_range(Failure::numerical, "at mesh phase ", phase, " the deflection ", x * 1e6,
                       " micrometres closes the gap of a tip edge that would touch below the involute (gap ",
                       at.position.lost_corner_gap * 1e6,
                       " micrometres); lower the torque or set corner_contact = false");
  if (x <= at.position.next_corner_gap) return "";
  return text("at mesh phase ", phase, " the deflection ", x * 1e6,
              " micrometres closes a tip edge's gap of ", at.position.next_corner_gap * 1e6, " micrometres");
}

// m: as if each point gave way by itself under its share of the load.
double start_without_coupling(const FacePosition& p, double load) {
  double stiffness = 0;
  for (Index q = 0; q < p.points.size(); ++q) {
    const double share = load * p.points.weight[q] / p.points.weight.sum();
    stiffness += p.approach[q] * p.approach[q] /
                 (p.compliance(q, q) + p.law[static_cast<size_t>(q)].at(share).indentation / share);
  }
  return p.gap.minCoeff() + load / stiffness;
}

void require_small(const FaceContact& contact, double x, double torque) {
  constexpr double kMost = 0.25;  // modules
  const double most = kMost * contact.gears().gear(0).design().module;
  if (x > most)
    fail_outside_range(
        Failure::input, "at ", torque, " N m the transmission error is ", millimetres(x), ", above ",
        millimetres(most),
        ", a quarter of the module, up to which teeth may stand beside the place that the drawing gives them; lower the torque");
}

// start: m, of the transmission error; below 0: none is known.
FaceSolution solve_phase(const FaceContact& contact, double phase, double corner_gap, double load,
                         double start) {
  FaceSolution at;
  at.position = contact.at(phase, corner_gap, load);
  const FacePosition& p = at.position;
  if (start < 0) start = start_without_coupling(p, load);
  at.equilibrium = equilibrium(p.compliance, p.law, p.gap, p.approach, load, start);
  require_hertz_range(p.law, at.equilibrium.p);
  return at;
}

// All phases, with tip edges up to corner_gap (m) away; `beyond`: in words what that left out.
std::vector<FaceSolution> solve_phases(const FaceContact& contact, int positions, double corner_gap,
                                       double load, double torque, std::string& beyond) {
  std::vector<FaceSolution> out(static_cast<size_t>(positions));
  double start = -1;
  for (int i = 0; i < positions && beyond.empty(); ++i) {
    report_step("mesh positions", i, positions);
    const double phase = static_cast<double>(i) / positions;
    FaceSolution& at = out[static_cast<size_t>(i)];
    at = solve_phase(contact, phase, corner_gap, load, start);
    start = at.equilibrium.x;
    require_small(contact, start, torque);
    at.unloaded = contact.unloaded_transmission_error(phase, corner_gap);
    beyond = outside(at);
  }
  return out;
}

// m: half-width of the widest contact well inside.
double widest_contact(const FaceContact& contact, const std::vector<FaceSolution>& period) {
  double most = 0;
  for (const FaceSolution& at : period)
    for (Index q = 0; q < at.position.points.size(); ++q)
      if (at.equilibrium.p[q] > 0 && contact.inside(at.position.points.path[q], at.position.points.z[q]))
        most = std::max(most, 0.5 * at.position.law[static_cast<size_t>(q)].width(at.equilibrium.p[q]));
  return most;
}

// Degree that a contact of this half-width (m) allows on the common face.
int allowed_degree(const FaceContact& contact, double half_width, double torque) {
  constexpr int kLeast = 2;
  const double width = contact.gears().face_width();
  const int degree = degree_of_contact(width, half_width);
  if (degree < kLeast)
    fail_outside_range(
        Failure::input, "at ", torque, " N m the contact is ", millimetres(2 * half_width),
        " wide, and the common face ", millimetres(width), ": polynomials to degree ", degree,
        " alone, by P <= sqrt(b / 2a), hold no load over the face; lower the torque or write width = \"slices\"");
  return degree;
}

// m2 N-1: of local compliance (at the forces that it carries) and bodies between line loads, W^1/2 (C + law') W^1/2 with the weights W.
double least_eigenvalue(const FaceSolution& at) {
  const FacePoints& points = at.position.points;
  MatrixXd whole = at.position.compliance;
  for (Index q = 0; q < points.size(); ++q)
    whole(q, q) += at.position.law[static_cast<size_t>(q)].at(at.equilibrium.p[q]).slope;
  const VectorXd root = points.weight.cwiseSqrt();
  whole = root.asDiagonal() * whole * root.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(whole, Eigen::EigenvaluesOnly).eigenvalues()[0];
}

// Of each tooth pair at one phase.
void store_lines(const FaceContact& contact, const FaceSolution& at, Index row, StaticResult& result) {
  const FacePoints& points = at.position.points;
  const double cosine = std::cos(contact.gears().base_helix_angle());
  FaceLoad& face = result.face;
  const int n = points.per_line;
  const auto i = static_cast<size_t>(row);
  for (MatrixRM* m : {&face.line_load[i], &face.position[i], &face.width[i]})
    m->setZero(result.pair.size(), n);
  for (Index line = 0; line < static_cast<Index>(points.line.size()); ++line) {
    const Index k = points.line[static_cast<size_t>(line)].pair - result.pair[0];
    const auto own = Eigen::seqN(line * n, n);
    face.line_load[i].row(k) = (at.equilibrium.p(own).array() / points.weight(own).array()).transpose();
    face.position[i].row(k) = points.z(own).transpose();
    face.width[i].row(k) = points.weight(own).transpose();
    result.tooth_load(row, k) = at.equilibrium.p(own).sum();
    for (Index q = line * n; q < (line + 1) * n; ++q) {
      const double force = at.equilibrium.p[q];
      const HertzLine& law = at.position.law[static_cast<size_t>(q)];
      if (!(force > 0) || law.at_edge(force)) continue;
      const double width = law.width(force),
                   pressure = 4 * force * cosine / (std::numbers::pi * width * points.weight[q]);
      if (pressure <= result.contact_pressure(row, k)) continue;
      result.contact_pressure(row, k) = pressure;
      result.contact_half_width(row, k) = 0.5 * width;
    }
  }
  face.contact_line_length[row] = 0;
  for (const ContactLine& line : points.line) face.contact_line_length[row] += line.length() / cosine;
}

// K_Hbeta of the reference pair where it has a line, else 0.
double load_factor(const FaceContact& contact, const FaceSolution& at) {
  const FacePoints& points = at.position.points;
  const int n = points.per_line;
  for (Index line = 0; line < static_cast<Index>(points.line.size()); ++line) {
    if (points.line[static_cast<size_t>(line)].pair != 0) continue;
    const auto own = Eigen::seqN(line * n, n);
    const VectorXd load = at.equilibrium.p(own).array() / points.weight(own).array();
    return face_load_factor(points.z(own), points.weight(own), load, points.line[static_cast<size_t>(line)],
                            contact.degree() > 0 ? kInnerFace : 1);
  }
  return 0;
}

// What K_Hbeta at phase 0 changes by with half as many points more, and with two degrees less.
double load_factor_error(const FaceContact& contact, double factor, double corner_gap, double load,
                         double start) {
  const auto change = [&](int points, int degree) {
    const FaceContact other = contact.with(points, degree);
    return std::abs(load_factor(other, solve_phase(other, 0, corner_gap, load, start)) - factor);
  };
  double sum = change(contact.points() + contact.points() / 2, contact.degree());
  if (contact.degree() > 0) sum += change(contact.points(), contact.degree() - 2);
  return sum;
}

// What is true of the whole period.
void store_face(const FaceContact& contact, const std::vector<FaceSolution>& period, double corner_gap,
                StaticResult& result) {
  FaceLoad& face = result.face;
  const GearPair& gears = contact.gears();
  face.overlap_ratio = gears.overlap_ratio();
  face.axial_force = helical_forces(gears, result.torque).axial;
  face.degree = contact.degree();
  face.load_factor = load_factor(contact, period[0]);
  face.load_factor_error =
      load_factor_error(contact, face.load_factor, corner_gap, result.torque / gears.gear(0).base_radius(),
                        period[0].equilibrium.x);
  double lost = 0;  // N m rad-1
  for (const FaceSolution& at : period)
    for (Index q = 0; q < at.position.points.size(); ++q) {
      const FacePoints& p = at.position.points;
      const double force = at.equilibrium.p[q],
                   path = std::clamp(p.path[q], gears.path_start(), gears.path_end());
      lost += force * std::abs(gears.sliding(path));
      if (contact.inside(p.path[q], p.z[q]))
        face.line_load_max = std::max(face.line_load_max, force / p.weight[q]);
    }
  result.loss_factor = lost / (static_cast<double>(period.size()) * result.torque);
}

StaticResult result_of(const FaceContact& contact, const std::vector<FaceSolution>& period,
                       const ReducedBody& driver, const ReducedBody& driven, const StaticParameters& settings,
                       double torque, double corner_gap) {
  StaticResult out;
  set_pair(out, {driver, driven}, settings);
  out.fidelity.contact = ContactModel::line;
  out.torque = torque;
  out.contact_ratio = contact.gears().contact_ratio();
  const auto positions = static_cast<Index>(period.size());
  for (VectorXd* v : {&out.mesh_phase, &out.transmission_error, &out.unloaded_error, &out.stiffness_secant,
                      &out.stiffness_tangent, &out.face.contact_line_length})
    v->resize(positions);
  int lowest = -1, highest = 1;
  for (const FaceSolution& at : period)
    for (const ContactLine& line : at.position.points.line) {
      lowest = std::min(lowest, line.pair);
      highest = std::max(highest, line.pair);
    }
  out.pair = Eigen::VectorXi::LinSpaced(highest - lowest + 1, lowest, highest);
  out.tooth_load = MatrixRM::Zero(positions, out.pair.size());
  out.contact_pressure = out.contact_half_width = out.tooth_load;
  for (std::vector<MatrixRM>* list : {&out.face.line_load, &out.face.position, &out.face.width})
    list->resize(period.size());
  out.least_gap = out.least_force = out.face.least_eigenvalue = std::numeric_limits<double>::infinity();
  const double load = torque / contact.gears().gear(0).base_radius();
  for (Index i = 0; i < positions; ++i) {
    const FaceSolution& at = period[static_cast<size_t>(i)];
    const Equilibrium& e = at.equilibrium;
    out.mesh_phase[i] = static_cast<double>(i) / static_cast<double>(positions);
    out.transmission_error[i] = e.x;
    out.unloaded_error[i] = at.unloaded;
    out.stiffness_secant[i] = load / (e.x - at.unloaded);
    out.stiffness_tangent[i] = e.stiffness;
    out.torque_residual = std::max(out.torque_residual, e.residual);
    out.least_gap = std::min(out.least_gap, e.certificate.least_gap);
    out.least_force = std::min(out.least_force, e.certificate.least_force);
    out.face.least_eigenvalue = std::min(out.face.least_eigenvalue, least_eigenvalue(at));
    store_lines(contact, at, i, out);
  }
  out.mean_stiffness = out.stiffness_secant.mean();
  if (!(out.face.least_eigenvalue > 0))
    fail(Failure::numerical, "at ", torque, " N m the compliance of ", contact.points(),
         " points along each line and polynomials to degree ", contact.degree(),
         " is not positive definite (least eigenvalue ", out.face.least_eigenvalue,
         " m2/N); write a smaller width_degree in [discretisation], or another number of face_points");
  store_face(contact, period, corner_gap, out);
  out.backlash_margin = out.tooth_thinning() > 0
                            ? contact.gears().backlash() + out.transmission_error.minCoeff()
                            : std::numeric_limits<double>::infinity();
  out.compliance = compliance_split(out);
  out.flank_pressure = flank_pressure(out);
  out.rectangular_wave = rectangular_wave(out);
  out.remarks = remarks(out);
  return out;
}

}  // namespace

StaticResult face_transmission(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticParameters& settings, double torque) {
  const int points = face_points_of(settings.mesh, settings.contact);
  FaceContact contact(driver, driven, settings.mesh, settings.fidelity.width, points);
  const double load = torque / contact.gears().gear(0).base_radius();
  if (contact.degree() > 0) {
    StaticResult pair;
    set_pair(pair, {driver, driven}, settings);
    contact = contact.with(points, allowed_degree(contact, hertz_contact(pair, load).half_width, torque));
  }
  double widening = 1;
  for (int attempt = 0;;) {
    std::string beyond;
    const double corner_gap = reach_of_edges(contact.mesh(), load) * widening;
    const std::vector<FaceSolution> period =
        solve_phases(contact, settings.contact.positions, corner_gap, load, torque, beyond);
    if (beyond.empty()) {
      const int allowed =
          contact.degree() > 0 ? allowed_degree(contact, widest_contact(contact, period), torque) : 0;
      if (contact.degree() <= allowed)
        return result_of(contact, period, driver, driven, settings, torque, corner_gap);
      contact = contact.with(points, allowed);
      continue;
    }
    if (attempt == kWidenings)
      fail_outside_range(Failure::numerical, "at ", torque,
                         " N m contact leaves the flanks: tip edges up to ", corner_gap * 1e6,
                         " micrometres away, and still ", beyond, "; lower the torque");
    ++attempt;
    widening *= kWidening;
  }
}

SystemStaticResult face_at_rest(const ReducedBody& driver, const ReducedBody& driven,
                                const StaticParameters& settings, double torque) {
  SystemStaticResult out;
  const StaticResult& mesh = out.mesh.emplace_back(face_transmission(driver, driven, settings, torque));
  const GearPair gears(mesh);
  const double force = torque / gears.gear(0).base_radius();
  const Index phases = mesh.mesh_phase.size();
  out.mesh_phase = mesh.mesh_phase;
  out.rotation = out.torque = MatrixRM::Zero(phases, kSides);
  out.rotation.col(0) = mesh.transmission_error;
  out.torque.col(0).setConstant(torque);
  out.torque.col(1).setConstant(-force * gears.gear(1).base_radius());
  out.mesh_deflection = mesh.transmission_error;
  out.mesh_force = MatrixRM::Constant(phases, 1, force);
  out.load_share = MatrixRM::Ones(phases, 1);
  out.translation.assign(static_cast<size_t>(phases), MatrixRM::Zero(kSides, 2));
  MatrixRM bearings(kSides, 2);
  bearings << -force * contact_normal(gears).transpose(), force * contact_normal(gears).transpose();
  out.bearing_force.assign(static_cast<size_t>(phases), bearings);
  out.least_gap = mesh.least_gap;
  out.least_force = mesh.least_force;
  out.torque_residual = mesh.torque_residual;
  out.backlash_margin = mesh.backlash_margin;
  return out;
}

}  // namespace whine
