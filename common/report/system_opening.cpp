#include "report/system_opening.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/one_system.h"
#include "report/opening.h"

namespace whine {
namespace {

using Eigen::Index;

std::string driving_load(const SystemReport& r, const std::string& driver) {
  const System& s = layout_of(r);
  for (size_t b = 0; b < s.bodies.size(); ++b)
    if (s.bodies[b].name == driver)
      return torque_words(std::round(r.rest->torque.col(static_cast<Index>(b)).mean() * 1e6) * 1e-6) +
             " on " + driver;
  return "the torques of the scene";
}

std::string train_excitation(const SystemReport& r, const TurningMember& driver) {
  if (!r.rest) return excitation_line("", {});
  const SystemStaticResult& a = *r.rest;
  std::vector<MeshExcitation> out;
  for (const AlikeMeshes& section : alike_meshes(a.settings)) {
    MeshExcitation& e = out.emplace_back(MeshExcitation{section.name, {1e30, 0}, {1e30, 0}});
    for (const size_t m : section.meshes) {
      const StaticResult& mesh = a.mesh[m];
      const double swing = peak_to_peak(mesh.transmission_error),
                   first =
                       mesh.transmission_error_harmonic.size() > 1 ? mesh.transmission_error_harmonic[1] : 0;
      e.peak_to_peak = {std::min(e.peak_to_peak.least, swing), std::max(e.peak_to_peak.most, swing)};
      e.first_order = {std::min(e.first_order.least, first), std::max(e.first_order.most, first)};
    }
  }
  return excitation_line(driving_load(r, driver.name), out);
}

std::optional<SpeedRange> swept_speeds(const SystemReport& r) {
  if (r.sweeps.empty()) return std::nullopt;
  const Eigen::VectorXd& f = r.sweeps.front().mesh_frequency;
  return SpeedRange{f.minCoeff(), f.maxCoeff()};
}

std::string train_critical_speeds(const SystemReport& r, const TurningMember& driver) {
  constexpr double kMeshMode = 0.1;  // of the energy in the meshes: what transmission errors excite
  constexpr int kOrders = 3;
  constexpr double kAlike = 0.01;
  CriticalSpeeds out{driver, swept_speeds(r), {}, {}};
  if (r.modes) {
    const ModesResult& a = *r.modes;
    std::vector<std::tuple<int, double, Index>>
        modes;  // by the lowest order that meets them and the energy in the meshes
    for (Index i = 0; i < a.natural_frequency.size(); ++i) {
      const double f = a.natural_frequency[i], energy = a.mesh_energy.row(i).sum();
      int order = 1;
      while (order <= kOrders && out.speeds && (f / order < out.speeds->from || f / order > out.speeds->to))
        ++order;
      if (f > 0 && energy > kMeshMode && order <= kOrders) modes.emplace_back(order, -energy, i);
    }
    std::sort(modes.begin(), modes.end());
    for (const auto& [order, energy, i] : modes) {
      // Pairs of translational modes have one frequency, or nearly so.
      const double f = a.natural_frequency[i];
      if (std::any_of(out.natural.begin(), out.natural.end(),
                      [&](const auto& known) { return std::abs(known.frequency - f) < kAlike * f; }))
        continue;
      out.natural.push_back({f, text("mode ", i + 1, ", ", name_of(a.type[static_cast<size_t>(i)]))});
    }
  }
  if (!r.sweeps.empty()) {
    const ResponseResult& a = r.sweeps.front();
    for (const Index i : resonances(a.mesh_frequency, a.dte_rms.rowwise().maxCoeff()))
      out.peaks.push_back(a.mesh_frequency[i]);
  }
  return critical_speed_line(out);
}

std::map<double, bool> apart_at(const ResponseResult& a) {
  std::map<double, bool> out;
  for (Index i = 0; i < a.mesh_frequency.size(); ++i)
    out[a.mesh_frequency[i]] = a.separation_fraction.row(i).maxCoeff() > 0;
  return out;
}

std::string train_parting(const SystemReport& r, const TurningMember& driver) {
  Parting out;
  out.member = driver;
  out.speeds = swept_speeds(r);
  std::vector<std::string> names;
  for (const ResponseResult& a : r.sweeps) {
    (a.direction == Direction::up ? out.rising : out.falling) =
        Parting::Sweep{marked_ranges(apart_at(a)), {a.jump_frequency.begin(), a.jump_frequency.end()}};
    for (const AlikeMeshes& section : alike_meshes(r.rest->settings))
      if (std::any_of(
              section.meshes.begin(), section.meshes.end(),
              [&](size_t m) { return a.separation_fraction.col(static_cast<Index>(m)).maxCoeff() > 0; }) &&
          std::find(names.begin(), names.end(), section.name) == names.end())
        names.push_back(section.name);
  }
  out.meshes = listed(names);
  if (r.sweeps.size() == 2) {
    const size_t up = r.sweeps[0].direction == Direction::up ? 0 : 1;
    out.only_falling = marked_ranges(but_not(apart_at(r.sweeps[1 - up]), apart_at(r.sweeps[up])));
  }
  return parting_line(out);
}

std::string train_dynamic_factor(const SystemReport& r, const TurningMember& driver) {
  std::vector<DynamicFactor> out;
  if (!r.sweeps.empty())
    for (const AlikeMeshes& section : alike_meshes(r.rest->settings)) {
      DynamicFactor most{section.name, 0, 0, {}};
      for (const ResponseResult& a : r.sweeps)
        for (const size_t number : section.meshes) {
          const auto m = static_cast<Index>(number);
          const double rest = r.rest->mesh_force.col(m).mean();
          Index at = 0;
          const double factor = rest > 0 ? a.mesh_force_max.col(m).maxCoeff(&at) / rest : 0;
          if (factor > most.factor) most = {section.name, factor, a.mesh_frequency[at], {}};
        }
      if (most.factor > 0) out.push_back(most);
    }
  return dynamic_factor_line(driver, out, "its formulas are of one mesh");
}

// What tip edges of a section carry, where nothing is taken off both gears' tips.
void add_relief(const SystemStaticResult& a, const AlikeMeshes& section, Advice& out) {
  constexpr double kSmall = 0.01;  // of the largest load of a pair
  double edge = 0, load = 0, deflection = 0;
  for (const size_t m : section.meshes) {
    deflection = std::max(deflection, a.mesh_deflection.col(static_cast<Index>(m)).maxCoeff());
    const StaticResult& mesh = a.mesh[m];
    load = std::max(load, mesh.tooth_load.maxCoeff());
    edge = std::max(edge, tip_edge_load(mesh));
  }
  if (edge > kSmall * load) out.relief.push_back({section.name, deflection, edge});
}

std::string train_advice(const SystemReport& r, const TurningMember& driver) {
  Advice out;
  out.member = driver;
  if (r.rest) {
    const std::vector<AlikeMeshes> sections = alike_meshes(r.rest->settings);
    for (size_t k = 0; k < sections.size(); ++k) {
      const auto& modification = r.rest->settings.mesh[k].modification;
      if (!(modification[0].tip.amount > 0 && modification[1].tip.amount > 0))
        add_relief(*r.rest, sections[k], out);
    }
    constexpr double kUnequal = 1.3;  // of an equal share
    for (const LoadSharing& of : load_sharing(*r.rest))
      if (of.factor > kUnequal)
        out.more.push_back(text("One of the meshes of ", of.name, " carries ", fixed(of.factor, 2),
                                " times an equal share: let a central gear float on a softer [[bearing]]."));
  }
  for (const ResponseResult& a : r.sweeps) out.parts = out.parts || a.separation_fraction.maxCoeff() > 0;
  constexpr double kNearPeak = 0.7;
  std::map<double, bool> marked;
  for (const ResponseResult& a : r.sweeps) {
    const Eigen::VectorXd rms = a.dte_rms.rowwise().maxCoeff();
    if (!out.parts && resonances(a.mesh_frequency, rms).empty()) continue;
    for (const auto& [f, lost] : apart_at(a)) marked[f] |= out.parts && lost;
    for (Index i = 0; !out.parts && i < rms.size(); ++i)
      marked[a.mesh_frequency[i]] |= rms[i] > kNearPeak * rms.maxCoeff();
  }
  out.avoid = marked_ranges(marked);
  if (!r.rest)
    out.more.emplace_back(
        "Keep the speeds of operation away from the critical ones; give the gears drawings and materials to see what excites them.");
  return advice_line(out);
}

}  // namespace

TurningMember driving_member(const SystemReport& r) {
  const System& s = layout_of(r);
  size_t driver = 0;
  double most = 0;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    if (s.held(static_cast<int>(b))) continue;
    const double torque =
        r.rest ? r.rest->torque.col(static_cast<Index>(b)).mean() : s.torque(static_cast<int>(b));
    if (torque > most) {
      most = torque;
      driver = b;
    }
  }
  Figure speeds;
  add_shafts(s, speeds);
  return {s.bodies[driver].name, speeds.shafts.empty() ? 0 : std::abs(speeds.shafts[driver].turns)};
}

std::vector<std::string> opening_lines(const SystemReport& r) {
  const TurningMember driver = driving_member(r);
  return {train_excitation(r, driver), train_critical_speeds(r, driver), train_parting(r, driver),
          train_dynamic_factor(r, driver), train_advice(r, driver)};
}

}  // namespace whine
