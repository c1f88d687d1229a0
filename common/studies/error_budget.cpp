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

namespace whine {

using Eigen::VectorXd;

namespace {

constexpr int kJudgedHarmonics = 5;

struct Outcome {
  double mean_stiffness, peak_to_peak, pressure;
  VectorXd harmonic;
  VectorXd root_stress;  // (gear) Pa, empty: not known
  double load_factor;    // 0: of one slice
};

// What one thing changed alone leads to; coarser: where its order can show, changed the other way by the factor of 2.
struct Alternative {
  std::string name;
  Outcome outcome;
  std::optional<Outcome> coarser = {};
};
using AlternativeList = std::vector<Alternative>;

Outcome outcome(const StaticResult& s) {
  return {s.mean_stiffness,        s.transmission_error.maxCoeff() - s.transmission_error.minCoeff(),
          s.flank_pressure.smooth, harmonics(s.transmission_error, kJudgedHarmonics).amplitude,
          s.root_stress_max,       s.face.none() ? 0 : s.face.load_factor};
}

// What both have in common, relative to a reference.
VectorXd relative_change(const Outcome& to, const Outcome& from, const Outcome& reference) {
  VectorXd out(2 + kJudgedHarmonics);
  out << (to.mean_stiffness - from.mean_stiffness) / reference.mean_stiffness,
      (to.peak_to_peak - from.peak_to_peak) / reference.peak_to_peak,
      (to.harmonic - from.harmonic) / reference.harmonic[0];
  return out;
}

StaticChanges changes(const AlternativeList& others, const Outcome& reference) {
  const auto count = static_cast<Eigen::Index>(others.size());
  StaticChanges result;
  result.order.setZero(count);
  result.mean_stiffness_change.resize(count);
  result.peak_to_peak_change.resize(count);
  result.harmonic_change.resize(count, kJudgedHarmonics);
  if (reference.pressure > 0) result.pressure_change.resize(count);
  if (reference.root_stress.size() > 0) result.root_stress_change.resize(count);
  if (reference.load_factor > 0) result.load_factor_change.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [name, other, coarser] = others[static_cast<size_t>(i)];
    result.entry += (i ? ", " : "") + name;
    result.mean_stiffness_change[i] = other.mean_stiffness / reference.mean_stiffness - 1;
    result.peak_to_peak_change[i] = other.peak_to_peak / reference.peak_to_peak - 1;
    if (reference.pressure > 0) result.pressure_change[i] = other.pressure / reference.pressure - 1;
    if (reference.load_factor > 0)
      result.load_factor_change[i] = other.load_factor / reference.load_factor - 1;
    if (reference.root_stress.size() > 0) {
      const Eigen::ArrayXd change = other.root_stress.array() / reference.root_stress.array() - 1;
      result.root_stress_change[i] = std::abs(change[0]) > std::abs(change[1]) ? change[0] : change[1];
    }
    result.harmonic_change.row(i) = (other.harmonic - reference.harmonic).transpose() / reference.harmonic[0];
    if (coarser)
      result.order[i] = order_of(relative_change(reference, *coarser, reference).norm(),
                                 relative_change(other, reference, reference).norm());
  }
  return result;
}

// The pair at rest, solved in other ways than the settings say.
struct Alternatives {
  const ReducedBody &driver, &driven;
  const StaticParameters& settings;
  double torque;  // N m

