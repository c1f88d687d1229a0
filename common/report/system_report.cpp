#include "report/system_report.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "gear/layout.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/one_system.h"
#include "report/opening.h"
#include "report/report_page.h"
#include "report/system_motion_tables.h"
#include "report/system_opening.h"
#include "report/system_picture.h"
#include "report/system_report_guide.h"
#include "report/system_report_tables.h"

namespace whine {
namespace {

using Eigen::Index;

std::string of_picture(const SystemReport& r) {
  return r.rest
             ? "The gears at their places, unloaded at mesh phase 0, with the teeth of their drawings, and the teeth about a pitch point of each [[mesh]]. Check positions and senses of rotation against your drawing."
             : "The gears at their places by the working pitch circles of their meshes, with a tick at each tooth; rigid gears have no drawing. Check positions and senses of rotation against your drawing.";
}

std::string of_rest(const SystemReport& r) {
  if (!r.rest) return "";
  const SystemStaticResult& a = *r.rest;
  std::vector<std::string> parts;
  parts.reserve(a.mesh.size());
  for (size_t m = 0; m < a.mesh.size(); ++m)
    parts.push_back(text(significant(peak_to_peak(a.mesh[m].transmission_error) * kMicro, 3), " µm of ",
                         a.mesh_names[m]));
  constexpr size_t kMost = 4;
  const size_t all = parts.size();
  parts.resize(std::min(all, kMost));
  return text(
      "Transmission error of each mesh, its stiffness and force, the force on each bearing and pin, and the root stress of each gear over a mesh ",
      "period, and their harmonics. The transmission error from peak to peak is ", listed(parts),
      all > kMost ? text(" (", all - kMost, " more in the table above)") : "",
      "; its variation excites the whine, and the harmonics of the bearing forces act on the housing.",
      load_sharing(a).empty()
          ? ""
          : " In the torque and the force on a central gear, harmonics are missing that the planets cancel among them; each mesh by itself has them all.");
}

std::string of_sharing(const SystemReport& r) {
  if (!r.rest) return "";
  const std::vector<LoadSharing> sharing = load_sharing(*r.rest);
  std::vector<std::string> parts;
  parts.reserve(sharing.size());
  for (const LoadSharing& of : sharing) parts.push_back(text(fixed(of.factor, 3), " of ", of.name));
  return text(
      "Share of each planet's mesh in the load over the mesh period (left), and the loads of the tooth ",
      "pairs of the first one (right). The load sharing factor, the largest share times the number of ",
      "planets, is ", listed(parts), "; 1 is equal sharing.");
}

std::string of_modes(const SystemReport& r) {
  const ModesResult& a = *r.modes;
  Index lowest = 0;
  while (lowest < a.natural_frequency.size() && a.natural_frequency[lowest] == 0) ++lowest;
  return text("Natural frequencies by type, and the shapes of the modes, magnified; grey: at rest.",
              lowest < a.natural_frequency.size()
                  ? text(" The lowest is ", shown(a.natural_frequency[lowest], 6), " Hz (",
                         name_of(a.type[static_cast<size_t>(lowest)]), ").")
                  : "");
}

std::string of_campbell(const SystemReport&) {
  return "Natural frequencies and the harmonics of the mesh frequency. Where a ray meets a line that harmonic of the transmission error can excite that mode: keep operating speeds away from the points that matter.";
}

std::string of_sweep(const SystemReport& r) {
  return text(
      "RMS of the oscillating transmission error and time without contact of each mesh, and oscillating ",
      "force on each bearing and pin, over the mesh frequency; lines: speed rising, marks: falling. ",
      motion_words(r));
}

std::string of_orders(const SystemReport&) {
  return "Amplitudes of the first orders of the mesh frequency in the transmission error of each mesh, on a logarithmic axis: "
         "where an order peaks, that multiple of the mesh frequency meets a natural frequency.";
}

std::string of_residual(const SystemReport&) {
  return "Teeth that differ or are cracked: of the mesh in which it shows most, at that speed, the transmission error over the period after "
         "which the same teeth meet, and what it is less the mean of its mesh periods, the residual signal of gear diagnostics; orders, with "
         "sidebands beside those of the mesh; RMS and kurtosis of the residual signal over speed.";
}

// A figure of another stage is a row here, its words above, and its name in report_shows of pipelines/figures.mk.
const std::vector<ExplainedFigure<SystemReport>>& explained_system_figures() {
  static const std::vector<ExplainedFigure<SystemReport>> all{
      {"system", "opening", "The system", of_picture},
      {"system-static", "rest", "The system at rest", of_rest},
      {"load-sharing", "rest", "Load sharing among planets", of_sharing},
      {"modes", "modes", "Natural modes", of_modes},
      {"campbell", "modes", "Campbell diagram", of_campbell},
      {"system-sweep", "motion", "The system over its speeds", of_sweep},
      {"order-cuts", "motion", "Order cuts", of_orders},
      {"residual-signal", "motion", "Residual signal", of_residual},
  };
  return all;
}

std::string figures_in(const SystemReport& r, const std::string& section) {
  std::string out;
  for (const ExplainedFigure<SystemReport>& kind : explained_system_figures())
    for (const ReportPicture& picture : r.pictures)
      if (section == kind.section && picture.name == kind.name)
        out += picture_html(picture, kind.title, html::escaped(with_rpm(driving_member(r), kind.words(r))));
  return out;
}

std::string system_introduction(const SystemReport& r) {
  const System& s = layout_of(r);
  const Eigen::VectorXd torque =
      r.rest ? Eigen::VectorXd(r.rest->torque.colwise().mean().transpose()) : Eigen::VectorXd();
  std::string out = text("The train has ", s.bodies.size(), " bodies and ", s.meshes.size(),
                         " meshes. On the ground stand ", bodies_words(s, torque), ".");
  for (size_t c = 0; c < s.bodies.size(); ++c) {
    if (s.bodies[c].kind != System::BodyKind::carrier) continue;
    const auto planets = std::count_if(s.bodies.begin(), s.bodies.end(), [&](const System::Body& body) {
      return body.on == static_cast<int>(c);
    });
    out += text(" The ", s.bodies[c].name, " has ", planets, planets == 1 ? " planet." : " planets.");
  }
  if (!r.rest) {
    out += " The gears are rigid, with one spring for each mesh: natural modes alone are computed.";
    return html::paragraph(out);
  }
  if (r.rest->hunting_periods > 1) {
    std::string differ;
    for (size_t b = 0; b < s.bodies.size(); ++b)
      if (r.rest->settings.has_errors(b)) differ += text(differ.empty() ? "" : ", ", s.bodies[b].name);
    out += text(" Teeth differ (", differ, "): the same ones meet again after ", r.rest->hunting_periods,
                " mesh periods, over all of which loads and motions are computed.");
  }
  for (const LoadSharing& of : load_sharing(*r.rest))
    out += text(" The load sharing factor of ", of.name, " is ", fixed(of.factor, 3), ".");
  double most = 0;
  for (const StaticResult& mesh : r.rest->mesh) most = std::max(most, peak_to_peak(mesh.transmission_error));
  out +=
      text(" Static transmission errors are up to ", significant(most * kMicro, 3), " µm from peak to peak.");
  if (!r.sweeps.empty()) out += " " + motion_words(r);
  return html::paragraph(with_rpm(driving_member(r), out));
}

void require_sweeps(const SystemReport& r) {
  if (r.sweeps.empty()) return;
  if (!r.rest)
    fail(Failure::input, "report: response.h5 is given without the static.h5 of its scene; give it, too");
  for (size_t i = 0; i < r.sweeps.size(); ++i) {
    const ResponseResult& a = r.sweeps[i];
    const System& layout = a.train.layout;
    if (!one_system(layout, r.rest->settings.layout))
      fail(Failure::input,
           "report: response.h5 and static.h5 are of two systems; give artifacts of one scene");
    if (a.hunting_periods != r.rest->hunting_periods)
      fail(Failure::input, "report: the same teeth meet again after ", a.hunting_periods,
           " mesh periods in response.h5 and after ", r.rest->hunting_periods,
           " in static.h5; give artifacts of one scene");
    for (size_t j = 0; j < i; ++j)
      if (r.sweeps[j].direction == a.direction)
        fail(Failure::input, "report: two sweeps in the direction '", name_of(a.direction),
             "' are given; give one of each direction");
    for (size_t b = 0; b < layout.bodies.size(); ++b) {
      const double moving = a.drive[static_cast<Index>(b)],
                   resting = r.rest->torque.col(static_cast<Index>(b)).mean();
      if (layout.held(static_cast<int>(b)) || std::abs(moving - resting) <= 1e-9 * std::abs(resting))
        continue;
      fail(Failure::input, "report: the torque on '", layout.bodies[b].name, "' is ", moving,
           " N m in response.h5 and ", resting, " N m in static.h5; give artifacts of one scene");
    }
  }
}

}  // namespace

void require_whole_system(const SystemReport& r) {
  if (!r.modes)
    fail(Failure::input, "report: no modes.h5 given; the report of a system needs that of its scene");
  if (r.rest && !one_system(r.rest->settings.layout, r.modes->layout))
    fail(Failure::input, "report: static.h5 and modes.h5 are of two systems; give artifacts of one scene");
  require_sweeps(r);
  require_known_pictures(r.pictures, system_report_figures(), " of a system");
}

const System& layout_of(const SystemReport& r) {
  return r.rest ? r.rest->settings.layout : r.modes->layout;
}

bool has_planets(const System& system) {
  return std::any_of(system.bodies.begin(), system.bodies.end(),
                     [](const System::Body& body) { return body.on != System::kGround; });
}

std::vector<std::string> system_report_figures() {
  return names_of(explained_system_figures());
}

std::string system_report_tsv(const SystemReport& r) {
  require_whole_system(r);
  std::string out = "# " + r.scene + "\npart\tquantity\tvalue\tunit\tremark\n";
  for (const SystemNumber& n : system_numbers(r))
    out += text(n.part, "\t", n.quantity, "\t", n.value, "\t", n.unit, "\t", n.remark, "\n");
  return out;
}

std::string system_report_html(const SystemReport& r) {
  require_whole_system(r);
  std::vector<ReportSection> sections;
  const auto add = [&](const char* id, const char* heading, const std::string& inside) {
    if (!inside.empty()) sections.push_back({id, heading, inside});
  };
  add("results", "Results", system_introduction(r));
  add("remarks", "Warnings and remarks", system_remarks(r));
  add("guide", "What the numbers mean", system_guide(r));
  add("gears", "Gears and bodies", gear_tables(r));
  add("meshes", "Meshes", mesh_tables(r));
  add("rest", "At rest", force_table(r) + figures_in(r, "rest"));
  add("modes-of-system", "Natural modes", modes_table(r) + figures_in(r, "modes"));
  add("motion", "In motion", motion_tables(r) + figures_in(r, "motion"));
  add("parameters", "Parameters", settings_table(r));
  add("provenance", "Provenance", provenance_table(r.sources));
  return report_page(r.scene, opening_html(opening_lines(r), figures_in(r, "opening")), sections);
}

}  // namespace whine
