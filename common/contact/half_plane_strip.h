// Surface of an elastic half-plane under a strip of constant pressure: the line load's logarithm, averaged.
#pragma once
#include <cmath>
#include <string>

#include "contact/half_plane.h"
#include "gear/hertz.h"

namespace whine {

class HalfPlaneSurface {
 public:
  // face_width: m; forces are total forces over it.
  HalfPlaneSurface(const Material& material, double face_width)
      : moduli_(plane_strain_equivalent(material)), face_width_(face_width) {}

  // The same material of another width (m).
  HalfPlaneSurface of_width(double face_width) const {
    HalfPlaneSurface out = *this;
    out.face_width_ = face_width;
    return out;
  }

  // m N-1: C = 2 (1 - nu^2) / (pi E b), the factor of ln(depth / |x|).
  double coefficient() const {
    const double nu = moduli_.poisson_ratio;
    return 2 * (1 - nu * nu) / (std::acos(-1.0) * moduli_.youngs_modulus * face_width_);
  }

  // m N-1: inward displacement at distance x (m, not 0) from a line load of unit force, relative to `depth` (m)
  // under it: C (ln(depth / |x|) - 1 / (2 (1 - nu))).
  double line(double x, double depth) const {
    return flat_surface_displacement(x, moduli_, face_width_, depth);
  }

  // m N-1: inward displacement relative to `depth` (m) under a line load, of a unit force spread evenly over a strip of
  // half width `half_width` (m), averaged over another strip whose middle lies at distance x (m, any) and whose half
  // width is `reading` (m). Symmetric in the two strips.
  double mean_over_strip(double x, double half_width, double reading, double depth) const {
    // Twice integrated: t^2 / 2 ln|t| - 3 t^2 / 4.
    const auto primitive = [](double t) {
      return t == 0 ? 0.0 : t * t * (0.5 * std::log(std::abs(t)) - 0.75);
    };
    const double mean_log = (primitive(x + half_width + reading) - primitive(x + half_width - reading) -
                             primitive(x - half_width + reading) + primitive(x - half_width - reading)) /
                            (4 * half_width * reading);
    return flat_surface_displacement(1.0, moduli_, face_width_, depth) - coefficient() * mean_log;
  }

 private:
  PlaneModuli moduli_;
  double face_width_;
};

}  // namespace whine
