#include "system/system_rest.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/format.h"
#include "gear/friction.h"
#include "gear/system_layout.h"
#include "gear/tooth_errors.h"
#include "signal/spectrum.h"
#include "system/drawing_remarks.h"
#include "system/near_interference.h"
#include "system/system_statics.h"

namespace whine {

using Eigen::Index;

namespace {

const ReducedBody& body_of(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                           const std::string& gear) {
  for (size_t g = 0; g < settings.body.size() && g < bodies.size(); ++g)
    if (settings.body[g].first == gear) return bodies[g];
  fail(Failure::input, "[gear.", gear, "] has no body");
}

}  // namespace

int hunting_periods(const SystemStaticParameters& settings) {
  std::vector<int> teeth;
  for (size_t b = 0; b < settings.errors.size(); ++b)
    if (settings.has_errors(b)) teeth.push_back(settings.layout.bodies[b].teeth);
  return hunting_periods_of(teeth);
}

SystemModel elastic_system(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies) {
  const System& layout = settings.layout;
  std::vector<ReducedBody> of_body;
  for (size_t b = 0; b < layout.bodies.size(); ++b)
    if (layout.bodies[b].kind == System::BodyKind::gear)
      of_body.push_back(body_of(settings, bodies, settings.gear[b]));
  std::vector<GearMeshSpec> specs;
  specs.reserve(settings.section.size());
  for (size_t m = 0; m < settings.section.size(); ++m) {
    specs.push_back(settings.mesh[static_cast<size_t>(settings.section[m])]);
    for (size_t s = 0; s < kSides; ++s)
      if (const auto b = static_cast<size_t>(layout.meshes[m].side[s].body); settings.has_errors(b))
        specs.back().errors[s] = settings.errors[b];
  }
  SystemModel out(layout, of_body, specs);
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

void take_pairs(const std::vector<SystemSolution>& solutions, Index meshes, SystemStaticResult& out) {
  int lowest = -1, highest = 1;
  for (const SystemSolution& at : solutions)
    for (const LoadedSegment& load : at.loads)
      if (load.force > 0) {
        lowest = std::min(lowest, load.pair);
        highest = std::max(highest, load.pair);
      }
  out.pair = Eigen::VectorXi::LinSpaced(highest - lowest + 1, lowest, highest);
  const MatrixRM none = MatrixRM::Zero(meshes, out.pair.size());
  out.tooth_load.assign(solutions.size(), none);
  out.contact_pressure = out.tooth_load;
  for (size_t i = 0; i < solutions.size(); ++i)
    for (const LoadedSegment& load : solutions[i].loads)
      if (load.force > 0) {
        out.tooth_load[i](load.mesh, load.pair - lowest) = load.force;
        out.contact_pressure[i](load.mesh, load.pair - lowest) = load.patch.pressure;
      }
}

// Torques on bodies and forces on bearings; those of carriers follow from their planets.
void take_balance(const SystemModel& system, const SystemSolution& at, Index row, SystemStaticResult& out) {
  const System& layout = system.layout;
  MatrixRM& force = out.bearing_force[static_cast<size_t>(row)];
  for (size_t b = 0; b < system.body.size(); ++b) {
    force.row(static_cast<Index>(b)) = at.bearing_force[b].transpose();
    double moment = 0;  // N, of the contact forces over the base radius
    for (size_t m = 0; m < system.mesh.size(); ++m)
      if (const int side = system.side_of(static_cast<int>(b), static_cast<int>(m)); side >= 0)
        moment += side == 0 ? at.mesh_force[m] : -at.driven_force[m];
    const int number = static_cast<int>(b);
    out.torque(row, number) =
        system.layout.held(number) ? moment * system.base_radius(number) : system.layout.torque(number);
  }
  for (size_t c = system.body.size(); c < layout.bodies.size(); ++c)
    if (const int number = static_cast<int>(c); !layout.held(number))
      out.torque(row, number) = layout.torque(number);
  for (size_t b = 0; b < system.body.size(); ++b) {
    const int on = layout.bodies[b].on;
    if (on == System::kGround) continue;
    const System::Body& carrier = layout.bodies[static_cast<size_t>(on)];
    const double x = layout.bodies[b].centre[0] - carrier.centre[0],
                 y = layout.bodies[b].centre[1] - carrier.centre[1];
    const Vec2& pin = at.bearing_force[b];
    force.row(on) += pin.transpose();
    if (!layout.held(on)) continue;
    out.torque(row, on) -= carrier.sense * (x * pin.y() - y * pin.x());
  }
}

void take_phase(const SystemModel& system, const SystemSolution& at, Index row, SystemStaticResult& out) {
  const SystemStaticParameters& settings = out.settings;
  std::vector<double> carried(settings.mesh.size(), 0.0);
  for (size_t m = 0; m < system.mesh.size(); ++m)
    carried[static_cast<size_t>(settings.section[m])] += at.mesh_force[m];
  for (size_t m = 0; m < system.mesh.size(); ++m) {
    const auto column = static_cast<Index>(m);
    const double all = carried[static_cast<size_t>(settings.section[m])];
    out.transmission_error(row, column) = at.transmission_error[m];
    out.mesh_deflection(row, column) = at.deflection[m];
    out.mesh_force(row, column) = at.mesh_force[m];
    out.load_share(row, column) = all > 0 ? at.mesh_force[m] / all : 0;
  }
  for (size_t b = 0; b < system.layout.bodies.size(); ++b) {
    const auto column = static_cast<Index>(b);
    out.rotation(row, column) = at.equilibrium.x[column];
    if (const Bearing& bearing = system.layout.bodies[b].bearing; bearing.elastic())
      out.translation[static_cast<size_t>(row)].row(column) =
          at.bearing_force[b].transpose() / bearing.stiffness;
  }
  out.mesh_stiffness[static_cast<size_t>(row)] = at.mesh_stiffness;
  for (size_t m = 0; m < system.friction.size(); ++m)
    out.friction_work(row, static_cast<Index>(m)) = at.friction_work[m];
  out.least_gap[row] = at.equilibrium.certificate.least_gap;
  out.least_force[row] = at.equilibrium.certificate.least_force;
  out.torque_residual[row] = at.equilibrium.residual;
  take_balance(system, at, row, out);
}

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
  for (Index m = 0; m < a.friction_work.cols(); ++m)
    work[static_cast<size_t>(a.settings.section[static_cast<size_t>(m)])] += a.friction_work.col(m).mean();
  const double all = a.friction_work.rowwise().sum().mean();
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

void take_harmonics(SystemStaticResult& out) {
  constexpr int kMostHarmonics = 40, kMostOrders = 1 << 20;
  const auto taken = [&](int most, int periods) {
    const int count = resolved_harmonics(out.mesh_phase.size(), most, periods);
    MatrixRM amplitude(count + 1, out.transmission_error.cols());
    for (Index m = 0; m < out.transmission_error.cols(); ++m) {
      const Harmonics h = harmonics(Eigen::VectorXd(out.transmission_error.col(m)), count, periods);
      amplitude(0, m) = h.mean;
      amplitude.col(m).tail(count) = h.amplitude;
    }
    return amplitude;
  };
  out.transmission_error_harmonic = taken(kMostHarmonics, out.hunting_periods);
  if (out.hunting_periods > 1) out.transmission_error_order = taken(kMostOrders, 1);
}

}  // namespace

void check_at_rest(const SystemScene& scene, const System& layout) {
  const auto reject = [](const char* section, size_t number, const auto&... words) {
    throw SystemSceneError(section, number, text(words...));
  };
  for (size_t c = 0; c < scene.carriers.size(); ++c)
    for (size_t b = 0; b < layout.bodies.size(); ++b) {
      const System::Body& body = layout.bodies[b];
      if (body.name != scene.carriers[c].name) continue;
      if (!layout.held(static_cast<int>(b)) && !(body.inertia > 0))
        reject(
            "carrier", c, "carrier '", body.name,
            "' may turn and has no inertia: give 'inertia_kgm2' or 'equivalent_mass_kg', or hold it by a [[drive]] with kind = \"held\"");
    }
  std::vector<GearMeshSpec> specs;
  for (const SystemScene::Mesh& mesh : scene.meshes) specs.push_back(mesh.spec);
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
           "' and '", specs[section].gear[1], "' apart (", balance.load[balance.pulled_apart], " N); ",
           kFlowOfPower);
  }
  if (!(balance.load.maxCoeff() > 0)) reject("drive", 0, kNoTorque);
  for (const auto& [section, words] : near_interferences(scene, layout, ForceBound::least))
    reject("mesh", section, "[[mesh]] of '", specs[section].gear[0], "' and '", specs[section].gear[1],
           "': ", words);
}

