// One static position of two whole gears by CalculiX (Dhondt, The Finite Element Method for Three-dimensional
// Thermomechanical Applications, 2004): quadratic triangles in plane strain, fine where the flanks touch, bore of the driven
// gear fixed, bore of the driver turned as a rigid ring, contact of surfaces by a penalty that is stiff against the teeth. The driven
// gear may be internal: its rim is then fixed, and it works with its trailing flanks.
#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/ccx.h"
#include "bench/gear_mesh.h"
#include "gear/pair.h"

namespace whine {

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

  // rotation: rad, of the driver's bore from where the unloaded flanks touch. Throws Error(numerical) if ccx does not
  // converge; its files then stay where the message says.
  CalculixPosition solve(double rotation) const {
    const CalculixFolder folder;
    const std::array<Mesh, 2> meshes{mesh(0), mesh(1)};
    write_deck(folder.file("pair.inp"), meshes, rotation);
    CalculixPosition result;
    result.nodes = static_cast<int>(meshes[0].node.size() + meshes[1].node.size());
    result.usage = folder.run("pair");
    result.torque = read_torque(folder.file("pair.dat"), meshes);
    if (root_ > 0) result.root_stress = read_root_stress(folder.file("pair.frd"), meshes);
    for (std::size_t g = 0; g < 2; ++g) result.root_parameter[g] = meshes[g].root_parameter;
    return result;
  }

 private:
  struct Mesh : GearMesh {                              // in the plane of both gears
    std::vector<std::pair<std::size_t, int>> contact;   // element (from 0), side (from 1) on flanks in reach
    std::vector<std::pair<std::size_t, Vec2>> tangent;  // of the nodes of the root, from the flank on
    std::vector<double> root_parameter;                 // 1: of these nodes
    Vec2 centre;
  };

  static double angle_of(const Vec2& v) { return std::atan2(v.y(), v.x()); }

  // Whether gear g works with the flank that trails in counter-clockwise rotation, the mirror image of flank_point().
  bool trails(int g) const { return g == 1 && gears_.internal(); }

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

  // Where pairs touch, or would a little later: tooth, roll angle.
  std::vector<std::pair<int, double>> places(int g) const {
    std::vector<std::pair<int, double>> out;
    const int teeth = gears_.gear(g).design().teeth;
    for (int pair = -1; pair <= 1; ++pair)
      out.emplace_back(((g == 0 || trails(g) ? pair : -pair) + teeth) % teeth,
                       gears_.contact(phase_ + pair).roll[g]);
    return out;
  }

  Mesh mesh(int g) const {
    const ToothGeometry& tooth = gears_.gear(g);
    const double module = tooth.design().module;
    GearMeshPlan plan;
    plan.turned = turn(g);
    plan.trailing = trails(g);
    plan.coarse = module;
    const GearMesher bare(tooth, plan);
    FineAround touching{{}, element_, 0.1 * module}, of_root{{}, root_, 4 * root_};
    for (const auto& [number, roll] : places(g))
      touching.point.push_back(bare.placed(number, bare.on_flank(roll), trails(g)));
    for (int i = 0; root_ > 0 && i <= 200; ++i)
      of_root.point.push_back(bare.placed(0, tooth.root_point(i / 200.0), false));
    plan.fine.push_back(touching);
    if (root_ > 0) plan.fine.push_back(of_root);
    Mesh mesh{GearMesher(tooth, plan).mesh(), {}, {}, {}, centre(g)};
    const double reach = 0.12 * module;  // contact is looked for so far from the nominal points
    std::map<std::size_t, bool> near;    // nodes of these flanks, and whether they lie in reach
    for (std::size_t i = 0; i < touching.point.size(); ++i)
      for (const FlankNode& node : mesh.flank[0][static_cast<std::size_t>(places(g)[i].first)])
        near[node.tag] = (mesh.node.at(node.tag) - touching.point[i]).norm() < reach;
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
      std::map<int, std::size_t> along;  // by the nearest of steps on the root curve
      const auto on_root = [&](int k) { return bare.placed(0, tooth.root_point(double(k) / kSteps), false); };
      for (std::size_t tag : mesh.root) {
        int nearest = 0;
        for (int k = 1; k <= kSteps; ++k)
          if ((on_root(k) - mesh.node.at(tag)).norm() < (on_root(nearest) - mesh.node.at(tag)).norm())
            nearest = k;
        along[nearest] = tag;
      }
      for (const auto& [k, tag] : along) {
        const Vec2 tangent = on_root(std::min(k + 1, kSteps)) - on_root(std::max(k - 1, 0));
        mesh.tangent.emplace_back(tag, tangent.normalized());
        mesh.root_parameter.push_back(double(k) / kSteps);
      }
    }
    for (auto& [tag, p] : mesh.node) p += mesh.centre;
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
      for (const auto& [tag, tangent] : meshes[g].tangent) {
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
