#include "studies/error_budget.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "signal/spectrum.h"
#include "studies/refinement.h"
#include "studies/width_levels.h"
#include "system/face_points.h"
#include "system/flank_pressure.h"
#include "system/statics.h"
#include "system/system_rest.h"

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr int kJudgedHarmonics = 5;  // as far as the positions resolve them

// Of a mesh.
struct Outcome {
  double mean_stiffness, peak_to_peak, pressure;
  VectorXd harmonic;
  VectorXd root_stress;  // (side) Pa, empty: not known
  double load_factor;    // 0: of one slice
};
using Outcomes = std::vector<Outcome>;  // of the meshes that carry a load

// What one thing changed alone leads to; coarser: where its order can show, changed the other way by the factor of 2.
struct Alternative {
  std::string name;
  Outcomes outcome;
  std::optional<Outcomes> coarser = {};
};
using AlternativeList = std::vector<Alternative>;

Outcome outcome(const StaticResult& s) {
  const int count = resolved_harmonics(s.transmission_error.size(), kJudgedHarmonics, s.hunting_periods);
  return {s.mean_stiffness,        s.transmission_error.maxCoeff() - s.transmission_error.minCoeff(),
          s.flank_pressure.smooth, harmonics(s.transmission_error, count, s.hunting_periods).amplitude,
          s.root_stress_max,       s.face.none() ? 0 : s.face.load_factor};
}

// What all have in common, relative to a reference.
VectorXd relative_change(const Outcomes& to, const Outcomes& from, const Outcomes& reference) {
  const Eigen::Index known = reference[0].harmonic.size(), kOwn = 2 + known;
  VectorXd out(kOwn * static_cast<Eigen::Index>(reference.size()));
  for (size_t m = 0; m < reference.size(); ++m)
    out.segment(kOwn * static_cast<Eigen::Index>(m), kOwn)
        << (to[m].mean_stiffness - from[m].mean_stiffness) / reference[m].mean_stiffness,
        (to[m].peak_to_peak - from[m].peak_to_peak) / reference[m].peak_to_peak,
        (to[m].harmonic - from[m].harmonic).head(known) / reference[m].harmonic[0];
  return out;
}

// Of all meshes the change that is largest; of(to, from): that of one. One that is not finite counts as such.
template <typename Of>
double largest_change(const Outcomes& to, const Outcomes& from, const Of& of) {
  double most = 0;
  for (size_t m = 0; m < from.size(); ++m)
    if (const double change = of(to[m], from[m]); !(std::abs(change) <= std::abs(most))) most = change;
  return most;
}

double of_root_stress(const Outcome& to, const Outcome& from) {
  const Eigen::ArrayXd change = to.root_stress.array() / from.root_stress.array() - 1;
  return std::abs(change[0]) > std::abs(change[1]) ? change[0] : change[1];
}

StaticChanges changes(const AlternativeList& others, const Outcomes& reference) {
  const auto count = static_cast<Eigen::Index>(others.size());
  const auto all = [&](const auto& known) { return std::all_of(reference.begin(), reference.end(), known); };
  const bool pressure = all([](const auto&o) { return o.pressure > 0; }),
             root_stress = all([](const auto&o) { return o.root_stress.size() > 0; }),
             load_factor = all([](const auto&o) { return o.load_factor > 0; });
  StaticChanges result;
  result.order.setZero(count);
  result.mean_stiffness_change.resize(count);
  result.peak_to_peak_change.resize(count);
  const auto known = static_cast<int>(reference[0].harmonic.size());
  result.harmonic_change.resize(count, known);
  if (pressure) result.pressure_change.resize(count);
  if (root_stress) result.root_stress_change.resize(count);
  if (load_factor) result.load_factor_change.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [name, other, coarser] = others[static_cast<size_t>(i)];
    const auto largest = [&, &to = other](const auto& of) { return largest_change(to, reference, of); };
    const auto relative = [&](double Outcome::*value) {
      return largest([=](const Outcome& a, const Outcome& b) { return a.*value / b.*value - 1; });
    };
    result.entry += (i ? ", " : "") + name;
    result.mean_stiffness_change[i] = relative(&Outcome::mean_stiffness);
    result.peak_to_peak_change[i] = relative(&Outcome::peak_to_peak);
    if (pressure) result.pressure_change[i] = relative(&Outcome::pressure);
    if (load_factor) result.load_factor_change[i] = relative(&Outcome::load_factor);
    if (root_stress) result.root_stress_change[i] = largest(of_root_stress);
    for (int n = 0; n < known; ++n)
      result.harmonic_change(i, n) = largest([n](const Outcome& a, const Outcome& b) {
        return (a.harmonic[n] - b.harmonic[n]) / b.harmonic[0];
      });
    if (coarser)
      result.order[i] = order_of(relative_change(reference, *coarser, reference).norm(),
                                 relative_change(other, reference, reference).norm());
  }
  return result;
}

