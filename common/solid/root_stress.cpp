#include "solid/root_stress.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "base/dense.h"
#include "base/error.h"
#include "contact/half_plane.h"

namespace whine {
namespace {

// The root curve in steps that are even in its parameter.
constexpr int kSteps = 4000;
constexpr Eigen::Index kMostTerms = 9;

// (place, value) 1: least squares by polynomials in x, from -1 to 1 along the root or a piece of it, of values at `at` with the weights `weight`,
// read at `wanted`. Legendre polynomials, of at most degree 8; where zero is -1 or 1, times what vanishes there.
Eigen::MatrixXd fitted(const Eigen::VectorXd& at, const Eigen::VectorXd& weight,
                       const Eigen::VectorXd& wanted, int zero) {
  const Eigen::Index terms = std::clamp<Eigen::Index>(at.size() / 2 + 1, 1, kMostTerms);
  const auto polynomials = [terms, zero](const Eigen::VectorXd& x) {
    Eigen::MatrixXd p(x.size(), terms);
    p.col(0).setOnes();
    if (terms > 1) p.col(1) = x;
    for (Eigen::Index n = 2; n < terms; ++n) {
      const auto k = static_cast<double>(n);
      p.col(n) = ((2 * k - 1) * x.array() * p.col(n - 1).array() - (k - 1) * p.col(n - 2).array()) / k;
    }
    if (zero != 0) p.array().colwise() *= 1 - zero * x.array();
    return p;
  };
  const Eigen::VectorXd root = weight.cwiseSqrt();
  const Eigen::MatrixXd known = root.asDiagonal() * polynomials(at);
  return polynomials(wanted) * least_squares(known, Eigen::MatrixXd(root.asDiagonal()));
}

// Nodes and their mirror images in the centre line of the tooth.
int mirror_node(const SectorGrid& mesh, int node) {
  const Vec2 image(-mesh.node_position(node, 0), mesh.node_position(node, 1));
  Eigen::Index nearest = 0;
  const double miss = (mesh.node_position.rowwise() - image.transpose()).rowwise().norm().minCoeff(&nearest);
  if (miss > 1e-9 * image.norm())
    fail(Failure::input, "the mesh has no mirror image of its root node ", node, " (the nearest node is ",
         miss * 1e3, " mm off); rebuild the mesh");
  return static_cast<int>(nearest);
}

}  // namespace

RootPoints root_points(const ToothGeometry& tooth, int points) {
  std::vector<double> length(kSteps + 1, 0), angle(kSteps + 1, 0), turn(kSteps + 1, 0);
  std::vector<Vec2> at(kSteps + 1);
  for (int i = 0; i <= kSteps; ++i)
    at[static_cast<size_t>(i)] = tooth.root_point(static_cast<double>(i) / kSteps);
  for (size_t i = 1; i <= kSteps; ++i) {
    const Vec2 step = at[i] - at[i - 1];
    length[i] = length[i - 1] + step.norm();
    // Against the centre line, from the tip inwards; of a ring outwards. Above the neck of an undercut tooth it is below 0.
    angle[i] = std::atan2(-step.x(), -tooth.outwards() * step.y());
    if (i > 1) turn[i] = turn[i - 1] + std::abs(angle[i] - angle[i - 1]);
  }
  angle[0] = angle[1];
  RootPoints out;
  out.length = length[kSteps];
  out.places.resize(kSteps + 1);
  out.lengths.resize(kSteps + 1);
  out.parameter.resize(points);
  out.arc_length.resize(points);
  out.angle.resize(points);
  size_t i = 1;
  const auto place = [&](size_t k) { return 0.5 * (length[k] / length[kSteps] + turn[k] / turn[kSteps]); };
  for (size_t k = 0; k <= kSteps; ++k) {
    out.places[k] = place(k);
    out.lengths[k] = length[k];
  }
  for (int k = 0; k < points; ++k) {
    const double wanted = (k + 0.5) / points;
    while (i < kSteps && place(i) < wanted) ++i;
    const double share = (wanted - place(i - 1)) / (place(i) - place(i - 1));
    const auto between = [&](const std::vector<double>& v) { return v[i - 1] + share * (v[i] - v[i - 1]); };
    out.parameter[k] = (static_cast<double>(i) - 1 + share) / kSteps;
    out.arc_length[k] = between(length);
    out.angle[k] = between(angle);
  }
  return out;
}

double least_root_radius(const ToothGeometry& tooth) {
  constexpr int kPieces = 100;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 1; i < kPieces; ++i) {
    const auto at = [&](int k) { return tooth.root_point(static_cast<double>(k) / kPieces); };
    const Vec2 before = at(i) - at(i - 1), after = at(i + 1) - at(i);
    const double turn =
        std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
    if (turn > 0) least = std::min(least, 0.5 * (before.norm() + after.norm()) / turn);
  }
  return least;
}

