// The report of a system: its picture, load sharing, the page, and the view of its modes.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "gear/tooth_contour.h"
#include "relative.h"
#include "report/system_figures.h"
#include "report/system_picture.h"
#include "report/system_report.h"
#include "small_system.h"
#include "system/mode_view.h"
#include "system/natural_modes.h"
#include "system/rigid_system.h"

using namespace whine;
using Eigen::Index;

namespace {

constexpr double kPi = std::numbers::pi;

const FigureBlock& block(const Figure& figure, const std::string& name) {
  for (const auto& b : figure.blocks)
    if (b.name == name) return b;
  FAIL("no block " << name);
  return figure.blocks.front();
}

// m: from a point to the closed polygons of a block of a drawing in mm.
double distance_to(const FigureBlock& lines, const Vec2& p) {
  double least = 1e30;
  for (size_t i = 1; i < lines.rows.size(); ++i) {
    if (lines.rows[i].empty() || lines.rows[i - 1].empty()) continue;
    const Vec2 a(lines.rows[i - 1][0] * 1e-3, lines.rows[i - 1][1] * 1e-3),
        b(lines.rows[i][0] * 1e-3, lines.rows[i][1] * 1e-3);
    const double along = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    least = std::min(least, (p - a - along * (b - a)).norm());
  }
  return least;
}

// "" of a call that ends without an error.
std::string message_of(const auto& f) {
  try {
    f();
  } catch (const Error& error) {
    CHECK(error.kind() == Failure::input);
    return error.what();
  }
  return "";
}

SystemReport report_of(const SystemStaticArtifact& rest) {
  SystemReport r;
  r.scene = "train.toml: A planetary train";
  r.rest = rest;
  r.modes = elastic_modes(rest);
  r.pictures = {{"system", "png"}, {"load-sharing", "png"}, {"modes", "png"}};
  return r;
}

}  // namespace

TEST_CASE(
    "the contour of a gear: closed, between tip and root, its teeth are turned images, its flanks "
    "involutes") {
  for (const bool internal : {false, true}) {
    GearDesign design = rigid_gear(internal ? 99 : 27, internal);
    if (!internal) design.bore_radius = 10e-3;
    const ToothGeometry gear(design);
    const auto tooth = tooth_contour(gear, 8), whole = gear_contour(gear, 8);
    REQUIRE(whole.size() == (tooth.size() - 1) * static_cast<size_t>(design.teeth) + 1);
    CHECK((whole.front() - whole.back()).norm() == 0);
    double least = 1e30, most = 0, area = 0;
    for (size_t i = 0; i < whole.size(); ++i) {
      least = std::min(least, whole[i].norm());
      most = std::max(most, whole[i].norm());
      if (i > 0) area += 0.5 * (whole[i - 1].x() * whole[i].y() - whole[i - 1].y() * whole[i].x());
    }
    CHECK(std::min(gear.tip_radius(), gear.root_radius()) == relative(least, 1e-12));
    CHECK(std::max(gear.tip_radius(), gear.root_radius()) == relative(most, 1e-12));
    CHECK(area > kPi * least * least);  // counter-clockwise, once round
    CHECK(area < kPi * most * most);
    const double step =
        std::atan2(tooth.back().y(), tooth.back().x()) - std::atan2(tooth.front().y(), tooth.front().x());
    CHECK(step == relative(2 * kPi / design.teeth, 1e-9));
    // The pitch circle is met where the tooth is as thick as the drawing says.
    const Vec2 form = gear.flank_point(gear.form_roll_angle());
    CHECK(std::any_of(tooth.begin(), tooth.end(), [&](const Vec2& p) { return (p - form).norm() < 1e-15; }));
  }
}

