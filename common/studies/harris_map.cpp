#include "studies/harris_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/error.h"
#include "contact/load_path.h"
#include "model/capabilities.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/rolling_mesh.h"
#include "system/statics.h"
#include "system/system_statics.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kDepth = 1e-3;  // m: statics do not depend on it
constexpr int kMappedHarmonics = 3;
// Ranges of torque and of relief that share their strips: strips that suit the least load of a range are many under the
// largest, and wide reliefs want wide candidate zones.
constexpr double kTorqueRange = 3, kReliefRange = 2;
constexpr int kReliefRanges = 4;

FlankModification with_tip(FlankModification m, double amount, double length, ReliefShape shape) {
  m.tip = {};
  m.tip.amount = amount;
  m.tip.length = length;
  m.tip.shape = shape;
  return m;
}

GearMeshSpec relieved_mesh(const HarrisMapResult& map, double relief, double length) {
  GearMeshSpec mesh = map.mesh;
  for (int g = 0; g < kSides; ++g)
    if (relieves(map.relieved, g))
      mesh.modification[g] = with_tip(mesh.modification[g], relief, length, map.shape);
  return mesh;
}

// The contact at one mesh position for a range of torques and reliefs.
struct Position {
  double phase = 0;
  MatrixXd compliance;  // (strip, strip) m N-1
  VectorXd gap, unit,
      approach;  // (strip) m without the relief, 1: what the relief adds to it, over the relief; 1
  std::vector<int> zone_end;  // strips at the ends of candidate zones that are no tip edges
  struct TipEdge {
    double gap, unit;  // m, 1
  };
  std::vector<TipEdge> left_out;  // too far to touch, or with no flank to touch
};

class Range {
 public:
  // load: N, ascending, of this range.
  Range(const GearMeshModel& model, const std::array<FlankDeviation, 2>& relief, double largest_relief,
        const std::array<std::vector<MatrixXd>, 2>& tables, VectorXd load, const HarrisPlan& plan)
      : model_(model),
        relief_(relief),
        tables_(tables),
        load_(std::move(load)),
        largest_(largest_relief),
        plan_(plan) {
    build();
  }

  // (position, load) m: transmission error under a relief (m, the largest of the range at most).
  MatrixXd error(double relief) {
    for (int attempt = 0;; ++attempt) {
      MatrixXd x(positions_.size(), load_.size());
      const std::string beyond = solve(relief, x);
      if (beyond.empty()) return x;
      constexpr int kWidenings = 6;
      if (attempt == kWidenings)
        fail(Failure::numerical, "at ", load_[load_.size() - 1], " N contact leaves the flanks: ", beyond,
             "; lower the torque");
      widening_ *= 1.6;
      build();
    }
  }

 private:
  void build() {
    const double largest = load_[load_.size() - 1];
    const double scale = largest_ / kUnit;
    // The steepest of all together sets the candidate zone: of the modifications that stay, and of the largest relief.
    PairDeviation flanks = model_.flanks();
    CandidateZone range =
        candidate_zone(model_.kinematics, model_.gear[0].half_plane(), model_.gear[1].half_plane(),
                       plan_.strips, load_[0] / model_.kinematics.contact_ratio(), 1.1 * largest * widening_,
                       reach_of_edges(model_, largest) * widening_, flanks);
    const double radius = model_.kinematics.relative_curvature_radius(0);
    double slope = 0, spread = 0;
    for (const FlankDeviation& r : relief_) {
      slope += scale * r.steepest();
      spread += scale * r.largest();
    }
    const double wider = range.half_zone + std::min(radius * slope, std::sqrt(2 * radius * spread));
    constexpr int kMostStrips = 32;
    range.strips =
        std::min(kMostStrips, 4 * static_cast<int>(std::ceil(range.strips * wider / range.half_zone / 4)));
    range.half_zone = wider;
    range.follows = false;

    positions_.clear();
    const PairDeviation unit{{&relief_[0], &relief_[1]}, {}};
    for (int i = 0; i < plan_.positions; ++i) {
      Position p;
      p.phase = static_cast<double>(i) / plan_.positions;
      const MeshPosition position = make_position(model_, p.phase, range);
      p.compliance = contact_compliance(model_, position, tables_, kDepth);
      p.gap = position.gap;
      p.unit.resize(position.strips());
      p.approach = position.strip_lever[0] / model_.kinematics.gear(0).base_radius();
      for (size_t j = 0; j < position.pairs.size(); ++j) {
        const PairStrips& s = position.pairs[j];
        p.unit.segment(position.first_strip[j], s.size()) =
            mean_deviation(model_.kinematics, s, unit) / kUnit;
        if (!s.low_is_edge) p.zone_end.push_back(position.first_strip[j]);
        if (!s.high_is_edge) p.zone_end.push_back(position.first_strip[j + 1] - 1);
      }
      // Edges that are left out move away with the relief of their own tip.
      p.left_out.push_back({position.lost_corner_gap, 0});
      constexpr double kFarther = 4;
      const PairsInReach around = pairs_in_reach(model_, p.phase, kFarther * range.corner_gap);
      for (int j = 0; j < around.size(); ++j) {
        const bool inside = std::any_of(position.pairs.begin(), position.pairs.end(),
                                        [&](const PairStrips& s) { return s.pair == around.pair[j]; });
        if (!inside)
          p.left_out.push_back({around.contact[j].gap + model_.flanks().at(around.contact[j].roll),
                                0.9 * unit.at(around.contact[j].roll) / kUnit});
      }
      p.left_out.push_back({around.next_corner_gap, 0});
      positions_.push_back(std::move(p));
    }
  }

