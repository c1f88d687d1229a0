#include "system/flank_pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "contact/half_plane_strip.h"
#include "gear/flank_kink.h"
#include "gear/pair.h"

namespace whine {

using Eigen::Index;

namespace {

// A contact reaches as far as its half width; strips and flanks that lean make that less than certain.
constexpr double kReach = 1.3;

struct Ridge {
  double roll, bend;
  std::string words;
};

std::array<std::vector<Ridge>, 2> ridges_of(const GearPair& gears, const GearMeshSpec& mesh) {
  std::array<std::vector<Ridge>, 2> out;
  for (int g = 0; g < kSides; ++g)
    for (const FlankRidge& ridge : flank_ridges(gears.gear(g), mesh.modification[g]))
      out[g].push_back({ridge.roll, ridge.bend, text("the ", ridge.cause, " of [gear.", mesh.gear[g], "]")});
  return out;
}

// The ridge within a contact of half width a; nullptr if none is.
const Ridge* ridge_within(const GearPair& gears, const PairContact& contact, double middle, double half_width,
                          const std::array<std::vector<Ridge>, 2>& ridges) {
  const Ridge* found = nullptr;
  for (int g = 0; g < kSides; ++g)
    for (const Ridge& ridge : ridges[g]) {
      // m: along the flank's arc, in the sense of the tangential coordinate
      const double x = (g == 0 ? 0.5 : -0.5) * gears.gear(g).base_radius() *
                       (ridge.roll * ridge.roll - contact.roll[g] * contact.roll[g]);
      if (std::abs(x - middle) < kReach * half_width && (!found || ridge.bend > found->bend)) found = &ridge;
    }
  return found;
}

}  // namespace

FlankPressure flank_pressure(const StaticResult& s) {
  const GearPair gears(s);
  const auto ridges = ridges_of(gears, s.mesh);
  const bool strips = s.fidelity.contact == ContactModel::strips,
             any = !ridges[0].empty() || !ridges[1].empty();
  const std::array flank{FlankDeviation(gears.gear(0), s.mesh.modification[0]),
                         FlankDeviation(gears.gear(1), s.mesh.modification[1])};
  const PairDeviation flanks{{&flank[0], &flank[1]}, {kEveryTooth, kEveryTooth}};
  FlankPressure out;
  const Ridge* worst = nullptr;
  for (Index i = 0; i < s.contact_pressure.rows(); ++i)
    for (Index j = 0; j < s.contact_pressure.cols(); ++j) {
      const double pressure = s.contact_pressure(i, j);
      if (!(pressure > 0)) continue;
      const Ridge* ridge = nullptr;
      if (any && strips) {
        const PairContact contact = gears.contact(s.mesh_phase[i] - std::floor(s.mesh_phase[i]) + s.pair[j]);
        ridge =
            ridge_within(gears, contact, gears.nearest(contact, flanks), s.contact_half_width(i, j), ridges);
      }
      if (!ridge) {
        out.smooth = std::max(out.smooth, pressure);
      } else if (pressure > out.on_ridge) {
        out.on_ridge = pressure;
        worst = ridge;
      }
    }
  if (worst) {
    out.ridge = worst->words;
    double compliance = 0;  // m N-1 times the face width: 2 / (pi E*)
    for (const Material& material : {s.gear[0].material, s.gear[1].material})
      compliance += HalfPlaneSurface(in_contact_plane(material, s.mesh.contact_plane), 1.0).coefficient();
    out.per_doubling = worst->bend * std::numbers::ln2 / (std::numbers::pi * std::numbers::pi * compliance);
  }
  return out;
}

std::vector<Remark> pressure_remarks(const StaticResult& s) {
  const FlankPressure& p = s.flank_pressure;
  if (!(p.on_ridge > p.smooth)) return {};
  return {remark(
      true, "contact pressure has no largest value where contact runs over the start of ", p.ridge,
      ": it is a ridge. ", s.contact.strips, " strips show ", std::round(p.on_ridge * 1e-6),
      " MPa there, and ", std::round(p.per_doubling * 1e-6),
      " MPa more with each doubling; a relief of parabolic shape has no ridge. Clear of it the largest is ",
      std::round(p.smooth * 1e-6), " MPa")};
}

LoadedPressure largest_pressure(const LoadedResult& a) {
  LoadedPressure out;
  for (Index j = 0; j < a.pair.size(); ++j) {
    Index first = -1, last = -1;
    double largest = 0;
    for (Index i = 0; i < a.strip_pair.size(); ++i) {
      if (a.strip_pair[i] != a.pair[j]) continue;
      if (first < 0) first = i;
      last = i;
      largest = std::max(largest, a.strip_pressure[i]);
    }
    if (first < 0) continue;
    // Candidate zones end where contact does not reach, but for tip edges.
    if (a.strip_force[first] > 0 || a.strip_force[last] > 0) {
      if (largest > out.at_edge) {
        out.at_edge = largest;
        out.edge_pair = a.pair[j];
        out.edge_force = a.tooth_load[j];
      }
    } else {
      out.inside = std::max(out.inside, largest);
    }
  }
  return out;
}

}  // namespace whine
