#include "dynamics/newmark.h"

#include <algorithm>
#include <cmath>

namespace whine {

namespace {
// Displacement after time h from rest under a unit force, by its power series: the closed form cancels for
// small w h.
double unit_response(double w, double c, double h) {
  double before = 0, term = 0.5, power = h * h, sum = 0.5 * h * h, last = sum;  // term: coefficient of h^k
  for (int k = 1; k < 60; ++k) {
    const double next = -(c * (k + 1) * term + w * w * before) / ((k + 2.0) * (k + 1.0));
    before = term;
    term = next;
    power *= h;
    sum += term * power;
    if (std::max(std::abs(term * power), std::abs(last)) < 1e-18 * std::abs(sum))
      break;  // every other term may be 0
    last = term * power;
  }
  return sum;
}
}  // namespace

Propagator exact_propagator(double w, double c, double h) {
  const double s = 0.5 * c, discriminant = w * w - s * s;
  double cosine, sine;   // e^-sh cos rh, e^-sh sin(rh) / r
  double response = -1;  // displacement after h under a unit force; below 0: from the others
  if (std::abs(discriminant) * h * h < 1e-12) {
    cosine = std::exp(-s * h);
    sine = h * cosine;
  } else if (discriminant > 0) {
    const double r = std::sqrt(discriminant);
    cosine = std::exp(-s * h) * std::cos(r * h);
    sine = std::exp(-s * h) * std::sin(r * h) / r;
  } else {
    const double r = std::sqrt(-discriminant), fast = s + r,
                 slow = w * w / fast;  // slow = s - r without cancellation
    cosine = 0.5 * (std::exp(-slow * h) + std::exp(-fast * h));
    sine = (std::exp(-slow * h) - std::exp(-fast * h)) / (2 * r);
    // (1 - a11) / w^2 would cancel where w h is small however large c h is.
    if (slow > 0) response = (std::expm1(-fast * h) / fast - std::expm1(-slow * h) / slow) / (2 * r);
  }
  Propagator p;
  p.a11 = cosine + s * sine;
  p.a12 = sine;
  p.a21 = -w * w * sine;
  p.a22 = cosine - s * sine;
  if (w * h < 0.1 && c * h < 0.5)
    p.bq = unit_response(w, c, h);
  else if (response >= 0)
    p.bq = response;
  else
    p.bq = w > 0 ? (1 - p.a11) / (w * w) : (h - sine) / c;
  p.bv = sine;
  return p;
}

Propagator newmark_propagator(double w, double c, double h) {
  // From q+ = q + h (v + v+)/2 and v+ = v + h (a + a+)/2 with a = g - c v - w^2 q at both ends.
  const double denominator = 1 + 0.5 * h * c + 0.25 * h * h * w * w;
  Propagator p;
  p.a11 = 1 - 0.5 * h * h * w * w / denominator;
  p.a12 = h / denominator;
  p.a21 = -h * w * w / denominator;
  p.a22 = 2 / denominator - 1;
  p.bq = 0.5 * h * h / denominator;
  p.bv = h / denominator;
  return p;
}

Relaxation relaxation_step(double relaxation, double h) {
  if (relaxation <= 0) return {0, 0, 1};
  const double decay = std::exp(-h / relaxation), share = -std::expm1(-h / relaxation) * relaxation / h;
  // 1 - share cancels for h << eta; its series there.
  const double x = h / relaxation;
  const double rest = x < 1e-3 ? x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5))) : 1 - share;
  return {decay, share - decay, rest};
}

}  // namespace whine
