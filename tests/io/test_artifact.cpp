// Artifacts: what is written is what is read, whole or not at all, and every wrong file is rejected by name.
#include <doctest/doctest.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "base/error.h"
#include "base/tool.h"
#include "gear/system_layout.h"
#include "io/artifact.h"
#include "io/artifact_place.h"
#include "io/body_codec.h"
#include "io/branch_codec.h"
#include "io/compatibility.h"
#include "io/datasets.h"
#include "io/error_budget_codec.h"
#include "io/h5.h"
#include "io/harris_map_codec.h"
#include "io/impact_codec.h"
#include "io/jump_map_codec.h"
#include "io/loaded_codec.h"
#include "io/mesh_codec.h"
#include "io/modes_codec.h"
#include "io/named_files.h"
#include "io/picture_sources.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/ranges.h"
#include "io/readings_codec.h"
#include "io/response_codec.h"
#include "io/runup_codec.h"
#include "io/scene_words.h"
#include "io/static_codec.h"
#include "io/study.h"
#include "io/study_codec.h"
#include "io/summary.h"
#include "io/sweep_codec.h"
#include "io/system_branch_codec.h"
#include "io/system_impact_codec.h"
#include "io/system_scene.h"
#include "io/system_static_codec.h"
#include "io/system_sweep_codec.h"
#include "io/variant_codec.h"
#include "io/vtk.h"
#include "planetary_train.h"
#include "relative.h"
#include "small_system.h"
#include "system/natural_modes.h"

using namespace whine;
namespace fs = std::filesystem;

namespace {

// A folder of its own for each case, in which the case works, removed at the end; WHINE_KEEP=folder keeps a copy.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "whine-files-XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
    fs::current_path(path_);
  }
  ~Folder() {
    fs::current_path(before_);
    std::error_code ignored;
    if (const char* place = std::getenv("WHINE_KEEP"))
      fs::copy(path_, place, fs::copy_options::recursive | fs::copy_options::overwrite_existing, ignored);
    fs::remove_all(path_);
  }
  std::vector<std::string> names(const fs::path& where = ".") const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(where)) out.push_back(entry.path().filename().string());
    std::sort(out.begin(), out.end());
    return out;
  }

 private:
  fs::path before_ = fs::current_path(), path_;
};

// Kind and message of the Error that f throws; kind 0 if none.
struct Caught {
  int kind = 0;
  std::string message;
  bool says(const std::string& part) const { return message.find(part) != std::string::npos; }
};

Caught caught(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return {static_cast<int>(error.kind()), error.what()};
  }
  return {};
}

constexpr int kInput = static_cast<int>(Failure::input), kIo = static_cast<int>(Failure::io),
              kNumerical = static_cast<int>(Failure::numerical);

// Values without a short decimal form, so that a round trip through text or single precision would show; above 0, as many
// datasets must be.
Eigen::VectorXd odd_vector(Eigen::Index n, double scale) {
  Eigen::VectorXd out(n);
  for (Eigen::Index i = 0; i < n; ++i)
    out[i] = scale * (1.1 + std::sin(1.0 + 3.0 * static_cast<double>(i))) / 2.1;
  return out;
}

MatrixRM odd_matrix(Eigen::Index rows, Eigen::Index columns, double scale) {
  const Eigen::VectorXd flat = odd_vector(rows * columns, scale);
  return Eigen::Map<const MatrixRM>(flat.data(), rows, columns);
}

GearDesign odd_design(int teeth) {
  GearDesign out;
  out.teeth = teeth;
  out.module = 0.003 * std::sqrt(1.1);
  out.pressure_angle = 20 * std::numbers::pi / 180;
  out.profile_shift = -0.1 / 3;
  out.addendum = 1.0 / 3;
  out.dedendum = 1.3 / 1.1;
  out.rack_tip_radius = 0.38 / 1.7;
  out.tooth_thinning = 1e-5 / 3;
  out.face_width = 0.0254 / 1.3;
  out.bore_radius = 0.04 / 1.7;
  return out;
}

bool same(const GearDesign& a, const GearDesign& b) {
  return a.teeth == b.teeth && a.module == b.module && a.pressure_angle == b.pressure_angle &&
         a.profile_shift == b.profile_shift && a.addendum == b.addendum && a.dedendum == b.dedendum &&
         a.rack_tip_radius == b.rack_tip_radius && a.tooth_thinning == b.tooth_thinning &&
         a.face_width == b.face_width && a.bore_radius == b.bore_radius;
}

bool same(const GearMeshSpec& a, const GearMeshSpec& b) {
  return a.gear == b.gear && a.centre_distance == b.centre_distance && a.corner.enabled == b.corner.enabled &&
         a.corner.largest_angle == b.corner.largest_angle && a.contact_plane == b.contact_plane;
}

bool same(const Damping& a, const Damping& b) {
  return a.rayleigh_mass == b.rayleigh_mass && a.rayleigh_stiffness == b.rayleigh_stiffness &&
         a.undamped_depth == b.undamped_depth && a.bearing_ratio == b.bearing_ratio;
}

bool same(const BodyDiscretisation& a, const BodyDiscretisation& b) {
  return a.element_size == b.element_size && a.element_order == b.element_order && a.modes == b.modes &&
         a.near_field == b.near_field && a.matching_depth == b.matching_depth;
}

bool same(const Material& a, const Material& b) {
  return a.youngs_modulus == b.youngs_modulus && a.poisson_ratio == b.poisson_ratio &&
         a.density == b.density && a.plane_stress == b.plane_stress;
}

bool same(const ContactDiscretisation& a, const ContactDiscretisation& b) {
  return a.strips == b.strips && a.positions == b.positions;
}

bool same(const TimeDiscretisation& a, const TimeDiscretisation& b) {
  return a.steps_per_period == b.steps_per_period && a.steady_state == b.steady_state &&
         a.min_sample_rate == b.min_sample_rate && a.periodicity == b.periodicity;
}

// Both gears of a pair, all different, so that swapped roles show.
template <class Artifact>
void set_pair(Artifact& a) {
  a.gear[0].design = odd_design(50);
  a.gear[1].design = odd_design(35);
  a.gear[0].material = {207e9 / 1.1, 0.3 / 1.1, 7600 / 1.1, false};
  a.gear[1].material = {110e9 / 1.3, 0.27 / 1.1, 7200 / 1.3, true};
  a.gear[0].discretisation = {0.0004 / 1.3, 2, 5};
  a.gear[1].discretisation = {0.0007 / 1.3, 1, 12, NearField::matching, 0.001 / 1.3};
}

template <class Artifact>
bool same_pair(const Artifact& a, const Artifact& b) {
  return same(a.gear[0].design, b.gear[0].design) && same(a.gear[1].design, b.gear[1].design) &&
         same(a.gear[0].material, b.gear[0].material) && same(a.gear[1].material, b.gear[1].material) &&
         same(a.gear[0].discretisation, b.gear[0].discretisation) &&
         same(a.gear[1].discretisation, b.gear[1].discretisation);
}

// A ring sector of two four-node elements, one on the other, closing exactly after a turn of 360/teeth
// degrees.
SectorGrid small_mesh() {
  SectorGrid a;
  a.design = odd_design(12);
  a.discretisation = {0.0004 / 1.3, 1, 7};
  const double half = std::numbers::pi / a.design.teeth;
  a.node_position.resize(6, 2);
  for (int k = 0; k < 3; ++k) {
    const double r = 0.01 * (k + 1);
    a.node_position.row(2 * k) << r * std::sin(half), r * std::cos(half);       // clockwise edge, x > 0
    a.node_position.row(2 * k + 1) << -r * std::sin(half), r * std::cos(half);  // counter-clockwise edge
  }
  a.element_node.resize(2, 4);
  a.element_node << 1, 0, 2, 3, 3, 2, 4, 5;
  a.element_region = Eigen::VectorXi{{0, 1}};
  a.bore_node = Eigen::VectorXi{{0, 1}};
  a.side_node.resize(3, 2);
  a.side_node << 0, 1, 2, 3, 4, 5;
  a.flank_node = Eigen::VectorXi{{3, 5}};
  a.flank_roll_angle = Eigen::VectorXd{{0.1 / 3, 0.4 / 3}};
  return a;
}

ReducedBody small_body() {
  ReducedBody a;
  a.design = odd_design(50);
  a.material = {207e9 / 1.1, 0.3 / 1.1, 7600 / 1.1, false};
  a.discretisation = {0.0004 / 1.3, 2, 5, NearField::matching, 0.001 / 1.3};
  a.inertia = 0.01 / 3;
  a.mass = 4.0 / 3;
  a.eigenfrequency = odd_vector(3, 1e4).cwiseAbs();
  a.nodal_diameter = Eigen::VectorXi{{0, 1, 1}};
  a.component = Eigen::VectorXi{{0, 0, 1}};
  a.inertia_coupling = odd_vector(3, 0.1);
  a.translation_coupling = odd_matrix(3, 2, 1);
  a.flank_position = Eigen::Vector4d(0.1 / 3, 0.2 / 3, 0.3 / 3, 0.5 / 3);
  a.flank_mode = odd_matrix(4, 3, 2);
  a.offsets = 1;
  a.compliance = {odd_matrix(4, 4, 1e-9), odd_matrix(4, 4, 1e-10)};
  a.far_compliance = odd_matrix(4 * (25 - 1), 4, 1e-11);
  a.back_compliance = odd_matrix(4 * 50, 4, 1e-10);
  a.back_flank_mode = odd_matrix(4, 3, 3);
  a.root_arc_length = Eigen::Vector3d(0.1e-3 / 3, 0.5e-3 / 3, 2e-3 / 3);
  a.root_angle = Eigen::Vector3d(0.3 / 1.1, 0.7 / 1.1, 1.5 / 1.1);
  a.root_stress = {odd_matrix(6, 4, 1e4), odd_matrix(6, 4, 4e4), odd_matrix(6, 4, 1.1e4)};
  a.reference_depth = 0.001 / 3;
  a.asymmetry = 1e-4 / 3;
  a.least_eigenvalue = 1e-13 / 3;
  a.vtk_point = odd_matrix(4, 2, 0.05);
  a.vtk_cell.resize(1, 4);
  a.vtk_cell << 0, 1, 2, 3;
  // Point data are single precision in the file: multiples of 1/8 pass through exactly.
  MatrixRM shape(4, 2);
  shape << 0.125, 0.25, -0.5, 1, 2, -3, 0, 0.375;
  a.vtk_point_data = {{"mode_1", shape}, {"mode_2", -shape}};
  return a;
}

StaticResult small_static() {
  StaticResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.05 / 3}};
  a.contact = {17, 128};
  a.torque = 150.0 / 1.3;
  a.contact_ratio = 1.7547 / 1.1;
  a.mesh_phase = Eigen::VectorXd{{0, 1.0 / 3, 2.0 / 3}};
  a.transmission_error = odd_vector(3, 1e-5);
  a.unloaded_error = odd_vector(3, 1e-6);
  a.stiffness_secant = odd_vector(3, 4e8);
  a.stiffness_tangent = odd_vector(3, 4.1e8);
  a.pair = Eigen::VectorXi{{-1, 0, 1}};
  a.tooth_load = odd_matrix(3, 3, 2e3);
  a.contact_pressure = odd_matrix(3, 3, 5e8);
  a.contact_half_width = odd_matrix(3, 3, 1e-4);
  a.root_stress = {odd_matrix(3, 3, 9e7), odd_matrix(3, 3, 8e7)};
  a.root_stress_max = Eigen::Vector2d(1e8 / 1.1, 1e8 / 1.2);
  a.root_stress_angle = Eigen::Vector2d(0.7 / 1.1, 0.8 / 1.1);
  a.root_stress_phase = Eigen::Vector2d(0.1 / 1.1, -0.1 / 1.1);
  a.loss_factor = 0.1 / 1.1;
  a.transmission_error_harmonic = odd_vector(2, 1e-6);
  a.stiffness_harmonic = odd_vector(2, 1e7);
  a.mean_stiffness = 463.5e6 / 1.1;
  a.least_gap = 1e-9 / 3;
  a.least_force = 1e-3 / 3;
  a.torque_residual = 1e-12 / 3;
  a.backlash_margin = 1e-5 / 3;
  return a;
}

ErrorBudgetResult small_budget() {
  ErrorBudgetResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.05 / 3}, ContactPlane::strain};
  a.fidelity.contact = ContactModel::line;
  a.contact = {17, 128};
  a.torque = 150.0 / 1.3;
  a.refinement = {"strips, flank table, elements", odd_vector(3, 1e-4), odd_vector(3, 3e-4),
                  odd_vector(3, 5e-4), odd_matrix(3, 5, 2e-4)};
  a.choice = {"matching at 1 mm, contact strips",
              odd_vector(2, 1e-2),
              odd_vector(2, 3e-2),
              {},
              odd_matrix(2, 5, 2e-2)};
  a.refinement.root_stress_change = odd_vector(3, 7e-3);
  a.root = {odd_vector(3, 1e-3).cwiseAbs(), odd_matrix(3, 2, 1e8)};
  return a;
}