  bool one_slice() const { return settings.fidelity.width == WidthModel::one; }
  bool strips() const { return one_slice() && settings.fidelity.contact == ContactModel::strips; }
  // One plane body serves both gears, whatever the hands of their helices.
  bool alike() const { return driver.compliance == driven.compliance; }
  // The plane body of a gear with the tables over its face, which have refinements of their own.
  static ReducedBody over_face(ReducedBody plane, const ReducedBody& of) {
    plane.design = of.design;
    plane.width = of.width;
    plane.discretisation.width = of.discretisation.width;
    return plane;
  }
  Outcome with(const StaticParameters& other, double zone_factor = 1) const {
    return outcome(static_transmission(driver, driven, other, torque, zone_factor));
  }
  Outcome of_bodies(const std::function<void(BodyDiscretisation&)>& change) const {
    constexpr int kModes = 1;  // statics ask for none
    const auto again = [&](const ReducedBody& body) {
      BodyDiscretisation other = body.discretisation;
      other.width = {};
      change(other);
      return reduced_again(body, other, kModes);
    };
    const ReducedBody first = again(driver);
    return outcome(static_transmission(over_face(first, driver),
                                       over_face(alike() ? first : again(driven), driven), settings, torque));
  }
  // Bodies in three dimensions on sections with elements of this share of their size.
  Outcome of_sections(double share) const {
    const auto again = [share](ReducedBody body) {
      const WidthDiscretisation& width = body.discretisation.width;
      add_width({width.degree, share * width.section_size}, body);
      return body;
    };
    return outcome(static_transmission(again(driver), again(driven), settings, torque));
  }
  // (gear) Pa: largest root stress with elements on the roots that are `share` times as large; size (m) becomes the driver's.
  VectorXd with_root_elements(double share, double& size) const {
    const auto again = [share, &size](const ReducedBody& body) {
      ReducedBody finer = body;
      size = refine_root_stress(make_sector_mesh(body.design, body.discretisation), share, finer);
      return finer;
    };
    const ReducedBody second = again(driven);  // the driver last: it leaves its size
    const ReducedBody first = alike() ? second : again(driver);
    return static_transmission(first, second, settings, torque).root_stress_max;
  }
};

// at(2): twice as fine; coarse: whether at(0.5) is possible.
void refine(AlternativeList& list, const std::string& name, const std::function<Outcome(double)>& at,
            bool coarse) {
  list.push_back({name, at(2), coarse ? std::optional(at(0.5)) : std::nullopt});
}

// A number of the contact, of which half must be whole and not below `least`.
void refine_contact(const Alternatives& pair, int ContactDiscretisation::*number, int present, int least,
                    const char* name, AlternativeList& refined) {
  refine(
      refined, from_to(name, present, 2 * present),
      [&](double finer) {
        StaticParameters other = pair.settings;
        other.contact.*number = static_cast<int>(std::lround(present * finer));
        return pair.with(other);
      },
      present % 2 == 0 && present / 2 >= least);
}

// Of contact over the face: its points and, of bodies in three dimensions, their section and degree.
void refine_over_face(const Alternatives& pair, const StaticResult& base, AlternativeList& refined) {
  constexpr int kLeastPoints = 2;
  refine_contact(pair, &ContactDiscretisation::face_points,
                 face_points_of(pair.settings.mesh, pair.settings.contact), kLeastPoints, "face points",
                 refined);
  if (pair.settings.fidelity.width != WidthModel::body) return;
  const double section = pair.driver.discretisation.width.section_size;
  refined.push_back(
      {from_to("section", shown_length(section), shown_length(0.5 * section), " mm"), pair.of_sections(0.5)});
  refined.push_back({from_to("degree", base.face.degree, base.face.degree - 2),
                     outcome(next_width_level(pair.driver, pair.driven, pair.settings, base))});
}

void refine_bodies(const Alternatives& pair, AlternativeList& refined) {
  constexpr int kLeastPoints = 8;
  constexpr double kCoarsest = 0.5;  // of a module
  const BodyDiscretisation& present = pair.driver.discretisation;
  const int points = present.flank_points;
  refine(
      refined, from_to("flank table", points, 2 * points, " points"),
      [&](double finer) {
        return pair.of_bodies([&](BodyDiscretisation& body) {
          body.flank_points = static_cast<int>(std::lround(body.flank_points * finer));
        });
      },
      points / 2 >= kLeastPoints);
  const double element = present.element_size;
  refine(
      refined, from_to("elements", shown_length(element), shown_length(0.5 * element), " mm"),
      [&](double finer) {
        return pair.of_bodies([&](BodyDiscretisation& body) { body.element_size /= finer; });
      },
      2 * element <= kCoarsest * pair.driver.design.module);
  if (present.element_order == 1 || pair.driven.discretisation.element_order == 1)
    refined.push_back(
        {from_to("order", 1, 2), pair.of_bodies([](BodyDiscretisation& body) { body.element_order = 2; })});
}

AlternativeList refinements(const Alternatives& pair, const StaticResult& base) {
  constexpr int kLeastStrips = 4, kLeastPositions = 8;
  AlternativeList refined;
  const ContactDiscretisation& contact = pair.settings.contact;
  if (!pair.one_slice()) refine_over_face(pair, base, refined);
  if (pair.strips())
    refine_contact(pair, &ContactDiscretisation::strips, contact.strips, kLeastStrips, "strips", refined);
  refine_bodies(pair, refined);
  if (pair.strips())
    refined.push_back({from_to("search range", 1, 2, " times"), pair.with(pair.settings, 2)});
  refine_contact(pair, &ContactDiscretisation::positions, contact.positions, kLeastPositions, "positions",
                 refined);
  return refined;
}

// What is no refinement. A choice has limits of its own: `missing` says why one cannot be made.
AlternativeList other_choices(const Alternatives& pair, const StaticResult& base, std::string& missing) {
  AlternativeList chosen;
  const auto choose = [&](const std::string& name, const std::function<Outcome()>& instead) {
    try {
      chosen.push_back({name, instead()});
    } catch (const Error& error) {
      missing += text(missing.empty() ? "" : "; ", name, ": ", error.what());
    }
  };
  if (!pair.one_slice()) {
    if (pair.settings.fidelity.width == WidthModel::slices)
      choose("width body",
             [&] { return outcome(next_width_level(pair.driver, pair.driven, pair.settings, base)); });
    return chosen;
  }
  const BodyDiscretisation& present = pair.driver.discretisation;
  const bool matched = present.near_field == NearField::matching;
  choose(matched ? "subtraction" : text("matching at ", shown_length(present.matching_depth), " mm"), [&] {
    return pair.of_bodies([&](BodyDiscretisation& body) {
      body.near_field = matched ? NearField::subtraction : NearField::matching;
    });
  });
  if (present.element_order == 2)  // there is no higher order to refine to
    choose("order 1",
           [&] { return pair.of_bodies([](BodyDiscretisation& body) { body.element_order = 1; }); });
  StaticParameters other = pair.settings;
  other.fidelity.contact = pair.strips() ? ContactModel::line : ContactModel::strips;
  choose(text("contact ", other.fidelity.contact), [&] { return pair.with(other); });
  return chosen;
}

// With the elements on the roots once, half, a quarter and an eighth as large; none without root stress.
RootRefinement root_levels(const Alternatives& pair, const Outcome& present) {
  constexpr int kLevels = 4;
  RootRefinement out;
  if (present.root_stress.size() == 0) return out;
  out.element_size.resize(kLevels);
  out.stress.resize(kLevels, present.root_stress.size());
  out.stress.row(0) = present.root_stress.transpose();
  for (int k = 1; k < kLevels; ++k)
    out.stress.row(k) = pair.with_root_elements(std::pow(0.5, k), out.element_size[k]).transpose();
  out.element_size[0] = 2 * out.element_size[1];
  return out;
}

}  // namespace

ErrorBudgetResult error_budget(const ReducedBody& driver, const ReducedBody& driven,
                               const StaticParameters& settings, double torque) {
  const Alternatives pair{driver, driven, settings, torque};
  const StaticResult base = static_transmission(driver, driven, settings, torque);
  const Outcome reference = outcome(base);
  ErrorBudgetResult budget;
  static_cast<GearPairParameters&>(budget) = base;
  budget.torque = torque;
  budget.refinement = changes(refinements(pair, base), reference);
  budget.root = root_levels(pair, reference);
  budget.choice = changes(other_choices(pair, base, budget.choice_missing), reference);
  return budget;
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
