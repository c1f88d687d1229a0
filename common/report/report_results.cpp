#include "report/report_results.h"

#include <algorithm>

#include "base/error.h"
#include "gear/hertz.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;
using Numbers = std::vector<ReportNumber>;

// One definition at rest and in motion, so that the two can be compared.
const std::string kNominalPressure =
    "nominal contact pressure of the largest tooth load (Hertz, at the pitch point)";
constexpr const char* kBeyond = "beyond the backlash";

// Adds numbers of one torque to a list.
struct Adder {
  double torque;  // N m
  Numbers& out;
  void operator()(const std::string& quantity, const std::string& unit, const std::string& value,
                  const std::string& remark = "") const {
    out.push_back({torque, quantity, unit, value, remark});
  }
};

void add_statics(const StaticResult& s, const Adder& add) {
  add("mean mesh stiffness", "N/µm", fixed(s.mean_stiffness * 1e-6, 1));
  add("the same per face width", "N/(mm µm)", fixed(s.mean_stiffness * 1e-6 / (s.face_width() * kMilli), 2));
  add("static transmission error, mean", "µm", significant(s.transmission_error.mean() * kMicro, 4));
  add("static transmission error, peak to peak", "µm",
      significant(peak_to_peak(s.transmission_error) * kMicro, 4));
  for (Index n = 1; n <= std::min<Index>(3, s.transmission_error_harmonic.size() - 1); ++n)
    add(text("static transmission error, harmonic ", n), "µm",
        significant(s.transmission_error_harmonic[n] * kMicro, 3));
  add("static tooth load, largest", "N", fixed(s.tooth_load.maxCoeff(), 0));
  add(text("static: ", kNominalPressure), "MPa",
      fixed(hertz_contact(s, s.tooth_load.maxCoeff()).pressure * 1e-6, 0));
  const FlankPressure& pressure = s.flank_pressure;
  if (pressure.smooth > 0)
    add("static contact pressure inside a flank, largest", "MPa", fixed(pressure.smooth * 1e-6, 0));
  if (pressure.on_ridge > pressure.smooth)
    add("the same where relief begins", "MPa", "no value: see the warnings");
  for (int g = 0; g < s.root_stress_max.size(); ++g)
    add("static root stress of " + s.mesh.gear[g] + ", largest", "MPa",
        fixed(s.root_stress_max[g] * 1e-6, 1));
  add("loss factor H_V at rest (power lost over power carried and coefficient of friction)", "1",
      fixed(s.loss_factor, 4));
  if (s.friction_loss.size() > 0) {
    add("coefficient of friction at rest", "1", fixed(s.friction_coefficient, 4));
    add("efficiency at rest (friction between the flanks alone)", "%", fixed(s.efficiency * kPercent, 3));
  }
}

void add_ring_down(const ImpactResult& a, const Adder& add) {
  for (size_t i = 0; i < a.contact_state.size(); ++i) {
    const Index at = static_cast<Index>(i);
    const std::string state =
        at < a.state_phase.size()
            ? name_of(a.contact_state[i]) + (a.contact_state[i] == ContactState::one ? " pair" : " pairs")
            : "mean over the period";
    add("natural frequency by ring-down, " + state, "Hz", hertz(a.natural_frequency[at]));
    add("damping ratio by ring-down, " + state, "%", fixed(a.damping_ratio[at] * kPercent, 2));
  }
}

