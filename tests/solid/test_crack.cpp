// A cracked tooth: where the slit lies, its mesh, what it adds to the flexibility, and how that follows the tooth.
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "base/dense.h"
#include "base/error.h"
#include "contact/half_plane.h"
#include "cracked_gear.h"
#include "gear/crack.h"
#include "io/artifacts.h"
#include "io/scene.h"
#include "own_folder.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "results/sector_grid.h"
#include "results/static.h"
#include "scene_file.h"
#include "solid/crack.h"
#include "solid/elements.h"
#include "solid/flank_table.h"
#include "solid/mesher.h"
#include "solid/reduce.h"
#include "solid/root_stress.h"
#include "solid/sector.h"

namespace {

using namespace whine;
using Eigen::Index;
Eigen::VectorXd table_of(const GearDesign& design, int points = BodyDiscretisation{}.flank_points) {
  return FlankTable(ToothGeometry(design), points).points();
}

// Displacements K^-1 f of a mesh whose held unknowns are zero.
Eigen::MatrixXd solved(const SparseReal& stiffness, const std::vector<char>& held,
                       const Eigen::MatrixXd& force) {
  std::vector<int> free(static_cast<size_t>(stiffness.rows()), -1);
  int count = 0;
  for (Index i = 0; i < stiffness.rows(); ++i)
    if (!held[static_cast<size_t>(i)]) free[static_cast<size_t>(i)] = count++;
  std::vector<Eigen::Triplet<double>> entries;
  for (Index c = 0; c < stiffness.cols(); ++c)
    for (SparseReal::InnerIterator it(stiffness, c); it; ++it)
      if (free[static_cast<size_t>(it.row())] >= 0 && free[static_cast<size_t>(c)] >= 0)
        entries.emplace_back(free[static_cast<size_t>(it.row())], free[static_cast<size_t>(c)], it.value());
  SparseReal k(count, count);
  k.setFromTriplets(entries.begin(), entries.end());
  Eigen::MatrixXd f(count, force.cols());
  for (Index i = 0; i < force.rows(); ++i)
    if (free[static_cast<size_t>(i)] >= 0) f.row(free[static_cast<size_t>(i)]) = force.row(i);
  const Eigen::SimplicialLDLT<SparseReal> factor(k);
  REQUIRE(factor.info() == Eigen::Success);
  const Eigen::MatrixXd x = factor.solve(f);
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(force.rows(), force.cols());
  for (Index i = 0; i < force.rows(); ++i)
    if (free[static_cast<size_t>(i)] >= 0) u.row(i) = x.row(free[static_cast<size_t>(i)]);
  return u;
}

// Rotation (rad per N m) that an edge crack of depth a adds to a strip in bending: 2 b / E times the integral of (K / M)^2
// (Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook, appendix B), K by Brown and Srawley, ASTM STP 410 (1966),
// 0.2 % up to a = 0.6 w.
double handbook_rotation(double a, double w, double thickness, double modulus) {
  const GaussRule rule = gauss_rule(40);
  double sum = 0;
  for (int g = 0; g < 40; ++g) {
    const double x = 0.5 * a * (1 + rule.point[g]), r = x / w;
    const double shape = 1.122 - 1.40 * r + 7.33 * r * r - 13.08 * r * r * r + 14.0 * r * r * r * r;
    const double k = 6 / (thickness * w * w) * std::sqrt(kPi * x) * shape;
    sum += 0.5 * a * rule.weight[g] * k * k;
  }
  return 2 * thickness / modulus * sum;
}

// The same by finite elements: a strip of width w and six times that length, its crack in the middle of the left side.
// finest: m, element size at the tip.
double strip_rotation(double a, double w, double element, double finest, bool second) {
  const double thickness = 0.02, length = 6 * w;
  const int across = static_cast<int>(std::round(w / element)),
            along = 2 * static_cast<int>(std::round(length / element / 2));
  std::vector<Vec2> corner, middle;
  const auto line = [&](const Vec2& from, const Vec2& to, int n) {
    for (int i = 0; i < n; ++i) {
      corner.push_back(from + (to - from) * i / n);
      middle.push_back(from + (to - from) * (i + 0.5) / n);
    }
  };
  line({0, 0}, {w, 0}, across);
  line({w, 0}, {w, length}, along);
  line({w, length}, {0, length}, across);
  const size_t left = corner.size();
  line({0, length}, {0, 0}, along);
  const size_t mouth = left + static_cast<size_t>(along) / 2;
  if (!second) middle.clear();
  const SlitPatch patch =
      slit_patch(corner, middle, mouth, Vec2(a, 0.5 * length), std::min(element, a / 4), finest, element);

  const auto rotation_of = [&](const MatrixRMi& element_node) {
    const SparseReal k = assemble(patch.node_position, element_node, kSteel, thickness).stiffness;
    Eigen::VectorXd force = Eigen::VectorXd::Zero(k.rows());
    // Bending stress on both ends, as consistent forces of whole sides.
    for (size_t i = 0; i < corner.size(); ++i) {
      const Vec2 p = corner[i], q = corner[(i + 1) % corner.size()];
      const bool top = p.y() == length && q.y() == length, foot = p.y() == 0 && q.y() == 0;
      if (!top && !foot) continue;
      std::vector<Index> node{static_cast<Index>(i), static_cast<Index>((i + 1) % corner.size())};
      if (second) node.push_back(static_cast<Index>(corner.size() + i));
      const GaussRule rule = gauss_rule(4);
      for (int g = 0; g < 4; ++g) {
        const SideShape shape = side_shape(node.size(), rule.point[g]);
        const double x = 0.5 * (p.x() + q.x()) + 0.5 * rule.point[g] * (q.x() - p.x());
        const double stress =
            6 / (thickness * w * w) * (1 - 2 * x / w) * (top ? 1 : -1);  // tension at the crack
        for (size_t n = 0; n < node.size(); ++n)
          force[2 * node[n] + 1] +=
              shape.value[n] * stress * thickness * 0.5 * std::abs(q.x() - p.x()) * rule.weight[g];
      }
    }
    std::vector<char> held(static_cast<size_t>(k.rows()), 0);
    for (Index n = 0; n < k.rows() / 2; ++n)
      if (k.coeff(2 * n, 2 * n) == 0)
        held[static_cast<size_t>(2 * n)] = held[static_cast<size_t>(2 * n + 1)] = 1;
    held[0] = held[1] = held[static_cast<size_t>(2 * across + 1)] = 1;  // statically determinate
    return force.dot(solved(k, held, force).col(0));
  };
  MatrixRMi closed = patch.element_node;
  for (Index i = 0; i < closed.size(); ++i)
    for (Index s = 0; s < patch.slit_node.rows(); ++s)
      if (closed.data()[i] == patch.slit_node(s, 1)) closed.data()[i] = patch.slit_node(s, 0);
  return rotation_of(patch.element_node) - rotation_of(closed);
}

}  // namespace

