#include "solid/width_body.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "base/error.h"
#include "base/legendre.h"
#include "base/progress.h"
#include "base/units.h"
#include "gear/involute.h"
#include "solid/elements.h"
#include "solid/factor.h"
#include "solid/flank_loads.h"
#include "solid/root_stress.h"
#include "solid/width_tables.h"

namespace whine {
namespace {

// A component x, y or z of the displacements (0, 1, 2) times a polynomial.
struct Shape3d {
  int component, polynomial;
  // Under half a turn about the centre line of the tooth: 1, or -1 where it changes its sign.
  int image() const { return (component == 1 ? 1 : -1) * (polynomial % 2 == 0 ? 1 : -1); }
};

// The shapes of displacement that are coupled: all of a helical gear; of a spur gear those of one parity in z and the rest.
std::vector<std::vector<Shape3d>> families(int degree, bool helical) {
  std::vector<std::vector<Shape3d>> result(helical ? 1 : 2);
  for (int component = 0; component < 3; ++component)
    for (int j = 0; j <= degree; ++j)
      result[helical ? 0 : static_cast<size_t>((component / 2 + j) % 2)].push_back({component, j});
  return result;
}

// The sector's section: free nodes in their order of elimination, those of the clockwise edge and then those of the other last.
struct Section {
  Section(const SectorGrid& mesh, const Material& material, double helix, const FaceFunctional& functional);

  Eigen::Index nodes = 0, edge = 0;  // free ones; those of one edge
  SectionSystem stiffness;
  FaceFunctional load;
};

// The rows of nodes that have a number, in the order of the numbers.
SparseReal of_nodes(const SparseReal& functional, const Eigen::VectorXi& number, Eigen::Index nodes) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(functional.nonZeros()));
  for (int k = 0; k < functional.outerSize(); ++k)
    for (SparseReal::InnerIterator it(functional, k); it; ++it)
      if (const int node = number[it.row() / 3]; node >= 0)
        entries.emplace_back(3 * node + static_cast<int>(it.row() % 3), k, it.value());
  SparseReal out(3 * nodes, functional.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

// Adjacent nodes of elements: (node, node) of those that have a number.
SparseReal adjacent_nodes(const MatrixRMi& element_node, const Eigen::VectorXi& number, int count) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(element_node.size() * element_node.cols()));
  for (Eigen::Index e = 0; e < element_node.rows(); ++e)
    for (const int a : element_node.row(e))
      for (const int b : element_node.row(e))
        if (number[a] >= 0 && number[b] >= 0) entries.emplace_back(number[a], number[b], 1);
  SparseReal graph(count, count);
  graph.setFromTriplets(entries.begin(), entries.end());
  return graph;
}

Section::Section(const SectorGrid& mesh, const Material& material, double helix,
                 const FaceFunctional& functional) {
  Eigen::VectorXi number = Eigen::VectorXi::Zero(mesh.node_position.rows());
  for (const int node : mesh.bore_node) number[node] = -1;
  std::vector<std::pair<int, int>> sides;  // free pairs: clockwise edge, the other
  for (Eigen::Index i = 0; i < mesh.side_node.rows(); ++i)
    if (number[mesh.side_node(i, 0)] >= 0) sides.emplace_back(mesh.side_node(i, 0), mesh.side_node(i, 1));
  edge = static_cast<Eigen::Index>(sides.size());
  std::vector<int> free;
  free.reserve(static_cast<size_t>(number.size()));
  for (int i = 0; i < number.size(); ++i)
    if (number[i] >= 0) {
      number[i] = static_cast<int>(free.size());
      free.push_back(i);
    }
  nodes = static_cast<Eigen::Index>(free.size());
  std::vector<char> last(free.size(), 0);
  for (const auto& [low, high] : sides)
    last[static_cast<size_t>(number[low])] = last[static_cast<size_t>(number[high])] = 1;
  const std::vector<int> order =
      elimination_order(adjacent_nodes(mesh.element_node, number, static_cast<int>(nodes)), last);
  for (size_t k = 0; k < order.size(); ++k) number[free[static_cast<size_t>(order[k])]] = static_cast<int>(k);
  int place = static_cast<int>(nodes - 2 * edge);
  for (const auto& [low, high] : sides) {
    number[high] = place + static_cast<int>(edge);
    number[low] = place++;
  }
  stiffness = assemble_section(mesh.node_position, mesh.element_node, material, helix, number,
                               static_cast<int>(nodes));
  load = {of_nodes(functional.value, number, nodes), of_nodes(functional.slope, number, nodes)};
}

