// Strips and complementarity: Hertz's closed form, problems with known solutions, sets of the same force.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "base/error.h"
#include "contact/complementarity.h"
#include "contact/half_plane_strip.h"
#include "contact/hertz_line.h"
#include "contact/line_contact.h"
#include "contact/strips.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "solved_strips.h"

using namespace whine;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {
constexpr double kPi = std::numbers::pi;

Material strain_steel() {
  return {207e9, 0.3, 7600, false};
}

// m N-1: inward displacement of the point at x (m) from the middle of a strip |x| <= half_width (m) that carries a unit
// force, relative to `depth` (m) under a line load: the mean of ln|t| over the strip from t ln|t| - t.
double under_strip(const HalfPlaneSurface& surface, double x, double half_width, double depth) {
  const auto primitive = [](double t) { return t == 0 ? 0.0 : t * std::log(std::abs(t)) - t; };
  const double mean_log = (primitive(x + half_width) - primitive(x - half_width)) / (2 * half_width);
  return surface.line(1.0, depth) - surface.coefficient() * mean_log;
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
    CHECK((under_strip(surface, x, 20e-6, d) * force - under) * 1e6 == relative(value, 2e-4));
  }
}

TEST_CASE("strips do not depend on how a load is cut: two halves make a whole") {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  for (double x : {0.0, 1e-5, 7e-5, 1e-3}) {
    const double whole = under_strip(surface, x, 2e-5, 1e-3);
    const double halves =
        0.5 * (under_strip(surface, x - 1e-5, 1e-5, 1e-3) + under_strip(surface, x + 1e-5, 1e-5, 1e-3));
    CHECK(whole == relative(halves, 1e-13));
  }
}

TEST_CASE("Hertz line contact: 12 to 50 strips across, any place of the grid") {
  // Pitch point of the paper's pair at 150 N m: a = 109.686 um, p0 = 486.338 MPa; parabolic gap.
  const double width = 25.4e-3, force = 150 / 70.4769466e-3, radius = 12.8257552e-3, a_hertz = 109.686e-6;
  const HalfPlaneSurface surface(strain_steel(), width);
  for (int across : {12, 25, 50}) {
    double least = 1e300, largest = 0;
    for (double shift = 0; shift < 1; shift += 1.0 / 16) {
      const double h = 2 * a_hertz / across;
      const int n = static_cast<int>(1.3 * across) + 2;
      MatrixXd a(n, n);
      VectorXd gap(n);
      for (int i = 0; i < n; ++i) {
        const double x = (i - 0.5 * (n - 1) + shift) * h;
        gap[i] = 0.5 * (x * x + h * h / 12) / radius;  // mean over the strip
        for (int j = 0; j < n; ++j)
          a(i, j) = 2 * surface.mean_over_strip((i - j) * h, 0.5 * h, 0.5 * h, 1e-3);
      }
      // Approach that Hertz says carries this force: both bodies' centre displacement, from the exact line
      // integral g = asinh(l) - ... less the constant between a Hertz load's and a line load's depth point.
      const double c = surface.coefficient(), depth = 1e-3, line = 0.5 / 0.7;
      const double approach = 2 * c * force * (std::log(2 * depth / a_hertz) + 0.5 - line);
      const Solved s = solved(a, gap.array() - approach);
      const double sum = s.p.sum();
      least = std::min(least, sum);
      largest = std::max(largest, sum);
      CHECK(sum == relative(force, 0.17 / (across * across)));
      CHECK(s.p.maxCoeff() / (h * width) == relative(486.338e6, 0.5 / (across * across)));
      CHECK(complementarity_residual(a, gap.array() - approach, s.p) < 1e-17);
    }
    // Strips are open or closed as a whole, so the load varies with the place of the grid: an excitation at the strip-
    // passing frequency, had candidate zones not moved with the contact point. It falls with the square of the strip.
    CHECK((largest - least) / force < 0.3 / (across * across));
  }
}

TEST_CASE("strips of any widths: compliance symmetric, equal to the mean of readings across the strip") {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  for (double x : {0.0, 1e-5, 3e-5, 2e-4}) {
    const double there = surface.mean_over_strip(x, 2e-5, 5e-6, 1e-3);
    CHECK(surface.mean_over_strip(-x, 5e-6, 2e-5, 1e-3) == relative(there, 1e-13));
    double mean = 0;  // midpoint rule over the reading strip
    constexpr int kPoints = 4000;
    for (int i = 0; i < kPoints; ++i)
      mean += under_strip(surface, x + 5e-6 * (2 * (i + 0.5) / kPoints - 1), 2e-5, 1e-3) / kPoints;
    CHECK(there == relative(mean, 1e-7));
  }
}

