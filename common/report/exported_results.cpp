#include "report/exported_results.h"

#include <optional>

#include "base/error.h"
#include "base/tool.h"
#include "gear/pair.h"
#include "report/figures.h"
#include "report/sweep_panels.h"

namespace whine {
namespace {

using Eigen::Index;
using Value = std::optional<double>;

// Units of REXS.
constexpr const char *kNoUnit = "none", *kMicrometre = "mum", *kHertz = "Hz", *kPerMinute = "1 / min",
                     *kNewton = "N";

class Collector {
 public:
  explicit Collector(const ReportContent& content) : content_(content) {}

  // value(statics): nothing if there is none at that torque.
  template <class F>
  void add(const std::string& name, const char* unit, const F& value) {
    RexsResult result{name, unit, {}, true};
    for (const SystemStaticResult& at : content_.statics) {
      const Value found = value(at.mesh[0]);
      if (!found) return;
      result.values.push_back(*found);
    }
    out.push_back(std::move(result));
  }

  std::vector<RexsResult> out;

 private:
  const ReportContent& content_;
};

void export_statics(Collector& all) {
  using S = const StaticResult&;
  all.add("mesh_stiffness_mean", "N / mm", [](S s) { return Value(s.mean_stiffness * 1e-3); });
  all.add("mesh_stiffness_mean_per_face_width", "N / (mm mum)",
          [](S s) { return Value(s.mean_stiffness * 1e-6 / (s.face_width() * kMilli)); });
  all.add("static_transmission_error_mean", kMicrometre,
          [](S s) { return Value(s.transmission_error.mean() * kMicro); });
  all.add("static_transmission_error_peak_to_peak", kMicrometre,
          [](S s) { return Value(peak_to_peak(s.transmission_error) * kMicro); });
  for (const int n : {1, 2, 3})
    all.add(text("static_transmission_error_harmonic_", n), kMicrometre, [n](S s) {
      return n < s.transmission_error_harmonic.size() ? Value(s.transmission_error_harmonic[n] * kMicro)
                                                      : Value();
    });
  all.add("static_tooth_load_max", kNewton, [](S s) { return Value(s.tooth_load.maxCoeff()); });
}

void export_ring_down(const ReportContent& c, Collector& all) {
  for (const auto& [name, state] :
       {std::pair{"one_pair", ContactState::one}, std::pair{"two_pairs", ContactState::two}}) {
    const auto at = [&c, wanted = state](const StaticResult& s, auto member, double scale) {
      const ImpactResult* a = impact_of(c, s.torque);
      const auto row = a ? a->states.row_of(wanted) : std::nullopt;
      return row ? Value((a->states.*member)[*row] * scale) : Value();
    };
    all.add(text("natural_frequency_", name), kHertz,
            [&](const StaticResult& s) { return at(s, &ContactStateDecays::natural_frequency, 1.0); });
    all.add(text("damping_ratio_", name), "%",
            [&](const StaticResult& s) { return at(s, &ContactStateDecays::damping_ratio, kPercent); });
  }
}

void export_motion(const ReportContent& c, Direction direction, Collector& all) {
  const std::string way = direction == Direction::up ? "_speed_rising" : "_speed_falling";
  const auto add = [&](const std::string& name, const char* unit, const auto& value) {
    all.add(name + way, unit, [&](const StaticResult& s) {
      const ResponseResult* sweep = sweep_of(c, s.torque, direction);
      return sweep ? Value(value(*sweep)) : Value();
    });
  };
  using R = const ResponseResult&;
  add("dynamic_transmission_error_rms_max", kMicrometre, [](R r) { return r.dte_rms.maxCoeff() * kMicro; });
  const auto resonance = [](R r) {
    Index at = 0;
    r.dte_rms.col(0).maxCoeff(&at);
    return r.mesh_frequency[at];
  };
  add("resonance_mesh_frequency", kHertz, resonance);
  add("resonance_driver_rpm", kPerMinute, [&](R r) { return 60 * resonance(r) / r.gear[0].design.teeth; });
  add("dynamic_tooth_load_max", kNewton, [](R r) { return r.tooth_load_max.maxCoeff(); });
  all.add("speeds_beyond_backlash" + way, kNoUnit, [&](const StaticResult& s) {
    const ResponseResult* sweep = sweep_of(c, s.torque, direction);
    if (!sweep) return Value();
    double count = 0;
    for (Index i = 0; i < sweep->mesh_frequency.size(); ++i) count += beyond_backlash(*sweep, i);
    return Value(count);
  });
  RexsResult jumps{"jump_mesh_frequency" + way, kHertz, {}, true},
      torques{"jump_torque" + way, "N m", {}, true};
  bool complete = true;
  for (const SystemStaticResult& at : c.statics) {
    const ResponseResult* sweep = sweep_of(c, torque_of(at), direction);
    complete = complete && sweep;
    if (!sweep) continue;
    for (const double f : sweep->jump_frequency) {
      jumps.values.push_back(f);
      torques.values.push_back(torque_of(at));
    }
  }
  if (complete && !jumps.values.empty()) {
    all.out.push_back(std::move(jumps));
    all.out.push_back(std::move(torques));
  }
}

}  // namespace

RexsPair exported_pair(const ReportContent& c) {
  require_one_scene(c);
  if (c.of_train())
    fail(Failure::input, "results: these are artifacts of a train; give those of a pair of gears");
  const StaticResult& s = c.pair();
  return {{s.gear[0].design.teeth, s.gear[1].design.teeth},
          {s.gear[0].design.module, s.gear[1].design.module},
          s.mesh.centre_distance,
          {s.gear[0].design.pressure_angle, s.gear[1].design.pressure_angle},
          {s.gear[0].design.profile_shift, s.gear[1].design.profile_shift}};
}

std::vector<RexsResult> exported_results(const ReportContent& c) {
  Collector all(c);
  all.out.push_back({"version", kNoUnit, {}, false, kVersion});
  all.out.push_back({"scene", kNoUnit, {}, false, c.scene});
  all.out.push_back({"contact_ratio", kNoUnit, {GearPair(c.pair()).contact_ratio()}});
  all.add("torque", "N m", [](const StaticResult& s) { return Value(s.torque); });
  export_statics(all);
  all.add("critical_mesh_frequency", kHertz, [&](const StaticResult& s) {
    for (const ResponseResult& sweep : c.sweeps)
      if (sweep.torque == s.torque) return Value(sweep.natural_frequency);
    return Value();
  });
  all.add("critical_driver_speed", kPerMinute, [&](const StaticResult& s) {
    for (const ResponseResult& sweep : c.sweeps)
      if (sweep.torque == s.torque) return Value(60 * sweep.natural_frequency / s.gear[0].design.teeth);
    return Value();
  });
  export_ring_down(c, all);
  for (const Direction direction : {Direction::up, Direction::down}) export_motion(c, direction, all);
  return all.out;
}

}  // namespace whine
