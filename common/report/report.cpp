#include "report/report.h"

#include <numbers>

#include "base/error.h"
#include "gear/pair.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/measured_errors.h"
#include "report/opening.h"
#include "report/report_figures.h"
#include "report/report_geometry.h"
#include "report/report_guide.h"
#include "report/report_opening.h"
#include "report/report_page.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "report/report_tables.h"

namespace whine {
namespace {

std::string introduction(const ReportContent& c) {
  const StaticResult& s = c.statics[0];
  const GearPair pair(s);
  const bool helical = s.gear[0].design.helical();
  std::vector<std::string> torques;
  for (const auto& a : c.statics) torques.push_back(shown(a.torque, 6));
  std::string out = text(
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
      ", working pressure angle ", fixed(pair.working_pressure_angle() * 180 / std::numbers::pi, 2),
      "°. Torque on the driver: ", listed(torques), " N m.");
  if (!c.sweeps.empty()) {
    const Eigen::VectorXd& f = c.sweeps[0].mesh_frequency;
    const double rpm = 60.0 / s.gear[0].design.teeth;
    out += text(" Speeds: ", hertz(f.minCoeff()), " to ", hertz(f.maxCoeff()), " Hz mesh frequency, ",
                fixed(f.minCoeff() * rpm, 0), " to ", fixed(f.maxCoeff() * rpm, 0), " rpm of the driver.");
  } else {
    out += " Without motion: only gears at rest are computed for such a scene.";
  }
  const std::string errors = words_on_errors(c);
  return html::paragraph(out) + (errors.empty() ? "" : html::paragraph(errors));
}

void require_whole(const ReportContent& c) {
  if (c.statics.empty())
    fail(Failure::input, "report: no static.h5 given; that of the scene's first torque is the least");
  require_one_pair(c);
  require_known_pictures(c.pictures, report_figures());
}

}  // namespace

std::string report_tsv(const ReportContent& c) {
  require_whole(c);
  std::string out = "# " + c.scene + "\ntorque [N m]\tquantity\tvalue\tunit\tremark\terror\n";
  for (const GeometryNumber& g : pair_geometry(c.statics[0]))
    out += text("\t", g.quantity, "\t", g.value, "\t", g.unit, "\t\t\n");
  const auto add = [&](const ReportNumber& r, const std::string& quantity, const std::string& unit,
                       const std::string& value, const std::string& error) {
    // A column that holds numbers alone is read as numbers: words stand in the remark.
    const bool words = value.find_first_not_of("+-.0123456789e") != std::string::npos;
    const std::string remark = text(words ? value : "", words && !r.remark.empty() ? "; " : "", r.remark);
    out += text(shown(r.torque, 6), "\t", quantity, "\t", words ? "" : value, "\t", unit, "\t", remark, "\t",
                error, "\n");
  };
  for (const ReportNumber& r : report_numbers(c)) {
    add(r, r.quantity, r.unit, r.value, r.error);
    if (!r.rpm.empty() && r.rpm != r.value)
      add(r, r.quantity + ", as rotation of the driver", "rpm", r.rpm, "");
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
  add("gears", "The gears", gears_table(c) + figures_of(c, "gears"));
  add("rest", "At rest", face_level(c) + stiffness_tables(c) + class_table(c) + figures_of(c, "rest"));
  add("frequencies", "Natural frequencies and damping",
      c.impacts.empty() ? "" : natural_frequencies_table(c));
  add("motion", "In motion", figures_of(c, "motion"));
  add("errors", "What the errors are", figures_of(c, "errors") + (c.budget ? budget_table(*c.budget) : ""));
  add("parameters", "Parameters", parameters_table(c));
  add("provenance", "Provenance", provenance_table(c.sources));

  return report_page(c.scene, opening_html(opening_lines(c), figures_of(c, "opening")), sections);
}

}  // namespace whine
