#include "paper/beside.h"

#include <cmath>
#include <map>

#include "base/error.h"

namespace whine {
namespace {

bool close(double x, double y) {
  return std::abs(x - y) < 1e-9;
}

bool teeth_of_paper(const GearDesign& g) {
  return g.teeth == 50 && close(g.module, 3e-3);
}

// P2000, section 2.1; the gears it leaves open are the scene's.
bool pair_of_paper(const GearPairParameters& a) {
  return teeth_of_paper(a.gear[0].design) && a.gear[1].design.teeth == 50 &&
         close(a.gear[0].design.face_width, 25.4e-3) && close(a.mesh.centre_distance, 0.15) &&
         close(a.gear[0].material.youngs_modulus, 207e9);
}

}  // namespace

PrintedJumps jumps_of_paper() {
  PrintedJumps p;
  p.of_pair = pair_of_paper;
  p.source = "P2000";
  p.damping_ratio = 0.07;
  p.lumped_damping_ratio = 0.08;
  p.torques = {100, 150, 200, 300, 600};
  p.torque_words = "100 to 300 and 600 N m";
  p.load_torque = 150;
  p.loads = "3.00 and 4.85";
  p.lost_torque = 100;
  p.kept_torques = {200, 300};
  p.lost_words = "P2000's second lumped model (Figure 16)";
  return p;
}

std::string paper_figure(const std::string& name) {
  if (name == "fig14-elastic") return "Figures 14 and 16";
  if (!name.starts_with("fig") || name.size() < 5) return "";
  const std::string number = name.substr(3, 2);
  if (number.find_first_not_of("0123456789") != std::string::npos || (name.size() > 5 && name[5] != '-'))
    return "";
  constexpr int kLast = 16;  // of P2000
  return std::stoi(number) <= kLast ? text("Figure ", std::stoi(number)) : "";
}

void name_figures_of_paper(ReportContent& content) {
  if (content.statics.empty() || content.of_train()) return;
  const StaticResult& pair = content.pair();
  if (!teeth_of_paper(pair.gear[0].design) || !teeth_of_paper(pair.gear[1].design)) return;
  // Figures of a scene are called by what they show.
  static const std::map<std::string, std::string> alike{{"finite-elements", "fig01"},
                                                        {"contact-zone", "fig03"},
                                                        {"response", "fig05"},
                                                        {"response-branches", "fig05"},
                                                        {"responses-by-torque", "fig07"},
                                                        {"responses-by-torque-branches", "fig07"},
                                                        {"transmission-error", "fig12"},
                                                        {"mesh-stiffness", "fig13"},
                                                        {"rms-and-mean", "fig14-elastic"}};
  for (ReportPicture& picture : content.pictures)
    if (const auto found = alike.find(picture.name); found != alike.end())
      if (const std::string figure = paper_figure(found->second); !figure.empty())
        picture.printed = figure + " of P2000 " + (figure.starts_with("Figures") ? "show" : "shows");
}

}  // namespace whine
