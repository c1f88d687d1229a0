#include "report/report_guide.h"

#include <algorithm>
#include <string>

#include "base/error.h"
#include "report/figures.h"

namespace whine {
namespace {

// What is needed for a row to stand on the page.
enum class Needs {
  figure,
  train,
  rest,
  planets,
  modes,
  ring_down,
  motion,
  one_slice,
  face,
  face_in_motion,
  budget
};

struct GuideRow {
  Needs needs;
  const char* figures;  // names of those that it is about, blank between
  const char* what;
  const char* reading;
  const char* trust;
  const char* next;
};

// Errors are those of tests/accuracy.tsv; tests/report/test_report.cpp compares.
constexpr GuideRow kRows[] =
    {
        {Needs::train, "system", "Positions, senses, phases",
         "They follow from tooth numbers, centre distances and angles of the scene. The mesh phase is the part of a mesh period by which a mesh is ahead of the first one: at equal phases the meshes excite together, at others in turn.",
         "Exact. Compare picture and tables with your drawing first.",
         "If one is off, correct the scene: direction_deg of a [[mesh]], positions_deg of the [[carrier]]."},
        {Needs::rest, "", "Contact ratio, diameters, angles",
         "Geometry of the gears as drawn: exact involutes at the given centre distance. SAP is where the active profile starts; between the diameters at B and D one pair alone is in contact.",
         "All digits shown. Compare them with your drawing first: a wrong one shows here.",
         "If one is off, correct the scene: addendum and dedendum, or tip_diameter_mm and root_diameter_mm."},
        {Needs::rest, "transmission-error error-budget system-static",
         "Static transmission error (mean, peak to peak, harmonics)",
         "How far the driving gear of a mesh runs ahead under load, along the line of action, with the displacements of bearings. The mean is no noise. The variation is what excites the whine; harmonic 1 sounds at the mesh frequency, harmonic 2 at twice it.",
         "0.1 % against other finite element codes for the same drawing, 0.4 % where tip edges come into contact, 0.6 % for an internal pair whose tip edges carry 14 % of the load. A whole train has not been compared: its housing and carriers are elastic. Real flanks deviate by micrometres, and those add to it: trust comparisons of designs more than the level of one.",
         "Tip relief (harris-map says how much at which torque), other torques, errors of manufacture ([gear.name.error]); in a train tooth numbers and planet positions whose phases cancel a harmonic."},
        {Needs::rest, "mesh-stiffness", "Mesh stiffness",
         "Load over what it adds to the transmission error. It falls where fewer pairs carry. Per face width it compares with c-gamma of ISO 6336-1.",
         "0.1 % for the drawing; ISO's formula is a fit for solid discs: it stands above where bodies twist about a bore, and may stand below under less than 100 N/mm, where ISO lowers its value. Compare it with the column of bodies that do not twist; the table of compliances says how much is of the body.",
         "If it is far below ISO's, look at bore_radius_mm: inside it the gear is rigid."},
        {Needs::rest, "load-sharing", "Load sharing, static tooth load",
         "The part of the load that each pair carries. Load beyond the grey lines is carried by tip edges of bent teeth.",
         "0.1 to 0.2 %, tip edges included.", "Load at a tip edge: relieve the tips."},
        {Needs::planets, "load-sharing", "Load sharing among planets",
         "The part of the load that each planet carries. Equal planets at equal spacing, or opposite each other, have equal mean shares; over the mesh period shares vary where phases differ.",
         "Of teeth as the scene has them, exact unless it gives errors. An error of a pin's position of a few micrometres is as large as the deflection of a mesh (compare the mean STE) and then decides the sharing; the model has no such errors.",
         "A floating central gear (soft [[bearing]]) equalises; ISO 6336-1 has the mesh load factor K_gamma."},
        {Needs::modes, "modes", "Natural frequencies, types",
         "Of the bodies, rigid in themselves, on the mean stiffness of the meshes and on their bearings. A rotational mode responds to torque variation, a translational one to forces on central gears; planet modes leave central gears at rest.",
         "As good as inertias, masses and bearings of the scene; 1 % of stiffness is 0.5 % of a frequency. Shafts and the elastic modes of the bodies are left out.",
         "Check total_inertia_kgm2 of gears that carry a shaft; give all bearings."},
        {Needs::modes, "campbell", "Campbell diagram",
         "Mesh frequencies at which a harmonic meets a natural frequency. Bands: the natural frequencies with the contact of each phase, by rank.",
         "It shows where resonances are possible, not how strong they are: the harmonic may be weak, or cancelled among planets.",
         "Look at the harmonics of the transmission error beside it."},
        {Needs::face, "flank-load", "Load over the face, K_Hβ at rest",
         "Line load over face and path, as a contact pattern. K_Hβ is the largest over the mean line load of the reference pair at the pitch point; ISO 6336-1 has it of the whole mesh.",
         "Of bodies in three dimensions 2 % of finite elements away from the ends of the face; of slices K_Hβ - 1 is half to two thirds of that. Shafts and bearings are rigid: give misalignment_um.",
         "Lead crowning or end relief lower the ends; a lead slope takes up a misalignment."},
        {Needs::face_in_motion, "face-load", "K_Hβ in motion",
         "The same of the tooth pair with the largest load at the instant of that load, with speed rising and falling.",
         "Slices, as at rest: compare it with K_Hβ of slices at rest. The load itself is as good as the vibration.",
         "A factor that grows near a resonance goes with less load on a part of the face: look at the contact lost there."},
        {Needs::rest, "contact-zone", "Static contact pressure",
         "Largest pressure on a strip of the contact, inside a flank.",
         "2 % of Hertz's with 8 strips, 0.6 % with 15. At the kink of a linear relief and at tip edges it grows with the number of strips: there it is a warning, not a number.",
         "Set strips = 15 and then 32 and see whether it stays; make reliefs parabolic."},
        {Needs::ring_down, "ring-down", "Natural frequency and damping ratio by ring-down",
         "The gears are at a fixed mesh phase, let go from a part of the torque, in a train moved along each mode, and the decay is fitted.",
         "0.2 % for the inertia and the stiffness of the scene. 1 % of inertia is 0.5 % of frequency. Shafts and bearings are rigid unless the scene says otherwise, so that lower modes of a real drive are missing.",
         "Check total_inertia_kgm2: it is of all that turns with the gear. The damping ratio is an input in disguise: see below."},
        {Needs::motion, "", "Damping",
         "No drawing says it. 1 to 10 % of critical damping are usual for an oiled pair.",
         "As good as your guess. At a resonance the amplitude goes with 1 / damping: 5 % instead of 7 % make it 1.4 times as high, and whether teeth lose contact may depend on it.",
         "Run the report with a low and a high ratio (make calibrate DAMPING=0.03, then 0.07), and believe what both say."},
        {Needs::motion,
         "responses-by-torque response response-branches rms-and-mean system-sweep", "RMS of the dynamic transmission error over speed", "The vibration of a mesh at each mesh frequency, after it has settled, with speed rising and falling. Peaks stand near f_n (the natural frequency), f_n / 2 and f_n / 3. Where the two directions differ there are two motions at one speed, and jumps between them.",
         "0.2 % of numerical error for the scene's damping; a jump's frequency to 4 Hz. Unstable motions and those that no sweep enters are left out. Away from resonances it is as good as the static transmission error, at resonances as good as the damping.",
         "Keep operating speeds away from the peaks, or lower the harmonic of the static transmission error that meets f_n there."},
        {Needs::motion, "", "Contact lost, jumps",
         "Speeds at which the teeth part in each mesh period, and speeds at which the motion changes to another one.",
         "Yes or no is sharp only away from the limit: contact is lost where the first harmonic of the stiffness over its mean is more than about 1.7 times the damping ratio.",
         "Of a pair make jump-map shows both against torque and damping. Less excitation (relief, phases), more torque, other speeds."},
        {Needs::motion, "system-sweep", "Time without contact, dynamic factor",
         "Part of the time in which no pair of teeth of a mesh touches. Dynamic factor: largest mesh force, sustained for 1/64 of a mesh period, over that at rest; with contact loss teeth meet again with impact.",
         "The peak of an impact depends on the finest modes that are kept; the time without contact hardly does. Back flanks do not touch in the model.",
         "Less excitation (relief, phases), more torque, other speeds."},
        {Needs::figure, "response-branches branch multipliers", "Branches, stable or not",
         "All motions of one mesh period that hang together over speed. Between two folds there are two stable ones at one speed and an unstable one, which parts their basins.",
         "A fold to 4 Hz with the steps of the scene, as a jump. Motions that the branch is not joined to are not seen.",
         ""},
        {Needs::motion, "tooth-loads", "Largest tooth load, over T / r_b",
         "T / r_b is the load of one pair alone at rest; the ratio is of one pair of teeth at one instant, the dynamic factor of all in mesh.",
         "0.7 % of numerical error, else as the RMS. A number with a * is of a motion larger than the backlash: not to be trusted at all.",
         "For strength take it with speed rising and falling, and at the damping you are sure of."},
        {Needs::figure, "waterfall order-cuts sidebands", "Spectra and orders over speed",
         "Which frequencies sound at which speed. Orders of the mesh frequency run along rays; teeth that differ add orders of the shafts around them.",
         "Amplitudes as the RMS; below 1/1000 of the largest they are numerical.",
         "make histories AT=1300 shows the motion at one speed."},
        {Needs::one_slice, "root-stress root-stress-branches", "Root stress, loss factor",
         "Tension in the roots, at rest and in motion; sigma_F0 is that of ISO 6336-3, method B, with its own assumptions (one pair carries the load, a beam with a notch).",
         "At rest as the line root stress of the error budget; in motion as the tooth load, from which it follows as at rest: the inertia of the body, kept modes included, adds none.",
         "Raise element_order or lower element_mm if its line is above 1 %."},
        {Needs::figure, "flank-pressure", "Flank pressure",
         "Hertz's pressure of the load that a pair sustains inside its flanks for 1/64 of a mesh period. Over a tip edge the pressure is singular: the load is stated there, apart, and the map is grey; it is white where no load is sustained.",
         "Half of the relative error of the tooth load; strips at rest are within 2.1 % of it. Edges are sharp here and round in metal.",
         "A load over an edge asks for tip relief: make harris-map."},
        {Needs::figure, "efficiency", "Efficiency, power lost by friction",
         "What friction between the flanks takes, at rest and in motion; the loss factor H_V is apart from the coefficient of friction.",
         "Proportional to the coefficient of friction, which formulas give to 20 to 35 %; H_V is that of the loads: where they jump with the speed, so does it. Oil, bearings and windage are left out.",
         "Compare designs by H_V; it depends on no coefficient."},
        {Needs::figure, "residual-signal", "Residual signal of teeth that differ or are cracked",
         "The transmission error less the mean of its mesh periods, over the period after which the same teeth meet: what gear diagnostics look at. Kurtosis is 3 of noise and grows with the rarity of a spike.",
         "As good as the depth of the crack or the errors that the scene gives; a crack gives way at once, without mass of its own.",
         "Compare its orders with measured sidebands of the shaft that carries the tooth."},
        {Needs::rest, "system-static system-sweep bearing-forces", "Forces on bearings and pins",
         "What each body presses its bearing or pin with, spring and damper together. The mean loads the bearing, the oscillating part is what a housing hears. N equal planets at equal spacing, z teeth of the central gear: harmonic l of its force is left only where (z l + 1) / N or (z l - 1) / N is whole, of its torque only where z l / N is whole.",
         "As good as load sharing, stiffness and damping of the bearings, which the scene gives; they are linear and alike in all directions. Where a carrier turns, remarks say how large centrifugal and Coriolis forces are, and whether they are in them.",
         "They are the input of a housing model; /bearing_force/name of sweep.h5 has their time histories. The angle between the meshes of an idler turns its mesh forces against each other."},
        {Needs::budget, "error-budget", "Error budget",
         "What each refinement of the computation alone changes. Add the lines: the sum bounds the numerical error of the statics.",
         "It tells nothing of what is not modelled: shafts, what friction does to the bodies, lead errors, heat.",
         "A line above 1 %: refine that key of [discretisation]."},
        {Needs::figure, "motion-errors", "Errors of the motions",
         "What refining one discretisation at a time changes in the sweeps, at some of their speeds; the sum stands behind ±.",
         "As the error budget: it tells nothing of what is not modelled.", ""},
        {Needs::figure, "system finite-elements", "Pictures of the gears",
         "The finite elements that carry the bending; flanks in contact are exact.",
         "A picture: look whether these are your gears.", ""},
        {Needs::figure, "profile-chart", "Profile charts", "What the scene takes off the flanks.",
         "Exact: compare with the inspection sheet.", ""},
        {Needs::figure, "crack", "Cracked tooth", "What the crack adds while its tooth is in mesh.",
         "Some per cent for a straight crack of one depth over the face width.", ""},
};

bool named_in(const GuideRow& row, const ReportPicture& picture) {
  return text(" ", row.figures, " ").find(" " + picture.name + " ") != std::string::npos;
}

bool there(const GuideRow& row, const ReportContent& c) {
  const bool over_face = !c.statics.empty() && !c.pair().face.none(), moves = !c.sweeps.empty();
  switch (row.needs) {
    case Needs::figure:
      return std::any_of(c.pictures.begin(), c.pictures.end(),
                         [&](const auto& p) { return named_in(row, p); });
    case Needs::train:
      return c.of_train();
    case Needs::rest:
      return !c.statics.empty();
    case Needs::planets:
      return c.of_train() && has_planets(layout_of(c)) && !c.statics.empty();
    case Needs::modes:
      return c.modes.has_value();
    case Needs::ring_down:
      return !c.impacts.empty();
    case Needs::motion:
      return moves;
    case Needs::one_slice:
      return moves && !over_face;
    case Needs::face:
      return over_face;
    case Needs::face_in_motion:
      return moves && over_face;
    case Needs::budget:
      return c.budget.has_value();
  }
  return true;
}

}  // namespace

std::string guide_to_numbers(const ReportContent& c) {
  std::string out =
      "<p>DTE is the dynamic transmission error: how far the driver runs ahead of where rigid, exact gears would have it, along the line of action, in motion; STE is the same at rest. Frequencies are mesh frequencies in Hz unless said otherwise: teeth of the driver times its turns per second.</p>\n";
  if (c.of_train() && has_planets(layout_of(c)))
    out += "<p>All numbers are those in the frame of the carrier, which turns at its mean speed.</p>\n";
  if (c.budget)
    out += text("<p>Of these gears the error budget at ", torque_words(c.budget->torque), " sums up to ",
                shown(c.budget->refinement.error(&StaticChanges::mean_stiffness_change) * kPercent, 2),
                " % of the mean mesh stiffness, ",
                shown(c.budget->refinement.error(&StaticChanges::peak_to_peak_change) * kPercent, 2),
                " % of the peak-to-peak transmission error and ",
                shown(c.budget->refinement.harmonic_error(1) * kPercent, 2),
                " % of its first harmonic: more digits than these have no meaning.</p>\n");
  out +=
      "<div class=\"wide\"><table class=\"guide\">\n<caption>Numerical errors are those that the defaults leave on the pair of P2000; those of your own gears stand in the error budget.</caption>\n<thead><tr><th>what</th><th>how to read it</th><th>how far to trust it</th><th>what to do next</th></tr></thead>\n<tbody>\n";
  const auto cell = [](const std::string& words) { return "<td>" + words + "</td>"; };
  for (const GuideRow& row : kRows) {
    if (!there(row, c)) continue;
    std::string links;
    for (const ReportPicture& picture : c.pictures)
      if (named_in(row, picture))
        links += text(links.empty() ? " (" : ", ", "<a href=\"#", picture.name, "\">", picture.name, "</a>");
    out += "<tr>" + cell(row.what + links + (links.empty() ? "" : ")")) + cell(row.reading) +
           cell(row.trust) + cell(row.next) + "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

}  // namespace whine