double RootPoints::place(double s) const {
  const auto above =
      std::clamp<std::ptrdiff_t>(std::upper_bound(lengths.begin(), lengths.end(), s) - lengths.begin(), 1,
                                 static_cast<std::ptrdiff_t>(lengths.size()) - 1);
  const auto i = static_cast<size_t>(above);
  return places[i - 1] + (s - lengths[i - 1]) / (lengths[i] - lengths[i - 1]) * (places[i] - places[i - 1]);
}

// A side of an element on the root of the driving flank.
struct RootReader::Side {
  std::vector<int> node;  // 2, or 3: start, end, middle; from the flank on
};

// The root of the driving flank.
struct RootReader::Curve {
  std::vector<Side> side;
  size_t before_mouth = 0;  // sides from the flank to the mouth of a slit; 0: none opens here
};

// From the lower end of the driving flank along the free boundary to the sector's edge, past a slit.
RootReader::Curve RootReader::curve() const {
  const SectorGrid& mesh = mesh_;
  std::map<std::pair<int, int>, std::pair<std::vector<int>, int>> all;  // nodes, elements at the side
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e)
    for (int k = 0; k < 4; ++k) {
      std::vector<int> node{mesh.element_node(e, k), mesh.element_node(e, (k + 1) % 4)};
      if (node[0] == node[1]) continue;  // the fourth side of a triangle
      if (mesh.element_node.cols() == 9) node.push_back(mesh.element_node(e, 4 + k));
      auto& [nodes, elements] = all[std::minmax(node[0], node[1])];
      nodes = node;
      ++elements;
    }
  std::multimap<int, std::vector<int>> free;
  const std::set<int> flank(mesh.flank_node.begin(), mesh.flank_node.end());
  for (const auto& [ends, side] : all) {
    if (side.second != 1) continue;
    if (flank.contains(ends.first) && flank.contains(ends.second)) continue;
    free.emplace(ends.first, side.first);
    free.emplace(ends.second, side.first);
  }
  std::set<int> edge(mesh.side_node.col(0).begin(), mesh.side_node.col(0).end());
  edge.insert(mesh.side_node.col(1).begin(), mesh.side_node.col(1).end());
  int at = tooth_.internal() ? mesh.flank_node[mesh.flank_node.size() - 1] : mesh.flank_node[0];
  int last = -1;
  std::vector<Side> chain;
  while (!edge.contains(at)) {
    const auto [first, end] = free.equal_range(at);
    const auto next =
        std::find_if(first, end, [&](const auto& s) { return s.second[0] != last && s.second[1] != last; });
    if (next == end || chain.size() > all.size())
      fail(Failure::input, "the root of the mesh breaks off at node ", at,
           " before it reaches the edge of the sector; rebuild the mesh");
    Side side{next->second};
    if (side.node[0] != at) std::swap(side.node[0], side.node[1]);
    last = at;
    at = side.node[1];
    chain.push_back(std::move(side));
  }
  Curve out{std::move(chain)};
  // Two nodes stand at the mouth: the boundary comes to the first of them, and leaves from the second.
  const std::set<int> slit(mesh.slit_node.data(), mesh.slit_node.data() + mesh.slit_node.size());
  const auto at_end = [&](const Side& s) { return slit.contains(s.node[1]); };
  const auto at_start = [&](const Side& s) { return slit.contains(s.node[0]); };
  const auto come = std::find_if(out.side.begin(), out.side.end(), at_end);
  if (come == out.side.end()) return out;
  const auto leave = std::find_if(out.side.rbegin(), out.side.rend(), at_start).base() - 1;
  out.before_mouth = static_cast<size_t>(come - out.side.begin()) + 1;
  out.side.erase(come + 1, leave);
  return out;
}

