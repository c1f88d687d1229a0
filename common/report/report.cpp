#include "report/report.h"

#include <algorithm>
#include <numbers>

#include "base/error.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/measured_errors.h"
#include "report/opening.h"
#include "report/report_figures.h"
#include "report/report_gears.h"
#include "report/report_guide.h"
#include "report/report_opening.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "report/report_tables.h"
#include "report/system_picture.h"

namespace whine {
namespace {

using Eigen::Index;

std::string words_on_pair(const StaticResult& s) {
  const GearPair pair(s);
  const bool helical = s.gear[0].design.helical();
  return text(
      s.mesh.gear[0], " (", s.gear[0].design.teeth, " teeth) drives ", s.mesh.gear[1], " (",
      s.gear[1].design.teeth, " teeth), ", helical ? "normal " : "", "module ",
      shown(s.gear[0].design.module * kMilli, 4), " mm, ",
      helical ? text("helix angle ", fixed(s.gear[0].design.helix_angle * 180 / std::numbers::pi, 2), "°, ")
              : "",
      "at a centre distance of ", shown(pair.centre_distance() * kMilli, 7), " mm: ",
      helical ? text("transverse contact ratio ", fixed(s.contact_ratio, 3), ", overlap ratio ",
                     fixed(pair.overlap_ratio(), 3), ", in all ",
                     fixed(s.contact_ratio + pair.overlap_ratio(), 3))
              : "contact ratio " + fixed(s.contact_ratio, 3),
      ", working pressure angle ", fixed(pair.working_pressure_angle() * 180 / std::numbers::pi, 2), "°.");
}

std::string words_on_train(const ReportContent& c) {
  const System s = layout_of(c);
  const Eigen::VectorXd torque = c.statics.empty()
                                     ? Eigen::VectorXd()
                                     : Eigen::VectorXd(c.statics[0].torque.colwise().mean().transpose());
  std::string out = text("The train has ", s.bodies.size(), " bodies and ", s.meshes.size(),
                         " meshes. On the ground stand ", bodies_words(s, torque), ".");
  for (size_t k = 0; k < s.bodies.size(); ++k) {
    if (s.bodies[k].kind != System::BodyKind::carrier) continue;
    const auto planets = std::count_if(s.bodies.begin(), s.bodies.end(), [&](const System::Body& body) {
      return body.on == static_cast<int>(k);
    });
    out += text(" The ", s.bodies[k].name, " has ", planets, planets == 1 ? " planet." : " planets.");
  }
  return out;
}

// Which teeth differ, how planets share the load, how large transmission errors are.
std::string words_at_rest(const SystemStaticResult& rest) {
  std::string out, differ;
  const System& s = rest.settings.layout;
  for (size_t b = 0; b < s.bodies.size(); ++b)
    if (rest.settings.has_errors(b)) differ += text(differ.empty() ? "" : ", ", s.bodies[b].name);
  if (rest.hunting_periods > 1)
    out +=
        text(" Teeth differ", differ.empty() ? "" : " (" + differ + ")", ": the same ones meet again after ",
             rest.hunting_periods, " mesh periods, over all of which loads and motions are computed.");
  for (const LoadSharing& of : load_sharing(rest))
    out += text(" The load sharing factor of ", of.name, " is ", fixed(of.factor, 3), ".");
  double most = 0;
  for (const StaticResult& mesh : rest.mesh) most = std::max(most, peak_to_peak(mesh.transmission_error));
  return out + text(" Static transmission errors are up to ", significant(most * kMicro, 3),
                    " µm from peak to peak.");
}

std::string introduction(const ReportContent& c) {
  std::string out = c.of_train() ? words_on_train(c) : words_on_pair(c.pair());
  const TurningMember driver = driver_of(c);
  if (c.statics.empty())
    return html::paragraph(
        out + " The gears are rigid, with one spring for each mesh: natural modes alone are computed.");
  std::vector<std::string> torques;
  torques.reserve(c.statics.size());
  for (const SystemStaticResult& a : c.statics) torques.push_back(shown(torque_of(a), 6));
  out += text(" Torque on ", driver.name, ": ", listed(torques), " N m.") + words_at_rest(c.statics[0]);
  if (!c.sweeps.empty()) {
    const Eigen::VectorXd& f = c.sweeps[0].mesh_frequency;
    out += text(" Speeds: ", hertz(f.minCoeff()), " to ", hertz(f.maxCoeff()), " Hz mesh frequency",
                driver.turns > 0 ? text(", ", fixed(driver.rpm(f.minCoeff()), 0), " to ",
                                        fixed(driver.rpm(f.maxCoeff()), 0), " rpm of ", driver.name)
                                 : "",
                ". ") +
           with_rpm(driver, motion_words(c));
  } else {
    out +=
        c.statics[0].mesh[0].fidelity.width == WidthModel::body
            ? " Without motion: bodies in three dimensions over the face are computed at rest. Write width = \"slices\" in [fidelity] for natural frequencies, vibration and loss of contact."
            : " Without motion: [operation] of the scene gives no mesh_frequency_Hz.";
  }
  const std::string errors = words_on_errors(c);
  return html::paragraph(out) + (errors.empty() ? "" : html::paragraph(errors));
}

void require_whole(const ReportContent& c) {
  require_one_scene(c);
  require_known_pictures(c.pictures, report_figures());
}

}  // namespace

std::string report_tsv(const ReportContent& c) {
  require_whole(c);
  std::string out = "# " + c.scene + "\ntorque [N m]\tpart\tquantity\tvalue\tunit\tremark\terror\n";
  const auto line = [&](double torque, const std::string& part, const std::string& quantity,
                        const std::string& unit, const std::string& value, const std::string& said,
                        const std::string& error) {
    // A column that holds numbers alone is read as numbers: words stand in the remark.
    const bool words = value.find_first_not_of("+-.0123456789e") != std::string::npos;
    const std::string remark = text(words ? value : "", words && !said.empty() ? "; " : "", said);
    out += text(torque == 0 ? "" : shown(torque, 6), "\t", part, "\t", quantity, "\t", words ? "" : value,
                "\t", unit, "\t", remark, "\t", error, "\n");
  };
  if (!c.statics.empty())
    for (const GeometryNumber& g : geometry_numbers(c)) line(0, g.part, g.quantity, g.unit, g.value, "", "");
  for (const ReportNumber& r : report_numbers(c)) {
    line(r.torque, r.part, r.quantity, r.unit, r.value, r.remark, r.error);
    if (!r.rpm.empty() && r.rpm != r.value)
      line(r.torque, r.part,
           r.quantity + ", as rotation of " + (c.of_train() ? driver_of(c).name : "the driver"), "rpm", r.rpm,
           r.remark, "");
  }
  return out;
}

std::string report_html(const ReportContent& c) {
  require_whole(c);
  std::vector<ReportSection> sections;
  const auto add = [&](const char* id, const char* heading, const std::string& inside) {
    if (!inside.empty()) sections.push_back({id, heading, inside});
  };
  add("results", "Results", introduction(c) + results_tables(c));
  add("remarks", "Warnings and remarks", remarks_list(c));
  add("guide", "What the numbers mean", guide_to_numbers(c));
  add("gears", "The gears", bodies_table(c) + drawings_table(c) + figures_of(c, "gears"));
  add("meshes", "The meshes", meshes_table(c));
  add("rest", "At rest", face_level(c) + rest_tables(c) + figures_of(c, "rest"));
  add("frequencies", "Natural frequencies and damping", natural_frequencies_table(c));
  add("modes-of-system", "Natural modes", modes_table(c) + figures_of(c, "modes"));
  add("motion", "In motion", figures_of(c, "motion"));
  add("errors", "What the errors are", figures_of(c, "errors") + (c.budget ? budget_table(*c.budget) : ""));
  add("parameters", "Parameters", parameters_table(c));
  add("provenance", "Provenance", provenance_table(c.sources));
  return report_page(c.scene, opening_html(opening_lines(c), figures_of(c, "opening")), sections);
}

}  // namespace whine
