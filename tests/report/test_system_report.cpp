// The report of a system: its picture, load sharing, the page, and the view of its modes.
#include <doctest/doctest.h>

#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "figure_block.h"
#include "gear/layout.h"
#include "gear/pair.h"
#include "gear/system_layout.h"
#include "gear/tooth_contour.h"
#include "refusal.h"
#include "relative.h"
#include "report/alike_meshes.h"
#include "report/figure_list.h"
#include "report/system_picture.h"
#include "small_system.h"
#include "system/mode_view.h"
#include "system/natural_modes.h"

using namespace whine;
using Eigen::Index;

namespace {

constexpr double kPi = std::numbers::pi;

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

}  // namespace

TEST_CASE(
    "the contour of a gear: closed, between tip and root, its teeth are turned images, its flanks involutes") {
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
    // At each of its points on an involute the tooth is as thick as its drawing says; tooth and space change places inside a ring.
    int points = 0;
    const double form = gear.flank_point(gear.form_roll_angle()).norm();
    for (const Vec2& p : tooth) {
      const double r = p.norm(), tooth_angle = std::abs(std::atan2(p.x(), p.y()));
      if (std::abs(r - gear.tip_radius()) < 1e-9 || (r - form) * (internal ? -1 : 1) < 1e-9) continue;
      CHECK(2 * r * tooth_angle == relative(gear.thickness_at_radius(r), 1e-9));
      ++points;
    }
    CHECK(points >= 10);
  }
}

namespace {

// The ring drives three planets and these the sun.
Scene driving_ring() {
  Scene scene = planetary_train(3);
  const std::array teeth{26, 37, 100};
  for (size_t g = 0; g < 3; ++g) scene.gears[g].design = rigid_gear(teeth[g], g == 2);
  std::swap(scene.meshes[0], scene.meshes[1]);
  for (Scene::Mesh& mesh : scene.meshes) {
    std::swap(mesh.spec.gear[0], mesh.spec.gear[1]);
    mesh.spec.centre_distance = 0.5 * 63 * 2.776e-3;
  }
  return scene;
}

// Three gears whose axes form an angle.
Scene idler_at_an_angle() {
  Scene scene;
  const std::array teeth{27, 36, 31};
  const std::array names{"first", "idler", "last"};
  for (size_t g = 0; g < 3; ++g) {
    SceneGear gear;
    gear.name = names[g];
    gear.design = rigid_gear(teeth[g]);
    gear.equivalent_mass = 0.4;
    scene.gears.push_back(gear);
  }
  for (size_t m = 0; m < 2; ++m) {
    Scene::Mesh mesh;
    mesh.spec.gear = {names[m], names[m + 1]};
    mesh.spec.centre_distance = 0.5 * (teeth[m] + teeth[m + 1]) * 2.776e-3;
    mesh.direction = m == 0 ? 0.7 : 2.1;
    scene.meshes.push_back(mesh);
  }
  return scene;
}

// [body] whether it is drawn in the second colour: the two gears of a mesh differ.
std::vector<bool> second_colours(const System& s) {
  std::vector<bool> out(s.bodies.size(), false);
  for (const System::Mesh& mesh : s.meshes)
    out[static_cast<size_t>(mesh.side[1].body)] = !out[static_cast<size_t>(mesh.side[0].body)];
  return out;
}

Vec2 pitch_point_of(const System& s, const System::Mesh& mesh) {
  const System::Body& driver = s.bodies[static_cast<size_t>(mesh.side[0].body)];
  return Vec2(driver.centre[0], driver.centre[1]) +
         driver.radius / std::cos(mesh.pressure_angle) *
             Vec2(std::cos(mesh.direction), std::sin(mesh.direction));
}

}  // namespace