// Upper triangle of the stiffness of a family of shapes, (node shape, node shape).
SparseReal family_stiffness(const Section& section, const std::vector<Shape3d>& family, double width) {
  const SectionSystem& s = section.stiffness;
  const int shapes = static_cast<int>(family.size());
  std::vector<int> rows;
  std::vector<double> values;
  std::vector<int> starts{0};
  const auto entry = [&](Eigen::Index at, int i, int j) {
    const double a = value_times_slope(i, j, width), b = value_times_slope(j, i, width),
                 c = slope_times_slope(i, j, width);
    return (i == j ? s.k00.valuePtr()[at] : 0) + a * s.k01.valuePtr()[at] + b * s.k10.valuePtr()[at] +
           c * s.k11.valuePtr()[at];
  };
  for (int node = 0; node < section.nodes; ++node)
    for (int q = 0; q < shapes; ++q) {
      const Shape3d of = family[static_cast<size_t>(q)];
      const int column = 3 * node + of.component;
      // Blocks of three rows, of each node one.
      for (int at = s.k00.outerIndexPtr()[column]; at < s.k00.outerIndexPtr()[column + 1]; at += 3) {
        const int other = s.k00.innerIndexPtr()[at] / 3;
        if (other > node) break;
        for (int p = 0; p < (other == node ? q + 1 : shapes); ++p) {
          const Shape3d by = family[static_cast<size_t>(p)];
          rows.push_back(other * shapes + p);
          values.push_back(entry(at + by.component, by.polynomial, of.polynomial));
        }
      }
      starts.push_back(static_cast<int>(rows.size()));
    }
  const Eigen::Index size = section.nodes * shapes;
  return Eigen::Map<const SparseReal>(size, size, starts.back(), starts.data(), rows.data(), values.data());
}

// One family, its sector condensed, in the axes of the harmonics: entries of the edge in which S_n is real, those with image() 1
// first.
struct SectorEdge {
  Eigen::MatrixXd still, turning,
      across;  // (edge, edge) Pa m: S_n = still + cos theta turning + sin theta across
  Eigen::MatrixXd with_cosine,
      with_sine;  // (edge, load): R_n = cos(theta / 2) with_cosine + sin(theta / 2) with_sine ...
  Eigen::MatrixXd with_cosine_i, with_sine_i;  // and its imaginary part
  Eigen::MatrixXd inner;                       // (load, load) m2 N-1: D
  std::vector<int> polynomial;                 // of the loads, which are (flank polynomial)
};

// Both edges turned to the centre line of the tooth, by plus and minus half a pitch: (edge shape, edge shape), clockwise edge first.
SparseReal turn_to_centre(const std::vector<Shape3d>& family, Eigen::Index edge_nodes, int teeth) {
  const Eigen::Index shapes = static_cast<Eigen::Index>(family.size()), size = edge_nodes * shapes;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(4 * size));
  for (Eigen::Index k = 0; k < 2 * size; ++k) {
    const Shape3d& shape = family[static_cast<size_t>(k % shapes)];
    const double angle = (k < size ? -kPi : kPi) / teeth;
    for (Eigen::Index q = 0; q < shapes; ++q) {
      const Shape3d& other = family[static_cast<size_t>(q)];
      if (other.polynomial != shape.polynomial || (other.component == 2) != (shape.component == 2)) continue;
      const double entry = shape.component == 2                 ? 1
                           : shape.component == other.component ? std::cos(angle)
                           : shape.component == 0               ? -std::sin(angle)
                                                                : std::sin(angle);
      entries.emplace_back(k, k / shapes * shapes + q, entry);
    }
  }
  SparseReal turn(2 * size, 2 * size);
  turn.setFromTriplets(entries.begin(), entries.end());
  return turn;
}

