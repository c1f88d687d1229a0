// What artifacts hold: axes, pictures for ParaView, records written in blocks, the list of datasets, summaries.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "filled_artifact.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/datasets.h"
#include "io/h5.h"
#include "io/publish.h"
#include "io/runup_file.h"
#include "io/summary.h"
#include "io/vtk.h"
#include "own_folder.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;
namespace fs = std::filesystem;

namespace {

void write_streamed(const std::string& path, const RunupResult& a) {
  RunupFile file(path, kMade);
  file.begin(a, a.samples.size(), a.periods.size());
  if (a.samples.size() > 0) file.take(a.samples);
  if (a.periods.size() > 0) file.take(a.periods);
  file.end(a);
}

}  // namespace

TEST_CASE("ParaView finds the modes of body.h5 in a picture that is not read again") {
  OwnFolder folder;
  ReducedBody a = any<ReducedBody>();
  a.vtk_point = MatrixRM{{0.01, 0.02}, {0.02, 0.02}, {0.02, 0.03}, {0.01, 0.03}};
  a.vtk_cell.resize(1, 4);
  a.vtk_cell << 0, 1, 2, 3;
  // Point data are single precision in the file: multiples of 1/8 pass through exactly.
  const MatrixRM shape{{0.125, 0.25}, {-0.5, 1}, {2, -3}, {0, 0.375}};
  a.vtk_point_data = {{"mode_1", shape}, {"mode_2", -shape}};
  write("body.h5", a, kMade);
  CHECK(read<ReducedBody>("body.h5").vtk_point.size() == 0);
  const h5::Reader file(read_bytes("body.h5"), "body.h5", "");
  CHECK(file.children("/VTKHDF/PointData") == std::vector<std::string>{"mode_1", "mode_2"});
  for (const auto& [name, field] : a.vtk_point_data) {
    const std::vector<double> found = file.doubles("/VTKHDF/PointData/" + name);
    MatrixRM expected = MatrixRM::Zero(4, 3);
    expected.leftCols(2) = field;
    CHECK(Eigen::Map<const MatrixRM>(found.data(), static_cast<Eigen::Index>(found.size()) / 3, 3) ==
          expected);
  }
  CHECK(fs::read_symlink("body.hdf") == "body.h5");
}

TEST_CASE(
    "a run-up written block by block is the whole one in single precision; without samples or mesh periods it is rejected") {
  OwnFolder folder;
  const RunupResult a = any<RunupResult>();
  write_streamed("runup.h5", a);
  const RunupResult b = read<RunupResult>("runup.h5");
  const auto single = [](const auto& x) { return x.template cast<float>().template cast<double>().eval(); };
  const auto alike = [&](const MatrixRM& read, const MatrixRM& written) {
    return read.rows() == written.rows() && read.cols() == written.cols() && read == single(written);
  };
  CHECK(b.samples.time == a.samples.time);
  CHECK(alike(b.samples.mesh_force, a.samples.mesh_force));
  CHECK(alike(b.samples.tooth_load, a.samples.tooth_load));
  CHECK(b.periods.time == a.periods.time);
  CHECK(alike(b.periods.dte_rms, a.periods.dte_rms));
  CHECK(alike(b.periods.root_stress_sustained, a.periods.root_stress_sustained));
  CHECK(b.drift_force == a.drift_force);
  const std::string counted = text(a.samples.size(), " samples and ");

  RunupResult still = a;
  still.periods = RunupPeriods();
  write_streamed("still.h5", still);
  CHECK(names(message_of([] { read<RunupResult>("still.h5"); }), {counted + "0 mesh periods"}));
  CHECK(names(message_of([] { summary("still.h5", "whine/runup"); }), {counted + "0 mesh periods"}));
  RunupResult silent = a;
  silent.samples = RunupSamples();
  silent.samples.tooth_load.resize(0, a.pair.size());
  silent.samples.transmission_error.resize(0, a.meshes());
  silent.samples.mesh_force.resize(0, a.meshes());
  silent.samples.bearing_force.assign(a.body_names.size(), MatrixRM(0, 2));
  write_streamed("silent.h5", silent);
  CHECK(names(message_of([] { read<RunupResult>("silent.h5"); }),
              {text("0 samples and ", a.periods.size(), " mesh periods")}));
}

TEST_CASE("two writes of the same values give the same bytes, another value others") {
  OwnFolder folder;
  ReducedBody body = any<ReducedBody>();
  write("a.h5", body, kMade);
  write("b.h5", body, kMade);
  CHECK(read_bytes("a.h5") == read_bytes("b.h5"));
  body.inertia = std::nextafter(body.inertia, 1.0);
  write("c.h5", body, kMade);
  CHECK(read_bytes("a.h5") != read_bytes("c.h5"));
}

TEST_CASE("the whole gear closes: teeth copies with shared edges, counter-clockwise, all on their radii") {
  SectorGrid sector = any<SectorGrid>();  // two elements between radii of 2, 4 and 6
  const VtkGrid gear = whole_gear(sector);
  CHECK(gear.point.rows() == 6 * 3);  // 6 nodes less 3 shared ones
  CHECK(gear.cell.rows() == 6 * 2);
  // Every cell has the positive area of the ring sector's quadrilaterals: 1/2 (r2^2 - r1^2) sin(2 pi /
  // teeth).
  for (Eigen::Index e = 0; e < gear.cell.rows(); ++e) {
    double area = 0;
    for (int k = 0; k < 4; ++k) {
      const auto p = gear.point.row(gear.cell(e, k)), q = gear.point.row(gear.cell(e, (k + 1) % 4));
      area += 0.5 * (p[0] * q[1] - p[1] * q[0]);
    }
    const double outer = e % 2 == 0 ? 4.0 : 6.0, inner = outer - 2;
    const double expected = 0.5 * (outer * outer - inner * inner) * std::sin(2 * std::numbers::pi / 6);
    CHECK(area == relative(expected, 1e-12));  // round-off of the rotation only
  }
  // The second copy lies counter-clockwise of the first, towards negative x.
  CHECK(gear.point.row(gear.cell(2, 0))[0] < gear.point.row(gear.cell(0, 0))[0]);

  sector.node_position(4, 0) += 1e-6;
  CHECK(refused([&] { whole_gear(sector); }, Failure::numerical, {"close"}));
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
  CHECK(contains(dataset_list(), "static.h5  /transmission_error (mesh_phase mesh; m): "));
}