Eigen::MatrixXd RootReader::fit(const std::vector<Strain>& strains, double length, double mouth) const {
  const Eigen::Index points = points_.parameter.size(), count = static_cast<Eigen::Index>(strains.size());
  const auto place = [&](double arc_length) { return points_.place(arc_length * points_.length / length); };
  const Eigen::VectorXd wanted =
      Eigen::VectorXd::NullaryExpr(points, [&](Eigen::Index i) { return (i + 0.5) / points; });
  Eigen::VectorXd at(count), weight(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Strain& strain = strains[static_cast<size_t>(i)];
    at[i] = place(strain.arc_length);
    weight[i] = strain.weight / length;
  }
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(points, count);
  double from = 0;
  for (const double to : parted_ ? std::vector<double>{place(mouth), 1} : std::vector<double>{1}) {
    const auto split = [&](const Eigen::VectorXd& v, double x) {
      return std::lower_bound(v.begin(), v.end(), x) - v.begin();
    };
    const Eigen::Index first = split(at, from), known = split(at, to) - first, top = split(wanted, from),
                       rows = split(wanted, to) - top;
    const auto inside = [&](const auto& v) {
      return Eigen::VectorXd((2 * (v.array() - from) / (to - from) - 1).matrix());
    };
    if (rows > 0)
      out.block(top, first, rows, known) =
          fitted(inside(at.segment(first, known)), weight.segment(first, known),
                 inside(wanted.segment(top, rows)), parted_ ? (from > 0 ? -1 : 1) : 0);
    from = to;
  }
  return out;
}

RootReader::RootReader(const SectorGrid& mesh, const Material& material, Roots roots, int points)
    : mesh_(mesh),
      sides_(roots == Roots::both ? 2 : 1),
      tooth_(mesh.design),
      points_(root_points(tooth_, points)),
      moduli_(plane_strain_equivalent(material)) {
  const GaussRule fine = gauss_rule(6);
  double length = 0, mouth = 0;
  const Curve root = curve();
  for (size_t k = 0; k < root.side.size(); ++k) {
    const Side& side = root.side[k];
    if (k == root.before_mouth) mouth = length;
    const auto along = [&](double a) {
      const SideShape shape = side_shape(side.node.size(), a);
      Vec2 d = Vec2::Zero();
      for (size_t k = 0; k < std::min(side.node.size(), std::size(shape.slope)); ++k)
        d += shape.slope[k] * Vec2(mesh.node_position.row(side.node[k]));
      return d;
    };
    const auto length_to = [&](double a) {
      double sum = 0;
      for (Eigen::Index g = 0; g < fine.point.size(); ++g)
        sum += 0.5 * (a + 1) * fine.weight[g] * along(-1 + 0.5 * (a + 1) * (1 + fine.point[g])).norm();
      return sum;
    };
    const GaussRule best = gauss_rule(static_cast<int>(side.node.size()) - 1);
    for (const double a : best.point) {
      const SideShape shape = side_shape(side.node.size(), a);
      const Vec2 d = along(a);
      Strain strain{length + length_to(a), d.norm(), Vec2::Zero(), d.normalized(), side.node, {}, {}};
      for (size_t k = 0; k < side.node.size(); ++k) {
        strain.place += shape.value[k] * Vec2(mesh.node_position.row(side.node[k]));
        strain.value.push_back(shape.value[k]);
        strain.slope.push_back(shape.slope[k] / d.norm());
      }
      strains_.push_back(std::move(strain));
    }
    length += length_to(1);
  }
  parted_ = mouth > 0;
  fitting_ = fit(strains_, length, mouth);
  const double modulus = moduli_.youngs_modulus / (1 - moduli_.poisson_ratio * moduli_.poisson_ratio);  // E'
  std::map<int, int> image;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < points; ++i)
    for (size_t g = 0; g < strains_.size(); ++g) {
      const Strain& s = strains_[g];
      for (size_t k = 0; k < s.node.size(); ++k) {
        const int node = s.node[k];
        if (sides_ == 2 && !image.contains(node)) image[node] = mirror_node(mesh, node);
        for (int c = 0; c < 2; ++c) {
          const double value =
              fitting_(i, static_cast<Eigen::Index>(g)) * modulus * s.slope[k] * s.tangent[c];
          entries.emplace_back(i, 2 * node + c, value);
          if (sides_ == 2) entries.emplace_back(points + i, 2 * image.at(node) + c, c == 0 ? -value : value);
        }
      }
    }
  stress_.resize(sides_ * points, 2 * mesh.node_position.rows());
  stress_.setFromTriplets(entries.begin(), entries.end());
}