TEST_CASE(
    "the picture of a system: drawn teeth touch where every mesh is at its phase, on its path of contact, arrows turn as bodies do") {
  constexpr double kChord = 5e-6;  // m: of drawn flanks of ten points
  for (const Scene& scene : {planetary_train(3), unequal_train(), driving_ring(), idler_at_an_angle()}) {
    const SystemStaticResult a = small_system(scene);
    const System& s = a.settings.layout;
    const Figure figure = system_picture(a);
    const std::vector<bool> second = second_colours(s);
    const FigureBlock& paths = block(figure, "paths");
    REQUIRE(paths.rows.size() == 3 * s.meshes.size());
    for (size_t m = 0; m < s.meshes.size(); ++m) {
      const System::Mesh& mesh = s.meshes[m];
      const GearPair pair(drawing_of(a, mesh.side[0].body)->design, drawing_of(a, mesh.side[1].body)->design,
                          mesh.centre_distance);
      // The pair that is at the mesh's phase, or the one that follows it.
      double path = mesh.phase * pair.base_pitch();
      if (path > pair.path_end()) path -= pair.base_pitch();
      const Vec2 pitch = pitch_point_of(s, mesh), at = pitch + path * line_of_action(mesh);
      for (const System::Side& side : mesh.side) {
        const bool ring = is_ring(s, side.body), other = second[static_cast<size_t>(side.body)];
        CAPTURE(s.bodies[static_cast<size_t>(side.body)].name);
        const char* of = ring ? (other ? "second_hollow" : "hollow") : other ? "planets" : "central";
        CHECK(distance_to(block(figure, of), at) < kChord);
      }
      const auto end = [&](size_t row) {
        return Vec2(paths.rows[3 * m + row][0] * 1e-3, paths.rows[3 * m + row][1] * 1e-3);
      };
      CHECK((end(0) - pitch - pair.path_start() * line_of_action(mesh)).norm() < 1e-12);
      CHECK((end(1) - pitch - pair.path_end() * line_of_action(mesh)).norm() < 1e-12);
      // The line of action is a common tangent of the base circles.
      for (const System::Side& side : mesh.side) {
        const System::Body& body = s.bodies[static_cast<size_t>(side.body)];
        const Vec2 way = line_of_action(mesh), from = pitch - Vec2(body.centre[0], body.centre[1]);
        CHECK(std::abs(way.x() * from.y() - way.y() * from.x()) == relative(body.radius, 1e-9));
      }
    }
    // Arrows: the head of each lies on a circle about its body, in its sense.
    const FigureBlock& heads = block(figure, "heads");
    size_t row = 0;
    for (const System::Body& body : s.bodies) {
      if (body.kind == System::BodyKind::carrier) continue;
      REQUIRE(row < heads.rows.size());
      const double x = heads.rows[row][0] * 1e-3 - body.centre[0],
                   y = heads.rows[row][1] * 1e-3 - body.centre[1];
      CHECK((x * heads.rows[row][3] - y * heads.rows[row][2]) * body.sense > 0);
      ++row;
    }
  }
  const System s = layout_of(planetary_train(3));
  CHECK(is_ring(s, 4));
  CHECK(!is_ring(s, 0));
  // Rigid gears: a pitch circle for each mesh, and a line of action of one base pitch.
  const Figure rigid = system_picture(natural_modes(s));
  CHECK(block(rigid, "circles").rows.size() > 6 * 180);
  const FigureBlock& lines = block(rigid, "paths");
  const double length =
      std::hypot(lines.rows[1][0] - lines.rows[0][0], lines.rows[1][1] - lines.rows[0][1]) * 1e-3;
  CHECK(length == relative(2 * kPi * s.bodies[0].radius / s.bodies[0].teeth, 1e-9));
  CHECK(std::any_of(rigid.notes.begin(), rigid.notes.end(),
                    [](const std::string& note) { return contains(note, "one base pitch long"); }));
  for (const FigureBlock& of : rigid.blocks) CHECK(of.name != "central");
}

