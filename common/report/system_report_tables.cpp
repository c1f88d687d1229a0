#include "report/system_report_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/units.h"
#include "gear/drawing_quantities.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "io/scene_keys.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/one_system.h"
#include "report/report_page.h"
#include "report/report_results.h"
#include "report/report_tables.h"
#include "report/system_motion_tables.h"
#include "report/system_opening.h"

namespace whine {

bool shares_load(const SystemStaticResult& a, size_t m) {
  const std::vector<int>& section = a.settings.section;
  return std::count(section.begin(), section.end(), section[m]) > 1;
}

namespace {

using Eigen::Index;

struct Force {
  double mean_x, mean_y, mean, most, rms;  // N; rms: of the oscillating part
  double first;                            // N: first order of the mesh frequency
};

Force force_of(const SystemStaticResult& a, size_t b) {
  Force f{};
  const auto row = static_cast<Index>(b);
  const auto n = static_cast<double>(a.bearing_force.size());
  for (const MatrixRM& at : a.bearing_force) {
    f.mean_x += at(row, 0) / n;
    f.mean_y += at(row, 1) / n;
    f.most = std::max(f.most, at.row(row).norm());
  }
  for (const MatrixRM& at : a.bearing_force)
    f.rms += (std::pow(at(row, 0) - f.mean_x, 2) + std::pow(at(row, 1) - f.mean_y, 2)) / n;
  f.rms = std::sqrt(f.rms);
  MatrixRM over_period(static_cast<Index>(a.bearing_force.size()), 2);
  for (size_t i = 0; i < a.bearing_force.size(); ++i)
    over_period.row(static_cast<Index>(i)) = a.bearing_force[i].row(row);
  f.first = first_order_of_force(over_period, a.hunting_periods);
  f.mean = std::hypot(f.mean_x, f.mean_y);
  return f;
}

// Of what is left of a first order that cancels there is no level.
std::string level_words(double amplitude) {
  constexpr double kNothing = 1e-3;  // N
  return amplitude > kNothing ? decibels(amplitude) : html::kNoValue;
}

// A carrier does not turn in its own frame.
std::string sense_words(const System::Body& body) {
  if (body.kind == System::BodyKind::carrier) return "–";
  return body.sense > 0 ? "counter-clockwise" : "clockwise";
}

std::string stands_on(const System& s, const System::Body& body) {
  return body.on == System::kGround ? "ground" : s.bodies[static_cast<size_t>(body.on)].name;
}

std::string bearing_words(const System::Body& body) {
  return body.bearing.elastic() ? shown(body.bearing.stiffness * 1e-6, 4) : "rigid";
}

// What holds or drives the rotation of a body. Natural modes do not know of torques, the statics do.
std::string held_words(const SystemReport& r, size_t b) {
  const System& s = layout_of(r);
  if (s.held(static_cast<int>(b)))
    return s.bodies[b].kind == System::BodyKind::carrier ? "held (the frame)" : "held";
  if (!r.rest) return "turns";
  const double torque = r.rest->torque.col(static_cast<Index>(b)).mean();
  return torque > 0 ? "driven" : torque < 0 ? "loaded" : "free";
}

// Without the sign of what rounds to 0.
std::string plain(double value, int decimals) {
  return fixed(std::abs(value) < 0.5 * std::pow(10, -decimals) ? 0 : value, decimals);
}

// A column for each mesh: what it says as that of a pair does, and its place among the others.
std::vector<ReportNumber> meshes_at_rest(const SystemStaticResult& a) {
  std::vector<ReportNumber> out;
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    const StaticResult& mesh = a.mesh[m];
    const auto c = static_cast<Index>(m);
    std::vector<ReportNumber> own = mesh_at_rest(mesh, m);
    const std::string excitation = own.front().group;
    const auto add = [&](const std::string& group, const char* quantity, const char* unit,
                         const std::string& value) {
      own.push_back({group, mesh.torque, quantity, unit, value, "", "", "", m});
    };
    add(excitation, "mean mesh stiffness, contact frozen", "N/µm",
        shown(mesh.stiffness_tangent.mean() * 1e-6, 5));
    add("Loads", "mesh force, mean", "N", fixed(a.mesh_force.col(c).mean(), 1));
    add("Loads", "mesh force, largest", "N", fixed(a.mesh_force.col(c).maxCoeff(), 1));
    if (shares_load(a, m)) {
      add("Loads", "share of the load, mean", "%", fixed(a.load_share.col(c).mean() * kPercent, 2));
      add("Loads", "share of the load, largest", "%", fixed(a.load_share.col(c).maxCoeff() * kPercent, 2));
    }
    out.insert(out.end(), own.begin(), own.end());
  }
  return out;
}

void add_rest(const SystemReport& r, std::vector<SystemNumber>& out) {
  const SystemStaticResult& a = *r.rest;
  const System& s = a.settings.layout;
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    out.push_back({a.mesh_names[m], "contact ratio", "1", fixed(a.mesh[m].contact_ratio, 3), ""});
    out.push_back({a.mesh_names[m], "mesh phase", "1", fixed(s.meshes[m].phase, 4), ""});
  }
  for (const ReportNumber& n : meshes_at_rest(a))
    out.push_back({a.mesh_names[n.column], n.quantity, n.unit, n.value, n.remark});
  for (const LoadSharing& of : load_sharing(a))
    out.push_back({of.name, "load sharing factor", "1", fixed(of.factor, 3), ""});
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const Force f = force_of(a, b);
    const auto c = static_cast<Index>(b);
    const std::string& name = s.bodies[b].name;
    out.push_back({name, "torque, mean", "N m", plain(a.torque.col(c).mean(), 2), held_words(r, b)});
    out.push_back({name, "force on the bearing, mean", "N", plain(f.mean, 1), ""});
    out.push_back({name, "force on the bearing, largest", "N", plain(f.most, 1), ""});
    out.push_back({name, "force on the bearing, RMS of the oscillating part", "N", plain(f.rms, 2), ""});
    out.push_back({name, "force on the bearing, first order", "N", plain(f.first, 2), ""});
    if (const std::string level = level_words(f.first); level != html::kNoValue)
      out.push_back({name, "force on the bearing, first order, level of its RMS", "dB re 1 N", level, ""});
  }
}

}  // namespace

