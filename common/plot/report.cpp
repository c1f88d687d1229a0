#include "plot/report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>

#include "base/error.h"
#include "base/tool.h"
#include "contact/half_plane_strip.h"
#include "gear/body_inertia.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "io/publish.h"
#include "io/scene_keys.h"
#include "io/summary.h"
#include "motion/flank_pressure.h"
#include "plot/figures.h"
#include "plot/motion_figures.h"
#include "plot/report_geometry.h"
#include "plot/report_guide.h"
#include "plot/report_style.h"
#include "plot/stiffness_table.h"
#include "signal/response.h"

namespace whine {
namespace {

using Eigen::Index;
using Rows = std::vector<std::vector<std::string>>;

// ---- marks of HTML

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string tagged(const std::string& tag, const std::string& inside) {
  return "<" + tag + ">" + inside + "</" + tag.substr(0, tag.find(' ')) + ">";
}

bool is_number(const std::string& cell) {
  const std::string start = "+-0123456789";
  return !cell.empty() && start.find(cell[0]) != std::string::npos;
}

// Cells are words, not marks; a column of numbers stands to the right.
std::string table(const std::string& caption, const std::vector<std::string>& head, const Rows& rows,
                  const std::string& kind = "") {
  std::vector<std::string> open(head.size());
  for (size_t c = 0; c < head.size(); ++c) {
    const auto count = [&](const auto& of) {
      return std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return of(row[c]); });
    };
    const auto filled = count([](const std::string& cell) { return !cell.empty(); });
    if (2 * count(is_number) > filled) open[c] = " class=\"number\"";
  }
  std::string out = "<div class=\"wide\"><table" + (kind.empty() ? "" : " class=\"" + kind + "\"") +
                    ">\n<caption>" + escaped(caption) + "</caption>\n<thead><tr>";
  for (size_t c = 0; c < head.size(); ++c) out += tagged("th" + open[c], escaped(head[c]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (size_t c = 0; c < head.size(); ++c) out += tagged("td" + open[c], escaped(row[c]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string paragraph(const std::string& words) {
  return tagged("p", escaped(words)) + "\n";
}

std::string listed(const std::vector<std::string>& words) {
  std::string out;
  for (size_t i = 0; i < words.size(); ++i)
    out += (i == 0 ? "" : i + 1 == words.size() ? " and " : ", ") + words[i];
  return out;
}

// With all of its digits: 1.400 where shown() has 1.4.
std::string significant(double value, int digits) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%#.*g", digits, value);
  std::string out = buffer;
  if (out.back() == '.') out.pop_back();
  return out;
}

// ---- what is said of the scene

const ReportSweep* sweep_of(const ReportContent& c, double torque, const std::string& direction) {
  for (const ReportSweep& s : c.sweeps)
    if (s.response.torque == torque && s.response.direction == direction) return &s;
  return nullptr;
}

const ImpactArtifact* impact_of(const ReportContent& c, double torque) {
  for (const ImpactArtifact& a : c.impacts)
    if (a.torque == torque) return &a;
  return nullptr;
}

double static_force(const StaticArtifact& s) {
  return s.torque / ToothGeometry(s.driver).base_radius();
}

double face_width(const StaticArtifact& s) {
  return std::min(s.driver.face_width, s.driven.face_width);
}

double peak_to_peak(const Eigen::VectorXd& v) {
  return v.maxCoeff() - v.minCoeff();
}

std::string hertz(double f) {
  return fixed(f, 0);
}

std::string jumps_of(const ResponseArtifact& r) {
  std::vector<double> jumps(r.jump_frequency.begin(), r.jump_frequency.end());
  std::sort(jumps.begin(), jumps.end());
  std::string out;
  for (const double f : jumps) out += (out.empty() ? "" : ", ") + hertz(f);
  return out.empty() ? "none" : out;
}

// Hertz's pressure (Pa) of a force (N) on one tooth pair at the pitch point.
double hertz_pressure(const StaticArtifact& s, double force) {
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const double tangent = std::tan(pair.working_pressure_angle());
  const double curvature = (1 / pair.gear(0).base_radius() + 1 / pair.gear(1).base_radius()) / tangent;
  const auto compliance = [&](const Material& material) {
    const Material m = in_contact_plane(material, s.mesh.contact_plane);
    return (m.plane_stress ? 1 : 1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  return std::sqrt(
      force * curvature /
      (face_width(s) * std::numbers::pi * (compliance(s.driver_material) + compliance(s.driven_material))));
}

// Whether the motion at a row of the sweep goes beyond the backlash.
bool beyond_backlash(const ReportSweep& s, Index row) {
  return row < s.backlash_left.size() && s.backlash_left[row] <= 0;
}

std::string way_words(const ReportSweep& s) {
  return s.response.direction == "up" ? "speed rising" : "speed falling";
}

// In Hz; "" if there are none.
std::string speeds_beyond_backlash(const ReportSweep& s) {
  std::map<double, bool> beyond;
  for (Index i = 0; i < s.response.mesh_frequency.size(); ++i)
    beyond[s.response.mesh_frequency[i]] = beyond_backlash(s, i);
  return speed_ranges(beyond);
}

// One definition at rest and in motion, so that the two can be compared.
const std::string kNominalPressure =
    "nominal contact pressure of the largest tooth load (Hertz, at the pitch point)";
constexpr const char* kBeyond = "beyond the backlash";

struct Result {
  double torque;  // N m
  std::string quantity, unit, value;
  std::string remark = "";
};

std::vector<Result> results_of(const ReportContent& c) {
  std::vector<Result> out;
  for (const StaticArtifact& s : c.statics) {
    const auto add = [&](const std::string& quantity, const std::string& unit, const std::string& value,
                         const std::string& remark = "") {
      out.push_back({s.torque, quantity, unit, value, remark});
    };
    add("mean mesh stiffness", "N/µm", fixed(s.mean_stiffness * 1e-6, 1));
    add("the same per face width", "N/(mm µm)", fixed(s.mean_stiffness * 1e-6 / (face_width(s) * kMilli), 2));
    add("static transmission error, mean", "µm", significant(s.transmission_error.mean() * kMicro, 4));
    add("static transmission error, peak to peak", "µm",
        significant(peak_to_peak(s.transmission_error) * kMicro, 4));
    for (Index n = 1; n <= std::min<Index>(3, s.transmission_error_harmonic.size() - 1); ++n)
      add(text("static transmission error, harmonic ", n), "µm",
          significant(s.transmission_error_harmonic[n] * kMicro, 3));
    add("static tooth load, largest", "N", fixed(s.tooth_load.maxCoeff(), 0));
    add(text("static: ", kNominalPressure), "MPa",
        fixed(hertz_pressure(s, s.tooth_load.maxCoeff()) * 1e-6, 0));
    const FlankPressure pressure = flank_pressure(s);
    if (pressure.smooth > 0)
      add("static contact pressure inside a flank, largest", "MPa", fixed(pressure.smooth * 1e-6, 0));
    if (pressure.on_ridge > pressure.smooth)
      add("the same where relief begins", "MPa", "no value: see the warnings");
    if (const ImpactArtifact* a = impact_of(c, s.torque))
      for (size_t i = 0; i < a->contact_state.size(); ++i) {
        const Index at = static_cast<Index>(i);
        const std::string state =
            at < a->state_phase.size()
                ? a->contact_state[i] + (i == 0 && a->contact_state[i] == "one" ? " pair" : " pairs")
                : "mean over the period";
        add("natural frequency by ring-down, " + state, "Hz", hertz(a->natural_frequency[at]));
        add("damping ratio by ring-down, " + state, "%", fixed(a->damping_ratio[at] * kPercent, 2));
      }
    const ReportSweep *up = sweep_of(c, s.torque, "up"), *down = sweep_of(c, s.torque, "down");
    for (const ReportSweep* sweep : {up, down}) {
      if (!sweep) continue;
      const ResponseArtifact& r = sweep->response;
      const std::string way = r.direction == "up" ? ", speed rising" : ", speed falling";
      Index at = 0;
      const double rms = r.dte_rms.maxCoeff(&at);
      std::string beyond = beyond_backlash(*sweep, at) ? kBeyond : "";
      add("largest RMS of the dynamic transmission error" + way, "µm", significant(rms * kMicro, 3), beyond);
      add("mesh frequency of that RMS" + way, "Hz", hertz(r.mesh_frequency[at]), beyond);
      const double load = r.tooth_load_max.maxCoeff(&at);
      beyond = beyond_backlash(*sweep, at) ? kBeyond : "";
      add("largest tooth load" + way, "N", fixed(load, 0), beyond);
      add("mesh frequency of that tooth load" + way, "Hz", hertz(r.mesh_frequency[at]), beyond);
      add("largest tooth load over T / r_b" + way, "1", fixed(load / static_force(s), 2), beyond);
      add(kNominalPressure + way, "MPa", fixed(hertz_pressure(s, load) * 1e-6, 0), beyond);
      for (int g = 0; g < 2; ++g)
        if (r.bearing_force_rms[g].size() > 0) {
          const std::string of = "force on the bearing of " + s.mesh.gear(g);
          const double force = r.bearing_force_rms[g].maxCoeff(&at);
          beyond = beyond_backlash(*sweep, at) ? kBeyond : "";
          add("largest RMS of the oscillating " + of + way, "N", fixed(force, 0), beyond);
          add("mesh frequency of that RMS, " + s.mesh.gear(g) + way, "Hz", hertz(r.mesh_frequency[at]),
              beyond);
          add("largest " + of + way, "N", fixed(r.bearing_force_max[g].maxCoeff(&at), 0),
              beyond_backlash(*sweep, at) ? kBeyond : "");
        }
      add("jumps" + way, "Hz", jumps_of(r));
      if (const std::string speeds = speeds_beyond_backlash(*sweep); !speeds.empty())
        add("motion beyond the backlash" + way, "Hz", speeds);
    }
    if (up && down) add("contact lost at", "Hz", loss_ranges(up->response, down->response));
  }
  return out;
}

// A row for each quantity in the order in which they come, a column for each torque.
std::string results_table(const ReportContent& c) {
  const std::vector<Result> results = results_of(c);
  std::vector<std::string> head{"", "unit"};
  for (const auto& s : c.statics) head.push_back(torque_words(s.torque));
  Rows rows;
  bool remarked = false;
  for (const Result& result : results) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r[0] == result.quantity; });
    if (row == rows.end()) {
      rows.push_back({result.quantity, result.unit == "1" ? "–" : result.unit});
      rows.back().resize(head.size());
      row = rows.end() - 1;
    }
    for (size_t t = 0; t < c.statics.size(); ++t)
      if (c.statics[t].torque == result.torque)
        (*row)[t + 2] = result.value + (result.remark.empty() ? "" : " *");
    remarked = remarked || !result.remark.empty();
  }
  return table("Results by torque on the driver; results.tsv holds the same numbers.", head, rows) +
         (remarked ? paragraph("* At this speed the motion is larger than the backlash: back flanks would "
                               "touch, which is not modelled, so the number is not to be trusted.")
                   : "");
}

std::string gears_table(const ReportContent& c) {
  const StaticArtifact& s = c.statics.front();
  constexpr double kNoBacklash = 1e-6;  // m: what a centre distance rounded to a micrometre leaves
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const auto degrees = [](double rad) { return fixed(rad * 180 / std::numbers::pi, 3); };
  Rows rows;
  const auto both = [&](const std::string& what, const std::string& unit, const auto& value) {
    rows.push_back({what, unit, value(pair.gear(0)), value(pair.gear(1))});
  };
  using G = const ToothGeometry&;
  both("teeth", "–", [](G g) { return text(g.design().teeth); });
  both("module", "mm", [](G g) { return shown(g.design().module * kMilli, 6); });
  both("profile shift", "modules", [](G g) { return shown(g.design().profile_shift, 6); });
  both("base diameter", "mm", [](G g) { return fixed(2 * g.base_radius() * kMilli, 3); });
  both("reference diameter", "mm", [](G g) { return fixed(2 * g.pitch_radius() * kMilli, 3); });
  both("tip diameter", "mm", [](G g) { return fixed(2 * g.tip_radius() * kMilli, 3); });
  both("root diameter", "mm", [](G g) { return fixed(2 * g.root_radius() * kMilli, 3); });
  both("roll angle where the involute begins", "deg", [&](G g) { return degrees(g.form_roll_angle()); });
  both("roll angle at the tip", "deg", [&](G g) { return degrees(g.tip_roll_angle()); });
  both("tooth thickness at the tip", "mm",
       [](G g) { return fixed(g.thickness_at_radius(g.tip_radius()) * kMilli, 3); });
  const auto points = path_points(pair);
  const auto diameter = [&](const std::string& what, size_t driver, size_t driven) {
    rows.push_back({what, "mm", fixed(points[driver].diameter[0] * kMilli, 3),
                    fixed(points[driven].diameter[1] * kMilli, 3)});
  };
  diameter("diameter where the active profile starts (SAP)", 0, 4);
  diameter("diameter at B, from where one pair carries alone", 1, 1);
  diameter("diameter at D, up to where it does", 3, 3);
  both("face width", "mm", [](G g) { return shown(g.design().face_width * kMilli, 6); });
  rows.push_back({"inertia of the body as drawn, bore to tip, without fillets", "kg m²",
                  shown(least_body_inertia(pair.gear(0), s.driver_material), 3),
                  shown(least_body_inertia(pair.gear(1), s.driven_material), 3)});
  if (!c.impacts.empty()) {
    constexpr double kFillets = 1.03;  // what fillets add to the outline at most
    const ImpactArtifact& a = c.impacts.front();
    const auto total = [&](size_t g, const Material& material, double inertia) {
      return shown(inertia, 4) +
             (inertia < kFillets * least_body_inertia(pair.gear(g), material) ? ", as drawn" : "");
    };
    rows.push_back({"inertia in motion, with all that turns with the gear", "kg m²",
                    total(0, s.driver_material, a.driver_inertia),
                    total(1, s.driven_material, a.driven_inertia)});
  }
  rows.push_back({"flanks", "", in_words(s.mesh.modification[0]), in_words(s.mesh.modification[1])});
  if (s.mesh.on_bearings()) {
    const auto of_bearing = [&](const char* what, const char* unit, double scale, double Bearing::*number,
                                const char* none) {
      const auto value = [&](const Bearing& b) {
        return !b.elastic() ? "rigid" : b.*number == 0 ? none : shown(b.*number * scale, 5);
      };
      rows.push_back({what, unit, value(s.mesh.bearing[0]), value(s.mesh.bearing[1])});
    };
    of_bearing("radial stiffness of the bearing", "N/µm", 1e-6, &Bearing::stiffness, "0");
    of_bearing("radial damping of the bearing", "N s/m", 1, &Bearing::damping, "0");
    of_bearing("mass on the bearing", "kg", 1, &Bearing::mass, "as drawn");
  }
  return table(text("The gears: ", s.mesh.driver, " drives ", s.mesh.driven, "."),
               {"", "unit", s.mesh.driver + " (driver)", s.mesh.driven + " (driven)"}, rows) +
         table("Their mesh.", {"", "unit", "value"},
               {{"centre distance", "mm", shown(pair.centre_distance() * kMilli, 7)},
                {"working pressure angle", "deg", degrees(pair.working_pressure_angle())},
                {"base pitch", "mm", fixed(pair.base_pitch() * kMilli, 4)},
                {"contact ratio", "–", fixed(pair.contact_ratio(), 4)},
                {"path of contact before the pitch point", "mm", fixed(-pair.path_start() * kMilli, 3)},
                {"path of contact after it", "mm", fixed(pair.path_end() * kMilli, 3)},
                {"backlash along the line of action", "mm",
                 std::abs(pair.backlash()) < kNoBacklash ? "none" : fixed(pair.backlash() * kMilli, 4)},
                {"tip edges off the line of action", "", corner_words(s.mesh.corner)}});
}

std::string stiffness_tables(const ReportContent& c) {
  std::string out;
  for (const WordTable& t : {compliance_table(c.statics[0]), iso_table(c.statics[0])})
    out += table(t.caption, t.head, t.rows);
  return out;
}

// "" for gears on rigid axes.
std::string bearing_frequencies_table(const ReportContent& c) {
  Rows rows;
  for (const ImpactArtifact& a : c.impacts)
    for (Index i = 0; i < a.state_phase.size() && a.frozen_frequency.size() > 0; ++i) {
      Index phase = 0;
      (a.mesh_phase.array() - a.state_phase[i]).abs().minCoeff(&phase);
      std::string all;
      for (const double f : a.frozen_frequency.row(phase)) all += (all.empty() ? "" : ", ") + fixed(f, 1);
      rows.push_back({shown(a.torque, 6), a.contact_state[static_cast<size_t>(i)], all});
    }
  if (rows.empty()) return "";
  return table(
      "Lowest natural frequencies with the contact frozen, undamped: the hubs on their bearings, along the "
      "line of "
      "action and across, and the mesh, which the table above shows.",
      {"torque (N m)", "loaded tooth pairs", "frequencies (Hz)"}, rows);
}

std::string natural_frequencies_table(const ReportContent& c) {
  Rows rows;
  for (const ImpactArtifact& a : c.impacts)
    for (Index i = 0; i < a.natural_frequency.size(); ++i)
      rows.push_back(
          {shown(a.torque, 6),
           i < a.state_phase.size() ? a.contact_state[static_cast<size_t>(i)] : "mean over the mesh period",
           fixed(a.natural_frequency[i], 1), fixed(a.damping_ratio[i] * kPercent, 3),
           fixed(a.undamped_frequency[i], 1)});
  return table(
             "Natural frequency and damping ratio of the mesh by ring-down: the gears are held at a mesh "
             "phase, a part of the torque is let go, and the decay is fitted.",
             {"torque (N m)", "loaded tooth pairs", "by ring-down (Hz)", "damping ratio (%)",
              "contact frozen, undamped (Hz)"},
             rows) +
         paragraph(
             "Three kinds of natural frequency stand on this page. By ring-down: of the decay, damped, the "
             "contact free to change. Contact frozen, undamped: the eigenvalue at the same phases, with the "
             "contact that the load leaves kept as it is. f_n in the figures of motion: the mean of that "
             "eigenvalue over phases of the mesh period that need not be those of the ring-downs, under the "
             "static load; resonances stand near it and its fractions.") +
         bearing_frequencies_table(c);
}

std::string budget_table(const ErrorBudgetArtifact& b) {
  Rows rows;
  const auto add = [&](const StaticChanges& changes, const std::string& what) {
    std::string rest = changes.entry;
    for (Index i = 0; i < changes.mean_stiffness_change.size(); ++i) {
      const size_t comma = rest.find(", ");
      const auto percent = [](double share) { return fixed(share * kPercent, 4); };
      rows.push_back({what, rest.substr(0, comma), percent(changes.mean_stiffness_change[i]),
                      percent(changes.peak_to_peak_change[i]), percent(changes.harmonic_change(i, 0)),
                      i < changes.pressure_change.size() ? percent(changes.pressure_change[i]) : "–"});
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
  };
  add(b.refinement, "error");
  add(b.choice, "other model");
  return table(
             "What each refinement alone changes in the statics at " + torque_words(b.torque) +
                 ". Another model is no error of this one and in no sum.",
             {"", "change", "mean stiffness (%)", "peak to peak (%)", "harmonic 1 (%)", "flank pressure (%)"},
             rows) +
         (b.choice_missing.empty() ? "" : paragraph("Not computed: " + b.choice_missing + "."));
}

// Values of driver and driven gear side by side, of what is no gear's in the first column.
std::string parameters_table(const ReportContent& c) {
  const std::vector<SceneKey> keys =
      c.sweeps.empty() ? scene_keys_of(c.statics[0]) : scene_keys_of(c.sweeps[0].response);
  Rows rows;
  for (const SceneKey& key : keys)
    rows.push_back({key.section, key.name, key.driver, key.driven, key.meaning});
  std::string torques;
  for (const auto& s : c.statics) torques += (torques.empty() ? "" : ", ") + shown(s.torque, 6);
  rows.push_back(
      {"operation", "torque_Nm", torques, "", "torque on the driver; the first sets the bearing dampers"});
  if (!c.sweeps.empty()) {
    const Eigen::VectorXd& f = c.sweeps[0].response.mesh_frequency;
    rows.push_back({"operation", "mesh_frequency_Hz",
                    text(shown(f.minCoeff(), 6), " to ", shown(f.maxCoeff(), 6), ", ", f.size(), " speeds"),
                    "", "speeds of a sweep"});
  }
  return table(
      "Every value of the scene that went into the results, defaults included, in the scene's units.",
      {"section", "key", c.statics[0].mesh.driver + ", or all", c.statics[0].mesh.driven, "meaning"}, rows,
      "small");
}

std::string provenance_table(const ReportContent& c) {
  Rows rows;
  std::vector<std::string> history;
  for (const ReportSource& source : c.sources) {
    std::string inputs;
    for (const InputRecord& input : source.origin.inputs)
      inputs += text(inputs.empty() ? "" : "; ", input.role, " ", input.path, " (",
                     input.sha256.substr(0, 12), ")");
    rows.push_back({source.path, source.sha256,
                    source.origin.tool + " " + source.origin.version + ": " + source.origin.command, inputs});
    for (const std::string& stage : source.origin.history)
      if (std::find(history.begin(), history.end(), stage) == history.end()) history.push_back(stage);
  }
  std::string out = table(
      "Artifacts, the SHA-256 of each file, the command that made it, and its inputs with the first "
      "digits of their SHA-256. `gear-inspect` says of each whether it is still what these inputs give.",
      {"artifact", "SHA-256", "made by", "from"}, rows, "small code");
  Rows earlier;
  for (const std::string& stage : history) earlier.push_back({stage});
  if (!earlier.empty()) out += table("Stages before these.", {"command"}, earlier, "small code");
  return out + paragraph(text("This page was written by gear-report ", kVersion, "."));
}

std::string remarks_list(const ReportContent& c) {
  constexpr size_t kMost = 12;  // of one artifact
  std::string out;
  bool warned = false;
  const auto add = [&](const std::string& where, const std::vector<Remark>& remarks) {
    for (size_t i = 0; i < std::min(remarks.size(), kMost); ++i)
      out += tagged(remarks[i].warning ? "li class=\"warning\"" : "li",
                    (remarks[i].warning ? "<strong>Warning.</strong> " : "") +
                        escaped(where + ": " + remarks[i].words) + ".") +
             "\n";
    if (remarks.size() > kMost)
      out += tagged("li", escaped(text(where, ": ", remarks.size() - kMost, " more of these."))) + "\n";
    for (const Remark& remark : remarks) warned = warned || remark.warning;
  };
  for (const StaticArtifact& s : c.statics) add("at rest, " + torque_words(s.torque), remarks(s));
  for (const ImpactArtifact& a : c.impacts) {
    std::vector<Remark> found;
    for (Index i = 0; i < a.state_phase.size(); ++i)
      if (const double ratio = a.damping_ratio[i]; ratio < 0.01 || ratio > 0.12)
        found.push_back(remark(true, "the damping ratio by ring-down with ",
                               a.contact_state[static_cast<size_t>(i)],
                               a.contact_state[static_cast<size_t>(i)] == "one" ? " pair" : " pairs",
                               " in contact is ", shown(ratio * kPercent, 3),
                               " %, outside 1 to 12 %; `make calibrate` finds the damping for a ratio"));
    add("ring-down, " + torque_words(a.torque), found);
  }
  for (const ReportSweep& s : c.sweeps) {
    std::vector<Remark> found = s.remarks;
    for (const StaticArtifact& at : c.statics) {
      if (at.torque != s.response.torque) continue;
      if (const double pressure = hertz_pressure(at, s.response.tooth_load_max.maxCoeff());
          pressure > kHardenedSteelPressure)
        found.push_back(remark(true,
                               "the contact pressure of the largest tooth load (Hertz, at the pitch "
                               "point) of ",
                               fixed(pressure * 1e-9, 2), kBeyondSteel));
    }
    add(text(way_words(s), ", ", torque_words(s.response.torque)), found);
  }
  if (c.budget && !c.budget->choice_missing.empty())
    out += tagged("li", escaped("error budget: not computed: " + c.budget->choice_missing)) + "\n";
  return (warned ? "" : paragraph("No stage warns of anything.")) +
         (out.empty() ? "" : tagged("ul class=\"remarks\"", "\n" + out) + "\n");
}

// ---- figures and what is said under them

std::string at_torques(const ReportContent& c,
                       const std::function<std::string(const StaticArtifact&)>& said) {
  std::vector<std::string> parts;
  for (const StaticArtifact& s : c.statics) parts.push_back(said(s) + " at " + torque_words(s.torque));
  return listed(parts);
}

std::string of_transmission_error(const ReportContent& c) {
  return "Static transmission error over a mesh period and its harmonics: how far the driver runs ahead of "
         "where rigid, unloaded "
         "gears would have it. From peak to peak it is " +
         at_torques(c,
                    [](const auto& s) {
                      return significant(peak_to_peak(s.transmission_error) * kMicro, 3) + " µm";
                    }) +
         "; this variation is what excites the whine.";
}

std::string of_stiffness(const ReportContent& c) {
  return "Mesh stiffness, the load over what it adds to the transmission error, over a mesh period and its "
         "harmonics; "
         "black: the rectangular "
         "wave that lumped models take instead. Its mean is " +
         at_torques(c, [](const auto& s) { return fixed(s.mean_stiffness * 1e-6, 1) + " N/µm"; }) + ".";
}

std::string of_load_sharing(const ReportContent& c) {
  const StaticArtifact& s = c.statics[0];
  return text(
      "The share of the load that a tooth pair carries on its way from the root of the driver's tooth to its "
      "tip (left), and the loads "
      "of all pairs over a mesh period at ",
      torque_words(s.torque),
      " (right). Grey lines: where contact begins and ends on the line of action, and between "
      "them the part with one pair; load beyond them is carried by tip edges. The contact ratio is ",
      fixed(s.contact_ratio, 3), ".");
}

// Where sweeps at a torque (0: at any) go beyond the backlash; "" if none does.
std::string beyond_words(const ReportContent& c, double torque) {
  std::string list;
  for (const ReportSweep& s : c.sweeps) {
    const std::string speeds = speeds_beyond_backlash(s);
    if (speeds.empty() || (torque > 0 && s.response.torque != torque)) continue;
    list += text(list.empty() ? "" : "; ", torque > 0 ? "" : torque_words(s.response.torque) + ", ",
                 way_words(s), ": ", speeds, " Hz");
  }
  return list.empty()
             ? ""
             : " Beyond the backlash, where back flanks would touch, which is not modelled: " + list + ".";
}

std::string of_response(const ReportContent& c) {
  std::string out =
      "RMS of the oscillating part of the dynamic transmission error against mesh frequency, with speed "
      "rising and falling; f_n is the natural frequency with the contact frozen under the static load, mean "
      "over the "
      "mesh period. ";
  for (const StaticArtifact& s : c.statics) {
    const ReportSweep *up = sweep_of(c, s.torque, "up"), *down = sweep_of(c, s.torque, "down");
    if (!up || !down) continue;
    const ResponseArtifact &r = up->response, &f = down->response;
    std::vector<std::string> peaks;
    for (const Index i : resonances(r))
      peaks.push_back(
          text(hertz(r.mesh_frequency[i]), " Hz (", significant(r.dte_rms[i] * kMicro, 3), " µm)"));
    const std::string loss = loss_ranges(r, f);
    out += text("At ", torque_words(s.torque), ", f_n = ", hertz(r.natural_frequency),
                " Hz: ", peaks.empty() ? "no resonance within the sweep" : "resonances at " + listed(peaks),
                "; ");
    if (r.jump_frequency.size() + f.jump_frequency.size() > 0)
      out += text("jumps rising: ", jumps_of(r), r.jump_frequency.size() > 0 ? " Hz" : "",
                  ", falling: ", jumps_of(f), f.jump_frequency.size() > 0 ? " Hz" : "", "; ");
    else
      out += "no jumps; ";
    out += loss == "nowhere" ? "contact is never lost. " : "contact is lost at " + loss + " Hz. ";
  }
  while (out.ends_with(' ')) out.pop_back();
  return out + beyond_words(c, 0);
}

std::string of_waterfall(const ReportContent& c) {
  const ReportSweep& s = c.sweeps[0];
  return text(
      "Spectra of the dynamic transmission error at ", torque_words(s.response.torque),
      sweep_of(c, s.response.torque, "up") && sweep_of(c, s.response.torque, "down")
          ? ", speed rising (above) and falling (below)"
          : ", " + way_words(s),
      " as colours, one line for each speed (left), and the amplitudes of the first orders of the mesh "
      "frequency (right). Orders run along rays; each "
      "is strong where it crosses the natural frequency of ",
      hertz(s.response.natural_frequency),
      " Hz (mean over the period, contact frozen under the static load). The mesh frequency is ",
      s.response.driver.teeth, " times the speed of the driver: 1000 Hz are ",
      fixed(60000.0 / s.response.driver.teeth, 0), " 1/min.", beyond_words(c, s.response.torque));
}

std::string of_tooth_loads(const ReportContent& c) {
  const StaticArtifact& s = c.statics[0];
  const ReportSweep *up = sweep_of(c, s.torque, "up"), *down = sweep_of(c, s.torque, "down");
  std::string out =
      "Largest load of a tooth pair against mesh frequency (above), and the loads over the mesh period at "
      "the speed with the largest "
      "vibration (below).";
  if (up && down) {
    const double load =
        std::max(up->response.tooth_load_max.maxCoeff(), down->response.tooth_load_max.maxCoeff());
    out += text(" At ", torque_words(s.torque), " it reaches ", fixed(load, 0), " N, ",
                fixed(load / static_force(s), 2), " times T / r_b = ", fixed(static_force(s), 0), " N.");
  }
  return out + beyond_words(c, s.torque);
}

std::string of_bearings(const ReportContent& c) {
  return "Force of each gear on its bearing against mesh frequency: what a housing hears. RMS of the "
         "oscillating part, at most " +
         at_torques(c,
                    [&](const StaticArtifact& s) {
                      double most = 0;
                      for (const char* direction : {"up", "down"})
                        if (const ReportSweep* sweep = sweep_of(c, s.torque, direction))
                          for (const Eigen::VectorXd& rms : sweep->response.bearing_force_rms)
                            if (rms.size() > 0) most = std::max(most, rms.maxCoeff());
                      return fixed(most, 0) + " N";
                    }) +
         ", and the largest force, beside the load at rest.";
}

std::string of_budget(const ReportContent& c) {
  if (!c.budget) return "";
  return text("Error budget of the statics at ", torque_words(c.budget->torque),
              ": what refining each discretisation alone changes. In all the mean stiffness changes by ",
              shown(c.budget->refinement.mean_stiffness_change.cwiseAbs().sum() * kPercent, 2),
              " %, the first harmonic of the transmission error by ",
              shown(c.budget->refinement.harmonic_change.col(0).cwiseAbs().sum() * kPercent, 2),
              " % at most.");
}

struct Explained {
  const char *name, *section, *title;
  std::function<std::string(const ReportContent&)> words;
};

std::function<std::string(const ReportContent&)> plain(const char* words) {
  return [words](const ReportContent&) { return std::string(words); };
}

const std::vector<Explained>& explained() {
  static const std::vector<Explained> all{
      {"fig01", "gears", "Mesh of the pair",
       plain("Finite element mesh of the pair and of the teeth in mesh. Flanks are exact involutes in the "
             "contact; the mesh carries their bending.")},
      {"profile-chart", "gears", "Profile charts",
       plain("Profile charts of the driving flanks as an inspection sheet shows them: material against roll "
             "angle, the tip to the right.")},
      {"fig03", "rest", "Contact zone",
       plain("Contact zone of the reference pair at the pitch point: strips, gap and pressure, beside "
             "Hertz's.")},
      {"fig12", "rest", "Static transmission error", of_transmission_error},
      {"fig13", "rest", "Mesh stiffness", of_stiffness},
      {"load-sharing", "rest", "Load sharing", of_load_sharing},
      {"sidebands", "rest", "Sidebands",
       plain("Teeth that differ: transmission error over the period after which the same teeth meet, and the "
             "shafts' orders and sidebands at rest and in motion.")},
      {"crack", "rest", "The cracked tooth",
       plain("The mark of the cracked tooth in the static transmission error, and its orders.")},
      {"fig05", "motion", "Vibration over speed", of_response},
      {"fig07", "motion", "Vibration over speed", of_response},
      {"fig14-elastic", "motion", "RMS and mean over speed",
       plain("RMS and mean of the dynamic transmission error against mesh frequency.")},
      {"waterfall", "motion", "Spectra over speed", of_waterfall},
      {"tooth-loads", "motion", "Tooth loads in motion", of_tooth_loads},
      {"bearing-forces", "motion", "Forces on the bearings", of_bearings},
      {"error-budget", "errors", "Error budget", of_budget}};
  return all;
}

// By its name, which is that of its files: numbers of the page would be taken for those of P2000's figures.
std::string figure(const ReportContent& c, const ReportPicture& picture, const Explained& kind) {
  std::string words = escaped(kind.words(c));
  if (const std::string paper = paper_figure(picture.name); !paper.empty())
    words += text(" ", picture.name, " shows of this pair what ", paper, " of P2000 ",
                  paper.starts_with("Figures") ? "show" : "shows", " of its own.");
  return text("<figure id=\"", picture.name, "\">\n<img alt=\"", escaped(picture.name),
              "\" src=\"data:image/png;base64,", base64(picture.bytes), "\">\n<figcaption><strong>",
              kind.title, " (", picture.name, ").</strong> ", words, " <span class=\"files\">", "<a href=\"",
              picture.name, ".tsv\">numbers</a> <a href=\"", picture.name, ".svg\">svg</a> <a href=\"",
              picture.name, ".png\">png</a></span></figcaption>\n</figure>\n");
}

std::string introduction(const ReportContent& c) {
  const StaticArtifact& s = c.statics[0];
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  std::vector<std::string> torques;
  for (const auto& a : c.statics) torques.push_back(shown(a.torque, 6));
  std::string out =
      text(s.mesh.driver, " (", s.driver.teeth, " teeth) drives ", s.mesh.driven, " (", s.driven.teeth,
           " teeth), module ", shown(s.driver.module * kMilli, 4), " mm, at a centre distance of ",
           shown(pair.centre_distance() * kMilli, 7), " mm: contact ratio ", fixed(s.contact_ratio, 3),
           ", working pressure angle ", fixed(pair.working_pressure_angle() * 180 / std::numbers::pi, 2),
           "°. Torque on the driver: ", listed(torques), " N m.");
  if (!c.sweeps.empty()) {
    const Eigen::VectorXd& f = c.sweeps[0].response.mesh_frequency;
    const double rpm = 60.0 / s.driver.teeth;
    out += text(" Speeds: ", hertz(f.minCoeff()), " to ", hertz(f.maxCoeff()), " Hz mesh frequency, ",
                fixed(f.minCoeff() * rpm, 0), " to ", fixed(f.maxCoeff() * rpm, 0), " 1/min of the driver.");
  } else {
    out += " Without motion: only gears at rest are computed for such a scene.";
  }
  return paragraph(out);
}

void require_whole(const ReportContent& c) {
  if (c.statics.empty())
    fail(Failure::input, "report: no static.h5 given; that of the scene's first torque is the least");
  const StaticArtifact& first = c.statics[0];
  const auto same_pair = [&](const auto& a, const std::string& what) {
    if (a.driver.teeth != first.driver.teeth || a.driven.teeth != first.driven.teeth ||
        a.mesh.centre_distance != first.mesh.centre_distance ||
        a.mesh.modification != first.mesh.modification)
      fail(Failure::input, "report: ", what, " at ", a.torque,
           " N m is of another pair than the static.h5 at ", first.torque,
           " N m; give artifacts of one scene");
  };
  for (const auto& s : c.statics) same_pair(s, "a static.h5");
  for (const auto& a : c.impacts) same_pair(a, "an impact.h5");
  for (const auto& s : c.sweeps) same_pair(s.response, "a sweep.h5");
  if (c.budget) same_pair(*c.budget, "the error_budget.h5");
  const std::vector<std::string> known = report_figures();
  for (size_t i = 0; i < c.pictures.size(); ++i) {
    const std::string& name = c.pictures[i].name;
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail(Failure::input, "report: there are no words for a figure '", name, "'; known are ", listed(known));
    for (size_t j = 0; j < i; ++j)
      if (c.pictures[j].name == name) fail(Failure::input, "report: figure ", name, " is given twice");
  }
}

}  // namespace

std::vector<std::string> report_figures() {
  std::vector<std::string> names;
  for (const Explained& kind : explained()) names.push_back(kind.name);
  return names;
}

std::vector<Index> resonances(const ResponseArtifact& r) {
  constexpr double kHigher = 1.2;
  constexpr size_t kMost = 5;
  const Index n = r.mesh_frequency.size();
  std::vector<Index> order(static_cast<size_t>(n)), peaks;
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](Index a, Index b) { return r.mesh_frequency[a] < r.mesh_frequency[b]; });
  const auto rms = [&](Index k) { return r.dte_rms[order[static_cast<size_t>(k)]]; };
  // Least RMS on the way to a higher one, or to the end of the sweep.
  const auto foot = [&](Index k, Index step) {
    double least = rms(k);
    for (Index i = k + step; i >= 0 && i < n && rms(i) <= rms(k); i += step) least = std::min(least, rms(i));
    return least;
  };
  for (Index k = 1; k + 1 < n; ++k)
    if (rms(k) > rms(k - 1) && rms(k) >= rms(k + 1) && rms(k) > kHigher * std::max(foot(k, -1), foot(k, 1)))
      peaks.push_back(k);
  std::sort(peaks.begin(), peaks.end(), [&](Index a, Index b) { return rms(a) > rms(b); });
  peaks.resize(std::min(peaks.size(), kMost));
  std::sort(peaks.begin(), peaks.end());
  for (Index& k : peaks) k = order[static_cast<size_t>(k)];
  return peaks;
}

std::string report_tsv(const ReportContent& c) {
  require_whole(c);
  std::string out = "# " + c.scene + "\ntorque [N m]\tquantity\tvalue\tunit\tremark\n";
  for (const GeometryNumber& g : pair_geometry(c.statics[0]))
    out += text("\t", g.quantity, "\t", g.value, "\t", g.unit, "\t\n");
  for (const Result& r : results_of(c))
    out += text(shown(r.torque, 6), "\t", r.quantity, "\t", r.value, "\t", r.unit, "\t", r.remark, "\n");
  return out;
}

std::string report_html(const ReportContent& c) {
  require_whole(c);
  const size_t colon = c.scene.find(": ");
  const std::string file = c.scene.substr(0, colon),
                    title = colon == std::string::npos ? c.scene : c.scene.substr(colon + 2);

  const auto figures_of = [&](const std::string& section) {
    std::string out;
    for (const Explained& kind : explained())
      for (const ReportPicture& picture : c.pictures)
        if (section == kind.section && picture.name == kind.name) out += figure(c, picture, kind);
    return out;
  };
  struct Section {
    std::string id, heading, inside;
  };
  std::vector<Section> sections;
  const auto add = [&](const char* id, const char* heading, const std::string& inside) {
    if (!inside.empty()) sections.push_back({id, heading, inside});
  };
  add("results", "Results", introduction(c) + results_table(c));
  add("remarks", "Warnings and remarks", remarks_list(c));
  add("guide", "What the numbers mean", guide_to_numbers(c));
  add("gears", "The gears", gears_table(c) + figures_of("gears"));
  add("rest", "At rest", stiffness_tables(c) + figures_of("rest"));
  add("frequencies", "Natural frequencies and damping",
      c.impacts.empty() ? "" : natural_frequencies_table(c));
  add("motion", "In motion", figures_of("motion"));
  add("errors", "What the errors are", figures_of("errors") + (c.budget ? budget_table(*c.budget) : ""));
  add("parameters", "Parameters", parameters_table(c));
  add("provenance", "Provenance", provenance_table(c));

  std::string contents, inside;
  for (const Section& s : sections) {
    contents += text("<li><a href=\"#", s.id, "\">", escaped(s.heading), "</a></li>\n");
    inside +=
        text("<section id=\"", s.id, "\">\n<h2>", escaped(s.heading), "</h2>\n", s.inside, "</section>\n");
  }
  return text(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
      escaped(title), "</title>\n<style>", kStyle, "</style>\n</head>\n<body>\n<header>\n<h1>",
      escaped(title), "</h1>\n<p class=\"scene\">Gear whine report of the scene <code>", escaped(file),
      "</code></p>\n</header>\n<main>\n<nav aria-label=\"Contents\"><ol>\n", contents, "</ol></nav>\n",
      inside, "</main>\n<footer><p>Whine ", kVersion,
      ", gear whine from elastic teeth that touch, part and touch again.</p></footer>\n</body>\n</html>\n");
}

}  // namespace whine