TEST_CASE(
    "Hertz line contact that grows: a grid a quarter strip off has a quarter of the ripple of a centred one") {
  // Force at the approach that Hertz's closed form gives, while the half width grows by one strip from 12 strips across.
  // With a set of strips that stays, force is linear in the approach; at 12 strips a centred grid adds both ends at once.
  const double face = 25.4e-3, radius = 12.8257552e-3, depth = 1e-3, line = 0.5 / 0.7;
  const HalfPlaneSurface surface(strain_steel(), face);
  const double a0 = 109.686e-6, force0 = 150 / 70.4769466e-3, h = 2 * a0 / 12;
  const auto spread = [&](double offset, double& mean) {
    std::vector<double> errors;
    const int n = 28;
    MatrixXd a(n, n);
    VectorXd gap(n);
    for (int i = 0; i < n; ++i) {
      const double x = (i - 0.5 * (n - 1) + offset) * h;
      gap[i] = (0.5 * x * x + h * h / 24) / radius;  // mean over the strip
      for (int j = 0; j < n; ++j) a(i, j) = 2 * surface.mean_over_strip((i - j) * h, 0.5 * h, 0.5 * h, depth);
    }
    for (int k = 0; k <= 32; ++k) {
      const double growth = 1 + k / (32 * 6.0), half_width = a0 * growth, force = force0 * growth * growth;
      const double approach =
          2 * surface.coefficient() * force * (std::log(2 * depth / half_width) + 0.5 - line);
      errors.push_back(solved(a, gap.array() - approach).p.sum() / force - 1);
    }
    mean = Eigen::Map<VectorXd>(errors.data(), 33).mean();
    return std::sqrt((Eigen::Map<VectorXd>(errors.data(), 33).array() - mean).square().mean());
  };
  double mean = 0;
  const double centred = spread(0, mean);
  CHECK(std::abs(mean) < 1e-4);
  CHECK(centred < 1e-3);  // 8.4e-4
  const double quarter = spread(0.25, mean);
  CHECK(std::abs(mean) < 1e-4);  // 5e-5
  CHECK(quarter < 2.5e-4);       // 2.1e-4
  CHECK(quarter < 0.3 * centred);
}

TEST_CASE("a kept active set costs no factorisation, a changed load finds its own") {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  const int n = 20;
  MatrixXd a(n, n);
  VectorXd gap(n);
  for (int i = 0; i < n; ++i) {
    gap[i] = 40 * std::pow((i - 9.5) * 1e-5, 2);
    for (int j = 0; j < n; ++j) a(i, j) = 2 * under_strip(surface, (i - j) * 1e-5, 5e-6, 1e-3);
  }
  ComplementaritySolver solver;
  ActiveSet active;
  VectorXd p(n), d(n);
  CHECK(solver.solve(a, gap.array() - 1e-7, active, p, d).factorisations > 0);
  CHECK(solver.solve(a, gap.array() - 1.0001e-7, active, p, d).factorisations == 0);
  CHECK(solver.solve(a, gap.array() - 5e-7, active, p, d).factorisations > 0);
  CHECK(p.minCoeff() >= 0);
}

TEST_CASE(
    "candidate zone of strips: constant count, exact interpolation of smooth fields, edges where tips are") {
  const GearPair gears(paper_gear(), paper_gear(), 0.150);
  const CandidateZone range{2e-4, 24, 1e-5};
  for (double phase : {-0.9, -0.87, -0.5, 0.0, 0.5, 0.87, 0.9}) {
    const PairStrips s = make_strips(gears, 0, gears.contact(phase), range);
    CHECK(s.size() == 24);
    CHECK(s.interpolation.rowwise().sum().isApproxToConstant(1.0, 1e-13));
    CHECK(s.gap.minCoeff() >= 0);
    CHECK(s.low_is_edge == (phase <= -0.87));  // the driven gear's tip edge
    CHECK(s.high_is_edge == (phase >= 0.87));  // the driver's
  }
}