std::vector<SystemNumber> system_numbers(const SystemReport& r) {
  std::vector<SystemNumber> out;
  if (r.rest) add_rest(r, out);
  if (r.modes)
    for (Index i = 0; i < r.modes->natural_frequency.size(); ++i)
      out.push_back({text("mode ", i + 1), "natural frequency", "Hz", shown(r.modes->natural_frequency[i], 7),
                     r.modes->natural_frequency[i] == 0 ? "free motion"
                                                        : name_of(r.modes->type[static_cast<size_t>(i)])});
  const std::vector<SystemNumber> motion = motion_numbers(r);
  out.insert(out.end(), motion.begin(), motion.end());
  return out;
}

namespace {

// Of the gears as they are drawn, a column for each.
std::string drawings_table(const SystemStaticResult& a) {
  std::vector<std::string> head{"", "unit"};
  std::vector<ToothGeometry> gears;
  head.reserve(a.drawing.size() + 2);
  gears.reserve(a.drawing.size());
  for (size_t g = 0; g < a.drawing.size(); ++g) {
    head.push_back(a.settings.body[g].first);
    gears.emplace_back(a.drawing[g].design);
  }
  return html::table("Geometry of the gears; all keys of the scene stand below, under Parameters.", head,
                     drawing_rows(gears));
}

}  // namespace