ImpactResult small_impact() {
  ImpactResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.1 / 3}};
  a.fidelity = {BodyModel::relaxed, ContactModel::strips, Integrator::newmark};
  a.contact = {17, 128};
  a.damping = {1.0 / 3, 7.7e-6 / 1.1, 0.5e-3 / 1.1, 0.005 / 1.1};
  a.torque = 150;
  a.torque_step = 0.01 / 3;
  a.inertia[0] = 0.0148 / 1.1;
  a.inertia[1] = 0.0148 / 1.3;
  a.mean_stiffness = 4e8 / 1.1;
  a.bearing_damper[0] = 1.0 / 3;
  a.bearing_damper[1] = 2.0 / 3;
  a.contact_state = {ContactState::one, ContactState::two, ContactState::mean};
  a.natural_frequency = odd_vector(3, 3e3);
  a.damping_ratio = odd_vector(3, 0.07);
  a.undamped_frequency = odd_vector(3, 2.9e3);
  a.state_phase = odd_vector(2, 0.5);
  a.time = odd_vector(5, 1e-3);
  a.transmission_error = odd_matrix(2, 5, 1e-8);
  a.mesh_phase = odd_vector(4, 0.7);
  a.loaded_pairs = Eigen::VectorXi{{1, 2, 2, 2}};
  a.phase_natural_frequency = odd_vector(4, 3e3);
  a.phase_damping_ratio = odd_vector(4, 0.07);
  a.phase_undamped_frequency = odd_vector(4, 2.8e3);
  a.eigen_frequency = odd_vector(4, 2.7e3);
  a.eigen_damping_ratio = odd_vector(4, 0.06);
  a.fit_residual = odd_vector(4, 1e-8);
  a.least_mesh_force = 0.99 / 1.1;
  return a;
}

SweepResult small_pair_sweep() {
  SweepResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {false, std::numeric_limits<double>::infinity()}};
  a.fidelity = {BodyModel::relaxed, ContactModel::strips, Integrator::newmark};
  a.contact = {17, 128};
  a.time = {64, 250e3 / 1.1, 1e-6 / 3};
  a.damping = {1.0 / 3, 7.7e-6 / 1.1, 0.5e-3 / 1.1, 0.005 / 1.1};
  a.torque = 150;
  a.inertia[0] = 0.0148 / 1.1;
  a.inertia[1] = 0.0148 / 1.3;
  a.mean_stiffness = 4e8 / 1.1;
  a.bearing_damper[0] = 1.0 / 3;
  a.bearing_damper[1] = 2.0 / 3;
  a.natural_frequency = 2900.0 / 1.3;
  a.direction = Direction::down;
  a.mesh_frequency = Eigen::VectorXd{{4000, 3980 + 1.0 / 3}};
  a.transmission_error = odd_matrix(2, 64, 1e-5);
  a.mesh_force = odd_matrix(2, 64, 3e3);
  a.pair = Eigen::VectorXi{{-1, 0, 1}};
  a.root_stress = {odd_matrix(2, 64, 9e7), odd_matrix(2, 64, 8e7)};
  a.root_stress_angle = {odd_vector(2, 0.7), odd_vector(2, 0.8)};
  a.root_stress_phase = {odd_vector(2, 0.3), odd_vector(2, -0.4)};
  a.tooth_load = {odd_matrix(64, 3, 1e3), odd_matrix(64, 3, 2e3)};
  a.periods = Eigen::VectorXi{{80, 120}};
  a.residual = odd_vector(2, 1e-7);
  a.period_multiple = Eigen::VectorXi{{1, 2}};
  a.energy_imbalance = odd_vector(2, 1e-9);
  a.energy = MatrixRM::Constant(2, kEnergyLines.size(), 1e-3);
  a.energy(1, 3) = -2e-4;
  a.drift_force = odd_vector(2, 1e-3).cwiseAbs();
  a.least_gap = 1e-10 / 3;
  a.least_force = 1e-4 / 3;
  a.fallbacks = 3;
  a.backlash_margin = 1e-5 / 3;
  a.jump_frequency = Eigen::VectorXd();
  a.jump_width = Eigen::VectorXd();
  return a;
}

// Records are stored in single precision.
RunupResult small_runup() {
  const auto single = [](const auto& x) { return x.template cast<float>().template cast<double>().eval(); };
  const SweepResult other = small_pair_sweep();
  RunupResult a;
  static_cast<MotionParameters&>(a) = other;
  a.torque = 150;
  a.mean_stiffness = other.mean_stiffness;
  a.bearing_damper = other.bearing_damper;
  a.natural_frequency = other.natural_frequency;
  a.direction = Direction::down;
  a.ramp = {4000, 3900 + 1.0 / 3, 100.0 / 3};
  a.mesh_acceleration = -100.0 / 3 / 60 * 50;
  a.sample_rate = 48000;
  a.pair = Eigen::VectorXi{{-1, 0, 1}};
  RunupSamples& s = a.samples;
  s.time = odd_vector(40, 1e-3);
  s.mesh_frequency = single(odd_vector(40, 4e3));
  s.transmission_error = single(odd_vector(40, 1e-5));
  s.mesh_force = single(odd_vector(40, 3e3));
  s.tooth_load = single(odd_matrix(40, 3, 1e3));
  RunupPeriods& p = a.periods;
  p.time = odd_vector(5, 1e-3);
  p.mesh_frequency = single(odd_vector(5, 4e3));
  p.dte_rms = single(odd_vector(5, 1e-6));
  p.dte_mean = single(odd_vector(5, 1e-5));
  p.tooth_load_max = single(odd_vector(5, 4e3));
  p.separation_fraction = single(odd_vector(5, 0.01));
  p.root_stress_sustained = {single(odd_vector(5, 2e8)), single(odd_vector(5, 1e8))};
  a.root_stress = true;
  a.least_gap = 1e-10 / 3;
  a.least_force = 1e-4 / 3;
  a.fallbacks = 3;
  a.drift_force = 1e-3 / 3;
  a.backlash_margin = 1e-5 / 3;
  return a;
}

ResponseResult small_response() {
  ResponseResult a;
  set_pair(a);
  a.inertia[0] = 0.0148 / 1.1;
  a.inertia[1] = 0.0148 / 1.3;
  a.contact = {17, 128};
  a.time = {64, 250e3 / 1.1, 1e-6 / 3};
  a.torque = 150;
  a.direction = Direction::up;
  a.model = "finite elements";
  a.mesh_frequency = odd_vector(2, 1e3).cwiseAbs();
  a.dte_rms = odd_vector(2, 1e-6);
  a.dte_mean = odd_vector(2, 1e-5);
  a.dte_harmonic = odd_matrix(2, 10, 1e-6);
  a.tooth_load_max = odd_vector(2, 4e3);
  a.root_stress_max = {odd_vector(2, 3e8), odd_vector(2, 2e8)};
  a.root_stress_sustained = {odd_vector(2, 2.5e8), odd_vector(2, 1.5e8)};
  a.root_stress_angle = {odd_vector(2, 0.7), odd_vector(2, 0.8)};
  a.root_stress_phase = {odd_vector(2, 0.3), odd_vector(2, -0.4)};
  a.tooth_load_sustained = odd_vector(2, 4e3).cwiseAbs();
  a.mesh_force_sustained = odd_vector(2, 6e3).cwiseAbs();
  a.pair_phase = odd_vector(3, 0.5);
  a.flank_roll = odd_matrix(3, 2, 0.3);
  a.flank_pressure = odd_matrix(2, 3, 1e9).cwiseAbs();
  a.edge_load_there = odd_matrix(2, 3, 700).cwiseAbs();
  a.flank_pressure_sustained = odd_vector(2, 1.1e9).cwiseAbs();
  a.edge_load = {odd_vector(2, 900).cwiseAbs(), odd_vector(2, 800).cwiseAbs()};
  a.loss_factor = odd_vector(2, 0.1).cwiseAbs();
  a.mesh_force_max = odd_vector(2, 7e3);
  a.separation_fraction = odd_vector(2, 0.1);
  a.separations_per_period = odd_vector(2, 1);
  a.jump_frequency = odd_vector(1, 2.8e3);
  a.jump_width = odd_vector(1, 10);
  a.period_multiple = Eigen::VectorXi{{1, 1}};
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, std::numeric_limits<double>::infinity()}};
  a.fidelity = {BodyModel::modal, ContactModel::strips, Integrator::exact};
  a.damping = {0, 7.7e-6, 0.5e-3, 0.005};
  a.natural_frequency = 2900.0 / 1.1;
  return a;
}

LoadedResult small_loaded() {
  LoadedResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.05 / 3}};
  a.contact = {17, 128};
  a.torque = 150.0 / 1.3;
  a.mesh_phase = 0.25 / 3;
  a.transmission_error = 4e-6 / 3;
  a.pair = Eigen::VectorXi{{-1, 0}};
  a.tooth_load = odd_vector(2, 2e3);
  a.tooth.resize(2, 2);
  a.tooth << 0, 34, 1, 33;
  a.root_stress = odd_matrix(2, 2, 1e8);
  a.strip_pair = Eigen::VectorXi{{-1, -1, 0}};
  a.strip_roll = odd_matrix(3, 2, 0.4);
  a.strip_width = odd_vector(3, 1e-5);
  a.strip_force = odd_vector(3, 800);
  a.strip_pressure = odd_vector(3, 5e8);
  a.strip_separation = odd_vector(3, 1e-10);
  a.strip_deflection = odd_matrix(3, 2, 1e-6);
  a.hub_torque = odd_vector(2, 150);
  a.contact_torque = odd_vector(2, 151);
  a.strain_energy = odd_vector(2, 1e-2);
  a.contact_work = odd_vector(2, 2e-2);
  return a;
}

// Two starts, two torques, three reliefs; at rest and in motion.
HarrisMapResult small_harris_map() {
  HarrisMapResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.05 / 3}};
  a.fidelity = {BodyModel::relaxed, ContactModel::strips, Integrator::newmark};
  a.contact = {17, 128};
  a.relieved = Relieved::both;
  a.shape = ReliefShape::parabolic;
  a.torque = Eigen::VectorXd{{50.0 / 3, 150}};
  a.relief = Eigen::VectorXd{{0, 5e-6 / 3, 1e-5}};
  a.length = Eigen::VectorXd{{1e-3 / 3, 2e-3 / 3}};
  a.start_roll = odd_matrix(2, 2, 0.4);
  a.design_torque = 100.0 / 3;
  const auto cube = [](double scale) {
    return std::vector<MatrixRM>{odd_matrix(2, 3, scale), odd_matrix(2, 3, 2 * scale)};
  };
  a.peak_to_peak = cube(1e-6);
  a.harmonic = {cube(2e-6), cube(3e-7), cube(4e-8)};
  a.optimum_relief = odd_vector(2, 1e-5);
  a.optimum_peak_to_peak = odd_vector(2, 1e-6);
  a.cusp = odd_matrix(2, 2, 1e-6);
  a.unrelieved = odd_vector(2, 2e-6);
  a.checked = 3;
  a.largest_error = 1e-3 / 3;
  a.dynamic_rms = cube(5e-6);
  a.worst_frequency = cube(3e3);
  a.time = {64, 250e3 / 1.1, 1e-6 / 3};
  a.damping = {1.0 / 3, 7.7e-6 / 1.1, 0.5e-3 / 1.1, 0.005 / 1.1};
  a.inertia[0] = 0.0148 / 1.1;
  a.inertia[1] = 0.0148 / 1.3;
  a.frequency_from = 1000.0 / 3;
  a.frequency_to = 4000.0 / 3;
  a.frequency_step = 20.0 / 3;
  return a;
}

VariantResult small_variant() {
  VariantResult a;
  set_pair(a);
  a.mesh = {"pinion", "wheel", 0.15 / 1.1, {true, 0.05 / 3}};
  a.fidelity = {BodyModel::relaxed, ContactModel::strips, Integrator::newmark};
  a.contact = {17, 128};
  a.time = {64, 250e3 / 1.1, 1e-6 / 3};
  a.damping = {1.0 / 3, 7.7e-6 / 1.1, 0.5e-3 / 1.1, 0.005 / 1.1};
  a.torque = 150.0 / 1.3;
  a.reference_torque = 100.0 / 1.3;
  a.inertia[0] = 0.0148 / 1.1;
  a.inertia[1] = 0.0148 / 1.3;
  a.frequency_from = 1000.0 / 3;
  a.frequency_to = 4000.0 / 3;
  a.frequency_step = 20.0 / 3;
  a.directions = {Direction::up, Direction::down};
  a.quantity = odd_vector(static_cast<Eigen::Index>(response_quantities(a.directions).size()), 1e-6);
  return a;
}

StudyResult small_study() {
  StudyResult a;
  a.plan.title = "A study";
  a.plan.scene = "data/scenes/parker2000.toml";
  a.plan.directions = {Direction::up};
  a.plan.random = true;
  a.plan.seed = 7;
  a.plan.keys = {varied_key("damping.rayleigh_stiffness_s"), varied_key("fidelity.contact")};
  a.plan.quantities = {"rms_max_up", "te_mean"};
  a.plan.figure_quantities = {"te_mean"};
  a.plan.figure_keys = {"damping.rayleigh_stiffness_s"};
  a.plan.figure_colour = "fidelity.contact";
  a.variants = {{"ab01", {"5.5e-06", "strips"}}, {"ab02", {"7.7e-06", "line"}}, {"cd03", {"4e-06", "line"}}};
  a.quantity = odd_matrix(3, 2, 1e-6);
  a.quantity.row(1).setZero();
  a.rejection = {"", "it jams", ""};
  a.unsteady = Eigen::Vector3i(2, 0, 1);
  return a;
}

BranchResult small_branch() {
  BranchResult a;
  set_pair(a);
  a.mesh = small_static().mesh;
  a.torque = 150;
  a.inertia[0] = a.inertia[1] = 0.01;
  a.mesh_frequency = odd_vector(2, 2e3);
  a.dte_rms = a.dte_mean = a.residual = odd_vector(2, 1e-6);
  a.mesh_force_sustained = a.tooth_load_sustained = odd_vector(2, 5e3).cwiseAbs();
  a.root_stress_sustained = {odd_vector(2, 2.5e8), odd_vector(2, 1.5e8)};
  a.root_stress_angle = {odd_vector(2, 0.7), odd_vector(2, 0.8)};
  a.root_stress_phase = {odd_vector(2, 0.3), odd_vector(2, -0.4)};
  a.dte_harmonic = odd_matrix(2, 3, 1e-6);
  a.floquet_multiplier = {odd_matrix(4, 2, 0.9), odd_matrix(4, 2, 0.7)};
  a.stable = a.steps = a.period_multiple = Eigen::Vector2i(1, 1);
  a.part = Eigen::Vector2i(0, 1);
  a.fold_frequency = odd_vector(1, 2e3);
  a.fold_width = odd_vector(1, 0.2);
  a.fold_rms = odd_vector(1, 1e-6);
  a.fold_smooth = Eigen::VectorXi::Ones(1);
  a.fold_multiplier = odd_matrix(1, 2, 1);
  a.end = "leaves the speeds of the scene";
  return a;
}