  // Where and how contact wants more than the candidate zones hold, if it does.
  std::string solve(double relief, MatrixXd& x) {
    VectorXd row(load_.size());
    for (size_t i = 0; i < positions_.size(); ++i) {
      const Position& p = positions_[i];
      path_.follow(p.compliance, p.gap + relief * p.unit, p.approach, load_, row);
      for (const int strip : p.zone_end)
        if (path_.force()[strip] > 0)
          return text("at mesh phase ", p.phase, " the pressure reaches a candidate zone's end");
      const double deepest = row[row.size() - 1];
      for (const Position::TipEdge& edge : p.left_out)
        if (deepest > edge.gap + relief * edge.unit)
          return text("at mesh phase ", p.phase, " the deflection ", deepest * 1e6,
                      " micrometres closes a tip edge's gap of ", (edge.gap + relief * edge.unit) * 1e6,
                      " micrometres");
      x.row(i) = row.transpose();
    }
    return "";
  }

 public:
  static constexpr double kUnit = 1e-6;  // m: of the reliefs that `relief_` holds

 private:
  const GearMeshModel& model_;
  const std::array<FlankDeviation, 2>& relief_;  // of kUnit at the tip
  const std::array<std::vector<MatrixXd>, 2>& tables_;
  VectorXd load_;
  double largest_;
  const HarrisPlan& plan_;
  double widening_ = 1;
  std::vector<Position> positions_;
  LoadPath path_;
};

double peak_to_peak(const Eigen::Ref<const VectorXd>& error) {
  return error.maxCoeff() - error.minCoeff();
}

void require_plan(const HarrisPlan& plan) {
  for (const auto& [what, unit, values, least] :
       {std::tuple{"torque", " N m", &plan.torque, 0.0}, std::tuple{"relief", " m", &plan.relief, -1.0},
        std::tuple{"length", " m", &plan.length, 0.0}}) {
    if (values->empty()) fail(Failure::input, "Harris map: no ", what, "; give one at least");
    for (size_t i = 0; i < values->size(); ++i) {
      const double value = (*values)[i];
      if (!std::isfinite(value) || !(value > least) || value < 0)
        fail(Failure::input, "Harris map: ", what, " ", value, unit, " must be ",
             least < 0 ? "at least" : "above", " 0");
      if (i > 0 && !(value > (*values)[i - 1]))
        fail(Failure::input, "Harris map: ", what, " ", value, unit, " after ", (*values)[i - 1],
             "; they must ascend");
    }
  }
  if (plan.positions < 8) fail(Failure::input, "Harris map: ", plan.positions, " positions; 8 are the least");
  if (!(plan.design_torque >= plan.torque.front() && plan.design_torque <= plan.torque.back()))
    fail(Failure::input, "Harris map: the design torque ", plan.design_torque, " N m lies outside the map's ",
         plan.torque.front(), " to ", plan.torque.back(), " N m");
}

}  // namespace

