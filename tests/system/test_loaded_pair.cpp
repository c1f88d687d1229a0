#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <numbers>

#include "base/error.h"
#include "contact/half_plane.h"
#include "io/artifacts.h"
#include "io/h5.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "results/loaded.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "solid/loaded_gear.h"
#include "system/loaded_pair.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;

const PlaneModuli kModuli = plane_strain_equivalent(paper_steel());

// A coarse mesh of the paper's gear and its body, once.
struct Coarse {
  SectorGrid mesh;
  ReducedBody body;
};
const Coarse& coarse() {
  static const Coarse made = [] {
    BodyDiscretisation discretisation;
    discretisation.element_size = 0.8e-3;
    const SectorGrid mesh = make_sector_mesh(paper_gear(), discretisation);
    return Coarse{mesh, reduce(mesh, paper_steel(), 0)};
  }();
  return made;
}

const StaticResult& coarse_statics() {
  static const StaticResult made = static_transmission(coarse().body, coarse().body, paper_statics(16), 150);
  return made;
}

const LoadedResult& loaded_at(double phase) {
  static std::map<double, LoadedResult> made;
  if (!made.count(phase))
    made[phase] =
        loaded_pair(coarse().mesh, coarse().mesh, coarse().body, coarse().body, coarse_statics(), phase, 0);
  return made[phase];
}

// What is rounded for the view: near load to 4 nm and 1.3e-4 of each value, elsewhere to 2 um and 1/64 of the largest value there.
void check_digits(const std::string& path, const LoadedResult& at) {
  std::ifstream in(path, std::ios::binary);
  const h5::Reader file(std::string(std::istreambuf_iterator<char>(in), {}), path, "");
  std::vector<bool> near(static_cast<size_t>(at.vtk_point.rows()), false);
  for (Eigen::Index e = 0; e < at.vtk_cell.rows(); ++e)
    for (int k = 0; at.vtk_cell(e, 4) >= 0 && k < 9; ++k) near[static_cast<size_t>(at.vtk_cell(e, k))] = true;
  for (Eigen::Index i = 0; i < at.vtk_line.size(); ++i)
    near[static_cast<size_t>(at.vtk_line.data()[i])] = true;
  CHECK(std::count(near.begin(), near.end(), false) > at.vtk_point.rows() / 2);
  const std::vector<double> shown = file.doubles("/VTKHDF/Points");
  double off[2] = {0, 0};
  for (Eigen::Index i = 0; i < at.vtk_point.rows(); ++i)
    for (int k = 0; k < 2; ++k) {
      double& most = off[near[static_cast<size_t>(i)] ? 0 : 1];
      most = std::max(most, std::abs(shown[static_cast<size_t>(3 * i + k)] - at.vtk_point(i, k)));
    }
  CHECK(off[0] < 4e-9);
  CHECK(off[1] < 2e-6);
  for (const auto& [name, units, values] : at.vtk_point_data) {
    CAPTURE(name);
    const std::vector<double> field = file.doubles("/VTKHDF/PointData/" + name);
    const size_t width = field.size() / near.size();
    double near_error = 0, far_error = 0, far_most = 0;
    for (size_t i = 0; i < near.size(); ++i)
      for (Eigen::Index k = 0; k < values.cols(); ++k) {
        const double exact = values(static_cast<Eigen::Index>(i), k),
                     error = std::abs(field[i * width + static_cast<size_t>(k)] - exact);
        if (near[i]) near_error = std::max(near_error, error / std::max(std::abs(exact), 1e-300));
        if (near[i]) continue;
        far_error = std::max(far_error, error);
        far_most = std::max(far_most, std::abs(exact));
      }
    CHECK(near_error < 1.3e-4);
    CHECK(far_error <= far_most / 64);
  }
}

}  // namespace

