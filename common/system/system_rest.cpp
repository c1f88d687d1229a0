#include "system/system_rest.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "base/format.h"
#include "gear/friction.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "system/drawing_remarks.h"
#include "system/face_mesh.h"
#include "system/flank_pressure.h"
#include "system/mesh_record.h"
#include "system/near_interference.h"
#include "system/rest_record.h"
#include "system/statics.h"

namespace whine {

using Eigen::Index;

const ReducedBody& body_of(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                           const std::string& gear) {
  for (size_t g = 0; g < settings.body.size() && g < bodies.size(); ++g)
    if (settings.body[g].first == gear) return bodies[g];
  fail(Failure::input, "[gear.", gear, "] has no body");
}

SystemModel elastic_system(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                           double depth) {
  const System& layout = settings.layout;
  std::vector<ReducedBody> of_body;
  for (size_t b = 0; b < layout.bodies.size(); ++b)
    if (layout.bodies[b].kind == System::BodyKind::gear)
      of_body.push_back(body_of(settings, bodies, settings.gear[b]));
  // A crack is in one gear: of planets that are one [gear] in the first.
  for (size_t b = 1; b < of_body.size(); ++b)
    if (std::find(settings.gear.begin(), settings.gear.begin() + static_cast<Index>(b), settings.gear[b]) !=
        settings.gear.begin() + static_cast<Index>(b)) {
      of_body[b].crack_compliance.resize(0, 0);
      of_body[b].crack_root_stress.resize(0, 0);
    }
  std::vector<GearMeshSpec> specs;
  specs.reserve(settings.section.size());
  for (size_t m = 0; m < settings.section.size(); ++m) {
    specs.push_back(settings.mesh[static_cast<size_t>(settings.section[m])]);
    for (size_t s = 0; s < kSides; ++s)
      if (const auto b = static_cast<size_t>(layout.meshes[m].side[s].body); settings.has_errors(b))
        specs.back().errors[s] = settings.errors[b];
  }
  SystemModel out = settings.fidelity.width == WidthModel::one
                        ? SystemModel(layout, of_body, specs)
                        : sliced_system(layout, of_body, specs, settings.section, settings.fidelity.width,
                                        face_points_of(settings.mesh, settings.contact), depth);
  take_friction(out);
  return out;
}

void take_friction(SystemModel& system) {
  const auto acts = [](const GearMeshModel& mesh) { return mesh.friction.acts(); };
  system.friction.clear();
  if (std::none_of(system.mesh.begin(), system.mesh.end(), acts)) return;
  const Eigen::VectorXd load = mesh_loads(system);
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const GearMeshModel& mesh = system.mesh[m];
    const double torque = load[static_cast<Index>(m)] * mesh.kinematics.gear(0).base_radius();
    system.friction.push_back(
        torque > 0 ? mesh.coefficient_of_friction(torque, mesh.friction.static_frequency) : 0);
  }
}

int hold_output(SystemModel& system) {
  if (!system.slides() || !can_roll(system.layout)) return -1;
  const int out = output_of(system.layout);
  for (System::Drive& drive : system.layout.drives)
    if (drive.body == out) drive.kind = System::DriveKind::held;
  return out;
}

double efficiency_at_rest(const System& layout, const Eigen::VectorXd& torque, int at_rest) {
  const auto turns = [&](int b) {  // in a mesh period, counter-clockwise, in the frame of the layout
    const System::Body& body = layout.bodies[static_cast<size_t>(b)];
    return body.teeth > 0 ? static_cast<double>(body.sense) / body.teeth : 0;
  };
  const double still = at_rest < 0 ? 0 : turns(at_rest);
  double in = 0, out = 0;
  for (int b = 0; b < static_cast<int>(layout.bodies.size()); ++b) {
    const System::Body& body = layout.bodies[static_cast<size_t>(b)];
    if (body.on != System::kGround) continue;
    const double work = torque[b] * body.sense * (turns(b) - still);
    (work > 0 ? in : out) += work;
  }
  return in > 0 ? -out / in : 0;
}

