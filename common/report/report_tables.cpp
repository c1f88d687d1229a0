#include "report/report_tables.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "base/error.h"
#include "base/tool.h"
#include "gear/body_inertia.h"
#include "gear/hertz.h"
#include "gear/pair.h"
#include "gear/path_points.h"
#include "io/scene_keys.h"
#include "io/summary.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_page.h"
#include "report/stiffness_table.h"

namespace whine {
namespace {

using Eigen::Index;

// "" for gears on rigid axes.
std::string bearing_frequencies_table(const ReportContent& c) {
  html::Rows rows;
  for (const ImpactResult& a : c.impacts)
    for (Index i = 0; i < a.state_phase.size() && a.frozen_frequency.size() > 0; ++i) {
      Index phase = 0;
      (a.mesh_phase.array() - a.state_phase[i]).abs().minCoeff(&phase);
      std::string all;
      for (const double f : a.frozen_frequency.row(phase)) all += (all.empty() ? "" : ", ") + fixed(f, 1);
      rows.push_back({shown(a.torque, 6), name_of(a.contact_state[static_cast<size_t>(i)]), all});
    }
  if (rows.empty()) return "";
  return html::table(
      "Lowest natural frequencies with the contact frozen, undamped: the hubs on their bearings, along the line of action and across, and the mesh, which the table above shows.",
      {"torque (N m)", "loaded tooth pairs", "frequencies (Hz)"}, rows);
}

}  // namespace

std::string gears_table(const ReportContent& c) {
  const StaticResult& s = c.statics.front();
  constexpr double kNoBacklash = 1e-6;  // m: what a centre distance rounded to a micrometre leaves
  const GearPair pair(s);
  const auto degrees = [](double rad) { return fixed(rad * 180 / std::numbers::pi, 3); };
  html::Rows rows;
  const auto both = [&](const std::string& what, const std::string& unit, const auto& value) {
    rows.push_back({what, unit, value(pair.gear(0)), value(pair.gear(1))});
  };
  using G = const ToothGeometry&;
  both("teeth", "–", [](G g) { return text(g.design().teeth); });
  both("module", "mm", [](G g) { return shown(g.design().module * kMilli, 6); });
  both("profile shift", "modules", [](G g) { return shown(g.design().profile_shift, 6); });
  both("base diameter", "mm", [](G g) { return fixed(2 * g.base_radius() * kMilli, 3); });
  both("reference diameter", "mm", [](G g) { return fixed(2 * g.pitch_radius() * kMilli, 3); });
  both("tip diameter", "mm", [](G g) { return fixed(2 * g.tip_radius() * kMilli, 3); });
  both("root diameter", "mm", [](G g) { return fixed(2 * g.root_radius() * kMilli, 3); });
  both("diameter where the involute begins", "mm",
       [](G g) { return fixed(2 * std::hypot(1.0, g.form_roll_angle()) * g.base_radius() * kMilli, 3); });
  if (pair.gear(0).undercut() > 0 || pair.gear(1).undercut() > 0) {
    both("undercut: how far the rack reaches beyond the base circle's tangent point", "mm",
         [](G g) { return fixed(std::max(0.0, g.undercut()) * kMilli, 3); });
    rows.push_back({"path of contact lost to undercut", "mm", fixed(pair.path_lost(0) * kMilli, 3),
                    fixed(pair.path_lost(1) * kMilli, 3)});
  }
  both("roll angle where the involute begins", "deg", [&](G g) { return degrees(g.form_roll_angle()); });
  both("roll angle at the tip", "deg", [&](G g) { return degrees(g.tip_roll_angle()); });
  both("tooth thickness at the tip", "mm",
       [](G g) { return fixed(g.thickness_at_radius(g.tip_radius()) * kMilli, 3); });
  const auto points = path_points(pair);
  const auto diameter = [&](const std::string& what, size_t driver, size_t driven) {
    rows.push_back({what, "mm", fixed(points[driver].diameter[0] * kMilli, 3),
                    fixed(points[driven].diameter[1] * kMilli, 3)});
  };
  diameter("diameter where the active profile starts (SAP)", 0, 4);
  diameter("diameter at B, from where one pair carries alone", 1, 1);
  diameter("diameter at D, up to where it does", 3, 3);
  both("face width", "mm", [](G g) { return shown(g.design().face_width * kMilli, 6); });
  rows.push_back({"inertia of the body as drawn, bore to tip, without fillets", "kg m²",
                  shown(least_body_inertia(pair.gear(0), s.gear[0].material), 3),
                  shown(least_body_inertia(pair.gear(1), s.gear[1].material), 3)});
  if (!c.impacts.empty()) {
    constexpr double kFillets = 1.03;  // what fillets add to the outline at most
    const ImpactResult& a = c.impacts.front();
    const auto total = [&](int g) {
      const bool drawn = a.inertia[g] < kFillets * least_body_inertia(pair.gear(g), s.gear[g].material);
      return shown(a.inertia[g], 4) + (drawn ? ", as drawn" : "");
    };
    rows.push_back({"inertia in motion, with all that turns with the gear", "kg m²", total(0), total(1)});
  }
  rows.push_back({"flanks", "", in_words(s.mesh.modification[0]), in_words(s.mesh.modification[1])});
  if (s.mesh.on_bearings()) {
    const auto of_bearing = [&](const char* what, const char* unit, double scale, double Bearing::*number,
                                const char* none) {
      const auto value = [&](const Bearing& b) {
        return !b.elastic() ? "rigid" : b.*number == 0 ? none : shown(b.*number * scale, 5);
      };
      rows.push_back({what, unit, value(s.mesh.bearing[0]), value(s.mesh.bearing[1])});
    };
    of_bearing("radial stiffness of the bearing", "N/µm", 1e-6, &Bearing::stiffness, "0");
    of_bearing("radial damping of the bearing", "N s/m", 1, &Bearing::damping, "0");
    of_bearing("mass on the bearing", "kg", 1, &Bearing::mass, "as drawn");
  }
  return html::table(text("The gears: ", s.mesh.gear[0], " drives ", s.mesh.gear[1], "."),
                     {"", "unit", s.mesh.gear[0] + " (driver)", s.mesh.gear[1] + " (driven)"}, rows) +
         html::table("Their mesh.", {"", "unit", "value"},
                     {{"centre distance", "mm", shown(pair.centre_distance() * kMilli, 7)},
                      {"working pressure angle", "deg", degrees(pair.working_pressure_angle())},
                      {"base pitch", "mm", fixed(pair.base_pitch() * kMilli, 4)},
                      {"contact ratio", "–", fixed(pair.contact_ratio(), 4)},
                      {"path of contact before the pitch point", "mm", fixed(-pair.path_start() * kMilli, 3)},
                      {"path of contact after it", "mm", fixed(pair.path_end() * kMilli, 3)},
                      {"backlash along the line of action", "mm",
                       std::abs(pair.backlash()) < kNoBacklash ? "none" : fixed(pair.backlash() * kMilli, 4)},
                      {"tip edges off the line of action", "", corner_words(s.mesh.corner)}});
}

std::string stiffness_tables(const ReportContent& c) {
  std::string out;
  for (const WordTable& t : {compliance_table(c.statics[0]), iso_table(c.statics[0])})
    out += html::table(t.caption, t.head, t.rows);
  return out;
}

std::string natural_frequencies_table(const ReportContent& c) {
  html::Rows rows;
  for (const ImpactResult& a : c.impacts)
    for (Index i = 0; i < a.natural_frequency.size(); ++i)
      rows.push_back({shown(a.torque, 6),
                      i < a.state_phase.size() ? name_of(a.contact_state[static_cast<size_t>(i)])
                                               : "mean over the mesh period",
                      fixed(a.natural_frequency[i], 1), fixed(a.damping_ratio[i] * kPercent, 3),
                      fixed(a.undamped_frequency[i], 1)});
  return html::table(
             "Natural frequency and damping ratio of the mesh by ring-down: the gears are at a fixed mesh phase, a part of the torque is let go, and the decay is fitted.",
             {"torque (N m)", "loaded tooth pairs", "by ring-down (Hz)", "damping ratio (%)",
              "contact frozen, undamped (Hz)"},
             rows) +
         html::paragraph(
             "Three kinds of natural frequency stand on this page. By ring-down: of the decay, damped, the contact free to change. Contact frozen, undamped: the eigenvalue at the same phases, with the contact that the load leaves kept as it is. f_n in the figures of motion: the mean of that eigenvalue over phases of the mesh period that need not be those of the ring-downs, under the static load; resonances stand near it and its fractions.") +
         bearing_frequencies_table(c);
}

namespace {

// Largest root stress with elements of several sizes; "" where none is known.
std::string root_refinement_table(const ErrorBudgetResult& b) {
  if (b.root.element_size.size() == 0) return "";
  const RootConvergence found = convergence(b.root);
  html::Rows rows;
  for (int g = 0; g < kSides; ++g)
    for (Index k = 0; k < b.root.stress.rows(); ++k) {
      const bool changes = k > 0;
      const double order = k > 1 ? resolved_order(found, k - 2, g) : std::numeric_limits<double>::quiet_NaN();
      rows.push_back({b.mesh.gear[g], shown(b.root.element_size[k] * 1e3, 4),
                      fixed(b.root.stress(k, g) * 1e-6, 2),
                      changes ? fixed(found.change(k - 1, g) * kPercent, 3) : "–",
                      std::isfinite(order) ? fixed(order, 1) : "–"});
    }
  return html::table(
      "Largest root stress at rest at " + torque_words(b.torque) +
          ", with smaller elements on the roots, all else as it is. Order: p, if the error goes with the power p of the element size; none of changes below 0.02 %, which go with where the elements lie.",
      {"gear", "element on the driver's root (mm)", "root stress (MPa)", "change (%)", "order"}, rows);
}

}  // namespace

std::string budget_table(const ErrorBudgetResult& b) {
  html::Rows rows;
  const auto add = [&](const StaticChanges& changes, const std::string& what) {
    std::string rest = changes.entry;
    for (Index i = 0; i < changes.mean_stiffness_change.size(); ++i) {
      const size_t comma = rest.find(", ");
      // Without the sign of a change that rounds to 0.
      const auto percent = [](double share) {
        return fixed(std::abs(share * kPercent) < 5e-5 ? 0 : share * kPercent, 4);
      };
      rows.push_back({what, rest.substr(0, comma), percent(changes.mean_stiffness_change[i]),
                      percent(changes.peak_to_peak_change[i]), percent(changes.harmonic_change(i, 0)),
                      i < changes.pressure_change.size() ? percent(changes.pressure_change[i]) : "–",
                      i < changes.root_stress_change.size() ? percent(changes.root_stress_change[i]) : "–"});
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
  };
  add(b.refinement, "error");
  add(b.choice, "other model");
  return html::table("What each refinement alone changes in the statics at " + torque_words(b.torque) +
                         ". Another model is no error of this one and in no sum.",
                     {"", "change", "mean stiffness (%)", "peak to peak (%)", "harmonic 1 (%)",
                      "flank pressure (%)", "root stress (%)"},
                     rows) +
         root_refinement_table(b) +
         (b.choice_missing.empty() ? "" : html::paragraph("Not computed: " + b.choice_missing + "."));
}

std::string parameters_table(const ReportContent& c) {
  const std::vector<SceneKey> keys =
      c.sweeps.empty() ? scene_keys_of(c.statics[0]) : scene_keys_of(c.sweeps[0]);
  html::Rows rows;
  for (const SceneKey& key : keys)
    rows.push_back({key.section, key.name, key.value[0], key.value[1], key.meaning});
  std::string torques;
  for (const auto& s : c.statics) torques += (torques.empty() ? "" : ", ") + shown(s.torque, 6);
  rows.push_back(
      {"operation", "torque_Nm", torques, "", "torque on the driver; the first sets the bearing dampers"});
  if (!c.sweeps.empty()) {
    const Eigen::VectorXd& f = c.sweeps[0].mesh_frequency;
    rows.push_back({"operation", "mesh_frequency_Hz",
                    text(shown(f.minCoeff(), 6), " to ", shown(f.maxCoeff(), 6), ", ", f.size(), " speeds"),
                    "", "speeds of a sweep"});
  }
  return html::table(
      "Every value of the scene that went into the results, defaults included, in the scene's units.",
      {"section", "key", c.statics[0].mesh.gear[0] + ", or all", c.statics[0].mesh.gear[1], "meaning"}, rows,
      "small");
}

namespace {

// A sweep that takes wide steps may leave a branch before its end, with the largest values that stand there.
std::vector<Remark> wide_steps(const ResponseResult& r) {
  constexpr double kWide =
      0.02;  // of the speed: pairs that were tried lost a quarter of their largest load at 3 to 5 %
  const Eigen::VectorXd& f = r.mesh_frequency;
  for (double jump : r.jump_frequency) {
    Index at = 1;
    while (at + 1 < f.size() && (f[at] - jump) * (f[0] - jump) > 0) ++at;
    const double step = f.size() > 1 ? std::abs(f[at] - f[at - 1]) : 0;
    if (!(step > kWide * jump)) continue;
    return {remark(
        true, "the motion jumps at ", fixed(jump, 0), " Hz, where speeds stand ", shown(step, 3),
        " Hz apart, ", fixed(step / jump * kPercent, 1), " % of the speed: with steps above ",
        shown(kWide * kPercent, 2),
        " % a sweep may leave a branch before its end, and its largest values with it. Give mesh_frequency_Hz a step of ",
        fixed(0.01 * jump, 0), " Hz, or follow the branch with BRANCHES=yes")};
  }
  return {};
}

// Words with their numbers apart: what stands between is the same in remarks that differ by torque alone.
struct NumberedWords {
  std::vector<std::string> between, numbers;  // one more of the first

  explicit NumberedWords(const std::string& words) : between{""} {
    const auto in_name = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; };
    for (size_t i = 0; i < words.size();) {
      const bool digit = std::isdigit(static_cast<unsigned char>(words[i])) != 0;
      if (!digit || (i > 0 && in_name(words[i - 1]))) {
        between.back() += words[i++];
        while (digit && i < words.size() && std::isdigit(static_cast<unsigned char>(words[i])))
          between.back() += words[i++];
        continue;
      }
      char* end = nullptr;
      (void)std::strtod(words.c_str() + i, &end);
      auto length = static_cast<size_t>(end - words.c_str()) - i;
      if (words[i + length - 1] == '.') --length;  // the end of a sentence
      numbers.push_back(words.substr(i, length));
      between.emplace_back();
      i += length;
    }
  }
  // Of one kind: alike but for numbers that are sizes. Speeds are places: those of two torques have no range in common, but
  // can be listed.
  bool alike(const NumberedWords& other) const {
    if (between != other.between) return false;
    const bool speeds = std::any_of(between.begin(), between.end(), [](const std::string& words) {
      return words.find("Hz") != std::string::npos;
    });
    if (!speeds) return true;
    for (size_t k = 0; k < numbers.size(); ++k)
      if (numbers[k] != other.numbers[k] && !speed(k) && !between[k + 1].starts_with(" %")) return false;
    return true;
  }
  // Whether a number is a speed by itself, no end of a range and none of a list.
  bool speed(size_t k) const {
    return between[k + 1].starts_with(" Hz") && !between[k].ends_with(" to ") && !between[k].ends_with(", ");
  }
};

// Remarks of one kind of artifact: what is said at several torques is said once, with them and with the range of its numbers.
class RemarksByTorque {
 public:
  void add(const std::string& way, double torque, const std::vector<Remark>& remarks) {
    for (const Remark& r : remarks) {
      const NumberedWords words(r.words);
      auto said = std::find_if(said_.begin(), said_.end(), [&](const Said& s) {
        return s.warning == r.warning && s.all.front().alike(words);
      });
      if (said == said_.end()) said = said_.insert(said_.end(), {r.warning, {}, {}});
      said->all.push_back(words);
      auto at = std::find_if(said->places.begin(), said->places.end(),
                             [&](const Place& place) { return place.way == way; });
      if (at == said->places.end()) at = said->places.insert(said->places.end(), {way, {}});
      // One artifact may say the same of two places.
      const std::string here = shown(torque, 6);
      if (at->torques.empty() || at->torques.back() != here) at->torques.push_back(here);
    }
  }

  // Items of a list; adds to `warned`.
  std::string items(bool& warned) const {
    std::vector<std::pair<std::string, std::vector<Remark>>> of_place;
    for (const Said& said : said_) {
      warned = warned || said.warning;
      const std::string where = words_of(said.places);
      auto place = std::find_if(of_place.begin(), of_place.end(),
                                [&](const auto& other) { return other.first == where; });
      if (place == of_place.end()) place = of_place.insert(of_place.end(), {where, {}});
      place->second.push_back({said.warning, said.words()});
    }
    std::string out;
    for (const auto& [where, remarks] : of_place) out += remark_items(where, remarks);
    return out;
  }

 private:
  struct Place {
    std::string way;                   // "speed rising"
    std::vector<std::string> torques;  // N m
  };
  struct Said {
    bool warning;
    std::vector<NumberedWords> all;
    std::vector<Place> places;

    static double value(const std::string& number) { return std::strtod(number.c_str(), nullptr); }

    // "the teeth swing 2.9 to 37.2 µm apart"
    std::string words() const {
      std::string out = all.front().between.front();
      for (size_t k = 0; k < all.front().numbers.size(); ++k) {
        const auto less = [&](const NumberedWords& a, const NumberedWords& b) {
          return value(a.numbers[k]) < value(b.numbers[k]);
        };
        if (all.front().speed(k) && (" " + all.front().between[k]).ends_with(" at ")) {
          std::vector<std::string> speeds;
          for (const NumberedWords& one : all)
            if (std::find(speeds.begin(), speeds.end(), one.numbers[k]) == speeds.end())
              speeds.push_back(one.numbers[k]);
          std::sort(speeds.begin(), speeds.end(),
                    [](const auto& a, const auto& b) { return value(a) < value(b); });
          out += listed(speeds) + all.front().between[k + 1];
          continue;
        }
        const auto [low, high] = std::minmax_element(all.begin(), all.end(), less);
        out += low->numbers[k];
        if (value(low->numbers[k]) < value(high->numbers[k])) out += " to " + high->numbers[k];
        out += all.front().between[k + 1];
      }
      return out;
    }
  };

  // "speed rising and speed falling, 100, 150 and 200 N m"; "speed rising, 100 N m; speed falling, 100 and 150 N m"
  static std::string words_of(const std::vector<Place>& places) {
    std::string out;
    for (size_t i = 0; i < places.size();) {
      std::vector<std::string> ways;
      size_t end = i;
      while (end < places.size() && places[end].torques == places[i].torques)
        ways.push_back(places[end++].way);
      out += text(out.empty() ? "" : "; ", listed(ways), ", ", listed(places[i].torques), " N m");
      i = end;
    }
    return out;
  }

  std::vector<Said> said_;
};

}  // namespace

std::string remarks_list(const ReportContent& c) {
  RemarksByTorque at_rest, ring_downs, in_motion;
  for (const StaticResult& s : c.statics) at_rest.add("at rest", s.torque, s.remarks);
  for (const ImpactResult& a : c.impacts) {
    std::vector<Remark> found;
    for (Index i = 0; i < a.state_phase.size(); ++i)
      if (const double ratio = a.damping_ratio[i]; ratio < 0.01 || ratio > 0.12)
        found.push_back(
            remark(true, "the damping ratio by ring-down with ", a.contact_state[static_cast<size_t>(i)],
                   a.contact_state[static_cast<size_t>(i)] == ContactState::one ? " pair" : " pairs",
                   " in contact is ", shown(ratio * kPercent, 3),
                   " %, outside 1 to 12 %; `make calibrate` finds the damping for a ratio"));
    ring_downs.add("ring-down", a.torque, found);
  }
  for (const ResponseResult& s : c.sweeps) {
    std::vector<Remark> found = s.remarks;
    const std::vector<Remark> wide = wide_steps(s);
    found.insert(found.begin(), wide.begin(), wide.end());
    for (const StaticResult& at : c.statics) {
      if (at.torque != s.torque) continue;
      if (const double pressure = hertz_contact(at, s.tooth_load_max.maxCoeff()).pressure;
          pressure > kHardenedSteelPressure)
        found.push_back(
            remark(true, "the contact pressure of the largest tooth load (Hertz, at the pitch point) of ",
                   fixed(pressure * 1e-9, 2), kBeyondSteel));
    }
    in_motion.add(way_words(s), s.torque, found);
  }
  bool warned = false;
  std::string out = at_rest.items(warned) + ring_downs.items(warned) + in_motion.items(warned);
  if (c.budget && !c.budget->choice_missing.empty())
    out +=
        html::tagged("li", html::escaped("error budget: not computed: " + c.budget->choice_missing)) + "\n";
  return remark_list(out, warned);
}

}  // namespace whine