TEST_CASE("a slit starts on the fillet where its tangent says and goes where its angle says") {
  for (int teeth : {20, 50, 120})
    for (double start : {20.0, 30.0, 60.0})
      for (double angle : {30.0, 60.0, 90.0}) {
        GearDesign design = cracked_gear(1.5e-3, teeth, 0.3 * 3e-3 * teeth);
        design.crack.start = start * kPi / 180;
        design.crack.angle = angle * kPi / 180;
        const ToothGeometry gear(design);
        const Slit slit = crack_slit(gear);
        CHECK((slit.mouth - gear.root_point(slit.mouth_at)).norm() == 0);
        const Vec2 along = gear.root_point(slit.mouth_at + 1e-6) - gear.root_point(slit.mouth_at - 1e-6);
        CHECK(std::atan(along.x() / along.y()) == relative(design.crack.start, 1e-5));
        const Vec2 way = slit.tip - slit.mouth;
        CHECK(way.norm() == relative(1.5e-3, 1e-12));
        CHECK(std::atan2(way.x(), -way.y()) == relative(design.crack.angle, 1e-12));
      }
}

TEST_CASE("a crack that does not fit its tooth is rejected by name") {
  const auto with = [](auto&& change) {
    GearDesign design = cracked_gear(2e-3);
    change(design.crack);
    return [design] { crack_slit(ToothGeometry(design)); };
  };
  struct Case {
    std::function<void()> call;
    std::vector<Field> fields;
  };
  for (const Case& c : {Case{with([](Crack& k) { k.depth = 9e-3; }), {"depth_mm", 9}},
                        Case{with([](Crack& k) { k.depth = 8e-3; }), {"too", "long"}},
                        Case{with([](Crack& k) {
                               k.depth = 7e-3;
                               k.angle = kPi / 2;
                             }),
                             {"other", "side"}},
                        Case{with([](Crack& k) {
                               k.depth = 40e-3;
                               k.angle = 5 * kPi / 180;
                             }),
                             {"bore"}},
                        Case{with([](Crack& k) { k.tooth = 50; }), {"tooth", 50}},
                        Case{with([](Crack& k) { k.tooth = -1; }), {"tooth", "-1"}},
                        Case{with([](Crack& k) { k.start = 2 * kPi / 180; }), {"start_deg", 2}},
                        Case{with([](Crack& k) { k.angle = -1; }), {"angle_deg"}}}) {
    CHECK(names(message_of_input(c.call), c.fields));
  }
  crack_slit(ToothGeometry(cracked_gear(7.9e-3)));
}