// What the statics of a pair and of a train take alike.
struct RestSettings {
  Fidelity fidelity;
  ContactDiscretisation contact;
  double zone_factor = 1;
};

// Gears at rest, solved in other ways than the settings say.
struct Alternatives {
  const std::vector<ReducedBody>& bodies;
  RestSettings settings;
  std::function<SystemStaticResult(const std::vector<ReducedBody>&, const RestSettings&)> solve;
  // The next level over the face beside the given one; trains have none.
  std::function<StaticResult(const StaticResult&)> next_width_of = {};
  std::vector<size_t> loaded = {};  // meshes that carry a load

  bool one_slice() const { return settings.fidelity.width == WidthModel::one; }
  bool strips() const { return one_slice() && settings.fidelity.contact == ContactModel::strips; }
  Outcomes outcomes(const SystemStaticResult& rest) const {
    Outcomes out;
    out.reserve(loaded.size());
    for (const size_t m : loaded) out.push_back(outcome(rest.mesh[m]));
    return out;
  }
  Outcomes with(const RestSettings& other) const { return outcomes(solve(bodies, other)); }
  Outcomes next_width(const StaticResult& base) const { return {outcome(next_width_of(base))}; }
  // One plane body serves gears that are alike, whatever the hands of their helices.
  std::vector<ReducedBody> each_again(const std::function<ReducedBody(const ReducedBody&)>& again) const {
    std::vector<ReducedBody> out;
    for (size_t g = 0; g < bodies.size(); ++g) {
      size_t like = 0;
      while (bodies[like].compliance != bodies[g].compliance ||
             bodies[like].crack_compliance.rows() != bodies[g].crack_compliance.rows())
        ++like;
      out.push_back(like < g ? out[like] : again(bodies[g]));
    }
    return out;
  }
  // With tables over the face, which have refinements of their own, as they are.
  Outcomes of_bodies(const std::function<void(BodyDiscretisation&)>& change) const {
    constexpr int kModes = 1;  // statics ask for none
    std::vector<ReducedBody> other = each_again([&](const ReducedBody& body) {
      BodyDiscretisation plane = body.discretisation;
      plane.width = {};
      change(plane);
      return reduced_again(body, plane, kModes);
    });
    for (size_t g = 0; g < bodies.size(); ++g) {
      other[g].design = bodies[g].design;
      other[g].inertia = bodies[g].inertia;
      other[g].mass = bodies[g].mass;
      other[g].width = bodies[g].width;
      other[g].discretisation.width = bodies[g].discretisation.width;
    }
    return outcomes(solve(other, settings));
  }
  // Bodies in three dimensions on sections with elements of this share of their size.
  Outcomes of_sections(double share) const {
    std::vector<ReducedBody> other = bodies;
    for (ReducedBody& body : other) {
      const WidthDiscretisation& width = body.discretisation.width;
      add_width({width.degree, share * width.section_size}, body);
    }
    return outcomes(solve(other, settings));
  }
  // With elements on the roots that are `share` times as large; size (m) becomes the first gear's.
  SystemStaticResult with_root_elements(double share, double& size) const {
    size = 0;
    return solve(each_again([share, &size](const ReducedBody& body) {
                   ReducedBody finer = body;
                   const double own =
                       refine_root_stress(make_sector_mesh(body.design, body.discretisation), share, finer);
                   if (size == 0) size = own;
                   return finer;
                 }),
                 settings);
  }
};