// (node shape, functional polynomial): the functionals times the polynomials of the family's loads.
Eigen::MatrixXd shape_forces(const FaceFunctional& of, Eigen::Index nodes, const std::vector<Shape3d>& family,
                             const std::vector<int>& polynomial, double width) {
  const Eigen::Index shapes = static_cast<Eigen::Index>(family.size()),
                     loads = static_cast<Eigen::Index>(polynomial.size());
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(nodes * shapes, of.value.cols() * loads);
  const auto add = [&](const SparseReal& functional, auto&& factor) {
    for (Eigen::Index p = 0; p < functional.cols(); ++p)
      for (SparseReal::InnerIterator it(functional, p); it; ++it)
        for (Eigen::Index q = 0; q < shapes; ++q)
          if (const Shape3d& shape = family[static_cast<size_t>(q)]; shape.component == it.row() % 3)
            for (Eigen::Index l = 0; l < loads; ++l)
              force(it.row() / 3 * shapes + q, p * loads + l) +=
                  it.value() * factor(polynomial[static_cast<size_t>(l)], shape.polynomial);
  };
  add(of.value, [](int i, int j) { return i == j ? 1.0 : 0.0; });
  add(of.slope, [width](int i, int j) { return value_times_slope(i, j, width); });
  return force;
}

SectorEdge condense_family(const Section& section, const std::vector<Shape3d>& family, const SectorGrid& mesh,
                           const std::string& what) {
  const Eigen::Index shapes = static_cast<Eigen::Index>(family.size());
  const double width = mesh.design.face_width;
  SectorEdge edge;
  for (const Shape3d& shape : family)
    if (shape.component == 0) edge.polynomial.push_back(shape.polynomial);
  const Eigen::MatrixXd force = shape_forces(section.load, section.nodes, family, edge.polynomial, width);
  const Eigen::Index size = section.edge * shapes;
  CondensedSystem c = condensed_system(family_stiffness(section, family, width), 2 * size, force, what);

  const SparseReal turn = turn_to_centre(family, section.edge, mesh.design.teeth);
  const Eigen::MatrixXd s = turn.transpose() * (c.stiffness * turn), r = turn.transpose() * c.load;

  // Those that keep their sign under half a turn about the tooth first.
  std::vector<Eigen::Index> order;
  order.reserve(static_cast<size_t>(size));
  Eigen::Index kept = 0;
  for (const int image : {1, -1}) {
    for (Eigen::Index k = 0; k < size; ++k)
      if (family[static_cast<size_t>(k % shapes)].image() == image) order.push_back(k);
    if (image == 1) kept = static_cast<Eigen::Index>(order.size());
  }
  const auto block = [&](Eigen::Index row, Eigen::Index column) {
    return s.block(row * size, column * size, size, size)(order, order).eval();
  };
  const Eigen::MatrixXd low_high = block(0, 1), odd = low_high - low_high.transpose();
  edge.still = block(0, 0) + block(1, 1);
  edge.turning = low_high + low_high.transpose();
  const Eigen::Index changed = size - kept;
  edge.across = Eigen::MatrixXd::Zero(size, size);
  edge.across.topRightCorner(kept, changed) = -odd.topRightCorner(kept, changed);
  edge.across.bottomLeftCorner(changed, kept) = odd.bottomLeftCorner(changed, kept);
  const Eigen::MatrixXd low = r.topRows(size)(order, Eigen::all),
                        high = r.bottomRows(size)(order, Eigen::all);
  const Eigen::MatrixXd sum = low + high, difference = low - high;
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(size, r.cols());
  edge.with_cosine = edge.with_sine = edge.with_cosine_i = edge.with_sine_i = none;
  edge.with_cosine.topRows(kept) = sum.topRows(kept);
  edge.with_sine.bottomRows(changed) = difference.bottomRows(changed);
  edge.with_sine_i.topRows(kept) = difference.topRows(kept);
  edge.with_cosine_i.bottomRows(changed) = -sum.bottomRows(changed);
  edge.inner = std::move(c.flexibility);
  return edge;
}

