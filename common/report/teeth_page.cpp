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
#include "report/figures.h"
#include "report/html.h"
#include "report/iso_comparison.h"
#include "report/report_figures.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_tables.h"
#include "report/system_report_tables.h"
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

WordTable in_motion(const StaticResult& s, const IsoComparison& iso,
                    const std::array<const ResponseResult*, 2>& sweeps) {
  WordTable out{
      text(
          "In motion at ", torque_words(s.torque),
          ": the largest over all speeds, sustained for 1/64 of a mesh period, with the mesh frequency at which it stands; of forces and of root stress, which goes with them, what it is over its value at rest (the dynamic factor), and K_v of ISO 6336-1, method B, at that speed; of root stress, where: tangent of the root against the tooth's centre line, phase of the tooth's pair from the pitch point."),
      {"", "speed", "largest", "at (Hz)", "where", "dynamic factor", "K_v there"},
      {}};
  const double force = normal_force(s.gear[0].design, s.torque);
  enum class Factor { none, of_rest };
  for (size_t d = 0; d < sweeps.size(); ++d) {
    const ResponseResult& r = *sweeps[d];
    // 0: it does not occur at any speed
    const auto add = [&](const std::string& what, const Eigen::Ref<const Eigen::VectorXd>& values,
                         double scale, const char* unit, Factor factor, double rest = 0,
                         const std::function<std::string(Index)>& where = {}) {
      Index top = 0;
      const double most = values.maxCoeff(&top), speed = r.mesh_frequency[top];
      const bool compared = factor == Factor::of_rest && rest > 0;
      out.rows.push_back({what, d == 0 ? "rising" : "falling",
                          most > 0 ? fixed(most * scale, scale == 1 ? 0 : 1) + unit : "none",
                          most > 0 ? fixed(speed, 0) : html::kNoValue,
                          most > 0 && where ? where(top) : html::kNoValue,
                          compared ? fixed(most / rest, 2) : html::kNoValue,
                          compared ? or_dash(iso.dynamic_factor(speed), 2) : html::kNoValue});
    };
    for (int g = 0; g < kSides; ++g)
      add("root stress of " + s.mesh.gear[g], r.root_stress_sustained.col(g), kInMegapascals, " MPa",
          Factor::of_rest, s.root_stress_max[g], [&](Index i) {
            return fixed(r.root_stress_angle(i, g) * kInDegrees, 0) + " deg, " +
                   fixed(r.root_stress_phase(i, g), 2);
          });
    add("mesh force", r.mesh_force_sustained.col(0), 1, " N", Factor::of_rest, force);
    add("load of a pair of teeth", r.tooth_load_sustained.col(0), 1, " N", Factor::of_rest,
        s.tooth_load.maxCoeff());
    add("pressure inside the flanks", r.flank_pressure_sustained, kInMegapascals, " MPa", Factor::none);
    for (int g = 0; g < kSides; ++g)
      add("load over the tip edge of " + s.mesh.gear[g], r.edge_load.col(g), 1, " N", Factor::none);
    out.rows.push_back({"loss factor H_V, least to largest", d == 0 ? "rising" : "falling",
                        fixed(r.loss_factor.minCoeff(), 4) + " to " + fixed(r.loss_factor.maxCoeff(), 4),
                        html::kNoValue, html::kNoValue, html::kNoValue, html::kNoValue});
  }
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
  const auto stress = [&](size_t m) {
    const Eigen::VectorXd& of = a.mesh[m].root_stress_max;
    return of.size() > 0 ? of.maxCoeff() : 0;
  };
  for (size_t k = 0; k < a.settings.mesh.size(); ++k) {
    std::optional<size_t> most;
    for (size_t m = 0; m < a.mesh.size(); ++m)
      if (a.settings.section[m] == static_cast<int>(k) && stress(m) > (most ? stress(*most) : 0)) most = m;
    if (most) out.push_back(*most);
  }
  return out;
}

WordTable train_in_motion(const SystemReport& r) {
  WordTable out{
      "In motion: the largest over all speeds, with the mesh frequency at which it stands, and what it is over its value at rest: over the mean of the mesh force, over the largest load of a pair of teeth, over the largest root stress. Root stress is what lasts for 1/64 of a mesh period.",
      {"mesh", "speed", "mesh force (N)", "at (Hz)", "dynamic factor", "load of a pair of teeth (N)",
       "at (Hz)", "over rest", "root stress of the driving gear (MPa)", "at (Hz)", "over rest",
       "of the driven gear (MPa)", "at (Hz)", "over rest"},
      {}};
  for (size_t m = 0; m < r.rest->mesh.size(); ++m)
    for (const ResponseResult& sweep : r.sweeps) {
      const auto column = static_cast<Index>(m);
      out.rows.push_back({r.rest->mesh_names[m], sweep.direction == Direction::up ? "rising" : "falling"});
      const auto add = [&](const MatrixRM& of, Index column, double scale, double rest) {
        if (!known_of(of, column)) return out.rows.back().resize(out.rows.back().size() + 3, html::kNoValue);
        Index top = 0;
        const double most = of.col(column).maxCoeff(&top);
        for (const std::string& cell : {fixed(most * scale, 0), fixed(sweep.mesh_frequency[top], 0),
                                        rest > 0 ? fixed(most / rest, 2) : html::kNoValue})
          out.rows.back().push_back(cell);
      };
      const StaticResult& rest = r.rest->mesh[m];
      add(sweep.mesh_force_max, column, 1, r.rest->mesh_force.col(column).mean());
      add(sweep.tooth_load_max, column, 1, rest.tooth_load.maxCoeff());
      for (Index side = 0; side < kSides; ++side)
        add(sweep.root_stress_sustained, kSides * column + side, kInMegapascals,
            rest.root_stress_max.size() > 0 ? rest.root_stress_max[side] : 0);
    }
  return out;
}

