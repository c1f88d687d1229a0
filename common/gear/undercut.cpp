#include "gear/undercut.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/format.h"

namespace whine {

double undercut_clearance(const GearPair& pair, int g) {
  const int other = 1 - g;
  const ToothGeometry &tooth = pair.gear(g), &mate = pair.gear(other);
  const double edge = tooth.flank_point(tooth.form_roll_angle()).norm();
  // The driven gear of an internal pair works with its trailing flanks, the mirror images of the leading ones.
  const auto mirrored = [&](int side, const Vec2& p) {
    return pair.internal() && side == 1 ? Vec2(-p.x(), p.y()) : p;
  };
  const Vec2 tip = mirrored(other, mate.flank_point(mate.tip_roll_angle()));
  // A tip passes the root of the driver before the pair comes into contact, that of the driven gear after it has left.
  const double from = (g == 0 ? pair.path_start() : pair.path_end()) / pair.base_pitch(),
               away = g == 0 ? -1 : 1;
  constexpr int kPositions = 1200;
  constexpr double kReach = 1.5;  // mesh periods
  double least = std::numeric_limits<double>::infinity();
  const Placement own_0 = placed(pair, g, 0), own_1 = placed(pair, g, 1), other_0 = placed(pair, other, 0),
                  other_1 = placed(pair, other, 1);
  for (int i = 0; i <= kPositions; ++i) {
    const double phase = from + away * kReach * i / kPositions;
    Placement own = own_0, at = other_0;  // angles go with the phase
    own.angle += phase * (own_1.angle - own_0.angle);
    at.angle += phase * (other_1.angle - other_0.angle);
    const Vec2 p = mirrored(g, Eigen::Rotation2Dd(-own.angle) * (at(tip) - own.centre));
    const double r = p.norm();
    if (r > edge || r < tooth.root_radius()) continue;
    least = std::min(least, r * (std::atan2(-p.x(), p.y()) - tooth.half_span(r)));
  }
  return least;
}

std::string undercut_words(const GearDesign& design, const std::string& name) {
  const ToothGeometry tooth(design);
  if (!(tooth.undercut() > 0)) return "";
  const std::string start = millimetres(2 * tooth.flank_point(tooth.form_roll_angle()).norm()),
                    base = millimetres(2 * tooth.base_radius());
  return text(
      "[gear.", name, "] is undercut: the rack reaches ", millimetres(tooth.undercut()), " (",
      shown_number(tooth.undercut() / design.module),
      " modules) beyond the base circle's tangent point. The involute begins at a diameter of ", start,
      start == base ? ", the base circle's" : text(" (base circle: ", base, ")"),
      ", and below it the tooth is ", millimetres(tooth.neck()), " wide at its neck; with profile_shift = ",
      shown_number(std::ceil(1e4 * shift_without_undercut(design)) * 1e-4), " or more there is no undercut");
}

std::string shortened_path_words(const GearPair& pair, const std::array<std::string, 2>& name) {
  std::string out;
  for (int g = 0; g < kSides; ++g)
    if (const double lost = pair.path_lost(g); lost > 0)
      out += text(out.empty() ? "" : "; ", "the undercut of [gear.", name[static_cast<size_t>(g)],
                  "] shortens the path of contact by ", millimetres(lost), " and the contact ratio by ",
                  shown_number(lost / pair.base_pitch()));
  return out.empty() ? out
                     : text(out, "; the contact ratio is ", shown_number(pair.contact_ratio()),
                            ". Raise profile_shift there, or lower the addendum of the other gear");
}

}  // namespace whine