TEST_CASE("the slit doubles the nodes on it and nothing else") {
  for (int order : {1, 2})
    for (double depth : {0.3e-3, 2e-3, 5e-3}) {
      const SectorGrid sector = sector_of(cracked_gear(depth), 0.6e-3, order);
      REQUIRE(sector.cracked_tooth.size() == 1);
      const SectorGrid &open = sector.cracked_tooth[0], closed = close_slit(open);
      const auto borders = [](const SectorGrid& mesh) {
        std::map<std::pair<int, int>, int> owners;
        for (Index e = 0; e < mesh.element_node.rows(); ++e)
          for (int k = 0; k < 4; ++k) {
            const int a = mesh.element_node(e, k), b = mesh.element_node(e, (k + 1) % 4);
            if (a != b) ++owners[std::minmax(a, b)];
          }
        double length = 0;
        for (const auto& [edge, count] : owners) {
          CHECK(count <= 2);
          if (count == 1)
            length += (mesh.node_position.row(edge.first) - mesh.node_position.row(edge.second)).norm();
        }
        return length;
      };
      CHECK(borders(open) - borders(closed) == relative(2 * depth, 1e-9));
      CHECK(borders(closed) == relative(borders(sector), 2e-3));  // the fillet has other chords
      CHECK(mesh_area(open.node_position, open.element_node) ==
            relative(mesh_area(sector.node_position, sector.element_node), order == 2 ? 1e-5 : 2e-3));
      const Slit slit = crack_slit(ToothGeometry(sector.design));
      std::set<int> seen;
      for (Index i = 0; i < open.slit_node.rows(); ++i) {
        const Vec2 a = open.node_position.row(open.slit_node(i, 0)),
                   b = open.node_position.row(open.slit_node(i, 1));
        CHECK((a - b).norm() < 1e-15);
        CHECK(open.slit_node(i, 0) != open.slit_node(i, 1));
        const Vec2 off = a - slit.mouth, way = (slit.tip - slit.mouth).normalized();
        CHECK(std::abs(off.x() * way.y() - off.y() * way.x()) < 1e-12);
        CHECK(off.dot(way) < depth);
        seen.insert({open.slit_node(i, 0), open.slit_node(i, 1)});
      }
      CHECK(static_cast<Index>(seen.size()) == 2 * open.slit_node.rows());
      CHECK(closed.node_position.rows() == open.node_position.rows() - open.slit_node.rows());
      // What joins it to its neighbours and to contact is as in every other tooth.
      for (Index i = 0; i < sector.side_node.size(); ++i)
        CHECK(open.node_position.row(open.side_node.data()[i]) ==
              sector.node_position.row(sector.side_node.data()[i]));
      for (Index i = 0; i < sector.flank_node.size(); ++i)
        CHECK(open.node_position.row(open.flank_node[i]) == sector.node_position.row(sector.flank_node[i]));
      CHECK(open.bore_node.size() == sector.bore_node.size());
    }
}

