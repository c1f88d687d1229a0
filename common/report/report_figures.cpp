#include "report/report_figures.h"

#include <algorithm>
#include <functional>

#include "base/error.h"
#include "gear/pair.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_page.h"
#include "report/report_results.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;

std::string at_torques(const ReportContent& c, const std::function<std::string(const StaticResult&)>& said) {
  std::vector<std::string> parts;
  for (const SystemStaticResult& at : c.statics)
    parts.push_back(said(at.mesh[0]) + " at " + torque_words(torque_of(at)));
  return listed(parts);
}

std::string transmission_error_caption(const ReportContent& c) {
  return "Static transmission error over a mesh period and its harmonics: how far the driver runs ahead of where rigid, unloaded gears would have it. From peak to peak it is " +
         at_torques(c,
                    [](const auto& s) {
                      return significant(peak_to_peak(s.transmission_error) * kMicro, 3) + " µm";
                    }) +
         "; this variation is what excites the whine.";
}

std::string stiffness_caption(const ReportContent& c) {
  return text(
             "Mesh stiffness, the load over what it adds to the transmission error, over a mesh period and its harmonics",
             c.pair().gear[0].design.helical()
                 ? ""
                 : "; black: the rectangular wave that lumped models take instead",
             ". Its mean is ") +
         at_torques(c, [](const auto& s) { return fixed(s.mean_stiffness * 1e-6, 1) + " N/µm"; }) + ".";
}

// Of planets.
std::string planet_sharing_caption(const std::vector<LoadSharing>& sharing) {
  std::vector<std::string> parts;
  parts.reserve(sharing.size());
  for (const LoadSharing& of : sharing) parts.push_back(text(fixed(of.factor, 3), " of ", of.name));
  return text(
      "Share of each planet's mesh in the load over the mesh period (left), and the loads of the tooth ",
      "pairs of the first one (right). The load sharing factor, the largest share times the number of ",
      "planets, is ", listed(parts), "; 1 is equal sharing.");
}

std::string load_sharing_caption(const ReportContent& c) {
  if (c.statics.empty()) return "";
  if (c.of_train()) return planet_sharing_caption(load_sharing(c.statics[0]));
  const StaticResult& s = c.pair();
  return text(
      "The share of the load that a tooth pair carries on its way from the root of the driver's tooth to its tip (left), and the loads of all pairs over a mesh period at ",
      torque_words(s.torque), " (right). Grey lines: where contact begins and ends on the line of action, ",
      s.gear[0].design.helical()
          ? "and between them where the contact line reaches over the whole face, if it does"
          : "and between them the part with one pair",
      "; load beyond them is carried by tip edges. The contact ratio is ",
      fixed(s.contact_ratio + GearPair(s).overlap_ratio(), 3), ".");
}

// Where sweeps at a torque (0: at any) go beyond the backlash; "" if none does.
std::string beyond_words(const ReportContent& c, double torque) {
  std::string list;
  for (const ResponseResult& s : c.sweeps) {
    const std::string speeds = speeds_beyond_backlash({&s});
    if (speeds.empty() || (torque > 0 && s.torque != torque)) continue;
    list += text(list.empty() ? "" : "; ", torque > 0 ? "" : torque_words(s.torque) + ", ", way_words(s),
                 ": ", speeds, " Hz");
  }
  return list.empty()
             ? ""
             : " Beyond the backlash, where back flanks would touch, which is not modelled: " + list + ".";
}

std::string response_caption(const ReportContent& c) {
  std::string out =
      "RMS of the oscillating part of the dynamic transmission error against speed, with speed rising and falling; f_n is the natural frequency with the contact frozen under the static load, mean over the mesh period. ";
  for (const SystemStaticResult& at : c.statics) {
    const StaticResult& s = at.mesh[0];
    const ResponseResult *up = sweep_of(c, s.torque, Direction::up),
                         *down = sweep_of(c, s.torque, Direction::down);
    if (!up || !down) continue;
    const ResponseResult &r = *up, &f = *down;
    std::vector<std::string> peaks;
    for (const Index i : resonances(r))
      peaks.push_back(
          text(hertz(r.mesh_frequency[i]), " Hz (", significant(r.dte_rms(i, 0) * kMicro, 3), " µm)"));
    const std::string loss = loss_both_ways(r, f);
    out += text("At ", torque_words(s.torque), ", f_n = ", hertz(r.natural_frequency),
                " Hz: ", peaks.empty() ? "no resonance within the sweep" : "resonances at " + listed(peaks),
                "; ");
    if (r.jump_frequency.size() + f.jump_frequency.size() > 0)
      out += text("jumps rising: ", jumps_of(r), r.jump_frequency.size() > 0 ? " Hz" : "",
                  ", falling: ", jumps_of(f), f.jump_frequency.size() > 0 ? " Hz" : "", "; ");
    else
      out += "no jumps; ";
    out += loss.empty() ? "contact is never lost. " : "contact is lost " + loss + ". ";
  }
  while (out.ends_with(' ')) out.pop_back();
  return out + beyond_words(c, 0);
}

