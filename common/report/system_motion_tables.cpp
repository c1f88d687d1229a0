#include "report/system_motion_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/system_opening.h"

namespace whine {
namespace {

using Eigen::Index;

constexpr double kSamePeak = 0.01;        // of the RMS: below it rising and falling speed have one motion
constexpr double kLargeImbalance = 1e-6;  // of the throughput
constexpr double kSharpPeak = 2;          // of the RMS at the neighbouring speeds

// The largest value over the speeds, and where.
struct Peak {
  double value = 0, at = 0;  // at: Hz
};

Peak peak_of(const ResponseResult& a, const MatrixRM& values, size_t column) {
  if (values.size() == 0) return {};
  Index row = 0;
  const double value = values.col(static_cast<Index>(column)).maxCoeff(&row);
  return {value, a.mesh_frequency[row]};
}

std::string way_words_of(const ResponseResult& a) {
  return text("speed ", a.direction == Direction::up ? "rising" : "falling");
}

// "1600\n3556 rpm": Hz, and below the rotation of a member; a list likewise.
std::string speed_cell(const TurningMember& member, const std::string& speeds) {
  const std::string with = with_rpm(member, speeds + " Hz"), hertz_and = speeds + " Hz (";
  return with.starts_with(hertz_and)
             ? text(speeds, "\n", with.substr(hertz_and.size(), with.size() - hertz_and.size() - 1))
             : speeds;
}

// The largest first order over the speeds: N, and the level of its RMS; no value where artifacts do not have it.
std::array<std::string, 2> order_cells(const std::vector<MatrixRM>& harmonic, size_t column) {
  const Eigen::VectorXd first = first_order_of(harmonic, static_cast<Index>(column));
  const double most = first.size() > 0 ? first.maxCoeff() : 0;
  constexpr double kNothing = 1e-3;  // N
  if (!(most > kNothing)) return {first.size() > 0 ? "0" : html::kNoValue, html::kNoValue};
  return {fixed(most, 1), decibels(most)};
}

// Rows of a sweep by speed.
std::vector<Index> by_speed(const ResponseResult& a) {
  std::vector<Index> order(static_cast<size_t>(a.mesh_frequency.size()));
  std::iota(order.begin(), order.end(), Index{0});
  std::sort(order.begin(), order.end(),
            [&](Index x, Index y) { return a.mesh_frequency[x] < a.mesh_frequency[y]; });
  return order;
}

// "" if no row is marked.
std::string speeds_where(const ResponseResult& a, const auto& marks) {
  const std::vector<Index> order = by_speed(a);
  Eigen::VectorXd speeds(a.mesh_frequency.size());
  std::vector<bool> marked;
  marked.reserve(order.size());
  for (size_t i = 0; i < order.size(); ++i) {
    speeds[static_cast<Index>(i)] = a.mesh_frequency[order[i]];
    marked.push_back(marks(order[i]));
  }
  return speeds_words(speeds, marked);
}

// N: mean force of a mesh at rest; 0 where it carries none.
double rest_force(const SystemReport& r, size_t m) {
  return r.rest ? r.rest->mesh_force.col(static_cast<Index>(m)).mean() : 0;
}

// "" where the mesh carries nothing at rest.
std::string factor_words(const SystemReport& r, size_t m, const Peak& force) {
  const double at_rest = rest_force(r, m);
  return at_rest > 0 ? fixed(force.value / at_rest, 2) : "";
}

std::string meshes_table(const SystemReport& r) {
  const TurningMember driver = driving_member(r);
  const auto at = [&](const Peak& peak) { return speed_cell(driver, shown(peak.at, 6)); };
  html::Rows rows;
  for (const ResponseResult& a : r.sweeps)
    for (size_t m = 0; m < a.train.layout.meshes.size(); ++m) {
      const Peak error = peak_of(a, a.dte_rms, m), force = peak_of(a, a.mesh_force_max, m),
                 tooth = peak_of(a, a.tooth_load_max, m), share = peak_of(a, a.load_share_max, m),
                 loss = peak_of(a, a.separation_fraction, m);
      const std::string factor = factor_words(r, m, force);
      rows.push_back({mesh_name(a.train.layout, m), way_words_of(a), significant(error.value * kMicro, 4),
                      at(error), fixed(force.value, 0), at(force), factor.empty() ? "–" : factor,
                      fixed(tooth.value, 0),
                      r.rest && shares_load(*r.rest, m) ? fixed(share.value * kPercent, 1) : "–",
                      fixed(loss.value * kPercent, 1), loss.value > 0 ? at(loss) : "–"});
      for (const std::string& cell : order_cells(a.mesh_force_harmonic, m)) rows.back().push_back(cell);
    }
  return html::table(
      text("The meshes in motion: the largest value over the speeds, and the mesh frequency at which it ",
           "is, with the rotation of ", driver.name,
           ". RMS: of the oscillating part of the transmission error (DTE). Dynamic factor: largest ",
           "mesh force over the mean force at rest. Share: at one instant, of the load of the meshes of ",
           "one [[mesh]]. Contact loss: time in which no pair of teeth touches."),
      {"mesh", "sweep", "RMS of the DTE (µm)", "at (Hz)", "mesh force (N)", "at (Hz)", "dynamic factor",
       "tooth load (N)", "share (%)", "contact loss (%)", "at (Hz)", "first order of the force (N)",
       "dB re 1 N"},
      rows, "small");
}

std::string bodies_table(const SystemReport& r) {
  const TurningMember driver = driving_member(r);
  html::Rows rows;
  for (const ResponseResult& a : r.sweeps)
    for (size_t b = 0; b < a.train.layout.bodies.size(); ++b) {
      const System::Body& body = a.train.layout.bodies[b];
      const Peak most = peak_of(a, a.bearing_force_max, b), rms = peak_of(a, a.bearing_force_rms, b);
      rows.push_back({text(body.name, body.on != System::kGround ? " (pin)" : ""), way_words_of(a),
                      fixed(most.value, 1), speed_cell(driver, shown(most.at, 6)), fixed(rms.value, 1),
                      speed_cell(driver, shown(rms.at, 6))});
      for (const std::string& cell : order_cells(a.bearing_force_harmonic, b)) rows.back().push_back(cell);
    }
  return html::table(
      text("Forces on bearings and pins in motion: the largest value over the speeds, and the mesh ",
           "frequency at which it is. RMS: of the oscillating part. On a rigid axis: the sum of the ",
           "contact forces."),
      {"body", "sweep", "largest force (N)", "at (Hz)", "RMS (N)", "at (Hz)", "first order (N)", "dB re 1 N"},
      rows);
}

std::string sweeps_table(const SystemReport& r) {
  const TurningMember driver = driving_member(r);
  const auto at = [&](const std::string& speeds) {
    return speeds.empty() ? "none" : speed_cell(driver, speeds);
  };
  const bool slides = std::any_of(r.sweeps.begin(), r.sweeps.end(),
                                  [](const ResponseResult& a) { return a.friction.efficiency.size() > 0; });
  std::vector<std::string> head{"sweep",
                                "speeds (Hz)",
                                "contact loss at (Hz)",
                                "not periodic at (Hz)",
                                "repeats after several mesh periods at (Hz)",
                                "mesh periods run, most",
                                "energy imbalance"};
  if (slides) head.emplace_back("efficiency (%)");
  html::Rows rows;
  for (const ResponseResult& a : r.sweeps) {
    const std::string loss =
        speeds_where(a, [&](Index i) { return a.separation_fraction.row(i).maxCoeff() > 0; });
    const std::string open = speeds_where(a, [&](Index i) { return a.period_multiple[i] == 0; });
    const std::string several =
        speeds_where(a, [&](Index i) { return a.period_multiple[i] > a.hunting_periods; });
    rows.push_back(
        {way_words_of(a),
         text(a.mesh_frequency.size(), ": ",
              at(shown(a.mesh_frequency.minCoeff(), 6) + " to " + shown(a.mesh_frequency.maxCoeff(), 6))),
         at(loss), at(open), at(several), text(a.periods.maxCoeff()),
         shown(a.energy_imbalance.maxCoeff(), 2)});
    if (const Eigen::VectorXd& left = a.friction.efficiency; left.size() > 0)
      rows.back().push_back(
          text(fixed(left.minCoeff() * kPercent, 3), " to ", fixed(left.maxCoeff() * kPercent, 3)));
  }
  return html::table(
      text("The sweeps. Each speed starts with the motion of the one before it. Energy imbalance: ",
           "largest energy that is not accounted for, over the energy that goes through.",
           slides ? " Efficiency: by friction between the flanks alone." : ""),
      head, rows);
}

// The sweep the other way; nullptr: there is none.
const ResponseResult* other_way(const SystemReport& r, const ResponseResult& a) {
  for (const ResponseResult& other : r.sweeps)
    if (other.direction != a.direction) return &other;
  return nullptr;
}

// Whether the motions of two sweeps at one speed differ in the RMS of a mesh by more than kSamePeak of its larger value.
bool differs(const ResponseResult& a, Index row, const ResponseResult& b) {
  for (Index other = 0; other < b.mesh_frequency.size(); ++other) {
    if (std::abs(b.mesh_frequency[other] - a.mesh_frequency[row]) > 1e-9 * a.mesh_frequency[row]) continue;
    for (Index m = 0; m < a.dte_rms.cols(); ++m) {
      const double one = a.dte_rms(row, m), two = b.dte_rms(other, m);
      if (std::abs(one - two) > kSamePeak * std::max(one, two)) return true;
    }
  }
  return false;
}

// Hz: speeds at which the RMS of a mesh is far above those at the speeds on either side.
std::string sharp_peaks(const ResponseResult& a) {
  const std::vector<Index> order = by_speed(a);
  std::string out;
  for (size_t i = 1; i + 1 < order.size(); ++i) {
    const auto rms = [&](size_t k) { return a.dte_rms.row(order[k]).array(); };
    if ((rms(i) > kSharpPeak * rms(i - 1).max(rms(i + 1))).any())
      out += (out.empty() ? "" : ", ") + shown(a.mesh_frequency[order[i]], 5);
  }
  return out;
}

}  // namespace

std::string speeds_words(const Eigen::VectorXd& speeds, const std::vector<bool>& marked) {
  std::string out;
  for (size_t i = 0; i < marked.size(); ++i) {
    if (!marked[i]) continue;
    size_t last = i;
    while (last + 1 < marked.size() && marked[last + 1]) ++last;
    const double from = speeds[static_cast<Index>(i)], to = speeds[static_cast<Index>(last)];
    out += text(out.empty() ? "" : ", ", shown(from, 6), last > i ? text(" to ", shown(to, 6)) : "");
    i = last;
  }
  return out;
}

std::string motion_tables(const SystemReport& r) {
  return r.sweeps.empty() ? "" : sweeps_table(r) + meshes_table(r) + bodies_table(r);
}

std::vector<SystemNumber> motion_numbers(const SystemReport& r) {
  std::vector<SystemNumber> out;
  for (const ResponseResult& a : r.sweeps) {
    const System& s = a.train.layout;
    const std::string way = way_words_of(a);
    const auto add = [&](const std::string& part, const std::string& what, const char* unit,
                         const std::string& value, const Peak& peak) {
      out.push_back(
          {part, text(what, ", ", way), unit, value, text("at ", shown(peak.at, 6), " Hz of the mesh")});
    };
    const auto add_order = [&](const std::string& part, const std::string& what,
                               const std::vector<MatrixRM>& harmonic, size_t column) {
      const auto cells = order_cells(harmonic, column);
      if (cells[0] != html::kNoValue) out.push_back({part, text(what, ", ", way), "N", cells[0], ""});
      if (cells[1] != html::kNoValue)
        out.push_back({part, text(what, ", level of its RMS, ", way), "dB re 1 N", cells[1], ""});
    };
    for (size_t m = 0; m < s.meshes.size(); ++m) {
      const std::string name = mesh_name(s, m);
      const Peak error = peak_of(a, a.dte_rms, m), force = peak_of(a, a.mesh_force_max, m),
                 tooth = peak_of(a, a.tooth_load_max, m), share = peak_of(a, a.load_share_max, m),
                 loss = peak_of(a, a.separation_fraction, m);
      add(name, "RMS of the dynamic transmission error, largest", "µm", significant(error.value * kMicro, 4),
          error);
      add_order(name, "mesh force in motion, first order, largest", a.mesh_force_harmonic, m);
      add(name, "mesh force in motion, largest", "N", fixed(force.value, 1), force);
      if (const std::string factor = factor_words(r, m, force); !factor.empty())
        add(name, "dynamic factor, largest", "1", factor, force);
      add(name, "tooth load in motion, largest", "N", fixed(tooth.value, 1), tooth);
      if (r.rest && shares_load(*r.rest, m))
        add(name, "share of the load in motion, largest", "%", fixed(share.value * kPercent, 2), share);
      add(name, "time without contact, largest", "%", fixed(loss.value * kPercent, 2), loss);
      for (size_t side = kSides * m; side < kSides * (m + 1); ++side)
        if (const Peak stress = peak_of(a, a.root_stress_sustained, side); stress.value > 0)
          add(name,
              "root stress of " + a.name_of_side(static_cast<Index>(side)) + " in motion, largest sustained",
              "MPa", fixed(stress.value * kInMegapascals, 1), stress);
    }
    if (a.friction.efficiency.size() > 0) {
      Index least = 0, most = 0;
      const double efficiency = a.friction.efficiency.minCoeff(&least),
                   power = a.friction.power.maxCoeff(&most);
      add("train", "efficiency, friction between the flanks alone, least", "%",
          fixed(efficiency * kPercent, 3), {efficiency, a.mesh_frequency[least]});
      add("train", "power that friction takes, largest", "W", shown(power, 4),
          {power, a.mesh_frequency[most]});
    }
    for (size_t b = 0; b < s.bodies.size(); ++b) {
      const Peak most = peak_of(a, a.bearing_force_max, b), rms = peak_of(a, a.bearing_force_rms, b);
      add_order(s.bodies[b].name, "force on the bearing in motion, first order, largest",
                a.bearing_force_harmonic, b);
      add(s.bodies[b].name, "force on the bearing in motion, largest", "N", fixed(most.value, 1), most);
      add(s.bodies[b].name, "force on the bearing in motion, RMS of the oscillating part, largest", "N",
          fixed(rms.value, 2), rms);
    }
    out.push_back({way, "speeds", "1", text(a.mesh_frequency.size()), ""});
    out.push_back({way, "speeds whose motion is not periodic", "1",
                   text((a.period_multiple.array() == 0).count()),
                   speeds_where(a, [&](Index i) { return a.period_multiple[i] == 0; })});
    out.push_back({way, "energy imbalance, largest", "1", shown(a.energy_imbalance.maxCoeff(), 3), ""});
  }
  return out;
}

std::vector<Remark> motion_remarks(const SystemReport& r) {
  std::vector<Remark> out;
  for (const ResponseResult& a : r.sweeps) {
    const std::string way = way_words_of(a);
    const auto open = (a.period_multiple.array() == 0).count();
    if (open > 0)
      out.push_back(remark(true, way, ": the motion does not repeat at ", open, " of ",
                           a.mesh_frequency.size(), " speeds (",
                           speeds_where(a, [&](Index i) { return a.period_multiple[i] == 0; }),
                           " Hz): values there are of the recorded mesh periods alone"));
    const std::string loss =
        speeds_where(a, [&](Index i) { return a.separation_fraction.row(i).maxCoeff() > 0; });
    if (!loss.empty()) {
      std::string meshes;
      for (size_t m = 0; m < a.train.layout.meshes.size(); ++m)
        if (a.separation_fraction.col(static_cast<Index>(m)).maxCoeff() > 0)
          meshes += (meshes.empty() ? "" : ", ") + mesh_name(a.train.layout, m);
      out.push_back(remark(false, way, ": teeth part at ", loss, " Hz (", meshes,
                           "): the vibration is nonlinear there"));
    }
    if (a.energy_imbalance.maxCoeff() > kLargeImbalance)
      out.push_back(remark(true, way, ": ", shown(a.energy_imbalance.maxCoeff(), 2),
                           " of the energy that goes through is not accounted for; raise steps_per_period"));
  }
  if (!r.sweeps.empty()) {
    const ResponseResult& first = r.sweeps.front();
    if (const ResponseResult* other = other_way(r, first)) {
      const std::string two = speeds_where(first, [&](Index i) { return differs(first, i, *other); });
      if (!two.empty())
        out.push_back(remark(false, "rising and falling speed lead to different motions at ", two,
                             " Hz: the vibration jumps at the ends of these ranges"));
    }
    if (const std::string sharp = sharp_peaks(first); !sharp.empty())
      out.push_back(remark(
          true, "peaks at ", sharp, " Hz are one speed wide, of more than ", fixed(kSharpPeak, 0),
          " times the RMS beside them: their height is that of the step of mesh_frequency_Hz; lower it, or give the bearings their damping"));
    std::string undamped;
    for (const System::Body& body : first.train.layout.bodies)
      if (body.bearing.elastic() && body.bearing.damping == 0)
        undamped += (undamped.empty() ? "" : ", ") + body.name;
    if (!undamped.empty())
      out.push_back(remark(false, "no damping_Ns_m in the [[bearing]] of ", undamped,
                           ": where a resonance moves it on its bearing, the height has no meaning"));
    out.insert(out.end(), first.remarks.begin(), first.remarks.end());
  }
  return out;
}

std::string motion_words(const SystemReport& r) {
  Peak most;
  std::string mesh, way;
  double loss = 0;
  for (const ResponseResult& a : r.sweeps)
    for (size_t m = 0; m < a.train.layout.meshes.size(); ++m) {
      loss = std::max(loss, peak_of(a, a.separation_fraction, m).value);
      if (const Peak peak = peak_of(a, a.dte_rms, m); peak.value > most.value) {
        most = peak;
        mesh = mesh_name(a.train.layout, m);
        way = way_words_of(a);
      }
    }
  if (mesh.empty()) return "";
  return text("The largest vibration is an RMS of ", significant(most.value * kMicro, 3), " µm of ", mesh,
              " at ", shown(most.at, 6), " Hz, ", way, "; ",
              loss > 0
                  ? text("teeth are without contact for up to ", fixed(loss * kPercent, 1), " % of the time.")
                  : "no mesh loses contact.");
}

}  // namespace whine