TEST_CASE(
    "candidate zone of strips between two tip edges: narrow at both, without a step as either comes near") {
  GearDesign short_tooth = paper_gear();
  short_tooth.addendum = 0.8;  // tips within the other's involute on both sides
  const GearPair gears(short_tooth, short_tooth, 0.150);
  const PairContact contact = gears.contact(0.1);
  const double low = contact.x_min, high = contact.x_max;
  const auto zone = [&](double half) { return make_strips(gears, 0, contact, {half, 32, 1e-5}); };
  for (double half : {1.2 * high - 1.2 * low, 0.1, 10.0}) {
    const PairStrips s = zone(half);
    REQUIRE(s.low_is_edge);
    REQUIRE(s.high_is_edge);
    CHECK(s.border[0] == low);
    CHECK(s.border[32] == high);
    const VectorXd width = s.border.tail(32) - s.border.head(32);
    CHECK(width.minCoeff() > 0);
    const double share = half < 0.05 ? 0.9 : 0.5;
    CHECK(width[0] < share * width[16]);
    CHECK(width[31] < share * width[16]);
  }
  // The candidate zone that reaches either edge, then the other, then has the grade of one pass the other's: borders move with
  // it.
  const double first = std::min(-low, high), last = std::max(-low, high);
  VectorXd before;
  double worst = 0;
  for (int k = 0; k <= 4000; ++k) {
    const PairStrips s = zone(0.9 * first + k / 4000.0 * (4 * last - 0.9 * first));
    if (k > 0) worst = std::max(worst, (s.border - before).cwiseAbs().maxCoeff());
    before = s.border;
  }
  CHECK(worst < 3 * (4 * last - 0.9 * first) / 4000);

  // A flat punch: pressure F / (pi sqrt(a^2 - x^2)), mean of ln|x| under it ln(a / 2) (Johnson, section 2.8).
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  const PairStrips s = zone(10.0);
  const MatrixXd a = half_plane_compliance(s, surface, surface, 20e-3);
  const double exact = 1e-6 / (2 * surface.line(0.25 * (high - low), 20e-3));
  CHECK(solved(a, VectorXd::Constant(32, -1e-6)).p.sum() == relative(exact, 1e-3));
  for (int i = 0; i < 32; ++i)
    for (int j = 0; j < 32; ++j) {
      const double one =
          surface.mean_over_strip(s.middle(i) - s.middle(j), 0.5 * s.width(j), 0.5 * s.width(i), 20e-3);
      CHECK(a(i, j) / (2 * one) == relative(1, 1e-9));  // differences of x^2 ln x
    }
}

TEST_CASE(
    "candidate zone of strips: alike at both ends is not of one width; flanks that do not meet have none") {
  PairStrips s;
  s.border.resize(9);
  for (int i = 0; i <= 8; ++i) s.border[i] = -1e-4 * std::cos(kPi * i / 8);
  s.gap = VectorXd::Zero(8);
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  const MatrixXd a = half_plane_compliance(s, surface, surface, 1e-3);
  const double one =
      surface.mean_over_strip(s.middle(4) - s.middle(3), 0.5 * s.width(3), 0.5 * s.width(4), 1e-3);
  CHECK(a(4, 3) / (2 * one) == relative(1, 1e-12));
  CHECK(a(4, 3) < 0.9 * a(1, 0));

  const GearPair gears(paper_gear(), paper_gear(), 0.150);
  PairContact apart = gears.contact(0);
  apart.x_min = 1e-5;
  apart.x_max = 0.5e-5;
  CHECK(names(message_of([&] { make_strips(gears, 0, apart, {2e-4, 24, 1e-5}); }), {"candidate", "between"}));
}

