// Contact of one tooth pair along one line: the closed law of force and indentation, inside a flank and at a tip edge.
//
// Two half-planes of log coefficients C_1, C_2 (sum C), gap x^2 / (2 R). Inside a flank the pressure is Hertz's
// semi-ellipse of width w = 2 a, a = sqrt(2 R F C), its mean of ln|x| is ln(w / 4) - 1 / 2, and the middle sinks by
//   F sum_g C_g (ln(2 depth / a) + 1 / 2 - 1 / (2 (1 - nu_g)))
// (Johnson, Contact Mechanics, 1985, sections 2.2, 4.2(c) and 5.6). Contact that ends at a tip edge, x = 0 there and gap
// psi x + x^2 / (2 R), has instead the pressure sqrt((w - x) / x) (b + c x) of the same integral equation, bounded
// at one end only (Johnson, section 2.7), and so
//   C F = psi w / 2 + 3 w^2 / (8 R),   indentation = sum_g C_g F (ln(4 depth / w) + 1 - 1 / (2 (1 - nu_g))) - 3 w^2 / (16 R).
// psi > 0 is the slope at a corner. psi = -s / R is a touching point at distance s from the edge: Hertz's law holds up
// to a = s, where both laws have the same value and slope, and then the edge's, less s^2 / (2 R) of gap at the edge.
// Either way the slope is C (ln(4 depth / w) - k), k the mean of 1 / (2 (1 - nu_g)) with weights C_g.
//
// The indentation is relative to `depth` under a line load, the convention of the flank tables; what lies deeper is
// theirs, the wedge that ends at the edge included, and the sum of both does not depend on `depth`. (Relative to the
// point at that depth under the semi-ellipse itself, a << depth, the constant 1 / 2 - 1 / (2 (1 - nu)) is the same: it
// is -nu / (2 (1 - nu)).)
//
// The law rises as long as w < 4 depth exp(-k), 1.47 depth and more for any nu. It is used up to exp(-1/8) of that
// (a = 0.92 depth for steel in plane stress, 0.86 in plane strain), where its slope has fallen to C / 8, and goes on as
// a straight line of that slope, so that Newton's method may try any force. A result beyond `largest_force` is none.
#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

#include "contact/half_plane_strip.h"

namespace whine {

class HertzLine {
 public:
  // At one force; the slope is positive everywhere.
  struct Point {
    double indentation = 0;  // m
    double slope = 0;        // m N-1: d indentation / d force
    double energy = 0;       // N m: integral of the indentation over the force
  };

  // radius: m, relative curvature radius; depth: m; both positive. edge_slope: 1, psi above; -infinity: no edge is
  // near.
  HertzLine(const HalfPlaneSurface& driver, const HalfPlaneSurface& driven, double radius, double depth,
            double edge_slope = -std::numeric_limits<double>::infinity())
      : coefficient_(driver.coefficient() + driven.coefficient()) {
    constant_ = (driver.line(1.0, depth) + driven.line(1.0, depth)) / coefficient_ + std::log(4.0) + 1;
    inside_ = {0, 1 / (8 * radius), 0, 0};
    inside_constant_ = constant_ - 0.5 * std::log(coefficient_ / inside_.square);
    edge_ = {0.5 * edge_slope, 3 / (8 * radius), 0, 0};
    edge_from_ = std::numeric_limits<double>::infinity();
    if (!(edge_slope < 0)) {
      edge_from_ = 0;
    } else if (std::isfinite(edge_slope)) {
      const double distance = -edge_slope * radius;
      edge_from_ = 0.5 * distance * distance / (radius * coefficient_);
      edge_.offset = 0.5 * distance * distance / radius;
      edge_.energy = inside(edge_from_).energy - on(edge_, edge_from_).energy;
    }
    largest_force_ = force(std::exp(constant_ - 1 - kLeastSlope));
  }

  // force: N, any; one root, one logarithm. Zero force gives zero indentation within 1e-28 m and a finite slope,
  // although the slope of the law itself grows without bound.
  Point at(double force) const {
    const double f = std::clamp(force, kLeastForce, largest_force_), beyond = force - f;
    Point p = f <= edge_from_ ? inside(f) : on(edge_, f);
    p.energy += (p.indentation + 0.5 * p.slope * beyond) * beyond;
    p.indentation += p.slope * beyond;
    return p;
  }

  // m, of the contact; force: N, >= 0.
  double width(double force) const {
    return force > 0 ? (force <= edge_from_ ? inside_ : edge_).width(coefficient_ * force) : 0.0;
  }
  // N; width: m, >= 0. What `width` undoes.
  double force(double width) const {
    const double inside = inside_.force(width) / coefficient_;
    return inside < edge_from_ ? inside : std::max(edge_from_, edge_.force(width) / coefficient_);
  }
  // m, from the edge to the middle of the pressure where the contact ends at one: w^2 (psi + w / R) / (8 C F).
  double centroid(double force) const {
    const double cf = coefficient_ * force, w = edge_.width(cf);
    return w * w * (2 * edge_.linear + 8.0 / 3 * edge_.square * w) / (8 * cf);
  }
  // True where the contact ends at a tip edge.
  bool at_edge(double force) const { return force > edge_from_; }
  double largest_force() const { return largest_force_; }  // N
  double coefficient() const { return coefficient_; }      // m N-1: C; the slope changes by less than C / F

 private:
  struct Branch {  // C F = linear w + square w^2
    double linear, square;
    double offset, energy;  // m, N m: what makes the edge's law go on where Hertz's ends
    double force(double w) const { return (linear + square * w) * w; }  // m, times C
    double width(double cf) const { return 2 * cf / (linear + std::sqrt(linear * linear + 4 * square * cf)); }
  };
  // The same of inside_, where w is sqrt(C F / square).
  Point inside(double f) const {
    const double cf = coefficient_ * f, log_term = inside_constant_ - 0.5 * std::log(f);
    return {cf * (log_term - 0.5), coefficient_ * (log_term - 1), 0.5 * cf * f * (log_term - 0.25)};
  }
  Point on(const Branch& b, double f) const {
    const double cf = coefficient_ * f, w = b.width(cf), log_term = constant_ - std::log(w),
                 qw = b.square * w;
    return {cf * log_term - 0.5 * qw * w + b.offset, coefficient_ * (log_term - 1),
            0.5 * cf * f * log_term +
                (b.linear * (b.linear / 4 + qw / 6) - qw * qw / 8) * w * w / coefficient_ + b.offset * f +
                b.energy};
  }

  static constexpr double kLeastSlope = 0.125;  // in C
  static constexpr double kLeastForce = 1e-20;  // N
  double coefficient_, constant_;               // m N-1: C; 1: ln(4 depth) + 1 - k
  double inside_constant_;                      // 1: constant_ - ln(w) + ln(F) / 2 inside
  Branch inside_, edge_;
  double edge_from_, largest_force_;  // N
};

}  // namespace whine