TEST_CASE(
    "the picture of a system: drawn teeth touch where every mesh is at its phase, arrows turn as bodies do") {
  const SystemStaticArtifact a = small_system();
  const System& s = a.settings.layout;
  const Figure figure = system_picture(a);
  constexpr double kChord = 5e-6;  // m: of drawn flanks of ten points
  for (const System::Mesh& mesh : s.meshes) {
    const GearPair pair(drawing_of(a, mesh.side[0].body)->design, drawing_of(a, mesh.side[1].body)->design,
                        mesh.centre_distance);
    const System::Body& driver = s.bodies[static_cast<size_t>(mesh.side[0].body)];
    // The pair that is at the mesh's phase, or the one that follows it.
    double path = mesh.phase * pair.base_pitch();
    if (path > pair.path_end()) path -= pair.base_pitch();
    const Vec2 at = Vec2(driver.centre[0], driver.centre[1]) +
                    driver.radius / std::cos(mesh.pressure_angle) *
                        Vec2(std::cos(mesh.direction), std::sin(mesh.direction)) +
                    path * line_of_action(mesh);
    for (const System::Side& side : mesh.side) {
      const System::Body& body = s.bodies[static_cast<size_t>(side.body)];
      const char* of = is_ring(s, side.body) ? "hollow" : body.on == System::kGround ? "central" : "planets";
      CAPTURE(body.name);
      CHECK(distance_to(block(figure, of), at) < kChord);
    }
  }
  CHECK(is_ring(s, 4));
  CHECK(!is_ring(s, 0));
  // Arrows: the head of each lies on a circle about its body, in its sense.
  const FigureBlock& heads = block(figure, "heads");
  REQUIRE(heads.rows.size() == 5);
  for (size_t i = 0; i < 5; ++i) {
    const System::Body& body = s.bodies[i];
    const double x = heads.rows[i][0] * 1e-3 - body.centre[0], y = heads.rows[i][1] * 1e-3 - body.centre[1];
    CHECK((x * heads.rows[i][3] - y * heads.rows[i][2]) * body.sense > 0);
  }
  // Rigid gears: a pitch circle for each mesh.
  const Figure rigid = system_picture(natural_modes(layout_of(planetary_train(3))));
  CHECK(block(rigid, "circles").rows.size() > 6 * 180);
  for (const FigureBlock& of : rigid.blocks) CHECK(of.name != "central");
}

TEST_CASE("load sharing of a system: the factor of known shares, and a system that has none says so") {
  SystemStaticArtifact a = small_system();
  for (const LoadSharing& of : load_sharing(a)) {
    CHECK(of.meshes.size() == 3);
    CHECK(of.factor == relative(1, 1e-12));
  }
  // The second planet carries 40 % at the first phase.
  a.load_share.row(0).head(3) << 0.35, 0.4, 0.25;
  const std::vector<LoadSharing> sharing = load_sharing(a);
  REQUIRE(sharing.size() == 2);
  CHECK(sharing[0].name == "sun-planet");
  CHECK(sharing[0].factor == relative(1.2, 1e-12));
  CHECK(sharing[0].mean_factor == relative(1.5 * (0.4 + 1.0 / 3), 1e-12));
  const Figure figure = system_load_sharing_figure(a);
  const FigureBlock& share = block(figure, "share sun-planet");
  REQUIRE(share.rows.size() == 3);
  CHECK(share.rows[0][2] == relative(40, 1e-12));
  CHECK(share.rows[2] == std::vector<double>{1, share.rows[0][1], share.rows[0][2], share.rows[0][3]});
  a.settings.section = {0, 1, 2, 3, 4, 5};
  a.settings.mesh.resize(6);
  CHECK(message_of([&] { system_load_sharing_figure(a); }).find("stands for those of several planets") !=
        std::string::npos);
}

TEST_CASE("the page of a system holds its sections, its numbers and the words of each figure") {
  const SystemReport r = report_of(small_system());
  const std::string page = system_report_html(r), table = system_report_tsv(r);
  for (const char* words :
       {"id=\"gears\"", "id=\"meshes\"", "id=\"rest\"", "id=\"modes-of-system\"", "id=\"provenance\"",
        "<figure id=\"load-sharing\">", "sun-planet1", "planet3-ring", "What the numbers mean"})
    CHECK(page.find(words) != std::string::npos);
  CHECK(page.find("id=\"motion\"") == std::string::npos);
  CHECK(page.find(">nan<") == std::string::npos);
  CHECK(table.find("sun-planet2\tmesh phase\t") != std::string::npos);
  CHECK(table.find("mode 1\tnatural frequency\t") != std::string::npos);
  SystemReport rigid;
  rigid.scene = "rigid.toml: Rigid";
  rigid.modes = natural_modes(layout_of(planetary_train(3)));
  const std::string of_rigid = system_report_html(rigid);
  CHECK(of_rigid.find("id=\"rest\"") == std::string::npos);
  CHECK(of_rigid.find("rotational") != std::string::npos);

  const auto said = [](SystemReport changed, const auto& change) {
    change(changed);
    return message_of([&] { system_report_html(changed); });
  };
  CHECK(said(r, [](SystemReport& c) { c.modes.reset(); }).find("no modes.h5 given") != std::string::npos);
  CHECK(said(r, [](SystemReport& c) {
          c.pictures.push_back({"fig07", "png"});
        }).find("no words for a figure 'fig07'") != std::string::npos);
  CHECK(said(r, [](SystemReport& c) { c.pictures.push_back(c.pictures[0]); }).find("is given twice") !=
        std::string::npos);
  CHECK(said(r, [](SystemReport& c) {
          c.modes = natural_modes(layout_of(planetary_train(4)));
        }).find("of two systems") != std::string::npos);
}

