#include "report/teeth_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/iso_comparison.h"
#include "report/report_figures.h"
#include "report/report_gears.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_tables.h"
#include "signal/no_root_stress.h"

namespace whine {
namespace {

using Eigen::Index;

std::string megapascal(double stress) {
  return fixed(stress * kInMegapascals, 1);
}

// [gear] N: largest load at rest of a pair that touches over the gear's tip edge, where no pressure is stated.
std::array<double, kSides> edge_load_at_rest(const StaticResult& s) {
  const GearPair gears(s);
  std::array<double, kSides> most{};
  for (Index i = 0; i < s.tooth_load.rows(); ++i)
    for (Index j = 0; j < s.tooth_load.cols(); ++j) {
      if (!(s.tooth_load(i, j) > 0) || s.contact_pressure(i, j) > 0) continue;
      const PairContact contact = gears.contact(s.mesh_phase[i] - std::floor(s.mesh_phase[i]) + s.pair[j]);
      const int g =
          contact.corner
              ? contact.tip_gear
              : gears.edge_gear(contact,
                                gears.edge_distance(contact, 0) < gears.edge_distance(contact, 1) ? 0 : 1);
      double& load = most[static_cast<size_t>(g)];
      load = std::max(load, s.tooth_load(i, j));
    }
  return most;
}

// A value of the standard's formulas, or a dash where they have none.
std::string or_dash(const std::optional<double>& value, int decimals, double scale = 1) {
  return value ? fixed(*value * scale, decimals) : html::kNoValue;
}

// where: "At rest at 150 N m".
WordTable at_rest(const StaticResult& s, const IsoComparison& iso, const std::string& where) {
  WordTable out{
      text(
          where,
          ", beside ISO 6336, method B. sigma_F0 is of a tooth that carries the whole load at the outer point of single contact; sigma_H0 is at the pitch point."),
      {"", "unit", s.mesh.gear[0] + " (driver)", s.mesh.gear[1] + " (driven)"},
      {}};
  const auto both = [&](const char* what, const char* unit, const std::function<std::string(size_t)>& value) {
    out.rows.push_back({what, unit, value(0), value(1)});
  };
  const auto of = [](size_t g) { return static_cast<Index>(g); };
  both("largest root stress", "MPa", [&](size_t g) { return megapascal(s.root_stress_max[of(g)]); });
  both("where: tangent against the tooth's centre line", "deg",
       [&](size_t g) { return fixed(s.root_stress_angle[of(g)] * kInDegrees, 0); });
  both("when: phase of the pair, from the pitch point", "mesh periods",
       [&](size_t g) { return fixed(s.root_stress_phase[of(g)], 3); });
  both("form factor Y_F, ISO 6336-3", "1",
       [&](size_t g) { return iso.root[g] ? fixed(iso.root[g]->form, 3) : html::kNoValue; });
  both("stress correction factor Y_S", "1",
       [&](size_t g) { return iso.root[g] ? fixed(iso.root[g]->stress_correction, 3) : html::kNoValue; });
  both("sigma_F0", "MPa", [&](size_t g) { return or_dash(iso.root_stress[g], 1, kInMegapascals); });
  both("root stress over sigma_F0", "1", [&](size_t g) {
    return iso.root_stress[g] ? fixed(s.root_stress_max[of(g)] / *iso.root_stress[g], 3) : html::kNoValue;
  });
  const FlankPressure& pressure = s.flank_pressure;
  const std::array<double, kSides> edges = edge_load_at_rest(s);
  const auto alike = [&](const char* what, const char* unit, const std::string& value) {
    out.rows.push_back({what, unit, value, value});
  };
  alike("largest pressure inside the flanks", "MPa",
        pressure.smooth > 0 ? megapascal(pressure.smooth) : html::kNoValue);
  alike("sigma_H0, ISO 6336-2", "MPa", or_dash(iso.flank_pressure, 1, kInMegapascals));
  both("largest load over the gear's tip edge", "N",
       [&](size_t g) { return edges[g] > 0 ? fixed(edges[g], 0) : std::string("none"); });
  alike("loss factor H_V", "1", fixed(s.loss_factor, 4));
  alike("the same of rigid teeth", "1", or_dash(iso.loss_factor, 4));
  return out;
}

// Of each mesh; of a pair K_v of `iso` stands beside forces.
WordTable in_motion(const SystemStaticResult& all, const std::vector<const ResponseResult*>& sweeps,
                    const IsoComparison& iso, const TurningMember& member) {
  WordTable out{
      text(
          "In motion at ", torque_words(torque_of(all)),
          ": the largest over all speeds, sustained for 1/64 of a mesh period, with the mesh frequency at which it stands; of forces and of root stress, which goes with them, what it is over its value at rest (the dynamic factor), and K_v of ISO 6336-1, method B, at that speed; of root stress, where: tangent of the root against the tooth's centre line, phase of the tooth's pair from the pitch point."),
      {"", "speed", "largest", member.turns > 0 ? "at (Hz; rpm of " + member.name + ")" : "at (Hz)", "where",
       "dynamic factor", "K_v there"},
      {}};
  const auto add_mesh = [&](const ResponseResult& r, size_t number) {
    const auto m = static_cast<Index>(number);
    const StaticResult& s = all.mesh[number];
    const std::string of = all.mesh.size() > 1 ? all.mesh_names[number] + ": " : "",
                      way = r.direction == Direction::up ? "rising" : "falling";
    // 0: it does not occur at any speed; rest 0: not compared
    const auto add = [&](const std::string& what, const Eigen::Ref<const Eigen::VectorXd>& values,
                         double scale, const char* unit, double rest = 0,
                         const std::function<std::string(Index)>& where = {}) {
      Index top = 0;
      const double most = values.maxCoeff(&top), speed = r.mesh_frequency[top];
      out.rows.push_back(
          {of + what, way, most > 0 ? fixed(most * scale, scale == 1 ? 0 : 1) + unit : "none",
           most > 0 ? fixed(speed, 0) + (member.turns > 0 ? "; " + fixed(member.rpm(speed), 0) : "")
                    : html::kNoValue,
           most > 0 && where ? where(top) : html::kNoValue, rest > 0 ? fixed(most / rest, 2) : html::kNoValue,
           rest > 0 && !r.of_train() ? or_dash(iso.dynamic_factor(speed), 2) : html::kNoValue});
    };
    const auto lasting = [&](const MatrixRM& sustained, const MatrixRM& largest) {
      return Eigen::VectorXd((sustained.size() > 0 ? sustained : largest).col(m));
    };
    for (Index g = 0; g < kSides; ++g)
      if (const Index side = kSides * m + g; known_of(r.root_stress_sustained, side))
        add("root stress of " + r.name_of_side(side), r.root_stress_sustained.col(side), kInMegapascals,
            " MPa", s.root_stress_max.size() > 0 ? s.root_stress_max[g] : 0, [&, side](Index i) {
              return fixed(r.root_stress_angle(i, side) * kInDegrees, 0) + " deg, " +
                     fixed(r.root_stress_phase(i, side), 2);
            });
    add("mesh force", lasting(r.mesh_force_sustained, r.mesh_force_max), 1, " N", rest_force(all, number));
    add("load of a pair of teeth", lasting(r.tooth_load_sustained, r.tooth_load_max), 1, " N",
        s.tooth_load.maxCoeff());
    if (r.of_train()) return;
    add("pressure inside the flanks", r.flank_pressure_sustained, kInMegapascals, " MPa");
    for (size_t g = 0; g < kSides; ++g)
      add("load over the tip edge of " + s.mesh.gear[g], r.edge_load.col(static_cast<Index>(g)), 1, " N");
    out.rows.push_back({"loss factor H_V, least to largest", way,
                        fixed(r.loss_factor.minCoeff(), 4) + " to " + fixed(r.loss_factor.maxCoeff(), 4),
                        html::kNoValue, html::kNoValue, html::kNoValue, html::kNoValue});
  };
  for (size_t m = 0; m < all.mesh.size(); ++m)
    for (const ResponseResult* sweep : sweeps) add_mesh(*sweep, m);
  return out;
}

const std::vector<std::string>& limits() {
  static const std::vector<std::string> all{
      text(
          "Root stress is the tangential stress along the root beside the loaded flank of the teeth that carry load, by the loads of their own mesh; of a gear in several meshes what the others add, on its other flank, is left out. In motion it is quasi-static in the tooth loads: the inertia of the body adds none."),
      text(
          "A tip edge on a flank is a singular contact in this model: it has no largest pressure, so its load is stated, apart from the pressure inside the flanks. Real edges are rounded and wear."),
      text(
          "Pressure at rest, by strips, leaves out ridges where a linear relief begins; pressure in motion is Hertz's of the load of a pair and does not resolve them. It grows with the root of the load, so it has no dynamic factor beside K_v."),
      text(
          "K_v is a factor of forces, of gears without deviations. sigma_F0 and sigma_H0 have no application, face load or dynamic factors: they stand beside values at rest only."),
      text("Losses are per unit coefficient of friction.")};
  return all;
}

// What ISO 6336 leaves out, or is used beyond.
std::string range_of(const IsoComparison& iso) {
  std::string out;
  if (!iso.beyond.empty())
    out += " Outside of the range that ISO 6336 gives for its formulas: " + iso.beyond + ".";
  if (!iso.missing.empty()) out += " Left out: " + iso.missing + " (" + iso.why + ").";
  return out;
}

// [mesh] of each [[mesh]] that carries load the one whose roots are stressed most.
std::vector<size_t> most_stressed(const SystemStaticResult& a) {
  std::vector<size_t> out;
  for (const AlikeMeshes& section : alike_meshes(a)) {
    std::optional<size_t> most;
    const auto stress = [&](size_t m) {
      return a.mesh[m].root_stress_max.size() > 0 ? a.mesh[m].root_stress_max.maxCoeff() : 0;
    };
    for (const size_t m : section.meshes)
      if (stress(m) > (most ? stress(*most) : 0)) most = m;
    if (most) out.push_back(*most);
  }
  return out;
}

std::string as_html(const WordTable& t) {
  return html::table(t.caption, t.head, t.rows);
}

}  // namespace

std::vector<WordTable> teeth_tables(const ReportContent& c) {
  if (c.statics.empty()) fail(Failure::input, "teeth: no static.h5 given; make static makes it");
  require_one_scene(c);
  const SystemStaticResult& rest = c.statics[0];
  const std::vector<size_t> meshes = most_stressed(rest);
  if (const std::string why = why_no_root_stress(rest.mesh.at(0));
      meshes.empty() || (!rest.of_train() && !why.empty()))
    fail(Failure::input, "teeth: ", why);
  std::vector<const ResponseResult*> sweeps;
  for (const Direction direction : {Direction::up, Direction::down}) {
    const ResponseResult* sweep = sweep_of(c, torque_of(rest), direction);
    if (sweep && (rest.of_train() || known_of(sweep->root_stress_max, 0)))
      sweeps.push_back(sweep);
    else if (!rest.of_train())
      fail(Failure::input, "teeth: no response.h5 ", direction, " with root stress at ",
           torque_words(torque_of(rest)), " is given");
  }
  const System layout = layout_of(c);
  std::vector<WordTable> out;
  out.reserve(meshes.size() + 1);
  IsoComparison iso;
  for (const size_t m : meshes) {
    const StaticResult& mesh = rest.mesh[m];
    std::array<double, kSides> inertia{};
    for (size_t g = 0; g < kSides; ++g)
      inertia[g] = layout.bodies[static_cast<size_t>(layout.meshes[m].side[g].body)].inertia;
    iso = iso_comparison(mesh, inertia);
    out.push_back(at_rest(
        mesh, iso,
        rest.of_train()
            ? text(rest.mesh_names[m], " at rest, its part of the torque ", torque_words(mesh.torque), " on ",
                   mesh.mesh.gear[0], ", of the meshes of its [[mesh]] the one with the largest root stress")
            : "At rest at " + torque_words(mesh.torque)));
    out.back().caption += range_of(iso);
  }
  if (!sweeps.empty()) out.push_back(in_motion(rest, sweeps, iso, driver_of(c)));
  return out;
}

std::string teeth_html(const ReportContent& c) {
  const std::vector<WordTable> tables = teeth_tables(c);
  const size_t at_rest = tables.size() - (c.sweeps.empty() ? 0 : 1);
  std::string rest, list, sections;
  for (size_t i = 0; i < at_rest; ++i) rest += as_html(tables[i]);
  for (const std::string& limit : limits()) list += html::tagged("li", html::escaped(limit)) + "\n";
  for (const ReportSection& section : std::vector<ReportSection>{
           {"remarks", "Warnings and remarks", remarks_list(c)},
           {"rest", "At rest", rest + figures_of(c, "rest")},
           {"motion", "In motion",
            (c.sweeps.empty() ? "" : as_html(tables.back())) + figures_of(c, "motion")},
           {"errors", "What the errors are",
            figures_of(c, "errors") + (c.budget ? budget_table(*c.budget) : "")},
           {"limits", "Limits", html::tagged("ul", "\n" + list)},
           {"gears", "The gears", bodies_table(c) + drawings_table(c) + meshes_table(c)},
           {"provenance", "Provenance", provenance_table(c.sources)}})
    if (!section.inside.empty())
      sections += text("<section id=\"", section.id, "\">\n<h2>", section.heading, "</h2>\n", section.inside,
                       "</section>\n");
  const size_t colon = c.scene.find(": ");
  return html::page(
      colon == std::string::npos ? c.scene : c.scene.substr(colon + 2),
      text("<p class=\"scene\">What the teeth suffer at ", torque_words(torque_of(c.statics[0])),
           ": scene <code>", html::escaped(c.scene.substr(0, colon)), "</code></p>\n"),
      sections);
}

}  // namespace whine
