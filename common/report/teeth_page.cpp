#include "report/teeth_page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.h"
#include "gear/iso6336.h"
#include "gear/iso6336_strength.h"
#include "gear/pair.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_figures.h"
#include "report/report_page.h"
#include "report/report_tables.h"
#include "system/flank_pressure.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr double kMegapascal = 1e-6, kDegrees = 180 / std::numbers::pi;
constexpr const char* kNone = "–";

std::string megapascal(double stress) {
  return fixed(stress * kMegapascal, 1);
}

// A formula of the standard, or a dash where it is outside of its range.
std::string formula(const std::function<std::string()>& value) {
  try {
    return value();
  } catch (const Error& error) {
    if (error.kind() != Failure::input && error.kind() != Failure::numerical) throw;
    return kNone;
  }
}

double tangential_force(const StaticArtifact& s, const GearPair& pair) {
  return s.torque / pair.gear(0).pitch_radius();
}

WordTable at_rest(const StaticArtifact& s, const GearPair& pair) {
  WordTable out{
      text("At rest at ", torque_words(s.torque),
           ", beside ISO 6336, method B. sigma_F0 is of a tooth that carries the whole load at the outer "
           "point of single contact; sigma_H0 is at the pitch point."),
      {"", "unit", s.mesh.gear[0] + " (driver)", s.mesh.gear[1] + " (driven)"},
      {}};
  const double force = tangential_force(s, pair);
  const auto both = [&](const char* what, const char* unit, const std::function<std::string(int)>& value) {
    out.rows.push_back({what, unit, formula([&] { return value(0); }), formula([&] { return value(1); })});
  };
  both("largest root stress", "MPa", [&](int g) { return megapascal(s.root_stress_max[g]); });
  both("where: tangent against the tooth's centre line", "deg",
       [&](int g) { return fixed(s.root_stress_angle[g] * kDegrees, 0); });
  both("when: phase of the pair, from the pitch point", "mesh periods",
       [&](int g) { return fixed(s.root_stress_phase[g], 3); });
  both("form factor Y_F, ISO 6336-3", kNone, [&](int g) { return fixed(iso_6336_root(pair, g).form, 3); });
  both("stress correction factor Y_S", kNone,
       [&](int g) { return fixed(iso_6336_root(pair, g).stress_correction, 3); });
  both("sigma_F0", "MPa", [&](int g) { return megapascal(iso_6336_root_stress(pair, g, force)); });
  both("root stress over sigma_F0", "1",
       [&](int g) { return fixed(s.root_stress_max[g] / iso_6336_root_stress(pair, g, force), 3); });
  const FlankPressure pressure = flank_pressure(s);
  const auto alike = [&](const char* what, const char* unit, const std::string& value) {
    out.rows.push_back({what, unit, value, value});
  };
  alike("largest flank pressure, edges left out", "MPa",
        pressure.smooth > 0 ? megapascal(pressure.smooth) : kNone);
  alike("sigma_H0, ISO 6336-2", "MPa", formula([&] {
          return megapascal(iso_6336_flank_pressure(pair, {s.gear[0].material, s.gear[1].material}, force));
        }));
  alike("loss factor H_V", "1", fixed(s.loss_factor, 4));
  alike("the same of rigid teeth", "1", formula([&] { return fixed(loss_factor_of_rigid_teeth(pair), 4); }));
  return out;
}

// K_v of exact gears at a mesh frequency (Hz).
double dynamic_factor(const StaticArtifact& s, const ResponseArtifact& r, double frequency) {
  const IsoStiffness iso = iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design,
                                              s.gear[1].material, s.torque, s.contact_ratio);
  double inverse_mass = 0;  // kg-1
  for (int g = 0; g < kSides; ++g) {
    const double base = ToothGeometry(s.gear[g].design).base_radius();
    inverse_mass += base * base / r.inertia[g];
  }
  IsoDynamics gears;
  gears.contact_ratio = s.contact_ratio;
  gears.line_load = iso.line_load;
  gears.single_stiffness = iso.single;
  gears.relief = std::min(s.mesh.modification[0].tip.amount, s.mesh.modification[1].tip.amount);
  return iso_6336_dynamic_factor(
      gears, frequency * 2 * std::numbers::pi / std::sqrt(iso.mesh * s.face_width() * inverse_mass));
}