TEST_CASE("the view of modes: every body moves as a rigid one, and meshes close as the modes say") {
  const SystemStaticArtifact rest = small_system();
  for (const bool elastic : {true, false}) {
    ModesArtifact a = elastic ? elastic_modes(rest) : natural_modes(layout_of(planetary_train(3)));
    const System& s = a.layout;
    std::vector<const GearDesign*> design;
    for (size_t b = 0; b < s.bodies.size(); ++b) {
      const BodyParameters* drawing = elastic ? drawing_of(rest, static_cast<int>(b)) : nullptr;
      design.push_back(drawing ? &drawing->design : nullptr);
    }
    add_mode_view(a, design);
    REQUIRE(a.view.point_data.size() == a.shape.size());
    CHECK(a.view.line.rows() == 3);  // the arms of the carrier
    // Points of each body, by its cells.
    std::vector<std::vector<int>> points(s.bodies.size());
    for (Index e = 0; e < a.view.cell.rows(); ++e)
      for (const int p : a.view.cell.row(e))
        points[static_cast<size_t>(a.view.cell_data[0].values(e, 0))].push_back(p);
    for (size_t mode = 0; mode < a.shape.size(); ++mode) {
      const MatrixRM& moved = a.view.point_data[mode].values;
      CHECK(moved.allFinite());
      double ratio = 0;  // of the drawing to the shape, one number for all meshes
      // X and the turn of each body by least squares over its points.
      std::vector<Eigen::Vector3d> motion(s.bodies.size());
      for (size_t b = 0; b < s.bodies.size(); ++b) {
        if (points[b].empty()) continue;
        const auto n = static_cast<Index>(points[b].size());
        Eigen::MatrixXd left(2 * n, 3);
        Eigen::VectorXd right(2 * n);
        for (Index i = 0; i < n; ++i) {
          const int p = points[b][static_cast<size_t>(i)];
          left.row(2 * i) << 1, 0, -a.view.point(p, 1) / 0.1;
          left.row(2 * i + 1) << 0, 1, a.view.point(p, 0) / 0.1;
          right[2 * i] = moved(p, 0);
          right[2 * i + 1] = moved(p, 1);
        }
        motion[b] = (left.transpose() * left).inverse() * (left.transpose() * right);
        CHECK((left * motion[b] - right).norm() <= 1e-10 * moved.norm());
      }
      for (size_t m = 0; m < s.meshes.size(); ++m) {
        const System::Mesh& mesh = s.meshes[m];
        const System::Body& driver = s.bodies[static_cast<size_t>(mesh.side[0].body)];
        const Vec2 at = Vec2(driver.centre[0], driver.centre[1]) +
                        driver.radius / std::cos(mesh.pressure_angle) *
                            Vec2(std::cos(mesh.direction), std::sin(mesh.direction));
        double closes = 0;
        for (size_t side = 0; side < 2; ++side) {
          const Eigen::Vector3d& q = motion[static_cast<size_t>(mesh.side[side].body)];
          const Vec2 here(q[0] - q[2] * at.y() / 0.1, q[1] + q[2] * at.x() / 0.1);
          closes += (side == 0 ? 1 : -1) * here.dot(line_of_action(mesh));
        }
        const double expected = a.mesh_deflection(static_cast<Index>(mode), static_cast<Index>(m));
        if (std::abs(expected) < 1e-6) continue;
        if (ratio == 0) ratio = closes / expected;
        CHECK(closes / expected == relative(ratio, 1e-6));
        CHECK(ratio > 0);
      }
    }
    const double most = a.view.point_data[0].values.rowwise().norm().maxCoeff();
    CHECK(most ==
          relative(kShownMotion * 0.5 * (a.view.point.col(0).maxCoeff() - a.view.point.col(0).minCoeff()),
                   0.05));
  }
  ModesArtifact none = elastic_modes(rest);
  CHECK(message_of([&] { add_mode_view(none, {}); }).find("needs a drawing, or none, of each") !=
        std::string::npos);
}