double single_pair_relief_length(const ReducedBody& driver, const ReducedBody& driven,
                                 const GearMeshSpec& mesh) {
  const GearPair pair(driver.design, driven.design, mesh.centre_distance);
  return (pair.contact_ratio() - 1) * pair.base_pitch();
}

namespace {

// The place between low and high where f is least, to within `close`, and its value there: golden section.
std::pair<double, double> least_between(double low, double high, double close,
                                        const std::function<double(double)>& f) {
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double a = high - golden * (high - low), b = low + golden * (high - low), at_a = f(a), at_b = f(b);
  while (high - low > close) {
    if (at_a <= at_b) {
      high = b;
      b = a;
      at_b = at_a;
      at_a = f(a = high - golden * (high - low));
    } else {
      low = a;
      a = b;
      at_a = at_b;
      at_b = f(b = low + golden * (high - low));
    }
  }
  return {at_a <= at_b ? a : b, std::min(at_a, at_b)};
}

// The axes of a map, its values all 0.
HarrisMapResult blank_map(const ReducedBody& driver, const ReducedBody& driven,
                          const StaticParameters& statics, const HarrisPlan& plan) {
  const auto as_vector = [](const std::vector<double>& v) {
    return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Eigen::Index>(v.size())));
  };
  HarrisMapResult map;
  set_pair(map, {driver, driven}, statics);
  for (FlankModification& m : map.mesh.modification) m.tip = {};
  map.fidelity = {.contact = ContactModel::strips};
  map.contact.strips = plan.strips;
  map.contact.positions = plan.positions;
  map.relieved = plan.relieved;
  map.shape = plan.shape;
  map.torque = as_vector(plan.torque);
  map.relief = as_vector(plan.relief);
  map.length = as_vector(plan.length);
  map.design_torque = plan.design_torque;
  const Eigen::Index torques = map.torque.size(), starts = map.length.size();
  map.optimum_relief = map.optimum_peak_to_peak = VectorXd::Zero(starts);
  map.cusp = MatrixRM::Zero(starts, torques);
  map.unrelieved = VectorXd::Zero(torques);
  map.start_roll.resize(starts, 2);
  return map;
}

// Fills in a map start by start, in ranges of torque and relief whose positions all their points share.
class MapOfStarts {
 public:
  MapOfStarts(HarrisMapResult& map, const GearMeshModel& model, const HarrisPlan& plan)
      : map_(map),
        model_(model),
        plan_(plan),
        tables_{compliance_tables(model.gear[0], kDepth), compliance_tables(model.gear[1], kDepth)},
        reliefs_(map.relief.size()) {
    const Eigen::Index torques = map.torque.size();
    for (Eigen::Index first = 0, t = 0; t <= torques; ++t)
      if (t == torques || map.torque[t] > kTorqueRange * map.torque[first]) {
        torque_ranges_.emplace_back(first, t - first);
        first = t;
      }
    for (int r = kReliefRanges - 1; r >= 0; --r)
      relief_ends_.push_back(map.relief[reliefs_ - 1] / std::pow(kReliefRange, r));
    relief_ends_.back() = map.relief[reliefs_ - 1];
  }

  void begin(Eigen::Index start);
  void find_optimum(Eigen::Index start);
  void fill(Eigen::Index start, const std::function<void(long, long, const std::string&)>& report);

 private:
  double base_radius() const { return model_.kinematics.gear(0).base_radius(); }
  size_t range_of(double relief) const {
    return static_cast<size_t>(
        std::lower_bound(relief_ends_.begin(), relief_ends_.end(), relief * (1 - 1e-12)) -
        relief_ends_.begin());
  }

  HarrisMapResult& map_;
  const GearMeshModel& model_;
  const HarrisPlan& plan_;
  std::array<std::vector<MatrixXd>, 2> tables_;
  Eigen::Index reliefs_;
  std::vector<std::pair<Eigen::Index, Eigen::Index>> torque_ranges_;  // first, count
  std::vector<double> relief_ends_;     // ascending, the largest relief of each range
  std::array<FlankDeviation, 2> unit_;  // of the start: a relief of Range::kUnit
};

