// Time stepping against closed forms and against Eq. 8 as it is printed.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cmath>

#include "dynamics/newmark.h"
#include "relative.h"

using namespace whine;
using Eigen::Matrix3d;
using Eigen::Vector2d;

namespace {
// exp(h A) for (q, v, g): v' = g - c v - w^2 q with constant g, by scaling and squaring of the Taylor series.
Matrix3d exponential(double w, double c, double h) {
  Matrix3d a;
  a << 0, 1, 0, -w * w, -c, 1, 0, 0, 0;
  // Scaled so that all three states have one size; the scaling is undone at the end.
  const double s = std::max({w, c, 1 / h});
  const Matrix3d scale = Eigen::Vector3d(s * s, s, 1).asDiagonal();
  const int halvings = 40;
  Matrix3d x = scale * a * scale.inverse() * h / std::pow(2.0, halvings), e = x, term = x;
  for (int k = 2; k < 8; ++k) {
    term = term * x / k;
    e += term;
  }
  for (int i = 0; i < halvings; ++i) e = 2 * e + e * e;  // expm1 doubling keeps small parts
  return scale.inverse() * (e + Matrix3d::Identity()) * scale;
}
}  // namespace

TEST_CASE(
    "exact propagator equals the matrix exponential: under-, critically, overdamped, rigid, tiny steps") {
  for (double w : {0.0, 100.0, 1e5, 6e6})
    for (double ratio : {0.0, 0.07, 1.0, 3.0, 24.0, 5e4})
      for (double h : {1e-9, 2e-6, 4e-6}) {
        if (ratio > 100 && w > 100) continue;  // the matrix exponential has no digits left there
        const double c = w > 0 ? 2 * ratio * w : 100 * ratio;
        const Propagator p = exact_propagator(w, c, h);
        const Matrix3d e = exponential(w, c, h);
        INFO("w " << w << " ratio " << ratio << " h " << h);
        const double scale = std::max(1.0, w * h);
        CHECK(std::abs(p.a11 - e(0, 0)) < 2e-11);
        CHECK(std::abs(p.a12 - e(0, 1)) < 2e-11 * h * scale);
        CHECK(std::abs(p.a21 - e(1, 0)) < 2e-11 * (w + 1) * scale);
        CHECK(std::abs(p.a22 - e(1, 1)) < 2e-11 * scale);
        CHECK(std::abs(p.bq - e(0, 2)) < 2e-10 * std::abs(e(0, 2)));
        CHECK(std::abs(p.bv - e(1, 2)) < 2e-10 * h);
      }
}

TEST_CASE("undamped exact propagator: energy gain equals mean force times displacement, for any step") {
  const double w = 2e5;
  for (double h : {1e-7, 3e-6, 5e-5, 1e-3}) {
    const Propagator p = exact_propagator(w, 0, h);
    const double q = 0.3e-6, v = 0.02, g = 4e4;
    const double q1 = p.a11 * q + p.a12 * v + p.bq * g, v1 = p.a21 * q + p.a22 * v + p.bv * g;
    const double gain = 0.5 * (v1 * v1 - v * v) + 0.5 * w * w * (q1 * q1 - q * q);
    CHECK(gain == relative(g * (q1 - q), 1e-9));
  }
}

TEST_CASE("Newmark in one-step form is the paper's three-point formula, Eq. 8") {
  const double w = 2.9e4, c = 3e3, h = 4e-6, gamma = 0.5, beta = 0.25;
  const Propagator p = newmark_propagator(w, c, h);
  const auto force = [](int n) { return 1e3 * std::sin(0.3 * n) + 50 * (n % 3); };
  Vector2d y(1e-6, 0.01);
  double before = 0, now = y[0];
  for (int n = 0; n < 2000; ++n) {
    const double mean = 0.5 * (force(n) + force(n + 1));
    const Vector2d next(p.a11 * y[0] + p.a12 * y[1] + p.bq * mean, p.a21 * y[0] + p.a22 * y[1] + p.bv * mean);
    if (n > 0) {
      const double k = w * w;
      const double right = -(-2 + (1 - 2 * gamma) * h * c + (0.5 - 2 * beta + gamma) * h * h * k) * now -
                           (1 - (1 - gamma) * h * c + (0.5 + beta - gamma) * h * h * k) * before +
                           h * h *
                               (beta * force(n + 1) + (0.5 - 2 * beta + gamma) * force(n) +
                                (0.5 + beta - gamma) * force(n - 1));
      const double three_point = right / (1 + gamma * h * c + beta * h * h * k);
      REQUIRE(std::abs(three_point - next[0]) < 1e-9 * 1e-6);  // round-off of 1e-16 * q / (w h)^2
    }
    before = now;
    now = next[0];
    y = next;
  }
}

TEST_CASE("Newmark is second order, its spurious root on stiff damped modes is near -1") {
  // A stiffness-damped 1 MHz mode released from q = 1, step 2 us: printed roots 0.769586 and -0.99343, exact
  // 0.770732.
  const double w = 2 * std::acos(-1.0) * 1e6, eta = 0.07 / (std::acos(-1.0) * 2900), h = 2e-6;
  const auto roots = [](const Propagator& p) {
    const double trace = p.a11 + p.a22, det = p.a11 * p.a22 - p.a12 * p.a21;
    const double root = std::sqrt(trace * trace / 4 - det);
    return Vector2d(trace / 2 + root, trace / 2 - root);
  };
  CHECK(roots(newmark_propagator(w, eta * w * w, h))[0] == relative(0.769586, 2e-6));
  CHECK(roots(newmark_propagator(w, eta * w * w, h))[1] == relative(-0.99343, 1e-5));
  CHECK(roots(exact_propagator(w, eta * w * w, h))[0] == relative(0.770732, 2e-6));
  // Order: error of one period of a free oscillation falls by 4 when the step is halved.
  double before = 0;
  for (int n : {50, 100, 200, 400}) {
    const Propagator p = newmark_propagator(1, 0.1, 2 * std::acos(-1.0) / n),
                     e = exact_propagator(1, 0.1, 2 * std::acos(-1.0));
    Vector2d y(1, 0);
    for (int i = 0; i < n; ++i) y = Vector2d(p.a11 * y[0] + p.a12 * y[1], p.a21 * y[0] + p.a22 * y[1]);
    const double error = std::hypot(y[0] - e.a11, y[1] - e.a21);
    if (before > 0) CHECK(std::log2(before / error) == relative(2, 0.02));
    before = error;
  }
}

TEST_CASE(
    "relaxed: exact for linear loads, quasi-static for long steps, massless limit of a truncated mode") {
  const double eta = 0.07 / (std::acos(-1.0) * 2900);  // 7 % at 2900 Hz
  for (double h : {1e-9, 1e-7, 2e-6, 5e-5}) {
    const Relaxation relaxed = relaxation_step(eta, h);
    // eta U' + U = a + b t has the solution (U0 - a + eta b) exp(-t/eta) + a + b (t - eta).
    const double u0 = 0.3, a = 1.7, b = -2.1 / h;
    const double exact = (u0 - a + eta * b) * std::exp(-h / eta) + a + b * (h - eta);
    CHECK(std::abs(relaxed.decay * u0 + relaxed.from_old * a + relaxed.from_new * (a + b * h) - exact) <
          1e-15 * (1 + eta * std::abs(b)));
  }
  CHECK(relaxation_step(eta, 1.0).from_new == relative(1, 1e-5));
  CHECK(relaxation_step(0, 1e-6).from_new == 1);
  CHECK(relaxation_step(eta, 2e-6).decay == relative(0.770818, 1e-6));
}
