// One static position of two whole gears by CalculiX (Dhondt, The Finite Element Method for Three-dimensional
// Thermomechanical Applications, 2004): quadratic triangles in plane strain, fine where the flanks touch, bore of the driven
// gear fixed, bore of the driver turned as a rigid ring, contact of surfaces by a penalty that is stiff against the teeth. The driven
// gear may be internal: its rim is then fixed, and it works with its trailing flanks.
#pragma once
#include <gmsh.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "gear/pair.h"

namespace whine {

// What a child process took.
struct Usage {
  double seconds = 0;    // CPU, user and system
  double megabytes = 0;  // largest resident set
};

// Waits for a child; throws Error(numerical) with `what` if it did not end with status 0.
inline Usage wait_for(pid_t child, const std::string& what) {
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child || !WIFEXITED(status) || WEXITSTATUS(status) != 0)
    fail(Failure::numerical, what, " ended with status ", WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return {seconds(usage.ru_utime) + seconds(usage.ru_stime), double(usage.ru_maxrss) / 1024};
}

struct CalculixPosition {
  double torque =
      0;          // N m about the driven gear's axis, by the reaction of its bore or rim; positive under load
  int nodes = 0;  // of both gears, in the plane
  Usage usage;    // of ccx alone
  // [gear] Pa: tangential stress at the nodes of the root beside the loaded flank of tooth 0, from the flank on; empty unless
  // roots are asked for
  std::array<std::vector<double>, 2> root_stress;
  std::array<std::vector<double>, 2>
      root_parameter;  // [gear] 1: of these nodes, t of ToothGeometry::root_point
};

class CalculixPair {
 public:
  // material: of both gears, in plane strain; phase: of a pair on the line of action, throws Error(input)
  // otherwise; element: m, side of the triangles where the flanks touch; root: the same on the roots of tooth 0 beside the loaded
  // flanks, 0: as coarse as the rest, and no stress is read.
  CalculixPair(const GearPair& gears, const Material& material, double phase, double element, double root = 0)
      : gears_(gears), material_(material), phase_(phase), element_(element), root_(root) {
    if (gears.contact(phase).corner)
      fail(Failure::input, "mesh phase ", phase,
           " has a corner contact; CalculiX is set up from a pair on the line of action");
    if (gears.ring() == 0)
      fail(Failure::input, "the driver is an internal gear; CalculiX is set up for one that is driven");
    const double off = centre(1).norm() / gears.centre_distance() - 1;
    if (std::abs(off) > 1e-9)
      fail(Failure::numerical, "the gears stand at another centre distance than that of the pair, by ", off);
  }

  static bool installed() { return std::system("command -v ccx > /dev/null 2>&1") == 0; }

  // rotation: rad, of the driver's bore from where the unloaded flanks touch. Throws Error(numerical) if ccx does not
  // converge; its files then stay where the message says.
  CalculixPosition solve(double rotation) const {
    namespace fs = std::filesystem;
    std::string folder = (fs::temp_directory_path() / "whine-bench-XXXXXX").string();
    if (!mkdtemp(folder.data())) fail(Failure::io, "no folder ", folder, " for the deck of CalculiX");
    const std::array<Mesh, 2> meshes{mesh(0), mesh(1)};
    write_deck(folder + "/pair.inp", meshes, rotation);
    CalculixPosition result;
    result.nodes = static_cast<int>(meshes[0].node.size() + meshes[1].node.size());
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      setenv("OMP_NUM_THREADS", "1", 1);
      setenv("CCX_NPROC_EQUATION_SOLVER", "1", 1);
      if (chdir(folder.c_str()) == 0 && std::freopen("ccx.log", "w", stdout) &&
          std::freopen("ccx.err", "w", stderr))
        execlp("ccx", "ccx", "-i", "pair", static_cast<char*>(nullptr));
      _exit(127);
    }
    result.usage = wait_for(child, "ccx in " + folder);
    result.torque = read_torque(folder + "/pair.dat", meshes);
    if (root_ > 0) result.root_stress = read_root_stress(folder + "/pair.frd", meshes);
    for (std::size_t g = 0; g < 2; ++g) result.root_parameter[g] = meshes[g].root_parameter;
    fs::remove_all(folder);
    return result;
  }