std::string gear_tables(const SystemReport& r) {
  const System& s = layout_of(r);
  html::Rows rows;
  Figure speeds;
  add_shafts(s, speeds);
  constexpr double kAt = 1000;  // Hz
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const System::Body& body = s.bodies[b];
    rows.push_back({body.name, body.teeth > 0 ? text(body.teeth) : "carrier", sense_words(body),
                    held_words(r, b), stands_on(s, body), fixed(body.centre[0] * kMilli, 3),
                    fixed(body.centre[1] * kMilli, 3), fixed(2 * body.radius * kMilli, 3),
                    body.inertia > 0 ? shown(body.inertia, 4) : "–", bearing_words(body),
                    body.bearing.elastic() ? shown(body.bearing.mass, 4) : "–"});
    if (!speeds.shafts.empty())
      rows.back().insert(rows.back().begin() + 3, fixed(60 * kAt * std::abs(speeds.shafts[b].turns), 1));
  }
  std::vector<std::string> head{
      "body",   "teeth",         "sense",           "rotation",       "axis on",        "x (mm)",
      "y (mm)", "diameter (mm)", "inertia (kg m²)", "bearing (N/µm)", "mass on it (kg)"};
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
                 r.rest ? "" : "; torques do not change natural modes",
                 ". Diameter: of the base circle, of a carrier of the circle of its pins. The ",
                 "inertia of a body that is held has no meaning."),
             head, rows, "small") +
         (r.rest ? drawings_table(*r.rest) : "");
}

std::string mesh_tables(const SystemReport& r) {
  const System& s = layout_of(r);
  std::vector<std::string> head{"", "unit"};
  std::vector<GearPair> pairs;
  pairs.reserve(s.meshes.size());
  head.reserve(s.meshes.size() + 2);
  std::vector<std::vector<std::string>> more{{"mesh phase", "mesh periods"}};
  if (r.rest)
    more.insert(more.end(), {{"tip clearance, driving / driven", "mm"},
                             {"specific sliding where a pair comes, driving / driven", "–"},
                             {"specific sliding where it leaves", "–"}});
  else
    more.insert(more.end(),
                {{"centre distance", "mm"}, {"working pressure angle", "deg"}, {"stiffness", "N/µm"}});
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const System::Mesh& mesh = s.meshes[m];
    head.push_back(mesh_name(s, m));
    more[0].push_back(fixed(mesh.phase, 4));
    if (!r.rest) {
      more[1].push_back(fixed(mesh.centre_distance * kMilli, 3));
      more[2].push_back(fixed(mesh.pressure_angle * kInDegrees, 3));
      more[3].push_back(shown(mesh.stiffness * 1e-6, 5));
      continue;
    }
    const GearPair& pair = pairs.emplace_back(r.rest->mesh[m]);
    more[1].push_back(text(fixed(tip_clearance_to_root(pair, 0) * kMilli, 3), " / ",
                           fixed(tip_clearance_to_root(pair, 1) * kMilli, 3)));
    for (const size_t end : {0, 1}) {
      const auto sliding = specific_sliding(pair, end == 0 ? pair.path_start() : pair.path_end());
      const auto cell = [](const std::optional<double>& value) {
        return value ? fixed(*value, 2) : html::kNoValue;
      };
      more[2 + end].push_back(cell(sliding[0]) + " / " + cell(sliding[1]));
    }
  }
  html::Rows rows = r.rest ? mesh_rows(pairs) : html::Rows();
  rows.insert(rows.end(), more.begin(), more.end());
  const std::string out = html::table(text("The meshes, the driving side first. Mesh phase: the part of a ",
                                           "mesh period by which a mesh is ahead of the first one."),
                                      head, rows);
  if (!r.rest) return out;
  return out +
         html::paragraph(
             text("The meshes at rest over ",
                  r.rest->hunting_periods > 1
                      ? text("the ", r.rest->hunting_periods, " mesh periods after which the same teeth meet")
                      : "the mesh period",
                  "; results.tsv holds the same numbers.",
                  load_sharing(*r.rest).empty() ? "" : " Share: of the load of the meshes of one [[mesh]].",
                  " Root stress of a gear: by the loads of that mesh.")) +
         results_tables(meshes_at_rest(*r.rest), r.rest->mesh_names);
}

std::string force_table(const SystemReport& r) {
  if (!r.rest) return "";
  const SystemStaticResult& a = *r.rest;
  const System& s = a.settings.layout;
  html::Rows rows;
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const Force f = force_of(a, b);
    const auto column = a.torque.col(static_cast<Index>(b));
    rows.push_back({s.bodies[b].name, held_words(r, b), plain(column.mean(), 2),
                    plain(peak_to_peak(column), 2), bearing_words(s.bodies[b]), plain(f.mean_x, 1),
                    plain(f.mean_y, 1), plain(f.most, 1), plain(f.rms, 2), plain(f.first, 2),
                    level_words(f.first)});
  }
  return html::table(
      text("Torques, in the sense in which each body turns, and forces on bearings and pins over the ",
           "mesh period; on a rigid axis the sum of the contact forces. RMS: of the oscillating part, ",
           "which acts on the housing."),
      {"body", "rotation", "mean torque (N m)", "its peak to peak (N m)", "bearing (N/µm)",
       "mean force x (N)", "mean force y (N)", "largest force (N)", "RMS (N)", "first order (N)",
       "its level (dB re 1 N)"},
      rows);
}

