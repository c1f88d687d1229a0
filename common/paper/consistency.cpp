#include "paper/consistency.h"

#include <algorithm>
#include <iomanip>
#include <map>
#include <numbers>
#include <numeric>
#include <sstream>

#include "base/error.h"
#include "io/artifacts.h"
#include "io/readings_result.h"
#include "paper/scorecard.h"

namespace whine {
namespace {

constexpr size_t kShownConflicts = 20;
constexpr double kCommon = 0.1;  // share of the readings in which a claim of a conflict holds

bool holds(const Reading& r, size_t claim) {
  const auto v = static_cast<Verdict>(r.verdict[claim]);
  return v == Verdict::agrees || v == Verdict::given || v == Verdict::fitted;
}

bool can_fail(Verdict v) {
  return v == Verdict::agrees || v == Verdict::differs || v == Verdict::fitted;
}

std::string number(double value, int digits) {
  std::ostringstream out;
  out << std::setprecision(digits) << value;
  return out.str();
}

SetFound look_for(const ClaimSet& set, const ReadingsResult& a, const std::map<std::string, size_t>& index,
                  const std::vector<size_t>& order) {
  SetFound out;
  out.set = set;
  bool any = false;
  for (const size_t i : order) {
    bool whole = false;
    for (const std::vector<std::string>& claims : set.alternatives) {
      std::vector<std::string> failing;
      for (const std::string& id : claims) {
        const auto found = index.find(id);
        if (found == index.end())
          fail(Failure::input, "the set '", set.name, "' names the claim '", id,
               "', which does not exist; gear-scorecard --claims lists them");
        if (!holds(a.readings[i], found->second)) failing.push_back(id);
      }
      whole = whole || failing.empty();
      if (any && failing.size() >= out.failing.size()) continue;
      any = true;
      out.closest = i;
      out.size = static_cast<int>(claims.size());
      out.failing = failing;
    }
    out.readings += whole;
  }
  return out;
}

}  // namespace

Consistency consistency(const ReadingsResult& a, const std::vector<ClaimSet>& sets) {
  if (a.readings.empty()) fail(Failure::input, "there are no readings; make out/reading/readings.h5 again");
  Consistency out;
  std::map<std::string, size_t> index;
  for (size_t c = 0; c < a.claim.size(); ++c) index[a.claim[c]] = c;
  for (const Reading& r : a.readings)
    out.agreeing.push_back(
        static_cast<int>(std::count(r.verdict.begin(), r.verdict.end(), static_cast<int>(Verdict::agrees))));
  out.order.resize(a.readings.size());
  std::iota(out.order.begin(), out.order.end(), 0);
  std::stable_sort(out.order.begin(), out.order.end(),
                   [&](size_t i, size_t j) { return out.agreeing[i] > out.agreeing[j]; });

  std::vector<int> satisfied(a.claim.size(), 0);
  for (size_t c = 0; c < a.claim.size(); ++c) {
    bool open = false;
    for (const Reading& r : a.readings) {
      satisfied[c] += holds(r, c);
      open = open || can_fail(static_cast<Verdict>(r.verdict[c]));
    }
    if (open && satisfied[c] == 0) out.never.push_back(a.claim[c]);
  }
  for (const ClaimSet& set : sets) out.sets.push_back(look_for(set, a, index, out.order));

  const double common = kCommon * static_cast<double>(a.readings.size());
  for (size_t c = 0; c < a.claim.size(); ++c)
    for (size_t d = c + 1; d < a.claim.size(); ++d) {
      if (satisfied[c] < common || satisfied[d] < common) continue;
      const bool together = std::any_of(a.readings.begin(), a.readings.end(),
                                        [&](const Reading& r) { return holds(r, c) && holds(r, d); });
      if (!together) out.conflicts.push_back({a.claim[c], a.claim[d], satisfied[c], satisfied[d]});
    }
  std::stable_sort(out.conflicts.begin(), out.conflicts.end(), [](const Conflict& a, const Conflict& b) {
    return std::min(a.with_one, a.with_other) > std::min(b.with_one, b.with_other);
  });
  return out;
}

std::string words_of(const Reading& r) {
  const OpenChoices& c = r.choices;
  const std::string corner =
      !c.corner.enabled ? "no corner contact"
      : std::isinf(c.corner.largest_angle)
          ? "corner contact at any angle"
          : "corner contact to " + number(c.corner.largest_angle * 180 / std::numbers::pi, 3) + "°";
  return text("dedendum ", number(c.dedendum, 4), ", rack tip ", number(r.rack_tip_radius, 3),
              c.tooth_thinning > 0 ? text(", thinning ", number(1e3 * c.tooth_thinning, 3), " mm") : "",
              ", plane ", c.plane, ", bore ", number(1e3 * r.bore_radius, 4), " mm, ", corner, ", inertia ",
              number(1e3 * r.total_inertia, 4), "e-3 kg m² (", c.inertia_from,
              c.frequency_offset != 0 ? text(" ", number(100 * c.frequency_offset, 2), " %") : "",
              "), 7 % with ", c.damped_state, ", µ ", number(r.rayleigh_mass, 4), " 1/s, η ",
              number(1e6 * r.rayleigh_stiffness, 3), " µs, undamped to ", number(1e3 * c.undamped_depth, 3),
              " mm, ", c.steps_per_period, " steps");
}

std::string claim_sets_tsv(const ReadingsResult& a, const Consistency& found) {
  const auto listed = [](const std::vector<std::string>& ids) {
    std::string out;
    for (const std::string& id : ids) out += (out.empty() ? "" : ", ") + id;
    return out.empty() ? std::string("none") : out;
  };
  std::ostringstream out;
  out << "# " << a.readings.size() << " readings, " << a.outside
      << " more outside the model's range; most claims that agree in one reading: "
      << found.agreeing[found.order.front()]
      << "\n# claims that no reading satisfies: " << listed(found.never)
      << "\n# pairs of claims that hold in a tenth of the readings each and in none together: "
      << found.conflicts.size() << "\n";
  for (size_t i = 0; i < std::min(kShownConflicts, found.conflicts.size()); ++i) {
    const Conflict& c = found.conflicts[i];
    out << "#   " << c.one << " in " << c.with_one << ", " << c.other << " in " << c.with_other << "\n";
  }
  out << "# set\tclaims\treadings with all\tclosest reading lacks\tclosest reading\n";
  for (const SetFound& s : found.sets)
    out << s.set.name << "\t" << s.set.says << "\t" << s.readings << "\t"
        << (s.failing.empty() ? "nothing" : text(s.failing.size(), " of ", s.size, ": ", listed(s.failing)))
        << "\t" << words_of(a.readings[s.closest]) << "\n";
  return out.str();
}

std::string confirmed_tsv(const ReadingsResult& confirmed) {
  std::ostringstream out;
  out << "# The best readings again with strips and speeds 20 Hz apart, on the bodies of the search; jumps at 150 N m, the one down where it is above 0.575 f_n\n"
      << "# claims that agree\tjump up (Hz)\tjump down (Hz)\treading\n";
  const Consistency found = consistency(confirmed, {});
  for (const size_t i : found.order) {
    const Reading& r = confirmed.readings[i];
    out << found.agreeing[i] << "\t" << (r.jump_up > 0 ? number(r.jump_up, 4) : "none") << "\t"
        << (r.jump_down > 0 ? number(r.jump_down, 4) : "below") << "\t" << words_of(r) << "\n";
  }
  return out.str();
}

std::string readings_tsv(const ReadingsResult& a, const Consistency& found) {
  std::ostringstream out;
  out << std::setprecision(6);
  out << "# Readings of P2000, those with the most agreeing claims first; verdicts: 0 agrees, 1 differs, 2 given, 3 fitted, 4 cannot be compared, 5 misprint\n";
  out << "agreeing\tdedendum\track_tip_radius\ttooth_thinning_mm\tplane\tcorner_deg\tbore_mm\tinertia_kgm2\tinertia_from\tfrequency_offset_percent\tdamped_state\tmass_share\trayleigh_mass_per_s\trayleigh_stiffness_s\tundamped_depth_mm\tsteps_per_period\tlevel_ratio\tfirst_harmonic\tjump_up_Hz\tjump_down_Hz";
  for (const std::string& claim : a.claim) out << "\t" << claim;
  out << "\n";
  for (const size_t i : found.order) {
    const Reading& r = a.readings[i];
    const OpenChoices& c = r.choices;
    const double angle = !c.corner.enabled ? 0 : std::min(c.corner.largest_angle, std::numbers::pi);
    out << found.agreeing[i] << "\t" << c.dedendum << "\t" << r.rack_tip_radius << "\t"
        << 1e3 * c.tooth_thinning << "\t" << c.plane << "\t" << angle * 180 / std::numbers::pi << "\t"
        << 1e3 * r.bore_radius << "\t" << r.total_inertia << "\t" << c.inertia_from << "\t"
        << 100 * c.frequency_offset << "\t" << c.damped_state << "\t" << c.mass_share << "\t"
        << r.rayleigh_mass << "\t" << r.rayleigh_stiffness << "\t" << 1e3 * c.undamped_depth << "\t"
        << c.steps_per_period << "\t" << r.level_ratio << "\t" << r.first_harmonic << "\t" << r.jump_up
        << "\t" << r.jump_down;
    for (const int v : r.verdict) out << "\t" << v;
    out << "\n";
  }
  return out.str();
}

}  // namespace whine
