#include "gear/contact_lines.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace whine {

std::vector<ContactLine> contact_lines(const GearPair& pair, double phase) {
  constexpr double kNothing = 1e-9;  // of the face
  const double half = 0.5 * pair.face_width(), slope = std::tan(pair.base_helix_angle()),
               reach = half * std::abs(slope), pitch = pair.base_pitch();
  const int first = static_cast<int>(std::ceil((pair.path_start() - reach) / pitch - phase)),
            last = static_cast<int>(std::floor((pair.path_end() + reach) / pitch - phase));
  std::vector<ContactLine> lines;
  for (int j = first; j <= last; ++j) {
    const double middle = (phase + j) * pitch;
    ContactLine line{j, -half, half};
    if (slope != 0) {
      const double start = (pair.path_start() - middle) / slope, end = (pair.path_end() - middle) / slope;
      line.from = std::max(line.from, std::min(start, end));
      line.to = std::min(line.to, std::max(start, end));
    }
    if (line.length() > kNothing * half) lines.push_back(line);
  }
  return lines;
}

double contact_line_length(const GearPair& pair, double phase) {
  double sum = 0;
  for (const ContactLine& line : contact_lines(pair, phase)) sum += line.length();
  return sum / std::cos(pair.base_helix_angle());
}

double contact_line_harmonic(double contact_ratio, double overlap_ratio) {
  const auto sinc = [](double x) {
    return x > 0 ? std::sin(std::numbers::pi * x) / (std::numbers::pi * x) : 1;
  };
  return 2 * std::abs(sinc(contact_ratio) * sinc(overlap_ratio));
}

HelicalForces helical_forces(const GearPair& pair, double torque) {
  HelicalForces out;
  out.transverse = torque / pair.gear(0).base_radius();
  out.normal = out.transverse / std::cos(pair.base_helix_angle());
  out.axial = out.transverse * std::tan(pair.base_helix_angle());
  return out;
}

LeadDeviation::LeadDeviation(const LeadModification& modification, double face_width)
    : lead_(modification), width_(face_width) {
  if (lead_.end_relief > 0 && !(lead_.end_relief_length <= 0.5 * face_width))
    fail(Failure::input, "end_relief_length_mm = ", lead_.end_relief_length * 1e3,
         " is more than half of the face width, ", 0.5e3 * face_width, " mm; shorten it");
}

double LeadDeviation::at(double z) const {
  const double t = 2 * z / width_;
  double sum = lead_.crowning * t * t + 0.5 * lead_.slope * (1 + t);
  if (lead_.end_relief > 0)
    sum += lead_.end_relief * std::max(0.0, 1 - (0.5 * width_ - std::abs(z)) / lead_.end_relief_length);
  return sum;
}

}  // namespace whine
