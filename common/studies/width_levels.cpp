#include "studies/width_levels.h"

#include <algorithm>

#include "base/error.h"
#include "gear/face_width.h"
#include "signal/spectrum.h"
#include "solid/reduce.h"
#include "solid/width_tables.h"
#include "system/statics.h"

namespace whine {
namespace {

std::string level_of(const StaticResult& s) {
  if (s.fidelity.width == WidthModel::one) return "one slice";
  if (s.fidelity.width == WidthModel::slices) return "slices";
  return text("bodies in three dimensions, degree ", s.face.degree);
}

double peak_to_peak(const StaticResult& s) {
  return s.transmission_error.maxCoeff() - s.transmission_error.minCoeff();
}

double first_harmonic(const StaticResult& s) {
  return harmonics(s.transmission_error, 1).amplitude[0];
}

ReducedBody in_three_dimensions(const ReducedBody& body, int degree) {
  constexpr double kSection = 1 / 3.0;  // modules
  ReducedBody out = body;
  add_width({degree, kSection * body.design.module}, out);
  return out;
}

}  // namespace

WidthChange width_change(const StaticResult& result, const StaticResult& other) {
  WidthChange out;
  out.level = level_of(result);
  out.other = level_of(other);
  const auto relative = [&](double (*of)(const StaticResult&)) { return of(result) / of(other) - 1; };
  out.transmission_error = (result.transmission_error - other.transmission_error).cwiseAbs().maxCoeff() /
                           other.transmission_error.mean();
  out.peak_to_peak = relative(peak_to_peak);
  out.first_harmonic = relative(first_harmonic);
  out.mean_stiffness = result.mean_stiffness / other.mean_stiffness - 1;
  int i = 0;
  for (const StaticResult* s : {&result, &other}) {
    if (!s->face.none()) out.load_factor[i] = s->face.load_factor;
    ++i;
  }
  return out;
}

StaticResult next_width_level(const ReducedBody& driver, const ReducedBody& driven,
                              const StaticParameters& settings, const StaticResult& result) {
  StaticParameters next = settings;
  next.fidelity.width = WidthModel::body;
  const int degree =
      result.face.degree > 0 ? result.face.degree - 2 : degree_of_width(driver.design, driven.design);
  if (result.face.degree > 0) {
    const auto cut = [&](ReducedBody body) {
      body.width = cut_to_degree(body.width, std::min(degree, body.width.degree));
      return body;
    };
    return static_transmission(cut(driver), cut(driven), next, result.torque);
  }
  const ReducedBody wide = in_three_dimensions(driver, degree);
  return static_transmission(wide, in_three_dimensions(driven, degree), next, result.torque);
}

}  // namespace whine
