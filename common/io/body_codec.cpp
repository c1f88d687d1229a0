#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

void describe_compliance(Codec& c, ReducedBody& a) {
  const std::string at = "/compliance/";
  c(a.offsets, at + "offsets", "1", {0, 1000}, "", "largest tooth offset of the tables");
  const Eigen::Index points = a.flank_position.size();
  c.axis("loaded_position", points);
  for (const char* axis : {"tooth_flank_position", "loaded_tooth_flank_position"})
    c.axis(axis, (2 * a.offsets + 1) * points);
  const auto tables = static_cast<std::size_t>(a.offsets) + 1;
  if (c.out() && a.compliance.size() != tables)
    fail(Failure::numerical, "result compliance has ", a.compliance.size(), " rows, expected ", tables);
  if (!c.out()) a.compliance.resize(tables);
  for (std::size_t d = 0; d < tables; ++d) {
    const std::string number = c.lists() ? "<d>" : text(d);
    c(a.compliance[d], at + "offset_" + number, "m N-1", kFlexibility, "flank_position loaded_position",
      text("inward normal displacement of the tooth ", number,
           " counter-clockwise of the loaded one per unit normal force",
           d == 0 && !c.lists() ? ", less the half-plane relative to reference_depth" : ""));
  }
  const int teeth = a.design.teeth, half = teeth / 2;
  if (c.in() && 2 * a.offsets > teeth)
    c.in()->reject(text("holds tables of ", a.offsets, " tooth offsets of a gear of ", teeth, " teeth"));
  c.axis("far_position", (half - a.offsets) * points);
  if (c.lists() || half > a.offsets)
    c(a.far_compliance, at + "far", "m N-1", kFlexibility, "far_position loaded_position",
      "as offset_<d>, of the teeth from `offsets` + 1 to half of all, one below the other");
  c.axis("back_position", teeth * points);
  c(a.back_compliance, at + "back", "m N-1", kFlexibility, "back_position loaded_position",
    "inward normal displacement of the other flank of all teeth counter-clockwise from the loaded one on, per unit normal force");
  if (c.lists() || (c.in() ? a.design.crack.depth > 0 : a.crack_compliance.size() > 0))
    c(a.crack_compliance, at + "crack", "m N-1", kFlexibility,
      "tooth_flank_position loaded_tooth_flank_position",
      "what the crack adds between the teeth from `offsets` clockwise of the cracked one to `offsets` counter-clockwise of it, tooth by tooth");
  c(a.reference_depth, at + "reference_depth", "m", kSize, "",
    "depth relative to which the half-plane is taken off");
  c(a.asymmetry, at + "asymmetry", "1", kShare, "", "relative asymmetry of the tables before symmetrisation");
  c(a.least_eigenvalue, at + "least_eigenvalue", "m N-1", kFlexibility, "",
    "least eigenvalue of the compliance of all offsets less the stored modes");
}

void describe_root_stress(Codec& c, ReducedBody& a) {
  const std::string at = "/root_stress/";
  c(a.root_arc_length, at + "arc_length", "m", kSize, "root_position",
    "arc length from the flank along the root curve");
  c(a.root_angle, at + "angle", "1", kRoll, "root_position",
    "angle (rad) between the root's tangent and the centre line of the tooth");
  c.axis("both_root_position", 2 * a.root_arc_length.size());
  c.axis("root_offset", 2 * a.offsets + 1);
  c(a.root_stress, at + "per_force", "Pa N-1", kStressPerForce,
    "root_offset both_root_position loaded_position",
    "tangential stress along the driving flank's root, then the other one, per unit normal force; of the teeth from `offsets` clockwise of the loaded one to `offsets` counter-clockwise of it");
  if (c.lists() || (c.in() ? a.design.crack.depth > 0 : a.crack_root_stress.size() > 0)) {
    c.axis("tooth_root_position", (2 * a.offsets + 1) * a.root_arc_length.size());
    c(a.crack_root_stress, at + "crack", "Pa N-1", kStressPerForce,
      "tooth_root_position loaded_tooth_flank_position",
      "what the crack adds along the driving flank's root, between the teeth of /compliance/crack, tooth by tooth");
  }
}