JumpMapResult small_jump_map() {
  JumpMapResult a;
  set_pair(a);
  a.mesh = small_static().mesh;
  a.torque = 150;
  a.inertia[0] = a.inertia[1] = 0.01;
  a.rayleigh_stiffness = a.damping_ratio = a.branches_from = a.branches_to = a.loss_from = a.loss_to =
      a.excitation = odd_vector(2, 1);
  a.two_branches = a.open_below = a.unsteady = Eigen::Vector2i(1, 0);
  a.peak_tooth_load = a.sustained_tooth_load = odd_matrix(2, 2, 3e3);
  a.jump_case = a.jump_direction = Eigen::VectorXi::Ones(1);
  a.jump_frequency = a.jump_width = odd_vector(1, 2e3);
  a.mesh_frequency = odd_vector(3, 2e3);
  for (int d = 0; d < 2; ++d) {
    a.dte_rms[d] = odd_matrix(2, 3, 1e-6);
    a.tooth_load_max[d] = odd_matrix(2, 3, 4e3);
    a.separation_fraction[d] = odd_matrix(2, 3, 0.9);
  }
  return a;
}

ReadingsResult small_readings() {
  ReadingsResult a;
  a.title = "odd";
  a.claim = {"one", "two"};
  Reading r;
  r.verdict = {0, 1};
  r.value = {1.5, 0};
  r.exists = {1, 0};
  a.readings = {r, r, r};
  return a;
}

const Provenance kMade{"gear-test", "gear-test --output x.h5", {}};

void write_streamed(const std::string& path, const RunupResult& a) {
  RunupFile file(path, kMade);
  file.begin(a, a.samples.size(), a.periods.size());
  if (a.samples.size() > 0) file.take(a.samples);
  if (a.periods.size() > 0) file.take(a.periods);
  file.end(a);
}

void overwrite(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

// An artifact that differs from a right one in what `change` does.
void write_static_like(const std::string& path, const std::function<void(h5::Writer&)>& change) {
  h5::Writer file;
  put_seal(file);
  change(file);
  publish(path, sealed(file.finish()));
}

}  // namespace

TEST_CASE("mesh.h5 gives back every value bit by bit") {
  Folder folder;
  const SectorGrid a = small_mesh();
  write("mesh.h5", a, kMade);
  const SectorGrid b = read_mesh("mesh.h5");
  CHECK(same(a.design, b.design));
  CHECK(same(a.discretisation, b.discretisation));
  CHECK(a.node_position == b.node_position);
  CHECK(a.element_node == b.element_node);
  CHECK(a.element_region == b.element_region);
  CHECK(a.bore_node == b.bore_node);
  CHECK(a.side_node == b.side_node);
  CHECK(a.flank_node == b.flank_node);
  CHECK(a.flank_roll_angle == b.flank_roll_angle);
  CHECK(fs::read_symlink("mesh.hdf") == "mesh.h5");
}

TEST_CASE("body.h5 gives back every value bit by bit") {
  Folder folder;
  const ReducedBody a = small_body();
  write("body.h5", a, kMade);
  const ReducedBody b = read_body("body.h5");
  CHECK(same(a.design, b.design));
  CHECK(same(a.discretisation, b.discretisation));
  CHECK(a.material.youngs_modulus == b.material.youngs_modulus);
  CHECK(a.material.poisson_ratio == b.material.poisson_ratio);
  CHECK(a.material.density == b.material.density);
  CHECK(a.material.plane_stress == b.material.plane_stress);
  CHECK(a.inertia == b.inertia);
  CHECK(a.eigenfrequency == b.eigenfrequency);
  CHECK(a.nodal_diameter == b.nodal_diameter);
  CHECK(a.component == b.component);
  CHECK(a.inertia_coupling == b.inertia_coupling);
  CHECK(a.mass == b.mass);
  CHECK(a.translation_coupling == b.translation_coupling);
  CHECK(a.flank_position == b.flank_position);
  CHECK(a.flank_mode == b.flank_mode);
  CHECK(a.offsets == b.offsets);
  REQUIRE(b.compliance.size() == 2);
  CHECK(a.compliance[0] == b.compliance[0]);
  CHECK(a.compliance[1] == b.compliance[1]);
  CHECK(a.far_compliance == b.far_compliance);
  CHECK(a.back_compliance == b.back_compliance);
  CHECK(a.back_flank_mode == b.back_flank_mode);
  CHECK(a.root_arc_length == b.root_arc_length);
  CHECK(a.root_angle == b.root_angle);
  CHECK(a.root_stress == b.root_stress);
  CHECK(a.reference_depth == b.reference_depth);
  CHECK(a.asymmetry == b.asymmetry);
  CHECK(a.least_eigenvalue == b.least_eigenvalue);
  CHECK(b.vtk_point.size() == 0);
  const h5::Reader file(read_bytes("body.h5"), "body.h5", "");
  const std::vector<std::string> names = file.children("/VTKHDF/PointData");
  REQUIRE(names.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(names[k] == a.vtk_point_data[k].first);
    const std::vector<double> shape = file.doubles("/VTKHDF/PointData/" + names[k]);
    const MatrixRM& field = a.vtk_point_data[k].second;
    REQUIRE(shape.size() == static_cast<std::size_t>(3 * field.rows()));
    for (Eigen::Index i = 0; i < field.rows(); ++i)
      CHECK(std::array{shape[3 * i], shape[3 * i + 1], shape[3 * i + 2]} ==
            std::array{static_cast<double>(static_cast<float>(field(i, 0))),
                       static_cast<double>(static_cast<float>(field(i, 1))), 0.0});
  }
  CHECK(fs::read_symlink("body.hdf") == "body.h5");
}

TEST_CASE("modes.h5 gives back every value bit by bit") {
  Folder folder;
  const ModesResult a = natural_modes(layout_of(planetary_train(3)));
  write("modes.h5", a, kMade);
  const ModesResult b = read_modes("modes.h5");
  CHECK(a.natural_frequency == b.natural_frequency);
  CHECK(a.type == b.type);
  CHECK(a.planet_harmonic == b.planet_harmonic);
  CHECK(a.shape == b.shape);
  CHECK(a.mesh_deflection == b.mesh_deflection);
  CHECK(a.mesh_energy == b.mesh_energy);
  CHECK(a.bearing_energy == b.bearing_energy);
  CHECK(a.kinetic_energy == b.kinetic_energy);
  CHECK(a.rigid_frequency == b.rigid_frequency);
  // The system as it is stored has the same modes.
  CHECK(natural_modes(b.layout).shape == a.shape);
  // Springs have no energy below 0; elastic bodies may join meshes that have.
  ModesResult negative = a;
  negative.mesh_energy(0, 0) = -0.5;
  write("negative.h5", negative, kMade);
  CHECK_THROWS_WITH(read_modes("negative.h5"), doctest::Contains("mesh_energy"));
  negative.mesh_phase = Eigen::VectorXd::Zero(1);
  negative.frozen_frequency = a.natural_frequency.transpose();
  write("elastic.h5", negative, kMade);
  CHECK(read_modes("elastic.h5").mesh_energy(0, 0) == -0.5);
  REQUIRE(b.layout.bodies.size() == a.layout.bodies.size());
  for (size_t i = 0; i < a.layout.bodies.size(); ++i)
    CHECK(a.layout.bodies[i].name == b.layout.bodies[i].name);
}

TEST_CASE("system_static.h5 gives back every value bit by bit") {
  Folder folder;
  const SystemStaticResult a = small_system();
  write("system_static.h5", a, kMade);
  const SystemStaticResult b = read_system_static("system_static.h5");
  for (const auto member :
       {&SystemStaticResult::rotation, &SystemStaticResult::torque, &SystemStaticResult::transmission_error,
        &SystemStaticResult::mesh_deflection, &SystemStaticResult::mesh_force,
        &SystemStaticResult::load_share, &SystemStaticResult::transmission_error_harmonic})
    CHECK(a.*member == b.*member);
  for (const auto member :
       {&SystemStaticResult::translation, &SystemStaticResult::bearing_force, &SystemStaticResult::tooth_load,
        &SystemStaticResult::contact_pressure, &SystemStaticResult::mesh_stiffness})
    CHECK(a.*member == b.*member);
  for (const auto member :
       {&SystemStaticResult::contact_ratio, &SystemStaticResult::mesh_phase, &SystemStaticResult::least_gap,
        &SystemStaticResult::least_force, &SystemStaticResult::torque_residual})
    CHECK(a.*member == b.*member);
  CHECK(a.pair == b.pair);
  CHECK(a.settings.gear == b.settings.gear);
  CHECK(a.settings.section == b.settings.section);
  CHECK(a.settings.gears() == b.settings.gears());
  CHECK(a.settings.contact.positions == b.settings.contact.positions);
  CHECK(a.settings.fidelity.contact == b.settings.fidelity.contact);
  REQUIRE(b.settings.mesh.size() == 2);
  for (const char* gear : {"sun", "planet", "ring"})
    CHECK(a.settings.modification(gear) == b.settings.modification(gear));
  CHECK(a.settings.modification("sun") != a.settings.modification("planet"));
  CHECK(b.settings.mesh[0].modification[1] == b.settings.mesh[1].modification[0]);
  CHECK(b.settings.modification("ring") == FlankModification{});
  CHECK(a.settings.mesh[1].centre_distance == b.settings.mesh[1].centre_distance);
  REQUIRE(b.drawing.size() == 3);
  CHECK(a.drawing[2].design.rim_outer_radius == b.drawing[2].design.rim_outer_radius);
  // What has another name than its schema is misplaced.
  CHECK(misplaced("out/train/system_static.h5", read_origin("system_static.h5")).empty());
  CHECK(misplaced("out/train/static.h5", read_origin("system_static.h5")).find("its name is that of") !=
        std::string::npos);
  Origin of_pair;
  of_pair.schema = "whine/static";
  CHECK(misplaced("out/train/system_static.h5", of_pair).find("'whine/system_static'") != std::string::npos);
  // Names that no gear has.
  SystemStaticResult wrong = a;
  wrong.settings.gear[1] = "moon";
  write("system_static.h5", wrong, kMade);
  CHECK_THROWS_AS(read_system_static("system_static.h5"), Error);
  write("system_static.h5", a, kMade);
}

TEST_CASE("artifacts of systems belong to their scene and, sweeps, to their direction, whoever wrote them") {
  Folder folder;
  const auto write_sweep = [](const std::string& scene, const std::string& output) {
    overwrite("out/" + scene + "/params/system_sweep.toml", "of = '" + scene + "'\n");
    char name[] = "gear-system-sweep", option[] = "--output";
    std::string place = output;
    char* arguments[] = {name, option, place.data(), nullptr};
    const Provenance made = made_by(3, arguments, {"params=out/" + scene + "/params/system_sweep.toml"});
    write("sweep.h5", small_sweep(small_system(), Direction::down), made);
    return read_origin("sweep.h5");
  };
  fs::create_directories("out/a/params");
  fs::create_directories("out/b/params");
  const auto found = [](const std::string& place, const Origin& origin, const std::string& words) {
    const std::string said = misplaced(place, origin);
    INFO(said);
    CHECK(said.find(words) != std::string::npos);
  };
  const Origin down = write_sweep("a", "out/a/down/system_sweep.h5");
  CHECK(misplaced("out/a/down/system_sweep.h5", down).empty());
  found("out/a/up/system_sweep.h5", down, "is of the sweep down, but lies in up");
  found("out/b/down/system_sweep.h5", down,
        "was made from out/a/params/system_sweep.toml, but lies in out/b");
  found("out/a/system_branch.h5", down, "its name is that of 'whine/system_branch'");
  // Made by hand under another name and moved: its own parameters tell.
  const Origin by_hand = write_sweep("a", "sweep.h5");
  CHECK(misplaced("out/a/down/system_sweep.h5", by_hand).empty());
  found("out/a/up/system_sweep.h5", by_hand, "is of the sweep down, but lies in up");
  found("out/b/down/system_sweep.h5", by_hand, "but lies in out/b");
}