 private:
  struct Mesh {
    std::map<std::size_t, Vec2> node;                 // m, in the plane of both gears
    std::vector<std::array<std::size_t, 6>> element;  // corners counter-clockwise, mid-sides
    std::vector<std::size_t> bore;
    std::vector<std::pair<std::size_t, int>> contact;  // element (from 0), side (from 1) on flanks in reach
    std::vector<std::pair<std::size_t, Vec2>> root;    // node, tangent, from the flank on; of tooth 0
    std::vector<double> root_parameter;                // 1: of the nodes of `root`
    Vec2 centre;
  };

  static double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

  // Whether gear g works with the flank that trails in counter-clockwise rotation, the mirror image of flank_point().
  bool trails(int g) const { return g == 1 && gears_.internal(); }
  static Vec2 as_it_works(bool trailing, const Vec2& p) { return {trailing ? -p.x() : p.x(), p.y()}; }

  // The common normal of the flanks lies along x; the driver's centre is the origin.
  double turn(int g) const {
    const Vec2 normal = as_it_works(trails(g), gears_.gear(g).flank_normal(gears_.contact(phase_).roll[g]));
    return (g == 0 ? 0 : std::numbers::pi) - angle_of(normal);
  }
  Vec2 centre(int g) const {
    if (g == 0) return Vec2::Zero();
    const PairContact contact = gears_.contact(phase_);
    const Vec2 touch = Eigen::Rotation2Dd(turn(0)) * gears_.gear(0).flank_point(contact.roll[0]);
    return touch -
           Eigen::Rotation2Dd(turn(1)) * as_it_works(trails(1), gears_.gear(1).flank_point(contact.roll[1]));
  }