namespace {
constexpr double kRadius = 12.8257552e-3;  // m, the paper's pair at the pitch point

HertzLine paper_line(double depth, double edge_slope = -INFINITY, double radius = kRadius) {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  return HertzLine(surface, surface, radius, depth, edge_slope);
}

struct StripsSolution {
  double force, centroid;  // N, m
};

// Strips on two half-planes at an approach; the gap ends at x = from, n strips to x = to.
StripsSolution strips_solution(double from, double to, int n, double slope, double approach, double depth) {
  const HalfPlaneSurface surface(strain_steel(), 25.4e-3);
  const double h = (to - from) / n;
  MatrixXd a(n, n);
  VectorXd e(n);
  for (int i = 0; i < n; ++i) {
    const double x = from + (i + 0.5) * h;
    e[i] = slope * x + 0.5 * x * x / kRadius - approach;
    for (int j = 0; j < n; ++j) a(i, j) = 2 * under_strip(surface, (i - j) * h, 0.5 * h, depth);
  }
  const VectorXd p = solved(a, e).p;
  const VectorXd x = VectorXd::LinSpaced(n, from + 0.5 * h, to - 0.5 * h);
  return {p.sum(), p.dot(x) / p.sum()};
}

struct Lines {
  MatrixXd c;
  std::vector<HertzLine> law;
};

// Semidefinite of a random rank, entries about a tooth's 1e-9 m/N.
template <class Random>
Lines random_lines(int n, Random& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const int rank = static_cast<int>(uniform(random) * (n + 1));
  const MatrixXd root = MatrixXd::NullaryExpr(n, rank, [&] { return normal(random); });
  Lines lines{1e-9 / n * root * root.transpose(), {}};
  for (int i = 0; i < n; ++i) {
    const double slope[] = {-INFINITY, -0.01 * uniform(random), 0.0, 0.01 * uniform(random)};
    lines.law.push_back(
        paper_line(1e-3, slope[static_cast<int>(4 * uniform(random))], 5e-3 + 0.02 * uniform(random)));
  }
  return lines;
}
}  // namespace

TEST_CASE("Hertz's law of one line: the exact indentation relative to 1 and 3 mm, from 100 to 600 N m") {
  // Indentation of one body relative to a point at the depth below the semi-ellipse's middle: C F g(depth / a),
  // g(l) = asinh l - nu / (1 - nu) l (sqrt(1 + l^2) - l). The law is its limit for a small a.
  struct Row {
    double torque, half_width, at_1mm, at_3mm;
  };
  const double c = HalfPlaneSurface(strain_steel(), 25.4e-3).coefficient(), nu = 0.3, share = nu / (1 - nu);
  for (const Row& row : {Row{100, 89.558, 0.452472, 0.623892}, Row{150, 109.686, 0.631449, 0.888327},
                         Row{300, 155.120, 1.102036, 1.614294}, Row{600, 219.373, 1.885633, 2.904246}})
    for (double depth : {1e-3, 3e-3}) {
      const double force = row.torque / 70.4769466e-3;
      const HertzLine law = paper_line(depth);
      const double a = 0.5 * law.width(force), l = depth / a;
      CHECK(a * 1e6 == relative(row.half_width, 1e-5));
      const double exact = std::asinh(l) - share * l * (std::sqrt(1 + l * l) - l),
                   limit = std::log(2 * l) - 0.5 * share;
      CHECK((0.5 * law.at(force).indentation + c * force * (exact - limit)) * 1e6 ==
            relative(depth == 1e-3 ? row.at_1mm : row.at_3mm, 2e-6));
    }
}

TEST_CASE("the law of one line inside a flank, cut by a tip edge and at a corner is that of fine strips") {
  const double depth = 1e-3;
  for (double force : {300.0, 2128.0})
    for (double in_widths : {-2.0, -0.5, -0.2, 0.0, 0.3, 2.0}) {
      // In the slope that a Hertz contact has at its end.
      const double slope = in_widths * 0.5 * paper_line(depth).width(force) / kRadius;
      const HertzLine law = paper_line(depth, slope);
      const double from = law.at_edge(force) ? 0 : -1.01 * 0.5 * law.width(force) - slope * kRadius;
      const double to = from + 1.02 * law.width(force);
      const double at_edge_gap =
          slope < 0 ? 0.5 * slope * slope * kRadius : 0;  // the law counts from the touching point
      const auto strips = [&](int n) {
        return strips_solution(from, to, n, slope, law.at(force).indentation - at_edge_gap, depth);
      };
      INFO("force " << force << " slope " << slope);
      // The middle of the first strip stands half a strip off the edge: an error of first order in its width.
      const auto coarse = strips(100), fine = strips(200);
      CHECK(fine.force == relative(force, 6e-3));
      CHECK(2 * fine.force - coarse.force == relative(force, 3e-4));
      CHECK(law.at_edge(force) == (in_widths > -1));
      if (law.at_edge(force))
        CHECK(2 * fine.centroid - coarse.centroid == relative(law.centroid(force), 1e-3));
    }
}

