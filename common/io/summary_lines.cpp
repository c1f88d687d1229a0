#include "io/summary_lines.h"

#include <algorithm>
#include <cmath>

#include "gear/layout.h"

namespace whine {

void show(SummaryLines& lines, const ModesResult& a) {
  std::string bodies;
  for (const System::Body& body : a.layout.bodies) bodies += (bodies.empty() ? "" : ", ") + body.name;
  add(lines, "bodies", bodies);
  add(lines, "meshes", a.layout.meshes.size());
  for (Eigen::Index i = 0; i < a.natural_frequency.size(); ++i)
    add(lines, "mode", a.natural_frequency[i], " Hz, ", a.type[static_cast<size_t>(i)]);
}

// Which gears have errors, and after which time the same teeth meet.
void show_differing_teeth(SummaryLines& lines, const System& layout, const std::vector<ToothErrors>& errors,
                          int periods) {
  for (size_t b = 0; b < errors.size(); ++b)
    if (!errors[b].none()) add(lines, layout.bodies[b].name + "'s teeth", words_of(errors[b]));
  if (periods > 1) add(lines, "hunting period", periods, " mesh periods, after which the same teeth meet");
}

void show(SummaryLines& lines, const SystemStaticResult& a) {
  if (!a.of_train()) return show(lines, a.mesh.at(0));
  const System& s = a.settings.layout;
  add(lines, "model", "contact ", a.settings.fidelity.contact, ", ", a.mesh_phase.size() / a.hunting_periods,
      " positions in a mesh period");
  show_differing_teeth(lines, s, a.settings.errors, a.hunting_periods);
  for (size_t b = 0; b < s.bodies.size(); ++b) {
    const auto column = static_cast<Eigen::Index>(b);
    double most = 0;
    for (const MatrixRM& force : a.bearing_force) most = std::max(most, force.row(column).norm());
    add(lines, "body", s.bodies[b].name, ": torque ", a.torque.col(column).mean(),
        " N m, bearing force up to ", most, " N");
  }
  for (size_t m = 0; m < s.meshes.size(); ++m) {
    const auto column = static_cast<Eigen::Index>(m);
    const StaticResult& mesh = a.mesh[m];
    add(lines, "mesh", s.bodies[static_cast<size_t>(s.meshes[m].side[0].body)].name, " and ",
        s.bodies[static_cast<size_t>(s.meshes[m].side[1].body)].name, ": transmission error ",
        mesh.transmission_error.minCoeff() * 1e6, " to ", mesh.transmission_error.maxCoeff() * 1e6,
        " µm, share of the load ", a.load_share.col(column).minCoeff() * 100, " to ",
        a.load_share.col(column).maxCoeff() * 100, " %, mean stiffness ", mesh.mean_stiffness * 1e-6,
        " N/µm (secant), root stress up to ",
        mesh.root_stress_max.size() > 0 ? mesh.root_stress_max.maxCoeff() * 1e-6 : 0.0, " MPa");
  }
  add(lines, "residual", a.torque_residual, " of the largest mesh force");
}

void show_model(SummaryLines& lines, const MotionSource& s) {
  add(lines, "system", s.layout.bodies.size(), " bodies, ", s.layout.meshes.size(), " meshes");
  add(lines, "model", "body ", s.fidelity.body, ", contact ", s.fidelity.contact, ", damping ",
      s.damping.rayleigh_stiffness, " s and ", s.damping.rayleigh_mass, " 1/s");
}

std::string words_of(const ToothErrors& e) {
  const auto largest = [](const std::vector<double>& teeth) {
    double most = 0;
    for (const double deviation : teeth) most = std::max(most, std::abs(deviation));
    return most * 1e6;
  };
  std::string words;
  const auto part = [&](const auto&... parts) { words += text(words.empty() ? "" : ", ", parts...); };
  if (e.iso_class > 0)
    part("class ", e.iso_class, " of ISO 1328-1, ", e.iso_share * 100, " % of its limits, seed ", e.seed);
  if (e.eccentricity != 0)
    part("eccentricity ", e.eccentricity * 1e6, " µm towards tooth ", e.eccentric_tooth);
  for (const auto& [name, teeth] :
       {std::pair{"single pitch", &e.single_pitch}, std::pair{"cumulative pitch", &e.cumulative_pitch},
        std::pair{"profile slope", &e.profile_slope}, std::pair{"profile form", &e.profile_form}})
    if (largest(*teeth) > 0) part(name, " up to ", largest(*teeth), " µm");
  return words;
}

}  // namespace whine
