#include "studies/sweep_pressure.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact/half_plane_strip.h"
#include "gear/pair.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr int kPlaces = 64;  // in a mesh period

// A place that a pair passes, by its phase.
struct Place {
  double phase = 0;  // middle
  PairContact contact;
  double curvature = 0;     // m: relative radius
  int first = 0, last = 0;  // samples of a mesh period
  Index column = 0;         // pair
};

// N: largest over the mesh periods that are stored of the least load at the samples of a place.
double held_at(const Place& place, const MatrixRM& load, int steps) {
  double held = 0;
  for (Index period = 0; period * steps < load.rows(); ++period)
    held = std::max(
        held,
        load.col(place.column).segment(period * steps + place.first, place.last - place.first).minCoeff());
  return held;
}

// The places of the path of contact, and those beyond it at which a pair carries load.
std::vector<Place> places_of(const SweepArtifact& s, const GearPair& gears) {
  const int steps = s.time.steps_per_period, count = std::min(kPlaces, steps);
  const auto loaded = [&](const Place& place) {
    return std::any_of(s.tooth_load.begin(), s.tooth_load.end(),
                       [&](const MatrixRM& load) { return held_at(place, load, steps) > 0; });
  };
  std::vector<Place> out;
  for (Index k = 0; k < s.pair.size(); ++k)
    for (int i = 0; i < count; ++i) {
      Place place;
      place.first = i * steps / count;
      place.last = (i + 1) * steps / count;
      place.column = k;
      place.phase = s.pair[k] + (i + 0.5) / count;
      if (const double path = place.phase * gears.base_pitch();
          (path < gears.path_start() || path > gears.path_end()) && !loaded(place))
        continue;
      place.contact = gears.contact(place.phase);
      if (!place.contact.on_flank) continue;
      place.curvature = gears.relative_curvature_radius(place.contact);
      out.push_back(std::move(place));
    }
  std::sort(out.begin(), out.end(), [](const Place& a, const Place& b) { return a.phase < b.phase; });
  return out;
}

}  // namespace

void add_flank_pressure(const SweepArtifact& s, ResponseArtifact& r) {
  if (s.root_stress[0].size() == 0 && s.model != "finite elements") return;
  const GearPair gears(s);
  const std::vector<Place> places = places_of(s, gears);
  double compliance = 0;  // Pa-1: 2 / (pi E*)
  for (const BodyParameters& gear : s.gear)
    compliance += HalfPlaneSurface(in_contact_plane(gear.material, s.mesh.contact_plane), 1.0).coefficient();
  const double modulus = 2 / (std::numbers::pi * compliance), width = s.face_width();
  const Index speeds = s.mesh_frequency.size();
  const auto inside = static_cast<Index>(
      std::count_if(places.begin(), places.end(), [](const Place& p) { return !p.contact.corner; }));
  r.pair_phase.resize(inside);
  r.flank_roll.resize(inside, kSides);
  r.flank_pressure = MatrixRM::Zero(speeds, inside);
  for (Eigen::VectorXd& load : r.edge_load) load.setZero(speeds);
  Index column = 0;
  for (const Place& place : places) {
    if (!place.contact.corner) {
      r.pair_phase[column] = place.phase;
      for (int g = 0; g < kSides; ++g) r.flank_roll(column, g) = place.contact.roll[static_cast<size_t>(g)];
    }
    for (Index f = 0; f < speeds; ++f) {
      const double load = held_at(place, s.tooth_load[static_cast<size_t>(f)], s.time.steps_per_period);
      if (!(load > 0)) continue;
      int edge = place.contact.corner ? place.contact.tip_gear : -1;
      const double half = std::sqrt(4 * load * place.curvature / (std::numbers::pi * width * modulus));
      for (int g = 0; g < kSides && edge < 0; ++g)
        if (gears.tip_distance(place.contact, g) < half) edge = g;
      if (edge < 0)
        r.flank_pressure(f, column) =
            std::sqrt(load * modulus / (std::numbers::pi * width * place.curvature));
      else
        r.edge_load[static_cast<size_t>(edge)][f] = std::max(r.edge_load[static_cast<size_t>(edge)][f], load);
    }
    if (!place.contact.corner) ++column;
  }
}

}  // namespace whine
