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
#include "filled_artifact.h"
#include "gear/system_layout.h"
#include "io/artifact.h"
#include "io/artifact_kinds.h"
#include "io/artifact_place.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/datasets.h"
#include "io/h5.h"
#include "io/named_files.h"
#include "io/picture_sources.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/ranges.h"
#include "io/runup_file.h"
#include "io/scene_words.h"
#include "io/study.h"
#include "io/summary.h"
#include "io/system_scene.h"
#include "io/vtk.h"
#include "own_folder.h"
#include "planetary_train.h"
#include "relative.h"
#include "small_system.h"
#include "system/natural_modes.h"

using namespace whine;
namespace fs = std::filesystem;

namespace {

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

// Values of no meaning, other ones in each dataset.
template <class Artifact>
Artifact any() {
  Artifact a;
  fill(a);
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

TEST_CASE("ParaView finds the modes of body.h5 in a picture that is not read again") {
  OwnFolder folder;
  const ReducedBody a = small_body();
  write("body.h5", a, kMade);
  CHECK(read<ReducedBody>("body.h5").vtk_point.size() == 0);
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

TEST_CASE("the system in modes.h5 has the same modes; shares of energy below 0 are those of elastic bodies") {
  OwnFolder folder;
  const ModesResult a = natural_modes(layout_of(planetary_train(3)));
  write("modes.h5", a, kMade);
  const ModesResult b = read<ModesResult>("modes.h5");
  // The system as it is stored has the same modes.
  CHECK(natural_modes(b.layout).shape == a.shape);
  // Springs have no energy below 0; elastic bodies may join meshes that have.
  ModesResult negative = a;
  negative.mesh_energy(0, 0) = -0.5;
  write("negative.h5", negative, kMade);
  CHECK_THROWS_WITH(read<ModesResult>("negative.h5"), doctest::Contains("mesh_energy"));
  negative.mesh_phase = Eigen::VectorXd::Zero(1);
  negative.frozen_frequency = a.natural_frequency.transpose();
  write("elastic.h5", negative, kMade);
  CHECK(read<ModesResult>("elastic.h5").mesh_energy(0, 0) == -0.5);
}

TEST_CASE(
    "system_static.h5 keeps the modification of each gear, and is rejected with the name of a gear that there is not") {
  OwnFolder folder;
  const SystemStaticResult a = small_system();
  write("system_static.h5", a, kMade);
  const SystemStaticResult b = read<SystemStaticResult>("system_static.h5");
  REQUIRE(b.settings.mesh.size() == 2);
  for (const char* gear : {"sun", "planet", "ring"})
    CHECK(a.settings.modification(gear) == b.settings.modification(gear));
  CHECK(a.settings.modification("sun") != a.settings.modification("planet"));
  CHECK(b.settings.mesh[0].modification[1] == b.settings.mesh[1].modification[0]);
  CHECK(b.settings.modification("ring") == FlankModification{});
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
  CHECK_THROWS_AS(read<SystemStaticResult>("system_static.h5"), Error);
  write("system_static.h5", a, kMade);
}

TEST_CASE("artifacts of systems belong to their scene and, sweeps, to their direction, whoever wrote them") {
  OwnFolder folder;
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

TEST_CASE("modes.h5 whose bodies stand on nothing, or whose meshes join none, is rejected with its dataset") {
  OwnFolder folder;
  const ModesResult good = natural_modes(layout_of(planetary_train(3)));
  const int carrier = good.layout.bodies[1].on;
  const auto said = [&](const auto& spoil) {
    ModesResult a = good;
    spoil(a.layout);
    write("modes.h5", a, kMade);
    try {
      read<ModesResult>("modes.h5");
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
  rejects([](System& s) { s.meshes[0].side[1].body = 99; },
          "dataset /mesh/body_number holds 0, 99 of mesh 0");
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
  OwnFolder folder;
  const auto said = [&](const auto& spoil) {
    SystemStaticResult a = small_system();
    spoil(a);
    try {
      write("system_static.h5", a, kMade);
      read<SystemStaticResult>("system_static.h5");
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

TEST_CASE(
    "a run-up written block by block is the whole one in single precision; without samples or mesh periods it is rejected") {
  OwnFolder folder;
  const RunupResult a = any<RunupResult>();
  write_streamed("runup.h5", a);
  const RunupResult b = read<RunupResult>("runup.h5");
  const auto single = [](const auto& x) { return x.template cast<float>().template cast<double>().eval(); };
  CHECK(b.samples.time == a.samples.time);
  CHECK(b.samples.mesh_force == single(a.samples.mesh_force));
  CHECK(b.samples.tooth_load == single(a.samples.tooth_load));
  CHECK(b.periods.time == a.periods.time);
  CHECK(b.periods.dte_rms == single(a.periods.dte_rms));
  CHECK(b.periods.root_stress_sustained[1] == single(a.periods.root_stress_sustained[1]));
  CHECK(b.drift_force == a.drift_force);
  const std::string counted = text(a.samples.size(), " samples and ");

  RunupResult still = a;
  still.periods = RunupPeriods();
  write_streamed("still.h5", still);
  CHECK(caught([] { read<RunupResult>("still.h5"); }).says(counted + "0 mesh periods"));
  CHECK(caught([] { summary("still.h5", "whine/runup"); }).says(counted + "0 mesh periods"));
  RunupResult silent = a;
  silent.samples = RunupSamples();
  silent.samples.tooth_load.resize(0, a.pair.size());
  write_streamed("silent.h5", silent);
  CHECK(caught([] {
          read<RunupResult>("silent.h5");
        }).says(text("0 samples and ", a.periods.size(), " mesh periods")));
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

TEST_CASE("two writes of the same values give the same bytes, another value others") {
  OwnFolder folder;
  write("a.h5", small_body(), kMade);
  write("b.h5", small_body(), kMade);
  CHECK(read_bytes("a.h5") == read_bytes("b.h5"));
  ReducedBody changed = small_body();
  changed.inertia = std::nextafter(changed.inertia, 1.0);
  write("c.h5", changed, kMade);
  CHECK(read_bytes("a.h5") != read_bytes("c.h5"));
  write("d.h5", any<SweepResult>(), kMade);
  write("e.h5", any<SweepResult>(), kMade);
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
  OwnFolder folder;
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
  OwnFolder folder;
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
  OwnFolder folder;
  const fs::path place = fs::temp_directory_path() / "whine-nowhere" / "x.h5";
  for (const std::string& path : {place.string(), std::string("../whine-nowhere/x.h5")}) {
    const Caught absent = caught([&] { read<StaticResult>(path); });
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
  OwnFolder folder;
  const ReducedBody body = small_body();
  write("body.h5", body, kMade);
  const std::string hash = body_hash(body_parameters({body.design, body.material, body.discretisation}));
  CHECK(hash.size() == 16);
  CHECK(caught([&] { require_body(read<ReducedBody>("body.h5"), hash, "driver", "body.h5"); }).kind == 0);
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
  StaticResult statics = any<StaticResult>();
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
  OwnFolder folder;
  write("out/static.h5", any<StaticResult>(), kMade);
  const Caught other = caught([] { read<SweepResult>("out/static.h5"); });
  CHECK(other.kind == kInput);
  CHECK(other.says("'whine/static'"));
  CHECK(other.says("'whine/sweep'"));
  CHECK(other.says("rebuild it with: make out/static.h5"));

  write_static_like("out/old.h5", [](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/static"));
    file.attribute("/", "schema_version", 0);
  });
  const Caught old = caught([] { read<StaticResult>("out/old.h5"); });
  CHECK(old.kind == kInput);
  CHECK(old.says("is schema version 0, this program reads 5"));
  CHECK(old.says("make out/old.h5"));

  write_static_like("out/alien.h5", [](h5::Writer& file) { file.group("/data"); });
  CHECK(caught([] { read<StaticResult>("out/alien.h5"); }).kind == kInput);
}

TEST_CASE("one flipped bit in any byte of an artifact is found, whatever reads it") {
  OwnFolder folder;
  write("out/static.h5", any<StaticResult>(), kMade);
  const std::string whole = read_bytes("out/static.h5");
  std::mt19937 random(8);
  // Bytes of the signature make it no HDF5 file; all others are under the hash.
  for (std::size_t place = 0; place < whole.size(); place += 1 + random() % 64) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    overwrite("out/static.h5", bytes);
    const Caught content = caught([] { read<StaticResult>("out/static.h5"); }),
                 seen = caught([] { read_origin("out/static.h5"); });
    if (content.kind == kIo && seen.kind == kIo && content.says("make out/static.h5")) continue;
    FAIL("the flipped bit in byte " << place << " of " << whole.size() << " was not found");
  }
  overwrite("out/static.h5", whole);
  CHECK(caught([] { read<StaticResult>("out/static.h5"); }).kind == 0);
}

TEST_CASE("what HDF5 would follow for ever is rejected although the hash is right") {
  OwnFolder folder;
  write("out/static.h5", any<StaticResult>(), kMade);
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
    const Caught damaged = caught([] { read<StaticResult>("out/static.h5"); });
    CHECK(damaged.kind == kIo);
    CHECK(damaged.says("damaged"));
    CHECK(damaged.says("make out/static.h5"));
  }
  // All else that HDF5 follows has a checksum of its own, here that of the root group.
  std::string bytes = whole;
  const std::size_t root = bytes.find("schema_version");
  bytes[root] = 'S';
  overwrite("out/static.h5", sealed(bytes));
  CHECK(caught([] { read<StaticResult>("out/static.h5"); }).kind != 0);

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
  OwnFolder folder;
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
  const OwnFolder folder;
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
  CHECK(says(said(body, read<ReducedBody>), "dataset /compliance/offsets holds -1, allowed is 0 to 1000"));
  body = small_body();
  body.design.module = -0.003;
  CHECK(says(said(body, read<ReducedBody>), "dataset /parameters/gear/module holds -0.003, allowed is "));
  body = small_body();
  body.discretisation.near_field = static_cast<NearField>(7);
  CHECK(says(said(body, read<ReducedBody>), "near_field is '', which is none of: subtraction matching"));
  body = small_body();
  body.nodal_diameter[1] = -3;
  CHECK(says(said(body, read<ReducedBody>), "dataset /nodal_diameter holds -3, allowed is 0 to 2000"));
  StaticResult statics = any<StaticResult>();
  statics.torque = 1e300;
  CHECK(says(said(statics, read<StaticResult>),
             "dataset /parameters/operation/torque holds 1e+300, allowed is more than 0"));
  statics = any<StaticResult>();
  statics.mesh.centre_distance = -1;
  CHECK(says(said(statics, read<StaticResult>),
             "dataset /parameters/mesh/centre_distance holds -1, allowed is "));
  statics = any<StaticResult>();
  statics.hunting_periods = 1 << 30;
  CHECK(
      says(said(statics, read<StaticResult>), "dataset /hunting_periods holds 1073741824, allowed is 1 to "));
  SweepResult sweep = any<SweepResult>();
  sweep.tooth_load[1](0, 0) = 1e18;
  CHECK(says(said(sweep, read<SweepResult>), "dataset /tooth_load holds 1e+18, allowed is "));
  sweep = any<SweepResult>();
  sweep.mesh_frequency[0] = 0;
  CHECK(says(said(sweep, read<SweepResult>), "dataset /mesh_frequency holds 0, allowed is more than 0 to "));
  SystemStaticResult rest = small_system();
  rest.settings.layout.bodies[0].radius = 1e-300;
  CHECK(says(said(rest, read<SystemStaticResult>),
             "dataset /body/radius holds 1e-300, allowed is 1e-06 to 10"));
  SystemSweepResult motion = small_sweep(small_system(), Direction::up);
  motion.residual[0] = 1e300;
  CHECK(says(said(motion, read<SystemSweepResult>), "dataset /residual holds 1e+300, allowed is 0 to 1e+12"));
  motion = small_sweep(small_system(), Direction::up);
  motion.energy_imbalance[0] = 1e300;
  CHECK(says(said(motion, read<SystemSweepResult>),
             "dataset /energy_imbalance holds 1e+300, allowed is 0 to 1e+12"));
}

TEST_CASE("a picture says what it was drawn from, and one of other files or of another scene is rejected") {
  const OwnFolder folder;
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
  OwnFolder folder;
  h5::Writer file;
  file.attribute("/", "schema", std::string("whine/static"));
  file.attribute("/", "schema_version", 3);
  publish("out/bare.h5", file.finish());
  const Caught bare = caught([] { read<StaticResult>("out/bare.h5"); });
  CHECK(bare.kind == kIo);
  CHECK(bare.says("carries no content hash"));
  CHECK(bare.says("make out/bare.h5"));
}

TEST_CASE("an input that was replaced, before or while a stage ran, is named and nothing is written") {
  OwnFolder folder;
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
  const Caught replaced = caught([&] { write("static.h5", any<StaticResult>(), now); });
  CHECK(replaced.kind == kInput);
  CHECK(replaced.says("static.h5: is not written, because its input out/body.h5 was replaced"));
  CHECK_FALSE(fs::exists("static.h5"));
}

TEST_CASE("a file that is absent, empty, no HDF5 or cut at any of many places is rejected, never read") {
  OwnFolder folder;
  CHECK(caught([] { read<StaticResult>("absent.h5"); }).kind == kIo);
  overwrite("empty.h5", "");
  CHECK(caught([] { read<StaticResult>("empty.h5"); }).says("is empty"));
  overwrite("text.h5", "not an artifact at all");
  CHECK(caught([] { read<StaticResult>("text.h5"); }).says("not an HDF5 file"));
  write("out/whole.h5", any<StaticResult>(), kMade);
  const std::string bytes = read_bytes("out/whole.h5");
  for (std::size_t part = 1; part < 32; ++part) {
    overwrite("out/cut.h5", bytes.substr(0, bytes.size() * part / 32));
    const Caught cut = caught([] { read<StaticResult>("out/cut.h5"); });
    CHECK(cut.kind == kIo);
    CHECK(fs::exists("out/cut.h5"));
    CHECK(cut.says("make out/cut.h5"));
  }
}

TEST_CASE(
    "a missing dataset, a wrong shape, a value that is not finite, an index that leads nowhere: rejected by name") {
  OwnFolder folder;
  const auto head = [](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/mesh"));
    file.attribute("/", "schema_version", 1);
  };
  write_static_like("none.h5", head);
  const Caught none = caught([] { read<SectorGrid>("none.h5"); });
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
  const Caught shape = caught([] { read<ReadingsResult>("ragged.h5"); });
  CHECK(shape.kind == kInput);
  CHECK(shape.says("/value has shape 1 x 3, expected any x 2"));

  StaticResult broken = any<StaticResult>();
  broken.transmission_error[1] = std::nan("");
  const Caught nan = caught([&] { write("nan.h5", broken, kMade); });
  CHECK(nan.kind == kNumerical);
  CHECK(nan.says("/transmission_error"));
  CHECK_FALSE(fs::exists("nan.h5"));

  SectorGrid lost = small_mesh();
  lost.flank_node[1] = 99;
  write("lost.h5", lost, kMade);
  CHECK(caught([] { read<SectorGrid>("lost.h5"); }).says("/sector/flank_node holds the number 99"));
}

TEST_CASE(
    "what a killed process left beside a file goes with its next write; what a living one or another machine writes stays") {
  OwnFolder folder;
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
  OwnFolder folder;
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
  OwnFolder folder;
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
    const Caught artifact = caught([] { write("out/a/x.h5", any<StaticResult>(), kMade); });
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
  OwnFolder folder;
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
  OwnFolder folder;
  StaticResult a = any<StaticResult>();
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
  write("impact.h5", any<ImpactResult>(), kMade);
  write("sweep.h5", any<SweepResult>(), kMade);
  write("response.h5", any<ResponseResult>(), kMade);
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
  OwnFolder folder;
  BranchResult a = any<BranchResult>();
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
  const BranchResult b = read<BranchResult>("branch.h5");
  CHECK(b.floquet_multiplier.empty());
  CHECK(b.mesh_frequency.size() == 0);
  CHECK(b.dte_harmonic.cols() == 3);
  CHECK(b.end == a.end);
}

TEST_CASE("axes of each kind of artifact are dimension scales, the numbers of harmonics among them") {
  OwnFolder folder;
  write("mesh.h5", small_mesh(), kMade);
  write("body.h5", small_body(), kMade);
  write("static.h5", any<StaticResult>(), kMade);
  write("error_budget.h5", small_budget(), kMade);
  write("loaded.h5", any<LoadedResult>(), kMade);
  write("impact.h5", any<ImpactResult>(), kMade);
  write("sweep.h5", any<SweepResult>(), kMade);
  write("response.h5", any<ResponseResult>(), kMade);
  write("branch.h5", any<BranchResult>(), kMade);
  write("modes.h5", natural_modes(layout_of(planetary_train(3))), kMade);
  write("jump_map.h5", any<JumpMapResult>(), kMade);
  write("harris_map.h5", any<HarrisMapResult>(), kMade);
  write("variant.h5", any<VariantResult>(), kMade);
  write("study.h5", any<StudyResult>(), kMade);
  write("readings.h5", any<ReadingsResult>(), kMade);
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
  CHECK(read<BranchResult>("branch.h5").floquet_multiplier[1] == any<BranchResult>().floquet_multiplier[1]);
  CHECK(read<JumpMapResult>("jump_map.h5").dte_rms[1] == any<JumpMapResult>().dte_rms[1]);

  SweepResult sweep = any<SweepResult>();
  sweep.pair.conservativeResize(sweep.pair.size() - 1);
  CHECK(caught([&] { write("x.h5", sweep, kMade); }).says("along pair"));
}
