#include "system/system_statics.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/format.h"
#include "base/model_range.h"
#include "base/progress.h"
#include "gear/involute_start.h"
#include "gear/layout.h"
#include "system/face_mesh.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double kStripsDepth = 1e-3;  // m: statics do not depend on it, near field and far field cancel it

// [mesh] N: what contact is looked for with; of a mesh without load a thousandth of the largest.
VectorXd loads_of_ranges(const SystemModel& system) {
  const VectorXd loads = mesh_loads(system);
  return loads.cwiseMax(1e-3 * loads.maxCoeff());
}

// Of the pairs of a mesh the gear, side 0 or 1, whose involute ends at its root where force stands; -1: none does.
int side_of_strips(const GearPair& gears, const MeshPosition& mesh, const VectorXd& p) {
  constexpr double kNowhere = std::numeric_limits<double>::infinity();
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    const PairStrips& pair = mesh.pairs[j];
    const bool low = !pair.low_is_edge && p[mesh.first_strip[j]] > 0,
               high = !pair.high_is_edge && p[mesh.first_strip[j + 1] - 1] > 0;
    if (!low && !high) continue;
    const int side = side_at_root(gears, pair.contact, low ? pair.border[0] : kNowhere,
                                  high ? pair.border[pair.border.size() - 1] : -kNowhere);
    if (side >= 0) return side;
  }
  return -1;
}

// The same of lines: whose width reaches beyond the start of an involute. Deviations of flanks move a contact by less than its width,
// which is left out.
int side_of_lines(const GearPair& gears, const MeshPosition& mesh, const VectorXd& p) {
  for (size_t j = 0; j < mesh.pairs.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    if (!(p[i] > 0)) continue;
    const PairContact& contact = mesh.pairs[j].contact;
    const double width = mesh.law[j].width(p[i]), driver_tip = gears.edge_distance(contact, 0),
                 driven_tip = gears.edge_distance(contact, 1);
    double low = -0.5 * width, high = 0.5 * width;
    if (contact.corner || mesh.law[j].at_edge(p[i])) {
      const bool driver = contact.corner ? contact.end() == 0 : driver_tip < driven_tip;
      const double edge = contact.corner ? 0 : driver ? driver_tip : -driven_tip;
      low = driver ? edge - width : edge;
      high = low + width;
    }
    if (const int side = side_at_root(gears, contact, low, high); side >= 0) return side;
  }
  return -1;
}

// The range would have to be wider, whatever else is wrong.
bool wants_more(const SystemSolution& solution) {
  bool out = solution.leaves_zone;
  for (size_t m = 0; m < solution.deflection.size(); ++m)
    out = out || solution.deflection[m] > solution.next_corner_gap[m];
  return out;
}
}  // namespace

double reach_of_edges(const GearMeshModel& mesh, double load) {
  // Of the compliance of a pair of teeth: steel with a face of 25 mm, or half of what the half-planes say of softer and narrower ones.
  constexpr double kSteel = 8e-9, kHalfPlanes = 8;  // m N-1; 1
  const double surfaces = mesh.gear[0].half_plane().coefficient() + mesh.gear[1].half_plane().coefficient();
  return 1e-6 + std::max(kSteel, kHalfPlanes * surfaces) * load;
}

std::vector<CandidateZone> static_zones(const SystemModel& system, int strips, double zone, double widening) {
  const VectorXd loads = loads_of_ranges(system);
  std::vector<CandidateZone> out;
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const GearMeshModel& mesh = system.mesh[m];
    const double load = loads[static_cast<Eigen::Index>(m)];
    double errors = 0;  // m: what teeth that differ may add to the transmission error
    for (const FlankDeviation& flank : mesh.deviation)
      if (flank.repeats() > 1) errors += std::max(0.0, flank.largest());
    out.push_back(candidate_zone(mesh.kinematics, mesh.gear[0].half_plane(), mesh.gear[1].half_plane(),
                                 strips, load / mesh.kinematics.contact_ratio(),
                                 1.1 * load * zone * zone * widening,
                                 reach_of_edges(mesh, load) * widening + errors, mesh.flanks()));
  }
  return out;
}

