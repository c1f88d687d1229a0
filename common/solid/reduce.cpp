#include "solid/reduce.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "base/dense.h"
#include "base/error.h"
#include "base/progress.h"
#include "solid/crack.h"
#include "solid/flank_table.h"
#include "solid/half_plane.h"
#include "solid/mesher.h"
#include "solid/modes.h"
#include "solid/sector.h"

namespace whine {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDrawnModes = 16;  // modes shown in ParaView; each costs megabytes
// Unknowns of a harmonic for every mode: ten seconds and 0.2 GB a harmonic at the limit, growing as cube and square.
constexpr int kMostDense = 1500;
using Complex = std::complex<double>;

// A side of an element on the boundary of the tooth region, node order counter-clockwise around the region.
struct Side {
  std::vector<int> node;  // 2, or 3: start, end, middle
  bool cut = false;       // borders on the rest of the gear; otherwise free
  bool flank = false;     // on the driving flank
};

std::vector<Side> sides_of_tooth_region(const MeshArtifact& mesh) {
  const std::set<int> flank(mesh.flank_node.begin(), mesh.flank_node.end());
  std::set<int> edge;
  for (Eigen::Index i = 0; i < mesh.side_node.size(); ++i) edge.insert(mesh.side_node.data()[i]);
  auto element_side = [&](Eigen::Index e, int k) {
    std::vector<int> node{mesh.element_node(e, k), mesh.element_node(e, (k + 1) % 4)};
    if (mesh.element_node.cols() == 9) node.push_back(mesh.element_node(e, 4 + k));
    return node;
  };
  std::map<std::pair<int, int>, std::pair<int, int>> count;  // tooth elements, other elements at a side
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e)
    for (int k = 0; k < 4; ++k) {
      const auto node = element_side(e, k);
      if (node[0] == node[1]) continue;  // of a triangle
      auto& [tooth, rest] = count[std::minmax(node[0], node[1])];
      ++(mesh.element_region[e] == 1 ? tooth : rest);
    }
  std::vector<Side> sides;
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    if (mesh.element_region[e] != 1) continue;
    for (int k = 0; k < 4; ++k) {
      Side side{element_side(e, k)};
      if (side.node[0] == side.node[1]) continue;
      const auto [tooth, rest] = count.at(std::minmax(side.node[0], side.node[1]));
      if (tooth == 2) continue;
      auto all_in = [&side](const std::set<int>& set) {
        return std::all_of(side.node.begin(), side.node.end(), [&set](int i) { return set.contains(i); });
      };
      side.cut = rest > 0 || all_in(edge);
      side.flank = all_in(flank);
      sides.push_back(side);
    }
  }
  return sides;
}

// Adds the integral of N^T t_hs over one side; sides that are long against their distance to the load are
// halved.
class TractionIntegral {
 public:
  TractionIntegral(const MeshArtifact& mesh, const ToothGeometry& tooth) : mesh_(mesh), tooth_(tooth) {
    for (Eigen::Index i = 0; i < mesh.flank_node.size(); ++i)
      roll_[mesh.flank_node[i]] = mesh.flank_roll_angle[i];
  }

  void add(const Side& side, const Vec2& load, const LineLoadField& field,
           Eigen::Ref<Eigen::VectorXd> force) const {
    add(side, load, field, -1, 1, 0, force);
  }