void take_masses(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                 System& layout) {
  for (size_t b = 0; b < layout.bodies.size(); ++b) {
    System::Body& body = layout.bodies[b];
    if (body.kind == System::BodyKind::carrier) continue;
    const ReducedBody& drawn = body_of(settings, bodies, settings.gear[b]);
    if (body.inertia == 0) body.inertia = drawn.inertia;
    if (!body.bearing.elastic()) continue;
    if (body.bearing.mass == 0) body.bearing.mass = drawn.mass;
    // A mass that was read off a page has some digits.
    constexpr double kDigits = 1e-3;
    if (body.bearing.mass < (1 - kDigits) * drawn.mass)
      fail(Failure::input, "mass_kg = ", body.bearing.mass, " in the [[bearing]] of '", settings.gear[b],
           "' lies below the mass of its own body, ", drawn.mass,
           " kg: it is that of all that moves with the hub; raise it, or leave it out");
  }
}

namespace {

// With each member of the train at rest, from the mean torques on its drives.
void take_efficiency(SystemStaticResult& out) {
  const System& layout = out.settings.layout;
  const auto bodies = static_cast<int>(layout.bodies.size());
  const Eigen::VectorXd torque = out.torque.colwise().mean().transpose();
  const bool planetary =
      std::any_of(layout.bodies.begin(), layout.bodies.end(),
                  [](const System::Body& body) { return body.kind == System::BodyKind::carrier; });
  out.efficiency.setZero(bodies);
  for (int b = 0; b < bodies; ++b)
    if (layout.bodies[static_cast<size_t>(b)].on == System::kGround)
      out.efficiency[b] = efficiency_at_rest(layout, torque, planetary ? b : -1);
}

// What friction takes, mesh by mesh of the scene, and the efficiencies.
Remark remark_on_friction(const SystemStaticResult& a) {
  const System& layout = a.settings.layout;
  std::vector<double> work(a.settings.mesh.size(), 0.0);
  double all = 0;
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    const double own = a.mesh[m].friction_work().mean();
    work[static_cast<size_t>(a.settings.section[m])] += own;
    all += own;
  }
  std::string shares, efficiencies;
  for (size_t m = 0; m < work.size(); ++m)
    shares += text(m == 0 ? "" : ", ", a.settings.mesh[m].gear[0], "-", a.settings.mesh[m].gear[1], " ",
                   fixed(all > 0 ? work[m] / all * 100 : 0, 1), " %");
  const bool planetary = std::any_of(layout.bodies.begin(), layout.bodies.end(),
                                     [](const auto& body) { return body.kind == System::BodyKind::carrier; });
  for (size_t b = 0; b < (planetary ? layout.bodies.size() : 1); ++b)
    if (layout.bodies[b].on == System::kGround)
      efficiencies +=
          text(efficiencies.empty() ? "" : ", ", fixed(a.efficiency[static_cast<Index>(b)] * 100, 3), " %",
               planetary ? text(" while ", layout.bodies[b].name, " is at rest") : std::string());
  return remark(false, "friction, ", in_words(a.settings.friction()), ", takes ", shown(all, 4),
                " J a mesh period (", shares, "): efficiency ", efficiencies,
                ". It acts by its moments and forces on the hubs and bends no teeth");
}

// What tilts a body that no shaft lets tilt.
void remark_on_tilting(const SystemStaticResult& a, std::vector<Remark>& out) {
  constexpr double kSeen = 1e-6;  // of the largest
  double most = 0;
  Index worst = 0;
  for (const MatrixRM& at : a.tilting_moment)
    for (Index b = 0; b < at.rows(); ++b)
      if (const double own = at.row(b).norm(); own > (1 + kSeen) * most) {
        most = own;
        worst = b;
      }
  if (!(most > 0)) return;
  out.push_back(remark(
      false, "axial forces and loads beside the middle of the face tilt bodies: by up to ", shown(most, 3),
      " N m '", a.settings.layout.bodies[static_cast<size_t>(worst)].name,
      "', whose bearing or shaft holds it. Bodies do not tilt here, which would move the load along the face; give misalignment_um"));
}