TEST_CASE("an edge crack in a strip in bending adds the rotation that the handbook gives") {
  const double w = 10e-3, thickness = 0.02;
  for (double share : {0.1, 0.3, 0.5}) {
    const double a = share * w, book = handbook_rotation(a, w, thickness, kSteel.youngs_modulus);
    const double found = strip_rotation(a, w, 1e-3, a / 10, true);
    CHECK(found == relative(book, 0.01));
  }
  // Against a fine solution: quarter points take in the singular strain, straight sides of first order do not.
  const double fine = strip_rotation(3e-3, w, 0.25e-3, 0.03e-3, true);
  const auto error = [&](double element, bool second) {
    return std::abs(strip_rotation(3e-3, w, element, element / 2, second) / fine - 1);
  };
  for (const bool second : {false, true}) {
    const double at[3] = {error(2e-3, second), error(1e-3, second), error(0.5e-3, second)};
    CHECK(at[1] < (second ? 0.5 : 0.7) * at[0]);
    CHECK(at[2] < (second ? 0.5 : 0.7) * at[1]);
  }
}

TEST_CASE("condensed teeth give the compliance and the root stress that cyclic symmetry gives") {
  for (int teeth : {9, 50}) {
    GearDesign design = cracked_gear(0, teeth, 0.25 * 3e-3 * teeth);
    if (teeth < 17) design.profile_shift = 0.6;
    const SectorGrid sector = sector_of(design, 1e-3);
    CHECK(sector.cracked_tooth.empty());
    const ReducedBody body = reduce(sector, kSteel, 0);
    CHECK(body.crack_compliance.size() == 0);
    const int reach = body.offsets;
    const TeethTables tables = teeth_tables(sector, sector, kSteel, body.flank_position, reach);
    const MatrixRM& all = tables.compliance;
    const Index roots = body.root_angle.size();
    const Index n = body.flank_position.size();
    const double scale = body.compliance[0].cwiseAbs().maxCoeff();
    for (int i = -reach; i <= reach; ++i)
      for (int j = -reach; j <= reach; ++j) {
        const int offset = i - j;
        if (std::abs(offset) > reach) continue;
        Eigen::MatrixXd cyclic = body.compliance[static_cast<size_t>(std::abs(offset))];
        if (offset < 0) cyclic.transposeInPlace();
        CHECK((all.block((i + reach) * n, (j + reach) * n, n, n) - cyclic).cwiseAbs().maxCoeff() <
              1e-10 * scale);
        const MatrixRM& stress = body.root_stress[static_cast<size_t>(offset + reach)];
        CHECK(
            (tables.root_stress.block((i + reach) * roots, (j + reach) * n, roots, n) - stress.topRows(roots))
                .cwiseAbs()
                .maxCoeff() < 1e-9 * body.root_stress[static_cast<size_t>(reach)].cwiseAbs().maxCoeff());
      }
  }
}

namespace {

// (root, load) Pa N-1: along the root of the driving flank, at the points of RootReader, from the strain inside the elements there.
Eigen::MatrixXd surface_stress(const SectorGrid& mesh, const Material& material, const Eigen::MatrixXd& u) {
  const ToothGeometry tooth(mesh.design);
  const RootPoints points = root_points(tooth);
  const double e = material.youngs_modulus, nu = material.poisson_ratio;
  Eigen::Matrix3d law;
  law << 1, nu, 0, nu, 1, 0, 0, 0, 0.5 * (1 - nu);
  law *= e / (1 - nu * nu);
  Eigen::MatrixXd out(kRootPoints, u.cols());
  for (Index i = 0; i < kRootPoints; ++i) {
    const double t = points.parameter[i], step = 1e-4;
    const Vec2 p = tooth.root_point(t),
               along = (tooth.root_point(t + step) - tooth.root_point(t - step)).normalized();
    double nearest = 1.3;  // a side of an element is a parabola, the root is not
    for (Index k = 0; k < mesh.element_node.rows(); ++k) {
      Eigen::MatrixX2d node(9, 2);
      for (Index n = 0; n < 9; ++n) node.row(n) = mesh.node_position.row(mesh.element_node(k, n));
      Vec2 at;
      if ((node.row(0) - p.transpose()).norm() > 3e-3 || !invert_map(node, p, at) ||
          !(at.cwiseAbs().maxCoeff() < nearest))
        continue;
      nearest = at.cwiseAbs().maxCoeff();
      const Shape shape = shape_functions(9, at.x(), at.y());
      const Eigen::MatrixX2d slope = shape.slope * (node.transpose() * shape.slope).inverse();
      for (Index c = 0; c < u.cols(); ++c) {
        Eigen::Matrix2d g = Eigen::Matrix2d::Zero();  // du_a / dx_b
        for (Index n = 0; n < 9; ++n) g += u.col(c).segment<2>(2 * mesh.element_node(k, n)) * slope.row(n);
        const Eigen::Vector3d s = law * Eigen::Vector3d(g(0, 0), g(1, 1), g(0, 1) + g(1, 0));
        out(i, c) =
            along.x() * along.x() * s[0] + along.y() * along.y() * s[1] + 2 * along.x() * along.y() * s[2];
      }
    }
    REQUIRE(nearest < 1.3);
  }
  return out;
}

}  // namespace