std::string waterfall_caption(const ReportContent& c) {
  const ResponseResult& s = c.sweeps[0];
  return text("Spectra of the dynamic transmission error at ", torque_words(s.torque),
              sweep_of(c, s.torque, Direction::up) && sweep_of(c, s.torque, Direction::down)
                  ? ", speed rising (above) and falling (below)"
                  : ", " + way_words(s),
              " as colours. Orders run along rays; each is strong where it crosses the natural frequency of ",
              hertz(s.natural_frequency),
              " Hz (mean over the period, contact frozen under the static load). The mesh frequency is ",
              s.gear[0].design.teeth, " times the speed of the driver.", beyond_words(c, s.torque));
}

std::string tooth_loads_caption(const ReportContent& c) {
  const StaticResult& s = c.pair();
  const ResponseResult *up = sweep_of(c, s.torque, Direction::up),
                       *down = sweep_of(c, s.torque, Direction::down);
  std::string out =
      "Largest load of a tooth pair against speed (above), and the loads over the mesh period at the speed with the largest vibration (below).";
  if (up && down) {
    const double load = std::max(up->tooth_load_max.maxCoeff(), down->tooth_load_max.maxCoeff());
    out += text(" At ", torque_words(s.torque), " it reaches ", fixed(load, 0), " N, ",
                fixed(load / static_force(s), 2), " times ", plain_force_name(s), " = ",
                fixed(static_force(s), 0), " N.");
  }
  return out + beyond_words(c, s.torque);
}

std::string bearings_caption(const ReportContent& c) {
  return "Force of each gear on its bearing against speed: what a housing hears. RMS of the oscillating part, at most " +
         at_torques(c,
                    [&](const StaticResult& s) {
                      double most = 0;
                      for (const Direction direction : {Direction::up, Direction::down})
                        if (const ResponseResult* sweep = sweep_of(c, s.torque, direction))
                          if (sweep->bearing_force_rms.size() > 0)
                            most = std::max(most, sweep->bearing_force_rms.maxCoeff());
                      return fixed(most, 0) + " N";
                    }) +
         ", and the largest force, beside the load at rest.";
}

std::string losses_caption(const ReportContent& c) {
  return "Efficiency of the mesh (a) and the mean power that friction between the flanks takes (b) over speed, rising and falling; dotted: the efficiency at rest, by kinematics. Moments of friction about the two axes while the teeth pass through the mesh at rest (c). Oil, bearings and windage are left out, and so is what the dampers of the vibration take." +
         beyond_words(c, 0);
}

std::string flank_load_caption(const ReportContent& c) {
  if (c.of_train())
    return "Load over the flanks, of each [[mesh]] the one with the largest line load, as a contact pattern shows it: line load over face and path of contact (left); red: lines of contact, a quarter of a mesh period apart. Line load of each tooth pair over the face, with the reference pair at the pitch point (right). The face counts from its middle towards the viewer who sees the driving gear turn counter-clockwise.";
  const StaticResult& s = c.pair();
  return text(
      "Load over the flank of the driver at ", torque_words(s.torque),
      ", as a contact pattern shows it: line load over face and path of contact, root below and tip above (left); red: lines of contact, a quarter of a mesh period apart. Line load of each tooth pair over the face at mesh phase 0 (right). The face counts from its middle towards the viewer who sees the driver turn counter-clockwise. K_Hβ of the reference pair is ",
      at_torques(c,
                 [](const StaticResult& a) {
                   return text(fixed(a.face.load_factor, 3), " ± ", significant(a.face.load_factor_error, 1));
                 }),
      ".");
}

std::string face_load_caption(const ReportContent& c) {
  double most = 0;
  for (const ResponseResult& s : c.sweeps)
    if (s.torque == c.pair().torque && s.face_load_factor.size() > 0)
      most = std::max(most, s.face_load_factor.maxCoeff());
  return text("Face load factor K_Hβ and largest line load against speed at ", torque_words(c.pair().torque),
              ", of the tooth pair with the largest load at its instant. K_Hβ is ",
              fixed(c.pair().face.load_factor, 3), " at rest and reaches ", fixed(most, 3), " in motion.",
              beyond_words(c, c.pair().torque));
}