TEST_CASE(
    "the law of one line: slope and energy are those of its indentation, over every joint and the far end") {
  for (double slope : {-double(INFINITY), -0.02, -0.008, 0.0, 0.005}) {
    const HertzLine law = paper_line(1e-3, slope);
    const double largest = law.largest_force();
    for (double force : {1e-3, 10.0, 300.0, 1000.0, 2000.0, 0.999 * largest, 1.5 * largest, -50.0}) {
      const double h = 1e-4 * std::abs(force);
      const auto low = law.at(force - h), at = law.at(force), high = law.at(force + h);
      CHECK(at.slope == relative((high.indentation - low.indentation) / (2 * h), 1e-5));
      CHECK(at.indentation == relative((high.energy - low.energy) / (2 * h), 1e-5));
      CHECK(at.slope > 0);
    }
    CHECK(std::abs(law.at(0).indentation) < 1e-28);
    // Continuous where Hertz's law ends at the edge (a = s) and where the straight line begins.
    const double c = 2 * HalfPlaneSurface(strain_steel(), 25.4e-3).coefficient();
    CHECK(law.at(2 * largest).slope == relative(c / 8, 1e-9));
    if (slope < 0 && std::isfinite(slope)) {
      const double joint = 0.5 * slope * slope * kRadius / c;
      const auto before = law.at(joint * (1 - 1e-9)), after = law.at(joint * (1 + 1e-9));
      CHECK(after.indentation == relative(before.indentation, 1e-8));
      CHECK(after.slope == relative(before.slope, 1e-8));
      CHECK(after.energy == relative(before.energy, 1e-8));
      CHECK(law.centroid(joint) == relative(-slope * kRadius, 1e-9));
    }
  }
  // From the last contact on the line of action to the first corner.
  CHECK(paper_line(1e-3, -1e-12).at(1000).indentation ==
        relative(paper_line(1e-3, 1e-12).at(1000).indentation, 1e-8));
}

TEST_CASE("the law of one line at an edge: width and middle are those of its pressure, integrated") {
  // p = sqrt((w - x) / x) (psi + w / (2 R) + x / R) / (pi C), by x = w sin^2; midpoints are exact for its cosines.
  const double c = 2 * HalfPlaneSurface(strain_steel(), 25.4e-3).coefficient();
  for (double slope : {-0.008, -0.004, 0.0, 0.005, 0.05})
    for (double force : {200.0, 1000.0, 2000.0}) {
      const HertzLine law = paper_line(1e-3, slope);
      if (!law.at_edge(force)) continue;
      const double w = law.width(force);
      double sum = 0, moment = 0;
      constexpr int kPoints = 16;
      for (int i = 0; i < kPoints; ++i) {
        const double angle = (i + 0.5) * 0.5 * kPi / kPoints, x = w * std::pow(std::sin(angle), 2);
        const double load = 2 * w * std::pow(std::cos(angle), 2) * (slope + (0.5 * w + x) / kRadius) /
                            (kPi * c) * 0.5 * kPi / kPoints;
        sum += load;
        moment += load * x;
      }
      INFO("force " << force << " slope " << slope);
      CHECK(sum == relative(force, 1e-12));
      CHECK(law.centroid(force) == relative(moment / sum, 1e-12));
    }
}

TEST_CASE("line contact: one pair is where bisection puts it") {
  const HertzLine law = paper_line(1e-3, -0.005);
  PairMatrix c(1, 1);
  c(0, 0) = 2.1e-9;
  for (double approach : {1e-12, 1e-9, 1e-6, 5e-6}) {
    double low = 0, high = 1e5;
    for (int i = 0; i < 200; ++i) {
      const double middle = 0.5 * (low + high);
      (c(0, 0) * middle + law.at(middle).indentation < approach ? low : high) = middle;
    }
    for (double start : {0.0, 1.0, 1e5}) {
      VectorXd force = VectorXd::Constant(1, start), d(1);
      solve_line_contact(c, std::span(&law, 1), VectorXd::Constant(1, -approach), force, d);
      CHECK(force[0] == relative(low, 1e-12));
    }
  }
}