TEST_CASE("condensed teeth give what the whole gear with its crack gives in one piece") {
  const int teeth = 9, reach = 2, tooth = 5;
  GearDesign design = cracked_gear(2e-3, teeth, 4e-3);
  design.profile_shift = 0.6;
  design.crack.tooth = tooth;
  const SectorGrid sector = sector_of(design, 0.8e-3);
  const SectorGrid& cracked = sector.cracked_tooth.at(0);
  const Eigen::VectorXd xi = table_of(design, 8);
  const Index points = xi.size();

  // All nodes in the frame of the gear; those of the intact tooth in the cracked one's place are left over and held.
  const WholeGear gear = replicate(sector);
  const Index before = gear.node_position.rows(), added = cracked.node_position.rows(),
              per_tooth = sector.element_node.rows();
  std::vector<int> own(static_cast<size_t>(added), -1);
  for (Index i = 0; i < sector.side_node.size(); ++i)
    own[static_cast<size_t>(cracked.side_node.data()[i])] = gear.node(tooth, sector.side_node.data()[i]);
  MatrixRM position(before + added, 2);
  position.topRows(before) = gear.node_position;
  const Eigen::Matrix2d turned = Eigen::Rotation2Dd(2 * kPi * tooth / teeth).toRotationMatrix();
  for (Index i = 0; i < added; ++i) {
    position.row(before + i) = turned * cracked.node_position.row(i).transpose();
    if (own[static_cast<size_t>(i)] < 0) own[static_cast<size_t>(i)] = static_cast<int>(before + i);
  }
  MatrixRMi element((teeth - 1) * per_tooth + cracked.element_node.rows(), 9);
  element << gear.element_node.topRows(tooth * per_tooth),
      gear.element_node.bottomRows((teeth - 1 - tooth) * per_tooth),
      cracked.element_node.unaryExpr([&own](int i) { return own[static_cast<size_t>(i)]; });
  const SparseReal stiffness = assemble(position, element, kSteel, design.face_width).stiffness;
  std::vector<char> held(static_cast<size_t>(stiffness.rows()), 0);
  for (Index i = 0; i < stiffness.rows(); ++i) held[static_cast<size_t>(i)] = stiffness.coeff(i, i) == 0;
  const auto mesh_of = [&](int j) -> const SectorGrid& { return j == tooth ? cracked : sector; };
  const auto node_of = [&](int j, int node) {
    return j == tooth ? own[static_cast<size_t>(node)] : gear.node(j, node);
  };
  for (int j = 0; j < teeth; ++j)
    for (int node : mesh_of(j).bore_node)
      held[static_cast<size_t>(2 * node_of(j, node))] = held[static_cast<size_t>(2 * node_of(j, node) + 1)] =
          1;

  const int window = 2 * reach + 1;
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(stiffness.rows(), window * points);
  const auto tooth_at = [&](int k) { return (tooth + k - reach + teeth) % teeth; };
  const auto turn = [&](int j) -> Eigen::Matrix2d {
    return Eigen::Rotation2Dd(2 * kPi * j / teeth).toRotationMatrix();
  };
  std::map<int, FlankLoads> loads;
  for (int k = 0; k < window; ++k) {
    const int j = tooth_at(k);
    const FlankLoads& f = loads[k] = make_flank_loads(mesh_of(j), kSteel, xi);
    for (Index i = 0; i < mesh_of(j).node_position.rows(); ++i)
      force.block(2 * node_of(j, static_cast<int>(i)), k * points, 2, points) +=
          turn(j) * f.force.middleRows(2 * i, 2);
  }
  const Eigen::MatrixXd u = solved(stiffness, held, force);
  MatrixRM found(window * points, window * points), stress(window * kRootPoints, window * points);
  for (int k = 0; k < window; ++k) {
    const int j = tooth_at(k);
    const SectorGrid& mesh = mesh_of(j);
    Eigen::MatrixXd local(2 * mesh.node_position.rows(), u.cols());
    for (Index i = 0; i < mesh.node_position.rows(); ++i)
      local.middleRows(2 * i, 2) = turn(j).transpose() * u.middleRows(2 * node_of(j, static_cast<int>(i)), 2);
    found.middleRows(k * points, points) = -(FlankReader(mesh).outward(xi) * local);
    found.block(k * points, k * points, points, points) += loads[k].subtracted;
    const RootReader reader(mesh, kSteel, Roots::driving);
    stress.middleRows(k * kRootPoints, kRootPoints) = reader.stress() * local;
    stress.block(k * kRootPoints, k * points, kRootPoints, points) += reader.near_field(loads[k], xi);
    if (j != tooth) continue;
    // Of the cracked tooth, from the elements' whole strain; under its own loads nodes near them hold what the half-plane leaves.
    for (Index load = 0; load < points; ++load)
      for (Index i = 0; i < mesh.node_position.rows(); ++i)
        if (loads[k].holds_rest[static_cast<size_t>(i)])
          local.col(k * points + load).segment<2>(2 * i) +=
              LineLoadField(ToothGeometry(design).flank_point(xi[load]),
                            ToothGeometry(design).flank_normal(xi[load]), plane_strain_equivalent(kSteel),
                            design.face_width, kReferenceDepth)
                  .displacement(mesh.node_position.row(i).transpose());
    const Eigen::MatrixXd own = local.middleCols(k * points, points),
                          read = stress.block(k * kRootPoints, k * points, kRootPoints, points);
    const Eigen::MatrixXd whole = surface_stress(mesh, kSteel, own);
    const double scale =
        reduce(sector, kSteel, 0).root_stress[static_cast<size_t>(reach)].topRows(kRootPoints).maxCoeff();
    // The lowest force stands beside the root. A sharp bend of the stress before the mouth is rounded off by the fit.
    CHECK((whole - read).rightCols(points - 1).cwiseAbs().maxCoeff() < 0.25 * scale);
    for (Index load = 2; load < points; ++load)
      CHECK(read.col(load).maxCoeff() == relative(whole.col(load).maxCoeff(), 0.02));
  }
  found = (0.5 * (found + found.transpose())).eval();
  const TeethTables tables = teeth_tables(sector, cracked, kSteel, xi, reach);
  const MatrixRM& condensed = tables.compliance;
  CHECK((stress - tables.root_stress).cwiseAbs().maxCoeff() < 1e-9 * stress.cwiseAbs().maxCoeff());
  CHECK((found - condensed).cwiseAbs().maxCoeff() < 1e-9 * condensed.cwiseAbs().maxCoeff());
  const MatrixRM intact = teeth_tables(sector, sector, kSteel, xi, reach).compliance;
  CHECK((condensed - intact).cwiseAbs().maxCoeff() > 0.05 * intact.cwiseAbs().maxCoeff());
}

