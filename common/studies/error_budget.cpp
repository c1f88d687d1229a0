#include "studies/error_budget.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

using NamedOutcomes = std::vector<std::pair<std::string, Outcome>>;

Outcome outcome(const StaticResult& s) {
  return {s.mean_stiffness,        s.transmission_error.maxCoeff() - s.transmission_error.minCoeff(),
          s.flank_pressure.smooth, harmonics(s.transmission_error, kJudgedHarmonics).amplitude,
          s.root_stress_max,       s.face.none() ? 0 : s.face.load_factor};
}

StaticChanges changes(const NamedOutcomes& others, const Outcome& reference) {
  const auto count = static_cast<Eigen::Index>(others.size());
  StaticChanges result;
  result.mean_stiffness_change.resize(count);
  result.peak_to_peak_change.resize(count);
  result.harmonic_change.resize(count, kJudgedHarmonics);
  if (reference.pressure > 0) result.pressure_change.resize(count);
  if (reference.root_stress.size() > 0) result.root_stress_change.resize(count);
  if (reference.load_factor > 0) result.load_factor_change.resize(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [name, other] = others[i];
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
  // Bodies of another discretisation, with `finer` times the points of the flank table.
  Outcome of_bodies(const std::function<void(BodyDiscretisation&)>& change, int finer = 1) const {
    constexpr int kModes = 1;  // statics ask for none
    const auto again = [&](const ReducedBody& body) {
      BodyDiscretisation other = body.discretisation;
      other.width = {};
      change(other);
      return reduced_again(body, other, kModes, finer * static_cast<int>(body.flank_position.size()));
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

// Of contact over the face: its points and, of bodies in three dimensions, their section and degree.
void refine_over_face(const Alternatives& pair, const StaticResult& base, NamedOutcomes& refined) {
  constexpr int kMostPoints = 64;
  const int points = face_points_of(pair.settings.mesh, pair.settings.contact);
  StaticParameters finer = pair.settings;
  finer.contact.face_points = std::min(kMostPoints, 2 * points);
  refined.emplace_back(from_to("face points", points, finer.contact.face_points), pair.with(finer));
  if (pair.settings.fidelity.width != WidthModel::body) return;
  const double section = pair.driver.discretisation.width.section_size;
  refined.emplace_back(from_to("section", shown_length(section), shown_length(0.5 * section), " mm"),
                       pair.of_sections(0.5));
  refined.emplace_back(from_to("degree", base.face.degree, base.face.degree - 2),
                       outcome(next_width_level(pair.driver, pair.driven, pair.settings, base)));
}

NamedOutcomes refinements(const Alternatives& pair, const StaticResult& base) {
  NamedOutcomes refined;
  if (!pair.one_slice()) refine_over_face(pair, base, refined);
  if (pair.strips()) {
    StaticParameters finer = pair.settings;
    finer.contact.strips *= 2;
    refined.emplace_back(from_to("strips", pair.settings.contact.strips, finer.contact.strips),
                         pair.with(finer));
  }
  const auto flank_points = static_cast<int>(pair.driver.flank_position.size());
  refined.emplace_back(from_to("flank table", flank_points, 2 * flank_points, " points"),
                       pair.of_bodies([](BodyDiscretisation&) {}, 2));
  const double element = pair.driver.discretisation.element_size;
  refined.emplace_back(from_to("elements", shown_length(element), shown_length(0.5 * element), " mm"),
                       pair.of_bodies([](BodyDiscretisation& body) { body.element_size *= 0.5; }));
  if (pair.driver.discretisation.element_order == 1 || pair.driven.discretisation.element_order == 1)
    refined.emplace_back(from_to("order", 1, 2),
                         pair.of_bodies([](BodyDiscretisation& body) { body.element_order = 2; }));
  if (pair.strips())
    refined.emplace_back(from_to("search range", 1, 2, " times"), pair.with(pair.settings, 2));
  StaticParameters denser = pair.settings;
  denser.contact.positions *= 2;
  refined.emplace_back(from_to("positions", pair.settings.contact.positions, denser.contact.positions),
                       pair.with(denser));
  return refined;
}

// What is no refinement. A choice has limits of its own: `missing` says why one cannot be made.
NamedOutcomes other_choices(const Alternatives& pair, const StaticResult& base, std::string& missing) {
  NamedOutcomes chosen;
  const auto choose = [&](const std::string& name, const std::function<Outcome()>& instead) {
    try {
      chosen.emplace_back(name, instead());
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