std::string budget_caption(const ReportContent& c) {
  if (!c.budget) return "";
  return text("Error budget of the statics at ", torque_words(c.budget->torque),
              ": what refining each discretisation alone changes. The changes stand for errors of ",
              shown(c.budget->refinement.error(&StaticChanges::mean_stiffness_change) * kPercent, 2),
              " % of the mean stiffness and ", shown(c.budget->refinement.harmonic_error(1) * kPercent, 2),
              " % of the first harmonic of the transmission error.");
}

std::string picture_caption(const ReportContent& c) {
  return !c.statics.empty()
             ? "The gears at their places, unloaded at mesh phase 0, with the teeth of their drawings, and the teeth about a pitch point of each [[mesh]]. Check positions and senses of rotation against your drawing."
             : "The gears at their places by the working pitch circles of their meshes, with a tick at each tooth; rigid gears have no drawing. Check positions and senses of rotation against your drawing.";
}

std::string system_at_rest_caption(const ReportContent& c) {
  if (c.statics.empty()) return "";
  const SystemStaticResult& a = c.statics[0];
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

std::string modes_caption(const ReportContent& c) {
  if (!c.modes) return "";
  const ModesResult& a = *c.modes;
  Index lowest = 0;
  while (lowest < a.natural_frequency.size() && a.natural_frequency[lowest] == 0) ++lowest;
  return text("Natural frequencies by type, and the shapes of the modes, magnified; grey: at rest.",
              lowest < a.natural_frequency.size()
                  ? text(" The lowest is ", shown(a.natural_frequency[lowest], 6), " Hz (",
                         name_of(a.type[static_cast<size_t>(lowest)]), ").")
                  : "");
}

std::string system_sweep_caption(const ReportContent& c) {
  return text(
      "RMS of the oscillating transmission error and time without contact of each mesh, and oscillating ",
      "force on each bearing and pin, over the mesh frequency; lines: speed rising, marks: falling. ",
      motion_words(c));
}

// A figure that the page has words for. section: of the page. One of another stage is a row below, and its name in report_shows of
// pipelines/figures.mk.
struct ExplainedFigure {
  const char *name, *section, *title;
  std::function<std::string(const ReportContent&)> words;
};

std::function<std::string(const ReportContent&)> same_words(const char* words) {
  return [words](const ReportContent&) { return std::string(words); };
}

const std::vector<ExplainedFigure>& explained_figures() {
  static const std::vector<ExplainedFigure> all{
      {"system", "opening", "The gears", picture_caption},
      {"finite-elements", "gears", "Finite elements of the pair",
       same_words(
           "Finite element mesh of the pair and of the teeth in mesh. Flanks are exact involutes in the contact; the mesh carries their bending.")},
      {"profile-chart", "gears", "Profile charts",
       same_words(
           "Profile charts of the driving flanks as an inspection sheet shows them: material against roll angle, the tip to the right.")},
      {"contact-zone", "rest", "Contact zone",
       same_words(
           "Contact zone of the reference pair at the pitch point: strips, gap and pressure, beside Hertz's.")},
      {"system-static", "rest", "The train at rest", system_at_rest_caption},
      {"transmission-error", "rest", "Static transmission error", transmission_error_caption},
      {"mesh-stiffness", "rest", "Mesh stiffness", stiffness_caption},
      {"flank-load", "rest", "Load over the flank", flank_load_caption},
      {"load-sharing", "rest", "Load sharing", load_sharing_caption},
      {"sidebands", "rest", "Sidebands",
       same_words(
           "Teeth that differ: transmission error over the period after which the same teeth meet, and the shafts' orders and sidebands at rest and in motion.")},
      {"residual-signal", "motion", "Residual signal",
       same_words(
           "Teeth that differ or are cracked, at the speed and, of several meshes, in the mesh in which they show most: transmission error over the period after which the same teeth meet, and what it is less the mean of its mesh periods, the residual signal of gear diagnostics; orders, with sidebands beside those of the mesh; RMS and kurtosis of the residual signal over speed.")},
      {"crack", "rest", "The cracked tooth",
       same_words(
           "The mark of the cracked tooth in the static transmission error, its orders, and the root stress of the teeth about it.")},
      {"modes", "modes", "Natural modes", modes_caption},
      {"campbell", "modes", "Campbell diagram",
       same_words(
           "Natural frequencies and the harmonics of the mesh frequency. Where a ray meets a line that harmonic of the transmission error can excite that mode: keep operating speeds away from the points that matter.")},
      {"ring-down", "modes", "Ring-down",
       same_words(
           "Natural frequency and damping ratio of each mode by ring-down at each mesh phase, beside the eigenvalues of the frozen contact.")},
      {"system-sweep", "motion", "The train over its speeds", system_sweep_caption},
      {"response", "motion", "Vibration over speed", response_caption},
      {"responses-by-torque", "motion", "Vibration over speed", response_caption},
      {"response-branches", "motion", "Branches of periodic motions",
       same_words(
           "The same with all orbits of the branch: stable ones as a thin line, also where no sweep was on them, unstable ones dashed, and the folds at which stable branches end. A sweep jumps at a fold; where it jumps without one it has left the basin of a branch that goes on.")},
      {"branch", "motion", "Branches of periodic motions",
       same_words(
           "Periodic motions along their branch, stable or not, beside the sweeps: RMS of the transmission error of each mesh, folds, period doublings, and where a Floquet multiplier leaves the unit circle.")},
      {"multipliers", "motion", "Floquet multipliers",
       same_words(
           "Floquet multipliers along the branch in the complex plane: a small disturbance of the motion is multiplied by them in each mesh period. Inside the unit circle it decays. A branch folds at 1; at -1 its period doubles.")},
      {"rms-and-mean", "motion", "RMS and mean over speed",
       same_words("RMS and mean of the dynamic transmission error against speed.")},
      {"waterfall", "motion", "Spectra over speed", waterfall_caption},
      {"order-cuts", "motion",
       "Order cuts", same_words("Order cuts: amplitudes of the first orders of the mesh frequency in the dynamic transmission error of each mesh against speed, rising and falling. Where an order peaks, that multiple of the mesh frequency meets a natural frequency. Where the two directions differ there are two motions, and the order that is heard depends on where the speed came from.")},
      {"tooth-loads", "motion", "Tooth loads in motion", tooth_loads_caption},
      {"face-load", "motion", "Load over the face in motion", face_load_caption},
      {"root-stress", "motion", "Root stress and dynamic factors",
       same_words(
           "Largest tension along the roots beside the loaded flanks: while a tooth passes through the mesh at rest (a), and over speed (b). Dynamic factors (c) are the largest mesh force, tooth load and root stress at a speed, each sustained for 1/64 of a mesh period, over T / r_b or over the largest at rest; K_v is what ISO 6336-1, method B, says of gears without deviations.")},
      {"root-stress-branches", "motion", "Root stress along the branch",
       same_words(
           "The same with the orbits of the branch: thin lines where they are stable, dots where they are not and no sweep finds them.")},
      {"flank-pressure", "motion", "Flank pressure over speed",
       same_words(
           "Largest pressure at each place of the flanks, by Hertz's law of the load that a pair holds there inside its flanks for 1/64 of a mesh period, against roll angle and speed. Where a tip edge runs on a flank the pressure is singular: the map is grey, and the load that the edge carries stands beside it. White: no load is sustained.")},
      {"efficiency", "motion", "Losses by friction", losses_caption},
      {"bearing-forces", "motion", "Forces on the bearings", bearings_caption},
      {"error-budget", "errors", "Error budget", budget_caption},
      {"motion-errors", "errors", "Errors of the motions",
       same_words(
           "What refining one discretisation at a time changes in the sweeps, at some of their speeds, and the error that follows.")}};
  return all;
}

// By its name, which is that of its files: numbers of the page would be taken for those of a publication's figures.
std::string figure(const ReportContent& c, const ReportPicture& picture, const ExplainedFigure& kind) {
  std::string words = html::escaped(with_rpm(driver_of(c), kind.words(c)));
  if (!picture.printed.empty())
    words += text(" ", picture.name, " shows of this pair what ", picture.printed, " of its own.");
  return picture_html(picture, kind.title, words, c.figure_folder);
}

}  // namespace

std::vector<std::string> report_figures() {
  std::vector<std::string> names;
  names.reserve(explained_figures().size());
  for (const ExplainedFigure& kind : explained_figures()) names.emplace_back(kind.name);
  return names;
}

std::string figures_of(const ReportContent& c, const std::string& section) {
  std::string out;
  for (const ExplainedFigure& kind : explained_figures())
    for (const ReportPicture& picture : c.pictures)
      if (section == kind.section && picture.name == kind.name) out += figure(c, picture, kind);
  return out;
}

}  // namespace whine
