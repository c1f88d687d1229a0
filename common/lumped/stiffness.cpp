#include "lumped/stiffness.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "base/error.h"
#include "contact/half_plane_strip.h"
#include "gear/pair.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

constexpr double kFarthestDeflection =
    6;  // gaps up to this many times the largest static transmission error have a spring

double wrapped(double phase) {
  return phase - std::floor(phase);
}

// Ends of `cells` equal cells, the first about phase 0 and therefore in two halves.
Eigen::VectorXd centred_cells(int cells) {
  if (cells < 1) fail(Failure::input, "lumped model: ", cells, " cells; 1 is the least");
  Eigen::VectorXd end(cells + 1);
  for (int j = 0; j < cells; ++j) end[j] = (j + 0.5) / cells;
  end[cells] = 1;
  return end;
}

// Integral from phase 0 to p, 0 <= p <= 1, of the curve that is linear between values at i / n.
double integral(const Eigen::VectorXd& values, double p) {
  const Eigen::Index n = values.size();
  const double place = p * static_cast<double>(n);
  const Eigen::Index whole = std::min(n, static_cast<Eigen::Index>(place));
  double sum = 0;
  for (Eigen::Index i = 0; i < whole; ++i) sum += 0.5 * (values[i] + values[(i + 1) % n]);
  const double rest = place - static_cast<double>(whole);
  if (rest > 0) sum += rest * values[whole] + 0.5 * rest * rest * (values[(whole + 1) % n] - values[whole]);
  return sum / static_cast<double>(n);
}

}  // namespace

RectangularWave stated_wave(const StaticResult& s, double fewer, double more, double duty) {
  const GearPair pair(s);
  const double force = s.torque / pair.gear(0).base_radius(), module = s.gear[0].design.module;
  for (double level : {fewer, more})
    if (!(level > force / module) || !std::isfinite(level))
      fail(Failure::input, "lumped model: a stiffness level is ", level, " N/m; it must be above ",
           force / module, " N/m, at which the static load of ", force,
           " N bends teeth by a whole module of ", 1e3 * module, " mm");
  if (more < fewer)
    fail(Failure::input, "lumped model: the second stiffness level is ", more,
         " N/m; it is that of more pairs and must not be below the first, ", fewer,
         " N/m; swap them, and take one minus the duty");
  if (!(duty > 0 && duty < 1))
    fail(Failure::input, "lumped model: the duty, the share of the second level, is ", duty,
         "; it must be above 0 and below 1");
  const RectangularWave& place = s.rectangular_wave;
  RectangularWave wave;
  wave.low = fewer;
  wave.high = more;
  const double middle = 0.5 * (place.high_begin + place.high_end);
  wave.high_begin = wrapped(middle - 0.5 * duty);
  wave.high_end = wave.high_begin + duty;
  return wave;
}

LumpedParameters cells_of(const RectangularWave& wave) {
  std::vector<double> ends{wrapped(wave.high_begin), wrapped(wave.high_end), 1};
  std::sort(ends.begin(), ends.end());
  std::erase(ends, 0.0);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  LumpedParameters p;
  p.cell_end = Eigen::Map<Eigen::VectorXd>(ends.data(), static_cast<Eigen::Index>(ends.size()));
  p.stiffness.resize(p.cell_end.size(), 1);
  p.gap = MatrixRM::Zero(p.cell_end.size(), 1);
  for (Eigen::Index c = 0; c < p.cell_end.size(); ++c)
    p.stiffness(c, 0) = wave.at(0.5 * ((c > 0 ? p.cell_end[c - 1] : 0) + p.cell_end[c]));
  return p;
}

