#include "io/body_codec.h"

#include "base/error.h"
#include "io/codec.h"
#include "io/vtk.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kBodySchema{"body", 5};

void describe_compliance(Codec& c, ReducedBody& a) {
  const std::string at = "/compliance/";
  c.dataset({at + "offsets", "1", "largest tooth offset of the tables", "", {0, 1000}}, &a.offsets);
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
    c.dataset({at + "offset_" + number, "m N-1",
               text("inward normal displacement of the tooth ", number,
                    " counter-clockwise of the loaded one per unit normal force",
                    d == 0 && !c.lists() ? ", less the half-plane relative to reference_depth" : ""),
               "flank_position loaded_position", kFlexibility},
              &a.compliance[d]);
  }
  const int teeth = a.design.teeth, half = teeth / 2;
  if (c.in() && 2 * a.offsets > teeth)
    c.in()->file().reject(
        text("holds tables of ", a.offsets, " tooth offsets of a gear of ", teeth, " teeth"));
  c.axis("far_position", (half - a.offsets) * points);
  if (c.lists() || half > a.offsets)
    c.dataset({at + "far", "m N-1",
               "as offset_<d>, of the teeth from `offsets` + 1 to half of all, one below the other",
               "far_position loaded_position", kFlexibility},
              &a.far_compliance);
  c.axis("back_position", teeth * points);
  c.dataset(
      {at + "back", "m N-1",
       "inward normal displacement of the other flank of all teeth counter-clockwise from the loaded one on, per unit normal force",
       "back_position loaded_position", kFlexibility},
      &a.back_compliance);
  if (c.lists() || (c.in() ? a.design.crack.depth > 0 : a.crack_compliance.size() > 0))
    c.dataset(
        {at + "crack", "m N-1",
         "what the crack adds between the teeth from `offsets` clockwise of the cracked one to `offsets` counter-clockwise of it, tooth by tooth",
         "tooth_flank_position loaded_tooth_flank_position", kFlexibility},
        &a.crack_compliance);
  c.dataset({at + "reference_depth", "m", "depth relative to which the half-plane is taken off", "", kSize},
            &a.reference_depth);
  c.dataset({at + "asymmetry", "1", "relative asymmetry of the tables before symmetrisation", "", kShare},
            &a.asymmetry);
  c.dataset({at + "least_eigenvalue", "m N-1",
             "least eigenvalue of the compliance of all offsets less the stored modes", "", kFlexibility},
            &a.least_eigenvalue);
}

void describe_root_stress(Codec& c, ReducedBody& a) {
  const std::string at = "/root_stress/";
  c.dataset(
      {at + "arc_length", "m", "arc length from the flank along the root curve", "root_position", kSize},
      &a.root_arc_length);
  c.dataset({at + "angle", "1", "angle (rad) between the root's tangent and the centre line of the tooth",
             "root_position", kRoll},
            &a.root_angle);
  c.axis("both_root_position", 2 * a.root_arc_length.size());
  c.axis("root_offset", 2 * a.offsets + 1);
  c.dataset(
      {at + "per_force", "Pa N-1",
       "tangential stress along the driving flank's root, then the other one, per unit normal force; of the teeth from `offsets` clockwise of the loaded one to `offsets` counter-clockwise of it",
       "root_offset both_root_position loaded_position", kStressPerForce},
      &a.root_stress);
  if (c.lists() || (c.in() ? a.design.crack.depth > 0 : a.crack_root_stress.size() > 0)) {
    c.axis("tooth_root_position", (2 * a.offsets + 1) * a.root_arc_length.size());
    c.dataset(
        {at + "crack", "Pa N-1",
         "what the crack adds along the driving flank's root, between the teeth of /compliance/crack, tooth by tooth",
         "tooth_root_position loaded_tooth_flank_position", kStressPerForce},
        &a.crack_root_stress);
  }
}

}  // namespace

void describe(Codec& c, ReducedBody& a) {
  describe_design(c, "gear", a.design);
  SceneParameters values;
  values.material = a.material;
  values.body = a.discretisation;
  c.parameters("material", values, KeyGroup::material);
  for (const KeyGroup part : {KeyGroup::body, KeyGroup::near_field})
    c.parameters("discretisation", values, part);
  if (c.in()) {
    a.material = values.material;
    a.discretisation = values.body;
  }
  c.dataset({"/inertia", "kg m2", "inertia of the meshed body about its axis, hub ring included", "", kMass},
            &a.inertia);
  c.dataset({"/mass", "kg", "mass of the meshed body, hub ring included", "", kMass}, &a.mass);
  c.dataset({"/eigenfrequency", "Hz", "natural frequencies with the hub fixed", "mode", kFrequency,
             "K_ff phi = w^2 M_ff phi"},
            &a.eigenfrequency);
  c.dataset({"/nodal_diameter", "1", "nodal diameters of the mode", "mode", kTooth}, &a.nodal_diameter);
  c.dataset({"/component", "1", "0: cosine or single, 1: sine of a doublet", "mode", kFlag}, &a.component);
  // UDUNITS knows whole exponents only; mass-normal modes need a half.
  c.dataset({"/inertia_coupling", "kg^0.5 m", "coupling of the mode to the rotation of the hub", "mode",
             kMode, "gamma = phi^T M_fr (Eq. 3)"},
            &a.inertia_coupling);
  c.dataset({"/translation_coupling", "kg^0.5",
             "coupling of the mode to translations of the hub along x and y; tooth 0 points along +y",
             "mode xy", kMode, "phi^T M_fr (Eq. 3)"},
            &a.translation_coupling);
  c.dataset({"/flank_position", "1", "roll angle (rad) of the points of the flank table, ascending",
             "flank_position", kRoll},
            &a.flank_position);
  c.dataset({"/flank_mode", "kg^-0.5",
             "outward normal displacement of the mass-normal modes on the flank of tooth 0",
             "flank_position mode", kMode},
            &a.flank_mode);
  c.dataset({"/back_flank_mode", "kg^-0.5", "flank_mode of the other flank of tooth 0", "flank_position mode",
             kMode},
            &a.back_flank_mode);
  describe_compliance(c, a);
  describe_root_stress(c, a);
  if (c.out() && a.vtk_point.rows() > 0)
    put_vtk(c.out()->file(), {a.vtk_point, a.vtk_cell, a.vtk_point_data, {}, {}, {}, {}, false});
}

void write(const std::string& path, const ReducedBody& a, const Provenance& provenance) {
  write_artifact(path, kBodySchema, "Reduced body of a gear on a rigid hub: " + gear_title(a.design), a,
                 provenance);
  link_for_paraview(path);
}

ReducedBody read_body(const std::string& path) {
  return read_artifact<ReducedBody>(path, kBodySchema);
}

}  // namespace whine