TEST_CASE("a crack adds flexibility, the more the deeper, and none of it without depth") {
  const GearDesign design = cracked_gear(0);
  const Eigen::VectorXd xi = table_of(design);
  const Index n = xi.size();
  const auto tip_of = [&](double depth, double element) {
    const MatrixRM share = crack_tables(sector_of(cracked_gear(depth), element), kSteel, xi, 3).compliance;
    return share(4 * n - 1, 4 * n - 1);
  };
  const SectorGrid sector = sector_of(cracked_gear(2e-3), 0.6e-3);
  const MatrixRM share = crack_tables(sector, kSteel, xi, 3).compliance;
  const SymmetricEigen eigen = symmetric_eigenvalues(Eigen::MatrixXd(share));
  CHECK(eigen.values[0] > -1e-7 * eigen.values[7 * n - 1]);
  Index row = 0, column = 0;
  share.cwiseAbs().maxCoeff(&row, &column);
  CHECK(row == 4 * n - 1);  // the tip of the cracked tooth itself
  CHECK(column == row);
  // What the other mesh of the same tooth, with its slit closed, differs by is far less.
  const MatrixRM closed = teeth_tables(sector, close_slit(sector.cracked_tooth[0]), kSteel, xi, 3).compliance,
                 plain = teeth_tables(sector, sector, kSteel, xi, 3).compliance;
  CHECK((closed - plain).cwiseAbs().maxCoeff() < 1e-4 * plain.cwiseAbs().maxCoeff());

  const double at[4] = {tip_of(0.1e-3, 0.6e-3), tip_of(0.2e-3, 0.6e-3), tip_of(1e-3, 0.6e-3),
                        tip_of(3e-3, 0.6e-3)};
  for (int k = 0; k < 3; ++k) CHECK(at[k + 1] > at[k]);
  CHECK(at[1] / at[0] > 3.2);  // with the square of the depth, as long as that is small
  CHECK(at[1] / at[0] < 4.0);
  CHECK(tip_of(2e-3, 0.8e-3) == relative(tip_of(2e-3, 0.4e-3), 2e-3));
  CHECK(failure_of([&] { crack_tables(sector_of(design, 1e-3), kSteel, xi, 3); }) == Failure::input);
  CHECK(failure_of([&] { make_cracked_sector(sector_of(design, 1e-3)); }) == Failure::input);
}