// at(2): twice as fine; coarse: whether at(0.5) is possible.
void refine(AlternativeList& list, const std::string& name, const std::function<Outcomes(double)>& at,
            bool coarse) {
  list.push_back({name, at(2), coarse ? std::optional(at(0.5)) : std::nullopt});
}

// A number of the contact, of which half must be whole and not below `least`.
void refine_contact(const Alternatives& gears, int ContactDiscretisation::*number, int least,
                    const char* name, AlternativeList& refined) {
  const int present = gears.settings.contact.*number;
  refine(
      refined, from_to(name, present, 2 * present),
      [&](double finer) {
        RestSettings other = gears.settings;
        other.contact.*number = static_cast<int>(std::lround(present * finer));
        return gears.with(other);
      },
      present % 2 == 0 && present / 2 >= least);
}

// Of contact over the face: its points and, of bodies in three dimensions, their section and degree.
void refine_over_face(const Alternatives& gears, const StaticResult& base, AlternativeList& refined) {
  constexpr int kLeastPoints = 2;
  refine_contact(gears, &ContactDiscretisation::face_points, kLeastPoints, "face points", refined);
  if (gears.settings.fidelity.width != WidthModel::body) return;
  const double section = gears.bodies[0].discretisation.width.section_size;
  refined.push_back({from_to("section", shown_length(section), shown_length(0.5 * section), " mm"),
                     gears.of_sections(0.5)});
  refined.push_back({from_to("degree", base.face.degree, base.face.degree - 2), gears.next_width(base)});
}

void refine_bodies(const Alternatives& gears, AlternativeList& refined) {
  constexpr int kLeastPoints = 8;
  constexpr double kCoarsest = 0.5;  // of a module
  const BodyDiscretisation& present = gears.bodies[0].discretisation;
  const int points = present.flank_points;
  refine(
      refined, from_to("flank table", points, 2 * points, " points"),
      [&](double finer) {
        return gears.of_bodies([&](BodyDiscretisation& body) {
          body.flank_points = static_cast<int>(std::lround(body.flank_points * finer));
        });
      },
      points / 2 >= kLeastPoints);
  const double element = present.element_size;
  refine(
      refined, from_to("elements", shown_length(element), shown_length(0.5 * element), " mm"),
      [&](double finer) {
        return gears.of_bodies([&](BodyDiscretisation& body) { body.element_size /= finer; });
      },
      2 * element <= kCoarsest * gears.bodies[0].design.module);
  if (std::any_of(gears.bodies.begin(), gears.bodies.end(),
                  [](const ReducedBody& body) { return body.discretisation.element_order == 1; }))
    refined.push_back(
        {from_to("order", 1, 2), gears.of_bodies([](BodyDiscretisation& body) { body.element_order = 2; })});
}

AlternativeList refinements(const Alternatives& gears, const StaticResult& base) {
  constexpr int kLeastStrips = 4, kLeastPositions = 2 * kJudgedHarmonics + 2;
  AlternativeList refined;
  if (!gears.one_slice()) refine_over_face(gears, base, refined);
  if (gears.strips()) refine_contact(gears, &ContactDiscretisation::strips, kLeastStrips, "strips", refined);
  refine_bodies(gears, refined);
  if (gears.strips()) {
    RestSettings wider = gears.settings;
    wider.zone_factor = 2;
    refined.push_back({from_to("search range", 1, 2, " times"), gears.with(wider)});
  }
  refine_contact(gears, &ContactDiscretisation::positions, kLeastPositions, "positions", refined);
  return refined;
}

