#include "report/report_opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/iso_comparison.h"
#include "report/measured_errors.h"
#include "report/opening.h"
#include "signal/mode_excitation.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr double kSmall = 0.01;  // of the largest load of a pair of teeth

struct FirstTorque {
  const ReportContent& content;
  const SystemStaticResult* rest;             // nullptr: rigid gears
  double torque = 0;                          // N m
  std::vector<AlikeMeshes> sections = {};     // of those at rest
  std::vector<const ResponseResult*> sweeps;  // rising, falling, those that are there
  TurningMember driver;

  explicit FirstTorque(const ReportContent& c) : content(c), rest(rest_of(c)), driver(driver_of(c)) {
    if (!rest) return;
    torque = torque_of(*rest);
    sections = alike_meshes(*rest);
    for (const Direction direction : {Direction::up, Direction::down})
      if (const ResponseResult* sweep = sweep_of(c, torque, direction)) sweeps.push_back(sweep);
  }
  const SweepErrorsResult* errors(const ResponseResult& r) const {
    return errors_of(content, torque, r.direction);
  }
  std::optional<SpeedRange> speeds() const {
    if (sweeps.empty()) return std::nullopt;
    const Eigen::VectorXd& f = sweeps[0]->mesh_frequency;
    return SpeedRange{f.minCoeff(), f.maxCoeff()};
  }
};

std::string excitation(const FirstTorque& t) {
  if (!t.rest) return excitation_line("", {});
  const ErrorBudgetResult* budget = budget_of(t.content, t.torque);
  std::vector<MeshExcitation> out;
  for (const AlikeMeshes& section : t.sections) {
    MeshExcitation& e = out.emplace_back(MeshExcitation{section.name, {1e30, 0}, {1e30, 0}});
    for (const size_t m : section.meshes) {
      const StaticResult& mesh = t.rest->mesh[m];
      const Eigen::VectorXd& harmonic = mesh.transmission_error_harmonic;
      const double swing = peak_to_peak(mesh.transmission_error),
                   first = harmonic.size() > 1 ? harmonic[1] : 0;
      e.peak_to_peak = {std::min(e.peak_to_peak.least, swing), std::max(e.peak_to_peak.most, swing),
                        swing * sum_of(budget, &StaticChanges::peak_to_peak_change)};
      e.first_order = {std::min(e.first_order.least, first), std::max(e.first_order.most, first),
                       harmonic_error(budget, 1, first)};
    }
  }
  return excitation_line(text(torque_words(t.torque), t.rest->of_train() ? " on " + t.driver.name : ""), out);
}

// Which orders excite a mode: not those that equal planets, whose meshes follow each other in phase, cancel.
std::array<bool, kOrders> excited_by(const FirstTorque& t, const ModesResult& a, Index mode) {
  constexpr double kCancelled = 1e-6;
  std::array<bool, kOrders> out{true, true, true};
  bool differ = !t.rest;
  for (size_t b = 0; !differ && b < a.layout.bodies.size(); ++b)
    differ = t.rest->settings.has_errors(b) || a.layout.bodies[b].offset != System::Body{}.offset;
  for (int order = 1; !differ && order <= kOrders; ++order)
    out[static_cast<size_t>(order - 1)] =
        std::any_of(t.sections.begin(), t.sections.end(), [&](const AlikeMeshes& section) {
          return excitation_left(a, mode, order, section.meshes) > kCancelled;
        });
  return out;
}

// Natural modes that transmission errors excite, by the lowest order that meets them and the energy in the meshes.
void add_modes(const FirstTorque& t, const ModesResult& a, CriticalSpeeds& out) {
  constexpr double kMeshMode = 0.1;  // of the energy in the meshes
  constexpr double kAlike = 0.01;
  std::vector<std::tuple<int, double, Index>> modes;
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    const double f = a.natural_frequency[i], energy = a.mesh_energy.row(i).sum();
    const std::array<bool, kOrders> excited = excited_by(t, a, i);
    int order = 1;
    while (order <= kOrders && (!excited[static_cast<size_t>(order - 1)] ||
                                (out.speeds && (f / order < out.speeds->from || f / order > out.speeds->to))))
      ++order;
    if (f > 0 && energy > kMeshMode && order <= kOrders) modes.emplace_back(order, -energy, i);
  }
  std::sort(modes.begin(), modes.end());
  for (const auto& [order, energy, i] : modes) {
    // Pairs of translational modes have one frequency, or nearly so.
    const double f = a.natural_frequency[i];
    if (std::none_of(out.natural.begin(), out.natural.end(),
                     [&](const auto& known) { return std::abs(known.frequency - f) < kAlike * f; }))
      out.natural.push_back({f, text("mode ", i + 1, ", ", name_of(a.type[static_cast<size_t>(i)])), kNoError,
                             excited_by(t, a, i)});
  }
}