TEST_CASE("statics over a turn: the cracked tooth's own softness where it works, nothing elsewhere") {
  constexpr int kPositions = 8, kTeeth = 50;
  const double torque = 150;
  const StaticResult intact =
      static_transmission(cracked_body(0), cracked_body(0), paper_statics(kPositions), torque);
  CHECK(intact.hunting_periods == 1);
  for (const int gear : {0, 1})
    for (const int tooth : {0, 3}) {
      const ReducedBody& cracked = cracked_body(2e-3, tooth);
      const StaticResult s =
          gear == 0 ? static_transmission(cracked, cracked_body(0), paper_statics(kPositions), torque)
                    : static_transmission(cracked_body(0), cracked, paper_statics(kPositions), torque);
      REQUIRE(s.hunting_periods == kTeeth);
      REQUIRE(s.transmission_error.size() == kTeeth * kPositions);
      CHECK(s.torque_residual < 1e-9);
      CHECK(s.least_force >= 0);
      // The reference pair is of the driver's tooth -k and the driven gear's tooth k in mesh period k.
      const int own = gear == 0 ? (kTeeth - tooth) % kTeeth : tooth;
      const auto added = [&](int period, int i) {
        return s.transmission_error[((period % kTeeth + kTeeth) % kTeeth) * kPositions + i] -
               intact.transmission_error[i];
      };
      double far = 0, most = 0;
      for (int k = -kTeeth / 2; k < kTeeth / 2; ++k)
        for (int i = 0; i < kPositions; ++i) {
          // Under its neighbour's load the tooth may lean forward and take over early.
          CHECK(added(own + k, i) > -0.03e-6);
          if (std::abs(k) > 5) far = std::max(far, std::abs(added(own + k, i)));
          most = std::max(most, added(own + k, i));
        }
      CHECK(far == 0);
      // At the pitch point that pair carries the load alone: its force times the crack's share where it touches.
      const int pair = static_cast<int>(-intact.pair[0]);
      REQUIRE(s.tooth_load(own * kPositions, pair) ==
              relative(torque / ToothGeometry(cracked.design).base_radius(), 1e-9));
      const GearPair kinematics(cracked.design, cracked.design, 0.15);
      const Eigen::RowVectorXd at =
          FlankTable(ToothGeometry(cracked.design), BodyDiscretisation{}.flank_points)
              .weights(kinematics.contact(0).roll[gear]);
      const Index n = at.size(), first = cracked.offsets * n;
      const double share = at * cracked.crack_compliance.block(first, first, n, n) * at.transpose();
      // The pressure's middle lies a few micrometres off the nominal point.
      CHECK(added(own, 0) == relative(share * s.tooth_load(own * kPositions, pair), 3e-3));
      CHECK(most >= added(own, 0));
    }
}