TEST_CASE("the summary names the key numbers in an engineer's units") {
  OwnFolder folder;
  const auto words_of = [](const std::string& path, const std::string& schema) {
    std::string all;
    for (const auto& [name, words] : summary(path, schema)) all += name + ": " + words + "\n";
    return all;
  };
  SystemStaticResult a = any<SystemStaticResult>();
  a.mesh[0].mean_stiffness = 463.5e6;
  a.mesh[0].transmission_error.setConstant(5e-6);
  a.mesh[0].transmission_error.head(2) << 4e-6, 6e-6;
  write("static.h5", a, kMade);
  const std::string statics = words_of("static.h5", "whine/static");
  CHECK(contains(statics, "463.5 N/µm"));
  CHECK(contains(statics, "5 µm mean, 2 µm peak to peak"));
  ErrorBudgetResult budget = any<ErrorBudgetResult>();
  budget.gear_names = {"pinion", "wheel"};
  const auto changes_of = [](const char* entries, const Eigen::VectorXd& mean) {
    return StaticChanges{entries, mean, mean, {}, MatrixRM::Constant(mean.size(), 5, 1e-4)};
  };
  budget.refinement = changes_of("strips, flank table, elements", Eigen::Vector3d(1e-4, -2e-4, 3e-4));
  budget.choice = changes_of("matching at 1 mm, contact strips", Eigen::Vector2d(0.5, 0.25));
  budget.root = {Eigen::Vector3d(8e-4, 4e-4, 2e-4), MatrixRM::Constant(3, 2, 1e8)};
  budget.root.stress.col(0) << 96e6, 99e6, 100e6;
  write("error_budget.h5", budget, kMade);
  const std::string changes = words_of("error_budget.h5", "whine/error_budget");
  CHECK(contains(changes, "error: 0.06 % of the mean stiffness"));
  CHECK(contains(changes, "or contact strips: mean stiffness 25 %"));
  CHECK(
      contains(changes, "root stress of pinion: 3 % from 0.8 to 0.4 mm, 1 % from 0.4 to 0.2 mm, order 1.58"));
  CHECK(contains(changes, "root stress of wheel: 0 % from 0.8 to 0.4 mm, 0 % from 0.4 to 0.2 mm"));
  for_each_kind([]<class A>(const ArtifactKind<A>& kind) {
    CAPTURE(std::string(kind.name));
    if (!*kind.stems) return;
    write(text(kind.name, ".h5"), any<A>(), kMade);
    CHECK(summary(text(kind.name, ".h5"), kind.schema()).size() >= 3);
  });
}

// What WHINE_KEEP keeps of this case, tests/xarray.sh opens.
TEST_CASE("axes of each kind of artifact are dimension scales, the numbers of harmonics among them") {
  OwnFolder folder;
  for_each_kind([]<class A>(const ArtifactKind<A>& kind) {
    A artifact;
    fill(artifact, Optional::usual);
    write(text(kind.name, ".h5"), artifact, kMade);
  });
  const auto file = [](const std::string& path) { return h5::Reader(read_bytes(path), path, ""); };
  // A coordinate is one by HDF5's attribute CLASS.
  const auto is_scale = [&](const std::string& path, const std::string& dataset) {
    return file(path).string_attribute(dataset, "CLASS") == "DIMENSION_SCALE";
  };
  CHECK(is_scale("static.h5", "/mesh_phase"));
  CHECK(is_scale("sweep.h5", "/sample"));  // without values
  CHECK(is_scale("impact.h5", "/ring_down/time"));
  CHECK(is_scale("study.h5", "/variant"));
  CHECK(file("static.h5").ints("/harmonic").at(0) == 0);  // the mean
  CHECK(file("response.h5").ints("/harmonic").at(0) == 1);
}

TEST_CASE("an empty list of matrices is given back as such: a branch without a point") {
  OwnFolder folder;
  BranchResult a = any<BranchResult>();
  for (Eigen::VectorXd* v : {&a.mesh_frequency, &a.residual, &a.fold_frequency, &a.fold_width}) v->resize(0);
  for (MatrixRM* x : {&a.dte_rms, &a.dte_mean, &a.mesh_force_max, &a.tooth_load_max, &a.mesh_force_sustained,
                      &a.tooth_load_sustained, &a.separation_fraction, &a.fold_rms, &a.bearing_force_rms,
                      &a.root_stress_sustained, &a.root_stress_angle, &a.root_stress_phase})
    x->resize(0, x->cols());
  a.dte_harmonic.clear();
  a.floquet_multiplier.clear();
  for (Eigen::VectorXi* v : {&a.stable, &a.steps, &a.period_multiple, &a.part}) v->resize(0);
  a.fold_smooth.resize(0);
  a.fold_multiplier.resize(0, 2);
  write("branch.h5", a, kMade);
  const BranchResult b = read<BranchResult>("branch.h5");
  CHECK(b.floquet_multiplier.empty());
  CHECK(b.mesh_frequency.size() == 0);
  CHECK(b.dte_rms.cols() == a.dte_rms.cols());
  CHECK(b.end == a.end);
}
