#include "report/system_report_guide.h"

#include <algorithm>
#include <vector>

#include "base/error.h"
#include "report/report_page.h"

namespace whine {
namespace {

// Errors are those of tests/accuracy.tsv; tests/report/test_report.cpp compares.
std::vector<GuideRow> rows_at_rest(bool planets) {
  std::vector<GuideRow> rows{
      {"system", "Positions, senses, phases",
       text("They follow from tooth numbers, centre distances and angles of the scene. The mesh phase ",
            "is the part of a mesh period by which a mesh is ahead of the first one: at equal phases ",
            "the meshes excite together, at others in turn."),
       "Exact. Compare picture and tables with your drawing first.",
       "If one is off, correct the scene: direction_deg of a [[mesh]], positions_deg of the [[carrier]]."},
      {"", "Contact ratio, backlash, diameters",
       "Geometry of the gears as drawn at the centre distances of the scene.", "All digits shown.",
       "addendum and dedendum, profile_shift, tooth_thinning_mm."},
      {"system-static", "Static transmission error of a mesh",
       text("The way by which the driving gear of the mesh runs ahead under load, along the line of ",
            "action, with the displacements of the bearings. The variation excites the whine; the mean ",
            "does not."),
       text(
           "Single pairs agree with other finite element programs within 0.1 % where contact is on the ",
           "line of action, within 0.4 % where tip edges come into contact, and within 0.6 % for an internal pair whose tip edges carry 14 % of the ",
           "load. A whole train has not been compared. Real flanks deviate by micrometres, and ",
           "housings and carriers are elastic."),
       "Tip relief ([gear.name.modification]); tooth numbers and planet positions whose phases cancel a harmonic."}};
  if (planets)
    rows.push_back(
        {"load-sharing", "Load sharing",
         text("The part of the load that each planet carries. Equal planets at equal spacing, or ",
              "opposite each other, have equal mean shares; over the mesh period shares vary where ",
              "phases differ."),
         text(
             "Of teeth as the scene has them, exact unless it gives errors. An error of a pin's position of a few ",
             "micrometres is as large as the deflection of a mesh (compare the mean STE) and then decides the ",
             "sharing; the model has no such errors."),
         "A floating central gear (soft [[bearing]]) equalises; ISO 6336-1 has the mesh load factor K_gamma."});
  rows.push_back(
      {"system-static", "Forces on bearings and pins",
       "The force of each body on its bearing or pin. The mean loads the bearing, the oscillating part acts on the housing.",
       "As good as the load sharing and the stiffness of the bearings that the scene gives.",
       planets ? text("N equal planets at equal spacing, z teeth of the central gear: harmonic l of its ",
                      "force is left only where (z l + 1) / N or (z l - 1) / N is whole, of its torque ",
                      "only where z l / N is whole.")
               : "The angle between the meshes of an idler turns its mesh forces against each other."});
  return rows;
}

const std::vector<GuideRow>& rows_of_modes_and_motion() {
  static const std::vector<GuideRow> rows{
      {"modes", "Natural frequencies, types",
       text("Of the bodies, rigid in themselves, on the mean stiffness of the meshes and on their ",
            "bearings. A rotational mode responds to torque variation, a translational one to forces on ",
            "central gears; planet modes leave central gears at rest."),
       text("As good as inertias, masses and bearings of the scene; 1 % of stiffness is 0.5 % of a ",
            "frequency. Shafts and the elastic modes of the bodies are left out."),
       "Check total_inertia_kgm2 of gears that carry a shaft; give all bearings."},
      {"campbell", "Campbell diagram",
       text("Mesh frequencies at which a harmonic meets a natural frequency. Bands: the natural ",
            "frequencies with the contact of each phase, by rank."),
       text("It shows where resonances are possible, not how strong they are: the harmonic may be weak, ",
            "or cancelled among planets."),
       "Look at the harmonics of the transmission error beside it."},
      {"system-sweep", "Vibration over speed",
       text("RMS of the oscillating transmission error of each mesh, speed rising and falling. Where ",
            "the two differ there are two motions, and the vibration jumps between them."),
       text("The height of a resonance goes with 1 over the damping, which the scene assumes; its ",
            "frequency is as good as stiffness and inertias. Contact is of lines. Unstable motions and ",
            "those that no sweep enters are left out."),
       "Measure the damping, or compute with half and twice of it. Finer: steps_per_period, element_mm."},
      {"system-sweep", "Contact loss, dynamic factor",
       text("Part of the time in which no pair of teeth of a mesh touches. Dynamic factor: largest mesh ",
            "force over the mean one at rest; with contact loss teeth meet again with impact."),
       text("The peak of an impact depends on the finest modes that are kept; the time without contact ",
            "hardly does. Back flanks do not touch in the model."),
       "Less excitation (relief, phases), more torque, other speeds."},
      {"system-sweep", "Forces on bearings and pins in motion",
       "The largest force, and the RMS of the oscillating part, over the speeds.",
       text("As the forces at rest, and the dampers of the bearings in the scene. Where a carrier turns, ",
            "remarks say how large centrifugal and Coriolis forces are, and whether they are in them."),
       "They are the input of a housing model; /bearing_force/name of sweep.h5 has their time histories."},
  };
  return rows;
}

}  // namespace

std::string system_guide(const SystemReport& r) {
  const bool planets = has_planets(layout_of(r));
  std::vector<GuideRow> all = rows_at_rest(planets), rows;
  all.insert(all.end(), rows_of_modes_and_motion().begin(), rows_of_modes_and_motion().end());
  for (const GuideRow& row : all) {
    const bool there = std::any_of(r.pictures.begin(), r.pictures.end(),
                                   [&](const ReportPicture& picture) { return row.figures == picture.name; });
    if (there || (row.figures.empty() && r.rest)) rows.push_back(row);
  }
  return guide_table(
      text("Frequencies are mesh frequencies unless said otherwise.",
           planets ? " All numbers are those in the frame of the carrier, which turns at its mean speed."
                   : ""),
      rows, r.pictures);
}

}  // namespace whine