  Mesh mesh(int g) const {
    constexpr double kScale = 1e3;  // gmsh's tolerances are meant for numbers near 1
    constexpr double kGrowth = 0.2;
    const ToothGeometry& tooth = gears_.gear(g);
    const double even = 0.1 * tooth.design().module, coarse = tooth.design().module;  // m
    const int teeth = tooth.design().teeth;
    const Vec2 middle = centre(g);
    const double turned = turn(g);
    Mesh mesh;
    mesh.centre = middle;

    gmsh::initialize(0, nullptr, false);
    gmsh::option::setNumber("General.Terminal", 0);
    gmsh::option::setNumber("General.NumThreads", 1);
    gmsh::model::add("gear");
    namespace geo = gmsh::model::geo;
    const auto point = [&](const Vec2& p) { return geo::addPoint(p.x() * kScale, p.y() * kScale, 0); };
    const auto spline = [&](int from, int to, int pieces, const std::function<Vec2(double)>& curve) {
      std::vector<int> points{from};
      for (int i = 1; i < pieces; ++i) points.push_back(point(curve(double(i) / pieces)));
      points.push_back(to);
      return geo::addSpline(points);
    };
    const double form = tooth.form_roll_angle(), tip = tooth.tip_roll_angle();
    std::vector<int> outer, flank_of_tooth;
    int root_of_tooth = 0;          // 0
    std::vector<int> first(teeth);  // point in the tooth space clockwise of the tooth
    const auto placed = [&](int j, const Vec2& p, bool mirrored) -> Vec2 {
      return Eigen::Rotation2Dd(turned + 2 * std::numbers::pi * j / teeth) * as_it_works(mirrored, p);
    };
    const auto on_flank = [&](double roll) {
      return tooth.flank_point(std::clamp(roll, tooth.least_roll_angle(), tooth.largest_roll_angle()));
    };
    for (int j = 0; j < teeth; ++j) first[j] = point(placed(j, tooth.root_point(1), true));
    const int axis = point({0, 0});
    for (int j = 0; j < teeth; ++j) {
      const int a = point(placed(j, tooth.flank_point(form), true)),
                b = point(placed(j, tooth.flank_point(tip), true));
      const int c = point(placed(j, tooth.flank_point(tip), false)),
                d = point(placed(j, tooth.flank_point(form), false));
      const auto flank = [&](double t) { return tooth.flank_point(form + (tip - form) * t); };
      outer.push_back(
          spline(first[j], a, 30, [&](double t) { return placed(j, tooth.root_point(1 - t), true); }));
      outer.push_back(spline(a, b, 60, [&](double t) { return placed(j, flank(t), true); }));
      if (trails(g)) flank_of_tooth.push_back(outer.back());
      outer.push_back(geo::addCircleArc(b, axis, c));
      outer.push_back(spline(c, d, 60, [&](double t) { return placed(j, flank(1 - t), false); }));
      if (!trails(g)) flank_of_tooth.push_back(outer.back());
      outer.push_back(spline(d, first[(j + 1) % teeth], root_ > 0 ? 200 : 30,
                             [&](double t) { return placed(j, tooth.root_point(t), false); }));
      if (j == 0) root_of_tooth = outer.back();
    }
    std::vector<int> bore, quarter;
    for (int k = 0; k < 4; ++k)
      quarter.push_back(point(tooth.design().clamped_radius() *
                              Vec2(std::cos(k * std::numbers::pi / 2), std::sin(k * std::numbers::pi / 2))));
    for (int k = 0; k < 4; ++k) bore.push_back(geo::addCircleArc(quarter[k], axis, quarter[(k + 1) % 4]));
    std::vector<int> loops{geo::addCurveLoop(outer), geo::addCurveLoop(bore)};
    if (tooth.internal()) std::swap(loops[0], loops[1]);
    const int surface = geo::addPlaneSurface(loops);
    geo::remove({{0, axis}});

    // Where pairs touch, or would a little later.
    std::vector<std::pair<int, Vec2>> places;  // tooth, nominal point in the body's own place
    std::vector<double> touching;
    for (int pair = -1; pair <= 1; ++pair) {
      const PairContact contact = gears_.contact(phase_ + pair);
      const int number = ((g == 0 || trails(g) ? pair : -pair) + teeth) % teeth;
      places.emplace_back(number, placed(number, on_flank(contact.roll[g]), trails(g)));
      touching.push_back(point(places.back().second));
    }
    std::vector<double> of_root;
    for (int i = 0; root_ > 0 && i <= 200; ++i)
      of_root.push_back(point(placed(0, tooth.root_point(i / 200.0), false)));
    geo::synchronize();
    namespace field = gmsh::model::mesh::field;
    const int distance = field::add("Distance"), threshold = field::add("Threshold");
    field::setNumbers(distance, "PointsList", touching);
    field::setNumber(threshold, "InField", distance);
    field::setNumber(threshold, "SizeMin", element_ * kScale);
    field::setNumber(threshold, "DistMin", even * kScale);
    field::setNumber(threshold, "SizeMax", coarse * kScale);
    field::setNumber(threshold, "DistMax", (even + (coarse - element_) / kGrowth) * kScale);
    if (root_ > 0) {
      const int from_root = field::add("Distance"), at_root = field::add("Threshold"),
                least = field::add("Min");
      field::setNumbers(from_root, "PointsList", of_root);
      field::setNumber(at_root, "InField", from_root);
      field::setNumber(at_root, "SizeMin", root_ * kScale);
      field::setNumber(at_root, "DistMin", 4 * root_ * kScale);
      field::setNumber(at_root, "SizeMax", coarse * kScale);
      field::setNumber(at_root, "DistMax", (4 * root_ + (coarse - root_) / kGrowth) * kScale);
      field::setNumbers(least, "FieldsList", {double(threshold), double(at_root)});
      field::setAsBackgroundMesh(least);
    } else {
      field::setAsBackgroundMesh(threshold);
    }
    for (const char* off :
         {"Mesh.MeshSizeExtendFromBoundary", "Mesh.MeshSizeFromPoints", "Mesh.MeshSizeFromCurvature"})
      gmsh::option::setNumber(off, 0);
    gmsh::option::setNumber("Mesh.Algorithm", 6);
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::setOrder(2);

    std::vector<std::size_t> tags, nodes;
    std::vector<double> at, parameters;
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> element_tags, element_nodes;
    gmsh::model::mesh::getElements(types, element_tags, element_nodes, 2, surface);
    for (size_t t = 0; t < types.size(); ++t)
      for (size_t e = 0; e < element_tags[t].size(); ++e) {
        std::array<std::size_t, 6> six;
        std::copy_n(element_nodes[t].begin() + static_cast<std::ptrdiff_t>(6 * e), 6, six.begin());
        mesh.element.push_back(six);
      }
    gmsh::model::mesh::getNodes(tags, at, parameters, 2, surface, true, false);
    for (size_t i = 0; i < tags.size(); ++i) mesh.node[tags[i]] = Vec2(at[3 * i], at[3 * i + 1]) / kScale;
    for (int curve : bore) {
      gmsh::model::mesh::getNodes(tags, at, parameters, 1, curve, true, false);
      mesh.bore.insert(mesh.bore.end(), tags.begin(), tags.end());
    }
    std::sort(mesh.bore.begin(), mesh.bore.end());
    mesh.bore.erase(std::unique(mesh.bore.begin(), mesh.bore.end()), mesh.bore.end());
    const double reach =
        0.12 * tooth.design().module;  // contact is looked for so far from the nominal points
    std::map<std::size_t, bool> near;  // nodes of these flanks, and whether they lie in reach
    for (const auto& [number, place] : places) {
      gmsh::model::mesh::getNodes(tags, at, parameters, 1, flank_of_tooth[number], true, false);
      for (std::size_t tag : tags) {  // from the spline onto the involute
        Vec2& p = mesh.node.at(tag);
        p = placed(number, on_flank(tooth.roll_angle_at_radius(p.norm())), trails(g));
        near[tag] = (p - place).norm() < reach;
      }
    }
    for (size_t e = 0; e < mesh.element.size(); ++e)
      for (int s = 0; s < 3; ++s) {
        const auto middle_node = near.find(mesh.element[e][3 + s]);
        if (middle_node != near.end() && near.contains(mesh.element[e][s]) &&
            near.contains(mesh.element[e][(s + 1) % 3]) && middle_node->second)
          mesh.contact.emplace_back(e, s + 1);
      }
    if (root_ > 0) {
      // From the spline onto the root curve's own tangents.
      constexpr int kSteps = 2000;
      gmsh::model::mesh::getNodes(tags, at, parameters, 1, root_of_tooth, true, false);
      std::map<int, std::size_t> along;  // by the nearest of steps on the root curve
      const auto on_root = [&](int k) { return placed(0, tooth.root_point(double(k) / kSteps), false); };
      for (std::size_t tag : tags) {
        int nearest = 0;
        for (int k = 1; k <= kSteps; ++k)
          if ((on_root(k) - mesh.node.at(tag)).norm() < (on_root(nearest) - mesh.node.at(tag)).norm())
            nearest = k;
        along[nearest] = tag;
      }
      for (const auto& [k, tag] : along) {
        const Vec2 tangent = on_root(std::min(k + 1, kSteps)) - on_root(std::max(k - 1, 0));
        mesh.root.emplace_back(tag, tangent.normalized());
        mesh.root_parameter.push_back(double(k) / kSteps);
      }
    }
    gmsh::finalize();
    for (auto& [tag, p] : mesh.node) p += middle;
    return mesh;
  }

