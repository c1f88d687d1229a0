#include "studies/train_in_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/error.h"
#include "base/model_range.h"
#include "gear/layout.h"
#include "gear/system_layout.h"
#include "system/face_mesh.h"
#include "system/face_statics.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;

namespace {

constexpr int kRestPositions = 32;  // of the statics that come first, in each mesh period
constexpr int kMostRestPositions = 2048,
              kFewestRestPositions = 4;  // in all of a hunting period; in a mesh period
constexpr double kBeyondStatics = 2.5;   // deflection that tip edges are looked for, over that of rest
constexpr int kMostWidenings = 5;

SystemModel in_motion(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies) {
  if (settings.fidelity.width == WidthModel::one) return elastic_system(settings, bodies);
  const System& layout = settings.layout;
  const auto body = [&](size_t side) -> const ReducedBody& {
    return body_of(settings, bodies, settings.gear[static_cast<size_t>(layout.meshes[0].side[side].body)]);
  };
  return sliced_system(layout, body(0), body(1), settings.mesh[0], settings.fidelity.width,
                       face_points_of(settings.mesh[0], settings.contact), settings.damping.undamped_depth);
}

}  // namespace

void require_like_teeth(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                        const std::string& stage) {
  for (size_t b = 0; b < settings.errors.size(); ++b)
    if (settings.has_errors(b))
      fail(
          Failure::input, stage, " does not take teeth that differ: [gear.", settings.gear[b],
          ".error] gives '", settings.layout.bodies[b].name,
          "' deviations tooth by tooth; use a scene without this section, or a sweep, which covers the hunting period");
  for (size_t g = 0; g < settings.body.size() && g < bodies.size(); ++g)
    if (bodies[g].design.crack.depth > 0)
      fail(Failure::input, stage, " does not take a cracked tooth: [gear.", settings.body[g].first,
           ".crack]; use a scene without this section, or a sweep, which covers the turn of the gear");
}

TrainInMotion::TrainInMotion(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                             int positions)
    : system_(in_motion(settings, bodies)), settings_(settings), positions_(positions) {
  take_masses(settings, bodies, system_.layout);
  if (system_.face.empty())
    take_rest();
  else
    take_rest_in_slices(bodies);
  // A mesh without load has a tenth of the deflection of the most loaded one.
  const double most = *std::max_element(deflection_.begin(), deflection_.end());
  for (double& deflection : deflection_) deflection = std::max(deflection, 0.1 * most);
  motion_.damping = settings.damping;
  motion_.fidelity = settings.fidelity;
  motion_.fidelity.contact = ContactModel::line;
  motion_.axis_frequency = axis_frequency(
      system_, settings.axis_stiffness > 0 ? MatrixXd::Constant(1, 1, settings.axis_stiffness) : stiffness_);
  motion_.frame_turns = frame_turns(system_.layout);
  dynamics_ = placed();
}

// Of a mesh in one slice.
void TrainInMotion::take_rest() {
  const auto meshes = static_cast<Index>(system_.mesh.size());
  stiffness_ = MatrixXd::Zero(meshes, meshes);
  deflection_.assign(system_.mesh.size(), 0);
  SystemModel still = system_;
  motion_.output = hold_output(still);
  const std::vector<SystemSolution> rest = rest_over_period(
      still, ContactModel::line, settings_.contact.strips,
      std::clamp(kMostRestPositions / hunting_periods(system_), kFewestRestPositions, kRestPositions));
  for (const SystemSolution& at : rest) {
    stiffness_ += at.mesh_stiffness / static_cast<double>(rest.size());
    for (size_t m = 0; m < system_.mesh.size(); ++m)
      deflection_[m] = std::max(deflection_[m], at.deflection[m]);
  }
  take_losses(still, rest);
}

// The one mesh of a pair.
void TrainInMotion::take_rest_in_slices(const std::vector<ReducedBody>& bodies) {
  StaticParameters rest{settings_.mesh[0], settings_.fidelity, settings_.contact};
  rest.contact.positions = kRestPositions;
  const auto& side = system_.layout.meshes[0].side;
  const StaticResult at =
      face_transmission(body_of(settings_, bodies, settings_.gear[static_cast<size_t>(side[0].body)]),
                        body_of(settings_, bodies, settings_.gear[static_cast<size_t>(side[1].body)]), rest,
                        mesh_loads(system_)[0] * system_.base_radius(side[0].body));
  stiffness_ = MatrixXd::Constant(1, 1, at.mean_stiffness);
  deflection_ = {at.transmission_error.maxCoeff()};
}

// Losses at rest over the coefficients there, on the body that gives what is left; those in motion go with the speed.
void TrainInMotion::take_losses(const SystemModel& still, const std::vector<SystemSolution>& rest) {
  system_.friction.clear();
  if (motion_.output < 0) return;
  motion_.loss = Eigen::VectorXd::Zero(static_cast<Index>(still.mesh.size()));
  const double turned =
      2 * std::numbers::pi * ground_turns(system_.layout, motion_.output);  // in a mesh period
  for (const SystemSolution& at : rest)
    for (size_t m = 0; m < still.mesh.size(); ++m)
      if (still.friction[m] > 0)
        motion_.loss[static_cast<Index>(m)] +=
            at.friction_work[m] / still.friction[m] / turned / static_cast<double>(rest.size());
}

std::unique_ptr<SystemDynamics> TrainInMotion::placed() const {
  std::vector<double> gap;
  gap.reserve(deflection_.size());
  for (const double deflection : deflection_)
    gap.push_back(kBeyondStatics * deflection * std::pow(kWidening, widenings_));
  auto dynamics = std::make_unique<SystemDynamics>(system_, motion_);
  dynamics->set_positions(gap, positions_);
  return dynamics;
}

void TrainInMotion::widen(const std::vector<SystemDynamics::State*>& states) {
  if (widenings_ == kMostWidenings) {
    const auto worst =
        static_cast<size_t>(std::max_element(deflection_.begin(), deflection_.end()) - deflection_.begin());
    fail_outside_range(Failure::numerical, "the meshes deflect beyond the tip edges that are looked at, ",
                       kBeyondStatics * std::pow(kWidening, widenings_) * deflection_[worst] * 1e6,
                       " micrometres at ", mesh_name(system_.layout, worst),
                       "; lower the torque or raise the damping");
  }
  ++widenings_;
  std::unique_ptr<SystemDynamics> wider = placed();
  for (SystemDynamics::State* state : states) *state = wider->fitted(*state, *dynamics_);
  dynamics_ = std::move(wider);
}

MotionSource TrainInMotion::source() const {
  MotionSource out;
  SystemSweepParameters& used = out.train = settings_;
  used.fidelity = motion_.fidelity;
  out.drive.setZero(static_cast<Index>(used.layout.bodies.size()));
  out.axis_frequency = motion_.axis_frequency / (2 * std::numbers::pi);
  for (size_t b = 0; b < system_.layout.bodies.size(); ++b) {
    const System::Body& body = system_.layout.bodies[b];
    out.drive[static_cast<Index>(b)] = used.layout.torque(static_cast<int>(b));
    used.layout.bodies[b].inertia = body.inertia;
    // On a rigid pin a planet has the mass of its body, of which a moving carrier's pins feel the inertia.
    used.layout.bodies[b].bearing.mass = body.on != System::kGround && !body.bearing.elastic()
                                             ? system_.body[b]->body().mass
                                             : body.bearing.mass;
  }
  out.name_parts();
  return out;
}

}  // namespace whine