std::string modes_table(const SystemReport& r) {
  if (!r.modes) return "";
  const ModesResult& a = *r.modes;
  const TurningMember driver = driving_member(r);
  const bool bands = a.frozen_frequency.size() > 0;
  html::Rows rows;
  for (Index i = 0; i < a.natural_frequency.size(); ++i) {
    const double f = a.natural_frequency[i];
    Index most = 0;
    const double share = a.kinetic_energy.row(i).maxCoeff(&most);
    rows.push_back(
        {text(i + 1), shown(f, 6), driver.turns > 0 ? fixed(driver.rpm(f), 0) : html::kNoValue,
         f == 0 ? "free motion" : name_of(a.type[static_cast<size_t>(i)]),
         f == 0 ? "–" : fixed(a.mesh_energy.row(i).sum() * kPercent, 1),
         f == 0 ? "–" : fixed(a.bearing_energy.row(i).sum() * kPercent, 1),
         text(a.layout.bodies[static_cast<size_t>(most)].name, ", ", fixed(share * kPercent, 0), " %")});
    if (bands)
      rows.back().push_back(f == 0 ? "–"
                                   : text(shown(a.frozen_frequency.col(i).minCoeff(), 6), " to ",
                                          shown(a.frozen_frequency.col(i).maxCoeff(), 6)));
  }
  std::vector<std::string> head{"mode",
                                "natural frequency (Hz)",
                                "met by order 1 at (rpm of " + driver.name + ")",
                                "type",
                                "energy in the meshes (%)",
                                "energy in bearings and holds (%)",
                                "moves most (share of the kinetic energy)"};
  if (bands) head.emplace_back("over the mesh phases, by rank (Hz)");
  return html::table(
      text("Natural modes, the meshes at their mean stiffness.",
           !has_planets(a.layout) ? " Train: the system has no planets."
                                  : text(" Rotational: central gears turn, planets all move alike. ",
                                         "Translational: central gears move sideways; at equal spacing ",
                                         "in pairs of equal frequency. Planet: planets alone. Mixed: ",
                                         "none of these, of planets that differ or stand unequally."),
           bands ? text(" Over the mesh phases: with the contact of each phase, the lowest frequency ",
                        "with the lowest; modes are not followed by their shapes, so that the frequency ",
                        "at the mean stiffness may lie beside.")
                 : ""),
      head, rows);
}

std::string settings_table(const SystemReport& r) {
  if (!r.rest) return "";
  return scene_table(
      "Every value of the scene that went into the results, defaults included, in the scene's units; inertias and masses that the scene leaves out are those of the bodies. Torques and what is held: under At rest.",
      scene_keys_of(*r.rest, r.sweeps.empty() ? nullptr : &r.sweeps.front().train), speed_rows(r.sweeps));
}