void add_motion(const StaticResult& s, const ResponseResult& r, const Adder& add) {
  const std::string way = r.direction == Direction::up ? ", speed rising" : ", speed falling";
  Index at = 0;
  const double rms = r.dte_rms.col(0).maxCoeff(&at);
  std::string beyond = beyond_backlash(r, at) ? kBeyond : "";
  add("largest RMS of the dynamic transmission error" + way, "µm", significant(rms * kMicro, 3), beyond);
  add("mesh frequency of that RMS" + way, "Hz", hertz(r.mesh_frequency[at]), beyond);
  const double load = r.tooth_load_max.col(0).maxCoeff(&at);
  beyond = beyond_backlash(r, at) ? kBeyond : "";
  add("largest tooth load" + way, "N", fixed(load, 0), beyond);
  add("mesh frequency of that tooth load" + way, "Hz", hertz(r.mesh_frequency[at]), beyond);
  add("largest tooth load over T / r_b" + way, "1", fixed(load / static_force(s), 2), beyond);
  add(kNominalPressure + way, "MPa", fixed(hertz_contact(s, load).pressure * 1e-6, 0), beyond);
  for (int g = 0; g < s.root_stress_max.size(); ++g)
    if (known_of(r.root_stress_max, g)) {
      const std::string of = "root stress of " + s.mesh.gear[g] + " (sustained for 1/64 of a mesh period)";
      const double stress = r.root_stress_sustained.col(g).maxCoeff(&at);
      beyond = beyond_backlash(r, at) ? kBeyond : "";
      add("largest " + of + way, "MPa", fixed(stress * 1e-6, 1), beyond);
      add("largest " + of + " over that at rest" + way, "1", fixed(stress / s.root_stress_max[g], 2), beyond);
    }
  for (int g = 0; g < kSides; ++g)
    if (known_of(r.bearing_force_max, g)) {
      const std::string of = "force on the bearing of " + s.mesh.gear[g];
      const double force = r.bearing_force_rms.col(g).maxCoeff(&at);
      beyond = beyond_backlash(r, at) ? kBeyond : "";
      add("largest RMS of the oscillating " + of + way, "N", fixed(force, 0), beyond);
      add("mesh frequency of that RMS, " + s.mesh.gear[g] + way, "Hz", hertz(r.mesh_frequency[at]), beyond);
      add("largest " + of + way, "N", fixed(r.bearing_force_max.col(g).maxCoeff(&at), 0),
          beyond_backlash(r, at) ? kBeyond : "");
    }
  add("jumps" + way, "Hz", jumps_of(r));
  add("contact lost" + way, "Hz", loss_ranges(r));
  if (const std::string speeds = speeds_beyond_backlash({&r}); !speeds.empty())
    add("motion beyond the backlash" + way, "Hz", speeds);
}

}  // namespace

std::vector<ReportNumber> report_numbers(const ReportContent& c) {
  Numbers out;
  for (const StaticResult& s : c.statics) {
    const Adder add{s.torque, out};
    add_statics(s, add);
    if (const ImpactResult* a = impact_of(c, s.torque)) add_ring_down(*a, add);
    const ResponseResult *up = sweep_of(c, s.torque, Direction::up),
                         *down = sweep_of(c, s.torque, Direction::down);
    for (const ResponseResult* sweep : {up, down})
      if (sweep) add_motion(s, *sweep, add);
  }
  return out;
}

std::string results_table(const ReportContent& c) {
  const Numbers results = report_numbers(c);
  std::vector<std::string> head{"", "unit"};
  for (const auto& s : c.statics) head.push_back(torque_words(s.torque));
  html::Rows rows;
  bool remarked = false;
  for (const ReportNumber& result : results) {
    auto row = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r[0] == result.quantity; });
    if (row == rows.end()) {
      rows.push_back({result.quantity, result.unit == "1" ? "–" : result.unit});
      rows.back().resize(head.size());
      row = rows.end() - 1;
    }
    for (size_t t = 0; t < c.statics.size(); ++t)
      if (c.statics[t].torque == result.torque)
        (*row)[t + 2] = result.value + (result.remark.empty() ? "" : " *");
    remarked = remarked || !result.remark.empty();
  }
  return html::table("Results by torque on the driver; results.tsv holds the same numbers.", head, rows) +
         (remarked
              ? html::paragraph(
                    "* At this speed the motion is larger than the backlash: back flanks would touch, which is not modelled, so the number is not to be trusted.")
              : "");
}

}  // namespace whine
