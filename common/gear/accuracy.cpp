#include "gear/accuracy.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/face_width.h"
#include "gear/helix.h"

namespace whine {
namespace {

// e = bound (x / at)^power. share: of e^2, where the key is open; elements and modes take most of it, since the reduction takes most of
// the time.
struct Law {
  const char* key;
  double bound, at, power, share;

  double error(double x) const { return bound * std::pow(x / at, power); }
  double value(double error) const { return at * std::pow(error / bound, 1 / power); }
};
constexpr Law kStrips{"strips", 5.5e-3, 4, -1.6, 0.15}, kPoints{"face_points", 2.4e-3, 8, -1.4, 0.06},
    kElements{"element_mm", 4.7e-2, 1, 2, 0.15}, kPeriodicity{"periodicity", 3e-4, 1e-4, 1, 0.02},
    kPeriodicityOfTrain{"periodicity", 1e-2, 1e-4, 1, 0.02}, kModes{"modes", 4.5e-3, 1, -1.6, 0.40},
    kFlankPoints{"flank_points", 1.1e-3, 24, -2, 0.03}, kSteps{"min_sample_rate_kHz", 22, 1, -2, 0.25},
    kStepsOfMassDamping{"min_sample_rate_kHz", 400, 1, -2, 0.25};

// N m-1 per m, c_gamma of steel gears as practice takes it.
constexpr double kMeshStiffness = 20e9, kSteelModulus = 206e9;

// m: r_b.
double base_radius(const GearDesign& d) {
  return 0.5 * d.module * d.teeth / std::cos(d.helix_angle) * std::cos(transverse_section(d).pressure_angle);
}

// kg-1: r_b^2 / I. An inertia that is left open is that of a disc from the bore to the pitch circle.
double inverse_mass(const SceneGear& gear) {
  const GearDesign& d = gear.design;
  const double pitch = 0.5 * d.module * d.teeth / std::cos(d.helix_angle),
               disc = 0.5 * gear.material.density * std::numbers::pi * d.face_width *
                      std::abs(std::pow(pitch, 4) - std::pow(d.clamped_radius(), 4)),
               base = base_radius(d);
  return base * base / (gear.total_inertia > 0 ? gear.total_inertia : disc);
}

double natural_frequency_of(const SceneGear& a, const SceneGear& b) {
  const double modulus = 2 * a.material.youngs_modulus * b.material.youngs_modulus /
                         (a.material.youngs_modulus + b.material.youngs_modulus),
               stiffness = kMeshStiffness * contact_width(a.design, b.design) * modulus / kSteelModulus;
  return std::sqrt(stiffness * (inverse_mass(a) + inverse_mass(b))) / (2 * std::numbers::pi);
}

// What of a scene the laws are of.
struct Settings {
  const Fidelity& fidelity;
  BodyDiscretisation& body;
  ContactDiscretisation& contact;
  TimeDiscretisation& time;
  double natural_frequency, module, fastest;  // Hz, m, Hz
  double first_modes;                         // of the largest gear, those in which its teeth bend
  bool on_strips, train, mass_damped;
  const KeyGiven& given;
};

// A setting under its law: x, and what makes x a setting again, a whole number to the side of less error.
struct Governed {
  const Law* law;
  double x;
  std::function<double(double)> set;  // gives the x that it becomes
  double shown;                       // in the key's unit
};

// To ten digits, so that builds that round in another order choose the same.
double to_digits(double x) {
  constexpr int kDigits = 10;
  const double scale = std::pow(10, std::floor(std::log10(x)) + 1 - kDigits);
  return std::round(x / scale) * scale;
}

// Whole numbers first, since what they leave can go to the others. any_body: the modes of a body that a motion does not read, too.
std::vector<Governed> governed(const Settings& s, bool any_body = false) {
  std::vector<Governed> out;
  const auto whole = [](int& held, double x, int least, int most, int step) {
    held = std::clamp(step * static_cast<int>(std::ceil(x / step - 1e-9)), least, most);
    return static_cast<double>(held);
  };
  constexpr int kLeastFlankPoints = BodyDiscretisation{}.flank_points, kMostFlankPoints = 96;
  int& flank_points = s.body.flank_points;
  out.push_back(
      {&kFlankPoints, static_cast<double>(flank_points),
       [&, whole](double x) { return whole(flank_points, x, kLeastFlankPoints, kMostFlankPoints, 1); },
       static_cast<double>(flank_points)});
  if (s.on_strips) {
    constexpr int kFour = 4, kMost = 64;  // a candidate zone holds whole fours
    int& strips = s.contact.strips;
    out.push_back({&kStrips, static_cast<double>(strips),
                   [&, whole](double x) { return whole(strips, x, kFour, kMost, kFour); },
                   static_cast<double>(strips)});
  }
  if (s.fidelity.width != WidthModel::one) {
    constexpr int kMost = 64;
    int& points = s.contact.face_points;
    const int n = points > 0 ? points : kFacePoints;
    out.push_back({&kPoints, static_cast<double>(n),
                   [&, whole](double x) {  // the default has more where the load is uneven
                     points = 0;
                     return x <= kFacePoints ? kFacePoints : whole(points, x, kFacePoints, kMost, 1);
                   },
                   static_cast<double>(n)});
  }
  if (any_body ? s.fidelity.body != BodyModel::full : s.fidelity.body == BodyModel::modal) {
    constexpr int kLeast = 9, kMost = 1001;
    int& modes = s.body.modes;
    out.push_back(
        {&kModes, modes / s.first_modes,
         [&, whole, n = s.first_modes](double x) { return whole(modes, x * n, kLeast, kMost, 1) / n; },
         static_cast<double>(modes)});
  }
  const double size = relative_element_size(s.body, s.module);
  out.push_back({&kElements, size,
                 [&](double x) {
                   constexpr double kFinest = 0.04, kCoarsest = 0.25;
                   return s.body.element_modules = to_digits(std::clamp(x, kFinest, kCoarsest));
                 },
                 size * s.module * 1e3});
  double& periodicity = s.time.periodicity;
  out.push_back({s.train ? &kPeriodicityOfTrain : &kPeriodicity, periodicity,
                 [&](double x) { return periodicity = to_digits(std::clamp(x, 1e-9, 1e-3)); }, periodicity});
  double& rate = s.time.min_sample_rate;
  out.push_back({s.mass_damped ? &kStepsOfMassDamping : &kSteps, rate / s.natural_frequency,
                 [&, f = s.natural_frequency](double x) {
                   rate = to_digits(x * f);
                   return rate / f;
                 },
                 rate * 1e-3});
  return out;
}

// What the bound of a law was not measured with; empty: nothing.
std::string beyond(const Settings& s, const Law& law) {
  if (&law == &kElements && s.body.element_order != 2)
    return text("elements of second order, and element_order = ", s.body.element_order);
  if (&law == &kElements && s.body.near_field != NearField::subtraction)
    return text("near_field = \"subtraction\", and near_field = \"", s.body.near_field, "\"");
  if ((&law == &kSteps || &law == &kStepsOfMassDamping) && s.fidelity.integrator != Integrator::exact)
    return text("integrator = \"exact\", and integrator = \"", s.fidelity.integrator, "\"");
  return "";
}

DiscretisationPlan plan_of(const Settings& s) {
  DiscretisationPlan out;
  out.natural_frequency = s.natural_frequency;
  for (const Governed& one : governed(s))
    out.settings.push_back({one.law->key, one.shown, one.law->error(one.x), s.given && s.given(one.law->key),
                            beyond(s, *one.law).empty()});
  return out;
}

void require_lawful(const Settings& s) {
  for (const Governed& one : governed(s))
    if (const std::string what = beyond(s, *one.law); !what.empty())
      fail(Failure::input, "[accuracy] chooses settings for ", what,
           "; change that, or take rms_percent out and give the settings of [discretisation] yourself");
}

void choose_stored_samples(const Settings& s) {
  if (s.given("steps_per_period")) return;
  // Fewer stored samples than 64 leave no load that lasts for 1/64 of a period.
  constexpr int kFewest = 64;
  if (s.fastest * s.time.steps_per_period > s.time.min_sample_rate) s.time.steps_per_period = kFewest;
}

void choose(const Settings& s) {
  const double accepted = s.time.accepted_error;
  require_lawful(s);
  std::vector<Governed> open;
  double rest = accepted * accepted, shares = 0;
  for (Governed& one : governed(s)) {
    if (s.given(one.law->key)) {
      const double error = one.law->error(one.x);
      rest -= error * error;
    } else {
      shares += one.law->share;
      open.push_back(std::move(one));
    }
  }
  // What is given may be above the accepted error alone; the rest then adds little to it.
  constexpr double kLeast = 0.1;
  rest = std::max(rest, kLeast * accepted * accepted);
  for (const Governed& one : open) {  // what one leaves goes to the next
    const double x = one.set(one.law->value(std::sqrt(rest * one.law->share / shares))),
                 error = one.law->error(x);
    shares -= one.law->share;
    rest = std::max(rest - error * error, kLeast * accepted * accepted * shares);
  }
  choose_stored_samples(s);
}

// Each by its own share, whatever the scene gives: a key that it adds then changes itself alone, and no body that does not read it.
void choose_unasked(const Settings& s) {
  // The default number of points of a flank leaves more than its share would ask for.
  const double all = kAcceptedError * kAcceptedError - kFlankPoints.bound * kFlankPoints.bound;
  bool open = false;
  for (const Governed& one : governed(s, true)) {
    if (s.given(one.law->key) || !beyond(s, *one.law).empty()) continue;
    open |= one.set(one.law->value(std::sqrt(all * one.law->share))) != one.x;
  }
  s.time.accepted_error = open ? kAcceptedError : 0;
  if (open) choose_stored_samples(s);
}

double smallest_module(const Scene& scene) {
  double out = scene.gears.front().design.module;
  for (const auto& gear : scene.gears) out = std::min(out, gear.design.module);
  return out;
}

double first_modes(const Scene& scene) {
  constexpr int kOfDisc = 11;  // that lie among those of the teeth
  int teeth = 0;
  for (const auto& gear : scene.gears) teeth = std::max(teeth, gear.design.teeth);
  return teeth + kOfDisc;
}

// Whether most of the damping at a frequency (Hz) is that of the mass, so that none is left for fast modes.
bool mass_damped(const Damping& damping, double frequency) {
  const double omega = 2 * std::numbers::pi * frequency;
  return damping.rayleigh_mass > damping.rayleigh_stiffness * omega * omega;
}

// Hubs on bearings or several meshes have slow modes of little damping, which take long to settle.
bool in_train(const Scene& scene) {
  return !scene.pair() || std::any_of(scene.gears.begin(), scene.gears.end(),
                                      [](const SceneGear& gear) { return gear.bearing.elastic(); });
}

bool on_strips(const Scene& scene) {
  return scene.pair() && scene.fidelity.contact == ContactModel::strips &&
         scene.fidelity.width == WidthModel::one;
}

Settings settings_of(Scene& scene, const KeyGiven& given) {
  const double frequency = expected_natural_frequency(scene);
  return {scene.fidelity,
          scene.body,
          scene.contact,
          scene.time,
          frequency,
          smallest_module(scene),
          scene.operation.frequency_to,
          first_modes(scene),
          on_strips(scene),
          in_train(scene),
          mass_damped(scene.damping, frequency),
          given};
}

}  // namespace

double DiscretisationPlan::error() const {
  double sum = 0;
  for (const SettingError& one : settings) sum += one.known ? one.error * one.error : 0;
  return std::sqrt(sum);
}

double relative_element_size(const BodyDiscretisation& body, double module) {
  constexpr double kElementsInModule = 7.5;  // the default of the key
  if (body.element_size > 0) return body.element_size / module;
  return body.element_modules > 0 ? body.element_modules : 1 / kElementsInModule;
}

double expected_natural_frequency(const Scene& scene) {
  double out = 0;
  for (const GearMeshSpec& mesh : scene.specs())
    out = std::max(out, natural_frequency_of(scene.gear(mesh.gear[0]), scene.gear(mesh.gear[1])));
  return out;
}

DiscretisationPlan discretisation_plan(const Scene& scene, const KeyGiven& given) {
  Scene s = scene;
  return plan_of(settings_of(s, given));
}

void choose_discretisation(Scene& scene, const KeyGiven& given) {
  if (scene.time.accepted_error > 0) choose(settings_of(scene, given));
}

void choose_by_default(Scene& scene, const KeyGiven& given) {
  choose_unasked(settings_of(scene, given));
}

}  // namespace whine