void MapOfStarts::begin(Eigen::Index start) {
  for (int g = 0; g < kSides; ++g) {
    const ToothGeometry& gear = model_.kinematics.gear(g);
    map_.start_roll(start, g) = gear.tip_roll_angle() - map_.length[start] / gear.base_radius();
    unit_[g] = relieves(map_.relieved, g)
                   ? FlankDeviation(gear, with_tip({}, Range::kUnit, map_.length[start], map_.shape))
                   : FlankDeviation();
    // The largest must fit the tooth, together with what else is taken off.
    FlankDeviation(gear, relieved_mesh(map_, map_.relief[reliefs_ - 1], map_.length[start]).modification[g]);
  }
  map_.peak_to_peak.push_back(MatrixRM::Zero(map_.torque.size(), reliefs_));
  for (auto& h : map_.harmonic) h.push_back(MatrixRM::Zero(map_.torque.size(), reliefs_));
}

void MapOfStarts::find_optimum(Eigen::Index start) {
  const VectorXd load = VectorXd::Constant(1, plan_.design_torque / base_radius());
  // A range of one load has no strips to spare, as the others have under their larger loads.
  HarrisPlan finer = plan_;
  finer.strips *= 2;
  std::vector<Range> ranges;
  ranges.reserve(relief_ends_.size());
  for (const double end : relief_ends_) ranges.emplace_back(model_, unit_, end, tables_, load, finer);
  const auto value = [&](double relief) {
    return peak_to_peak(ranges[range_of(relief)].error(relief).col(0));
  };
  Eigen::Index best = 0;
  VectorXd there(reliefs_);
  for (Eigen::Index r = 0; r < reliefs_; ++r) {
    there[r] = value(map_.relief[r]);
    if (there[r] < there[best]) best = r;
  }
  // Between the neighbours of the best of the map.
  std::tie(map_.optimum_relief[start], map_.optimum_peak_to_peak[start]) =
      least_between(map_.relief[std::max<Eigen::Index>(0, best - 1)],
                    map_.relief[std::min(reliefs_ - 1, best + 1)], 1e-3 * map_.relief[reliefs_ - 1], value);
  if (there[best] <= map_.optimum_peak_to_peak[start]) {
    map_.optimum_relief[start] = map_.relief[best];
    map_.optimum_peak_to_peak[start] = there[best];
  }
}

void MapOfStarts::fill(Eigen::Index start,
                       const std::function<void(long, long, const std::string&)>& report) {
  const auto fill_in = [&](Range& range, Eigen::Index first, double relief, const auto& take) {
    const MatrixXd error = range.error(relief);
    for (Eigen::Index t = 0; t < error.cols(); ++t) take(first + t, error.col(t));
  };
  long done = 0;
  const long total = static_cast<long>(torque_ranges_.size() * relief_ends_.size());
  double after = -1;
  for (const double end : relief_ends_) {
    for (const auto& [first, count] : torque_ranges_) {
      Range range(model_, unit_, end, tables_, map_.torque.segment(first, count) / base_radius(), plan_);
      for (Eigen::Index r = 0; r < reliefs_; ++r) {
        if (relief_ends_[std::min(range_of(map_.relief[r]), relief_ends_.size() - 1)] != end) continue;
        fill_in(range, first, map_.relief[r], [&](Eigen::Index t, const auto& error) {
          map_.peak_to_peak[start](t, r) = peak_to_peak(error);
          const Harmonics h = harmonics(error, kMappedHarmonics);
          for (int n = 0; n < kMappedHarmonics; ++n) map_.harmonic[n][start](t, r) = h.amplitude[n];
        });
      }
      const double optimum = map_.optimum_relief[start];  // it has a curve over all torques
      if (optimum > after && optimum <= end)
        fill_in(range, first, optimum,
                [&](Eigen::Index t, const auto& error) { map_.cusp(start, t) = peak_to_peak(error); });
      if (start == 0 && after < 0)
        fill_in(range, first, 0.0,
                [&](Eigen::Index t, const auto& error) { map_.unrelieved[t] = peak_to_peak(error); });
      report(++done + start * total, map_.length.size() * total, text("relief to ", end * 1e6, " µm"));
    }
    after = end;
  }
}

}  // namespace