 private:
  struct Place {
    Vec2 point, outward;  // outward: times the length per unit of a
  };
  Place place(const Side& side, double a) const {
    const size_t n = side.node.size();
    if (side.flank) {  // the exact involute: the half-plane's traction next to the load knows the difference
      const double from = roll_.at(side.node[0]), to = roll_.at(side.node[1]);
      const double xi = 0.5 * (from + to) + 0.5 * a * (to - from);
      return {tooth_.flank_point(xi),
              tooth_.flank_normal(xi) * (tooth_.base_radius() * xi * 0.5 * std::abs(to - from))};
    }
    const SideShape shape = side_shape(n, a);
    Vec2 point = Vec2::Zero(), along = Vec2::Zero();
    for (size_t k = 0; k < n; ++k) {
      const Vec2 p = mesh_.node_position.row(side.node[k]);
      point += shape.value[k] * p;
      along += shape.slope[k] * p;
    }
    return {point, {along.y(), -along.x()}};
  }
  void add(const Side& side, const Vec2& load, const LineLoadField& field, double from, double to, int depth,
           Eigen::Ref<Eigen::VectorXd> force) const {
    const Vec2 start = place(side, from).point, end = place(side, to).point,
               middle = place(side, 0.5 * (from + to)).point;
    const double length = (end - start).norm();
    const double distance = std::min({(start - load).norm(), (end - load).norm(), (middle - load).norm()});
    constexpr int kDeepest = 24;  // 2e-8 of a side: beyond it the exact involute is flat to round-off
    if (length > distance && depth < kDeepest) {
      add(side, load, field, from, 0.5 * (from + to), depth + 1, force);
      add(side, load, field, 0.5 * (from + to), to, depth + 1, force);
      return;
    }
    if (length > distance) return;  // traction is bounded on a flank, the piece is nothing
    static const GaussRule rule = gauss_rule(10);
    for (Eigen::Index g = 0; g < rule.point.size(); ++g) {
      const double a = 0.5 * (from + to) + 0.5 * (to - from) * rule.point[g];
      const Place at = place(side, a);
      const Vec2 traction = 0.5 * (to - from) * rule.weight[g] * field.traction(at.point, at.outward);
      const SideShape shape = side_shape(side.node.size(), a);
      for (size_t k = 0; k < side.node.size(); ++k)
        force.segment<2>(2 * side.node[k]) += shape.value[k] * traction;
    }
  }

  const MeshArtifact& mesh_;
  const ToothGeometry& tooth_;
  std::map<int, double> roll_;  // rad, of flank nodes
};

// Inward displacement of the flank at roll angle xi by the half-plane that is loaded at `load`, less that of a flat
// surface at the same arc length. m N-1
double beside_flat_surface(const LineLoadField& field, const ToothGeometry& tooth, const PlaneModuli& moduli,
                           double thickness, double xi, double load) {
  if (xi == load) return 0;  // on the surface under the load both parts have the same limit
  return -tooth.flank_normal(xi).dot(field.displacement(tooth.flank_point(xi))) -
         flat_surface_displacement(tooth.arc_length(xi) - tooth.arc_length(load), moduli, thickness,
                                   kReferenceDepth);
}

// Of a point or a normal of the driving flank of tooth 0: that of its other flank.
Vec2 mirrored(const Vec2& v) {
  return {-v.x(), v.y()};
}

// One mode of one harmonic; doublets stand for two real modes.
struct KeptMode {
  int harmonic = 0;
  double omega_squared = 0;
  double coupling = 0;  // gamma
  // kg^1/2: phi^H M_fr t over the whole gear, t the translation along x plus i times that along y
  Complex translation;
  Eigen::VectorXcd sector;  // (2 node) kg^-1/2, normalised over the whole gear
  Eigen::VectorXcd flank;   // (point) kg^-1/2
  Eigen::VectorXcd back;    // (point) kg^-1/2, of the other flank
};

// Turns the phase so that the outward displacement of the tip-most table point is real and positive.
void fix_phase(Eigen::VectorXcd& shape, const SparseReal& outward) {
  const Eigen::VectorXcd flank = outward.cast<Complex>() * shape;
  Complex value = flank[flank.size() - 1];
  if (std::abs(value) < 1e-6 * shape.cwiseAbs().maxCoeff()) {  // the flank does not move in this mode
    Eigen::Index largest = 0;
    shape.cwiseAbs().maxCoeff(&largest);
    value = shape[largest];
  }
  shape *= std::conj(value) / std::abs(value);
}

// A mesh of the same gear whose modes can all be found, in words.
std::string coarse_enough(const MeshArtifact& mesh) {
  BodyDiscretisation coarser = mesh.discretisation;
  coarser.element_order = 1;
  for (; coarser.element_size <= mesh.design.module; coarser.element_size *= 1.5) {
    const MeshArtifact other = make_sector_mesh(mesh.design, coarser);
    const Eigen::Index size =
        2 * (other.node_position.rows() - other.bore_node.size() - other.side_node.rows());
    if (size <= kMostDense)
      return text("element_order = 1 and element_mm = ", coarser.element_size * 1e3, " make about ", size);
  }
  return "not even elements of a module of order 1 are coarse enough";
}

}  // namespace