TEST_CASE("system_impact.h5 and system_branch.h5 give back every value bit by bit") {
  Folder folder;
  SystemImpactResult a;
  static_cast<SystemStaticParameters&>(a.settings) = small_system().settings;
  a.settings.damping.rayleigh_stiffness = 2e-6;
  const auto bodies = static_cast<Eigen::Index>(a.settings.layout.bodies.size()),
             meshes = static_cast<Eigen::Index>(a.settings.layout.meshes.size());
  a.torque = Eigen::VectorXd::LinSpaced(bodies, -1, 1) / 3;
  a.axis_frequency = 1e4 / 3;
  a.impulse = 1e-4 / 3;
  a.rigid_frequency = Eigen::Vector3d(100, 200, 300) / 7;
  a.mesh_phase = Eigen::Vector2d(0, 0.5);
  a.loaded_pairs = MatrixRM::Constant(2, meshes, 2);
  double value = 1.0 / 3;
  const std::array of_modes{
      &SystemImpactResult::undamped_frequency, &SystemImpactResult::rayleigh_damping_ratio,
      &SystemImpactResult::eigen_frequency,    &SystemImpactResult::eigen_damping_ratio,
      &SystemImpactResult::natural_frequency,  &SystemImpactResult::damping_ratio,
      &SystemImpactResult::fit_residual,       &SystemImpactResult::contact_changes};
  for (const auto member : of_modes) a.*member = MatrixRM::Constant(2, 5, value *= 0.9);
  write("system_impact.h5", a, kMade);
  const SystemImpactResult b = read_system_impact("system_impact.h5");
  for (const auto member : of_modes) CHECK(a.*member == b.*member);
  CHECK(a.rigid_frequency == b.rigid_frequency);
  CHECK(a.loaded_pairs == b.loaded_pairs);
  CHECK(a.impulse == b.impulse);
  CHECK(a.torque == b.torque);
  CHECK(b.settings.damping.rayleigh_stiffness == 2e-6);

  SystemBranchResult c;
  c.settings = a.settings;
  c.torque = a.torque;
  c.axis_frequency = a.axis_frequency;
  c.mesh_frequency = Eigen::Vector2d(2000, 1000) / 3;
  const std::array of_points{&SystemBranchResult::dte_rms, &SystemBranchResult::dte_mean,
                             &SystemBranchResult::mesh_force_max, &SystemBranchResult::tooth_force_max,
                             &SystemBranchResult::separation_fraction};
  for (const auto member : of_points) c.*member = MatrixRM::Constant(2, meshes, value *= 0.9);
  c.bearing_force_rms = MatrixRM::Constant(2, bodies, value);
  c.floquet_multiplier.assign(2, MatrixRM::Constant(3, 2, -1.0 / 3));
  c.stable = Eigen::Vector2i(1, 0);
  c.steps = Eigen::Vector2i(64, 128);
  c.residual = Eigen::Vector2d(1e-12, 1e-11) / 3;
  c.segment_mismatch = Eigen::VectorXd::Constant(1, 1.0 / 7);
  c.fold_frequency = Eigen::VectorXd::Constant(1, 1e4 / 7);
  c.fold_smooth = Eigen::VectorXi::Ones(1);
  c.fold_multiplier = MatrixRM::Constant(1, 2, 1.01);
  c.fold_width = Eigen::VectorXd::Constant(1, 0.1 / 7);
  c.flip_frequency = c.torus_frequency = Eigen::Vector2d(1, 2) / 3;
  c.flip_width = c.torus_width = Eigen::Vector2d(2, 1) / 70;
  c.end = "the parameter left its range";
  write("system_branch.h5", c, kMade);
  const SystemBranchResult d = read_system_branch("system_branch.h5");
  for (const auto member : of_points) CHECK(c.*member == d.*member);
  CHECK(c.mesh_frequency == d.mesh_frequency);
  CHECK(c.bearing_force_rms == d.bearing_force_rms);
  CHECK(c.floquet_multiplier == d.floquet_multiplier);
  CHECK(c.stable == d.stable);
  CHECK(c.steps == d.steps);
  CHECK(c.residual == d.residual);
  CHECK(c.segment_mismatch == d.segment_mismatch);
  CHECK(c.fold_frequency == d.fold_frequency);
  CHECK(c.fold_multiplier == d.fold_multiplier);
  CHECK(c.torus_frequency == d.torus_frequency);
  CHECK(c.fold_width == d.fold_width);
  CHECK(c.flip_width == d.flip_width);
  CHECK(c.torus_width == d.torus_width);
  CHECK(c.end == d.end);
}

TEST_CASE("system_sweep.h5 gives back every value bit by bit") {
  Folder folder;
  const SystemSweepResult a = small_sweep(small_system(), Direction::down);
  write("system_sweep.h5", a, kMade);
  CHECK(read_system_sweep("system_sweep.h5").mesh_deflection == a.mesh_deflection);
  const SystemSweepResult b = read_system_sweep("system_sweep.h5");
  for (const auto member :
       {&SystemSweepResult::dte_rms, &SystemSweepResult::dte_mean, &SystemSweepResult::mesh_force_max,
        &SystemSweepResult::tooth_force_max, &SystemSweepResult::load_share_max,
        &SystemSweepResult::separation_fraction, &SystemSweepResult::bearing_force_max,
        &SystemSweepResult::bearing_force_rms, &SystemSweepResult::energy, &SystemSweepResult::rolling,
        &SystemSweepResult::bearing_damping, &SystemSweepResult::holding_torque})
    CHECK(a.*member == b.*member);
  for (const auto member :
       {&SystemSweepResult::torque, &SystemSweepResult::mesh_frequency, &SystemSweepResult::residual,
        &SystemSweepResult::energy_imbalance, &SystemSweepResult::drift_force})
    CHECK(a.*member == b.*member);
  CHECK(a.transmission_error == b.transmission_error);
  CHECK(a.mesh_force == b.mesh_force);
  CHECK(a.bearing_force == b.bearing_force);
  CHECK(a.periods == b.periods);
  CHECK(a.period_multiple == b.period_multiple);
  CHECK(a.axis_frequency == b.axis_frequency);
  CHECK(a.least_gap == b.least_gap);
  CHECK(a.direction == b.direction);
  CHECK(a.settings.damping.rayleigh_stiffness == b.settings.damping.rayleigh_stiffness);
}