TEST_CASE(
    "loaded: an even pressure on a strip is the sum of line loads, and in balance with what it presses on") {
  const Vec2 point(0.3, 0.2), normal = Vec2(0.6, 0.8);
  const double width = 2e-3, thickness = 25e-3;
  const StripLoadField strip(point, normal, width, kModuli, thickness, 1e-3);
  const Vec2 tangent(-normal.y(), normal.x());
  const GaussRule rule = gauss_rule(40);
  for (const Vec2& p : {Vec2(point - 1e-3 * normal), Vec2(point - 2e-3 * normal + 3e-3 * tangent),
                        Vec2(point - 0.3e-3 * normal - 1.4e-3 * tangent)}) {
    Vec2 sum = Vec2::Zero();
    Eigen::Matrix2d stress;
    const Eigen::Vector3d s = strip.stress(p);
    stress << s[0], s[2], s[2], s[1];
    Vec2 traction = Vec2::Zero();
    const Vec2 outward = Vec2(0.28, -0.96);
    for (int g = 0; g < rule.point.size(); ++g) {
      const LineLoadField line(point + 0.5 * width * rule.point[g] * tangent, normal, kModuli, thickness,
                               1e-3);
      sum += 0.5 * rule.weight[g] * line.displacement(p);
      traction += 0.5 * rule.weight[g] * line.traction(p, outward) / thickness;
    }
    CHECK((strip.displacement(p) - sum).norm() < 1e-7 * sum.norm());
    CHECK((stress * outward - traction).norm() < 1e-7 * traction.norm());
  }
  // under the strip the pressure itself, beside it none
  const auto across = [&](const Vec2& p) {
    const Eigen::Vector3d s = strip.stress(p);
    return normal.x() * normal.x() * s[0] + normal.y() * normal.y() * s[1] +
           2 * normal.x() * normal.y() * s[2];
  };
  CHECK(across(point + 0.4 * width * tangent) == relative(-1 / (width * thickness), 1e-12));
  CHECK(std::abs(across(point + 0.6 * width * tangent)) < 1e-12 / (width * thickness));
  // strain is the derivative of the displacement
  const Vec2 p = point - 1.3e-3 * normal + 0.7e-3 * tangent;
  const double h = 1e-7;
  const Vec2 dx = (strip.displacement(p + Vec2(h, 0)) - strip.displacement(p - Vec2(h, 0))) / (2 * h),
             dy = (strip.displacement(p + Vec2(0, h)) - strip.displacement(p - Vec2(0, h))) / (2 * h);
  const Eigen::Vector3d stress =
      plane_elasticity(paper_steel()) * Eigen::Vector3d(dx.x(), dy.y(), dx.y() + dy.x());
  CHECK((stress - strip.stress(p)).norm() < 1e-6 * stress.norm());
}

TEST_CASE("loaded: hubs hold the torque, energy is the work, flanks give way as the tables say") {
  double with_corner = 0;
  for (double phase : {0.0, 0.25, 0.5, 0.9}) {
    CAPTURE(phase);
    const LoadedResult& at = loaded_at(phase);
    const double base_radius = ToothGeometry(paper_gear()).base_radius();
    for (int g = 0; g < kSides; ++g) {
      CAPTURE(g);
      CHECK(at.hub_torque[g] == relative(at.contact_torque[g], 1e-6));
      CHECK(at.strain_energy[g] == relative(at.contact_work[g], 0.01));
    }
    CHECK(at.tooth_load.sum() == relative(at.strip_force.sum(), 1e-12));
    // A corner's force has a lever of its own in the contact; along the gear's own normal it has the base radius.
    with_corner = std::max(with_corner, std::abs(at.contact_torque[0] / 150 - 1));
    CHECK(at.contact_torque[0] == relative(150, 0.005));
    // Complementarity by the whole field instead of the flank tables: d = e + deflections - approach.
    const auto zones = contact_zones(coarse().body, coarse().body, coarse_statics(), phase, 0);
    Eigen::Index i = 0;
    for (const ContactZone& zone : zones) {
      if (!(zone.force.sum() > 0)) continue;
      for (int k = 0; k < zone.strips.size(); ++k, ++i) {
        const double approach = zone.approach * zone.strips.contact.lever[0] / base_radius;
        const double gap = zone.strips.gap[k] + at.strip_deflection.row(i).sum() - approach;
        CHECK(std::abs(gap - at.strip_separation[i]) < 0.005 * at.transmission_error);
        CHECK(at.strip_separation[i] * at.strip_force[i] <
              1e-9 * at.transmission_error * at.strip_force.sum());
      }
    }
    CHECK(i == at.strip_force.size());
  }
  CHECK(with_corner > 1e-6);
  CHECK(loaded_at(0.5).contact_torque[0] == relative(150, 1e-6));
}

TEST_CASE("loaded: both gears stand in mesh, and strips lie on each other's flanks") {
  const LoadedResult& at = loaded_at(0.25);
  const Eigen::Index strips = at.strip_force.size(), lines = at.vtk_line.rows();
  REQUIRE(lines == 2 * strips);
  const auto field = [&](const char* name) -> const MatrixRM& {
    for (const auto& f : at.vtk_point_data)
      if (f.name == name) return f.values;
    FAIL("no field " << name);
    return at.vtk_point_data[0].values;
  };
  const MatrixRM &moved = field("displacement"), &elastic = field("elastic_displacement");
  double area = 0;
  for (Eigen::Index e = 0; e < at.vtk_cell.rows(); ++e)
    for (int k = 0; k < 4; ++k) {
      const Vec2 p = at.vtk_point.row(at.vtk_cell(e, k)), q = at.vtk_point.row(at.vtk_cell(e, (k + 1) % 4));
      area += 0.5 * (p.x() * q.y() - q.x() * p.y());
    }
  CHECK(area == relative(2 * 50 * exact_sector_area(paper_gear()), 2e-3));
  const Vec2 along(-std::cos(20 * kPi / 180), std::sin(20 * kPi / 180));
  for (Eigen::Index i = 0; i < strips; ++i) {
    double after = 0;  // m along the line of action, mean of the strip's two ends
    for (int end = 0; end < 2; ++end) {
      const int a = at.vtk_line(i, end), b = at.vtk_line(strips + i, end);
      const Vec2 apart = at.vtk_point.row(b) - at.vtk_point.row(a);
      CHECK(apart.norm() < 3e-6);  // the parabolas of two flanks over half a candidate zone
      after += 0.5 * (apart + Vec2(moved.row(b) - moved.row(a))).dot(along);
    }
    if (at.strip_force[i] > 0) CHECK(std::abs(after) < 0.02e-6);  // they touch
  }
  // The driven hub is held, the driver's turns.
  for (Eigen::Index i = 0; i < at.vtk_point.rows(); ++i) {
    const Vec2 r = at.vtk_point.row(i), turn = moved.row(i) - elastic.row(i);
    const double about =
        i < at.vtk_point.rows() / 2 ? at.transmission_error / ToothGeometry(paper_gear()).base_radius() : 0;
    CHECK((turn - about * Vec2(-r.y(), r.x())).norm() < 1e-15);
  }
  // Root stress: Lewis' cantilever with the load at the tip is the order of it; here the load is lower, and two pairs share it.
  CHECK(at.root_stress.minCoeff() > 10e6);
  CHECK(at.root_stress.maxCoeff() < 200e6);
}