std::string critical_speeds(const FirstTorque& t) {
  CriticalSpeeds out{t.driver, t.speeds(), {}, {}};
  const ResponseResult* r = t.sweeps.empty() ? nullptr : t.sweeps[0];
  const ImpactResult* ring_down = impact_of(t.content, t.torque);
  const char* const mesh = "the natural frequency of the mesh";
  if (r && r->natural_frequency > 0)
    out.natural.push_back(
        {r->natural_frequency, mesh,
         t.errors(*r) ? t.errors(*r)->natural_frequency_error * r->natural_frequency : kNoError});
  else if (ring_down && ring_down->states.natural_frequency.size() > 0)
    out.natural.push_back({ring_down->states.natural_frequency.tail<1>()[0], mesh});
  if (t.content.modes) add_modes(t, *t.content.modes, out);
  if (r)
    for (const Index i : resonances(r->mesh_frequency, r->dte_rms.rowwise().maxCoeff()))
      out.peaks.push_back(r->mesh_frequency[i]);
  return critical_speed_line(out);
}

// Speeds, and whether teeth of a mesh part there.
std::map<double, bool> speeds_apart(const ResponseResult& r) {
  std::map<double, bool> apart;
  for (Index i = 0; i < r.mesh_frequency.size(); ++i)
    apart[r.mesh_frequency[i]] = r.separation_fraction.row(i).maxCoeff() > 0;
  return apart;
}

bool parts(const std::vector<const ResponseResult*>& sweeps) {
  return std::any_of(sweeps.begin(), sweeps.end(),
                     [](const ResponseResult* r) { return r->separation_fraction.maxCoeff() > 0; });
}

std::string parting(const FirstTorque& t) {
  Parting out;
  out.member = t.driver;
  out.speeds = t.speeds();
  std::vector<std::string> names;
  for (const ResponseResult* r : t.sweeps) {
    (r->direction == Direction::up ? out.rising : out.falling) =
        Parting::Sweep{marked_ranges(speeds_apart(*r)), {r->jump_frequency.begin(), r->jump_frequency.end()}};
    for (const AlikeMeshes& section : t.sections)
      if (std::any_of(
              section.meshes.begin(), section.meshes.end(),
              [&](size_t m) { return r->separation_fraction.col(static_cast<Index>(m)).maxCoeff() > 0; }) &&
          std::find(names.begin(), names.end(), section.name) == names.end())
        names.push_back(section.name);
  }
  out.meshes = listed(names);
  if (t.sweeps.size() == 2)
    out.only_falling = marked_ranges(but_not(speeds_apart(*t.sweeps[1]), speeds_apart(*t.sweeps[0])));
  for (const SystemStaticResult& other : t.content.statics) {
    const double torque = torque_of(other);
    std::vector<const ResponseResult*> sweeps;
    for (const Direction direction : {Direction::up, Direction::down})
      if (const ResponseResult* r = sweep_of(t.content, torque, direction)) sweeps.push_back(r);
    if (torque != t.torque && !sweeps.empty())
      (parts(sweeps) ? out.parts_at : out.holds_at).push_back(torque_words(torque));
  }
  return parting_line(out);
}

std::string dynamic_factor(const FirstTorque& t) {
  std::vector<DynamicFactor> out;
  std::string why_none;
  for (const AlikeMeshes& section : t.sections) {
    DynamicFactor most{section.name, 0, 0, {}};
    for (const ResponseResult* r : t.sweeps)
      for (const size_t m : section.meshes) {
        const DynamicFactorPeak peak = largest_dynamic_factor(*t.rest, *r, m);
        if (peak.factor <= most.factor) continue;
        const double at = r->mesh_frequency[peak.row];
        most = {section.name, peak.factor, at, peak.standard,
                peak.factor * error_near(t.errors(*r), &SweepErrorsResult::mesh_force_max, at, m)};
        why_none = peak.why_none;
      }
    if (most.factor > 0) out.push_back(most);
  }
  return dynamic_factor_line(t.driver, out, why_none);
}

