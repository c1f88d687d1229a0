// Stress at the root over the face of a tooth that is loaded along its contact line, beside CalculiX: largest along the root, across the helix.
//
// Whine: T_ij of the tables over the width (solid/width_tables.h). CalculiX: its nodal displacements alone. On a side of a wedge in the root
// surface, of eight nodes with shapes N(x, y), the tangents are T_x = sum N_,x X and T_y = sum N_,y X, the strains E_ab = (T_a . u_,b + T_b . u_,a) / 2;
// read at x, y = +-1/sqrt(3), where they are best, along p = T_x less its part along T_y, and h = T_y: sigma = E' (e_p + nu e_h). No fit.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "base/legendre.h"
#include "bench/calculix_gear.h"
#include "gear/helix.h"
#include "results/reduced_body.h"
#include "solid/flank_table.h"
#include "solid/reduce.h"
#include "solid/width_tables.h"

namespace whine {

class RootsOverFace {
 public:
  using Index = Eigen::Index;
  // N m-1 at z over the face width, -0.5 to 0.5.
  using Load = std::function<double(double)>;

  RootsOverFace(const GearDesign& design, const Material& material)
      : design_(design), material_(material), tooth_(design), body_(design, material, plan(), border()) {
    const double nodes = 1 / std::sqrt(3.0);
    const std::vector<double>& level = body_.level();
    for (const Side& side : sides())
      for (size_t k = 0; k + 2 < level.size(); k += 2)
        for (const double x : {-nodes, nodes})
          for (const double y : {-nodes, nodes}) read(side, k, x, y);
  }

  // Under each load at each place(): [load] (place) Pa.
  std::vector<Eigen::VectorXd> theirs(const std::vector<Load>& loads) {
    std::vector<CalculixGear::Vectors> force(loads.size());
    for (size_t l = 0; l < loads.size(); ++l)
      along_the_face([&](double z, double dz) {
        const double value = dz * loads[l](z / design_.face_width), xi = roll(z);
        if (value != 0) body_.add(force[l], {0, 0, xi, z}, value * body_.inward(0, xi, z));
      });
    const Eigen::MatrixXd stress = body_.responses(force, stress_);  // (reading, load)
    std::vector<Eigen::VectorXd> out;
    for (Index l = 0; l < stress.cols(); ++l) {
      Eigen::VectorXd& most = out.emplace_back(Eigen::VectorXd::Zero(static_cast<Index>(place_.size())));
      for (Index i = 0; i < stress.rows(); ++i) {
        const auto at = std::lower_bound(place_.begin(), place_.end(), z_[static_cast<size_t>(i)] - 1e-9);
        double& here = most[at - place_.begin()];
        here = std::max(here, stress(i, l));
      }
    }
    return out;
  }

  std::vector<Eigen::VectorXd> ours(const std::vector<Load>& loads, int degree) const {
    const FlankTable flank(tooth_, 32);
    ReducedBody body;
    body.design = design_;
    body.material = material_;
    body.flank_position = flank.points();
    body.offsets = 0;
    add_width({degree, design_.module / 3}, body);
    const WidthKernel kernel(tooth_, body.width);
    std::vector<Eigen::VectorXd> out;
    for (const Load& load : loads) {
      Eigen::VectorXd force = Eigen::VectorXd::Zero(kernel.tables().flexibility[0].cols());
      along_the_face([&](double z, double dz) {
        force += dz * load(z / design_.face_width) * kernel.point(roll(z), z);
      });
      const Eigen::VectorXd stress = kernel.root_stress(0) * force;
      Eigen::VectorXd& most = out.emplace_back(static_cast<Index>(place_.size()));
      for (Index i = 0; i < most.size(); ++i)
        most[i] = (stress.reshaped(degree + 1, stress.size() / (degree + 1)).transpose() *
                   face_polynomials(place_[static_cast<size_t>(i)], design_.face_width, degree))
                      .maxCoeff();
    }
    return out;
  }

  const std::vector<double>& place() const { return place_; }  // m, ascending
  const CalculixGear& body() const { return body_; }

 private:
  using Side = std::array<std::size_t, 3>;  // nodes of the section along the root: corner, middle, corner

