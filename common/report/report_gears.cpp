#include "report/report_gears.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "gear/body_inertia.h"
#include "gear/drawing_quantities.h"
#include "gear/helix.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "io/summary.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/one_system.h"

namespace whine {
namespace {

html::Rows drawing_rows(const std::vector<ToothGeometry>& gears) {
  html::Rows rows;
  using G = const ToothGeometry&;
  const auto all = [&](const std::string& what, const std::string& unit, const auto& value) {
    rows.push_back({what, unit});
    for (G gear : gears) rows.back().push_back(value(gear));
  };
  const auto mm = [](double length) { return fixed(length * kMilli, 4); };
  const auto degrees = [](double rad) { return fixed(rad * kInDegrees, 4); };
  if (std::any_of(gears.begin(), gears.end(), [](G g) { return g.internal(); }))
    all("kind", "–", [](G g) { return std::string(g.internal() ? "internal" : "external"); });
  all("teeth", "–", [](G g) { return text(g.design().teeth); });
  const bool helical = std::any_of(gears.begin(), gears.end(), [](G g) { return g.design().helical(); });
  all(helical ? "normal module" : "module", "mm", [](G g) { return shown(g.design().module * kMilli, 7); });
  all(helical ? "normal pressure angle of the rack" : "pressure angle of the rack", "deg",
      [](G g) { return shown(g.design().pressure_angle * kInDegrees, 6); });
  if (helical) {
    all("helix angle at the reference circle", "deg", [&](G g) { return degrees(g.design().helix_angle); });
    all("hand", "–", [](G g) { return text(g.design().hand); });
    all("transverse module", "mm",
        [](G g) { return shown(transverse_section(g.design()).module * kMilli, 6); });
    all("transverse pressure angle", "deg",
        [&](G g) { return degrees(transverse_section(g.design()).pressure_angle); });
    all("base helix angle", "deg", [&](G g) { return degrees(std::abs(base_helix_angle(g.design()))); });
  }
  all("profile shift", "modules", [](G g) { return shown(g.design().profile_shift, 6); });
  all("base diameter", "mm", [&](G g) { return mm(2 * g.base_radius()); });
  all("reference diameter", "mm", [&](G g) { return mm(2 * g.pitch_radius()); });
  all("tip diameter", "mm", [&](G g) { return mm(2 * g.tip_radius()); });
  all("root diameter", "mm", [&](G g) { return mm(2 * g.root_radius()); });
  all("diameter where the involute begins", "mm",
      [&](G g) { return mm(2 * std::hypot(1.0, g.form_roll_angle()) * g.base_radius()); });
  if (std::any_of(gears.begin(), gears.end(), [](G g) { return g.undercut() > 0; }))
    all("undercut: how far the rack reaches beyond the base circle's tangent point", "mm",
        [&](G g) { return mm(std::max(0.0, g.undercut())); });
  all("roll angle where the involute begins", "deg", [&](G g) { return degrees(g.form_roll_angle()); });
  all("roll angle at the tip", "deg", [&](G g) { return degrees(g.tip_roll_angle()); });
  all("tooth thickness at the tip", "mm", [&](G g) { return mm(g.thickness_at_radius(g.tip_radius())); });
  all(helical ? "transverse tooth thickness at the reference circle"
              : "tooth thickness at the reference circle (transverse and normal)",
      "mm", [&](G g) { return mm(reference_thickness(g)); });
  if (helical)
    all("normal tooth thickness there", "mm",
        [&](G g) { return mm(reference_thickness(g) * std::cos(g.design().helix_angle)); });
  all("teeth k in the span", "–", [](G g) {
    const std::optional<Span> span = span_measurement(g);
    return span ? text(span->teeth) : html::kNoValue;
  });
  all("span W_k over these teeth", "mm", [&](G g) {
    const std::optional<Span> span = span_measurement(g);
    return span ? mm(span->length) : html::kNoValue;
  });
  all("face width", "mm", [](G g) { return shown(g.design().face_width * kMilli, 6); });
  all("diameter on which it is held rigidly (bore, of a ring its rim)", "mm",
      [&](G g) { return mm(2 * g.design().clamped_radius()); });
  return rows;
}

html::Rows mesh_rows(const std::vector<GearPair>& meshes) {
  html::Rows rows;
  using P = const GearPair&;
  const auto all = [&](const std::string& what, const std::string& unit, const auto& value) {
    rows.push_back({what, unit});
    for (P mesh : meshes) rows.back().push_back(value(mesh));
  };
  constexpr double kNoBacklash = 1e-6;  // m: what a centre distance rounded to a micrometre leaves
  const auto backlash = [](P p, double length) {
    return std::abs(p.backlash()) < kNoBacklash ? "0" : fixed(length * kMilli, 4);
  };
  all("centre distance", "mm", [](P p) { return shown(p.centre_distance() * kMilli, 7); });
  all("working pressure angle", "deg", [](P p) { return fixed(p.working_pressure_angle() * kInDegrees, 4); });
  all("base pitch", "mm", [](P p) { return fixed(p.base_pitch() * kMilli, 4); });
  const bool helical =
      std::any_of(meshes.begin(), meshes.end(), [](P p) { return p.base_helix_angle() != 0; });
  all(helical ? "transverse contact ratio" : "contact ratio", "–",
      [](P p) { return fixed(p.contact_ratio(), 4); });
  if (helical) {
    all("overlap ratio", "–", [](P p) { return fixed(p.overlap_ratio(), 4); });
    all("total contact ratio", "–", [](P p) { return fixed(p.contact_ratio() + p.overlap_ratio(), 4); });
  }
  all("path of contact, length", "mm",
      [](P p) { return fixed((p.path_end() - p.path_start()) * kMilli, 4); });
  all("path of contact before the pitch point", "mm", [](P p) { return fixed(-p.path_start() * kMilli, 4); });
  all("path of contact after it", "mm", [](P p) { return fixed(p.path_end() * kMilli, 4); });
  all("normal backlash, along the line of action", "mm",
      [&](P p) { return backlash(p, normal_backlash(p)); });
  all("circumferential backlash, on the working pitch circles", "mm",
      [&](P p) { return backlash(p, circumferential_backlash(p)); });
  return rows;
}

constexpr const char* kBoth = ", driving / driven";  // behind a quantity of which a cell holds both values

// Where the gears of each mesh meet: clearances, ends of the contact, sliding, each of the driving and of the driven gear.
void add_meeting_rows(const std::vector<GearPair>& meshes, html::Rows& rows) {
  const auto both = [&](const std::string& what, const char* unit, const auto& value) {
    rows.push_back({what + kBoth, unit});
    for (const GearPair& pair : meshes) rows.back().push_back(value(pair, 0) + " / " + value(pair, 1));
  };
  using P = const GearPair&;
  const auto mm = [](double length) { return fixed(length * kMilli, 4); };
  both("tip clearance, to the root circle of the mate", "mm",
       [&](P p, int g) { return mm(tip_clearance_to_root(p, g)); });
  both("root clearance, to the tip circle of the mate", "mm",
       [&](P p, int g) { return mm(tip_clearance_to_root(p, 1 - g)); });
  const auto diameter = [&](const std::string& what, size_t of_driver, size_t of_driven) {
    both(what, "mm", [&](P p, int g) {
      return mm(path_points(p)[g == 0 ? of_driver : of_driven].diameter[static_cast<size_t>(g)]);
    });
  };
  diameter("working pitch diameter", 2, 2);
  diameter("diameter where the active profile starts (SAP)", 0, 4);
  if (std::none_of(meshes.begin(), meshes.end(), [](P p) { return p.base_helix_angle() != 0; })) {
    diameter("diameter at B, from where one pair carries alone", 1, 1);
    diameter("diameter at D, up to where it does", 3, 3);
  }
  for (const auto& [what, at] : {std::pair{"specific sliding where a pair comes into contact", 0},
                                 std::pair{"specific sliding where it leaves", 4}})
    both(what, "–", [&, point = static_cast<size_t>(at)](P p, int g) {
      const auto sliding = specific_sliding(p, path_points(p)[point].path)[static_cast<size_t>(g)];
      return sliding ? fixed(*sliding, 4) : std::string(html::kNoValue);
    });
  if (std::any_of(meshes.begin(), meshes.end(), [](P p) { return p.path_lost(0) > 0 || p.path_lost(1) > 0; }))
    both("path of contact lost to undercut", "mm", [&](P p, int g) { return mm(p.path_lost(g)); });
}

// A carrier does not turn in its own frame.
std::string sense_words(const System::Body& body) {
  if (body.kind == System::BodyKind::carrier) return html::kNoValue;
  return body.sense > 0 ? "counter-clockwise" : "clockwise";
}

// One drawing, with what is known of its first body.
struct Drawn {
  std::string name, role;  // of a pair " (driver)"
  BodyParameters drawing;
  FlankModification flanks;
  double inertia = 0;  // kg m2: of all that turns with it; 0: not known
};

std::vector<Drawn> drawn_gears(const ReportContent& c) {
  std::vector<Drawn> out;
  const SystemStaticResult& a = c.statics[0];
  const System layout = layout_of(c);
  for (size_t g = 0; g < a.drawing.size(); ++g) {
    const std::string& name = a.settings.body[g].first;
    const auto body = std::find(a.settings.gear.begin(), a.settings.gear.end(), name);
    out.push_back({name, a.of_train() ? "" : text(" (", kRole[g], ")"), a.drawing[g],
                   a.settings.modification(name),
                   body == a.settings.gear.end()
                       ? 0
                       : layout.bodies[static_cast<size_t>(body - a.settings.gear.begin())].inertia});
  }
  return out;
}

// Of each of `gears`.
html::Rows rows_of_drawings(const std::vector<Drawn>& gears) {
  constexpr double kFillets = 1.03;  // what fillets add to the outline at most
  std::vector<std::string> outline{"inertia of the body as drawn, bore to tip, without fillets", "kg m²"},
      moving{"inertia in motion, with all that turns with the gear", "kg m²"}, flanks{"flanks", ""};
  std::vector<ToothGeometry> drawings;
  drawings.reserve(gears.size());
  bool moves = false;
  for (const Drawn& gear : gears) {
    const ToothGeometry& teeth = drawings.emplace_back(gear.drawing.design);
    const double least = least_body_inertia(teeth, gear.drawing.material);
    outline.push_back(shown(least, 3));
    moving.push_back(gear.inertia > 0
                         ? shown(gear.inertia, 4) + (gear.inertia < kFillets * least ? ", as drawn" : "")
                         : html::kNoValue);
    moves = moves || gear.inertia > 0;
    flanks.push_back(in_words(gear.flanks));
  }
  html::Rows rows = drawing_rows(drawings);
  rows.push_back(outline);
  if (moves) rows.push_back(moving);
  rows.push_back(flanks);
  return rows;
}

html::Rows rows_of_meshes(const std::vector<StaticResult>& meshes) {
  std::vector<GearPair> pairs;
  std::vector<std::string> corner{"tip edges off the line of action", ""};
  pairs.reserve(meshes.size());
  for (const StaticResult& mesh : meshes) {
    pairs.emplace_back(mesh);
    corner.push_back(corner_words(mesh));
  }
  html::Rows rows = mesh_rows(pairs);
  add_meeting_rows(pairs, rows);
  rows.push_back(corner);
  return rows;
}

}  // namespace

std::vector<GeometryNumber> geometry_numbers(const ReportContent& c) {
  std::vector<GeometryNumber> out;
  const auto add = [&](const std::string& part, const std::vector<std::string>& row,
                       const std::string& value) {
    const std::string& unit = row[1];
    if (value != html::kNoValue) out.push_back({part, row[0], unit == html::kNoValue ? "1" : unit, value});
  };
  for (const AlikeMeshes& section : alike_meshes(c.statics.at(0))) {
    const StaticResult& mesh = c.statics[0].mesh[section.meshes.front()];
    for (std::vector<std::string> row : rows_of_meshes({mesh})) {
      const size_t slash = row[2].find(" / ");
      if (!row[0].ends_with(kBoth)) {
        add(section.name, row, row[2]);
        continue;
      }
      row[0].resize(row[0].size() - std::string(kBoth).size());
      const std::string what = row[0];
      for (const size_t g : {0, 1}) {
        row[0] = text(what, ", ", mesh.mesh.gear[g], " (", kRole[g], ")");
        add(section.name, row, g == 0 ? row[2].substr(0, slash) : row[2].substr(slash + 3));
      }
    }
  }
  for (const Drawn& gear : drawn_gears(c))
    for (const std::vector<std::string>& row : rows_of_drawings({gear})) add(gear.name, row, row[2]);
  return out;
}

std::string held_words(const ReportContent& c, size_t b) {
  const System s = layout_of(c);
  if (!c.of_train()) return kRole[b];
  if (s.held(static_cast<int>(b)))
    return s.bodies[b].kind == System::BodyKind::carrier ? "held (the frame)" : "held";
  if (c.statics.empty()) return "turns";
  const double torque = c.statics[0].torque.col(static_cast<Eigen::Index>(b)).mean();
  return torque > 0 ? "input" : torque < 0 ? "output" : "free";
}

std::string bodies_table(const ReportContent& c) {
  const System s = layout_of(c);
  html::Rows rows;
  Figure speeds;
  add_shafts(s, speeds);
  constexpr double kAt = 1000;  // Hz
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    const Bearing& bearing = body.bearing;
    const auto of_bearing = [&](double value, int digits, const char* none) {
      return !bearing.elastic() ? html::kNoValue : value == 0 ? none : shown(value, digits);
    };
    rows.push_back(
        {body.name, body.teeth > 0 ? text(body.teeth) : "carrier", sense_words(body), held_words(c, b),
         body.on == System::kGround ? "ground" : s.bodies[static_cast<size_t>(body.on)].name,
         fixed(body.centre[0] * kMilli, 3), fixed(body.centre[1] * kMilli, 3),
         fixed(2 * body.radius * kMilli, 3), body.inertia > 0 ? shown(body.inertia, 4) : html::kNoValue,
         bearing.elastic() ? shown(bearing.stiffness * 1e-6, 5) : "rigid",
         of_bearing(bearing.damping, 5, "0"), of_bearing(bearing.mass, 5, "as drawn")});
    if (!speeds.shafts.empty())
      rows.back().insert(rows.back().begin() + 3, fixed(60 * kAt * std::abs(speeds.shafts[b].turns), 1));
  }
  std::vector<std::string> head{"body",
                                "teeth",
                                "sense",
                                "rotation",
                                "axis on",
                                "x (mm)",
                                "y (mm)",
                                "diameter (mm)",
                                "inertia (kg m²)",
                                "bearing (N/µm)",
                                "its damper (N s/m)",
                                "mass on it (kg)"};
  std::string speed_words;
  if (!speeds.shafts.empty()) {
    head.insert(head.begin() + 3, text("rpm at ", kAt, " Hz"));
    const std::string with = speeds.shafts[0].with;
    speed_words = text(". Speed: at a mesh frequency of ", kAt, " Hz", with.empty() ? "" : ", with ", with,
                       has_planets(s) ? "; of a planet on its pin" : "");
  }
  return html::table(
      text(
          "The bodies. Sense: of rotation",
          has_planets(s)
              ? " relative to the carrier, which the computation holds; a gear that the machine holds turns against its carrier"
              : "",
          speed_words, ". Rotation: by what it is held or driven",
          c.statics.empty() ? "; torques do not change natural modes" : "",
          ". Diameter: of the base circle, of a carrier of the circle of its pins. The ",
          "inertia of a body that is held has no meaning."),
      head, rows, "small");
}