// What is no refinement. A choice has limits of its own: `missing` says why one cannot be made.
AlternativeList other_choices(const Alternatives& gears, const StaticResult& base, std::string& missing) {
  AlternativeList chosen;
  const auto choose = [&](const std::string& name, const std::function<Outcomes()>& instead) {
    try {
      chosen.push_back({name, instead()});
    } catch (const Error& error) {
      missing += text(missing.empty() ? "" : "; ", name, ": ", error.what());
    }
  };
  if (!gears.one_slice()) {
    if (gears.next_width_of && gears.settings.fidelity.width == WidthModel::slices)
      choose("width body", [&] { return gears.next_width(base); });
    return chosen;
  }
  const BodyDiscretisation& present = gears.bodies[0].discretisation;
  const bool matched = present.near_field == NearField::matching;
  choose(matched ? "subtraction" : text("matching at ", shown_length(present.matching_depth), " mm"), [&] {
    return gears.of_bodies([&](BodyDiscretisation& body) {
      body.near_field = matched ? NearField::subtraction : NearField::matching;
    });
  });
  if (present.element_order == 2)  // there is no higher order to refine to
    choose("order 1",
           [&] { return gears.of_bodies([](BodyDiscretisation& body) { body.element_order = 1; }); });
  RestSettings other = gears.settings;
  other.fidelity.contact = gears.strips() ? ContactModel::line : ContactModel::strips;
  choose(text("contact ", other.fidelity.contact), [&] { return gears.with(other); });
  return chosen;
}

// (gear) Pa: largest root stress of each gear in all its meshes; empty: not known.
VectorXd root_stress_of(const SystemStaticResult& rest, const std::vector<std::string>& gears) {
  VectorXd out = VectorXd::Zero(static_cast<Eigen::Index>(gears.size()));
  for (const StaticResult& s : rest.mesh)
    for (size_t side = 0; side < kSides && s.root_stress_max.size() > 0; ++side)
      if (const auto gear = std::find(gears.begin(), gears.end(), s.mesh.gear[side]); gear != gears.end())
        out[gear - gears.begin()] =
            std::max(out[gear - gears.begin()], s.root_stress_max[static_cast<Eigen::Index>(side)]);
  return out.size() > 0 && out.minCoeff() > 0 ? out : VectorXd();
}

// With the elements on the roots once, half, a quarter and an eighth as large; none without root stress. Of bodies in three dimensions,
// whose roots are refined with their sections, none.
RootRefinement root_levels(const Alternatives& gears, const SystemStaticResult& present,
                           const std::vector<std::string>& names) {
  constexpr int kLevels = 4;
  RootRefinement out;
  const VectorXd stress = root_stress_of(present, names);
  if (stress.size() == 0 || gears.settings.fidelity.width == WidthModel::body) return out;
  out.element_size.resize(kLevels);
  out.stress.resize(kLevels, stress.size());
  out.stress.row(0) = stress.transpose();
  for (int k = 1; k < kLevels; ++k)
    out.stress.row(k) =
        root_stress_of(gears.with_root_elements(std::pow(0.5, k), out.element_size[k]), names).transpose();
  out.element_size[0] = 2 * out.element_size[1];
  return out;
}

ErrorBudgetResult budget_of(Alternatives gears, std::vector<std::string> names) {
  const SystemStaticResult base = gears.solve(gears.bodies, gears.settings);
  for (size_t m = 0; m < base.mesh.size(); ++m)
    if (base.mesh[m].mean_stiffness > 0) gears.loaded.push_back(m);
  const Outcomes reference = gears.outcomes(base);
  ErrorBudgetResult budget;
  static_cast<GearPairParameters&>(budget) = base.mesh[0];
  budget.torque = torque_of(base);
  budget.refinement = changes(refinements(gears, base.mesh[0]), reference);
  budget.root = root_levels(gears, base, names);
  budget.choice = changes(other_choices(gears, base.mesh[0], budget.choice_missing), reference);
  budget.gear_names = std::move(names);
  return budget;
}

