#include "report/report_remarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>

#include "base/error.h"
#include "gear/hertz.h"
#include "gear/system_layout.h"
#include "report/alike_meshes.h"
#include "report/figures.h"
#include "report/html.h"
#include "signal/response.h"

namespace whine {
namespace {

using Eigen::Index;

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

constexpr double kSamePeak = 0.01;        // of the RMS: below it rising and falling speed have one motion
constexpr double kLargeImbalance = 1e-6;  // of the throughput
constexpr double kSharpPeak = 2;          // of the RMS at the neighbouring speeds

// "800 to 950, 1200": Hz; "" if no row is marked.
std::string speeds_where(const ResponseResult& a, const auto& marks) {
  std::map<double, bool> marked;
  for (Index i = 0; i < a.mesh_frequency.size(); ++i) marked[a.mesh_frequency[i]] = marks(i);
  return speed_ranges(marked);
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
  // Rows stand by rising or by falling speed.
  std::string out;
  const bool falling = a.mesh_frequency.size() > 1 && a.mesh_frequency[1] < a.mesh_frequency[0];
  for (Index k = 1; k + 1 < a.mesh_frequency.size(); ++k) {
    const Index i = falling ? a.mesh_frequency.size() - 1 - k : k;
    if ((a.dte_rms.row(i).array() >
         kSharpPeak * a.dte_rms.row(i - 1).array().max(a.dte_rms.row(i + 1).array()))
            .any())
      out += (out.empty() ? "" : ", ") + shown(a.mesh_frequency[i], 5);
  }
  return out;
}

// Whether the planets of these meshes stand at equal angles about their carrier.
bool equally_spaced(const System& s, const std::vector<size_t>& meshes) {
  std::vector<double> angles;
  angles.reserve(meshes.size());
  for (const size_t m : meshes)
    for (const System::Side& side : s.meshes[m].side) {
      const System::Body& planet = s.bodies[static_cast<size_t>(side.body)];
      if (planet.on == System::kGround) continue;
      const System::Body& carrier = s.bodies[static_cast<size_t>(planet.on)];
      angles.push_back(
          std::atan2(planet.centre[1] - carrier.centre[1], planet.centre[0] - carrier.centre[0]));
    }
  std::sort(angles.begin(), angles.end());
  const double step = 2 * std::numbers::pi / static_cast<double>(angles.size());
  for (size_t i = 1; i < angles.size(); ++i)
    if (std::abs(angles[i] - angles[i - 1] - step) > 1e-6) return false;
  return true;
}

// What no stage says, because it is of several meshes: pressure and tip edges of those that are alike, sharing, rigid axes.
std::vector<Remark> remarks_on_meshes(const SystemStaticResult& a) {
  constexpr double kSmall = 0.01;   // of the largest load of a pair
  constexpr double kUnequal = 1.3;  // of an equal share
  const System& s = a.settings.layout;
  std::vector<Remark> out;
  for (const auto& [name, meshes] : alike_meshes(a)) {
    double pressure = 0, edge = 0, most = 0;
    for (const size_t m : meshes) {
      pressure = std::max(pressure, a.mesh[m].contact_pressure.maxCoeff());
      edge = std::max(edge, tip_edge_load(a.mesh[m]));
      most = std::max(most, a.mesh[m].tooth_load.maxCoeff());
    }
    const std::string of = name.empty() ? "" : name + ": ";
    if (a.of_train() && pressure > kHardenedSteelPressure)
      out.push_back(remark(true, of, "the contact pressure of ", fixed(pressure * 1e-9, 2), kBeyondSteel));
    if (edge > kSmall * most)
      out.push_back(remark(false, of, "tip edges of bent teeth carry up to ", fixed(edge, 0), " N, ",
                           fixed(edge / most * kPercent, 0),
                           " % of the largest tooth load; tip relief takes that away"));
  }
  if (!a.of_train()) return out;
  for (const LoadSharing& of : load_sharing(a))
    out.push_back(
        remark(of.factor > kUnequal, of.name, ": the most loaded of ", of.meshes.size(),
               " meshes carries up to ", fixed(of.factor, 3), " times an equal share",
               of.factor <= kUnequal ? ""
               : equally_spaced(s, of.meshes)
                   ? ". Let a central gear float on a softer [[bearing]]"
                   : ". Let a central gear float on a softer [[bearing]], or space the planets equally"));
  std::string rigid;
  for (const System::Body& body : s.bodies)
    if (!body.bearing.elastic()) rigid += (rigid.empty() ? "" : ", ") + body.name;
  if (!rigid.empty()) out.push_back(remark(false, "on rigid axes, without motion in x and y: ", rigid));
  out.push_back(remark(
      false, "largest unbalance of a torque over the largest mesh force: ", shown(a.torque_residual, 2)));
  return out;
}

std::vector<Remark> remarks_on_modes(const ModesResult& a) {
  std::vector<Remark> out;
  const auto mixed = std::count(a.type.begin(), a.type.end(), ModeType::mixed);
  if (mixed > 0)
    out.push_back(remark(
        false, mixed,
        " modes are mixed: the planets are not alike or not equally spaced, so that modes are neither purely rotational nor translational"));
  if (a.frozen_frequency.size() > 0)
    out.push_back(remark(
        false,
        "elastic modes of the gear bodies themselves are left out; frequencies near or above the lowest of a body (eigenfrequency in its body.h5) are not to be trusted"));
  if (a.turning_frequency.size() > 0)
    out.push_back(remark(
        false,
        "frequencies and shapes are those of a carrier at rest; Coriolis and centrifugal terms shift the former by up to ",
        shown((a.turning_frequency.bottomRows<1>() - a.turning_frequency.topRows<1>()).cwiseAbs().maxCoeff(),
              3),
        " Hz at a mesh frequency of ", shown(a.turning_mesh_frequency.tail<1>()[0], 4),
        " Hz, in proportion to speed: Campbell diagram"));
  else if (has_planets(a.layout))
    out.push_back(remark(
        false, "Coriolis and centrifugal terms of a turning carrier are left out, of the relative size ",
        "2 times its speed over the natural frequency"));
  return out;
}

// Items of a list, at most a dozen of one place, speeds with the rotation of `member`.
std::string remark_items(const std::string& where, const std::vector<Remark>& remarks,
                         const TurningMember& member) {
  constexpr size_t kMost = 12;  // of one artifact
  std::string out;
  for (size_t i = 0; i < std::min(remarks.size(), kMost); ++i)
    out += html::tagged(remarks[i].warning ? "li class=\"warning\"" : "li",
                        (remarks[i].warning ? "<strong>Warning.</strong> " : "") +
                            html::escaped(where + ": " + with_rpm(member, remarks[i].words)) + ".") +
           "\n";
  if (remarks.size() > kMost)
    out += html::tagged("li", html::escaped(text(where, ": ", remarks.size() - kMost, " more of these."))) +
           "\n";
  return out;
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
  std::string items(const TurningMember& member, bool& warned) const {
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
    for (const auto& [where, remarks] : of_place) out += remark_items(where, remarks, member);
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

std::vector<Remark> remarks_on_sweep(const ReportContent& c, const ResponseResult& a) {
  std::vector<Remark> out = wide_steps(a);
  out.insert(out.end(), a.remarks.begin(), a.remarks.end());
  const double torque = torque_of(a);
  for (const SystemStaticResult& at : c.statics)
    for (size_t m = 0; m < at.mesh.size() && torque_of(at) == torque; ++m)
      if (const double pressure =
              hertz_contact(at.mesh[m], a.tooth_load_max.col(static_cast<Index>(m)).maxCoeff()).pressure;
          pressure > kHardenedSteelPressure)
        out.push_back(remark(true, at.mesh.size() > 1 ? at.mesh_names[m] + ": " : "",
                             "the contact pressure of the largest tooth load (Hertz, at the pitch point) of ",
                             fixed(pressure * 1e-9, 2), kBeyondSteel));
  if (a.of_train()) {  // a sweep of a pair says so itself
    const auto open = [&](Index i) { return a.period_multiple[i] == 0; };
    if (const auto count = (a.period_multiple.array() == 0).count(); count > 0)
      out.push_back(remark(true, "the motion does not repeat at ", count, " of ", a.mesh_frequency.size(),
                           " speeds (", speeds_where(a, open),
                           " Hz): values there are of the recorded mesh periods alone"));
    if (a.energy_imbalance.maxCoeff() > kLargeImbalance)
      out.push_back(remark(true, shown(a.energy_imbalance.maxCoeff(), 2),
                           " of the energy that goes through is not accounted for; raise steps_per_period"));
  }
  if (const std::string loss =
          speeds_where(a, [&](Index i) { return a.separation_fraction.row(i).maxCoeff() > 0; });
      !loss.empty()) {
    std::string meshes;
    for (Index m = 0; m < a.meshes(); ++m)
      if (a.separation_fraction.col(m).maxCoeff() > 0)
        meshes += (meshes.empty() ? " (" : ", ") + a.mesh_names[static_cast<size_t>(m)];
    out.push_back(remark(false, "teeth part at ", loss, " Hz", a.meshes() > 1 ? meshes + ")" : "",
                         ": the vibration is nonlinear there"));
  }
  const ResponseResult* other =
      sweep_of(c, torque, a.direction == Direction::up ? Direction::down : Direction::up);
  if (a.direction == Direction::down && other) return out;
  if (const std::string two =
          other ? speeds_where(a, [&](Index i) { return differs(a, i, *other); }) : std::string();
      !two.empty())
    out.push_back(remark(false, "rising and falling speed lead to different motions at ", two,
                         " Hz: the vibration jumps at the ends of these ranges"));
  if (const std::string sharp = sharp_peaks(a); !sharp.empty())
    out.push_back(remark(
        true, "peaks at ", sharp, " Hz are one speed wide, of more than ", fixed(kSharpPeak, 0),
        " times the RMS beside them: their height is that of the step of mesh_frequency_Hz; lower it, or give the bearings their damping"));
  std::string undamped;
  for (const System::Body& body : a.layout.bodies)
    if (body.bearing.elastic() && body.bearing.damping == 0)
      undamped += (undamped.empty() ? "" : ", ") + body.name;
  if (!undamped.empty())
    out.push_back(remark(false, "no damping_Ns_m in the [[bearing]] of ", undamped,
                         ": where a resonance moves it on its bearing, the height has no meaning"));
  return out;
}

std::string remarks_list(const ReportContent& c) {
  RemarksByTorque at_rest, ring_downs, in_motion;
  for (const SystemStaticResult& s : c.statics) {
    at_rest.add("at rest", torque_of(s), s.remarks);
    at_rest.add("at rest", torque_of(s), remarks_on_meshes(s));
  }
  for (const ImpactResult& impact : c.impacts) {
    const ContactStateDecays& a = impact.states;
    std::vector<Remark> found;
    for (Index i = 0; i < a.mesh_phase.size(); ++i)
      if (const double ratio = a.damping_ratio[i]; ratio < 0.01 || ratio > 0.12)
        found.push_back(
            remark(true, "the damping ratio by ring-down with ", a.contact_state[static_cast<size_t>(i)],
                   a.contact_state[static_cast<size_t>(i)] == ContactState::one ? " pair" : " pairs",
                   " in contact is ", shown(ratio * kPercent, 3),
                   " %, outside 1 to 12 %; `make calibrate` finds the damping for a ratio"));
    ring_downs.add("ring-down", torque_of(impact), found);
  }
  for (const ResponseResult& s : c.sweeps) in_motion.add(way_words(s), torque_of(s), remarks_on_sweep(c, s));
  bool warned = false;
  const TurningMember driver = driver_of(c);
  std::string out = at_rest.items(driver, warned) + ring_downs.items(driver, warned);
  if (c.modes) out += remark_items("natural modes", remarks_on_modes(*c.modes), driver);
  out += in_motion.items(driver, warned);
  if (c.budget && !c.budget->choice_missing.empty())
    out +=
        html::tagged("li", html::escaped("error budget: not computed: " + c.budget->choice_missing)) + "\n";
  return (warned ? "" : html::paragraph("No stage warns of anything.")) +
         (out.empty() ? "" : html::tagged("ul class=\"remarks\"", "\n" + out) + "\n");
}

}  // namespace whine