TEST_CASE("modes.h5 whose bodies stand on nothing, or whose meshes join none, is rejected with its dataset") {
  Folder folder;
  const ModesResult good = natural_modes(layout_of(planetary_train(3)));
  const int carrier = good.layout.bodies[1].on;
  const auto said = [&](const auto& spoil) {
    ModesResult a = good;
    spoil(a.layout);
    write("modes.h5", a, kMade);
    try {
      read_modes("modes.h5");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto rejects = [&](const auto& spoil, const std::string& words) {
    const std::string message = said(spoil);
    CAPTURE(message);
    CHECK(message.find(words) != std::string::npos);
  };
  CHECK(said([](System&) {}).empty());
  for (const int on : {0, carrier, carrier + 1})
    rejects([&](System& s) { s.bodies[static_cast<size_t>(carrier)].on = on; },
            "allowed are -1, the ground, and the number of a carrier on the ground");
  rejects([](System& s) { s.bodies[1].on = 0; }, text("dataset /body/stands_on holds 0 of body 1"));
  rejects([](System& s) { s.bodies[1].sense = 0; }, "dataset /body/sense holds 0 of body 1");
  rejects([](System& s) { s.meshes[0].side[1].body = 99; }, "dataset /mesh/body_number holds the number 99");
  // What figures divide by and look up.
  rejects([](System& s) { s.bodies[2].teeth = 0; }, "dataset /body/teeth holds 0 of body 2, which is a gear");
  rejects([](System& s) { s.bodies[2].radius = 0; }, "dataset /body/radius holds 0, allowed is 1e-06 to 10");
  rejects([](System& s) { s.bodies[2].name = "a/b"; }, "dataset /body/name holds 'a/b'");
  rejects([&](System& s) { s.meshes[0].side[1].body = carrier; }, "allowed are two gears that differ");
  rejects([](System& s) { s.meshes[0].side[1].body = s.meshes[0].side[0].body; },
          "allowed are two gears that differ");
}

TEST_CASE(
    "system_static.h5 without a pair, or with the drawing of another gear, is rejected with its dataset") {
  Folder folder;
  const auto said = [&](const auto& spoil) {
    SystemStaticResult a = small_system();
    spoil(a);
    try {
      write("system_static.h5", a, kMade);
      read_system_static("system_static.h5");
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const auto has = [](const std::string& message, const std::string& words) {
    CAPTURE(message);
    CHECK(message.find(words) != std::string::npos);
  };
  CHECK(said([](SystemStaticResult&) {}).empty());
  has(said([](SystemStaticResult& a) {
        const auto meshes = static_cast<Eigen::Index>(a.settings.layout.meshes.size());
        a.pair.resize(0);
        for (auto* list : {&a.tooth_load, &a.contact_pressure}) list->assign(2, MatrixRM(meshes, 0));
      }),
      "dataset /pair holds no pair");
  has(said([](SystemStaticResult& a) { a.drawing[0].design.teeth += 1; }),
      "dataset /body/teeth holds 27 of body 0, and its drawing has 28");
  write("system_static.h5", small_system(), kMade);
}

TEST_CASE("static.h5 gives back every value bit by bit") {
  Folder folder;
  StaticResult a = small_static();
  write("static.h5", a, kMade);
  const StaticResult b = read_static("static.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(a.fidelity.contact == b.fidelity.contact);
  CHECK(same(a.contact, b.contact));
  CHECK(a.torque == b.torque);
  CHECK(a.contact_ratio == b.contact_ratio);
  CHECK(a.mesh_phase == b.mesh_phase);
  CHECK(a.transmission_error == b.transmission_error);
  CHECK(a.stiffness_secant == b.stiffness_secant);
  CHECK(a.stiffness_tangent == b.stiffness_tangent);
  CHECK(a.pair == b.pair);
  CHECK(a.tooth_load == b.tooth_load);
  CHECK(a.contact_pressure == b.contact_pressure);
  CHECK(a.contact_half_width == b.contact_half_width);
  CHECK(a.root_stress == b.root_stress);
  CHECK(a.root_stress_max == b.root_stress_max);
  CHECK(a.root_stress_angle == b.root_stress_angle);
  CHECK(a.root_stress_phase == b.root_stress_phase);
  CHECK(a.loss_factor == b.loss_factor);
  CHECK(a.transmission_error_harmonic == b.transmission_error_harmonic);
  CHECK(a.stiffness_harmonic == b.stiffness_harmonic);
  CHECK(a.mean_stiffness == b.mean_stiffness);
  CHECK(a.least_gap == b.least_gap);
  CHECK(a.least_force == b.least_force);
  CHECK(a.torque_residual == b.torque_residual);
  CHECK(a.backlash_margin == b.backlash_margin);

  a.backlash_margin = std::numeric_limits<double>::infinity();
  write("static.h5", a, kMade);
  CHECK(std::isinf(read_static("static.h5").backlash_margin));
}

TEST_CASE("error_budget.h5 gives back every value bit by bit, errors and choices apart") {
  Folder folder;
  ErrorBudgetResult a = small_budget();
  write("error_budget.h5", a, kMade);
  const auto same_changes = [](const StaticChanges& one, const StaticChanges& other) {
    return one.entry == other.entry && one.mean_stiffness_change == other.mean_stiffness_change &&
           one.peak_to_peak_change == other.peak_to_peak_change &&
           one.harmonic_change == other.harmonic_change && one.root_stress_change == other.root_stress_change;
  };
  const ErrorBudgetResult b = read_error_budget("error_budget.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(b.fidelity.contact == ContactModel::line);
  CHECK(same(a.contact, b.contact));
  CHECK(a.torque == b.torque);
  CHECK(same_changes(a.refinement, b.refinement));
  CHECK(same_changes(a.choice, b.choice));
  CHECK(a.root.element_size == b.root.element_size);
  CHECK(a.root.stress == b.root.stress);
  CHECK(b.choice_missing == "");

  a.choice = {"", Eigen::VectorXd(0), Eigen::VectorXd(0), {}, MatrixRM(0, 5)};
  a.choice_missing = "matching at 1 mm: leaves the tooth";
  a.root = {};
  write("without.h5", a, kMade);
  const ErrorBudgetResult c = read_error_budget("without.h5");
  CHECK(same_changes(a.choice, c.choice));
  CHECK(c.choice_missing == a.choice_missing);
  CHECK(c.root.element_size.size() == 0);
  a.choice.peak_to_peak_change.resize(1);
  CHECK(caught([&] { write("x.h5", a, kMade); }).says("peak_to_peak_change"));
}

TEST_CASE("sweep.h5 gives back every value bit by bit, and an empty list of jumps") {
  Folder folder;
  SweepResult a = small_pair_sweep();
  write("sweep.h5", a, kMade);
  const SweepResult b = read_sweep("sweep.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(same(a.damping, b.damping));
  CHECK(a.fidelity.body == b.fidelity.body);
  CHECK(a.fidelity.contact == b.fidelity.contact);
  CHECK(a.fidelity.integrator == b.fidelity.integrator);
  CHECK(same(a.contact, b.contact));
  CHECK(same(a.time, b.time));
  CHECK(a.torque == b.torque);
  CHECK(a.inertia[0] == b.inertia[0]);
  CHECK(a.inertia[1] == b.inertia[1]);
  CHECK(a.mean_stiffness == b.mean_stiffness);
  CHECK(a.bearing_damper[0] == b.bearing_damper[0]);
  CHECK(a.bearing_damper[1] == b.bearing_damper[1]);
  CHECK(a.direction == b.direction);
  CHECK(a.mesh_frequency == b.mesh_frequency);
  CHECK(a.transmission_error == b.transmission_error);
  CHECK(a.mesh_force == b.mesh_force);
  CHECK(a.root_stress == b.root_stress);
  CHECK(a.root_stress_angle == b.root_stress_angle);
  CHECK(a.root_stress_phase == b.root_stress_phase);
  CHECK(a.pair == b.pair);
  REQUIRE(b.tooth_load.size() == 2);
  CHECK(a.tooth_load[0] == b.tooth_load[0]);
  CHECK(a.tooth_load[1] == b.tooth_load[1]);
  CHECK(a.periods == b.periods);
  CHECK(a.residual == b.residual);
  CHECK(a.period_multiple == b.period_multiple);
  CHECK(a.energy_imbalance == b.energy_imbalance);
  CHECK(a.energy == b.energy);
  CHECK(b.jump_frequency.size() == 0);
  CHECK(b.jump_width.size() == 0);
  CHECK(a.natural_frequency == b.natural_frequency);
  CHECK(a.drift_force == b.drift_force);
  CHECK(a.least_gap == b.least_gap);
  CHECK(a.least_force == b.least_force);
  CHECK(a.fallbacks == b.fallbacks);
  CHECK(a.backlash_margin == b.backlash_margin);

  a.backlash_margin = std::numeric_limits<double>::infinity();
  write("sweep.h5", a, kMade);
  CHECK(std::isinf(read_sweep("sweep.h5").backlash_margin));
}

TEST_CASE("runup.h5 gives back every value bit by bit, and is rejected without samples or mesh periods") {
  Folder folder;
  const RunupResult a = small_runup();
  write_streamed("runup.h5", a);
  const RunupResult b = read_runup("runup.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(same(a.damping, b.damping));
  CHECK(same(a.time, b.time));
  CHECK(a.torque == b.torque);
  CHECK(a.mean_stiffness == b.mean_stiffness);
  CHECK(a.bearing_damper == b.bearing_damper);
  CHECK(a.natural_frequency == b.natural_frequency);
  CHECK(a.direction == b.direction);
  CHECK(a.ramp.from == b.ramp.from);
  CHECK(a.ramp.to == b.ramp.to);
  CHECK(a.ramp.rate == b.ramp.rate);
  CHECK(a.mesh_acceleration == b.mesh_acceleration);
  CHECK(a.sample_rate == b.sample_rate);
  CHECK(a.pair == b.pair);
  for (auto member : {&RunupSamples::time, &RunupSamples::mesh_frequency, &RunupSamples::transmission_error,
                      &RunupSamples::mesh_force})
    CHECK(a.samples.*member == b.samples.*member);
  CHECK(a.samples.tooth_load == b.samples.tooth_load);
  for (auto member :
       {&RunupPeriods::time, &RunupPeriods::mesh_frequency, &RunupPeriods::dte_rms, &RunupPeriods::dte_mean,
        &RunupPeriods::tooth_load_max, &RunupPeriods::separation_fraction})
    CHECK(a.periods.*member == b.periods.*member);
  CHECK(a.root_stress == b.root_stress);
  CHECK(a.periods.root_stress_sustained == b.periods.root_stress_sustained);
  CHECK(a.least_gap == b.least_gap);
  CHECK(a.least_force == b.least_force);
  CHECK(a.fallbacks == b.fallbacks);
  CHECK(a.drift_force == b.drift_force);
  CHECK(a.backlash_margin == b.backlash_margin);

  RunupResult still = a;
  still.periods = RunupPeriods();
  write_streamed("still.h5", still);
  CHECK(caught([] { read_runup("still.h5"); }).says("40 samples and 0 mesh periods"));
  CHECK(caught([] { summary("still.h5", "whine/runup"); }).says("40 samples and 0 mesh periods"));
  RunupResult silent = a;
  silent.samples = RunupSamples();
  silent.samples.tooth_load.resize(0, 3);
  write_streamed("silent.h5", silent);
  CHECK(caught([] { read_runup("silent.h5"); }).says("0 samples and 5 mesh periods"));
}

TEST_CASE("impact.h5 gives back every value bit by bit, and rejects rows that do not fit") {
  Folder folder;
  ImpactResult a = small_impact();
  write("impact.h5", a, kMade);
  const ImpactResult b = read_impact("impact.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(same(a.damping, b.damping));
  CHECK(a.fidelity.body == b.fidelity.body);
  CHECK(a.fidelity.contact == b.fidelity.contact);
  CHECK(a.fidelity.integrator == b.fidelity.integrator);
  CHECK(same(a.contact, b.contact));
  CHECK(a.torque == b.torque);
  CHECK(a.torque_step == b.torque_step);
  CHECK(a.inertia[0] == b.inertia[0]);
  CHECK(a.inertia[1] == b.inertia[1]);
  CHECK(a.mean_stiffness == b.mean_stiffness);
  CHECK(a.bearing_damper[0] == b.bearing_damper[0]);
  CHECK(a.bearing_damper[1] == b.bearing_damper[1]);
  CHECK(a.contact_state == b.contact_state);
  CHECK(a.natural_frequency == b.natural_frequency);
  CHECK(a.damping_ratio == b.damping_ratio);
  CHECK(a.undamped_frequency == b.undamped_frequency);
  CHECK(a.state_phase == b.state_phase);
  CHECK(a.time == b.time);
  CHECK(a.transmission_error == b.transmission_error);
  CHECK(a.mesh_phase == b.mesh_phase);
  CHECK(a.loaded_pairs == b.loaded_pairs);
  CHECK(a.phase_natural_frequency == b.phase_natural_frequency);
  CHECK(a.phase_damping_ratio == b.phase_damping_ratio);
  CHECK(a.phase_undamped_frequency == b.phase_undamped_frequency);
  CHECK(a.eigen_frequency == b.eigen_frequency);
  CHECK(a.eigen_damping_ratio == b.eigen_damping_ratio);
  CHECK(a.fit_residual == b.fit_residual);
  CHECK(a.least_mesh_force == b.least_mesh_force);

  a.eigen_frequency = odd_vector(3, 3e3);
  CHECK(caught([&] { write("impact.h5", a, kMade); }).says("by_phase/eigen_frequency has 3 rows"));
}

TEST_CASE(
    "bearings and their forces pass through static.h5, sweep.h5 and response.h5, under the gear's name") {
  Folder folder;
  const Bearing own{1e8 / 3, 900 / 1.1, 5 / 1.1};
  StaticResult rest = small_static();
  rest.mesh.bearing[1] = own;
  rest.bearing_force[1] = odd_matrix(3, 2, 2e3);
  write("static.h5", rest, kMade);
  const StaticResult at = read_static("static.h5");
  CHECK(!at.mesh.bearing[0].elastic());
  CHECK(at.mesh.bearing[1].stiffness == own.stiffness);
  CHECK(at.mesh.bearing[1].damping == own.damping);
  CHECK(at.mesh.bearing[1].mass == own.mass);
  CHECK(at.bearing_force[0].size() == 0);
  CHECK(at.bearing_force[1] == rest.bearing_force[1]);
  CHECK(h5::Reader(read_bytes("static.h5"), "static.h5", "").shape("/body/wheel/bearing_force") ==
        h5::Shape{3, 2});

  SweepResult moving = small_pair_sweep();
  moving.mesh.bearing = {own, own};
  for (auto& force : moving.bearing_force) force = {odd_matrix(64, 2, 1e3), odd_matrix(64, 2, 2e3)};
  write("sweep.h5", moving, kMade);
  const SweepResult on = read_sweep("sweep.h5");
  for (int g = 0; g < kSides; ++g)
    for (int f = 0; f < 2; ++f) CHECK(on.bearing_force[g][f] == moving.bearing_force[g][f]);
  moving.bearing_force[1].pop_back();
  CHECK_THROWS_WITH(write("other.h5", moving, kMade),
                    doctest::Contains("bearing_force has 1 rows, expected 2"));

  ResponseResult heard = small_response();
  heard.mesh = moving.mesh;
  for (int g = 0; g < kSides; ++g) {
    heard.bearing_force_max[g] = odd_vector(2, 3e3);
    heard.bearing_force_rms[g] = odd_vector(2, 1e3);
  }
  write("response.h5", heard, kMade);
  const ResponseResult back = read_response("response.h5");
  for (int g = 0; g < kSides; ++g) {
    CHECK(back.bearing_force_max[g] == heard.bearing_force_max[g]);
    CHECK(back.bearing_force_rms[g] == heard.bearing_force_rms[g]);
  }
}

TEST_CASE("bodies are given by the names of their gears, in any order, one for each") {
  GearMeshSpec mesh;
  mesh.gear[0] = "pinion";
  mesh.gear[1] = "wheel";
  const NamedFiles both("--body", {"wheel=out/b=c/body.h5", "pinion=a.h5"});
  CHECK(both.of(mesh) == std::vector<std::string>{"a.h5", "out/b=c/body.h5"});
  CHECK(both.role("wheel") == "body wheel");
  CHECK(both.and_inputs({"params=x"}) ==
        std::vector<std::string>{"params=x", "body wheel=out/b=c/body.h5", "body pinion=a.h5"});
  const auto rejected = [&](const std::vector<std::string>& words, const std::string& part) {
    const Caught error = caught([&] { NamedFiles("--body", words).of(mesh); });
    CHECK(error.kind == static_cast<int>(Failure::usage));
    INFO(error.message);
    CHECK(error.says(part));
  };
  for (const char* word : {"a.h5", "=a.h5", "pinion="}) rejected({word}, "write --body <gear>=<path>");
  rejected({"pinion=a.h5", "pinion=b.h5"}, "names the gear 'pinion' twice");
  rejected({"pinion=a.h5"}, "the gear 'wheel' has no file; give --body wheel=<path>");
  rejected({"pinion=a.h5", "whel=b.h5"}, "no gear of this mesh is called 'whel'; did you mean 'wheel'?");
  rejected({"pinion=a.h5", "wheel=b.h5", "carrier=c.h5"}, "they are pinion and wheel");
  // A system may have two gears, too.
  CHECK(caught([] {
          NamedFiles("--body", {"sun=a.h5", "moon=b.h5"}).of({"sun", "ring"}, "system");
        }).says("no gear of this system is called 'moon'"));
}

TEST_CASE("response.h5 gives back every value bit by bit") {
  Folder folder;
  const ResponseResult a = small_response();
  write("response.h5", a, kMade);
  const ResponseResult b = read_response("response.h5");
  CHECK(a.torque == b.torque);
  CHECK(a.direction == b.direction);
  CHECK(a.model == b.model);
  CHECK(a.mesh_frequency == b.mesh_frequency);
  CHECK(a.dte_rms == b.dte_rms);
  CHECK(a.dte_mean == b.dte_mean);
  CHECK(a.dte_harmonic == b.dte_harmonic);
  CHECK(a.tooth_load_max == b.tooth_load_max);
  CHECK(a.mesh_force_max == b.mesh_force_max);
  CHECK(a.root_stress_max == b.root_stress_max);
  CHECK(a.root_stress_sustained == b.root_stress_sustained);
  CHECK(a.root_stress_angle == b.root_stress_angle);
  CHECK(a.root_stress_phase == b.root_stress_phase);
  CHECK(a.tooth_load_sustained == b.tooth_load_sustained);
  CHECK(a.mesh_force_sustained == b.mesh_force_sustained);
  CHECK(a.pair_phase == b.pair_phase);
  CHECK(a.flank_roll == b.flank_roll);
  CHECK(a.flank_pressure == b.flank_pressure);
  CHECK(a.edge_load_there == b.edge_load_there);
  CHECK(a.flank_pressure_sustained == b.flank_pressure_sustained);
  CHECK(a.edge_load == b.edge_load);
  CHECK(a.loss_factor == b.loss_factor);
  CHECK(a.separation_fraction == b.separation_fraction);
  CHECK(a.separations_per_period == b.separations_per_period);
  CHECK(a.jump_frequency == b.jump_frequency);
  CHECK(a.jump_width == b.jump_width);
  CHECK(a.period_multiple == b.period_multiple);
  CHECK(same_pair(a, b));
  CHECK(a.inertia[0] == b.inertia[0]);
  CHECK(a.inertia[1] == b.inertia[1]);
  CHECK(same(a.mesh, b.mesh));
  CHECK(same(a.contact, b.contact));
  CHECK(same(a.time, b.time));
  CHECK(same(a.damping, b.damping));
  CHECK(a.fidelity.body == b.fidelity.body);
  CHECK(a.fidelity.contact == b.fidelity.contact);
  CHECK(a.fidelity.integrator == b.fidelity.integrator);
  CHECK(a.natural_frequency == b.natural_frequency);
}

TEST_CASE("loaded.h5 gives back every value bit by bit") {
  Folder folder;
  const LoadedResult a = small_loaded();
  write("loaded.h5", a, kMade);
  const LoadedResult b = read_loaded("loaded.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(same(a.contact, b.contact));
  CHECK(a.torque == b.torque);
  CHECK(a.mesh_phase == b.mesh_phase);
  CHECK(a.transmission_error == b.transmission_error);
  CHECK(a.pair == b.pair);
  CHECK(a.tooth_load == b.tooth_load);
  CHECK(a.tooth == b.tooth);
  CHECK(a.root_stress == b.root_stress);
  CHECK(a.strip_pair == b.strip_pair);
  CHECK(a.strip_roll == b.strip_roll);
  CHECK(a.strip_width == b.strip_width);
  CHECK(a.strip_force == b.strip_force);
  CHECK(a.strip_pressure == b.strip_pressure);
  CHECK(a.strip_separation == b.strip_separation);
  CHECK(a.strip_deflection == b.strip_deflection);
  CHECK(a.hub_torque == b.hub_torque);
  CHECK(a.contact_torque == b.contact_torque);
  CHECK(a.strain_energy == b.strain_energy);
  CHECK(a.contact_work == b.contact_work);
}

TEST_CASE("harris_map.h5 gives back every value bit by bit, with and without motion") {
  Folder folder;
  HarrisMapResult a = small_harris_map();
  const auto same_at_rest = [&](const HarrisMapResult& b) {
    return same_pair(a, b) && same(a.mesh, b.mesh) && a.fidelity.contact == b.fidelity.contact &&
           same(a.contact, b.contact) && a.relieved == b.relieved && a.shape == b.shape &&
           a.torque == b.torque && a.relief == b.relief && a.length == b.length &&
           a.start_roll == b.start_roll && a.design_torque == b.design_torque &&
           a.peak_to_peak == b.peak_to_peak && a.harmonic == b.harmonic &&
           a.optimum_relief == b.optimum_relief && a.optimum_peak_to_peak == b.optimum_peak_to_peak &&
           a.cusp == b.cusp && a.unrelieved == b.unrelieved && a.checked == b.checked &&
           a.largest_error == b.largest_error;
  };
  write("harris_map.h5", a, kMade);
  const HarrisMapResult b = read_harris_map("harris_map.h5");
  CHECK(same_at_rest(b));
  CHECK(a.dynamic_rms == b.dynamic_rms);
  CHECK(a.worst_frequency == b.worst_frequency);
  CHECK(same(a.time, b.time));
  CHECK(same(a.damping, b.damping));
  CHECK(a.fidelity.body == b.fidelity.body);
  CHECK(a.fidelity.integrator == b.fidelity.integrator);
  CHECK(a.inertia[0] == b.inertia[0]);
  CHECK(a.inertia[1] == b.inertia[1]);
  CHECK(a.frequency_from == b.frequency_from);
  CHECK(a.frequency_to == b.frequency_to);
  CHECK(a.frequency_step == b.frequency_step);
  a.dynamic_rms.clear();
  write("rest.h5", a, kMade);
  CHECK(same_at_rest(read_harris_map("rest.h5")));
  CHECK(read_harris_map("rest.h5").dynamic_rms.empty());
}

TEST_CASE("variant.h5 gives back every value bit by bit, and a refusal instead") {
  Folder folder;
  VariantResult a = small_variant();
  write("variant.h5", a, kMade);
  const VariantResult b = read_variant("variant.h5");
  CHECK(same_pair(a, b));
  CHECK(same(a.mesh, b.mesh));
  CHECK(a.fidelity.body == b.fidelity.body);
  CHECK(a.fidelity.contact == b.fidelity.contact);
  CHECK(a.fidelity.integrator == b.fidelity.integrator);
  CHECK(same(a.contact, b.contact));
  CHECK(same(a.time, b.time));
  CHECK(same(a.damping, b.damping));
  CHECK(a.torque == b.torque);
  CHECK(a.reference_torque == b.reference_torque);
  CHECK(a.inertia[0] == b.inertia[0]);
  CHECK(a.inertia[1] == b.inertia[1]);
  CHECK(a.frequency_from == b.frequency_from);
  CHECK(a.frequency_to == b.frequency_to);
  CHECK(a.frequency_step == b.frequency_step);
  CHECK(a.directions == b.directions);
  CHECK(a.quantity == b.quantity);
  CHECK(b.rejection == "");
  a.rejection = "it jams";
  write("refused.h5", a, kMade);
  const VariantResult rejected = read_variant("refused.h5");
  CHECK(rejected.rejection == "it jams");
  CHECK(rejected.quantity.size() == 0);
}

TEST_CASE("study.h5 gives back every value bit by bit") {
  Folder folder;
  const StudyResult a = small_study();
  write("study.h5", a, kMade);
  const StudyResult b = read_study_artifact("study.h5");
  CHECK(a.plan.title == b.plan.title);
  CHECK(a.plan.scene == b.plan.scene);
  CHECK(a.plan.directions == b.plan.directions);
  CHECK(a.plan.random == b.plan.random);
  CHECK(a.plan.seed == b.plan.seed);
  CHECK(a.plan.quantities == b.plan.quantities);
  CHECK(a.plan.figure_quantities == b.plan.figure_quantities);
  CHECK(a.plan.figure_keys == b.plan.figure_keys);
  CHECK(a.plan.figure_colour == b.plan.figure_colour);
  REQUIRE(a.plan.keys.size() == b.plan.keys.size());
  for (std::size_t k = 0; k < a.plan.keys.size(); ++k) CHECK(a.plan.keys[k].name == b.plan.keys[k].name);
  REQUIRE(a.variants.size() == b.variants.size());
  for (std::size_t v = 0; v < a.variants.size(); ++v) {
    CHECK(a.variants[v].name == b.variants[v].name);
    CHECK(a.variants[v].values == b.variants[v].values);
  }
  CHECK(a.quantity == b.quantity);
  CHECK(a.rejection == b.rejection);
  CHECK(a.unsteady == b.unsteady);
}

TEST_CASE("two writes of the same values give the same bytes, another value others") {
  Folder folder;
  write("a.h5", small_body(), kMade);
  write("b.h5", small_body(), kMade);
  CHECK(read_bytes("a.h5") == read_bytes("b.h5"));
  ReducedBody changed = small_body();
  changed.inertia = std::nextafter(changed.inertia, 1.0);
  write("c.h5", changed, kMade);
  CHECK(read_bytes("a.h5") != read_bytes("c.h5"));
  write("d.h5", small_pair_sweep(), kMade);
  write("e.h5", small_pair_sweep(), kMade);
  CHECK(read_bytes("d.h5") == read_bytes("e.h5"));
}

TEST_CASE("the whole gear closes: teeth copies with shared edges, counter-clockwise, all on their radii") {
  SectorGrid sector = small_mesh();
  const VtkGrid gear = whole_gear(sector);
  CHECK(gear.point.rows() == 12 * 3);  // 6 nodes less 3 shared ones
  CHECK(gear.cell.rows() == 12 * 2);
  // Every cell has the positive area of the ring sector's quadrilaterals: 1/2 (r2^2 - r1^2) sin(2 pi /
  // teeth).
  for (Eigen::Index e = 0; e < gear.cell.rows(); ++e) {
    double area = 0;
    for (int k = 0; k < 4; ++k) {
      const auto p = gear.point.row(gear.cell(e, k)), q = gear.point.row(gear.cell(e, (k + 1) % 4));
      area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    const double outer = e % 2 == 0 ? 0.02 : 0.03, inner = outer - 0.01;
    const double expected = 0.5 * (outer * outer - inner * inner) * std::sin(2 * std::numbers::pi / 12);
    CHECK(area == relative(expected, 1e-12));  // round-off of the rotation only
  }
  // The second copy lies counter-clockwise of the first, towards negative x.
  CHECK(gear.point.row(gear.cell(2, 0))[0] < gear.point.row(gear.cell(0, 0))[0]);

  sector.node_position(4, 0) += 1e-9;
  const Caught open = caught([&] { whole_gear(sector); });
  CHECK(open.kind == kNumerical);
  CHECK(open.says("does not close"));
}

TEST_CASE("provenance names tool, command, inputs with their SHA-256, and the stages before") {
  Folder folder;
  // SHA-256 of "abc", FIPS 180-2 example.
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  publish("out/body.toml", "abc");
  write("out/mesh.h5", small_mesh(),
        {"gear-mesh", "gear-mesh --params out/body.toml", {"params=out/body.toml"}});
  const std::string absolute = fs::current_path().string() + "/out/mesh.h5";
  write("out/body.h5", small_body(),
        {"gear-reduce", "gear-reduce", {"params=out/body.toml", "mesh=" + absolute}});
  const Origin origin = read_origin("out/body.h5");
  CHECK(origin.schema == "whine/body");
  CHECK(origin.tool == "gear-reduce");
  CHECK(origin.version == kVersion);
  REQUIRE(origin.inputs.size() == 2);
  CHECK(origin.inputs[0].role == "params");
  CHECK(origin.inputs[0].sha256 == sha256("abc"));
  CHECK(origin.inputs[1].path == "out/mesh.h5");
  CHECK(origin.inputs[1].sha256 == sha256_of_file("out/mesh.h5"));
  REQUIRE(origin.history.size() == 1);
  CHECK(origin.history[0] == "gear-mesh 0.1.0: gear-mesh --params out/body.toml");

  CHECK_NOTHROW(require_made_from("out/body.h5", "mesh", "out/mesh.h5"));
  SectorGrid other = small_mesh();
  other.design.addendum = 1;
  write("out/mesh.h5", other, kMade);
  const Caught stale = caught([] { require_made_from("out/body.h5", "mesh", "out/mesh.h5"); });
  CHECK(stale.kind == kInput);
  CHECK(stale.says("stale"));
  CHECK(stale.says("make out/body.h5"));
  CHECK(caught([] { write("x.h5", small_mesh(), {"t", "t", {"mesh=absent.h5"}}); }).kind == kIo);
}

TEST_CASE("no file holds a path of the machine: commands and inputs are relative to the working folder") {
  Folder folder;
  const std::string here = fs::current_path().string();
  CHECK(recorded_path(here + "/out/x.h5") == "out/x.h5");
  CHECK(recorded_path("out/x.h5") == "out/x.h5");
  CHECK(recorded_path("/somewhere/else/x.h5") == ".../x.h5");
  std::vector<std::string> words = {"/usr/bin/gear-x", "--input", here + "/a.h5",
                                    "--out=" + here + "/b c.h5"};
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  CHECK(command_line(4, argv.data()) == "gear-x --input a.h5 '--out=b c.h5'");
}

TEST_CASE("an artifact outside the working folder is rejected without a make target, which it has not") {
  Folder folder;
  const fs::path place = fs::temp_directory_path() / "whine-nowhere" / "x.h5";
  for (const std::string& path : {place.string(), std::string("../whine-nowhere/x.h5")}) {
    const Caught absent = caught([&] { read_static(path); });
    CHECK(absent.kind == kIo);
    CHECK(absent.says("make it again where it was made"));
    CHECK_FALSE(absent.says("make .."));
  }
}

TEST_CASE("a mesh of another gear, element size or order is rejected with both values; modes do not matter") {
  const SectorGrid mesh = small_mesh();
  const BodyParameters own{mesh.design, {}, mesh.discretisation};
  CHECK(caught([&] { require_mesh(mesh, own, "out/a/mesh.h5"); }).kind == 0);
  BodyParameters other = own;
  other.discretisation.modes = 50;
  CHECK(caught([&] { require_mesh(mesh, other, "out/a/mesh.h5"); }).kind == 0);
  other = own;
  other.design.teeth = 13;
  const Caught teeth = caught([&] { require_mesh(mesh, other, "out/a/mesh.h5"); });
  CHECK(teeth.kind == kInput);
  CHECK(teeth.says("its teeth is 12, the stage parameters of the scene say 13"));
  CHECK(teeth.says("make SCENE=path/to/a.toml out/a/mesh.h5"));
  other = own;
  other.design.bore_radius = std::nextafter(own.design.bore_radius, 1.0);
  CHECK(caught([&] { require_mesh(mesh, other, "out/a/mesh.h5"); }).says("bore_radius"));
  other = own;
  other.discretisation.element_order = 2;
  CHECK(caught([&] { require_mesh(mesh, other, "out/a/mesh.h5"); }).says("element_order is 1"));
  other = own;
  other.discretisation.element_size *= 2;
  CHECK(caught([&] { require_mesh(mesh, other, "out/a/mesh.h5"); }).says("its element is"));
}

TEST_CASE(
    "a body read back has the hash of its stage parameters, and another body is rejected with both hashes") {
  Folder folder;
  const ReducedBody body = small_body();
  write("body.h5", body, kMade);
  const std::string hash = body_hash(body_parameters({body.design, body.material, body.discretisation}));
  CHECK(hash.size() == 16);
  CHECK(caught([&] { require_body(read_body("body.h5"), hash, "driver", "body.h5"); }).kind == 0);
  CHECK(caught([&] { require_body(body, "", "driver", "body.h5"); }).kind == 0);
  ReducedBody other = body;
  other.material.density *= 2;
  const Caught rejected = caught([&] { require_body(other, hash, "driven", "out/s/wheel/body.h5"); });
  CHECK(rejected.kind == kInput);
  CHECK(rejected.says("out/s/wheel/body.h5: is the body "));
  CHECK(rejected.says("but the driven of this scene is " + hash));
  CHECK(rejected.says("make out/bodies/" + hash + "/body.h5"));
}

TEST_CASE("a static result of another contact level than a later stage's is rejected with both") {
  StaticResult statics = small_static();
  statics.fidelity.contact = ContactModel::line;
  Fidelity wanted;
  wanted.contact = ContactModel::line;
  CHECK(caught([&] { require_contact(statics, wanted, "out/s/T100/static.h5"); }).kind == 0);
  wanted.contact = ContactModel::strips;
  const Caught rejected = caught([&] { require_contact(statics, wanted, "out/s/T100/static.h5"); });
  CHECK(rejected.kind == kInput);
  CHECK(rejected.says(
      "out/s/T100/static.h5: was made with contact = \"line\", the parameters of this stage say \"strips\""));
  CHECK(rejected.says("make SCENE=path/to/s.toml out/s/T100/static.h5"));
}

TEST_CASE("the number of an option is decimal, finite and the whole word") {
  CHECK(number_option("--torque", "150") == 150);
  CHECK(number_option("--torque", "62.5") == 62.5);
  CHECK(number_option("--torque", "-1e3") == -1000);
  for (const char* word : {"", " 1", "1 ", "0x10", "inf", "-inf", "nan", "1e999", "ten", "1,5", "+1"}) {
    const Caught wrong = caught([&] { number_option("--torque", word); });
    CHECK(wrong.kind == static_cast<int>(Failure::usage));
    CHECK(wrong.says("--torque = '" + std::string(word) + "'"));
  }
}

TEST_CASE("the list of datasets has a line for each, with axes, unit and meaning") {
  std::istringstream lines(dataset_list());
  size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) {
    CAPTURE(line);
    const size_t name = line.find("  /"), unit = line.find(" ("), meaning = line.find("): ");
    CHECK(name != std::string::npos);
    CHECK(unit > name);
    REQUIRE(meaning != std::string::npos);
    CHECK(meaning > unit + 2);
    CHECK(line.size() > meaning + 5);
  }
  CHECK(count > 200);
  CHECK(dataset_list().find("static.h5  /transmission_error (mesh_phase; m): ") != std::string::npos);
}

TEST_CASE("only what lies below out/ has a make target") {
  CHECK(rebuild_advice("out/parker2000/T0.75/static.h5") ==
        "rebuild it with: make out/parker2000/T0.75/static.h5");
  CHECK(rebuild_advice("out/bodies/0123/body.h5") == "rebuild it with: make out/bodies/0123/body.h5");
  // Of a scene that is none of the project's.
  CHECK(rebuild_advice("out/s/T150/static.h5") ==
        "rebuild it with: make SCENE=path/to/s.toml out/s/T150/static.h5");
  CHECK(rebuild_advice("out/studies/thousand/study.h5") ==
        "rebuild it with: make out/studies/thousand/study.h5");
  CHECK(rebuild_advice("out/studies/own/variants/ab/abcd.h5") ==
        "rebuild it with: make STUDY=path/to/own.toml out/studies/own/variants/ab/abcd.h5");
  CHECK(rebuild_advice("results/static.h5").find("make results") == std::string::npos);
  CHECK(rebuild_advice("results/static.h5").find("below out/ only") != std::string::npos);
}

TEST_CASE("an artifact of another schema or version is rejected with what it is and how to rebuild it") {
  Folder folder;
  write("out/static.h5", small_static(), kMade);
  const Caught other = caught([] { read_sweep("out/static.h5"); });
  CHECK(other.kind == kInput);
  CHECK(other.says("'whine/static'"));
  CHECK(other.says("'whine/sweep'"));
  CHECK(other.says("rebuild it with: make out/static.h5"));

  write_static_like("out/old.h5", [](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/static"));
    file.attribute("/", "schema_version", 0);
  });
  const Caught old = caught([] { read_static("out/old.h5"); });
  CHECK(old.kind == kInput);
  CHECK(old.says("is schema version 0, this program reads 5"));
  CHECK(old.says("make out/old.h5"));

  write_static_like("out/alien.h5", [](h5::Writer& file) { file.group("/data"); });
  CHECK(caught([] { read_static("out/alien.h5"); }).kind == kInput);
}

TEST_CASE("one flipped bit in any byte of an artifact is found, whatever reads it") {
  Folder folder;
  write("out/static.h5", small_static(), kMade);
  const std::string whole = read_bytes("out/static.h5");
  std::mt19937 random(8);
  // Bytes of the signature make it no HDF5 file; all others are under the hash.
  for (std::size_t place = 0; place < whole.size(); place += 1 + random() % 64) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    overwrite("out/static.h5", bytes);
    const Caught read = caught([] { read_static("out/static.h5"); }),
                 seen = caught([] { read_origin("out/static.h5"); });
    if (read.kind == kIo && seen.kind == kIo && read.says("make out/static.h5")) continue;
    FAIL("the flipped bit in byte " << place << " of " << whole.size() << " was not found");
  }
  overwrite("out/static.h5", whole);
  CHECK(caught([] { read_static("out/static.h5"); }).kind == 0);
}

TEST_CASE("what HDF5 would follow for ever is rejected although the hash is right") {
  Folder folder;
  write("out/static.h5", small_static(), kMade);
  const std::string whole = read_bytes("out/static.h5");
  const std::size_t heap = whole.find("GCOL");
  REQUIRE(heap != std::string::npos);
  constexpr std::size_t kFirstSize =
      24;  // after the header of the heap, of 16 bytes, and number and use of the object
  for (const char byte : {'\xf0', '\x7f'}) {
    // -16 is the size with which HDF5 1.10 never gets on; the other one leads out of the file.
    std::string bytes = whole;
    bytes.replace(heap + kFirstSize, 8, std::string(1, byte) + std::string(7, '\xff'));
    overwrite("out/static.h5", sealed(bytes));
    const Caught damaged = caught([] { read_static("out/static.h5"); });
    CHECK(damaged.kind == kIo);
    CHECK(damaged.says("damaged"));
    CHECK(damaged.says("make out/static.h5"));
  }
  // All else that HDF5 follows has a checksum of its own, here that of the root group.
  std::string bytes = whole;
  const std::size_t root = bytes.find("schema_version");
  bytes[root] = 'S';
  overwrite("out/static.h5", sealed(bytes));
  CHECK(caught([] { read_static("out/static.h5"); }).kind != 0);

  // The heap's mark among numbers is no heap.
  const std::string mark = "a GCOL\1 and what follows it by accident";
  write_static_like("out/numbers.h5", [&](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/none"));
    file.put("/bytes", reinterpret_cast<const std::uint8_t*>(mark.data()), {mark.size()},
             {"1", "bytes", "byte", ""});
  });
  CHECK(h5::Reader(read_bytes("out/numbers.h5"), "out/numbers.h5", "").shape("/bytes").at(0) == mark.size());
}

TEST_CASE("a file that is little else than marks of heaps is looked through in no time") {
  h5::Writer file;
  file.attribute("/", "schema", std::string("whine/none"));
  std::string bytes = file.finish();
  // What follows the end that the superblock names is not HDF5's concern. Numbers before it refer to some of so many places by
  // accident, first of all that end itself: then the file is rejected.
  for (const std::string mark : {"GCOL\1", "GCOL\1\2\3"}) {
    std::string marks = bytes + std::string(1 << 16, '-');
    while (marks.size() < std::size_t(1) << 20) marks += mark;
    const std::clock_t start = std::clock();
    caught([&] { h5::Reader(marks, "marks.h5", ""); });
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 1);
  }

  // Many heaps to which the file refers, one within the other, all with the same objects.
  const std::size_t first = bytes.size();
  constexpr std::size_t kHeaps = 2000, kHeap = 32, kObjects = 30000;
  const auto number = [](std::uint64_t value) {
    std::string out(8, '\0');
    for (char& byte : out) {
      byte = static_cast<char>(value & 255);
      value >>= 8;
    }
    return out;
  };
  const std::size_t objects = first + kHeaps * kHeap, end = objects + kObjects * 16;
  for (std::size_t at = first; at < objects; at += kHeap)
    bytes += "GCOL\1" + std::string(3, '\0') + number(end - at) + std::string("\xff\xff", 2) +
             std::string(6, '\0') + number(objects - at - kHeap);
  for (std::size_t i = 0; i < kObjects; ++i) bytes += number(1 + i) + number(0);
  for (std::size_t at = first; at < objects; at += kHeap) bytes += number(at);
  const std::clock_t start = std::clock();
  CHECK(caught([&] { h5::Reader(bytes, "nested.h5", ""); }).says("the file is damaged"));
  CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 0.1);
}

TEST_CASE("a file that deflates to little is not read into a thousand times its size") {
  Folder folder;
  const std::vector<std::uint8_t> bytes(8 << 20);
  const std::vector<std::string> words(1 << 20);
  const std::vector<double> doubles(1 << 14);
  write_static_like("out/wide.h5", [&](h5::Writer& file) {
    const auto along = [](const char* axis) { return h5::Label{"1", "zeros", axis, ""}; };
    file.put("/bytes", bytes.data(), {bytes.size()}, along("bytes"));
    file.put("/words", words, along("words"));
    file.put("/doubles", doubles.data(), {doubles.size()}, along("doubles"));
  });
  const std::string whole = read_bytes("out/wide.h5");
  const h5::Reader file(whole, "out/wide.h5", "");
  // As doubles 64 MiB, as whole numbers 32, as texts 34.
  REQUIRE(whole.size() < (30 << 20) / 1020);
  for (const auto& read : std::vector<std::function<void()>>{
           [&] { file.doubles("/bytes"); }, [&] { file.ints("/bytes"); }, [&] { file.strings("/words"); }}) {
    const Caught rejected = caught(read);
    CHECK(rejected.kind == kInput);
    CHECK(rejected.says("of memory"));
  }
  CHECK(file.doubles("/doubles").size() == doubles.size());
}

TEST_CASE(
    "a number out of its range is rejected by its dataset, its value and the range, whatever the hash") {
  const Folder folder;
  const auto said = [](const auto& artifact, auto read) {
    write("a.h5", artifact, kMade);
    const Caught c = caught([&] { read("a.h5"); });
    CHECK(c.kind == kInput);
    return c.message;
  };
  const auto says = [](const std::string& message, const std::string& part) {
    INFO(message);
    return message.find(part) != std::string::npos;
  };
  ReducedBody body = small_body();
  body.offsets = -1;
  body.far_compliance = odd_matrix(4 * (25 + 1), 4, 1e-11);
  body.compliance.clear();
  CHECK(says(said(body, read_body), "dataset /compliance/offsets holds -1, allowed is 0 to 1000"));
  body = small_body();
  body.design.module = -0.003;
  CHECK(says(said(body, read_body), "dataset /parameters/gear/module holds -0.003, allowed is "));
  body = small_body();
  body.discretisation.near_field = static_cast<NearField>(7);
  CHECK(says(said(body, read_body), "near_field is '', which is none of: subtraction matching"));
  body = small_body();
  body.nodal_diameter[1] = -3;
  CHECK(says(said(body, read_body), "dataset /nodal_diameter holds -3, allowed is 0 to 2000"));
  StaticResult statics = small_static();
  statics.torque = 1e300;
  CHECK(says(said(statics, read_static),
             "dataset /parameters/operation/torque holds 1e+300, allowed is more than 0"));
  statics = small_static();
  statics.mesh.centre_distance = -1;
  CHECK(says(said(statics, read_static), "dataset /parameters/mesh/centre_distance holds -1, allowed is "));
  statics = small_static();
  statics.hunting_periods = 1 << 30;
  CHECK(says(said(statics, read_static), "dataset /hunting_periods holds 1073741824, allowed is 1 to "));
  SweepResult sweep = small_pair_sweep();
  sweep.tooth_load[1](0, 0) = 1e18;
  CHECK(says(said(sweep, read_sweep), "dataset /tooth_load holds 1e+18, allowed is "));
  sweep = small_pair_sweep();
  sweep.mesh_frequency[0] = 0;
  CHECK(says(said(sweep, read_sweep), "dataset /mesh_frequency holds 0, allowed is more than 0 to "));
  SystemStaticResult rest = small_system();
  rest.settings.layout.bodies[0].radius = 1e-300;
  CHECK(says(said(rest, read_system_static), "dataset /body/radius holds 1e-300, allowed is 1e-06 to 10"));
  SystemSweepResult motion = small_sweep(small_system(), Direction::up);
  motion.residual[0] = 1e300;
  CHECK(says(said(motion, read_system_sweep), "dataset /residual holds 1e+300, allowed is 0 to 1e+12"));
  motion = small_sweep(small_system(), Direction::up);
  motion.energy_imbalance[0] = 1e300;
  CHECK(
      says(said(motion, read_system_sweep), "dataset /energy_imbalance holds 1e+300, allowed is 0 to 1e+12"));
}

TEST_CASE("a picture says what it was drawn from, and one of other files or of another scene is rejected") {
  const Folder folder;
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR0123456789abcCRC!", 33),
      end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  for (const char* scene : {"one", "other"}) {
    std::filesystem::create_directories(text("out/", scene, "/params"));
    std::filesystem::create_directories(text("out/", scene, "/T100"));
    std::ofstream(text("out/", scene, "/params/title.txt")) << "Pair " << scene << '\n';
    std::ofstream(text("out/", scene, "/T100/static.h5")) << scene;
  }
  const std::string scene = scene_words("out/one/T100/static.h5");
  REQUIRE(scene.find("Pair one") != std::string::npos);
  const std::string picture = with_sources(header + end, {"out/one/T100/static.h5"});
  const auto sources = picture_sources("a.png", picture);
  REQUIRE(sources.size() == 1);
  CHECK(sources[0].path == "out/one/T100/static.h5");
  CHECK(sources[0].sha256 == sha256_of_file("out/one/T100/static.h5"));
  const auto rejected = [&](const std::string& bytes) {
    return caught([&] { require_fresh_picture("fig12.png", bytes, scene); });
  };
  CHECK_NOTHROW(require_fresh_picture("fig12.png", picture, scene));
  CHECK_NOTHROW(require_fresh_picture("fig12.png", picture, ""));
  CHECK(rejected(header + end).says("fig12.png: does not say what it was drawn from"));
  CHECK(
      rejected(with_sources(header + end, {"out/other/T100/static.h5"}))
          .says("was drawn from out/other/T100/static.h5, of the scene other: Pair other; the report is of"));
  std::ofstream("out/one/T100/static.h5") << "made anew";
  CHECK(rejected(picture).says("was drawn from another out/one/T100/static.h5 than there is"));
  for (size_t length = header.size(); length + end.size() < picture.size(); ++length)
    if (length > header.size()) CHECK(rejected(picture.substr(0, length)).says("is no whole PNG"));
}

TEST_CASE("a range holds its ends, an open one not its least, and none a number that is not one") {
  CHECK(outside({0, 1, true}, 0) == "holds 0, allowed is more than 0 to 1");
  CHECK(outside({0, 1}, 0).empty());
  CHECK(outside({0, 1}, 1).empty());
  CHECK(!outside({0, 1}, 1.1).empty());
  CHECK(!outside({0, 1}, std::numeric_limits<double>::quiet_NaN()).empty());
}

TEST_CASE("an artifact without its hash is rejected before HDF5 sees it") {
  Folder folder;
  h5::Writer file;
  file.attribute("/", "schema", std::string("whine/static"));
  file.attribute("/", "schema_version", 3);
  publish("out/bare.h5", file.finish());
  const Caught bare = caught([] { read_static("out/bare.h5"); });
  CHECK(bare.kind == kIo);
  CHECK(bare.says("carries no content hash"));
  CHECK(bare.says("make out/bare.h5"));
}

TEST_CASE("an input that was replaced, before or while a stage ran, is named and nothing is written") {
  Folder folder;
  char name[] = "build/bin/gear-test";
  char* arguments[] = {name, nullptr};
  overwrite("slice.toml", "a = 1\n");
  write("out/body.h5", small_body(), made_by(1, arguments, {"params=slice.toml"}));
  const Provenance now = made_by(1, arguments, {"driver=out/body.h5"});
  CHECK(caught([] { require_fresh("out/body.h5"); }).kind == 0);

  overwrite("slice.toml", "a = 2\n");
  const Caught stale = caught([&] { made_by(1, arguments, {"driver=out/body.h5"}); });
  CHECK(stale.kind == kInput);
  CHECK(stale.says("out/body.h5: is stale: its input 'params', slice.toml, is not what it was"));
  CHECK(stale.says("make out/body.h5"));
  fs::remove("slice.toml");  // what is not there contradicts nothing
  CHECK(caught([] { require_fresh("out/body.h5"); }).kind == 0);

  ReducedBody other = small_body();
  other.inertia *= 2;
  write("out/body.h5", other, kMade);
  const Caught replaced = caught([&] { write("static.h5", small_static(), now); });
  CHECK(replaced.kind == kInput);
  CHECK(replaced.says("static.h5: is not written, because its input out/body.h5 was replaced"));
  CHECK_FALSE(fs::exists("static.h5"));
}

TEST_CASE("a file that is absent, empty, no HDF5 or cut at any of many places is rejected, never read") {
  Folder folder;
  CHECK(caught([] { read_static("absent.h5"); }).kind == kIo);
  overwrite("empty.h5", "");
  CHECK(caught([] { read_static("empty.h5"); }).says("is empty"));
  overwrite("text.h5", "not an artifact at all");
  CHECK(caught([] { read_static("text.h5"); }).says("not an HDF5 file"));
  write("out/whole.h5", small_static(), kMade);
  const std::string bytes = read_bytes("out/whole.h5");
  for (std::size_t part = 1; part < 32; ++part) {
    overwrite("out/cut.h5", bytes.substr(0, bytes.size() * part / 32));
    const Caught cut = caught([] { read_static("out/cut.h5"); });
    CHECK(cut.kind == kIo);
    CHECK(fs::exists("out/cut.h5"));
    CHECK(cut.says("make out/cut.h5"));
  }
}

TEST_CASE(
    "a missing dataset, a wrong shape, a value that is not finite, an index that leads nowhere: rejected by name") {
  Folder folder;
  const auto head = [](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/mesh"));
    file.attribute("/", "schema_version", 1);
  };
  write_static_like("none.h5", head);
  const Caught none = caught([] { read_mesh("none.h5"); });
  CHECK(none.kind == kInput);
  CHECK(none.says("/parameters/gear/teeth"));
  CHECK(none.says("is missing"));

  ReducedBody ragged = small_body();
  ragged.flank_mode = odd_matrix(4, 2, 1);
  const Caught written = caught([&] { write("ragged.h5", ragged, kMade); });
  CHECK(written.kind == kNumerical);
  CHECK(written.says("/flank_mode has 2 columns, expected 3 along mode"));
  CHECK_FALSE(fs::exists("ragged.h5"));

  write_static_like("ragged.h5", [](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/readings"));
    file.attribute("/", "schema_version", 1);
    const std::string at = "/parameters/readings/";
    const int none = 0;
    const double values[] = {1, 2, 3};
    for (const char* word : {"title", "contact"})
      file.put(at + word, std::string("line"), {"1", "word", "", ""});
    file.put(at + "outside", &none, {}, {"1", "number", "", ""});
    file.put("/claim", std::vector<std::string>{"a", "b"}, {"1", "names", "claim", ""});
    file.put("/value", values, {1, 3}, {"1", "numbers", "row column", ""});
  });
  const Caught shape = caught([] { read_readings("ragged.h5"); });
  CHECK(shape.kind == kInput);
  CHECK(shape.says("/value has shape 1 x 3, expected any x 2"));

  StaticResult broken = small_static();
  broken.transmission_error[1] = std::nan("");
  const Caught nan = caught([&] { write("nan.h5", broken, kMade); });
  CHECK(nan.kind == kNumerical);
  CHECK(nan.says("/transmission_error"));
  CHECK_FALSE(fs::exists("nan.h5"));

  SectorGrid lost = small_mesh();
  lost.flank_node[1] = 99;
  write("lost.h5", lost, kMade);
  CHECK(caught([] { read_mesh("lost.h5"); }).says("/sector/flank_node holds the number 99"));
}

TEST_CASE(
    "what a killed process left beside a file goes with its next write; what a living one or another machine writes stays") {
  Folder folder;
  const pid_t gone = fork();
  if (gone == 0) _exit(0);
  REQUIRE(waitpid(gone, nullptr, 0) == gone);  // its number is free now
  char host[256] = {};
  REQUIRE(gethostname(host, sizeof host - 1) == 0);
  const std::string own = text(".tmp.", host, ".");
  const std::string stale = text("x.txt", own, gone), living = text("x.txt", own, getppid()),
                    of_another = text("y.txt", own, gone), of_none = text("x.txt", own, "notes"),
                    elsewhere = text("x.txt.tmp.not-", host, ".", gone), nowhere = text("x.txt.tmp.", gone);
  for (const std::string& name : {stale, living, of_another, of_none, elsewhere, nowhere})
    overwrite(name, "half");
  publish("x.txt", "whole");
  CHECK_FALSE(fs::exists(stale));
  CHECK(fs::exists(living));
  CHECK(fs::exists(of_another));
  CHECK(fs::exists(of_none));
  CHECK(fs::exists(elsewhere));
  CHECK(fs::exists(nowhere));  // it does not say on which machine its process was
  CHECK(read_bytes("x.txt") == "whole");
}

TEST_CASE("what is no regular file is rejected and not waited for") {
  Folder folder;
  REQUIRE(mkfifo("pipe", 0600) == 0);
  ::alarm(20);  // a reader of such files does not come back by itself
  for (const std::string name : {"pipe", "/dev/zero", "/dev/null"}) {
    const Caught rejected = caught([&] { read_bytes(name, "look elsewhere"); });
    CHECK(rejected.kind == kIo);
    CHECK(rejected.says(name + ": cannot be read: it is no regular file"));
    CHECK(rejected.says("look elsewhere"));
  }
  CHECK(caught([] { read_bytes("."); }).says("it is a folder"));
  fs::create_symlink("x.txt", "link");
  publish("x.txt", "whole");
  CHECK(read_bytes("link") == "whole");
  ::alarm(0);
}

TEST_CASE("writing is all or nothing: a failure leaves the earlier file and no rubbish") {
  Folder folder;
  publish("out/a/x.txt", "earlier");
  CHECK(folder.names("out/a") == std::vector<std::string>{"x.txt"});

  SUBCASE("a full disk (file size limit)") {
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{}, small{};
    getrlimit(RLIMIT_FSIZE, &before);
    small = before;
    small.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &small);
    const Caught full = caught([] { publish("out/a/x.txt", std::string(5000, 'n')); });
    const Caught artifact = caught([] { write("out/a/x.h5", small_static(), kMade); });
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, handler);
    CHECK(full.kind == kIo);
    CHECK(full.says("out/a/x.txt"));
    CHECK(full.message.find('\n') == std::string::npos);
    CHECK(artifact.kind == kIo);
  }
  SUBCASE("a folder in the place of the file") {
    fs::create_directory("out/a/folder");
    CHECK(caught([] { publish("out/a/folder", "new"); }).kind == kIo);
    fs::remove("out/a/folder");
  }
  SUBCASE("a file in the place of the folder") {
    CHECK(caught([] { publish("out/a/x.txt/y", "new"); }).kind == kIo);
  }
  CHECK(read_bytes("out/a/x.txt") == "earlier");
  CHECK(folder.names("out/a") == std::vector<std::string>{"x.txt"});
}

TEST_CASE("an unchanged file or link is left alone, a changed one replaced") {
  Folder folder;
  CHECK(publish_if_changed("p/a.toml", "one"));
  CHECK_FALSE(publish_if_changed("p/a.toml", "one"));
  CHECK(publish_if_changed("p/a.toml", "two"));
  CHECK(read_bytes("p/a.toml") == "two");
  CHECK(publish_link("p/link", "a.toml"));
  CHECK_FALSE(publish_link("p/link", "a.toml"));
  CHECK(publish_link("p/link", "b.toml"));
  CHECK(fs::read_symlink("p/link") == "b.toml");
  CHECK(caught([] { publish_link("p/a.toml", "b.toml"); }).kind == kIo);
  CHECK(read_bytes("p/a.toml") == "two");
}

TEST_CASE("the summary names the key numbers in an engineer's units") {
  Folder folder;
  StaticResult a = small_static();
  a.mean_stiffness = 463.5e6;
  a.transmission_error = Eigen::VectorXd{{4e-6, 6e-6, 5e-6}};
  write("static.h5", a, kMade);
  std::string all;
  for (const auto& [name, words] : summary("static.h5", "whine/static")) all += name + ": " + words + "\n";
  CHECK(all.find("463.5 N/µm") != std::string::npos);
  CHECK(all.find("5 µm mean, 2 µm peak to peak") != std::string::npos);
  ErrorBudgetResult budget = small_budget();
  budget.refinement.mean_stiffness_change = Eigen::VectorXd{{1e-4, -2e-4, 3e-4}};
  budget.choice.mean_stiffness_change = Eigen::VectorXd{{0.5, 0.25}};
  budget.root = {Eigen::Vector3d(8e-4, 4e-4, 2e-4), MatrixRM::Constant(3, 2, 1e8)};
  budget.root.stress.col(0) << 96e6, 99e6, 100e6;
  write("error_budget.h5", budget, kMade);
  all = "";
  for (const auto& [name, words] : summary("error_budget.h5", "whine/error_budget"))
    all += name + ": " + words + "\n";
  CHECK(all.find("sum: 0.06 % of the mean stiffness") != std::string::npos);
  CHECK(all.find("or contact strips: mean stiffness 25 %") != std::string::npos);
  CHECK(all.find("root stress of pinion: 3 % from 0.8 to 0.4 mm, 1 % from 0.4 to 0.2 mm, order 1.58") !=
        std::string::npos);
  CHECK(all.find("root stress of wheel: 0 % from 0.8 to 0.4 mm, 0 % from 0.4 to 0.2 mm") !=
        std::string::npos);
  write("impact.h5", small_impact(), kMade);
  write("sweep.h5", small_pair_sweep(), kMade);
  write("response.h5", small_response(), kMade);
  write("mesh.h5", small_mesh(), kMade);
  write("body.h5", small_body(), kMade);
  for (const char* name : {"impact", "sweep", "response", "mesh", "body"}) {
    CHECK(summary(text(name, ".h5"), text("whine/", name)).size() >= 3);
  }
}

TEST_CASE("a tool's exit status says the kind of failure") {
  char name[] = "/usr/bin/gear-x";
  char* argv[] = {name, nullptr};
  const int silent = dup(STDERR_FILENO), null = open("/dev/null", O_WRONLY);
  dup2(null, STDERR_FILENO);
  const int good = run_tool(1, argv, [](int, char**) {});
  const int own = run_tool(1, argv, [](int, char**) { return 3; });
  const int io = run_tool(1, argv, [](int, char**) { fail(Failure::io, "no room"); });
  const int memory = run_tool(1, argv, [](int, char**) -> int { throw std::bad_alloc(); });
  dup2(silent, STDERR_FILENO);
  close(silent);
  close(null);
  CHECK(good == 0);
  CHECK(own == 3);
  CHECK(io == 4);
  CHECK(memory == 1);
}

// tests/xarray.sh opens what WHINE_KEEP keeps of this case.
TEST_CASE("an empty list of matrices is given back as such: a branch without a point") {
  Folder folder;
  BranchResult a = small_branch();
  for (Eigen::VectorXd* v :
       {&a.mesh_frequency, &a.dte_rms, &a.dte_mean, &a.residual, &a.fold_frequency, &a.fold_rms,
        &a.fold_width, &a.mesh_force_sustained, &a.tooth_load_sustained, &a.root_stress_sustained[0],
        &a.root_stress_sustained[1], &a.root_stress_angle[0], &a.root_stress_angle[1],
        &a.root_stress_phase[0], &a.root_stress_phase[1]})
    v->resize(0);
  a.dte_harmonic.resize(0, 3);
  a.floquet_multiplier.clear();
  for (Eigen::VectorXi* v : {&a.stable, &a.steps, &a.period_multiple, &a.part}) v->resize(0);
  a.fold_smooth.resize(0);
  a.fold_multiplier.resize(0, 2);
  write("branch.h5", a, kMade);
  const BranchResult b = read_branch("branch.h5");
  CHECK(b.floquet_multiplier.empty());
  CHECK(b.mesh_frequency.size() == 0);
  CHECK(b.dte_harmonic.cols() == 3);
  CHECK(b.end == a.end);
}

TEST_CASE("axes of each kind of artifact are dimension scales, the numbers of harmonics among them") {
  Folder folder;
  write("mesh.h5", small_mesh(), kMade);
  write("body.h5", small_body(), kMade);
  write("static.h5", small_static(), kMade);
  write("error_budget.h5", small_budget(), kMade);
  write("loaded.h5", small_loaded(), kMade);
  write("impact.h5", small_impact(), kMade);
  write("sweep.h5", small_pair_sweep(), kMade);
  write("response.h5", small_response(), kMade);
  write("branch.h5", small_branch(), kMade);
  write("modes.h5", natural_modes(layout_of(planetary_train(3))), kMade);
  write("jump_map.h5", small_jump_map(), kMade);
  write("harris_map.h5", small_harris_map(), kMade);
  write("variant.h5", small_variant(), kMade);
  write("study.h5", small_study(), kMade);
  write("readings.h5", small_readings(), kMade);
  // A coordinate is one by HDF5's attribute CLASS.
  const auto is_scale = [](const std::string& path, const std::string& dataset) {
    return h5::Reader(read_bytes(path), path, "").string_attribute(dataset, "CLASS") == "DIMENSION_SCALE";
  };
  CHECK(is_scale("static.h5", "/mesh_phase"));
  CHECK(is_scale("sweep.h5", "/sample"));  // without values
  CHECK(is_scale("impact.h5", "/ring_down/time"));
  CHECK(is_scale("study.h5", "/variant"));
  const auto first = [](const std::string& path) {
    return h5::Reader(read_bytes(path), path, "").ints("/harmonic").at(0);
  };
  CHECK(first("static.h5") == 0);  // the mean
  CHECK(first("response.h5") == 1);
  CHECK(read_branch("branch.h5").floquet_multiplier[1] == small_branch().floquet_multiplier[1]);
  CHECK(read_jump_map("jump_map.h5").dte_rms[1] == small_jump_map().dte_rms[1]);

  SweepResult sweep = small_pair_sweep();
  sweep.pair.conservativeResize(sweep.pair.size() - 1);
  CHECK(caught([&] { write("x.h5", sweep, kMade); }).says("along pair"));
}