// (load, load) m2 N-1 for the offsets 0 .. offsets: 1/N sum over n of exp(i theta_n k) G_n.
std::vector<Eigen::MatrixXd> flexibility(const SectorEdge& edge, int teeth, int offsets,
                                         const std::string& what) {
  const Eigen::Index loads = edge.inner.rows(), size = edge.still.rows();
  std::vector<Eigen::MatrixXd> sum(static_cast<size_t>(offsets) + 1, Eigen::MatrixXd::Zero(loads, loads));
  sum[0] = edge.inner;
  for (int n = 0; 2 * n <= teeth; ++n) {
    report_step("harmonics over the face width", n, teeth / 2 + 1);
    const double theta = 2 * kPi * n / teeth, cosine = std::cos(theta / 2), sine = std::sin(theta / 2);
    const Eigen::LLT<Eigen::MatrixXd> factor(
        Eigen::MatrixXd(edge.still + std::cos(theta) * edge.turning + std::sin(theta) * edge.across));
    if (factor.info() != Eigen::Success)
      fail(Failure::numerical, "stiffness of ", what, " over the face width, harmonic ", n, " of ", teeth,
           " teeth: it is not positive definite; check the mesh, its bore nodes and the material");
    Eigen::MatrixXd x(size, 2 * loads);
    x << cosine * edge.with_cosine + sine * edge.with_sine,
        cosine * edge.with_cosine_i + sine * edge.with_sine_i;
    factor.matrixL().solveInPlace(x);
    const Eigen::MatrixXd g = x.transpose() * x;
    const Eigen::MatrixXd real = g.topLeftCorner(loads, loads) + g.bottomRightCorner(loads, loads),
                          imaginary = g.topRightCorner(loads, loads) - g.bottomLeftCorner(loads, loads);
    const double share = (n == 0 || 2 * n == teeth ? 1.0 : 2.0) / teeth;
    for (int k = 0; k <= offsets; ++k)
      sum[static_cast<size_t>(k)] += share * (std::cos(theta * k) * real - std::sin(theta * k) * imaginary);
  }
  return sum;
}

}  // namespace

SparseReal inward_normal(const SectorGrid& section, double helix, const Eigen::VectorXd& flank_position) {
  const ToothGeometry tooth(section.design);
  const SparseReal reading = FlankReader(section).displacement(flank_position);
  const double axial = -helix * tooth.base_radius(), length = std::hypot(1, axial);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<size_t>(9 * flank_position.size()));
  for (int column = 0; column < reading.outerSize(); column += 2)
    for (SparseReal::InnerIterator it(reading, column); it; ++it) {
      const int point = static_cast<int>(it.row() / 2);
      const Vec2 transverse = tooth.flank_normal(flank_position[point]);
      for (int c = 0; c < (helix == 0 ? 2 : 3); ++c)
        entries.emplace_back(column / 2 * 3 + c, point,
                             -it.value() * (c < 2 ? transverse[c] : axial) / length);
    }
  SparseReal functional(3 * section.node_position.rows(), flank_position.size());
  functional.setFromTriplets(entries.begin(), entries.end());
  return functional;
}