TEST_CASE(
    "line contact: random problems against projected gradients, from any start; stiffness as a difference") {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int empty = 0, steps = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // Every 60th is one of those that take memory.
    const int n = 1 + trial % kMostPairs + (trial % 60 == 0 ? kMostPairs : 0);
    const Lines lines = random_lines(n, random);
    const VectorXd e = VectorXd::NullaryExpr(n, [&] { return 4e-6 * uniform(random); });
    VectorXd force = VectorXd::Zero(n), d(n);
    const Certificate certificate = solve_line_contact(lines.c, lines.law, e, force, d);
    steps = std::max(steps, certificate.factorisations);
    CHECK(certificate.residual < 1e-12);
    CHECK(force.minCoeff() >= 0);
    CHECK(certificate.least_gap > -1e-12 * e.cwiseAbs().maxCoeff());
    empty += force.isZero();

    VectorXd again = VectorXd::NullaryExpr(n, [&] { return 5e3 * uniform(random); }), other_d(n);
    solve_line_contact(lines.c, lines.law, e, again, other_d);
    CHECK((again - force).cwiseAbs().maxCoeff() < 1e-8 * (1 + force.maxCoeff()));

    // Projected Gauss and Seidel: each force in turn by bisection, the others held.
    VectorXd sweep = VectorXd::Zero(n);
    for (int iteration = 0; iteration < 400; ++iteration)
      for (int i = 0; i < n; ++i) {
        const double rest = lines.c.row(i).dot(sweep) - lines.c(i, i) * sweep[i] + e[i];
        double low = 0, high = rest < 0 ? 1e6 : 0;
        for (int k = 0; k < 60; ++k) {
          const double middle = 0.5 * (low + high);
          (lines.c(i, i) * middle + lines.law[i].at(middle).indentation + rest < 0 ? low : high) = middle;
        }
        sweep[i] = 0.5 * (low + high);
      }
    CHECK((sweep - force).cwiseAbs().maxCoeff() < 1e-6 * (1 + force.maxCoeff()));

    const VectorXd approach = VectorXd::NullaryExpr(n, [&] { return 1 + 0.03 * uniform(random); });
    const double stiffness = line_contact_stiffness(lines.c, lines.law, approach, force), h = 1e-12;
    VectorXd more = force, less = force;
    solve_line_contact(lines.c, lines.law, e - h * approach, more, d);
    solve_line_contact(lines.c, lines.law, e + h * approach, less, d);
    if (force.minCoeff() == 0 && d.cwiseAbs().minCoeff() < 1e-11) continue;  // a pair comes or goes
    if (force.isZero()) {
      CHECK(stiffness == 0);
      CHECK(more.isZero());
      continue;
    }
    CHECK(stiffness == relative((approach.dot(more) - approach.dot(less)) / (2 * h), 1e-3));
  }
  CHECK(empty < 60);
  CHECK(steps < 60);
}

TEST_CASE("line contact: a start that goes along from one e to the next gives the solutions from nothing") {
  std::mt19937 random(13);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int at_once = 0, others = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 1 + trial % 5;
    const Lines lines = random_lines(n, random);
    VectorXd e = VectorXd::NullaryExpr(n, [&] { return 4e-6 * uniform(random); });
    VectorXd force = VectorXd::Zero(n), d(n), cold_d(n);
    LineStart start;
    for (int i = 0; i < 100; ++i) {
      const double step = i % 10 == 0 ? 2e-6 : i % 3 == 0 ? 1e-9 : 1e-16;
      for (double& x : e) x = std::clamp(x + step * uniform(random), -4e-6, 4e-6);
      if (!start.known()) start.look(lines.c, lines.law, force);
      const VectorXd before = force;
      const Certificate certificate = solve_line_contact(lines.c, lines.law, e, start, force, d);
      at_once += start.known() && certificate.factorisations == 1;
      others += ((before.array() > 0) != (force.array() > 0)).any();
      VectorXd cold = VectorXd::Zero(n);
      solve_line_contact(lines.c, lines.law, e, cold, cold_d);
      CHECK((force - cold).cwiseAbs().maxCoeff() < 1e-11 * (1 + cold.maxCoeff()));
      CHECK((d - cold_d).cwiseAbs().maxCoeff() < 1e-13 * e.cwiseAbs().maxCoeff());
      CHECK(certificate.residual < 1e-13);
    }
  }
  CHECK(at_once > 1000);
  CHECK(others > 100);
}