HarrisMapResult harris_map(const ReducedBody& driver, const ReducedBody& driven,
                           const StaticParameters& statics, const HarrisPlan& plan,
                           const std::function<void(long, long, const std::string&)>& report) {
  require_plan(plan);
  require_able("harris-map", traits(statics.mesh, driver.design, driven.design));
  HarrisMapResult map = blank_map(driver, driven, statics, plan);
  const GearMeshModel model(driver, driven, map.mesh);
  MapOfStarts starts(map, model, plan);
  for (Eigen::Index s = 0; s < map.length.size(); ++s) {
    starts.begin(s);
    starts.find_optimum(s);
    starts.fill(s, report);
  }
  return map;
}

void check(HarrisMapResult& map, const ReducedBody& driver, const ReducedBody& driven, int positions,
           int points, int finer) {
  const Eigen::Index torques = map.torque.size(), reliefs = map.relief.size(), all = torques * reliefs;
  StaticParameters settings;
  settings.fidelity.contact = ContactModel::strips;
  settings.contact.strips = finer * map.contact.strips;
  settings.contact.positions = finer * positions;
  map.checked = 0;
  map.largest_error = 0;
  const auto compare = [&](double relief, double length, double torque, double found) {
    settings.mesh = relieved_mesh(map, relief, length);
    const StaticResult fine = static_transmission(driver, driven, settings, torque);
    map.largest_error =
        std::max(map.largest_error, std::abs(found / peak_to_peak(fine.transmission_error) - 1));
    ++map.checked;
  };
  for (Eigen::Index s = 0; s < map.length.size(); ++s)
    compare(map.optimum_relief[s], map.length[s], map.design_torque, map.optimum_peak_to_peak[s]);
  // Spread over the map by the golden section of its places.
  for (int k = 0; k < points; ++k) {
    const double place = std::fmod((k + 0.5) * 0.5 * (std::sqrt(5.0) - 1), 1.0);
    const auto at =
        std::min(all - 1, static_cast<Eigen::Index>((k + place) / points * static_cast<double>(all)));
    const Eigen::Index t = at / reliefs, r = at % reliefs, s = k % map.length.size();
    compare(map.relief[r], map.length[s], map.torque[t], map.peak_to_peak[s](t, r));
  }
}

void add_dynamics(HarrisMapResult& map, const ReducedBody& driver, const ReducedBody& driven,
                  const SweepParameters& settings, double bearing_stiffness,
                  const std::function<void(long, long, const std::string&)>& report) {
  set_motion(map, {driver, driven}, map, settings);
  static_cast<MeshSpeeds&>(map) = settings;
  StaticParameters statics;
  statics.fidelity = settings.fidelity;
  statics.contact = map.contact;
  const Eigen::Index torques = map.torque.size(), reliefs = map.relief.size(), starts = map.length.size();
  const long total = static_cast<long>(torques * reliefs * starts);
  long done = 0;
  for (Eigen::Index s = 0; s < starts; ++s) {
    map.dynamic_rms.push_back(MatrixRM::Zero(torques, reliefs));
    map.worst_frequency.push_back(MatrixRM::Zero(torques, reliefs));
    for (Eigen::Index r = 0; r < reliefs; ++r) {
      statics.mesh = relieved_mesh(map, map.relief[r], map.length[s]);
      for (Eigen::Index t = 0; t < torques; ++t) {
        const StaticResult rest = static_transmission(driver, driven, statics, map.torque[t]);
        for (const Direction direction : {Direction::up, Direction::down}) {
          const SweepResult sweep = whine::sweep(driver, driven, rest, bearing_stiffness, settings, direction,
                                                 [](long, long, const std::string&) {});
          for (Eigen::Index f = 0; f < sweep.mesh_frequency.size(); ++f) {
            const double rms = harmonics(sweep.transmission_error[static_cast<size_t>(f)].col(0), 0).rms;
            if (rms <= map.dynamic_rms[s](t, r)) continue;
            map.dynamic_rms[s](t, r) = rms;
            map.worst_frequency[s](t, r) = sweep.mesh_frequency[f];
          }
        }
        report(++done, total, text(map.torque[t], " N m, ", map.relief[r] * 1e6, " µm"));
      }
    }
  }
}

}  // namespace whine
