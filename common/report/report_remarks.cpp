#include "report/report_remarks.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>

#include "base/error.h"
#include "gear/hertz.h"
#include "report/figures.h"
#include "report/html.h"
#include "report/report_page.h"

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

std::string remarks_list(const ReportContent& c) {
  RemarksByTorque at_rest, ring_downs, in_motion;
  for (const StaticResult& s : c.statics) at_rest.add("at rest", s.torque, s.remarks);
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
    ring_downs.add("ring-down", impact.torque, found);
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
  const TurningMember driver = driver_of(c);
  std::string out =
      at_rest.items(driver, warned) + ring_downs.items(driver, warned) + in_motion.items(driver, warned);
  if (c.budget && !c.budget->choice_missing.empty())
    out +=
        html::tagged("li", html::escaped("error budget: not computed: " + c.budget->choice_missing)) + "\n";
  return remark_list(out, warned);
}

}  // namespace whine
