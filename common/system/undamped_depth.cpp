#include "system/undamped_depth.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "gear/face_width.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "system/load_balance.h"

namespace whine {

double widest_half_width(const HalfPlaneSurface& driver, const HalfPlaneSurface& driven, double depth) {
  return 2 * std::exp((driver.line(1, depth) + driven.line(1, depth)) /
                      (driver.coefficient() + driven.coefficient()));
}

std::string beyond_undamped_depth(double half_width, double widest, double depth) {
  return text(
      "contact reaches ", millimetres(half_width),
      " to either side, and undamped_depth_mm = ", shown_number(depth * 1e3), " holds ", millimetres(widest),
      ": under a wider one what gives way without damping would push back. Raise undamped_depth_mm in [damping] to ",
      shown_number(depth * 1e3 * half_width / widest * 1.05), " or more, or lower the torque");
}

std::string torque_in_n_mm(double torque, const std::function<bool(double)>& passes) {
  constexpr double kFewNewtonMetres = 1000;  // N mm are large numbers
  if (torque < kFewNewtonMetres || !passes(torque / 1e3)) return "";
  return text(". torque_Nm = ", shown_number(torque), " may be N mm: ", shown_number(torque / 1e3),
              " N m pass");
}

namespace {

// What of a scene in motion the judgement needs.
struct Motion {
  Fidelity fidelity;
  Damping damping;
  double shortest_step = 0;  // s
};

Motion motion_of(const Scene& scene, ContactModel contact) {
  Motion out{
      scene.fidelity, scene.damping,
      1 / std::max(scene.time.min_sample_rate, scene.time.steps_per_period * scene.operation.frequency_to)};
  out.fidelity.contact = contact;
  return out;
}

// force: N, of the mesh. "" where its contact is held.
std::string judged(const SceneGear& driver, const SceneGear& driven, const GearMeshSpec& mesh, double force,
                   const Motion& motion) {
  const bool lines = motion.fidelity.contact == ContactModel::line;
  const BodyModel body = motion.fidelity.body;
  // All flexibility gives way at once.
  if (!lines && (body == BodyModel::full || body == BodyModel::quasi_static ||
                 motion.damping.rayleigh_stiffness < motion.shortest_step))
    return "";
  const double width = contact_width(driver.design, driven.design), depth = motion.damping.undamped_depth;
  const HalfPlaneSurface surface[2] = {
      HalfPlaneSurface(in_contact_plane(driver.material, mesh.contact_plane), width),
      HalfPlaneSurface(in_contact_plane(driven.material, mesh.contact_plane), width)};
  const double radius = GearPair(driver.design, driven.design, mesh.centre_distance)
                            .relative_curvature_radius(0.0),
               half_width =
                   std::sqrt(2 * radius * force * (surface[0].coefficient() + surface[1].coefficient())),
               widest = (lines ? std::exp(-0.125) : 1.0) * widest_half_width(surface[0], surface[1], depth);
  return half_width > widest ? beyond_undamped_depth(half_width, widest, depth) : "";
}

// At the largest of the torques.
void check_pair(const Scene& scene, const ScenePlace& where) {
  const SceneGear &driver = scene.gear(scene.mesh().gear[0]), &driven = scene.gear(scene.mesh().gear[1]);
  if (scene.operation.torques.empty()) return;
  const double torque = *std::max_element(scene.operation.torques.begin(), scene.operation.torques.end());
  const auto under = [&](double given) {
    return judged(driver, driven, scene.mesh(), given / ToothGeometry(driver.design).base_radius(),
                  motion_of(scene, scene.fidelity.contact));
  };
  const std::string words = under(torque);
  if (words.empty()) return;
  fail(Failure::input, where({"damping", "operation"}, words), ": at ", shown_number(torque), " N m ", words,
       torque_in_n_mm(torque, [&](double less) { return under(less).empty(); }));
}

}  // namespace

void check_undamped_depth(const Scene& scene, const System& layout, const ScenePlace& where) {
  if (scene.pair()) return check_pair(scene, where);
  if (scene.rigid() || !(scene.operation.frequency_to > 0)) return;
  const LoadBalance balance = load_balance(layout);
  const std::vector<GearMeshSpec> specs = scene.specs();
  const std::vector<int> section = sections_of(specs, gears_of(scene, layout), layout);
  for (size_t m = 0; m < section.size(); ++m) {
    const GearMeshSpec& spec = specs[static_cast<size_t>(section[m])];
    const std::string words =
        judged(scene.gear(spec.gear[0]), scene.gear(spec.gear[1]), spec,
               balance.load[static_cast<Eigen::Index>(m)], motion_of(scene, ContactModel::line));
    if (!words.empty())
      fail(Failure::input, where({"damping", "mesh"}, words), ": [[mesh]] of '", spec.gear[0], "' and '",
           spec.gear[1], "': ", words);
  }
}

}  // namespace whine
