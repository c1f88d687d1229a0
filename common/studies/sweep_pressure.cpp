#include "studies/sweep_pressure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "contact/half_plane_strip.h"
#include "gear/pair.h"
#include "signal/branches.h"

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
double sustained_at(const Place& place, const MatrixRM& load, int steps) {
  double sustained = 0;
  for (Index period = 0; period * steps < load.rows(); ++period)
    sustained = std::max(
        sustained,
        load.col(place.column).segment(period * steps + place.first, place.last - place.first).minCoeff());
  return sustained;
}

// Material and faces of the pair as Hertz's law has them, and where its contacts end.
struct Hertz {
  const GearPair& gears;
  double modulus;  // Pa: E*
  double width;    // m

  double pressure(double load, double curvature) const {
    return std::sqrt(load * modulus / (std::numbers::pi * width * curvature));
  }
  // Over whose edge a pair carries its load (N, above 0): 0 the driver's, 1 the driven gear's; -1: it touches inside its flanks.
  int edge(const PairContact& contact, double curvature, double load) const {
    if (contact.corner) return contact.tip_gear;
    const double half = std::sqrt(4 * load * curvature / (std::numbers::pi * width * modulus));
    for (int end = 0; end < kSides; ++end)
      if (gears.edge_distance(contact, end) < half) return gears.edge_gear(contact, end);
    return -1;
  }
};

Hertz hertz_of(const SweepResult& s, const GearPair& gears) {
  double compliance = 0;  // Pa-1: 2 / (pi E*)
  for (const BodyParameters& gear : s.gear)
    compliance += HalfPlaneSurface(in_contact_plane(gear.material, s.mesh.contact_plane), 1.0).coefficient();
  return {gears, 2 / (std::numbers::pi * compliance), s.face_width()};
}

// The places of the path of contact, and those beyond it at which a pair carries load.
std::vector<Place> places_of(const SweepResult& s, const GearPair& gears) {
  const int steps = s.time.steps_per_period, count = std::min(kPlaces, steps);
  const auto loaded = [&](const Place& place) {
    return std::any_of(s.tooth_load.begin(), s.tooth_load.end(),
                       [&](const MatrixRM& load) { return sustained_at(place, load, steps) > 0; });
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

// Pressure and load over either edge at every sample, each sustained for 1/64 of a mesh period, wherever that begins.
void add_sustained(const SweepResult& s, const Hertz& hertz, ResponseResult& r) {
  struct Touch {
    PairContact contact;
    double curvature = 0;  // m; 0: no pair carries load there, and some have no contact to be asked for
  };
  const int steps = s.time.steps_per_period;
  std::vector<Touch> touch;  // (pair, step)
  touch.reserve(static_cast<size_t>(s.pair.size()) * static_cast<size_t>(steps));
  for (Index pair = 0; pair < s.pair.size(); ++pair)
    for (int n = 0; n < steps; ++n) {
      Touch at;
      const bool loaded = std::any_of(s.tooth_load.begin(), s.tooth_load.end(), [&](const MatrixRM& load) {
        for (Index i = n; i < load.rows(); i += steps)
          if (load(i, pair) > 0) return true;
        return false;
      });
      if (loaded) at.contact = hertz.gears.contact(s.pair[pair] + static_cast<double>(n) / steps);
      if (loaded && at.contact.on_flank) at.curvature = hertz.gears.relative_curvature_radius(at.contact);
      touch.push_back(std::move(at));
    }
  const Index speeds = s.mesh_frequency.size();
  r.flank_pressure_sustained.resize(speeds);
  r.edge_load.resize(speeds, kSides);
  MatrixRM pressure;
  std::array<MatrixRM, kSides> over_edge;
  for (Index f = 0; f < speeds; ++f) {
    const MatrixRM& load = s.tooth_load[static_cast<size_t>(f)];
    pressure.setZero(load.rows(), load.cols());
    for (MatrixRM& edge : over_edge) edge.setZero(load.rows(), load.cols());
    for (Index pair = 0; pair < load.cols(); ++pair)
      for (Index n = 0; n < load.rows(); ++n) {
        const Touch& at = touch[static_cast<size_t>(pair * steps + n % steps)];
        if (!(load(n, pair) > 0 && at.curvature > 0)) continue;
        const int edge = hertz.edge(at.contact, at.curvature, load(n, pair));
        if (edge < 0)
          pressure(n, pair) = hertz.pressure(load(n, pair), at.curvature);
        else
          over_edge[static_cast<size_t>(edge)](n, pair) = load(n, pair);
      }
    r.flank_pressure_sustained[f] = sustained_load(pressure, steps);
    for (Index g = 0; g < kSides; ++g)
      r.edge_load(f, g) = sustained_load(over_edge[static_cast<size_t>(g)], steps);
  }
}

}  // namespace

void add_flank_pressure(const SweepResult& s, ResponseResult& r) {
  if (s.root_stress.empty() && !elastic(s)) return;
  const GearPair gears(s);
  const Hertz hertz = hertz_of(s, gears);
  const std::vector<Place> places = places_of(s, gears);
  const Index speeds = s.mesh_frequency.size(), count = static_cast<Index>(places.size());
  r.pair_phase.resize(count);
  r.flank_roll.resize(count, kSides);
  r.flank_pressure = MatrixRM::Zero(speeds, count);
  r.edge_load_there = MatrixRM::Zero(speeds, count);
  for (Index k = 0; k < count; ++k) {
    const Place& place = places[static_cast<size_t>(k)];
    r.pair_phase[k] = place.phase;
    for (int g = 0; g < kSides; ++g) r.flank_roll(k, g) = place.contact.roll[static_cast<size_t>(g)];
    for (Index f = 0; f < speeds; ++f) {
      const double load = sustained_at(place, s.tooth_load[static_cast<size_t>(f)], s.time.steps_per_period);
      if (!(load > 0)) continue;
      if (hertz.edge(place.contact, place.curvature, load) < 0)
        r.flank_pressure(f, k) = hertz.pressure(load, place.curvature);
      else
        r.edge_load_there(f, k) = load;
    }
  }
  add_sustained(s, hertz, r);
}

}  // namespace whine