std::string outside_zone(const SystemSolution& solution, double phase) {
  if (!solution.at_root.empty())
    return text("at mesh phase ", phase, " the pressure reaches the start of the involute of '",
                solution.at_root,
                "', which its mate's tip comes too close to: shorten that tip or deepen the root (dedendum)");
  if (solution.leaves_zone)
    return text("at mesh phase ", phase, " the pressure reaches the candidate zone's end");
  for (size_t m = 0; m < solution.deflection.size(); ++m) {
    const double deflection = solution.deflection[m];
    if (deflection > solution.lost_corner_gap[m])
      fail_outside_range(
          Failure::numerical, "at mesh phase ", phase, " the deflection ", deflection * 1e6,
          " micrometres closes the gap of a tip edge that would touch below the involute (gap ",
          solution.lost_corner_gap[m] * 1e6, " micrometres); lower the torque or set corner_contact = false");
    if (deflection > solution.next_corner_gap[m])
      return text("at mesh phase ", phase, " the deflection ", deflection * 1e6,
                  " micrometres closes a tip edge's gap of ", solution.next_corner_gap[m] * 1e6,
                  " micrometres");
  }
  return "";
}

namespace {

// In words: the zones of the loaded meshes.
std::string range_words(const std::vector<CandidateZone>& ranges) {
  const CandidateZone& widest = *std::max_element(
      ranges.begin(), ranges.end(), [](const auto& a, const auto& b) { return a.half_zone < b.half_zone; });
  // Beyond, no tip edge is that far from a flank.
  const bool edges = widest.corner_gap < 1e-3;
  return text("candidate zone ", widest.half_zone * 1e3, " mm either side",
              edges ? text(", tip edges up to ", widest.corner_gap * 1e6, " micrometres away") : "");
}

double largest_torque(const SystemModel& system) {
  double torque = 0;
  for (const System::Drive& drive : system.layout.drives) torque = std::max(torque, std::abs(drive.torque));
  return torque;
}

}  // namespace

void over_period(const SystemModel& system, ContactModel contact, int strips, int positions, double zone,
                 const TakeRest& take) {
  const int periods = hunting_periods(system), all = positions * periods;
  double widening = 1;
  for (int attempt = 0;; ++attempt, widening *= kWidening) {
    const std::vector<CandidateZone> ranges = static_zones(system, strips, zone, widening);
    SystemStatics statics(system, contact, ranges);
    std::string beyond;
    bool widened = true;  // whether a wider range may do
    std::vector<VectorXd> start(static_cast<size_t>(periods),
                                VectorXd::Zero(static_cast<Eigen::Index>(system.layout.bodies.size())));
    // All mesh periods at one position after the other: all but the gaps is the same there.
    for (int step = 0; step < all && beyond.empty(); ++step) {
      report_step("mesh positions", step, all);
      const int period = step % periods, position = step / periods;
      const double phase = static_cast<double>(position) / positions;
      VectorXd& from = start[static_cast<size_t>(period)];
      const SystemSolution& at = statics.solve(phase, period, from);
      from = at.equilibrium.x;
      beyond = outside_zone(at, phase + period);
      widened = at.at_root.empty() || wants_more(at);
      if (beyond.empty()) take({step, period * positions + position, period, phase}, at, statics);
    }
    if (beyond.empty()) return;
    if (attempt == kWidenings || !widened)
      fail_outside_range(Failure::numerical, "at ", largest_torque(system),
                         " N m contact leaves the flanks: ", range_words(ranges), ", and still ", beyond,
                         "; lower the torque", periods > 1 ? " or the errors of the teeth" : "");
  }
}

std::vector<SystemSolution> rest_over_period(const SystemModel& system, ContactModel contact, int strips,
                                             int positions) {
  std::vector<SystemSolution> out(static_cast<size_t>(positions) *
                                  static_cast<size_t>(hunting_periods(system)));
  over_period(system, contact, strips, positions, 1,
              [&](const RestStep& step, const SystemSolution& solution, const SystemStatics& statics) {
                SystemSolution& at = out[static_cast<size_t>(step.row)];
                at = solution;
                at.mesh_stiffness = statics.mesh_stiffness();
              });
  return out;
}

SystemStatics::SystemStatics(const SystemModel& system, ContactModel contact,
                             std::vector<CandidateZone> range)
    : system_(system), lines_(contact == ContactModel::line), alike_(true), range_(std::move(range)) {
  const VectorXd load = loads_of_ranges(system);
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    // The half candidate zone is Hertz's half-width under the whole load: the laws of lines rise over all of it, and the
    // tables keep what lies deeper. Slices have their own depth.
    depth_.push_back(!system.face.empty() ? system.face[m]->depth()
                     : lines_             ? 3 * range_[m].half_zone
                                          : kStripsDepth);
    load_.push_back(load[static_cast<Eigen::Index>(m)]);
    for (const FlankDeviation& flank : system.mesh[m].deviation) alike_ = alike_ && flank.repeats() == 1;
  }
  tables_ = compliance_tables(system, depth_);
}