FlankReader::FlankReader(const MeshArtifact& mesh) : mesh_(mesh), tooth_(mesh.design) {
  const Eigen::Index step = mesh.element_node.cols() == 9 ? 2 : 1;
  if (mesh.flank_node.size() < step + 1 || (mesh.flank_node.size() - 1) % step != 0 ||
      mesh.flank_roll_angle.size() != mesh.flank_node.size())
    fail(Failure::input, "the mesh has ", mesh.flank_node.size(), " flank nodes and ",
         mesh.flank_roll_angle.size(),
         " roll angles, which do not make whole element sides; rebuild the mesh");
}

SparseReal FlankReader::displacement(const Eigen::VectorXd& xi) const {
  const Eigen::Index step = mesh_.element_node.cols() == 9 ? 2 : 1, last = mesh_.flank_node.size() - 1;
  SparseReal reading(2 * xi.size(), 2 * mesh_.node_position.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < xi.size(); ++i) {
    const double lowest = mesh_.flank_roll_angle[0], highest = mesh_.flank_roll_angle[last];
    if (!(xi[i] >= lowest - 1e-9 && xi[i] <= highest + 1e-9))
      fail(Failure::numerical, "no displacement can be read at roll angle ", xi[i],
           " rad: the flank of the mesh goes from ", lowest, " to ", highest, " rad");
    Eigen::Index side = 0;
    while (side + step < last && mesh_.flank_roll_angle[side + step] < xi[i]) side += step;
    const double from = mesh_.flank_roll_angle[side], to = mesh_.flank_roll_angle[side + step];
    const SideShape shape = side_shape(static_cast<size_t>(step + 1), (2 * xi[i] - from - to) / (to - from));
    const Eigen::Index node[3] = {side, side + step, side + 1};
    for (int k = 0; k < step + 1; ++k)
      for (int c = 0; c < 2; ++c)
        entries.emplace_back(static_cast<int>(2 * i + c), 2 * mesh_.flank_node[node[k]] + c, shape.value[k]);
  }
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

SparseReal FlankReader::outward(const Eigen::VectorXd& xi) const {
  SparseReal normal(xi.size(), 2 * xi.size());
  for (Eigen::Index i = 0; i < xi.size(); ++i)
    for (int c = 0; c < 2; ++c) normal.insert(i, 2 * i + c) = tooth_.flank_normal(xi[i])[c];
  return normal * displacement(xi);
}

Eigen::Index FlankReader::element_at(const Vec2& p, Vec2& reference) const {
  Eigen::MatrixX2d nodes(mesh_.element_node.cols(), 2);
  for (Eigen::Index e = 0; e < mesh_.element_node.rows(); ++e) {
    if (mesh_.element_region[e] != 1) continue;
    for (Eigen::Index k = 0; k < nodes.rows(); ++k)
      nodes.row(k) = mesh_.node_position.row(mesh_.element_node(e, k));
    const Vec2 low = nodes.colwise().minCoeff(), high = nodes.colwise().maxCoeff();
    const Vec2 slack = 0.2 * (high - low);  // a curved side bulges beyond its nodes
    if ((p - low + slack).minCoeff() < 0 || (high + slack - p).minCoeff() < 0) continue;
    if (invert_map(nodes, p, reference) && reference.cwiseAbs().maxCoeff() < 1 + 1e-6) return e;
  }
  return -1;
}

SparseReal FlankReader::outward_below(const Eigen::VectorXd& xi, double depth) const {
  SparseReal reading(xi.size(), 2 * mesh_.node_position.rows());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < xi.size(); ++i) {
    const Vec2 normal = tooth_.flank_normal(xi[i]), surface = tooth_.flank_point(xi[i]);
    Vec2 at;
    const Eigen::Index e = element_at(surface - depth * normal, at);
    if (e < 0) {
      double inside = 0, outside = depth;  // a depth that is inside, one that is not
      while (outside - inside > 1e-3 * depth) {
        const double middle = 0.5 * (inside + outside);
        (element_at(surface - middle * normal, at) < 0 ? outside : inside) = middle;
      }
      fail(Failure::input, "matching_depth_mm = ", depth * 1e3, " leaves the tooth: ", inside * 1e3,
           " mm below the flank at roll angle ", xi[i] * 180 / kPi, " deg (",
           (tooth_.arc_length(tooth_.tip_roll_angle()) - tooth_.arc_length(xi[i])) * 1e3,
           " mm from the tip edge) the material ends; lower it, or use near_field = \"subtraction\"");
    }
    const int nodes = static_cast<int>(mesh_.element_node.cols());
    const Shape shape = shape_functions(nodes, at[0], at[1]);
    for (int k = 0; k < nodes; ++k)
      for (int c = 0; c < 2; ++c)
        entries.emplace_back(static_cast<int>(i), 2 * mesh_.element_node(e, k) + c,
                             shape.value[k] * normal[c]);
  }
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

SparseReal FlankReader::back_outward(const Eigen::VectorXd& xi) const {
  const SparseReal front = outward(xi);
  std::map<int, int> image;
  for (const int node : mesh_.flank_node) {
    const Vec2 mirrored(-mesh_.node_position(node, 0), mesh_.node_position(node, 1));
    Eigen::Index nearest = 0;
    const double miss =
        (mesh_.node_position.rowwise() - mirrored.transpose()).rowwise().norm().minCoeff(&nearest);
    if (miss > 1e-9 * mirrored.norm())
      fail(Failure::input, "the mesh has no mirror image of its flank node ", node, " (the nearest node is ",
           miss * 1e3, " mm off); rebuild the mesh");
    image[node] = static_cast<int>(nearest);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (int column = 0; column < front.outerSize(); ++column)
    for (SparseReal::InnerIterator it(front, column); it; ++it) {
      const int xy = static_cast<int>(it.col()) % 2;
      entries.emplace_back(static_cast<int>(it.row()), 2 * image.at(static_cast<int>(it.col()) / 2) + xy,
                           xy == 0 ? -it.value() : it.value());
    }
  SparseReal reading(front.rows(), front.cols());
  reading.setFromTriplets(entries.begin(), entries.end());
  return reading;
}

FlankLoads make_matched_loads(const MeshArtifact& mesh, const Material& material, const Eigen::VectorXd& xi,
                              double depth) {
  const ToothGeometry tooth(mesh.design);
  const PlaneModuli moduli = plane_strain_equivalent(material);
  const double thickness = mesh.design.face_width;
  const Eigen::Index size = 2 * mesh.node_position.rows(), loads = xi.size();
  FlankLoads result{-Eigen::MatrixXd(FlankReader(mesh).outward(xi)).transpose(),
                    Eigen::MatrixXd::Zero(size, loads),
                    std::vector<char>(static_cast<size_t>(mesh.node_position.rows()), 0),
                    MatrixRM::Zero(loads, loads), MatrixRM::Zero(loads, loads)};
  for (Eigen::Index j = 0; j < loads; ++j) {
    const LineLoadField field(tooth.flank_point(xi[j]), tooth.flank_normal(xi[j]), moduli, thickness,
                              kReferenceDepth);
    for (Eigen::Index i = 0; i < loads; ++i) {
      const Vec2 normal = tooth.flank_normal(xi[i]), surface = tooth.flank_point(xi[i]);
      result.subtracted(i, j) = beside_flat_surface(field, tooth, moduli, thickness, xi[i], xi[j]) +
                                normal.dot(field.displacement(surface - depth * normal));
    }
  }
  return result;
}

FlankLoads make_flank_loads(const MeshArtifact& mesh, const Material& material, const Eigen::VectorXd& xi) {
  const ToothGeometry tooth(mesh.design);
  const PlaneModuli moduli = plane_strain_equivalent(material);
  const double thickness = mesh.design.face_width;
  const Eigen::Index nodes = mesh.node_position.rows(), loads = xi.size();

  const std::vector<Side> sides = sides_of_tooth_region(mesh);
  std::vector<char> in_region(static_cast<size_t>(mesh.element_node.rows()));
  std::vector<char> holds_rest(static_cast<size_t>(nodes), 0);  // nodes where the unknown is w
  std::vector<char> on_cut(static_cast<size_t>(nodes), 0);
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    in_region[static_cast<size_t>(e)] = mesh.element_region[e] == 1;
    if (mesh.element_region[e] == 1)
      for (Eigen::Index k = 0; k < mesh.element_node.cols(); ++k)
        holds_rest[static_cast<size_t>(mesh.element_node(e, k))] = 1;
  }
  for (const Side& side : sides)
    if (side.cut)
      for (int node : side.node) {
        on_cut[static_cast<size_t>(node)] = 1;
        holds_rest[static_cast<size_t>(node)] = 0;
      }
  const SparseReal region_stiffness =
      assemble(mesh.node_position, mesh.element_node, material, thickness, in_region).stiffness;
  const TractionIntegral integral(mesh, tooth);

  FlankLoads result{Eigen::MatrixXd::Zero(2 * nodes, loads), Eigen::MatrixXd::Zero(2 * nodes, loads),
                    holds_rest, MatrixRM::Zero(loads, loads), MatrixRM::Zero(loads, loads)};
  for (Eigen::Index j = 0; j < loads; ++j) {
    const Vec2 load = tooth.flank_point(xi[j]);
    const LineLoadField field(load, tooth.flank_normal(xi[j]), moduli, thickness, kReferenceDepth);
    Eigen::VectorXd traction = Eigen::VectorXd::Zero(2 * nodes), cut = Eigen::VectorXd::Zero(2 * nodes);
    for (const Side& side : sides) integral.add(side, load, field, traction);
    for (Eigen::Index i = 0; i < nodes; ++i) {
      const Vec2 p = mesh.node_position.row(i);
      if (on_cut[static_cast<size_t>(i)]) cut.segment<2>(2 * i) = field.displacement(p);
      if (holds_rest[static_cast<size_t>(i)]) {
        // A node on the loaded point itself has no finite half-plane displacement: it is read a micrometre
        // below.
        const Vec2 away = (p - load).norm() > 1e-6 ? p : Vec2(load - 1e-6 * tooth.flank_normal(xi[j]));
        result.half_plane.col(j).segment<2>(2 * i) = field.displacement(away);
      }
    }
    result.force.col(j) = region_stiffness * cut - traction;
    for (Eigen::Index i = 0; i < loads; ++i) {
      result.subtracted(i, j) = beside_flat_surface(field, tooth, moduli, thickness, xi[i], xi[j]);
      result.across(i, j) =
          -mirrored(tooth.flank_normal(xi[i])).dot(field.displacement(mirrored(tooth.flank_point(xi[i]))));
    }
  }
  return result;
}

BodyArtifact reduce(const MeshArtifact& mesh, const Material& material, int modes, int flank_points) {
  const bool all = modes == kAllModes;
  if (modes < 0 && !all) fail(Failure::input, "modes = ", modes, " is below 0");
  const bool matching = mesh.discretisation.near_field == NearField::matching;
  const double depth = mesh.discretisation.matching_depth;
  if (!(material.youngs_modulus > 0) || !(material.density > 0) || !(material.poisson_ratio > -1) ||
      !(material.poisson_ratio < 0.5))
    fail(Failure::input, "youngs_modulus_GPa = ", material.youngs_modulus * 1e-9,
         ", poisson_ratio = ", material.poisson_ratio, ", density_kgm3 = ", material.density,
         ": modulus and density must be above 0, the ratio between -1 and 0.5");
  if (matching && !(depth > 0)) fail(Failure::input, "matching_depth_mm = ", depth * 1e3, " is not above 0");
  const ToothGeometry tooth(mesh.design);
  const int teeth = mesh.design.teeth;
  const double thickness = mesh.design.face_width;
  const FlankTable table(tooth, flank_points);
  const Eigen::VectorXd& xi = table.points();
  const Eigen::Index points = xi.size();

  const PlaneSystem system = assemble(mesh.node_position, mesh.element_node, material, thickness);
  const Eigen::VectorXd rotation = rotation_field(mesh.node_position);
  const Eigen::VectorXd momentum = system.mass * rotation;
  // Of unit translations along x and, imaginary, y. Seen from a tooth that is turned by an angle a this is exp(i a) (1, i):
  // harmonic 1, so that modes of no other number of diameters couple with it.
  const Eigen::VectorXcd translation =
      (Eigen::Vector2cd(1, Complex(0, 1))).replicate(mesh.node_position.rows(), 1);
  const Eigen::VectorXcd linear_momentum = system.mass.cast<Complex>() * translation;
  const CyclicSector sector(mesh, system);
  if (all && sector.size() > kMostDense)
    fail(Failure::input, "body = \"full\" wants all ", static_cast<long>(sector.size()) * teeth, " modes of ",
         teeth, " sectors with ", sector.size(), " unknowns; at most ", kMostDense,
         " are found by dense algebra, at four times the memory and eight times the time for twice as many; ",
         coarse_enough(mesh), "; or set body = \"modal\"");
  const FlankReader reader(mesh);
  const SparseReal outward = reader.outward(xi), back_outward = reader.back_outward(xi);
  // What the loaded tooth is read by in place of its surface.
  const SparseReal below = matching ? reader.outward_below(xi, depth) : outward;
  FlankLoads loads =
      matching ? make_matched_loads(mesh, material, xi, depth) : make_flank_loads(mesh, material, xi);

  // Harmonic by harmonic: flexibility and the lowest modes.
  std::vector<Eigen::MatrixXcd> flexibility;  // [harmonic] (point, load) inward
  std::vector<Eigen::MatrixXcd> across;       // [harmonic] (point, load) inward, of the other flank
  std::vector<KeptMode> found;
  const Eigen::Index shown = points / 2;       // the load whose displacement is stored for looking
  std::vector<Eigen::VectorXcd> displacement;  // [harmonic] (2 node)
  HermitianFactor factor(sector.stiffness(0));
  for (int n = 0; n < sector.harmonics(); ++n) {
    report_step("circumferential harmonics", n, sector.harmonics());
    const std::string what = text("sector stiffness, harmonic ", n, " of ", teeth, " teeth");
    const SparseComplex stiffness = sector.stiffness(n);
    factor.factorise(stiffness, what);
    const Eigen::MatrixXcd solution = sector.expand(n, factor.solve(sector.gather(n, loads.force)));
    flexibility.push_back(-(outward.cast<Complex>() * solution));
    across.push_back(-(back_outward.cast<Complex>() * solution));
    if (matching)
      loads.subtracted -=
          ((sector.single(n) ? 1.0 : 2.0) / teeth * ((below - outward).cast<Complex>() * solution)).real();
    displacement.push_back(solution.col(shown));

    // No more than these of a harmonic can be among the lowest `modes` of the gear; the torsional one is
    // always sought.
    const int wanted = all                ? sector.size()
                       : n == 0           ? std::max(modes, 4)
                       : sector.single(n) ? modes
                                          : (modes + 1) / 2;
    if (wanted == 0) continue;
    const ComplexModes lowest = all ? all_modes(stiffness, sector.mass(n), sector.single(n), what)
                                    : lowest_modes(stiffness, sector.mass(n), factor, wanted, what);
    for (int k = 0; k < wanted; ++k) {
      KeptMode mode;
      mode.harmonic = n;
      mode.omega_squared = lowest.omega_squared[k];
      mode.sector = sector.expand(n, lowest.shape.col(k)) * std::sqrt((sector.single(n) ? 1.0 : 2.0) / teeth);
      fix_phase(mode.sector, outward);
      if (sector.single(n)) mode.sector = mode.sector.real().cast<Complex>().eval();
      mode.flank = outward.cast<Complex>() * mode.sector;
      mode.back = back_outward.cast<Complex>() * mode.sector;
      if (n == 0) mode.coupling = teeth * mode.sector.real().dot(momentum);
      // Half: of the products of two harmonics over all teeth.
      if (n == 1) mode.translation = 0.5 * teeth * mode.sector.dot(linear_momentum);
      if (k >= kDrawnModes) mode.sector.resize(0);  // of all modes together: gigabytes
      found.push_back(std::move(mode));
    }
  }

  // The lowest modes, doublets whole, and the torsional one.
  std::stable_sort(found.begin(), found.end(),
                   [](const KeptMode& a, const KeptMode& b) { return a.omega_squared < b.omega_squared; });
  size_t torsional = 0;
  for (size_t k = 0; k < found.size(); ++k)
    if (std::abs(found[k].coupling) > std::abs(found[torsional].coupling)) torsional = k;
  std::vector<KeptMode> kept;
  int real_modes = 0;
  for (size_t k = 0; k < found.size(); ++k) {
    if (!all && real_modes >= modes && k != torsional) continue;
    real_modes += sector.single(found[k].harmonic) ? 1 : 2;
    kept.push_back(found[k]);
  }

  BodyArtifact body;
  body.design = mesh.design;
  body.material = material;
  body.discretisation = mesh.discretisation;
  body.discretisation.modes = modes;
  body.inertia = teeth * rotation.dot(momentum);
  body.mass = 0.5 * teeth * translation.dot(linear_momentum).real();
  body.eigenfrequency.resize(real_modes);
  body.nodal_diameter.resize(real_modes);
  body.component.resize(real_modes);
  body.inertia_coupling = Eigen::VectorXd::Zero(real_modes);
  body.translation_coupling = MatrixRM::Zero(real_modes, 2);
  body.flank_position = xi;
  body.flank_mode.resize(points, real_modes);
  body.back_flank_mode.resize(points, real_modes);
  body.reference_depth = kReferenceDepth;
  const WholeGear gear = replicate(mesh);
  body.vtk_point = gear.node_position;
  body.vtk_cell = gear.element_node;
  // tooth j: real part of factor(j) u, turned with the tooth
  auto show = [&](const std::string& name, auto&& tooth_displacement) {
    MatrixRM field(gear.node_position.rows(), 2);
    for (int j = 0; j < teeth; ++j) {
      const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2 * kPi * j / teeth).toRotationMatrix();
      const Eigen::VectorXd u = tooth_displacement(j);
      for (Eigen::Index i = 0; i < mesh.node_position.rows(); ++i)
        field.row(gear.node(j, i)) = turn * u.segment<2>(2 * i);
    }
    body.vtk_point_data.emplace_back(name, std::move(field));
  };
  int column = 0;
  for (const KeptMode& mode : kept)
    for (int component = 0; component < (sector.single(mode.harmonic) ? 1 : 2); ++component, ++column) {
      const Complex quarter = component == 0 ? Complex(1, 0) : Complex(0, -1);  // Im z = Re(-i z)
      body.eigenfrequency[column] = std::sqrt(mode.omega_squared) / (2 * kPi);
      body.nodal_diameter[column] = mode.harmonic;
      body.component[column] = component;
      body.inertia_coupling[column] = mode.coupling;
      // Re phi and Im phi against the real and imaginary parts of t.
      const Complex towards = component == 0 ? mode.translation : Complex(0, 1) * mode.translation;
      body.translation_coupling.row(column) << towards.real(), towards.imag();
      body.flank_mode.col(column) = (quarter * mode.flank).real();
      body.back_flank_mode.col(column) = (quarter * mode.back).real();
      if (column >= kDrawnModes) continue;
      char name[64];
      std::snprintf(name, sizeof name, "mode_%02d_%.0fHz", column + 1, body.eigenfrequency[column]);
      show(name, [&](int j) {
        return Eigen::VectorXd(
            (quarter * std::polar(1.0, sector.phase(mode.harmonic) * j) * mode.sector).real());
      });
    }

  // R_d = 1/N sum over all n of exp(i theta_n d) R_n; harmonics n and N - n are conjugate.
  auto offset_sum = [&](int d, auto&& of_harmonic) {
    auto sum = (of_harmonic(0) * 0).real().eval();
    for (int n = 0; n < sector.harmonics(); ++n)
      sum += (sector.single(n) ? 1.0 : 2.0) / teeth *
             (std::polar(1.0, sector.phase(n) * d) * of_harmonic(n)).real();
    return sum;
  };
  body.offsets = std::min(kOffsets, (teeth - 1) / 2);
  const Eigen::MatrixXd own =
      offset_sum(0, [&](int n) -> const Eigen::MatrixXcd& { return flexibility[static_cast<size_t>(n)]; }) +
      loads.subtracted;
  body.asymmetry = (own - own.transpose()).norm() / own.norm();
  // A matched table is as little symmetric as it is exact.
  const double allowed = matching ? 5e-2 : 2e-2;
  if (!(body.asymmetry < allowed))
    fail(Failure::numerical, "the flexibility of the flank is not symmetric: relative asymmetry ",
         body.asymmetry, ", at most ", allowed, " is allowed; lower element_mm (now ",
         mesh.discretisation.element_size * 1e3, ")",
         matching ? text(" or change matching_depth_mm (now ", depth * 1e3, ")") : "");
  for (auto& matrix : flexibility) {
    matrix += loads.subtracted.cast<Complex>();  // tooth 0 alone: the same share in every harmonic
    matrix = (0.5 * (matrix + matrix.adjoint())).eval();
  }
  const auto table_at = [&](int d, const std::vector<Eigen::MatrixXcd>& tables) -> Eigen::MatrixXd {
    return offset_sum(d, [&](int n) -> const Eigen::MatrixXcd& { return tables[static_cast<size_t>(n)]; });
  };
  for (int d = 0; d <= body.offsets; ++d) body.compliance.push_back(table_at(d, flexibility));
  body.far_compliance.resize(points * (teeth / 2 - body.offsets), points);
  for (int d = body.offsets + 1; d <= teeth / 2; ++d)
    body.far_compliance.middleRows((d - body.offsets - 1) * points, points) = table_at(d, flexibility);
  body.back_compliance.resize(points * teeth, points);
  for (int d = 0; d < teeth; ++d) {
    Eigen::MatrixXd x = table_at(d, across);
    if (d == 0) x += loads.across;
    body.back_compliance.middleRows(d * points, points) = 0.5 * (x + x.transpose());
  }

  if (mesh.design.crack.depth > 0) body.crack_compliance = crack_compliance(mesh, material, xi, body.offsets);

  // Eigenvalues of the whole gear's table, all offsets: those of its harmonics, less the kept modes. What the
  // half-plane takes too much beyond its depth leaves up to 2 % of the largest entry below zero (at a module of
  // 0.3 mm); far more is no body.
  const double lowest = -0.1 * body.compliance[0].cwiseAbs().maxCoeff();
  body.least_eigenvalue = std::numeric_limits<double>::infinity();
  for (int n = 0; n < sector.harmonics(); ++n) {
    Eigen::MatrixXcd rest = flexibility[static_cast<size_t>(n)];
    const SymmetricEigen whole = symmetric_eigenvalues(rest);
    if (!(whole.values[0] >= lowest))
      fail(Failure::numerical, "the flexibility of the flank is indefinite: least eigenvalue ",
           whole.values[0], " m/N in harmonic ", n, ", at least ", lowest,
           " m/N is allowed; lower element_mm (now ", mesh.discretisation.element_size * 1e3, ")");
    for (const KeptMode& mode : kept)
      if (mode.harmonic == n)
        rest -=
            (sector.single(n) ? 1.0 : 0.5) * teeth / mode.omega_squared * mode.flank * mode.flank.adjoint();
    body.least_eigenvalue = std::min(body.least_eigenvalue, symmetric_eigenvalues(rest).values[0]);
  }

  show("displacement_unit_force", [&](int j) {
    Eigen::VectorXd u =
        offset_sum(j, [&](int n) -> const Eigen::VectorXcd& { return displacement[static_cast<size_t>(n)]; });
    if (j == 0) u += loads.half_plane.col(shown);
    return u;
  });
  return body;
}

}  // namespace whine