  void write_deck(const std::string& path, const std::array<Mesh, 2>& meshes, double rotation) const {
    std::ofstream out(path);
    out << std::setprecision(12);
    // Softer would add to the deflection, harder makes the number of iterations grow.
    const double penalty = 20 * material_.youngs_modulus * 1e-6 / (element_ * 1e3);  // N mm-3
    std::size_t offset = 0, elements = 0;
    for (int g = 0; g < kSides; ++g) {
      const Mesh& gear = meshes[g];
      out << "*NODE, NSET=N" << g << "\n";
      for (const auto& [tag, p] : gear.node)
        out << tag + offset << ", " << p.x() * 1e3 << ", " << p.y() * 1e3 << ", 0\n";
      out << "*ELEMENT, TYPE=CPE6, ELSET=E" << g << "\n";
      for (size_t e = 0; e < gear.element.size(); ++e) {
        out << elements + e + 1;
        for (std::size_t tag : gear.element[e]) out << ", " << tag + offset;
        out << "\n";
      }
      out << "*SURFACE, NAME=FLANK" << g << ", TYPE=ELEMENT\n";
      for (const auto& [e, side] : gear.contact) out << elements + e + 1 << ", S" << side << "\n";
      out << "*NSET, NSET=BORE" << g << "\n";
      for (std::size_t tag : gear.bore) out << tag + offset << ",\n";
      if (g == 0) {
        const std::size_t handle = 9000000;
        out << "*NODE, NSET=HANDLE\n" << handle << ", 0, 0, 0\n";
        for (std::size_t tag : gear.bore) {
          const Vec2 p = gear.node.at(tag) * 1e3;
          out << "*EQUATION\n2\n" << tag + offset << ", 1, 1, " << handle << ", 1, " << p.y() << "\n";
          out << "*EQUATION\n2\n" << tag + offset << ", 2, 1, " << handle << ", 1, " << -p.x() << "\n";
        }
      }
      offset += gear.node.rbegin()->first;
      elements += gear.element.size();
    }
    out << "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
        << material_.youngs_modulus * 1e-6 << ", " << material_.poisson_ratio << "\n";
    for (int g = 0; g < kSides; ++g)
      out << "*SOLID SECTION, ELSET=E" << g << ", MATERIAL=STEEL\n"
          << gears_.gear(g).design().face_width * 1e3 << "\n";
    out << "*SURFACE INTERACTION, NAME=TOUCH\n*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
        << penalty << "\n";
    out << "*CONTACT PAIR, INTERACTION=TOUCH, TYPE=SURFACE TO SURFACE\nFLANK0, FLANK1\n";
    out << "*STEP\n*STATIC, DIRECT\n1, 1\n*BOUNDARY\nBORE1, 1, 2\nHANDLE, 1, 1, " << rotation << "\n";
    out << "*NODE PRINT, NSET=BORE1\nRF\n";
    if (root_ > 0) out << "*EL FILE, OUTPUT=2D\nS\n";
    out << "*END STEP\n";
    if (!out) fail(Failure::io, path, " could not be written");
    out.close();
  }