namespace {

// The compliance of all strips, and its factor.
void require_strips(double strips) {
  constexpr double kMostMemory = 2e9;  // bytes
  const double memory = 2 * 8 * strips * strips;
  if (memory > kMostMemory)
    fail(
        Failure::input, "contact is looked for on ", strips, " strips, whose compliance needs ",
        memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
        " are allowed: under this load contact is that narrow beside what flanks and teeth deviate by; raise the torque, lower strips, or set contact = \"line\"");
}

}  // namespace

void SystemStatics::take_position(double phase, int period) {
  const bool here = position_ && position_->phase == phase;
  if (here && (period == period_ || alike_) && !lines_) return;
  std::vector<MeshPosition> meshes;
  for (size_t m = 0; m < system_.mesh.size(); ++m) {
    const MeshInstant at = mesh_instant(system_, static_cast<int>(m), phase, period);
    const GearMeshModel& mesh = system_.mesh[m];
    if (!system_.face.empty()) {
      meshes.push_back(face_mesh_position(*system_.face[m], at.phase, range_[m].corner_gap, load_[m]));
      continue;
    }
    meshes.push_back(lines_ ? make_line_position(mesh, at.phase, range_[m].corner_gap, depth_[m],
                                                 shared_force(load_[m]), at.period)
                     : here ? position_->mesh[m]
                            : make_position(mesh, at.phase, range_[m]));
    if (!lines_ && !alike_) meshes[m].gap = flank_gaps(mesh, meshes[m], at.period);
  }
  position_ = join(system_, phase, period, std::move(meshes));
  period_ = period;
  if (here) return;
  require_strips(position_->strips());
  repeats_ = false;
  compliance_ = contact_compliance(system_, *position_, tables_, depth_);
  if (lines_) return;
  // A contact that happens to end on a sound part of a broken table would look right.
  const double least = compliance_.allFinite() ? compliance_.ldlt().vectorD().minCoeff()
                                               : std::numeric_limits<double>::quiet_NaN();
  if (least > 0) return;
  bool soft_rim = false;
  for (const auto& gear : system_.body) soft_rim = soft_rim || (gear && gear->body().design.elastic_rim());
  fail(
      Failure::numerical, "at mesh phase ", phase, " the compliance of ", position_->strips(),
      " strips is not positive definite: pivot ", least, " m/N; ",
      soft_rim
          ? "raise rim_radial_stiffness_N_mm2 and rim_tangential_stiffness_N_mm2, or lower element_mm: the rim moves so much as a whole that the error of the body's table hides what its teeth do"
          : "the body's table is wrong, rebuild body.h5");
}

const SystemSolution& SystemStatics::solve(double phase, int period, const VectorXd& start) {
  take_position(phase, period);
  const SystemPosition& position = *position_;
  if (system_.cracked()) {
    with_cracks_ = compliance_;
    cracked_here_ = add_cracks(system_, position, period, with_cracks_);
  }
  if (repeats_ && !cracked_here_) return solution_;
  SystemSolution solution;
  solution.equilibrium =
      equilibrium(system_, position, cracked_here_ ? with_cracks_ : compliance_, start, solver_);
  for (size_t b = 0; b < system_.layout.bodies.size(); ++b)
    solution.bearing_force.push_back(
        bearing_force(system_, position, static_cast<int>(b), solution.equilibrium.p));
  if (!system_.face.empty()) solution.axial = axial_loads(system_, position, solution.equilibrium.p);
  for (size_t m = 0; m < position.mesh.size(); ++m) {
    const int number = static_cast<int>(m);
    const VectorXd own = solution.equilibrium.p(position.strips_of(m));
    const auto moment = [&](size_t side) {
      return closing_sign(static_cast<int>(side)) *
             position.load.rotation.col(system_.mesh[m].layout.side[side].body)(position.strips_of(m))
                 .dot(own);
    };
    solution.driving_force.push_back(moment(0));
    solution.driven_force.push_back(moment(1));
    solution.transmission_error.push_back(solution.equilibrium.transmission_error(system_, number));
    solution.deflection.push_back(mesh_deflection(system_, position, solution.equilibrium, number));
    solution.next_corner_gap.push_back(position.mesh[m].next_corner_gap);
    solution.lost_corner_gap.push_back(position.mesh[m].lost_corner_gap);
  }
  solution.friction_work.assign(position.mesh.size(), 0);
  for (const ContactSegment& segment : position.segment) {
    if (!system_.slides()) break;
    const auto m = static_cast<size_t>(segment.mesh);
    const double force = solution.equilibrium.p.segment(segment.first_strip, segment.strips).sum(),
                 turned = 2 * std::numbers::pi / system_.mesh[m].kinematics.gear(0).design().teeth;
    solution.friction_work[m] += system_.friction[m] * force * segment.sliding.loss() * turned;
  }
  require_small(solution);
  lines_ ? take_lines(solution) : take_strips(solution);
  solution_ = std::move(solution);
  repeats_ = alike_ && !cracked_here_ && !lines_;
  return solution_;
}

