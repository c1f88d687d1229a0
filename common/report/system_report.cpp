#include "report/system_report.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/error.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_page.h"
#include "report/system_figures.h"
#include "report/system_picture.h"
#include "report/system_report_tables.h"
#include "system/rigid_system.h"

namespace whine {
namespace {

using Eigen::Index;

const System& layout_of(const SystemReport& r) {
  return r.rest ? r.rest->settings.layout : r.modes->layout;
}

std::string of_picture(const SystemReport& r) {
  return r.rest
             ? "The gears at their places, unloaded at mesh phase 0, with the teeth of their drawings, and "
               "the "
               "teeth about a pitch point of each [[mesh]]. Look whether these are your gears, and whether "
               "they turn as yours do."
             : "The gears at their places by the working pitch circles of their meshes, with a tick at each "
               "tooth: "
               "of rigid gears no more is known. Look whether they stand and turn as yours do.";
}

std::string of_rest(const SystemReport& r) {
  if (!r.rest) return "";
  const SystemStaticArtifact& a = *r.rest;
  std::vector<std::string> parts;
  parts.reserve(static_cast<size_t>(a.transmission_error.cols()));
  for (Index m = 0; m < a.transmission_error.cols(); ++m)
    parts.push_back(text(significant(peak_to_peak(a.transmission_error.col(m)) * kMicro, 3), " µm of ",
                         mesh_name(a.settings.layout, static_cast<size_t>(m))));
  constexpr size_t kMost = 4;
  const size_t all = parts.size();
  parts.resize(std::min(all, kMost));
  return text(
      "Transmission error of each mesh, its force, and the force on each bearing and pin over a mesh period, "
      "and "
      "their harmonics. The transmission error is from peak to peak ",
      listed(parts), all > kMost ? text(" (", all - kMost, " more in the table above)") : "",
      "; its variation excites the whine, and the harmonics of the bearing forces are what a housing hears.",
      load_sharing(a).empty() ? "" : " Harmonics that the planets cancel among them are missing.");
}

std::string of_sharing(const SystemReport& r) {
  if (!r.rest) return "";
  const std::vector<LoadSharing> sharing = load_sharing(*r.rest);
  std::vector<std::string> parts;
  parts.reserve(sharing.size());
  for (const LoadSharing& of : sharing) parts.push_back(text(fixed(of.factor, 3), " of ", of.name));
  return text(
      "Share of each planet's mesh in the load over the mesh period (left), and the loads of the tooth pairs "
      "of "
      "the first one (right). The load sharing factor, the largest share times the number of planets, is ",
      listed(parts), "; 1 is equal sharing.");
}

std::string of_modes(const SystemReport& r) {
  const ModesArtifact& a = *r.modes;
  Index lowest = 0;
  while (lowest < a.natural_frequency.size() && a.natural_frequency[lowest] == 0) ++lowest;
  return text("Natural frequencies by type, and the shapes of the modes, magnified; grey: at rest.",
              lowest < a.natural_frequency.size()
                  ? text(" The lowest is ", fixed(a.natural_frequency[lowest], 1), " Hz (",
                         name_of(a.type[static_cast<size_t>(lowest)]), ").")
                  : "");
}

std::string of_campbell(const SystemReport&) {
  return "Natural frequencies and the harmonics of the mesh frequency. Where a ray meets a line that "
         "harmonic of the "
         "transmission error excites that mode: keep operating speeds away from the points that matter.";
}

struct Explained {
  const char *name, *section, *title;
  std::function<std::string(const SystemReport&)> words;
};

// A figure of another stage, of motion say, is a row here, its words above, and its name in pipelines/systems.mk.
const std::vector<Explained>& explained() {
  static const std::vector<Explained> all{
      {"system", "gears", "The system", of_picture},
      {"system-static", "rest", "The system at rest", of_rest},
      {"load-sharing", "rest", "Load sharing among planets", of_sharing},
      {"modes", "modes", "Natural modes", of_modes},
      {"campbell", "modes", "Campbell diagram", of_campbell},
  };
  return all;
}

std::string figures_in(const SystemReport& r, const std::string& section) {
  std::string out;
  for (const Explained& kind : explained())
    for (const ReportPicture& picture : r.pictures)
      if (section == kind.section && picture.name == kind.name)
        out += picture_html(picture, kind.title, html::escaped(kind.words(r)));
  return out;
}

const std::vector<GuideRow>& guide_rows() {
  static const std::vector<GuideRow> rows{
      {"system", "Positions, senses, phases",
       "They follow from tooth numbers, centre distances and angles of the scene. A mesh phase is by what "
       "share of a "
       "mesh period a mesh is ahead of the first one: meshes in phase push together, others in turn.",
       "Exact. Compare picture and tables with your drawing first.",
       "If one is off, correct the scene: direction_deg of a [[mesh]], positions_deg of the [[carrier]]."},
      {"", "Contact ratio, backlash, diameters",
       "Geometry of the gears as drawn at the centre distances of the scene.", "All digits shown.",
       "addendum and dedendum, profile_shift, tooth_thinning_mm."},
      {"system-static", "Static transmission error of a mesh",
       "How far the driving gear of the mesh runs ahead under load, along the line of action, what bearings "
       "give "
       "way included. Its mean is no noise, its variation excites the whine.",
       "0.1 to 0.2 % of numerical error on the pairs that were compared with other programs. Real flanks "
       "deviate by "
       "micrometres, and real bearings and carriers give way more than those of the scene.",
       "Tip relief ([gear.name.modification]); tooth numbers and planet positions whose phases cancel a "
       "harmonic."},
      {"load-sharing", "Load sharing",
       "Which part of the load each planet carries. Equal planets share equally in the mean; over the mesh "
       "period "
       "shares vary where phases differ.",
       "For gears without errors. Positions of pins, run-out and tooth thickness of real planets differ by "
       "more than what a mesh "
       "gives way and decide the sharing; the model has none of them.",
       "A floating central gear (soft [[bearing]]) equalises; ISO 6336-1 has the mesh load factor K_gamma."},
      {"system-static", "Forces on bearings and pins",
       "What each body presses its bearing or pin with. The mean loads the bearing, what oscillates is "
       "heard.",
       "As good as the load sharing and the stiffness of the bearings that the scene gives.",
       "Harmonic l of the force on a central gear vanishes where z l / N is whole, z its teeth, N equal "
       "planets."},
      {"modes", "Natural frequencies, types",
       "Of the bodies, rigid in themselves, on the mean stiffness of the meshes and on their bearings. A "
       "rotational "
       "mode answers to torque variation, a translational one to forces on central gears; planet modes leave "
       "central gears at "
       "rest.",
       "As good as inertias, masses and bearings of the scene; 1 % of stiffness is 0.5 % of a frequency. "
       "Shafts and the elastic "
       "modes of the bodies are not in it.",
       "Check total_inertia_kgm2 of gears that carry a shaft; give all bearings."},
      {"campbell", "Campbell diagram",
       "Mesh frequencies at which a harmonic meets a natural frequency. Bands: the natural frequencies with "
       "the contact of "
       "each phase.",
       "It says where resonances can be, not how strong they are: the harmonic may be weak, or cancelled "
       "among the planets.",
       "Look at the harmonics of the transmission error beside it."},
  };
  return rows;
}

std::string guide(const SystemReport& r) {
  std::vector<GuideRow> rows;
  for (const GuideRow& row : guide_rows()) {
    const bool there = std::any_of(r.pictures.begin(), r.pictures.end(),
                                   [&](const ReportPicture& picture) { return row.figures == picture.name; });
    if (there || (row.figures.empty() && r.rest)) rows.push_back(row);
  }
  return guide_table(
      "All gears are at rest here, in the frame of the carrier; frequencies are mesh frequencies unless said "
      "otherwise.",
      rows, r.pictures);
}

std::string introduction(const SystemReport& r) {
  const System& s = layout_of(r);
  const Eigen::VectorXd torque =
      r.rest ? Eigen::VectorXd(r.rest->torque.colwise().mean().transpose()) : Eigen::VectorXd();
  std::string out = text(bodies_words(s, torque), ".");
  for (size_t c = 0; c < s.bodies.size(); ++c) {
    if (s.bodies[c].kind != System::BodyKind::carrier) continue;
    const auto planets = std::count_if(s.bodies.begin(), s.bodies.end(), [&](const System::Body& body) {
      return body.on == static_cast<int>(c);
    });
    out += text(" The ", s.bodies[c].name, " has ", planets, " planets.");
  }
  out += text(" ", s.bodies.size(), " bodies, ", s.meshes.size(), " meshes.");
  if (r.rest) {
    for (const LoadSharing& of : load_sharing(*r.rest))
      out += text(" Load sharing factor of ", of.name, ": ", fixed(of.factor, 3), ".");
    out += text(" Transmission errors from peak to peak up to ",
                significant(
                    [&] {
                      double most = 0;
                      for (Index m = 0; m < r.rest->transmission_error.cols(); ++m)
                        most = std::max(most, peak_to_peak(r.rest->transmission_error.col(m)));
                      return most * kMicro;
                    }(),
                    3),
                " µm.");
  } else {
    out += " The gears are rigid, with one spring for each mesh: natural modes alone are computed.";
  }
  return html::paragraph(out);
}

void require_whole(const SystemReport& r) {
  if (!r.modes)
    fail(Failure::input, "report: no modes.h5 given; the report of a system needs that of its scene");
  if (r.rest) {
    const System &a = r.rest->settings.layout, &b = r.modes->layout;
    bool same = a.bodies.size() == b.bodies.size() && a.meshes.size() == b.meshes.size();
    for (size_t i = 0; same && i < a.bodies.size(); ++i)
      same = a.bodies[i].name == b.bodies[i].name && a.bodies[i].teeth == b.bodies[i].teeth;
    if (!same)
      fail(Failure::input,
           "report: system_static.h5 and modes.h5 are of two systems; give artifacts of one scene");
  }
  const std::vector<std::string> known = system_report_figures();
  for (size_t i = 0; i < r.pictures.size(); ++i) {
    const std::string& name = r.pictures[i].name;
    if (std::find(known.begin(), known.end(), name) == known.end())
      fail(Failure::input, "report: there are no words for a figure '", name, "' of a system; known are ",
           listed(known));
    for (size_t j = 0; j < i; ++j)
      if (r.pictures[j].name == name) fail(Failure::input, "report: figure ", name, " is given twice");
  }
}

}  // namespace

std::vector<std::string> system_report_figures() {
  std::vector<std::string> names;
  names.reserve(explained().size());
  for (const Explained& kind : explained()) names.emplace_back(kind.name);
  return names;
}

std::string system_report_tsv(const SystemReport& r) {
  require_whole(r);
  std::string out = "# " + r.scene + "\npart\tquantity\tvalue\tunit\tremark\n";
  for (const SystemNumber& n : system_numbers(r))
    out += text(n.part, "\t", n.quantity, "\t", n.value, "\t", n.unit, "\t", n.remark, "\n");
  return out;
}

std::string system_report_html(const SystemReport& r) {
  require_whole(r);
  std::vector<ReportSection> sections;
  const auto add = [&](const char* id, const char* heading, const std::string& inside) {
    if (!inside.empty()) sections.push_back({id, heading, inside});
  };
  add("results", "Results", introduction(r) + figures_in(r, "gears"));
  add("remarks", "Warnings and remarks", system_remarks(r));
  add("guide", "What the numbers mean", guide(r));
  add("gears", "Gears and bodies", gear_tables(r));
  add("meshes", "Meshes", mesh_tables(r));
  add("rest", "At rest", force_table(r) + figures_in(r, "rest"));
  add("modes-of-system", "Natural modes", modes_table(r) + figures_in(r, "modes"));
  add("motion", "In motion", figures_in(r, "motion"));
  add("parameters", "Parameters", settings_table(r));
  add("provenance", "Provenance", provenance_table(r.sources));
  return report_page(r.scene, sections);
}

}  // namespace whine