TEST_CASE("lines and strips see the same crack") {
  const ReducedBody &cracked = cracked_body(2e-3, 0), &plain = cracked_body(0);
  StaticParameters settings = paper_statics(8);
  const StaticResult strips = static_transmission(cracked, plain, settings, 150);
  settings.fidelity.contact = ContactModel::line;
  const StaticResult lines = static_transmission(cracked, plain, settings, 150);
  double most = 0;
  for (Index i = 0; i < strips.transmission_error.size(); ++i) {
    CHECK(lines.transmission_error[i] == relative(strips.transmission_error[i], 1e-2));
    most = std::max(most, strips.transmission_error[i]);
  }
  CHECK(most > 1.05 * strips.transmission_error.minCoeff());
}

TEST_CASE("artifacts of a cracked gear give back every value bit by bit") {
  const OwnFolder folder;
  GearDesign design = cracked_gear(2e-3);
  design.crack.tooth = 7;
  const SectorGrid mesh = sector_of(design, 1e-3);
  write("mesh.h5", mesh, {"test", "test", {}});
  const SectorGrid again = read<SectorGrid>("mesh.h5");
  REQUIRE(again.cracked_tooth.size() == 1);
  const SectorGrid &a = again.cracked_tooth[0], &b = mesh.cracked_tooth[0];
  CHECK(a.node_position == b.node_position);
  CHECK(a.element_node == b.element_node);
  CHECK(a.element_region == b.element_region);
  CHECK(a.slit_node == b.slit_node);
  CHECK(a.flank_node == b.flank_node);
  CHECK(a.side_node == b.side_node);
  CHECK(a.bore_node == b.bore_node);
  for (const GearDesign& d : {again.design, a.design}) {
    CHECK(d.crack.tooth == 7);
    CHECK(d.crack.depth == design.crack.depth);
    CHECK(d.crack.start == design.crack.start);
    CHECK(d.crack.angle == design.crack.angle);
  }
  const ReducedBody body = reduce(again, kSteel, 1);
  write("body.h5", body, {"test", "test", {}});
  const ReducedBody back = read<ReducedBody>("body.h5");
  CHECK(back.crack_compliance == body.crack_compliance);
  CHECK(back.crack_root_stress == body.crack_root_stress);
  CHECK(back.design.crack.tooth == 7);
  CHECK(body_hash(body_parameters({back.design, back.material, back.discretisation})) ==
        body_hash(body_parameters({design, kSteel, body.discretisation})));
}

TEST_CASE("a scene's crack is its gear's own, and changes the body of that gear alone") {
  const SceneFile file;
  const auto scene_of = [&](const std::string& crack) {
    return file.read(scene_with("[gear.wheel]", crack + "\n[gear.wheel]"));
  };
  const Scene plain = scene_of("");
  const std::string intact = body_parameters(plain, "pinion");
  CHECK(body_parameters(scene_of("[gear.pinion.crack]\ndepth_mm = 0"), "pinion") == intact);
  const Scene cracked = scene_of("[gear.pinion.crack]\ntooth = 4\ndepth_mm = 2");
  CHECK(cracked.gear("pinion").design.crack.depth == 2e-3);
  CHECK(cracked.gear("pinion").design.crack.tooth == 4);
  CHECK(cracked.gear("pinion").design.crack.start == relative(kPi / 6, 1e-15));
  CHECK(cracked.gear("wheel").design.crack.depth == 0);
  CHECK(body_parameters(cracked, "wheel") == intact);
  CHECK(body_parameters(cracked, "pinion") != intact);
  CHECK(sweep_parameters(cracked) == sweep_parameters(plain));
  CHECK(static_parameters(cracked) != static_parameters(plain));
  CHECK(body_parameters(read_body_parameters(file.path(body_parameters(cracked, "pinion"), "body.toml"))) ==
        body_parameters(cracked, "pinion"));

  const std::string own = "[gear.pinion.crack]\n";
  const std::vector<std::pair<std::string, std::vector<Field>>> wrong{
      {own + "tooth = 4", {"depth_mm"}},
      {own + "tooth = 50\ndepth_mm = 2", {0, 49}},
      {own + "depth_mm = -2", {"depth_mm", "-2", 0}},
      {own + "depth_mm = 2\nangle_deg = 200", {"angle_deg", 200, 135}},
      {own + "depth = 2", {"depth", "[gear.pinion.crack]"}},
      {"crack = 2", {"crack", "section"}},
      {"start_deg = 30", {"[gear.<name>.crack]"}}};
  for (const auto& [crack, fields] : wrong)
    CHECK(names(message_of_input([&, text = crack] { scene_of(text); }), fields));
}
