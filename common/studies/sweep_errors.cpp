#include "studies/sweep_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "signal/response.h"
#include "studies/next_level.h"
#include "studies/refinement.h"
#include "studies/sweep.h"
#include "system/face_points.h"
#include "system/statics.h"

namespace whine {

using Eigen::Index;
using Report = std::function<void(long, long, const std::string&)>;

namespace {

// Sizes of a discretisation over those of the scene.
struct Sizes {
  double element = 1, flank_spacing = 1, strip = 1, step = 1, periodicity = 1;
  double modes = 1, face_points = 1;  // their number

  bool of_bodies() const { return element != 1 || flank_spacing != 1 || modes != 1; }
};

// One discretisation: refined, and where its order can show also coarser, by the same factor.
struct Entry {
  std::string name;
  Sizes finer;
  std::vector<Sizes> coarser = {};  // none or one
  double ratio = 2;
};

using SweepWith = std::function<SweepResult(const Sizes&)>;

std::vector<ReducedBody> resized(const std::vector<ReducedBody>& bodies, const Sizes& sizes) {
  std::vector<ReducedBody> out;
  out.reserve(bodies.size());
  for (size_t i = 0; i < bodies.size(); ++i) {
    const auto alike =
        std::find_if(bodies.begin(), bodies.begin() + static_cast<std::ptrdiff_t>(i),
                     [&](const ReducedBody& b) { return b.compliance == bodies[i].compliance; });
    if (const auto known = static_cast<size_t>(alike - bodies.begin()); known < i) {
      out.push_back(out[known]);
      continue;
    }
    BodyDiscretisation with = bodies[i].discretisation;
    with.element_size *= sizes.element;
    const int modes =
        with.modes == kAllModes ? kAllModes : static_cast<int>(std::lround(with.modes * sizes.modes));
    with.flank_points = static_cast<int>(std::lround(with.flank_points / sizes.flank_spacing));
    out.push_back(reduced_again(bodies[i], with, modes));
  }
  return out;
}

// Of a line; 0: one slice. meshes: that share them.
template <class Meshes>
int points_of(const Fidelity& fidelity, const Meshes& meshes, const ContactDiscretisation& contact) {
  return fidelity.width == WidthModel::one ? 0 : face_points_of(meshes, contact);
}

template <class Meshes>
ContactDiscretisation resized(ContactDiscretisation contact, const Fidelity& fidelity, const Meshes& meshes,
                              const Sizes& sizes) {
  contact.strips = static_cast<int>(std::lround(contact.strips / sizes.strip));
  if (const int points = points_of(fidelity, meshes, contact); points > 0)
    contact.face_points = static_cast<int>(std::lround(points * sizes.face_points));
  return contact;
}

TimeDiscretisation resized(TimeDiscretisation time, const Sizes& sizes) {
  time.steps_per_period = static_cast<int>(std::lround(time.steps_per_period / sizes.step));
  time.min_sample_rate /= sizes.step;
  time.periodicity *= sizes.periodicity;
  return time;
}

// Fewer speeds, from end to end.
double judged_step(const MeshSpeeds& speeds) {
  const auto& [from, to, step] = speeds;
  const double most = std::floor((to - from) / step);
  return step * std::max(1.0, std::ceil(most / (kJudgedSpeeds - 1)));
}

// face_points: of a line, 0 in one slice.
std::vector<Entry> entries_of(const ReducedBody& first, const TimeDiscretisation& time, int face_points) {
  constexpr int kLeastSteps = 16, kLeastFacePoints = 4;
  constexpr double kMoreModes = 1.5;
  std::vector<Entry> out;
  Entry steps{from_to("steps", time.steps_per_period, 2 * time.steps_per_period), {.step = 0.5}};
  if (time.steps_per_period % 2 == 0 && time.steps_per_period >= 2 * kLeastSteps)
    steps.coarser.push_back({.step = 2});
  out.push_back(std::move(steps));
  const double element = first.discretisation.element_size;
  out.push_back({from_to("elements", shown_length(element), shown_length(element / 2), " mm"),
                 {.element = 0.5},
                 {{.element = 2}}});
  const int points = first.discretisation.flank_points;
  out.push_back({from_to("flank table", points, 2 * points, " points"), {.flank_spacing = 0.5}});
  if (first.discretisation.modes != kAllModes)
    out.push_back({from_to("modes", first.discretisation.modes,
                           static_cast<double>(std::lround(kMoreModes * first.discretisation.modes))),
                   {.modes = kMoreModes},
                   {{.modes = 1 / kMoreModes}},
                   kMoreModes});
  if (face_points > 0) {
    Entry face{from_to("face points", face_points, 2 * face_points), {.face_points = 2}};
    if (face_points % 2 == 0 && face_points >= kLeastFacePoints) face.coarser.push_back({.face_points = 0.5});
    out.push_back(std::move(face));
  }
  out.push_back({from_to("periodicity", time.periodicity, time.periodicity / 10), {.periodicity = 0.1}});
  return out;
}

// (speed, mesh) 1, relative to b, of the speeds that are compared.
MatrixRM change_of(const MatrixRM& a, const MatrixRM& b, const Eigen::VectorXi& compared) {
  MatrixRM out = MatrixRM::Zero(a.rows(), a.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index m = 0; m < a.cols(); ++m)
      if (compared[i] && b(i, m) > 0) out(i, m) = a(i, m) / b(i, m) - 1;
  return out;
}

Eigen::VectorXi comparable(const ResponseResult& a, const ResponseResult& b) {
  const std::vector<SpeedCompared> speeds = compared_speeds(a, b);
  Eigen::VectorXi out(static_cast<Index>(speeds.size()));
  for (Index i = 0; i < out.size(); ++i) out[i] = speeds[static_cast<size_t>(i)] == SpeedCompared::yes;
  return out;
}

// RMS over the speeds that all three have in common, of the changes from the coarser to the base and from the base to the finer.
double order_by(const ResponseResult& coarser, const ResponseResult& base, const ResponseResult& finer,
                double ratio) {
  const Eigen::VectorXi common = comparable(coarser, base).cwiseProduct(comparable(base, finer));
  return order_of(change_of(coarser.dte_rms, base.dte_rms, common).norm(),
                  change_of(base.dte_rms, finer.dte_rms, common).norm(), ratio);
}

void compare_jumps(const ResponseResult& base, const ResponseResult& finer, double near, Index entry,
                   SweepErrorsResult& out) {
  for (Index j = 0; j < base.jump_frequency.size(); ++j) {
    double least = near;
    for (const double f : finer.jump_frequency)
      if (std::abs(f - base.jump_frequency[j]) <= std::abs(least)) {
        least = base.jump_frequency[j] - f;
        out.jump_found(entry, j) = 1;
      }
    if (out.jump_found(entry, j)) out.jump_change(entry, j) = least;
  }
}

// A quantity of a response and where it goes.
struct Taken {
  SweepErrorsResult::Judged SweepErrorsResult::*judged;
  MatrixRM (*of)(const ResponseResult&);
};
MatrixRM first_order(const ResponseResult& r) {
  MatrixRM out = MatrixRM::Zero(r.dte_rms.rows(), r.dte_rms.cols());
  for (Index i = 0; i < out.rows() && r.harmonics() > 0; ++i)
    out.row(i) = r.dte_harmonic[static_cast<size_t>(i)].row(0);
  return out;
}
MatrixRM sustained(const ResponseResult& r) {
  return r.tooth_load_sustained.size() > 0 ? r.tooth_load_sustained
                                           : MatrixRM::Zero(r.dte_rms.rows(), r.dte_rms.cols());
}
const std::array kTaken{
    Taken{&SweepErrorsResult::dte_rms, [](const ResponseResult& r) { return r.dte_rms; }},
    Taken{&SweepErrorsResult::dte_first_order, first_order},
    Taken{&SweepErrorsResult::tooth_load_max, [](const ResponseResult& r) { return r.tooth_load_max; }},
    Taken{&SweepErrorsResult::tooth_load_sustained, sustained},
    Taken{&SweepErrorsResult::mesh_force_max, [](const ResponseResult& r) { return r.mesh_force_max; }}};

// The result before anything is refined.
SweepErrorsResult begun(const SweepResult& sweep, const ResponseResult& base, Index entries) {
  SweepErrorsResult out;
  static_cast<MotionSource&>(out) = sweep;
  out.direction = sweep.direction;
  out.natural_frequency = sweep.natural_frequency;
  out.mesh_frequency = base.mesh_frequency;
  out.jump_frequency = base.jump_frequency;
  const Index speeds = base.mesh_frequency.size(), jumps = base.jump_frequency.size();
  for (const Taken& taken : kTaken) {
    SweepErrorsResult::Judged& judged = out.*taken.judged;
    judged.value = taken.of(base);
    judged.error = MatrixRM::Zero(speeds, base.dte_rms.cols());
  }
  out.order.setZero(entries);
  out.natural_frequency_change.setZero(entries);
  out.compared.setZero(entries, speeds);
  out.jump_change = MatrixRM::Zero(entries, jumps);
  out.jump_found.setZero(entries, jumps);
  out.jump_error.setZero(jumps);
  return out;
}

SweepErrorsResult measured(const std::vector<Entry>& entries, const SweepWith& sweep_with, double step,
                           const Report& report) {
  long total = 1, done = 0;
  for (const Entry& entry : entries) total += 1 + static_cast<long>(entry.coarser.size());
  const auto run = [&](const Sizes& sizes, const std::string& note) {
    report(done, total, note);
    const SweepResult out = sweep_with(sizes);
    report(++done, total, note);
    return out;
  };
  const SweepResult sweep = run({}, "as the scene says");
  const ResponseResult base = response(sweep);
  SweepErrorsResult out = begun(sweep, base, static_cast<Index>(entries.size()));
  for (Index e = 0; e < out.order.size(); ++e) {
    const Entry& entry = entries[static_cast<size_t>(e)];
    out.entry.push_back(entry.name);
    const SweepResult refined = run(entry.finer, entry.name);
    const ResponseResult finer = response(refined);
    for (const Sizes& coarser : entry.coarser) {
      try {
        out.order[e] = order_by(response(run(coarser, entry.name + ", its order")), base, finer, entry.ratio);
      } catch (const Error& error) {
        // What is coarser than the scene may be beyond what can be computed: then no order shows, and the change itself counts.
        if (error.kind() != Failure::numerical) throw;
        report(++done, total, entry.name + ": no order");
      }
    }
    out.compared.row(e) = comparable(base, finer).transpose();
    const Eigen::VectorXi compared = out.compared.row(e);
    compare_jumps(base, finer, 2 * step, e, out);
    const double factor = error_of(1, out.order[e], entry.ratio);
    for (const Taken& taken : kTaken) {
      SweepErrorsResult::Judged& judged = out.*taken.judged;
      judged.change.push_back(change_of(judged.value, taken.of(finer), compared));
      judged.error += factor * judged.change.back().cwiseAbs();
    }
    if (refined.natural_frequency > 0)
      out.natural_frequency_change[e] = out.natural_frequency / refined.natural_frequency - 1;
    out.natural_frequency_error += factor * std::abs(out.natural_frequency_change[e]);
    out.jump_error += factor * out.jump_change.row(e).cwiseAbs().transpose();
  }
  return out;
}

void quiet(long /*done*/, long /*total*/, const std::string& /*note*/) {}

}  // namespace

SweepErrorsResult sweep_errors(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticResult& statics, const StaticResult& reference,
                               const SweepParameters& settings, Direction direction, const Report& report) {
  const double step = judged_step(settings);
  std::vector<Entry> entries =
      entries_of(driver, settings.time, points_of(statics.fidelity, statics.mesh, statics.contact));
  if (settings.fidelity.contact == ContactModel::strips) {
    const int strips = statics.contact.strips;
    Entry entry{from_to("strips", strips, 2 * strips), {.strip = 0.5}};
    if (strips % 2 == 0 && strips >= 4) entry.coarser.push_back({.strip = 2});
    entries.push_back(std::move(entry));
  }
  const std::vector<ReducedBody> bodies{driver, driven};
  const auto sweep_with = [&](const Sizes& sizes) {
    const std::vector<ReducedBody> with = sizes.of_bodies() ? resized(bodies, sizes) : bodies;
    SweepParameters moved = settings;
    moved.frequency_step = step;
    moved.time = resized(settings.time, sizes);
    StaticParameters rest;
    rest.mesh = statics.mesh;
    rest.fidelity = statics.fidelity;
    rest.contact = resized(statics.contact, statics.fidelity, statics.mesh, sizes);
    // What refines neither bodies nor contact leaves the statics as they are.
    const bool as_given = !sizes.of_bodies() && sizes.strip == 1 && sizes.face_points == 1;
    const StaticResult at = as_given ? statics : static_transmission(with[0], with[1], rest, statics.torque);
    const double stiffness =
        as_given ? reference.mean_stiffness
        : reference.torque == statics.torque
            ? at.mean_stiffness
            : static_transmission(with[0], with[1], rest, reference.torque).mean_stiffness;
    return sweep(with[0], with[1], at, stiffness, moved, direction, quiet, nullptr,
                 settings.frequency_step / 64);
  };
  return measured(entries, sweep_with, step, report);
}

SweepErrorsResult sweep_errors(const SystemSweepParameters& settings, const std::vector<ReducedBody>& bodies,
                               Direction direction, const Report& report) {
  const double step = judged_step(settings);
  const auto sweep_with = [&](const Sizes& sizes) {
    SystemSweepParameters moved = settings;
    moved.frequency_step = step;
    moved.time = resized(settings.time, sizes);
    moved.contact = resized(settings.contact, settings.fidelity, settings.mesh, sizes);
    return system_sweep(moved, sizes.of_bodies() ? resized(bodies, sizes) : bodies, direction, quiet,
                        settings.frequency_step / 64);
  };
  return measured(
      entries_of(bodies.at(0), settings.time, points_of(settings.fidelity, settings.mesh, settings.contact)),
      sweep_with, step, report);
}

}  // namespace whine
