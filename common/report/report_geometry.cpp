#include "report/report_geometry.h"

#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "report/figures.h"
#include "results/static.h"

namespace whine {

std::vector<GeometryNumber> pair_geometry(const StaticResult& s) {
  const GearPair pair(s);
  std::vector<GeometryNumber> out;
  const auto add = [&](const std::string& quantity, const std::string& unit, const std::string& value) {
    out.push_back({quantity, unit, value});
  };
  const auto degrees = [](double rad) { return fixed(rad * 180 / std::numbers::pi, 4); };
  const auto millimetres = [](double m) { return fixed(std::abs(m) < 1e-9 ? 0.0 : m * kMilli, 4); };
  const bool helical = pair.base_helix_angle() != 0;
  add(helical ? "transverse contact ratio" : "contact ratio", "1", fixed(pair.contact_ratio(), 4));
  if (helical) {
    add("overlap ratio", "1", fixed(pair.overlap_ratio(), 4));
    add("helix angle at the reference circle", "deg", degrees(s.gear[0].design.helix_angle));
    add("base helix angle", "deg", degrees(std::abs(pair.base_helix_angle())));
  }
  add("centre distance", "mm", millimetres(pair.centre_distance()));
  add("working pressure angle", "deg", degrees(pair.working_pressure_angle()));
  add("base pitch", "mm", millimetres(pair.base_pitch()));
  add("path of contact, length", "mm", millimetres(pair.path_end() - pair.path_start()));
  add("path of contact before the pitch point", "mm", millimetres(-pair.path_start()));
  add("normal backlash, along the line of action", "mm", millimetres(normal_backlash(pair)));
  add("circumferential backlash", "mm", millimetres(circumferential_backlash(pair)));
  const auto points = path_points(pair);
  for (int g = 0; g < kSides; ++g) {
    const ToothGeometry& gear = pair.gear(g);
    const std::string of = text(", ", s.mesh.gear[g], " (", kRole[g], ")");
    const auto at = [&](int p) { return millimetres(points[static_cast<size_t>(p)].diameter[g]); };
    add("teeth" + of, "1", std::to_string(gear.design().teeth));
    add("base diameter" + of, "mm", millimetres(2 * gear.base_radius()));
    add("reference diameter" + of, "mm", millimetres(2 * gear.pitch_radius()));
    add("working pitch diameter" + of, "mm", at(2));
    add("tip diameter" + of, "mm", millimetres(2 * gear.tip_radius()));
    add("root diameter" + of, "mm", millimetres(2 * gear.root_radius()));
    add("SAP diameter, where the active profile starts" + of, "mm", at(g == 0 ? 0 : 4));
    if (!helical) {
      add("diameter d_B" + of, "mm", at(1));
      add("diameter d_D" + of, "mm", at(3));
    }
    add("form diameter, where the involute begins" + of, "mm",
        millimetres(2 * std::hypot(1.0, gear.form_roll_angle()) * gear.base_radius()));
    if (gear.undercut() > 0) {
      add("undercut: how far the rack reaches beyond the base circle's tangent point" + of, "mm",
          millimetres(gear.undercut()));
      add("path of contact lost to undercut" + of, "mm", millimetres(pair.path_lost(g)));
    }
    add("tooth thickness at the tip" + of, "mm", millimetres(gear.thickness_at_radius(gear.tip_radius())));
    add("tooth thickness at the reference circle" + of, "mm", millimetres(reference_thickness(gear)));
    if (const std::optional<Span> span = span_measurement(gear)) {
      add("teeth in the span" + of, "1", std::to_string(span->teeth));
      add("span over these teeth" + of, "mm", millimetres(span->length));
    }
    add("tip clearance" + of, "mm", millimetres(tip_clearance_to_root(pair, g)));
    add("root clearance" + of, "mm", millimetres(tip_clearance_to_root(pair, 1 - g)));
    for (const auto& [what, at_point] :
         {std::pair{"where a pair comes into contact", 0}, std::pair{"where it leaves", 4}})
      if (const auto sliding =
              specific_sliding(pair, points[static_cast<size_t>(at_point)].path)[static_cast<size_t>(g)])
        add(text("specific sliding ", what, of), "1", fixed(*sliding, 4));
  }
  return out;
}

}  // namespace whine
