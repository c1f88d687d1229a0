#include "system/mesh_record.h"

#include <algorithm>
#include <cmath>

#include "gear/losses.h"
#include "signal/spectrum.h"
#include "system/compliance_split.h"
#include "system/face_mesh.h"
#include "system/flank_pressure.h"
#include "system/rectangular_wave.h"
#include "system/root_stress.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

MeshRecord::MeshRecord(const SystemModel& system, int m, const GearPairParameters& of, double load,
                       double torque)
    : system_(system), model_(system.mesh[static_cast<size_t>(m)]), m_(m), load_(load) {
  static_cast<GearPairParameters&>(result_) = of;
  result_.torque = torque;
  result_.contact_ratio = model_.kinematics.contact_ratio();
  result_.hunting_periods = hunting_periods(system);
  const Index rows = Index{of.contact.positions} * result_.hunting_periods;
  for (VectorXd* v : {&result_.mesh_phase, &result_.transmission_error, &result_.unloaded_error,
                      &result_.stiffness_secant, &result_.stiffness_tangent, &deflection_})
    v->setZero(rows);
  if (system.slides()) {
    result_.friction_coefficient = system.friction[static_cast<size_t>(m)];
    for (VectorXd* v : {&result_.friction_loss, &result_.friction_moment[0], &result_.friction_moment[1]})
      v->setZero(rows);
  }
  if (!system.face.empty()) face_.emplace(*system.face[static_cast<size_t>(m)]);
  for (size_t s = 0; s < kSides && system.mesh.size() == 1; ++s)
    if (model_.bearing[s].elastic()) result_.bearing_force[s].setZero(rows, 2);
}

void MeshRecord::take(const RestStep& step, const SystemSolution& solution, const SystemStatics& statics) {
  if (step.step == 0) {
    loads_.clear();
    lowest_ = -1;
    highest_ = 1;
    result_.least_gap = result_.least_force = std::numeric_limits<double>::infinity();
    result_.torque_residual = result_.friction_coupling = 0;
    if (face_) face_->restart();
  }
  const auto m = static_cast<size_t>(m_);
  const SystemEquilibrium& e = solution.equilibrium;
  const Index i = step.row;
  const MeshInstant own = mesh_instant(system_, m_, step.phase, step.period);
  result_.mesh_phase[i] = step.period + step.phase + system_.layout.meshes[m].phase;
  result_.transmission_error[i] = solution.transmission_error[m];
  result_.unloaded_error[i] =
      face_ ? system_.face[m]->unloaded_transmission_error(own.phase, std::numeric_limits<double>::infinity())
            : unloaded_transmission_error(model_, own.phase, own.period);
  deflection_[i] = solution.deflection[m];
  if (solution.mesh_stiffness.size() == 0) {
    result_.stiffness_secant[i] = load_ / (deflection_[i] - result_.unloaded_error[i]);
    result_.stiffness_tangent[i] = e.stiffness(0, 0);
    for (size_t s = 0; s < kSides; ++s) {
      if (!model_.bearing[s].elastic()) continue;
      result_.bearing_force[s].row(i) =
          solution.bearing_force[static_cast<size_t>(model_.layout.side[s].body)].transpose();
      // In series on the line of action; that a corner's normal is tilted against it is left out here.
      result_.stiffness_tangent[i] = 1 / (1 / result_.stiffness_tangent[i] - 1 / model_.bearing[s].stiffness);
    }
    // With friction forces do not act along what they are read along, and bearings are not in series with the mesh.
    if (system_.slides() && model_.on_bearings())
      result_.stiffness_tangent[i] = statics.mesh_stiffness()(0, 0);
  } else if (solution.driving_force[m] > 0 && load_ > 0) {
    result_.stiffness_secant[i] = solution.driving_force[m] / (deflection_[i] - result_.unloaded_error[i]);
    result_.stiffness_tangent[i] = solution.mesh_stiffness(m_, m_);
  }
  if (system_.slides()) take_friction(i, solution, statics.position());
  result_.torque_residual = std::max(result_.torque_residual, e.residual);
  result_.friction_coupling = std::max(result_.friction_coupling, e.certificate.coupling);
  result_.least_gap = std::min(result_.least_gap, e.certificate.least_gap);
  result_.least_force = std::min(result_.least_force, e.certificate.least_force);
  for (const LoadedSegment& at : solution.loads)
    if (at.mesh == m_ && at.force > 0) {
      lowest_ = std::min(lowest_, at.pair);
      highest_ = std::max(highest_, at.pair);
      loads_.emplace_back(i, at);
    }
  if (!face_) return;
  const SystemPosition& position = statics.position();
  const FacePoints& points = position.mesh[m].face->points;
  const auto strips = position.strips_of(m);
  face_->take(i, *position.mesh[m].face, position.mesh[m].law, e.p(strips),
              statics.compliance()(strips, strips));
  for (const ContactLine& line : points.line) {
    lowest_ = std::min(lowest_, line.pair);
    highest_ = std::max(highest_, line.pair);
  }
}