WordTable in_motion(const StaticArtifact& s, const GearPair& pair,
                    const std::array<const ResponseArtifact*, 2>& sweeps) {
  WordTable out{
      "In motion: the largest over all speeds, held for 1/64 of a mesh period, with the mesh frequency at "
      "which it stands, what it is over its value at rest (the dynamic factor), and K_v of ISO 6336-1, "
      "method B, at that speed.",
      {"", "speed", "largest", "at (Hz)", "dynamic factor", "K_v there"},
      {}};
  const double force = s.torque / pair.gear(0).base_radius();
  for (size_t d = 0; d < sweeps.size(); ++d) {
    const ResponseArtifact& r = *sweeps[d];
    const auto add = [&](const std::string& what, const Eigen::VectorXd& values, double rest, double scale,
                         const char* unit) {
      Index top = 0;
      const double most = values.maxCoeff(&top);
      out.rows.push_back({what, d == 0 ? "rising" : "falling", fixed(most * scale, scale == 1 ? 0 : 1) + unit,
                          fixed(r.mesh_frequency[top], 0), rest > 0 ? fixed(most / rest, 2) : kNone,
                          pair.internal() ? kNone : formula([&] {
                            return fixed(dynamic_factor(s, r, r.mesh_frequency[top]), 2);
                          })});
    };
    for (size_t g = 0; g < kSides; ++g)
      add("root stress of " + s.mesh.gear[g], r.root_stress_held[g], s.root_stress_max[static_cast<Index>(g)],
          kMegapascal, " MPa");
    add("mesh force", r.mesh_force_held, force, 1, " N");
    add("load of a pair of teeth", r.tooth_load_held, s.tooth_load.maxCoeff(), 1, " N");
    const FlankPressure rest = flank_pressure(s);
    add("flank pressure", r.flank_pressure.rowwise().maxCoeff(), rest.smooth, kMegapascal, " MPa");
    for (size_t g = 0; g < kSides; ++g)
      add("load over the tip edge of " + s.mesh.gear[g], r.edge_load[g], 0, 1, " N");
    out.rows.push_back({"loss factor H_V, least to largest", d == 0 ? "rising" : "falling",
                        fixed(r.loss_factor.minCoeff(), 4) + " to " + fixed(r.loss_factor.maxCoeff(), 4),
                        kNone, kNone, kNone});
  }
  return out;
}

const std::vector<std::string>& limits() {
  static const std::vector<std::string> all{
      text("Root stress is the tangential stress along the root beside the loaded flank of the teeth that "
           "carry load. In "
           "motion it is quasi-static in the tooth loads: the inertia of the body adds none."),
      text("A tip edge on a flank is a singular contact in this model: it has no largest pressure, so its "
           "load is stated. "
           "Real edges are rounded and wear."),
      text("Pressure at rest leaves out ridges where a linear relief begins; pressure in motion is Hertz's "
           "of the load of "
           "a pair and does not resolve them, so their ratio is no dynamic factor there."),
      text("K_v is a factor of forces, of gears without deviations; pressure grows with the root of the "
           "force. sigma_F0 "
           "and sigma_H0 have no application, face load or dynamic factors."),
      text("Losses are per unit coefficient of friction.")};
  return all;
}

std::string as_html(const WordTable& t) {
  return html::table(t.caption, t.head, t.rows);
}

}  // namespace

std::vector<WordTable> teeth_tables(const ReportContent& c) {
  if (c.statics.empty())
    fail(Failure::input, "teeth: no static.h5 given; that of the scene's first torque is the least");
  require_one_pair(c);
  const StaticArtifact& s = c.statics[0];
  if (s.root_stress_max.size() != kSides)
    fail(Failure::input, "teeth: static.h5 holds no root stress; a pair with a cracked tooth has none");
  std::array<const ResponseArtifact*, 2> sweeps{};
  for (const Direction direction : {Direction::up, Direction::down}) {
    const ReportSweep* sweep = sweep_of(c, s.torque, direction);
    if (!sweep || sweep->response.root_stress_held[0].size() == 0)
      fail(Failure::input, "teeth: no sweep.h5 ", direction, " with root stress at ", torque_words(s.torque),
           " is given");
    sweeps[direction == Direction::up ? 0 : 1] = &sweep->response;
  }
  const GearPair pair(s);
  return {at_rest(s, pair), in_motion(s, pair, sweeps)};
}

std::string teeth_html(const ReportContent& c) {
  const std::vector<WordTable> tables = teeth_tables(c);
  const size_t colon = c.scene.find(": ");
  const std::string file = c.scene.substr(0, colon),
                    title = colon == std::string::npos ? c.scene : c.scene.substr(colon + 2);
  std::string list;
  for (const std::string& limit : limits()) list += html::tagged("li", html::escaped(limit)) + "\n";
  const auto section = [](const char* id, const char* heading, const std::string& inside) {
    return inside.empty()
               ? ""
               : text("<section id=\"", id, "\">\n<h2>", heading, "</h2>\n", inside, "</section>\n");
  };
  return html::page(
      title, "<p class=\"scene\">What the teeth suffer: scene <code>" + html::escaped(file) + "</code></p>\n",
      section("rest", "At rest", as_html(tables[0]) + figures_of(c, "rest")) +
          section("motion", "In motion", as_html(tables[1]) + figures_of(c, "motion")) +
          section("errors", "What the errors are",
                  figures_of(c, "errors") + (c.budget ? budget_table(*c.budget) : "")) +
          section("limits", "Limits", html::tagged("ul", "\n" + list)) +
          section("gears", "The gears", gears_table(c)) +
          section("provenance", "Provenance", provenance_table(c.sources)));
}

}  // namespace whine