std::vector<MatrixRM> width_flexibility(const SectorGrid& section, const Material& material, double helix,
                                        int degree, const FaceFunctional& functional, int offsets) {
  if (degree < 0 || degree > kLargestDegree)
    fail(Failure::input, "polynomials over the face width of degree ", degree, ", which must be 0 to ",
         kLargestDegree);
  if (section.design.elastic_rim())
    fail(
        Failure::input,
        "width = \"body\" of a ring on an elastic support: nothing holds it along its axis; leave the stiffnesses of its rim out, or use width = \"slices\"");
  const Section sector(section, material, helix, functional);
  const Eigen::Index points = functional.value.cols(), all = degree + 1;
  std::vector<MatrixRM> tables(static_cast<size_t>(offsets) + 1, MatrixRM::Zero(points * all, points * all));
  for (const auto& family : families(degree, helix != 0)) {
    if (family[0].component == 2) continue;  // no functional in the section moves it
    const std::string what = text("a sector of ", section.design.teeth, " teeth, degree ", degree);
    const SectorEdge edge = condense_family(sector, family, section, what);
    const auto sums = flexibility(edge, section.design.teeth, offsets, what);
    std::vector<Eigen::Index> place;
    place.reserve(static_cast<size_t>(edge.inner.rows()));
    for (Eigen::Index p = 0; p < points; ++p)
      for (const int j : edge.polynomial) place.push_back(p * all + j);
    for (size_t k = 0; k < sums.size(); ++k) tables[k](place, place) = sums[k];
  }
  return tables;
}

namespace {

// The functionals of both, one beside the other.
FaceFunctional joined(const FaceFunctional& a, const FaceFunctional& b) {
  const auto beside = [&](const SparseReal& left, const SparseReal& right) {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(static_cast<size_t>(left.nonZeros() + right.nonZeros()));
    for (const auto& [part, from] : {std::pair{&left, Eigen::Index{0}}, {&right, a.value.cols()}})
      for (int k = 0; k < part->outerSize(); ++k)
        for (SparseReal::InnerIterator it(*part, k); it; ++it)
          entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(from) + k, it.value());
    SparseReal out(a.value.rows(), a.value.cols() + b.value.cols());
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  };
  return {beside(a.value, b.value), beside(a.slope, b.slope)};
}

}  // namespace

WidthTables make_width_tables(const SectorGrid& section, const Material& material, double helix, int degree,
                              const Eigen::VectorXd& flank_position, int offsets) {
  const Eigen::Index all = degree + 1, flank = flank_position.size() * all;
  Material solid = material;
  solid.plane_stress = false;
  FaceFunctional functional = RootReader(section, solid, Roots::driving).over_face(helix);
  const Eigen::Index root = functional.value.cols() * all;
  functional = joined({inward_normal(section, helix, flank_position), {}}, functional);
  WidthTables tables{degree, section.design.face_width, helix, flank_position, {}, {}};
  for (const MatrixRM& table : width_flexibility(section, material, helix, degree, functional, offsets)) {
    tables.flexibility.push_back(table.topLeftCorner(flank, flank));
    // Of the tooth counter-clockwise of the loaded one, and by symmetry of that clockwise of it.
    tables.root_stress.push_back(table.bottomLeftCorner(root, flank));
    if (tables.flexibility.size() > 1)
      tables.root_stress.insert(tables.root_stress.begin(), table.topRightCorner(flank, root).transpose());
  }
  const MatrixRM plane =
      width_flexibility(section, material, 0, 0, {inward_normal(section, 0, flank_position), {}}, 0)[0];
  const Eigen::VectorXd share =
      plane_share(ToothGeometry(section.design).base_radius(), helix, flank_position);
  MatrixRM& own = tables.flexibility[0];
  for (Eigen::Index a = 0; a < plane.rows(); ++a)
    for (Eigen::Index b = 0; b < plane.cols(); ++b)
      own.block(a * all, b * all, all, all).diagonal().array() -=
          std::sqrt(share[a] * share[b]) * plane(a, b);
  return tables;
}

}  // namespace whine