// Gears are taken to stand where the drawing has them: displacements are small against the teeth.
void SystemStatics::require_small(const SystemSolution& solution) const {
  constexpr double kMost = 0.25;  // modules
  const auto& bodies = system_.layout.bodies;
  const double torque = largest_torque(system_);
  const bool elastic = std::any_of(bodies.begin(), bodies.end(),
                                   [](const System::Body& body) { return body.bearing.elastic(); });
  const auto require = [&](double moved, const GearMeshModel& mesh, const auto&... what) {
    const double most = kMost * mesh.kinematics.gear(0).design().module;
    if (moved > most)
      fail_outside_range(
          Failure::input, "at ", torque, " N m ", what..., " is ", millimetres(moved), ", above ",
          millimetres(most),
          ", a quarter of the module, up to which teeth may stand beside the place that the drawing gives them; lower the torque",
          elastic ? ", or raise stiffness_N_um in [[bearing]]" : "");
  };
  for (size_t m = 0; m < system_.mesh.size(); ++m)
    require(solution.transmission_error[m], system_.mesh[m], "the transmission error of ",
            mesh_name(system_.layout, m));
  for (size_t b = 0; b < bodies.size(); ++b)
    if (const System::Body& body = bodies[b]; body.bearing.elastic())
      require(solution.bearing_force[b].norm() / body.bearing.stiffness, system_.mesh[0],
              "the displacement of '", body.name, "' on its bearing");
}

void SystemStatics::note_root(SystemSolution& solution, size_t m, int side) const {
  if (side < 0) return;
  const int body = system_.mesh[m].layout.side[static_cast<size_t>(side)].body;
  solution.at_root = system_.layout.bodies[static_cast<size_t>(body)].name;
}

void SystemStatics::take_strips(SystemSolution& solution) const {
  const VectorXd& p = solution.equilibrium.p;
  for (size_t m = 0; m < position_->mesh.size(); ++m) {
    const VectorXd own = p(position_->strips_of(m));
    solution.leaves_zone = solution.leaves_zone || position_->mesh[m].reaches_zone_end(own);
    note_root(solution, m, side_of_strips(system_.mesh[m].kinematics, position_->mesh[m], own));
  }
  for (const ContactSegment& segment : position_->segment) {
    const auto own = p.segment(segment.first_strip, segment.strips);
    const MeshPosition& mesh = position_->mesh[static_cast<size_t>(segment.mesh)];
    const auto strips = std::find_if(mesh.pairs.begin(), mesh.pairs.end(),
                                     [&](const PairStrips& of) { return of.pair == segment.pair; });
    solution.loads.push_back(
        {segment.mesh, segment.pair, own.sum(), contact_patch(*strips, own, segment.width)});
  }
}

// Pressures in the corners where a helical line comes in have no limit in a line model.
bool SystemStatics::stated(const ContactSegment& segment) const {
  const auto m = static_cast<size_t>(segment.mesh);
  if (system_.face.empty() || system_.face[m]->gears().base_helix_angle() == 0) return true;
  const FacePoints& points = position_->mesh[m].face->points;
  const int q = segment.first_strip - position_->first_strip[m];
  return system_.face[m]->inside(points.path[q], points.z[q]);
}