TEST_CASE("load sharing: loads of tooth pairs are continuous over a period of the mesh, whatever its phase") {
  // Load of a pair by its place on the path, in base pitches.
  const auto load_at = [](double x) { return 1000 * std::max(0.0, 1 - std::pow((x - 0.3) / 0.9, 2)); };
  for (const double phase : {0.0, 0.37, 0.995}) {
    SystemStaticResult a = small_system();
    a.settings.layout.meshes[0].phase = phase;
    constexpr Index kPhases = 64;
    a.mesh_phase = Eigen::VectorXd::LinSpaced(kPhases + 1, 0, 1).head(kPhases);
    MatrixRM& load = a.mesh[0].tooth_load;
    load = MatrixRM::Zero(kPhases, 3);
    for (Index i = 0; i < kPhases; ++i) {
      double own = a.mesh_phase[i] + phase;
      own -= std::floor(own);
      for (Index p = 0; p < 3; ++p) load(i, p) = load_at(own + static_cast<double>(a.mesh[0].pair[p]));
    }
    for (StaticResult& other : a.mesh) other.tooth_load = load;
    a.load_share = MatrixRM::Constant(kPhases, 6, 1.0 / 3);
    const Figure figure = system_load_sharing_figure(a);
    const FigureBlock& loads = block(figure, "loads 1");
    REQUIRE(loads.rows.size() >= kPhases + 1);
    CHECK(loads.rows.front()[0] == 0);
    CHECK(loads.rows.back()[0] == 1);
    for (size_t r = 0; r < loads.rows.size(); ++r) {
      const bool end = r == 0 || r + 1 == loads.rows.size();
      if (r > 0) CHECK(loads.rows[r][0] > loads.rows[r - 1][0]);
      for (size_t p = 0; p < 3; ++p) {
        const double expected = load_at(loads.rows[r][0] + a.mesh[0].pair[static_cast<Index>(p)]);
        // At the ends between two positions.
        CHECK(std::abs(loads.rows[r][p + 1] - expected) < (end ? 0.2 : 1e-9));
      }
    }
    for (size_t p = 0; p < 2; ++p)
      CHECK(std::abs(loads.rows.back()[p + 1] - loads.rows.front()[p + 2]) < 1e-9);
  }
}

TEST_CASE("load sharing of a system: the factor of known shares, and a system that has none says so") {
  SystemStaticResult a = small_system();
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
  const FigureBlock& share = block(figure, "share 1");
  REQUIRE(share.rows.size() == 3);
  CHECK(share.rows[0][2] == relative(40, 1e-12));
  CHECK(share.rows[2] == std::vector<double>{1, share.rows[0][1], share.rows[0][2], share.rows[0][3]});
  a.settings.section = {0, 1, 2, 3, 4, 5};
  a.settings.mesh.resize(6);
  CHECK(names(message_of_input([&] { system_static_figure(SystemStaticResult{}); }), {"of a pair"}));
  CHECK(names(message_of_input([&] { system_load_sharing_figure(a); }), {"several", "planets"}));
}

TEST_CASE("the view of modes: every body moves as a rigid one, and meshes close as the modes say") {
  const SystemStaticResult rest = small_system();
  for (const bool elastic : {true, false}) {
    ModesResult a = elastic ? elastic_modes(rest) : natural_modes(layout_of(planetary_train(3)));
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
    for (Index e = 0; e < a.view.line.rows(); ++e)
      for (const int p : a.view.line.row(e))
        points[static_cast<size_t>(a.view.cell_data[0].values(a.view.cell.rows() + e, 0))].push_back(p);
    for (size_t mode = 0; mode < a.shape.size(); ++mode) {
      const MatrixRM& moved = a.view.point_data[mode].values;
      CHECK(moved.allFinite());
      // Of the drawing to the shape, one number for all meshes: the largest displacement is kShownMotion of half the width.
      double largest = 0;
      for (size_t b = 0; b < s.bodies.size(); ++b)
        for (const int p : points[b]) {
          const double turn =
              s.bodies[b].sense * a.shape[mode](static_cast<Index>(b), 0) / s.bodies[b].radius;
          const Vec2 arm(a.view.point(p, 0) - s.bodies[b].centre[0],
                         a.view.point(p, 1) - s.bodies[b].centre[1]);
          largest = std::max(largest, std::hypot(a.shape[mode](static_cast<Index>(b), 1) - turn * arm.y(),
                                                 a.shape[mode](static_cast<Index>(b), 2) + turn * arm.x()));
        }
      const double half = 0.5 *
                          (a.view.point.colwise().maxCoeff() - a.view.point.colwise().minCoeff()).maxCoeff(),
                   ratio = kShownMotion * half / largest;
      CHECK(moved.rowwise().norm().maxCoeff() == relative(kShownMotion * half, 1e-9));
      const double scale = a.mesh_deflection.row(static_cast<Index>(mode)).cwiseAbs().maxCoeff();
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
        CHECK(std::abs(closes - ratio * expected) < 1e-6 * ratio * std::max(scale, 1e-6));
      }
    }
  }
  ModesResult none = elastic_modes(rest);
  CHECK(names(message_of_input([&] { add_mode_view(none, {}); }), {"drawing", "needs"}));
  // A layout of carriers alone has nothing to show.
  ModesResult bare;
  bare.layout.bodies.resize(0);
  add_mode_view(bare, {});
  CHECK(bare.view.point.rows() == 0);
}