// Of statics with other settings.
template <typename Parameters>
Parameters changed(Parameters statics, const RestSettings& to) {
  statics.fidelity = to.fidelity;
  statics.contact = to.contact;
  return statics;
}

RestSettings settings_of(const auto& statics) {
  RestSettings out{statics.fidelity, statics.contact};
  if (out.fidelity.width != WidthModel::one)
    out.contact.face_points = face_points_of(statics.mesh, statics.contact);
  return out;
}

}  // namespace

ErrorBudgetResult error_budget(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticParameters& settings, double torque) {
  const std::vector bodies{driver, driven};
  const auto solve = [&](const std::vector<ReducedBody>& of, const RestSettings& to) {
    return pair_at_rest(of[0], of[1], changed(settings, to), torque, to.zone_factor);
  };
  const auto next_width = [&](const StaticResult& base) {
    return next_width_level(driver, driven, settings, base);
  };
  return budget_of({bodies, settings_of(settings), solve, next_width},
                   {settings.mesh.gear[0], settings.mesh.gear[1]});
}

ErrorBudgetResult error_budget(const SystemStaticParameters& settings,
                               const std::vector<ReducedBody>& bodies) {
  const auto solve = [&](const std::vector<ReducedBody>& of, const RestSettings& to) {
    return system_at_rest(changed(settings, to), of, to.zone_factor);
  };
  return budget_of({bodies, settings_of(settings), solve}, settings.gears());
}

NextLevel next_contact_level(const ReducedBody& driver, const ReducedBody& driven,
                             const StaticParameters& settings, const StaticResult& result) {
  if (settings.fidelity.contact != ContactModel::line)
    fail(Failure::input, "contact = \"", settings.fidelity.contact,
         "\" is the last model level of contact; the error budget says what its strips are worth");
  StaticParameters next = settings;
  next.fidelity.contact = ContactModel::strips;
  const StaticResult strips = static_transmission(driver, driven, next, result.torque);
  const GearPair gears(driver.design, driven.design, settings.mesh.centre_distance);
  const double mean_error = strips.transmission_error.mean(),
               load = result.torque / gears.gear(0).base_radius();
  const auto load_of = [](const StaticResult& a, Eigen::Index position, int pair) {
    const int j = pair - a.pair[0];
    return j >= 0 && j < a.pair.size() ? a.tooth_load(position, j) : 0.0;
  };
  const int lowest = std::min(result.pair[0], strips.pair[0]),
            highest = std::max(result.pair[result.pair.size() - 1], strips.pair[strips.pair.size() - 1]);
  NextLevel change;
  for (Eigen::Index i = 0; i < result.mesh_phase.size(); ++i) {
    bool corner = false;
    double worst = 0;
    for (int pair = lowest; pair <= highest; ++pair) {
      const double line = load_of(result, i, pair), by_strips = load_of(strips, i, pair);
      worst = std::max(worst, std::abs(by_strips - line) / load);
      if (line > 0 || by_strips > 0)
        corner |= gears.contact(result.mesh_phase[i] - std::floor(result.mesh_phase[i]) + pair).corner;
    }
    const double error = (strips.transmission_error[i] - result.transmission_error[i]) / mean_error;
    StaticDifference& zone = corner ? change.corner : change.elsewhere;
    ++zone.positions;
    zone.error_largest = std::max(zone.error_largest, std::abs(error));
    zone.load_largest = std::max(zone.load_largest, worst);
    zone.error_rms += error * error;
    zone.load_rms += worst * worst;
  }
  for (StaticDifference* zone : {&change.corner, &change.elsewhere})
    if (zone->positions > 0) {
      zone->error_rms = std::sqrt(zone->error_rms / zone->positions);
      zone->load_rms = std::sqrt(zone->load_rms / zone->positions);
    }
  return change;
}

}  // namespace whine