TEST_CASE("line contact: followed from a start nearby or far, d is 0 within round-off where there is force") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int quick = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const int n = 1 + trial % 4;
    const Lines lines = random_lines(n, random);
    const VectorXd e = VectorXd::NullaryExpr(n, [&] { return 4e-6 * uniform(random); });
    VectorXd force = VectorXd::Zero(n), d(n);
    solve_line_contact(lines.c, lines.law, e, force, d);
    for (double off : {1e-9, 1e-3, 0.3, 3.0}) {
      VectorXd near = force;
      for (double& f : near) f *= 1 + off * uniform(random);
      const Certificate certificate = solve_line_contact(lines.c, lines.law, e, near, d);
      quick += off == 1e-9 && certificate.factorisations == 1;
      CHECK((near - force).cwiseAbs().maxCoeff() < 1e-11 * (1 + force.maxCoeff()));
      CHECK(certificate.residual < 1e-13);
      for (int i = 0; i < n; ++i) {
        const double own = near[i] > 0 ? lines.law[i].at(near[i]).indentation : 0;
        const double gap = e[i] + own + lines.c.row(i).dot(near);
        const double size = std::abs(e[i]) + own + lines.c.row(i).cwiseAbs().dot(near);
        CHECK(std::abs(gap - d[i]) < 1e-14 * size);
        CHECK((near[i] > 0 ? std::abs(gap) : -gap) < 1e-14 * size);
      }
    }
  }
  CHECK(quick > 150);  // the others carry nothing, or four
}

TEST_CASE("line contact: pairs without overlap carry nothing; what cannot be solved is rejected") {
  std::mt19937 random(3);
  const Lines lines = random_lines(2, random);
  VectorXd force = VectorXd::Constant(2, 100.0), d(2);
  const VectorXd apart = VectorXd::Constant(2, 1e-6);
  CHECK(solve_line_contact(lines.c, lines.law, apart, force, d).least_gap == 1e-6);
  CHECK(force.isZero());

  const VectorXd deep = VectorXd::Constant(2, -1.0);
  solve_line_contact(lines.c, lines.law, deep, force, d);
  CHECK_THROWS_AS(require_hertz_range(lines.law, force), Error);
  CHECK_NOTHROW(require_hertz_range(lines.law, VectorXd::Constant(2, 1000.0)));
  CHECK_THROWS_AS(solve_line_contact(lines.c, lines.law, VectorXd::Constant(2, NAN), force, d), Error);
  // Newton's step from a compliance that is not symmetric need not lower any energy: said so, and never searched for ever.
  PairMatrix skew(2, 2);
  skew << 2e-9, -9e-9, 0, 2e-9;
  force.setZero();
  CHECK(
      names(message_of([&] { solve_line_contact(skew, lines.law, VectorXd::Constant(2, -1e-6), force, d); }),
            {"Newton's", "along"}));
  PairMatrix indefinite = -1e-8 * PairMatrix::Identity(2, 2);
  force.setZero();
  CHECK_THROWS_AS(solve_line_contact(indefinite, lines.law, VectorXd::Constant(2, -1e-6), force, d), Error);
}

TEST_CASE("gears of plastic: tip edges are found as far as they bend, and all lengths are those of steel") {
  // A body of another modulus: flexibilities go with its inverse, and equal lengths with equal loads over the modulus.
  constexpr double kPlastic = 1e9, kSoft = 1.0 / 207;
  ReducedBody steel = paper_body(40e-3, 1.2e-3, 12), plastic = steel;
  plastic.material.youngs_modulus = kPlastic;
  for (MatrixRM& r : plastic.compliance) r /= kSoft;
  plastic.far_compliance /= kSoft;
  const auto at_rest = [](const ReducedBody& body, double torque) {
    return static_transmission(body, body, paper_statics(8), torque);
  };
  for (const double torque : {1.0, 8.0, 20.0}) {
    CAPTURE(torque);
    const StaticResult soft = at_rest(plastic, torque), hard = at_rest(steel, torque / kSoft);
    CHECK((soft.transmission_error - hard.transmission_error).norm() < 2e-3 * hard.transmission_error.norm());
    CHECK((soft.tooth_load.rowwise().sum() - hard.tooth_load.rowwise().sum() * kSoft).norm() <
          2e-3 * soft.tooth_load.norm());
  }
  CHECK(at_rest(plastic, 20).transmission_error.maxCoeff() > 100e-6);
}
