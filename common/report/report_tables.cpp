#include "report/report_tables.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "base/error.h"
#include "base/tool.h"
#include "base/units.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "io/scene_keys.h"
#include "io/summary.h"
#include "report/alike_meshes.h"
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

}  // namespace

namespace {

// A table for each [[mesh]], of one of the meshes that are alike, under its name where there are several.
std::string of_sections(const ReportContent& c, const std::function<std::string(size_t)>& table) {
  const std::vector<AlikeMeshes> sections = alike_meshes(c.statics[0]);
  std::string out;
  for (const AlikeMeshes& section : sections) {
    if (sections.size() > 1) out += html::tagged("h3", html::escaped(section.name)) + "\n";
    out += table(section.meshes.front());
  }
  return out;
}

std::string class_table_of(const ReportContent& c, size_t m) {
  constexpr int kFinest = 3, kCoarsest = 9;
  const GearPair pair(c.statics[0].mesh[m]);
  html::Rows rows;
  std::string why;
  for (int grade = kFinest; grade <= kCoarsest; ++grade) try {
      const double most = most_error_of_class(pair, grade);
      rows.push_back({text(grade), fixed(most * kMicro, 1)});
      for (const SystemStaticResult& at : c.statics)
        rows.back().push_back(fixed((peak_to_peak(at.mesh[m].transmission_error) + most) * kMicro, 1));
    } catch (const Error& error) {
      if (error.kind() != Failure::input) throw;
      why = error.what();
    }
  if (rows.empty()) return html::paragraph("No effect of a class of ISO 1328-1 is stated: " + why + ".");
  std::vector<std::string> head{"class", "adds at most (µm)"};
  for (const SystemStaticResult& at : c.statics)
    head.push_back(torque_words(torque_of(at)) + ": at most (µm)");
  return html::table(
      "What deviations within a class of ISO 1328-1:2013 add to the peak-to-peak transmission error of a mesh period, at most: a step of the single pitch tolerance of both gears for each pair that comes in, and their total profile deviations. Run-out and cumulative pitch are slower and left out; most gears of a class stay far below.",
      head, rows);
}

}  // namespace

std::string rest_tables(const ReportContent& c) {
  if (c.statics.empty()) return "";
  return of_sections(c, [&](size_t m) {
    const StaticResult& mesh = c.statics[0].mesh[m];
    std::string out;
    if (mesh.compliance.whole > 0)  // of a mesh that carries load
      for (const WordTable& t : {compliance_table(mesh), iso_table(mesh)})
        out += html::table(t.caption, t.head, t.rows);
    return out + class_table_of(c, m);
  });
}

std::string face_level(const ReportContent& c) {
  if (c.statics.empty() || c.of_train() || c.pair().face.none()) return "";
  const StaticResult& s = c.pair();
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

std::string modes_table(const ReportContent& c) {
  if (!c.modes) return "";
  const ModesResult& a = *c.modes;
  const TurningMember driver = driver_of(c);
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
  if (rows.empty()) return "";
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
  for (Index g = 0; g < b.root.stress.cols(); ++g)
    for (Index k = 0; k < b.root.stress.rows(); ++k) {
      const bool changes = k > 0;
      const double order = k > 1 ? resolved_order(found, k - 2, g) : std::numeric_limits<double>::quiet_NaN();
      rows.push_back({b.gear_names[static_cast<size_t>(g)], shown(b.root.element_size[k] * 1e3, 4),
                      fixed(b.root.stress(k, g) * 1e-6, 2),
                      changes ? fixed(found.change(k - 1, g) * kPercent, 3) : "–",
                      std::isfinite(order) ? fixed(order, 1) : "–"});
    }
  return html::table(
      "Largest root stress at rest at " + torque_words(b.torque) +
          ", with smaller elements on the roots, all else as it is. Order: p, if the error goes with the power p of the element size; none of changes below 0.02 %, which go with where the elements lie.",
      {"gear", "element on the first gear's root (mm)", "root stress (MPa)", "change (%)", "order"}, rows);
}

}  // namespace

std::string budget_table(const ErrorBudgetResult& b) {
  html::Rows rows;
  const bool over_face = b.fidelity.width != WidthModel::one,
             roots = !over_face || b.refinement.root_stress_change.size() > 0;
  std::vector<std::string> columns{
      "", "change", "mean stiffness (%)", "peak to peak (%)", "harmonic 1 (%)", "flank pressure (%)"};
  if (over_face) columns.emplace_back("K_Hβ (%)");
  if (roots) columns.emplace_back("root stress (%)");
  columns.emplace_back("order");
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
      if (over_face) known(changes.load_factor_change);
      if (roots) known(changes.root_stress_change);
      rows.back().push_back(i < changes.order.size() && changes.order[i] > 0 ? fixed(changes.order[i], 1)
                                                                             : "–");
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
  };
  add(b.refinement, "error");
  add(b.choice, "other model");
  return html::table(
             "What each refinement alone changes in the statics at " + torque_words(b.torque) +
                 ". With an order p the error is the change over 1 - 2^-p, else the change itself. Another model is no error of this one and in no sum.",
             columns, rows) +
         root_refinement_table(b) +
         (b.choice_missing.empty() ? "" : html::paragraph("Not computed: " + b.choice_missing + "."));
}

namespace {

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

}  // namespace

SceneKeys scene_keys_in(const ReportContent& c) {
  if (c.of_train()) return scene_keys_of(c.statics.at(0), c.sweeps.empty() ? nullptr : &c.sweeps.front());
  return c.sweeps.empty() ? scene_keys_of(c.pair()) : scene_keys_of(c.sweeps[0]);
}

std::string parameters_table(const ReportContent& c) {
  if (c.statics.empty()) return "";
  const char* const every =
      "Every value of the scene that went into the results, defaults included, in the scene's units";
  html::Rows more = speed_rows(c.sweeps);
  if (c.of_train())
    return scene_table(
        text(
            every,
            "; inertias and masses that the scene leaves out are those of the bodies. Torques and what is held: "
            "under Results."),
        scene_keys_in(c), more);
  std::string torques;
  for (const SystemStaticResult& s : c.statics)
    torques += (torques.empty() ? "" : ", ") + shown(torque_of(s), 6);
  more.insert(more.begin(), {"operation", "torque_Nm", torques,
                             "torque on the driver; the first sets the bearing dampers"});
  return scene_table(text(every, "."), scene_keys_in(c), more);
}

}  // namespace whine