// Of the drawings, and of the pressure of the first mesh of each [[mesh]].
std::vector<Remark> remarks_on_train(const SystemStaticResult& a) {
  std::vector<Remark> out = drawing_remarks(a);
  if (a.settings.fidelity.width == WidthModel::slices) out.push_back(remark_on_slices());
  remark_on_tilting(a, out);
  const std::vector<int>& section = a.settings.section;
  for (size_t m = 0; m < a.mesh.size(); ++m) {
    const auto own = section.begin() + static_cast<Index>(m);
    if (std::find(section.begin(), own, section[m]) != own) continue;
    const std::vector<Remark> more = pressure_remarks(a.mesh[m]);
    out.insert(out.end(), more.begin(), more.end());
  }
  return out;
}

}  // namespace

namespace {

[[noreturn]] void reject(const char* section, size_t number, const auto&... words) {
  throw SectionError(section, number, text(words...));
}

void check_balance(const Scene& scene, const System& layout) {
  for (size_t c = 0; c < scene.carriers.size(); ++c)
    for (size_t b = 0; b < layout.bodies.size(); ++b) {
      const System::Body& body = layout.bodies[b];
      if (body.name != scene.carriers[c].name) continue;
      if (!layout.held(static_cast<int>(b)) && !(body.inertia > 0))
        reject(
            "carrier", c, "carrier '", body.name,
            "' may turn and has no inertia: give 'inertia_kgm2' or 'equivalent_mass_kg', or hold it by a [[drive]] with kind = \"held\"");
    }
  const std::vector<GearMeshSpec> specs = scene.specs();
  for (size_t m = 1; m < specs.size(); ++m)
    if (specs[m].contact_plane != specs[0].contact_plane)
      reject("mesh", m, "contact_plane = \"", specs[m].contact_plane, "\", and of the first [[mesh]] \"",
             specs[0].contact_plane, "\": bodies that take part in both have one; give all meshes the same");
  LoadBalance balance;
  try {
    balance = load_balance(layout);
  } catch (const Error& error) {
    reject("drive", 0, error.what());
  }
  if (!balance.balanced) reject("drive", 0, unbalanced_words(layout));
  if (balance.pulled_apart >= 0) {
    const auto section = static_cast<size_t>(
        sections_of(specs, gears_of(scene, layout), layout)[static_cast<size_t>(balance.pulled_apart)]);
    reject("mesh", section, "the torques of the drives pull the [[mesh]] of '", specs[section].gear[0],
           "' and '", specs[section].gear[1], "' apart (", shown_number(balance.load[balance.pulled_apart]),
           " N); ", kFlowOfPower);
  }
  if (!(balance.load.maxCoeff() > 0)) reject("drive", 0, kNoTorque);
}

}  // namespace

void check_at_rest(const Scene& scene, const System& layout) {
  if (!scene.pair()) check_balance(scene, layout);
  for (const auto& [section, words] : near_interferences(scene, layout, ForceBound::least)) {
    const auto& [driver, driven] = scene.meshes[section].spec.gear;
    reject("mesh", section, "[[mesh]] of '", driver, "' and '", driven, "': ", words);
  }
}

SystemStaticResult system_at_rest(const SystemStaticParameters& settings,
                                  const std::vector<ReducedBody>& bodies, double zone_factor) {
  SystemModel system = elastic_system(settings, bodies);
  hold_output(system);
  SystemStaticResult drawn;
  drawn.settings = settings;
  drawn.drawing.reserve(settings.body.size());
  for (const auto& [gear, hash] : settings.body) drawn.drawing.push_back(body_of(settings, bodies, gear));
  std::vector<GearPairParameters> of;
  of.reserve(system.mesh.size());
  if (settings.fidelity.width != WidthModel::one) drawn.settings.fidelity.contact = ContactModel::line;
  for (size_t m = 0; m < system.mesh.size(); ++m) of.push_back(mesh_parameters(drawn, m));
  SystemStaticResult out = record_rest(system, settings.section, of, zone_factor, true);
  out.settings = drawn.settings;
  out.drawing = std::move(drawn.drawing);
  take_masses(settings, bodies, out.settings.layout);
  out.body_names = body_names_of(settings.layout);
  out.mesh_names = mesh_names_of(settings.layout);
  for (StaticResult& mesh : out.mesh) add_harmonics(mesh);
  if (system.slides()) take_efficiency(out);
  out.remarks = remarks_on_train(out);
  if (system.slides()) out.remarks.push_back(remark_on_friction(out));
  return out;
}

}  // namespace whine