// What friction takes at a position, and its moments about the axes.
void MeshRecord::take_friction(Index row, const SystemSolution& solution, const SystemPosition& position) {
  for (VectorXd* v : {&result_.friction_loss, &result_.friction_moment[0], &result_.friction_moment[1]})
    (*v)[row] = 0;
  for (const ContactSegment& segment : position.segment) {
    if (segment.mesh != m_) continue;
    const double force = result_.friction_coefficient *
                         solution.equilibrium.p.segment(segment.first_strip, segment.strips).sum();
    result_.friction_loss[row] += force * segment.sliding.loss();
    for (size_t s = 0; s < kSides; ++s)
      result_.friction_moment[s][row] += force * segment.sliding.direction * segment.sliding.lever[s];
  }
}

void MeshRecord::store_loads(int lowest, int highest) {
  result_.pair = Eigen::VectorXi::LinSpaced(highest - lowest + 1, lowest, highest);
  result_.tooth_load = MatrixRM::Zero(result_.mesh_phase.size(), result_.pair.size());
  result_.contact_pressure = result_.contact_half_width = result_.tooth_load;
  for (const auto& [i, at] : loads_) {
    const Index k = at.pair - lowest;
    result_.tooth_load(i, k) += at.force;
    if (at.patch.pressure <= result_.contact_pressure(i, k)) continue;
    result_.contact_pressure(i, k) = at.patch.pressure;
    result_.contact_half_width(i, k) = at.patch.half_width;
  }
}

// Root stresses at all positions, and where they are largest.
void MeshRecord::store_root_stress() {
  StaticResult& s = result_;
  const auto positions = static_cast<size_t>(s.contact.positions);
  std::vector<double> phases;
  phases.reserve(positions);
  for (size_t i = 0; i < positions; ++i) {
    const double phase = s.mesh_phase[static_cast<Index>(i)];
    phases.push_back(phase - std::floor(phase));
  }
  RootStresses roots(model_, phases);
  if (!roots.known()) return;
  for (VectorXd* v : {&s.root_stress_max, &s.root_stress_angle, &s.root_stress_phase}) v->setZero(kSides);
  if (s.hunting_periods > 1) s.root_stress_tooth.setZero(kSides);
  // Of teeth that differ by round-off alone the first one is named.
  const double clearly = s.hunting_periods > 1 ? 1 + 1e-9 : 1;
  for (int g = 0; g < kSides; ++g) {
    const int teeth = s.gear[static_cast<size_t>(g)].design.teeth;
    MatrixRM& out = s.root_stress[static_cast<size_t>(g)];
    out.resize(s.tooth_load.rows(), s.tooth_load.cols());
    for (Index i = 0; i < out.rows(); ++i) {
      const size_t phase = static_cast<size_t>(i) % positions;
      const int period = static_cast<int>(std::floor(s.mesh_phase[i]));
      for (Index k = 0; k < out.cols(); ++k) {
        const RootStress tooth =
            roots.of_tooth(g, phase, s.pair[k], s.pair, s.tooth_load.row(i).transpose(), period);
        out(i, k) = tooth.stress;
        if (tooth.stress <= clearly * s.root_stress_max[g]) continue;
        s.root_stress_max[g] = tooth.stress;
        s.root_stress_angle[g] = tooth.angle;
        s.root_stress_phase[g] = phases[phase] + tooth.pair;
        if (s.hunting_periods > 1)
          s.root_stress_tooth[g] =
              (model_.layout.side[static_cast<size_t>(g)].tooth(tooth.pair - period) % teeth + teeth) % teeth;
      }
    }
  }
}

StaticResult MeshRecord::finish(int lowest, int highest) {
  StaticResult& s = result_;
  store_loads(lowest, highest);
  s.mean_stiffness = s.stiffness_secant.mean();
  if (face_)
    face_->finish(s);
  else
    store_root_stress();
  s.backlash_margin = s.tooth_thinning() > 0 ? model_.kinematics.backlash() + deflection_.minCoeff()
                                             : std::numeric_limits<double>::infinity();
  s.flank_pressure = flank_pressure(s);
  if (load_ > 0 && s.mean_stiffness > 0) {
    if (!face_) s.loss_factor = loss_factor(model_.kinematics, s.pair, s.mesh_phase, s.tooth_load, s.torque);
    if (system_.slides()) s.efficiency = 1 - s.friction_loss.mean() / s.torque;
    s.compliance = compliance_split(s);
    s.rectangular_wave = rectangular_wave(s);
  }
  return std::move(result_);
}

namespace {

// periods: mesh periods that the samples are of; those of `base` periods are its harmonics.
VectorXd mean_and_harmonics(const VectorXd& samples, int periods, int base) {
  const int count = resolved_harmonics(samples.size(), 40, periods) * (periods / base);
  const Harmonics h = harmonics(samples, count, base);
  VectorXd out(count + 1);
  out << h.mean, h.amplitude;
  return out;
}

}  // namespace

void add_harmonics(StaticResult& mesh) {
  const int periods = mesh.hunting_periods;
  mesh.transmission_error_harmonic = mean_and_harmonics(mesh.transmission_error, periods, periods);
  mesh.stiffness_harmonic = mean_and_harmonics(mesh.stiffness_secant, periods, periods);
  if (periods > 1) mesh.transmission_error_order = mean_and_harmonics(mesh.transmission_error, periods, 1);
}

}  // namespace whine