LumpedParameters cells_of(const Eigen::VectorXd& values, int cells, const Eigen::VectorXd& unloaded) {
  if (values.size() < 2 || !values.allFinite() || !(values.minCoeff() > 0))
    fail(Failure::input,
         "lumped model: the stiffness must be given at 2 phases at least and be above 0; its least is ",
         values.size() > 0 ? values.minCoeff() : 0, " N/m");
  LumpedParameters p;
  p.cell_end = centred_cells(cells);
  p.stiffness.resize(cells + 1, 1);
  p.gap = MatrixRM::Zero(cells + 1, 1);
  const auto fill = [&](const Eigen::VectorXd& curve, MatrixRM& means) {
    const double whole = integral(curve, 1);
    for (int j = 1; j < cells; ++j)
      means(j, 0) = (integral(curve, p.cell_end[j]) - integral(curve, p.cell_end[j - 1])) * cells;
    means(0, 0) = means(cells, 0) =
        (integral(curve, p.cell_end[0]) + whole - integral(curve, p.cell_end[cells - 1])) * cells;
  };
  fill(values, p.stiffness);
  if (unloaded.size() > 0) fill(unloaded, p.gap);
  return p;
}

double hertz_deflection(double load, double static_load, double stiffness, double coefficient) {
  return load > 0 ? load * (1 / stiffness + 0.5 * coefficient * std::log(static_load / load)) : 0;
}

namespace {

// Gap of a pair of flanks at a phase of its own, unloaded.
class PairGap {
 public:
  PairGap(const StaticResult& s, const GearPair& pair)
      : s_(s),
        pair_(pair),
        deviation_{{pair.gear(0), s.mesh.modification[0]}, {pair.gear(1), s.mesh.modification[1]}},
        flanks_{{&deviation_[0], &deviation_[1]}, {}},
        farthest_(kFarthestDeflection * s.transmission_error.maxCoeff()) {}
  PairGap(const PairGap&) = delete;
  PairGap& operator=(const PairGap&) = delete;

  // m; nothing where this pair cannot touch.
  std::optional<double> operator()(double own_phase) const {
    if (!pair_.in_reach(own_phase)) return std::nullopt;
    const PairContact c = pair_.contact(own_phase);
    const double gap =
        flanks_.none() || !c.on_flank ? c.gap : pair_.gap_at(c, pair_.nearest(c, flanks_), flanks_);
    if (c.corner && (!s_.mesh.corner.enabled || c.normal_angle > s_.mesh.corner.largest_angle ||
                     !c.on_flank || gap > farthest_))
      return std::nullopt;
    return gap;
  }