FaceFunctional RootReader::over_face(double helix) const {
  const double nu = moduli_.poisson_ratio, modulus = moduli_.youngs_modulus / (1 - nu * nu);  // E'
  std::vector<Eigen::Triplet<double>> values, slopes;
  for (size_t g = 0; g < strains_.size(); ++g) {
    const Strain& s = strains_[g];
    // Tangents along the root and the helix; with l = |h|^2 and m = t . h, p = (t - m / l h) / |t - m / l h|.
    const Eigen::Vector3d t(s.tangent.x(), s.tangent.y(), 0), h(-helix * s.place.y(), helix * s.place.x(), 1);
    const double l = h.squaredNorm(), m = t.dot(h), square = 1 - m * m / l;
    // sigma_p = a . u,s + b . u,z, u,z along the helix: e_ss = t . u,s, 2 e_sz = h . u,s + t . u,z, e_zz = h . u,z.
    const Eigen::Vector3d a = modulus / square * (t - m / l * h),
                          b = modulus / square * (m * m / (l * l) * h - m / l * t) + modulus * nu / l * h;
    // u,z = du/dz + helix z x u in turned axes.
    const Eigen::Vector3d turned = helix * Eigen::Vector3d(b.y(), -b.x(), 0);
    for (size_t k = 0; k < s.node.size(); ++k) {
      const Eigen::Vector3d value = s.slope[k] * a + s.value[k] * turned, slope = s.value[k] * b;
      for (Eigen::Index i = 0; i < fitting_.rows(); ++i) {
        const double share = fitting_(i, static_cast<Eigen::Index>(g));
        for (int c = 0; c < 3; ++c) {
          const int row = 3 * s.node[k] + c;
          if (value[c] != 0) values.emplace_back(row, static_cast<int>(i), share * value[c]);
          if (slope[c] != 0) slopes.emplace_back(row, static_cast<int>(i), share * slope[c]);
        }
      }
    }
  }
  FaceFunctional out;
  out.value.resize(3 * mesh_.node_position.rows(), fitting_.rows());
  out.value.setFromTriplets(values.begin(), values.end());
  out.slope.resize(out.value.rows(), out.value.cols());
  out.slope.setFromTriplets(slopes.begin(), slopes.end());
  return out;
}

MatrixRM RootReader::near_field(const FlankLoads& loads, const Eigen::VectorXd& xi) const {
  const Eigen::Index points = points_.parameter.size(), nodes = mesh_.node_position.rows();
  MatrixRM out = MatrixRM::Zero(sides_ * points, xi.size());
  if (std::none_of(loads.holds_rest.begin(), loads.holds_rest.end(), [](char rest) { return rest != 0; }))
    return out;
  const double thickness = mesh_.design.face_width,
               across = moduli_.poisson_ratio / (1 - moduli_.poisson_ratio);
  // Nodes of the roots that hold u: what they hold of the half-plane is taken off; beside a slit, added to the others.
  std::set<int> held_at;
  for (int column = 0; column < stress_.outerSize(); ++column)
    for (SparseReal::InnerIterator it(stress_, column); it; ++it)
      if ((loads.holds_rest[static_cast<size_t>(it.col() / 2)] != 0) == parted_)
        held_at.insert(static_cast<int>(it.col() / 2));
  for (Eigen::Index j = 0; j < xi.size(); ++j) {
    const LineLoadField field(tooth_.flank_point(xi[j]), tooth_.flank_normal(xi[j]), moduli_, thickness,
                              kReferenceDepth);
    Eigen::VectorXd held = Eigen::VectorXd::Zero(2 * nodes);
    for (const int node : held_at)
      held.segment<2>(2 * node) = field.displacement(mesh_.node_position.row(node).transpose());
    out.col(j) = (parted_ ? 1 : -1) * (stress_ * held);
    if (parted_) continue;
    for (Eigen::Index i = 0; i < points; ++i) {
      const double t = points_.parameter[i], step = 1e-5;
      const Vec2 d = tooth_.root_point(std::min(t + step, 1.0)) - tooth_.root_point(std::max(t - step, 0.0));
      for (int side = 0; side < sides_; ++side) {
        const Vec2 mirror(side == 0 ? 1 : -1, 1);
        const Vec2 point = tooth_.root_point(t).cwiseProduct(mirror),
                   tangent = d.normalized().cwiseProduct(mirror), normal(tangent.y(), -tangent.x());
        out(side * points + i, j) += (field.traction(point, tangent).dot(tangent) -
                                      across * field.traction(point, normal).dot(normal)) /
                                     thickness;
      }
    }
  }
  return out;
}

}  // namespace whine