void SystemStatics::take_lines(SystemSolution& solution) const {
  const VectorXd& force = solution.equilibrium.p;
  for (size_t m = 0; m < position_->mesh.size(); ++m) {
    const VectorXd own = force(position_->strips_of(m));
    require_line_range(position_->mesh[m], own);
    note_root(solution, m, side_of_lines(system_.mesh[m].kinematics, position_->mesh[m], own));
  }
  for (const ContactSegment& segment : position_->segment) {
    const auto mesh = static_cast<size_t>(segment.mesh);
    const int strip = segment.first_strip;
    const HertzLine& law =
        position_->mesh[mesh].law[static_cast<size_t>(strip - position_->first_strip[mesh])];
    const double width = law.width(force[strip]);
    ContactPatch patch;
    if (force[strip] > 0 && !law.at_edge(force[strip]) && stated(segment))
      patch = {4 * force[strip] / (std::numbers::pi * width * segment.width), 0.5 * width};
    solution.loads.push_back({segment.mesh, segment.pair, force[strip], patch});
  }
}

MatrixXd SystemStatics::mesh_stiffness() const {
  const SystemPosition& position = *position_;
  const VectorXd& p = solution_.equilibrium.p;
  const auto meshes = static_cast<Eigen::Index>(position.mesh.size());
  // Where a mesh without load touches is a matter of round-off.
  const std::vector<double>& force = solution_.driving_force;
  const double least = 1e-9 * *std::max_element(force.begin(), force.end());
  std::vector<Eigen::Index> active;
  for (size_t m = 0; m < position.mesh.size(); ++m)
    for (int i = position.first_strip[m]; i < position.first_strip[m + 1]; ++i)
      if (p[i] > 0 && force[m] > least) active.push_back(i);
  MatrixXd a = cracked_here_ ? with_cracks_ : compliance_;
  for (size_t b = 0; b < system_.layout.bodies.size(); ++b)
    if (const Bearing& bearing = system_.layout.bodies[b].bearing;
        bearing.elastic() && !system_.floats(static_cast<int>(b)))
      a -= position.displacement.translation[b] * position.displacement.translation[b].transpose() /
           bearing.stiffness;
  MatrixXd closing = MatrixXd::Zero(position.strips(), meshes);
  for (size_t m = 0; m < position.mesh.size(); ++m) {
    const auto own = position.strips_of(m);
    for (int s = 0; s < kSides; ++s)
      closing(own, static_cast<Eigen::Index>(m)) +=
          0.5 * closing_sign(s) *
          position.displacement.rotation.col(system_.mesh[m].layout.side[static_cast<size_t>(s)].body)(own);
    if (lines_)
      for (size_t j = 0; j < position.mesh[m].law.size(); ++j) {
        const Eigen::Index i = position.first_strip[m] + static_cast<Eigen::Index>(j);
        if (p[i] > 0) a(i, i) += position.mesh[m].law[j].at(p[i]).slope;
      }
  }
  const MatrixXd w = closing(active, Eigen::all), c = a(active, active);
  const MatrixXd k = w.transpose() * c.ldlt().solve(w);
  return 0.5 * (k + k.transpose());
}

std::vector<std::vector<ContactZone>> SystemStatics::zones() const {
  const SystemEquilibrium& at = solution_.equilibrium;
  const MatrixXd& a = cracked_here_ ? with_cracks_ : compliance_;
  VectorXd separation = a * at.p + position_->gap - position_->displacement.rotation * at.x;
  if (const MatrixXd friction = friction_compliance(system_, *position_); friction.size() > 0)
    separation += friction * at.p;
  for (size_t b = 0; b < system_.layout.bodies.size(); ++b)
    if (system_.floats(static_cast<int>(b))) {
      const MatrixXd& rows = position_->displacement.translation[b];
      separation += rows * (rows.transpose() * at.p) / system_.layout.bodies[b].bearing.stiffness;
    }
  std::vector<std::vector<ContactZone>> out(position_->mesh.size());
  for (size_t m = 0; m < out.size(); ++m)
    for (size_t j = 0; j < position_->mesh[m].pairs.size(); ++j) {
      const MeshPosition& mesh = position_->mesh[m];
      const auto own = Eigen::seqN(position_->first_strip[m] + mesh.first_strip[j], mesh.pairs[j].size());
      out[m].push_back({mesh.pairs[j], at.p(own), separation(own), solution_.transmission_error[m]});
    }
  return out;
}

}  // namespace whine