  double roll(double z) const {
    return tooth_.roll_angle_at_radius(tooth_.pitch_radius()) + helix_twist(design_) * z;
  }
  // Layers, thin at the ends of the face, where free teeth have less stress.
  std::vector<double> border() const {
    std::vector<double> out;
    for (const double t :
         {-0.5, -0.48, -0.45, -0.4, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.3, 0.4, 0.45, 0.48, 0.5})
      out.push_back(t * design_.face_width);
    return out;
  }
  template <class F>
  void along_the_face(const F& f) const {
    const std::vector<double> z = border();
    const GaussRule rule = gauss_rule(16);
    for (size_t i = 1; i < z.size(); ++i)
      for (Index k = 0; k < rule.point.size(); ++k) {
        const double half = 0.5 * (z[i] - z[i - 1]);
        f(0.5 * (z[i] + z[i - 1]) + half * rule.point[k], half * rule.weight[k]);
      }
  }
  GearMeshPlan plan() const {
    GearMeshPlan out;
    const double module = design_.module;
    out.coarse = 1.5 * module;
    out.growth = 0.4;
    const GearMesher bare(tooth_, out);
    FineAround root{{}, 0.06 * module, 0.1 * module};
    for (int i = 0; i <= 20; ++i) root.point.push_back(bare.placed(0, tooth_.root_point(0.05 * i), false));
    out.fine = {bare.flanks_of_three(0.2 * module), root};
    return out;
  }
  std::vector<Side> sides() const {
    const std::vector<std::size_t>& root = body_.mesh().root;
    const auto on = [&](std::size_t tag) { return std::binary_search(root.begin(), root.end(), tag); };
    std::vector<Side> out;
    for (const auto& e : body_.mesh().element)
      for (std::size_t i = 0; i < 3; ++i)
        if (const Side side{e[i], e[3 + i], e[(i + 1) % 3]}; on(side[0]) && on(side[1]) && on(side[2]))
          out.push_back(side);
    return out;
  }
  // The stress at a place of a side of the wedge between the levels k and k + 2.
  void read(const Side& side, size_t k, double x, double y) {
    struct Shape {
      int node;
      double dx, dy;
    };
    std::array<Shape, 8> shapes{};
    Eigen::Vector3d t_x = Eigen::Vector3d::Zero(), t_y = t_x, at = t_x;
    size_t count = 0;
    for (int p = -1; p <= 1; ++p)
      for (int q = -1; q <= 1; ++q) {
        if (p == 0 && q == 0) continue;
        const double n = p == 0   ? 0.5 * (1 - x * x) * (1 + q * y)
                         : q == 0 ? 0.5 * (1 + p * x) * (1 - y * y)
                                  : 0.25 * (1 + p * x) * (1 + q * y) * (p * x + q * y - 1),
                     dx = p == 0   ? -x * (1 + q * y)
                          : q == 0 ? 0.5 * p * (1 - y * y)
                                   : 0.25 * p * (1 + q * y) * (2 * p * x + q * y),
                     dy = p == 0   ? 0.5 * q * (1 - x * x)
                          : q == 0 ? -y * (1 + p * x)
                                   : 0.25 * q * (1 + p * x) * (p * x + 2 * q * y);
        const int node = body_.number(side[static_cast<size_t>(p + 1)], k + 1 + static_cast<size_t>(q));
        shapes[count++] = {node, dx, dy};
        at += n * body_.place(node);
        t_x += dx * body_.place(node);
        t_y += dy * body_.place(node);
      }
    const double length = t_y.squaredNorm(), share = t_x.dot(t_y) / length,
                 a = 1 / (t_x - share * t_y).norm(), b = -share * a, nu = material_.poisson_ratio,
                 modulus = material_.youngs_modulus / (1 - nu * nu);
    CalculixGear::Vectors reading;
    for (const Shape& s : shapes)
      reading[s.node] = modulus * (a * a * s.dx * t_x + a * b * (s.dy * t_x + s.dx * t_y) +
                                   (b * b + nu / length) * s.dy * t_y);
    stress_.push_back(std::move(reading));
    z_.push_back(at.z());
    const auto where = std::lower_bound(place_.begin(), place_.end(), at.z() - 1e-9);
    if (where == place_.end() || *where > at.z() + 1e-9) place_.insert(where, at.z());
  }

  GearDesign design_;
  Material material_;
  ToothGeometry tooth_;
  CalculixGear body_;
  std::vector<CalculixGear::Vectors> stress_;  // (reading) Pa m-1
  std::vector<double> z_, place_;              // (reading), (place) m
};

// Prints both at places over the face; the largest difference within the inner 90 % over the largest stress.
inline double compare_roots(const char* name, const GearDesign& design, const Material& material, int degree,
                            const std::vector<std::pair<const char*, RootsOverFace::Load>>& loads) {
  constexpr double kInner = 0.45;
  RootsOverFace roots(design, material);
  std::vector<RootsOverFace::Load> all;
  for (const auto& load : loads) all.push_back(load.second);
  const auto theirs = roots.theirs(all), ours = roots.ours(all, degree);
  std::printf("  %s, root stress, degree %d: CalculiX: %zu nodes, CPU %.0f s\n", name, degree,
              roots.body().nodes(), roots.body().seconds());
  double worst = 0;
  for (size_t l = 0; l < loads.size(); ++l) {
    double off = 0, end = 0;
    const double most = theirs[l].maxCoeff();
    std::printf("    %-12s z/b: here, CalculiX (MPa):", loads[l].first);
    for (size_t i = 0; i < roots.place().size(); ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      const double place = roots.place()[i] / design.face_width, a = ours[l][row], b = theirs[l][row];
      double& largest = std::abs(place) <= kInner ? off : end;
      largest = std::max(largest, std::abs(a - b) / most);
      std::printf(" %.3f: %.2f, %.2f;", place, 1e-6 * a, 1e-6 * b);
    }
    std::printf(
        "\n    largest %.2f, %.2f MPa: %.2f %%; apart by %.2f %%, at the ends of the face by %.2f %%\n",
        1e-6 * ours[l].maxCoeff(), 1e-6 * most, 100 * (ours[l].maxCoeff() / most - 1), 100 * off, 100 * end);
    std::fflush(stdout);
    worst = std::max(worst, off);
  }
  return worst;
}

}  // namespace whine
