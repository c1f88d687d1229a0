#include "report/speed_words.h"

#include <algorithm>
#include <regex>

#include "base/error.h"
#include "base/format.h"
#include "report/report_content.h"

namespace whine {
namespace {

// "1000 to 2640"; one number where both round to it.
std::string range_words(double from, double to) {
  const std::string first = fixed(from, 0), last = fixed(to, 0);
  return first == last ? first : first + " to " + last;
}

}  // namespace

std::vector<SpeedRange> marked_ranges(const std::map<double, bool>& speeds) {
  std::vector<SpeedRange> out;
  bool open = false;
  for (const auto& [speed, marked] : speeds) {
    if (marked && open) out.back().to = speed;
    if (marked && !open) out.push_back({speed, speed});
    open = marked;
  }
  return out;
}

std::map<double, bool> but_not(std::map<double, bool> speeds, const std::map<double, bool>& others) {
  for (auto& [speed, marked] : speeds)
    if (const auto other = others.find(speed); other != others.end() && other->second) marked = false;
  return speeds;
}

std::string speed_words(const TurningMember& member, double f) {
  return speed_words(member, {{f, f}});
}

std::string speed_words(const TurningMember& member, const std::vector<SpeedRange>& all) {
  constexpr size_t kMost = 4;
  std::vector<SpeedRange> ranges = all;
  if (all.size() > kMost) {
    std::stable_sort(ranges.begin(), ranges.end(),
                     [](const SpeedRange& a, const SpeedRange& b) { return a.to - a.from > b.to - b.from; });
    ranges.resize(kMost);
    std::sort(ranges.begin(), ranges.end(),
              [](const SpeedRange& a, const SpeedRange& b) { return a.from < b.from; });
  }
  std::vector<std::string> words;
  words.reserve(ranges.size() + 1);
  for (const SpeedRange& range : ranges) {
    const std::string in_hertz = range_words(range.from, range.to) + " Hz";
    words.push_back(member.turns > 0 ? text(range_words(member.rpm(range.from), member.rpm(range.to)),
                                            " rpm (", in_hertz, ")")
                                     : in_hertz);
  }
  if (all.size() > kMost) words.push_back(text(all.size() - kMost, " narrower ranges"));
  return listed(words);
}

std::string with_rpm(const TurningMember& member, const std::string& words) {
  if (!(member.turns > 0)) return words;
  // A list of numbers before "Hz" that is no part of a word; "2645 ± 0.4 Hz" is one number.
  static const std::regex speeds(
      R"((^|[^A-Za-z0-9_.-])(\d+(?:\.\d+)?(?:(?: to |, | and )\d+(?:\.\d+)?)*)(?: ± \d+(?:\.\d+)?)? Hz)"),
      number(R"(\d+(?:\.\d+)?)");
  std::string out;
  std::sregex_iterator end;
  auto last = words.cbegin();
  for (std::sregex_iterator found(words.begin(), words.end(), speeds); found != end; ++found) {
    // Not those that have it before them.
    const std::string before = words.substr(0, static_cast<size_t>((*found).position(2))), list = (*found)[2];
    if (before.ends_with("rpm (") || before.ends_with("± ")) continue;
    std::string turned;
    auto from = list.cbegin();
    for (std::sregex_iterator one(list.begin(), list.end(), number); one != end; ++one) {
      turned.append(from, (*one)[0].first);
      turned += fixed(member.rpm(std::stod(one->str())), 0);
      from = (*one)[0].second;
    }
    out.append(last, (*found)[0].second);
    out += " (" + turned + " rpm)";
    last = (*found)[0].second;
  }
  out.append(last, words.cend());
  return out;
}

}  // namespace whine
