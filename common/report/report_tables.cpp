#include "report/report_tables.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/error.h"
#include "base/tool.h"
#include "base/units.h"
#include "gear/body_inertia.h"
#include "gear/drawing_quantities.h"
#include "gear/helix.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "io/scene_keys.h"
#include "io/summary.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/stiffness_table.h"

namespace whine {
namespace {

using Eigen::Index;

// "" for gears on rigid axes.
std::string bearing_frequencies_table(const ReportContent& c) {
  html::Rows rows;
  for (const ImpactResult& a : c.impacts)
    for (Index i = 0; i < a.states.mesh_phase.size() && a.frozen_frequency.size() > 0; ++i) {
      Index phase = 0;
      (a.mesh_phase.array() - a.states.mesh_phase[i]).abs().minCoeff(&phase);
      std::string all, turned;
      for (const double f : a.frozen_frequency.row(phase)) {
        all += (all.empty() ? "" : ", ") + fixed(f, 1);
        turned += (turned.empty() ? "" : ", ") + fixed(driver_of(c).rpm(f), 0);
      }
      rows.push_back({shown(a.torque, 6), name_of(a.states.contact_state[static_cast<size_t>(i)]),
                      all + "\n" + turned + " rpm"});
    }
  if (rows.empty()) return "";
  return html::table(
      "Lowest natural frequencies with the contact frozen, undamped: the hubs on their bearings, along the line of action and across, and the mesh, which the table above shows.",
      {"torque (N m)", "loaded tooth pairs", "frequencies (Hz)"}, rows);
}

// Where the gears meet: clearances, ends of the contact, sliding.
void add_meeting_rows(const GearPair& pair, html::Rows& rows) {
  rows.push_back({"tip clearance, to the root circle of the mate", "mm",
                  fixed(tip_clearance_to_root(pair, 0) * kMilli, 3),
                  fixed(tip_clearance_to_root(pair, 1) * kMilli, 3)});
  rows.push_back({"root clearance, to the tip circle of the mate", "mm",
                  fixed(tip_clearance_to_root(pair, 1) * kMilli, 3),
                  fixed(tip_clearance_to_root(pair, 0) * kMilli, 3)});
  const auto points = path_points(pair);
  const auto diameter = [&](const std::string& what, size_t driver, size_t driven) {
    rows.push_back({what, "mm", fixed(points[driver].diameter[0] * kMilli, 3),
                    fixed(points[driven].diameter[1] * kMilli, 3)});
  };
  diameter("diameter where the active profile starts (SAP)", 0, 4);
  if (pair.base_helix_angle() == 0) {
    diameter("diameter at B, from where one pair carries alone", 1, 1);
    diameter("diameter at D, up to where it does", 3, 3);
  }
  for (const auto& [what, at] : {std::pair{"specific sliding where a pair comes into contact", 0},
                                 std::pair{"specific sliding where it leaves", 4}}) {
    const auto sliding = specific_sliding(pair, points[static_cast<size_t>(at)].path);
    const auto cell = [](const std::optional<double>& value) {
      return value ? fixed(*value, 3) : html::kNoValue;
    };
    rows.push_back({what, "–", cell(sliding[0]), cell(sliding[1])});
  }
}

void add_bearing_rows(const GearMeshSpec& mesh, html::Rows& rows) {
  if (!mesh.on_bearings()) return;
  const auto of_bearing = [&](const char* what, const char* unit, double scale, double Bearing::*number,
                              const char* none) {
    const auto value = [&](const Bearing& b) {
      return !b.elastic() ? "rigid" : b.*number == 0 ? none : shown(b.*number * scale, 5);
    };
    rows.push_back({what, unit, value(mesh.bearing[0]), value(mesh.bearing[1])});
  };
  of_bearing("radial stiffness of the bearing", "N/µm", 1e-6, &Bearing::stiffness, "0");
  of_bearing("radial damping of the bearing", "N s/m", 1, &Bearing::damping, "0");
  of_bearing("mass on the bearing", "kg", 1, &Bearing::mass, "as drawn");
}

}  // namespace

html::Rows drawing_rows(const std::vector<ToothGeometry>& gears) {
  html::Rows rows;
  using G = const ToothGeometry&;
  const auto all = [&](const std::string& what, const std::string& unit, const auto& value) {
    rows.push_back({what, unit});
    for (G gear : gears) rows.back().push_back(value(gear));
  };
  const auto mm = [](double length) { return fixed(length * kMilli, 3); };
  const auto degrees = [](double rad) { return fixed(rad * kInDegrees, 3); };
  if (std::any_of(gears.begin(), gears.end(), [](G g) { return g.internal(); }))
    all("kind", "–", [](G g) { return std::string(g.internal() ? "internal" : "external"); });
  all("teeth", "–", [](G g) { return text(g.design().teeth); });
  const bool helical = std::any_of(gears.begin(), gears.end(), [](G g) { return g.design().helical(); });
  all(helical ? "normal module" : "module", "mm", [](G g) { return shown(g.design().module * kMilli, 7); });
  all(helical ? "normal pressure angle of the rack" : "pressure angle of the rack", "deg",
      [](G g) { return shown(g.design().pressure_angle * kInDegrees, 6); });
  if (helical) {
    all("helix angle at the reference circle, hand", "deg",
        [](G g) { return text(shown(g.design().helix_angle * kInDegrees, 6), ", ", g.design().hand); });
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
  all("span W_k over k teeth", "mm", [&](G g) {
    const std::optional<Span> span = span_measurement(g);
    return span ? text(mm(span->length), ", k = ", span->teeth) : html::kNoValue;
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
    return std::abs(p.backlash()) < kNoBacklash ? "none" : fixed(length * kMilli, 4);
  };
  all("centre distance", "mm", [](P p) { return shown(p.centre_distance() * kMilli, 7); });
  all("working pressure angle", "deg", [](P p) { return fixed(p.working_pressure_angle() * kInDegrees, 3); });
  all("base pitch", "mm", [](P p) { return fixed(p.base_pitch() * kMilli, 4); });
  const bool helical =
      std::any_of(meshes.begin(), meshes.end(), [](P p) { return p.base_helix_angle() != 0; });
  all(helical ? "transverse contact ratio" : "contact ratio", "–",
      [](P p) { return fixed(p.contact_ratio(), 4); });
  if (helical) {
    all("overlap ratio", "–", [](P p) { return fixed(p.overlap_ratio(), 4); });
    all("total contact ratio", "–", [](P p) { return fixed(p.contact_ratio() + p.overlap_ratio(), 4); });
  }
  all("path of contact before the pitch point", "mm", [](P p) { return fixed(-p.path_start() * kMilli, 3); });
  all("path of contact after it", "mm", [](P p) { return fixed(p.path_end() * kMilli, 3); });
  all("normal backlash, along the line of action", "mm",
      [&](P p) { return backlash(p, normal_backlash(p)); });
  all("circumferential backlash, on the working pitch circles", "mm",
      [&](P p) { return backlash(p, circumferential_backlash(p)); });
  return rows;
}

std::string gears_table(const ReportContent& c) {
  const StaticResult& s = c.statics.front();
  const GearPair pair(s);
  html::Rows rows = drawing_rows({pair.gear(0), pair.gear(1)});
  if (pair.gear(0).undercut() > 0 || pair.gear(1).undercut() > 0)
    rows.push_back({"path of contact lost to undercut", "mm", fixed(pair.path_lost(0) * kMilli, 3),
                    fixed(pair.path_lost(1) * kMilli, 3)});
  add_meeting_rows(pair, rows);
  rows.push_back({"inertia of the body as drawn, bore to tip, without fillets", "kg m²",
                  shown(least_body_inertia(pair.gear(0), s.gear[0].material), 3),
                  shown(least_body_inertia(pair.gear(1), s.gear[1].material), 3)});
  if (!c.impacts.empty()) {
    constexpr double kFillets = 1.03;  // what fillets add to the outline at most
    const ImpactResult& a = c.impacts.front();
    const auto total = [&](int g) {
      const bool drawn = a.inertia[g] < kFillets * least_body_inertia(pair.gear(g), s.gear[g].material);
      return shown(a.inertia[g], 4) + (drawn ? ", as drawn" : "");
    };
    rows.push_back({"inertia in motion, with all that turns with the gear", "kg m²", total(0), total(1)});
  }
  rows.push_back({"flanks", "", in_words(s.mesh.modification[0]), in_words(s.mesh.modification[1])});
  add_bearing_rows(s.mesh, rows);
  html::Rows mesh = mesh_rows({pair});
  mesh.push_back({"tip edges off the line of action", "", corner_words(s.mesh.corner)});
  return html::table(text("The gears: ", s.mesh.gear[0], " drives ", s.mesh.gear[1], "."),
                     {"", "unit", s.mesh.gear[0] + " (driver)", s.mesh.gear[1] + " (driven)"}, rows) +
         html::table("Their mesh.", {"", "unit", "value"}, mesh);
}

std::string class_table(const ReportContent& c) {
  constexpr int kFinest = 3, kCoarsest = 9;
  const StaticResult& s = c.statics.front();
  const GearPair pair(s);
  html::Rows rows;
  std::string why;
  for (int grade = kFinest; grade <= kCoarsest; ++grade) try {
      const double most = most_error_of_class(pair, grade);
      rows.push_back({text(grade), fixed(most * kMicro, 1)});
      for (const StaticResult& at : c.statics)
        rows.back().push_back(fixed((peak_to_peak(at.transmission_error) + most) * kMicro, 1));
    } catch (const Error& error) {
      if (error.kind() != Failure::input) throw;
      why = error.what();
    }
  if (rows.empty()) return html::paragraph("No effect of a class of ISO 1328-1 is stated: " + why + ".");
  std::vector<std::string> head{"class", "adds at most (µm)"};
  for (const StaticResult& at : c.statics) head.push_back(torque_words(at.torque) + ": at most (µm)");
  return html::table(
      "What deviations within a class of ISO 1328-1:2013 add to the peak-to-peak transmission error of a mesh period, at most: a step of the single pitch tolerance of both gears for each pair that comes in, and their total profile deviations. Run-out and cumulative pitch are slower and left out; most gears of a class stay far below.",
      head, rows);
}

std::string stiffness_tables(const ReportContent& c) {
  std::string out;
  for (const WordTable& t : {compliance_table(c.statics[0]), iso_table(c.statics[0])})
    out += html::table(t.caption, t.head, t.rows);
  return out;
}

std::string face_level(const ReportContent& c) {
  const StaticResult& s = c.statics.front();
  if (s.face.none()) return "";
  std::string out = text(
      "Load over the face: contact at ", s.face.line_load[0].cols(), " points along each contact line, on ",
      s.face.degree > 0 ? text("bodies in three dimensions, polynomials to degree ", s.face.degree)
                        : "teeth that carry each section by itself (width = \"slices\")",
      ". K_Hβ, the largest over the mean line load of the reference pair at the pitch point, is ",
      fixed(s.face.load_factor, 3), " ± ", shown(s.face.load_factor_error, 1), " at ", torque_words(s.torque),
      ".");
  if (c.budget && c.budget->choice.load_factor_change.size() > 0) {
    const StaticChanges& next = c.budget->choice;
    const auto percent = [](double share) {
      return text(share < 0 ? "" : "+", fixed(share * kPercent, 1), " %");
    };
    out += text(" The next level over the face, bodies in three dimensions, makes it ",
                fixed(s.face.load_factor * (1 + next.load_factor_change[0]), 3),
                ", and changes the mean stiffness by ", percent(next.mean_stiffness_change[0]),
                ", the peak-to-peak transmission error by ", percent(next.peak_to_peak_change[0]),
                " and its first harmonic by ", percent(next.harmonic_change(0, 0)),
                ": width = \"body\" in [fidelity] takes it, of gears at rest.");
  }
  return html::paragraph(out);
}

std::string natural_frequencies_table(const ReportContent& c) {
  const TurningMember driver = driver_of(c);
  html::Rows rows;
  for (const ImpactResult& impact : c.impacts) {
    const ContactStateDecays& a = impact.states;
    for (Index i = 0; i < a.natural_frequency.size(); ++i)
      rows.push_back({shown(impact.torque, 6),
                      i < a.mesh_phase.size() ? name_of(a.contact_state[static_cast<size_t>(i)])
                                              : "mean over the mesh period",
                      fixed(a.natural_frequency[i], 1), fixed(driver.rpm(a.natural_frequency[i]), 0),
                      fixed(a.damping_ratio[i] * kPercent, 3), fixed(a.undamped_frequency[i], 1),
                      fixed(driver.rpm(a.undamped_frequency[i]), 0)});
  }
  return html::table(
             "Natural frequency and damping ratio of the mesh by ring-down: the gears are at a fixed mesh phase, a part of the torque is let go, and the decay is fitted. Rpm: of the driver, as the mesh frequency meets it.",
             {"torque (N m)", "loaded tooth pairs", "by ring-down (Hz)", "met at (rpm)", "damping ratio (%)",
              "contact frozen, undamped (Hz)", "met at (rpm)"},
             rows) +
         html::paragraph(
             "Three kinds of natural frequency stand on this page. By ring-down: of the decay, damped, the contact free to change. Contact frozen, undamped: the eigenvalue at the same phases, with the contact that the load leaves kept as it is. f_n in the figures of motion: the mean of that eigenvalue over phases of the mesh period that need not be those of the ring-downs, under the static load; resonances stand near it and its fractions.") +
         bearing_frequencies_table(c);
}

namespace {

// Largest root stress with elements of several sizes; "" where none is known.
std::string root_refinement_table(const ErrorBudgetResult& b) {
  if (b.root.element_size.size() == 0) return "";
  const RootConvergence found = convergence(b.root);
  html::Rows rows;
  for (int g = 0; g < kSides; ++g)
    for (Index k = 0; k < b.root.stress.rows(); ++k) {
      const bool changes = k > 0;
      const double order = k > 1 ? resolved_order(found, k - 2, g) : std::numeric_limits<double>::quiet_NaN();
      rows.push_back({b.mesh.gear[g], shown(b.root.element_size[k] * 1e3, 4),
                      fixed(b.root.stress(k, g) * 1e-6, 2),
                      changes ? fixed(found.change(k - 1, g) * kPercent, 3) : "–",
                      std::isfinite(order) ? fixed(order, 1) : "–"});
    }
  return html::table(
      "Largest root stress at rest at " + torque_words(b.torque) +
          ", with smaller elements on the roots, all else as it is. Order: p, if the error goes with the power p of the element size; none of changes below 0.02 %, which go with where the elements lie.",
      {"gear", "element on the driver's root (mm)", "root stress (MPa)", "change (%)", "order"}, rows);
}

}  // namespace

std::string budget_table(const ErrorBudgetResult& b) {
  html::Rows rows;
  const bool over_face = b.fidelity.width != WidthModel::one;
  const auto add = [&](const StaticChanges& changes, const std::string& what) {
    std::string rest = changes.entry;
    for (Index i = 0; i < changes.mean_stiffness_change.size(); ++i) {
      const size_t comma = rest.find(", ");
      // Without the sign of a change that rounds to 0.
      const auto percent = [](double share) {
        return fixed(std::abs(share * kPercent) < 5e-5 ? 0 : share * kPercent, 4);
      };
      rows.push_back({what, rest.substr(0, comma), percent(changes.mean_stiffness_change[i]),
                      percent(changes.peak_to_peak_change[i]), percent(changes.harmonic_change(i, 0))});
      const auto known = [&](const Eigen::VectorXd& change) {
        rows.back().push_back(i < change.size() ? percent(change[i]) : "–");
      };
      known(changes.pressure_change);
      known(over_face ? changes.load_factor_change : changes.root_stress_change);
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
  };
  add(b.refinement, "error");
  add(b.choice, "other model");
  return html::table("What each refinement alone changes in the statics at " + torque_words(b.torque) +
                         ". Another model is no error of this one and in no sum.",
                     {"", "change", "mean stiffness (%)", "peak to peak (%)", "harmonic 1 (%)",
                      "flank pressure (%)", over_face ? "K_Hβ (%)" : "root stress (%)"},
                     rows) +
         root_refinement_table(b) +
         (b.choice_missing.empty() ? "" : html::paragraph("Not computed: " + b.choice_missing + "."));
}

html::Rows speed_rows(const std::vector<ResponseResult>& sweeps) {
  if (sweeps.empty()) return {};
  const Eigen::VectorXd& f = sweeps.front().mesh_frequency;
  return {{"operation", "mesh_frequency_Hz",
           text(shown(f.minCoeff(), 6), " to ", shown(f.maxCoeff(), 6), ", ", f.size(), " speeds"),
           "speeds of a sweep"}};
}

std::string scene_table(const std::string& caption, const SceneKeys& keys, const html::Rows& more) {
  html::Rows rows;
  const auto add = [&](std::vector<std::string> row, const std::string& meaning) {
    row.resize(keys.gears.size() + 2);
    row.push_back(meaning);
    rows.push_back(std::move(row));
  };
  for (const SceneKeys::Row& key : keys.rows) {
    std::vector<std::string> row{key.section, key.name};
    row.insert(row.end(), key.value.begin(), key.value.end());
    add(std::move(row), key.meaning);
  }
  for (const std::vector<std::string>& row : more) add({row.begin(), row.end() - 1}, row.back());
  std::vector<std::string> head{"section", "key"};
  head.insert(head.end(), keys.gears.begin(), keys.gears.end());
  if (keys.gears.size() > 1) head[2] += ", or all";
  head.emplace_back("meaning");
  return html::table(caption, head, rows, "small");
}

std::string parameters_table(const ReportContent& c) {
  std::string torques;
  for (const auto& s : c.statics) torques += (torques.empty() ? "" : ", ") + shown(s.torque, 6);
  html::Rows more = speed_rows(c.sweeps);
  more.insert(more.begin(), {"operation", "torque_Nm", torques,
                             "torque on the driver; the first sets the bearing dampers"});
  return scene_table(
      "Every value of the scene that went into the results, defaults included, in the scene's units.",
      c.sweeps.empty() ? scene_keys_of(c.statics[0]) : scene_keys_of(c.sweeps[0]), more);
}

}  // namespace whine