void describe_width(Codec& c, ReducedBody& a) {
  WidthDiscretisation& settings = a.discretisation.width;
  KeyList list;
  list.append_group(keys(settings), settings.acts(), "width");
  c.parameters("width", list);
  if (!c.lists() && !settings.acts()) return;
  WidthTables& w = a.width;
  const Eigen::Index points = a.flank_position.size(), all = settings.degree + 1;
  if (!c.out()) {
    w.degree = settings.degree;
    w.face_width = a.design.face_width;
    w.flank_position = a.flank_position;
  }
  c(w.helix, "/width/helix", "m-1", kSigned, "",
    "turn (rad) of the section per length along the axis, of a right-hand gear above 0");
  for (const char* axis : {"width_position", "loaded_width_position"}) c.axis(axis, points * all);
  const auto stations = static_cast<Eigen::Index>(a.root_angle.size());
  c.axis("root_width_position", stations * all);
  c(w.root_stress, "/width/root_stress", "Pa m N-1", kStressPerForce,
    "root_offset root_width_position loaded_width_position",
    "stress across the helix along the driving flank's root per normal force on a unit of face width, between Legendre polynomials over the width; of the teeth of /root_stress/per_force");
  c(w.flexibility, "/width/flexibility", "m2 N-1", kFlexibility,
    "width_offset width_position loaded_width_position",
    "inward normal displacement per normal force on a unit of face width, between Legendre polynomials over the width at the points of the flank table, of the teeth from the loaded one on counter-clockwise; of the loaded tooth less the plane flexibility");
}

}  // namespace

void describe(Codec& c, ReducedBody& a) {
  describe_design(c, "gear", a.design);
  c.parameters("material", keys(a.material));
  c.parameters("discretisation", keys(a.discretisation).all());
  c(a.inertia, "/inertia", "kg m2", kMass, "",
    "inertia of the meshed body about its axis, hub ring included");
  c(a.mass, "/mass", "kg", kMass, "", "mass of the meshed body, hub ring included");
  c(a.eigenfrequency, "/eigenfrequency", "Hz", kFrequency, "mode", "natural frequencies with the hub fixed",
    "K_ff phi = w^2 M_ff phi");
  c(a.nodal_diameter, "/nodal_diameter", "1", kTooth, "mode", "nodal diameters of the mode");
  c(a.component, "/component", "1", kFlag, "mode", "0: cosine or single, 1: sine of a doublet");
  // UDUNITS knows whole exponents only; mass-normal modes need a half.
  c(a.inertia_coupling, "/inertia_coupling", "kg^0.5 m", kMode, "mode",
    "coupling of the mode to the rotation of the hub", "gamma = phi^T M_fr (Eq. 3)");
  c(a.translation_coupling, "/translation_coupling", "kg^0.5", kMode, "mode xy",
    "coupling of the mode to translations of the hub along x and y; tooth 0 points along +y",
    "phi^T M_fr (Eq. 3)");
  c(a.flank_position, "/flank_position", "1", kRoll, "flank_position",
    "roll angle (rad) of the points of the flank table, ascending");
  c(a.flank_mode, "/flank_mode", "kg^-0.5", kMode, "flank_position mode",
    "outward normal displacement of the mass-normal modes on the flank of tooth 0");
  c(a.back_flank_mode, "/back_flank_mode", "kg^-0.5", kMode, "flank_position mode",
    "flank_mode of the other flank of tooth 0");
  describe_compliance(c, a);
  describe_root_stress(c, a);
  describe_width(c, a);
  c.picture({a.vtk_point, a.vtk_cell, a.vtk_point_data, {}, {}, {}, {}, false});
}

std::string title(const ReducedBody& a) {
  return "Reduced body of a gear on a rigid hub: " + gear_title(a.design);
}

template struct ArtifactFile<ReducedBody>;

}  // namespace whine