std::string as_html(const WordTable& t) {
  return html::table(t.caption, t.head, t.rows);
}

}  // namespace

std::vector<WordTable> teeth_tables(const ReportContent& c) {
  if (c.statics.empty())
    fail(Failure::input, "teeth: no static.h5 given; that of the scene's first torque is the least");
  require_one_pair(c);
  const StaticResult& s = c.statics[0];
  if (const std::string why = why_no_root_stress(s); !why.empty()) fail(Failure::input, "teeth: ", why);
  std::array<const ResponseResult*, 2> sweeps{};
  for (const Direction direction : {Direction::up, Direction::down}) {
    const ResponseResult* sweep = sweep_of(c, s.torque, direction);
    if (!sweep || !known_of(sweep->root_stress_max, 0))
      fail(Failure::input, "teeth: no response.h5 ", direction, " with root stress at ",
           torque_words(s.torque), " is given");
    sweeps[direction == Direction::up ? 0 : 1] = sweep;
  }
  const IsoComparison iso = iso_comparison(s, sweeps[0]->inertia);
  WordTable rest = at_rest(s, iso, "At rest at " + torque_words(s.torque));
  rest.caption += range_of(iso);
  return {rest, in_motion(s, iso, sweeps)};
}

std::vector<WordTable> teeth_tables(const SystemReport& r) {
  require_whole_system(r);
  if (!r.rest) fail(Failure::input, "teeth: no static.h5 given; make static makes it");
  const std::vector<size_t> meshes = most_stressed(*r.rest);
  if (meshes.empty()) fail(Failure::input, "teeth: ", why_no_root_stress(r.rest->mesh.at(0)));
  std::vector<WordTable> out;
  out.reserve(meshes.size() + 1);
  for (const size_t m : meshes) {
    const StaticResult& mesh = r.rest->mesh[m];
    std::array<double, kSides> inertia{};
    for (size_t g = 0; g < kSides; ++g)
      inertia[g] = layout_of(r).bodies[static_cast<size_t>(layout_of(r).meshes[m].side[g].body)].inertia;
    const IsoComparison iso = iso_comparison(mesh, inertia);
    out.push_back(at_rest(
        mesh, iso,
        text(r.rest->mesh_names[m], " at rest, ", torque_words(mesh.torque), " on ", mesh.mesh.gear[0],
             ", of the meshes of its [[mesh]] the one with the largest root stress")));
    out.back().caption += range_of(iso);
  }
  if (!r.sweeps.empty()) out.push_back(train_in_motion(r));
  return out;
}

namespace {

// scene: "file: title"; words: before its name; of the sections those that hold something.
std::string teeth_of(const std::string& scene, const std::string& words,
                     const std::vector<ReportSection>& sections) {
  const size_t colon = scene.find(": ");
  const std::string file = scene.substr(0, colon),
                    title = colon == std::string::npos ? scene : scene.substr(colon + 2);
  std::string all;
  for (const auto& [id, heading, inside] : sections)
    if (!inside.empty())
      all += text("<section id=\"", id, "\">\n<h2>", heading, "</h2>\n", inside, "</section>\n");
  return html::page(title,
                    "<p class=\"scene\">What the teeth suffer " + words + ": scene <code>" +
                        html::escaped(file) + "</code></p>\n",
                    all);
}

std::string list_of_limits() {
  std::string list;
  for (const std::string& limit : limits()) list += html::tagged("li", html::escaped(limit)) + "\n";
  return html::tagged("ul", "\n" + list);
}

}  // namespace

std::string teeth_html(const ReportContent& c) {
  const std::vector<WordTable> tables = teeth_tables(c);
  return teeth_of(
      c.scene, "at " + torque_words(c.statics[0].torque),
      {{"remarks", "Warnings and remarks", remarks_list(c)},
       {"rest", "At rest", as_html(tables[0]) + figures_of(c, "rest")},
       {"motion", "In motion", as_html(tables[1]) + figures_of(c, "motion")},
       {"errors", "What the errors are", figures_of(c, "errors") + (c.budget ? budget_table(*c.budget) : "")},
       {"limits", "Limits", list_of_limits()},
       {"gears", "The gears", gears_table(c)},
       {"provenance", "Provenance", provenance_table(c.sources)}});
}

std::string teeth_html(const SystemReport& r) {
  const std::vector<WordTable> tables = teeth_tables(r);
  const size_t at_rest = tables.size() - (r.sweeps.empty() ? 0 : 1);
  std::string rest;
  for (size_t i = 0; i < at_rest; ++i) rest += as_html(tables[i]);
  return teeth_of(r.scene, "in each mesh",
                  {{"remarks", "Warnings and remarks", system_remarks(r)},
                   {"rest", "At rest", rest + mesh_tables(r)},
                   {"motion", "In motion", r.sweeps.empty() ? "" : as_html(tables.back())},
                   {"limits", "Limits", list_of_limits()},
                   {"gears", "The gears", gear_tables(r)},
                   {"provenance", "Provenance", provenance_table(r.sources)}});
}

}  // namespace whine
