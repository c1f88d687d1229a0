// Work over one time step: quadrature of what decays within it, and of Hertz's law whose force and shape change.
#pragma once
#include <algorithm>
#include <cmath>
#include <utility>

#include "contact/hertz_line.h"

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

}  // namespace whine::step_work