TEST_CASE("loaded: what is shown has mid nodes about the loaded teeth alone, and no point that nothing has") {
  const LoadedResult& at = loaded_at(0.25);
  std::vector<bool> used(static_cast<size_t>(at.vtk_point.rows()), false);
  const MatrixRM &gear = at.vtk_cell_data[0].values, &tooth = at.vtk_cell_data[1].values;
  Eigen::Index coarse = 0;
  for (Eigen::Index e = 0; e < at.vtk_cell.rows(); ++e) {
    int nearest = 50;
    for (Eigen::Index j = 0; j < at.tooth.rows(); ++j) {
      const int apart =
          std::abs(static_cast<int>(tooth(e, 0)) - at.tooth(j, static_cast<int>(gear(e, 0)) - 1));
      nearest = std::min({nearest, apart, 50 - apart});
    }
    CHECK((at.vtk_cell(e, 4) < 0) == (nearest > 1));
    coarse += at.vtk_cell(e, 4) < 0;
    for (int k = 0; k < at.vtk_cell.cols(); ++k) {
      CHECK((at.vtk_cell(e, k) < 0) == (k >= 4 && nearest > 1));
      if (at.vtk_cell(e, k) >= 0) used[static_cast<size_t>(at.vtk_cell(e, k))] = true;
    }
  }
  CHECK(coarse > at.vtk_cell.rows() * 4 / 5);
  for (Eigen::Index i = 0; i < at.vtk_line.size(); ++i)
    used[static_cast<size_t>(at.vtk_line.data()[i])] = true;
  CHECK(std::count(used.begin(), used.end(), false) == 0);
  for (const auto& field : at.vtk_point_data) CHECK(field.values.rows() == at.vtk_point.rows());
}

TEST_CASE("loaded: artifacts are read as they were written, and what cannot be shown is rejected") {
  const LoadedResult& at = loaded_at(0.25);
  const TemporaryFolder folder;
  const std::string path = folder / "loaded.h5";
  write(path, at, {"test", "test", {}});
  const LoadedResult back = read<LoadedResult>(path);
  CHECK(back.strip_pressure == at.strip_pressure);
  CHECK(back.strip_deflection == at.strip_deflection);
  CHECK(back.root_stress == at.root_stress);
  CHECK(back.tooth == at.tooth);
  CHECK(back.hub_torque == at.hub_torque);
  CHECK(back.mesh_phase == 0.25);
  CHECK(back.gear[0].design.teeth == 50);
  check_digits(path, at);
  // 16 bytes of an element, tables and history included; of 390 000 elements, a pair of 25 and 76 teeth, it is 13: 5 MB.
  CHECK(static_cast<double>(std::filesystem::file_size(path)) <
        18.0 * static_cast<double>(at.vtk_cell.rows()));

  CHECK(failure_of([] { loaded_at(1.0); }) == Failure::input);
  CHECK(failure_of([] { loaded_gear(coarse().mesh, paper_steel(), {}); }) == Failure::input);
  SectorGrid cracked = coarse().mesh;
  cracked.design.crack.depth = 1e-3;
  CHECK(failure_of([&] { loaded_gear(cracked, paper_steel(), {{0, 0.4, 1e-4, 1.0}}); }) == Failure::input);
}

TEST_CASE("loaded: von Mises and principal stresses") {
  const Material stress = paper_steel();
  Material strain = stress;
  strain.plane_stress = false;
  const StressMeasures pull = stress_measures({100, 0, 0}, stress);
  CHECK(pull.largest == relative(100, 1e-12));
  CHECK(pull.von_mises == relative(100, 1e-12));
  CHECK(stress_measures({0, 0, 50}, stress).von_mises == relative(50 * std::sqrt(3.0), 1e-12));
  CHECK(stress_measures({0, 0, 50}, stress).least == relative(-50, 1e-12));
  // uniaxial plane strain: sqrt(1 - nu + nu^2)
  CHECK(stress_measures({100, 0, 0}, strain).von_mises == relative(100 * std::sqrt(1 - 0.3 + 0.09), 1e-12));
}
