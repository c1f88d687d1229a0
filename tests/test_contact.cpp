// Strips and complementarity: Hertz's closed form, problems with known solutions, sets of the same force.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "contact/complementarity.h"
#include "contact/half_plane_strip.h"
#include "contact/strips.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double kPi = std::numbers::pi;

Material strain_steel() {
  return {207e9, 0.3, 7600, false};
}

GearDesign paper_gear() {
  GearDesign d;
  d.teeth = 50;
  d.module = 3e-3;
  d.pressure_angle = 20 * kPi / 180;
  d.face_width = 25.4e-3;
  d.bore_radius = 40e-3;
  return d;
}

struct Solved {
  VectorXd p, d;
  Certificate certificate;
  ActiveSet active;
};
Solved solve(const MatrixXd& a, const VectorXd& e, std::vector<int> start = {}) {
  Solved s;
  s.p.resize(e.size());
  s.d.resize(e.size());
  s.active.strips = std::move(start);
  ComplementaritySolver solver;
  s.certificate = solver.solve(a, e, s.active, s.p, s.d);
  return s;
}

// max over i of |min(d_i, p_i A_ii)|, in the unit of e
double complementarity_residual(const MatrixXd& a, const VectorXd& e, const VectorXd& p) {
  const VectorXd d = a * p + e;
  double worst = 0;
  for (int i = 0; i < e.size(); ++i) worst = std::max(worst, std::abs(std::min(d[i], p[i] * a(i, i))));
  return worst;
}
}  // namespace

TEST_CASE("strip on a half-plane: printed values in plane strain") {
  // q = 500 MPa on |x| <= 20 um, E = 207 GPa, nu = 0.3, relative to 1 mm under the strip; the reference here
  // is the line load's depth point, which differs from the strip's by its width over the depth squared: 1e-4.
  const HalfPlaneSurface surface(strain_steel(), 1.0);
  const double force = 500e6 * 40e-6;
  const double table[5][2] = {{0, 0.234970406},
                              {10e-6, 0.227655213},
                              {20e-6, 0.196199810},
                              {50e-6, 0.129448999},
                              {200e-6, 0.052841089}};
  for (const auto& [x, value] : table) {
    // The printed values take the depth point under the reading point: u_z(x, d) instead of u_z(0, d).
    const double d = 1e-3, nu = 0.3, r2 = x * x + d * d;
    const double under = force * 1.3 / (kPi * 207e9) *
                         ((-(1 - nu) * std::log(r2) + d * d / r2) - (-(1 - nu) * std::log(d * d) + 1));
    CHECK((surface.strip(x, 20e-6, d) * force - under) * 1e6 == doctest::Approx(value).epsilon(2e-4));
  }
}

TEST_CASE("strips do not depend on how a load is cut: two halves make a whole") {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  for (double x : {0.0, 1e-5, 7e-5, 1e-3}) {
    const double whole = surface.strip(x, 2e-5, 1e-3);
    const double halves = 0.5 * (surface.strip(x - 1e-5, 1e-5, 1e-3) + surface.strip(x + 1e-5, 1e-5, 1e-3));
    CHECK(whole == doctest::Approx(halves).epsilon(1e-13));
  }
}

TEST_CASE("Hertz line contact: 12 to 50 strips across, any place of the grid") {
  // Pitch point of the paper's pair at 150 N m: a = 109.686 um, p0 = 486.338 MPa; parabolic gap.
  const double width = 25.4e-3, force = 150 / 70.4769466e-3, radius = 12.8257552e-3, a_hertz = 109.686e-6;
  const HalfPlaneSurface surface(strain_steel(), width);
  for (int across : {12, 25, 50}) {
    double least = 1e300, largest = 0;
    for (double shift : {0.0, 0.13, 0.31, 0.5, 0.77}) {
      const double h = 2 * a_hertz / across;
      const int n = static_cast<int>(1.3 * across) + 2;
      MatrixXd a(n, n);
      VectorXd gap(n);
      for (int i = 0; i < n; ++i) {
        const double x = (i - 0.5 * (n - 1) + shift) * h;
        gap[i] = 0.5 * x * x / radius;
        for (int j = 0; j < n; ++j) a(i, j) = 2 * surface.strip((i - j) * h, 0.5 * h, 1e-3);
      }
      // Approach that Hertz says carries this force: both bodies' centre displacement, from the exact line
      // integral g = asinh(l) - ... less the constant between a Hertz load's and a line load's depth point.
      const double c = surface.coefficient(), depth = 1e-3, line = 0.5 / 0.7;
      const double approach = 2 * c * force * (std::log(2 * depth / a_hertz) + 0.5 - line);
      const Solved s = solve(a, gap.array() - approach);
      const double sum = s.p.sum();
      least = std::min(least, sum);
      largest = std::max(largest, sum);
      CHECK(sum == doctest::Approx(force).epsilon(across == 12 ? 1.5e-3 : 5e-4));
      CHECK(s.p.maxCoeff() / (h * width) == doctest::Approx(486.338e6).epsilon(across == 12 ? 8e-3 : 3e-3));
      CHECK(complementarity_residual(a, gap.array() - approach, s.p) < 1e-17);
    }
    // A load that varies with the place of the grid would be an excitation at the strip-passing frequency;
    // windows therefore move with the contact point. What is left falls with the square of the strip.
    CHECK((largest - least) / force < 0.2 / (across * across));
  }
}

TEST_CASE("a kept active set costs no factorisation, a changed load finds its own") {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  const int n = 20;
  MatrixXd a(n, n);
  VectorXd gap(n);
  for (int i = 0; i < n; ++i) {
    gap[i] = 40 * std::pow((i - 9.5) * 1e-5, 2);
    for (int j = 0; j < n; ++j) a(i, j) = 2 * surface.strip((i - j) * 1e-5, 5e-6, 1e-3);
  }
  ComplementaritySolver solver;
  ActiveSet active;
  VectorXd p(n), d(n);
  CHECK(solver.solve(a, gap.array() - 1e-7, active, p, d).factorisations > 0);
  CHECK(solver.solve(a, gap.array() - 1.0001e-7, active, p, d).factorisations == 0);
  CHECK(solver.solve(a, gap.array() - 5e-7, active, p, d).factorisations > 0);
  CHECK(p.minCoeff() >= 0);
}

TEST_CASE("window of strips: constant count, exact interpolation of smooth fields, edges where tips are") {
  const GearPair gears(paper_gear(), paper_gear(), 0.150);
  const ContactRange range{2e-4, 24, 1e-5};
  for (double phase : {-0.9, -0.87, -0.5, 0.0, 0.5, 0.87, 0.9}) {
    const PairStrips s = make_strips(gears, 0, gears.contact(phase), range);
    CHECK(s.size() == 24);
    CHECK(s.interpolation.rowwise().sum().isApproxToConstant(1.0, 1e-13));
    CHECK(s.gap.minCoeff() >= 0);
    CHECK(s.low_is_edge == (phase <= -0.87));  // the driven gear's tip edge
    CHECK(s.high_is_edge == (phase >= 0.87));  // the driver's
  }
}