namespace {

// Whether the planets of these meshes stand at equal angles about their carrier.
bool equally_spaced(const System& s, const std::vector<size_t>& meshes) {
  std::vector<double> angles;
  angles.reserve(meshes.size());
  for (const size_t m : meshes)
    for (const System::Side& side : s.meshes[m].side) {
      const System::Body& planet = s.bodies[static_cast<size_t>(side.body)];
      if (planet.on == System::kGround) continue;
      const System::Body& carrier = s.bodies[static_cast<size_t>(planet.on)];
      angles.push_back(
          std::atan2(planet.centre[1] - carrier.centre[1], planet.centre[0] - carrier.centre[0]));
    }
  std::sort(angles.begin(), angles.end());
  const double step = 2 * std::numbers::pi / static_cast<double>(angles.size());
  for (size_t i = 1; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return false;
  return true;
}

void remark_rest(const SystemStaticResult& a, std::vector<Remark>& out) {
  const System& s = a.settings.layout;
  constexpr double kSmall = 0.01;   // of the largest load of a pair
  constexpr double kUnequal = 1.3;  // of an equal share
  out = a.remarks;
  for (const auto& [name, meshes] : alike_meshes(a.settings)) {
    double pressure = 0, edge = 0, most = 0;
    for (const size_t m : meshes) {
      pressure = std::max(pressure, a.mesh[m].contact_pressure.maxCoeff());
      edge = std::max(edge, tip_edge_load(a.mesh[m]));
      most = std::max(most, a.mesh[m].tooth_load.maxCoeff());
    }
    if (pressure > kHardenedSteelPressure)
      out.push_back(
          remark(true, name, ": the contact pressure of ", fixed(pressure * 1e-9, 2), kBeyondSteel));
    if (edge > kSmall * most)
      out.push_back(remark(false, name, ": tip edges of bent teeth carry up to ", fixed(edge, 0), " N, ",
                           fixed(edge / most * kPercent, 0),
                           " % of the largest tooth load; tip relief takes that away"));
  }
  for (const LoadSharing& of : load_sharing(a))
    out.push_back(
        remark(of.factor > kUnequal, of.name, ": the most loaded of ", of.meshes.size(),
               " meshes carries up to ", fixed(of.factor, 3), " times an equal share",
               of.factor <= kUnequal ? ""
               : equally_spaced(s, of.meshes)
                   ? ". Let a central gear float on a softer [[bearing]]"
                   : ". Let a central gear float on a softer [[bearing]], or space the planets equally"));
  for (const std::string& words : colliding_gears(s, designs_of(a))) out.push_back({true, words});
  std::string rigid;
  for (const System::Body& body : s.bodies)
    if (!body.bearing.elastic()) rigid += (rigid.empty() ? "" : ", ") + body.name;
  if (!rigid.empty()) out.push_back(remark(false, "on rigid axes, without motion in x and y: ", rigid));
  out.push_back(remark(
      false, "largest unbalance of a torque over the largest mesh force: ", shown(a.torque_residual, 2)));
}

void remark_modes(const ModesResult& a, std::vector<Remark>& out) {
  const auto mixed = std::count(a.type.begin(), a.type.end(), ModeType::mixed);
  if (mixed > 0)
    out.push_back(remark(
        false, mixed,
        " modes are mixed: the planets are not alike or not equally spaced, so that modes are neither purely rotational nor translational"));
  if (a.frozen_frequency.size() > 0)
    out.push_back(remark(
        false,
        "elastic modes of the gear bodies themselves are left out; frequencies near or above the lowest of a body (eigenfrequency in its body.h5) are not to be trusted"));
  if (a.turning_frequency.size() > 0)
    out.push_back(remark(
        false,
        "frequencies and shapes are those of a carrier at rest; Coriolis and centrifugal terms shift the former by up to ",
        shown((a.turning_frequency.bottomRows<1>() - a.turning_frequency.topRows<1>()).cwiseAbs().maxCoeff(),
              3),
        " Hz at a mesh frequency of ", shown(a.turning_mesh_frequency.tail<1>()[0], 4),
        " Hz, in proportion to speed: Campbell diagram"));
  else if (has_planets(a.layout))
    out.push_back(remark(
        false, "Coriolis and centrifugal terms of a turning carrier are left out, of the relative size ",
        "2 times its speed over the natural frequency"));
}

}  // namespace

std::string system_remarks(const SystemReport& r) {
  std::string items;
  bool warned = false;
  const TurningMember driver = driving_member(r);
  const auto add = [&](const char* where, const std::vector<Remark>& remarks) {
    items += remark_items(where, remarks, driver);
    for (const Remark& one : remarks) warned = warned || one.warning;
  };
  std::vector<Remark> rest, modes;
  if (r.rest) remark_rest(*r.rest, rest);
  if (r.modes) remark_modes(*r.modes, modes);
  add("at rest", rest);
  add("natural modes", modes);
  add("in motion", motion_remarks(r));
  return remark_list(items, warned);
}

}  // namespace whine