std::string drawings_table(const ReportContent& c) {
  if (c.statics.empty()) return "";
  const std::vector<Drawn> gears = drawn_gears(c);
  std::vector<std::string> head{"", "unit"};
  for (const Drawn& gear : gears) head.push_back(gear.name + gear.role);
  return html::table("Geometry of the gears; all keys of the scene stand below, under Parameters.", head,
                     rows_of_drawings(gears));
}

std::string meshes_table(const ReportContent& c) {
  const System s = layout_of(c);
  std::vector<std::string> head{"", "unit"}, phase{"mesh phase", "mesh periods"};
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    head.push_back(mesh_name(s, m));
    phase.push_back(fixed(s.meshes[m].phase, 4));
  }
  html::Rows rows;
  if (c.statics.empty()) {
    rows = {{"centre distance", "mm"}, {"working pressure angle", "deg"}, {"stiffness", "N/µm"}};
    for (const System::Mesh& mesh : s.meshes) {
      rows[0].push_back(fixed(mesh.centre_distance * kMilli, 3));
      rows[1].push_back(fixed(mesh.pressure_angle * kInDegrees, 3));
      rows[2].push_back(shown(mesh.stiffness * 1e-6, 5));
    }
  } else {
    rows = rows_of_meshes(c.statics[0].mesh);
  }
  if (s.meshes.size() > 1) rows.push_back(phase);
  return html::table(
      text("The meshes, the driving side first.",
           s.meshes.size() > 1
               ? " Mesh phase: the part of a mesh period by which a mesh is ahead of the first one."
               : ""),
      head, rows);
}

}  // namespace whine