namespace {

// What is kept of each position until the result is written: loads and forces of the strips, and the result itself.
void require_rows(const SystemModel& system, int periods, int positions) {
  constexpr double kMostMemory = 4e9;  // bytes
  const auto meshes = static_cast<double>(system.mesh.size()),
             bodies = static_cast<double>(system.body.size());
  constexpr double kOfMesh = 100, kOfBody = 20;  // numbers: strips of its pairs among them; places and forces
  const double memory = 8.0 * positions * periods * (meshes * (kOfMesh + 2 * meshes) + bodies * kOfBody);
  if (memory > kMostMemory)
    fail(Failure::input,
         periods > 1 ? text("the same teeth meet again after ", periods, " mesh periods; ") : "",
         static_cast<double>(positions) * periods, " positions of ", system.mesh.size(), " meshes need ",
         memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; lower positions in [discretisation]",
         periods > 1 ? ", or give errors to fewer gears" : "");
}

}  // namespace

SystemStaticResult system_at_rest(const SystemStaticParameters& settings,
                                  const std::vector<ReducedBody>& bodies) {
  SystemModel system = elastic_system(settings, bodies);
  hold_output(system);
  const int periods = hunting_periods(system);
  require_rows(system, periods, settings.contact.positions);
  const std::vector<SystemSolution> solutions = rest_over_period(
      system, settings.fidelity.contact, settings.contact.strips, settings.contact.positions);
  const auto phases = static_cast<Index>(solutions.size()),
             all = static_cast<Index>(settings.layout.bodies.size()),
             meshes = static_cast<Index>(system.mesh.size());
  SystemStaticResult out;
  out.settings = settings;
  out.hunting_periods = periods;
  for (const auto& [gear, hash] : settings.body) out.drawing.push_back(body_of(settings, bodies, gear));
  take_masses(settings, bodies, out.settings.layout);
  out.contact_ratio.resize(meshes);
  for (Index m = 0; m < meshes; ++m)
    out.contact_ratio[m] = system.mesh[static_cast<size_t>(m)].kinematics.contact_ratio();
  for (Eigen::VectorXd* list : {&out.mesh_phase, &out.least_gap, &out.least_force, &out.torque_residual})
    list->setZero(phases);
  out.rotation = out.torque = MatrixRM::Zero(phases, all);
  out.transmission_error = out.mesh_deflection = out.mesh_force = out.load_share =
      MatrixRM::Zero(phases, meshes);
  out.translation.assign(solutions.size(), MatrixRM::Zero(all, 2));
  out.bearing_force = out.translation;
  out.mesh_stiffness.assign(solutions.size(), MatrixRM::Zero(meshes, meshes));
  if (system.slides()) {
    out.friction_coefficient = Eigen::Map<const Eigen::VectorXd>(system.friction.data(), meshes);
    out.friction_work = MatrixRM::Zero(phases, meshes);
  }
  for (Index i = 0; i < phases; ++i) {
    out.mesh_phase[i] = static_cast<double>(i) / static_cast<double>(settings.contact.positions);
    take_phase(system, solutions[static_cast<size_t>(i)], i, out);
  }
  take_pairs(solutions, meshes, out);
  take_harmonics(out);
  if (system.slides()) take_efficiency(out);
  out.remarks = drawing_remarks(out);
  if (system.slides()) out.remarks.push_back(remark_on_friction(out));
  return out;
}

}  // namespace whine