// Where teeth part or, if they do not, where the vibration is near its largest.
std::vector<SpeedRange> speeds_to_avoid(const FirstTorque& t, bool apart) {
  constexpr double kNearPeak = 0.7;
  std::map<double, bool> marked;
  for (const ResponseResult* r : t.sweeps) {
    const Eigen::VectorXd rms = r->dte_rms.rowwise().maxCoeff();
    if (!apart && resonances(r->mesh_frequency, rms).empty()) continue;
    for (const auto& [f, lost] : speeds_apart(*r)) marked[f] |= apart && lost;
    for (Index i = 0; !apart && i < rms.size(); ++i)
      marked[r->mesh_frequency[i]] |= rms[i] > kNearPeak * rms.maxCoeff();
  }
  return marked_ranges(marked);
}

// What tip edges of a section carry, where nothing is taken off both gears' tips. Returns whether the gears have or need relief.
bool add_relief(const SystemStaticResult& a, const AlikeMeshes& section, Advice& out) {
  const StaticResult& first = a.mesh[section.meshes.front()];
  if (first.mesh.modification[0].tip.amount > 0 && first.mesh.modification[1].tip.amount > 0) return true;
  double edge = 0, load = 0, deflection = 0;
  for (const size_t m : section.meshes) {
    const StaticResult& mesh = a.mesh[m];
    deflection =
        std::max(deflection, (a.mesh_deflection.col(static_cast<Index>(m)) - mesh.unloaded_error).maxCoeff());
    load = std::max(load, mesh.tooth_load.maxCoeff());
    edge = std::max(edge, tip_edge_load(mesh));
  }
  if (!(edge > kSmall * load)) return false;
  out.relief.push_back({section.name.empty() ? "both gears" : section.name, deflection, edge});
  return true;
}

std::string advice(const FirstTorque& t) {
  constexpr double kUnequal = 1.3;  // of an equal share
  Advice out;
  out.member = t.driver;
  bool relief = false;
  for (const AlikeMeshes& section : t.sections) relief = add_relief(*t.rest, section, out) || relief;
  if (relief && !t.content.of_train())
    out.more.emplace_back("See make harris-map for the relief that suits a torque.");
  if (t.rest)
    for (const LoadSharing& of : load_sharing(*t.rest))
      if (of.factor > kUnequal)
        out.more.push_back(text("One of the meshes of ", of.name, " carries ", fixed(of.factor, 2),
                                " times an equal share: let a central gear float on a softer [[bearing]]."));
  out.moves = !t.sweeps.empty();
  out.edges = t.rest && !t.rest->mesh[0].gear[0].design.helical();
  if (!out.moves && t.rest && t.rest->mesh[0].fidelity.width == WidthModel::body)
    out.more.emplace_back("Write width = \"slices\" in [fidelity] to see at which speeds it vibrates.");
  out.parts = parts(t.sweeps);
  out.avoid = speeds_to_avoid(t, out.parts);
  if (t.rest && t.sections.size() == 1 && t.rest->mesh[0].stiffness_harmonic.size() > 1)
    out.stiffness_swing = t.rest->mesh[0].stiffness_harmonic[1] / t.rest->mesh[0].stiffness_harmonic[0];
  if (const ImpactResult* a = impact_of(t.content, t.torque); a && a->states.damping_ratio.size() > 0)
    out.damping_ratio = a->states.damping_ratio.tail<1>()[0];
  if (!t.rest)
    out.more.emplace_back(
        "Keep the speeds of operation away from the critical ones; give the gears drawings and materials to see what excites them.");
  return advice_line(out);
}

}  // namespace

std::vector<std::string> opening_lines(const ReportContent& c) {
  const FirstTorque t(c);
  return {excitation(t), critical_speeds(t), parting(t), dynamic_factor(t), advice(t)};
}

}  // namespace whine
