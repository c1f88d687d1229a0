// Work over one time step: quadrature of what decays within it, of dampers, and of Hertz's law whose force and shape change.
#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/hertz_line.h"
#include "dynamics/newmark.h"

namespace whine::step_work {

// Gauss-Legendre on (0, 1).
inline constexpr int kPoints = 6;
inline constexpr double kNode[kPoints] = {0.033765242898423975, 0.16939530676686776, 0.3806904069584015,
                                          0.6193095930415985,   0.8306046932331322,  0.966234757101576};
inline constexpr double kWeight[kPoints] = {0.08566224618958487, 0.18038078652406947, 0.23395696728634569,
                                            0.23395696728634569, 0.18038078652406947, 0.08566224618958487};

inline HertzLine::Point at(const HertzLine& law, double force) {
  return force > 0 ? law.at(force) : HertzLine::Point{};
}

inline double stored(const HertzLine& law, double force) {  // N m
  return force * at(law, force).indentation - at(law, force).energy;
}

// N m: what a law stores from one force to another, less the mean force times the change of indentation.
inline double bent(double from, const HertzLine::Point& at_from, double to, const HertzLine::Point& at_to) {
  return (to * at_to.indentation - at_to.energy) - (from * at_from.indentation - at_from.energy) -
         0.5 * (from + to) * (at_to.indentation - at_from.indentation);
}
inline double bent(const HertzLine& law, double from, double to) {
  return bent(from, at(law, from), to, at(law, to));
}

// N m, switching and rolling: what a line's law stores while the force and the law change, less the mean force's work.
inline std::pair<double, double> law_work(const HertzLine& law0, const HertzLine& law1, double p0,
                                          double p1) {
  const HertzLine::Point old0 = at(law0, p0), old1 = at(law0, p1), new0 = at(law1, p0), new1 = at(law1, p1);
  return {0.5 * (bent(p0, old0, p1, old1) + bent(p0, new0, p1, new1)),
          0.25 * (p1 - p0) * (new1.indentation - old1.indentation - (new0.indentation - old0.indentation)) -
              0.5 * (new0.energy - old0.energy + new1.energy - old1.energy)};
}

// Calls at(t, weight) over (0, step), in panels over which nothing with the given rate (s-1) changes much.
template <class Function>
void quadrature(double step, double rate, Function at) {
  const int panels = static_cast<int>(std::clamp(std::ceil(step * rate), 1.0, 1000.0));
  for (int i = 0; i < panels; ++i)
    for (int k = 0; k < kPoints; ++k) at(step * (i + kNode[k]) / panels, step * kWeight[k] / panels);
}

// The same for what decays at that rate and then changes slowly: panels that grow from it on.
template <class Function>
void graded_quadrature(double step, double rate, Function at) {
  constexpr double kGrowth = 1.5;
  double from = 0;
  for (double width = 1 / rate; from < step; width = (kGrowth - 1) * from) {
    const double to = from + 1.01 * width < step ? from + width : step;
    for (int k = 0; k < kPoints; ++k) at(from + (to - from) * kNode[k], (to - from) * kWeight[k]);
    from = to;
  }
}

// Integrals over a step that dampers need, of each coordinate z'' + c z' + w^2 z = force and of the relaxed loads.
struct DampingIntegrals {
  DampingIntegrals() = default;
  // frequency, damping: (coordinate) rad s-1, s-1; relaxation, step: s. The sums of the coordinates are filled up to `size` by 0.
  DampingIntegrals(const Eigen::VectorXd& frequency, const Eigen::VectorXd& damping, double relaxation,
                   double step, Eigen::Index size);
  Eigen::VectorXd speed, mixed, push;  // of a22^2, a22 s, s^2, v = a22 v0 + s (mean force - w^2 z0)
  // Of (a, b): load - relaxed = a (load0 - relaxed0) + b (load1 - load0); of a, b, t a, t b.
  double decay2 = 0, mixed2 = 0, growth2 = 0;
  double decay = 0, growth = 0, late_decay = 0, late_growth = 0;
};

// N m in a step, of loads g on what they move by a flexibility R that relaxes, eta G' + G = g: dissipation eta G' R G', and the exact work of
// g on R G. moved: R g, field: R G; 0 at the start, 1 at the end of the step. Without relaxation all of it moves at once.
struct RelaxedWork {
  template <class Vector>
  RelaxedWork(const DampingIntegrals& of, bool relaxes, const Vector& load0, const Vector& load1,
              const Vector& relaxed0, const Vector& moved0, const Vector& moved1, const Vector& field0) {
    const auto behind = load0 - relaxed0, change = load1 - load0, moved_behind = moved0 - field0,
               moved_change = moved1 - moved0;
    exact = 0.5 * (load0 + load1).dot(moved_change);
    if (!relaxes) return;
    const double change2 = change.dot(moved_change);
    damping = of.decay2 * behind.dot(moved_behind) + 2 * of.mixed2 * behind.dot(moved_change) +
              of.growth2 * change2;
    exact = of.decay * load0.dot(moved_behind) + of.growth * load0.dot(moved_change) +
            of.late_decay * change.dot(moved_behind) + of.late_growth * change2;
  }
  double damping = 0, exact = 0;
};

inline DampingIntegrals::DampingIntegrals(const Eigen::VectorXd& frequency, const Eigen::VectorXd& damping,
                                          double relaxation, double step, Eigen::Index size) {
  for (Eigen::VectorXd* x : {&speed, &mixed, &push}) x->setZero(size);
  for (Eigen::Index c = 0; c < frequency.size(); ++c) {
    if (c > 0 && frequency[c] == frequency[c - 1] && damping[c] == damping[c - 1]) {
      for (Eigen::VectorXd* x : {&speed, &mixed, &push}) (*x)[c] = (*x)[c - 1];
      continue;
    }
    const auto add = [&](double t, double weight) {
      const Propagator part = exact_propagator(frequency[c], damping[c], t);
      speed[c] += weight * part.a22 * part.a22;
      mixed[c] += weight * part.a22 * part.bv;
      push[c] += weight * part.bv * part.bv;
    };
    // Every mode of a mesh: most of them are overdamped a thousandfold.
    if (damping[c] > 4 * frequency[c])
      graded_quadrature(step, frequency[c] + damping[c], add);
    else
      quadrature(step, frequency[c] + damping[c], add);
  }
  if (!(relaxation > 0)) return;
  quadrature(step, 1 / relaxation, [&](double t, double weight) {
    const double behind = std::exp(-t / relaxation),
                 risen = -(relaxation / step) * std::expm1(-t / relaxation);
    decay2 += weight * behind * behind / relaxation;
    mixed2 += weight * behind * risen / relaxation;
    growth2 += weight * risen * risen / relaxation;
    decay += weight * behind / relaxation;
    growth += weight * risen / relaxation;
    late_decay += weight * t / step * behind / relaxation;
    late_growth += weight * t / step * risen / relaxation;
  });
}

}  // namespace whine::step_work