 private:
  const StaticResult& s_;
  const GearPair& pair_;
  FlankDeviation deviation_[2];
  PairDeviation flanks_;
  double farthest_;
};

// Load (N) and stiffness (N m-1) of a pair at a phase of its own.
struct PairPoint {
  double phase, load, stiffness;
};

// At static positions where a pair carries load, by phase. force: N, torque over base radius.
std::vector<PairPoint> loaded_points(const StaticResult& s, const PairGap& gap_of, double force) {
  std::vector<PairPoint> points;
  for (Eigen::Index i = 0; i < s.mesh_phase.size(); ++i) {
    const double total = s.tooth_load.row(i).sum();
    for (Eigen::Index n = 0; n < s.pair.size(); ++n) {
      const double phase = s.mesh_phase[i] + s.pair[n], load = s.tooth_load(i, n);
      if (!(load > 0)) continue;
      const auto gap = gap_of(phase);
      const double deflection = s.transmission_error[i] - gap.value_or(0);
      if (!gap || !(deflection > 0))
        fail(Failure::input, "lumped model: pair ", s.pair[n], " carries ", load, " N at phase ",
             s.mesh_phase[i], " although its gap is not closed there");
      // The lever arms of a corner differ from the base radius: loads as the torque feels them.
      points.push_back({phase, load * (force / total), load * (force / total) / deflection});
    }
  }
  if (points.empty()) fail(Failure::input, "lumped model: no tooth pair carries load in the static result");
  std::sort(points.begin(), points.end(),
            [](const PairPoint& a, const PairPoint& b) { return a.phase < b.phase; });
  return points;
}

// Linear between the points, and as at their ends beyond them.
PairPoint point_at(const std::vector<PairPoint>& points, double phase) {
  const auto after = std::lower_bound(points.begin(), points.end(), phase,
                                      [](const PairPoint& p, double here) { return p.phase < here; });
  if (after == points.end()) return points.back();
  if (after == points.begin() || after->phase == phase) return *after;
  const auto before = after - 1;
  const double share = (phase - before->phase) / (after->phase - before->phase);
  return PairPoint{phase, (1 - share) * before->load + share * after->load,
                   (1 - share) * before->stiffness + share * after->stiffness};
}

// What a pair's force is made of: springs of its own that come in one after the other, in place `first` of a row. One spring
// for 0 chords, else a polygon of Hertz's law through the point.
void add_pair(const PairPoint& p, double gap, int chords, double coefficient, double force, Eigen::Index row,
              Eigen::Index first, LumpedParameters& to) {
  const int up_to_static = chords / 2, beyond = chords - up_to_static;
  to.gap(row, first) = gap;
  to.stiffness(row, first) = p.stiffness;
  double before = 0, reached = 0, slope = 0;
  for (int i = 0; i < chords; ++i) {
    const int below =
        up_to_static - 1 - i;  // halvings from the static load; from it on equal ratios to the last load
    const double load = below >= 0 ? std::ldexp(p.load, -below)
                                   : p.load * std::pow(4 * force / p.load, -below / double(beyond));
    const double deflection = hertz_deflection(load, p.load, p.stiffness, coefficient);
    const double chord = (load - before) / (deflection - reached);
    if (!(chord > slope))
      fail(Failure::input, "lumped model: Hertz's law does not stiffen between ", before, " and ", load,
           " N; the static result is of no contact of these flanks");
    to.gap(row, first + i) = gap + reached;
    to.stiffness(row, first + i) = chord - slope;
    before = load;
    reached = deflection;
    slope = chord;
  }
}

}  // namespace

LumpedParameters cells_of_pairs(const StaticResult& s, int cells, Eigen::VectorXi& numbers, int chords) {
  if (chords < 0 || chords == 1)
    fail(Failure::input, "lumped model: ", chords,
         " chords of Hertz's law; 2 are the least, 0 make linear springs");
  const GearPair pair(s);
  const double force = s.torque / pair.gear(0).base_radius();
  const PairGap gap_at(s, pair);
  const std::vector<PairPoint> points = loaded_points(s, gap_at, force);
  double coefficient = 0;
  for (const BodyParameters& gear : s.gear)
    coefficient +=
        HalfPlaneSurface(in_contact_plane(gear.material, s.mesh.contact_plane), s.face_width()).coefficient();
  const int springs = std::max(1, chords);

  // Pair n at mesh phase f in [0, 1] has the phase f + n of its own.
  int reach = 1;
  for (double phase = -4; phase <= 4; phase += 1.0 / 256)
    if (gap_at(phase)) reach = std::max(reach, static_cast<int>(std::floor(std::max(phase, 1 - phase))));
  const int pairs = 2 * reach + 1;
  numbers.resize(pairs * springs);
  LumpedParameters p;
  p.cell_end = centred_cells(cells);
  p.stiffness = p.gap = MatrixRM::Zero(cells + 1, numbers.size());
  for (int n = 0; n < pairs; ++n) {
    numbers.segment(n * springs, springs).setConstant(n - reach);
    for (int j = 0; j <= cells; ++j) {
      const double phase = static_cast<double>(j) / cells + n - reach;
      const auto gap = gap_at(phase);
      if (!gap) continue;
      // A pair that the others hold apart at rest, by what they bend of its gears, does not touch at rest.
      const bool loaded = phase >= points.front().phase && phase <= points.back().phase;
      add_pair(point_at(points, phase),
               loaded ? *gap : std::max(*gap, at_phase(s.mesh_phase, s.transmission_error, phase)), chords,
               coefficient, force, j, n * springs, p);
    }
  }
  return p;
}

}  // namespace whine