  // Reaction of the driven bore: lines of node, fx, fy, fz (N).
  double read_torque(const std::string& path, const std::array<Mesh, 2>& meshes) const {
    std::ifstream in(path);
    const std::size_t offset = meshes[0].node.rbegin()->first;
    double torque = 0;
    std::size_t count = 0;
    for (std::string line; std::getline(in, line);) {
      if (line.find("forces") != std::string::npos) torque = 0, count = 0;  // of a later increment
      std::istringstream words(line);
      std::size_t tag = 0;
      double x = 0, y = 0, z = 0;
      if (!(words >> tag >> x >> y >> z)) continue;
      const Vec2 arm = meshes[1].node.at(tag - offset) - meshes[1].centre;
      torque += arm.x() * y - arm.y() * x;
      ++count;
    }
    if (count != meshes[1].bore.size())
      fail(Failure::numerical, path, " holds ", count, " reactions, the driven bore has ",
           meshes[1].bore.size(), " nodes");
    return trails(1) ? -torque : torque;
  }

  // Stress at nodes as CalculiX has it: carried over from the integration points of each element, mean over the elements at a
  // node. Lines of -1, node, xx, yy, zz, xy, yz, zx in fixed columns, MPa.
  static std::array<std::vector<double>, 2> read_root_stress(const std::string& path,
                                                             const std::array<Mesh, 2>& meshes) {
    std::ifstream in(path);
    std::map<std::size_t, Eigen::Matrix2d> stress;
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
      if (line.rfind(" -4", 0) == 0) inside = line.find("STRESS") != std::string::npos;
      if (line.rfind(" -3", 0) == 0) inside = false;
      if (!inside || line.rfind(" -1", 0) != 0 || line.size() < 13 + 4 * 12) continue;
      const auto value = [&](std::size_t k) { return std::stod(line.substr(13 + 12 * k, 12)); };
      Eigen::Matrix2d& s = stress[std::stoul(line.substr(3, 10))];
      s << value(0), value(3), value(3), value(1);
    }
    std::array<std::vector<double>, 2> out;
    for (std::size_t g = 0; g < 2; ++g)
      for (const auto& [tag, tangent] : meshes[g].root) {
        const auto found = stress.find(tag + (g == 0 ? 0 : meshes[0].node.rbegin()->first));
        if (found == stress.end())
          fail(Failure::numerical, path, " holds no stress at node ", tag, " of gear ", g);
        out[g].push_back(tangent.dot(found->second * tangent) * 1e6);
      }
    return out;
  }

  const GearPair& gears_;
  Material material_;
  double phase_, element_, root_;
};

}  // namespace whine
