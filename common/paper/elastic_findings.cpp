#include "paper/findings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "io/artifacts.h"
#include "io/readings_result.h"
#include "signal/branches.h"
#include "signal/response.h"

namespace whine::paper {

namespace {

// Mean mesh stiffness against that at 100 N m.
double stiffening(const SceneResults& s, int torque) {
  return s.at_rest(torque).mean_stiffness / s.at_rest(kTorques[0]).mean_stiffness - 1;
}

// One printed number that the text lets one read in several ways: the reading that is nearest to it.
struct Candidate {
  std::string name;
  double value;  // in the unit of the claim
};
Finding nearest_reading(const std::vector<Candidate>& readings, double printed, const std::string& unit,
                        const std::string& note) {
  const Candidate* best = nullptr;
  std::string words;
  for (const Candidate& r : readings) {
    if (std::isnan(r.value)) continue;
    if (!best || std::abs(r.value - printed) < std::abs(best->value - printed)) best = &r;
    words += text(words.empty() ? "" : ", ", r.name, " ", digits(r.value), " ", unit);
  }
  if (!best) return {kNone, note};
  return {best->value, text("read as ", words, note.empty() ? "" : "; ", note), best->name};
}

// Where the response of a rising sweep has its summit near f_n / order.
struct Summit {
  Index row = -1;
  double speed = 0, natural_frequency = 0;
};

Summit summit(const ResponseResult& up, int order) {
  Summit found;
  found.natural_frequency = up.natural_frequency;
  const double centre = up.natural_frequency / order;
  for (Index i = 1; i + 1 < up.mesh_frequency.size(); ++i)
    if (std::abs(up.mesh_frequency[i] / centre - 1) < 0.15 && up.dte_rms(i, 0) > up.dte_rms(i - 1, 0) &&
        up.dte_rms(i, 0) >= up.dte_rms(i + 1, 0) &&
        (found.row < 0 || up.dte_rms(i, 0) > up.dte_rms(found.row, 0)))
      found.row = i;
  if (found.row >= 0) found.speed = up.mesh_frequency[found.row];
  return found;
}

constexpr std::array kLoadsOf{LoadOf::tooth, LoadOf::sum, LoadOf::sustained_tooth};
constexpr std::array kLoadsInWords{"one tooth", "sum over the teeth",
                                   "one tooth, sustained for 1/64 of a period"};

// Largest growth of the RMS across a jump of the rising sweep within 15 % of f_n / order; 0 without a jump there.
double rise(const ResponseResult& up, int order) {
  double largest = 0;
  const std::vector<Index> left = rows_before_jumps(up);
  for (size_t j = 0; j < left.size(); ++j)
    if (const Index i = left[j];
        i >= 0 &&
        std::abs(up.jump_frequency[static_cast<Index>(j)] * order / up.natural_frequency - 1) <= 0.15)
      largest = std::max(largest, up.dte_rms(i + 1, 0) - up.dte_rms(i, 0));
  return largest;
}

}  // namespace

Finding no_second_branch(const SceneResults& s, int torque, const Pair& at, double f) {
  if (!at.there()) return {kNone, text("the sweeps do not come to ", digits(f), " Hz")};
  if (like_a_jump(at.upper.rms(), at.lower.rms()))
    return {kNone, text("the upper branch at ", digits(f), " Hz is that of f_n: its largest harmonic is ",
                        at.upper.largest_harmonic(), ", not ", at.order)};
  return {kNone, text("one branch at ", digits(f), " Hz, RMS ", digits(at.upper.rms() * kMicro, 3),
                      " µm: ", excitation(s, torque))};
}

double largest_load(const SceneResults& s, const Motion& m, LoadOf what) {
  if (what == LoadOf::sum) return m.sweep->mesh_force_max(m.row, 0);
  if (what == LoadOf::tooth) return m.sweep->tooth_load_max(m.row, 0);
  const SweepResult& sweep = s.sweep(kFigureTorque, m.sweep->direction);
  return sustained_load(sweep.tooth_load[static_cast<size_t>(m.row)], sweep.time.steps_per_period);
}

Finding table_frequency(const SceneResults& s, int torque, ContactState state) {
  const ImpactResult& i = s.ring_down(torque);
  const auto row = i.states.row_of(state);
  if (!row) return {kNone, "no part of the period has " + name_of(state) + " loaded pairs"};
  const double frequency = i.states.natural_frequency[*row];
  if (state != ContactState::mean)
    return {frequency, torque == kTorques[0] ? std::string()
                                             : text("mean stiffness ", digits(100 * stiffening(s, torque), 2),
                                                    " % above that at ", kTorques[0], " N m")};
  const double loaded =
      (i.loaded_pairs.array() >= 2).cast<double>().sum() / static_cast<double>(i.loaded_pairs.size());
  std::string note =
      text("two pairs loaded for ", digits(100 * loaded, 3), " % of the period, tip edges included");
  const auto one = i.states.row_of(ContactState::one), two = i.states.row_of(ContactState::two);
  const double share = s.at_rest(torque).contact_ratio - 1;
  if (one && two)
    note += text(
        "; weighted with the ", digits(100 * share, 3), " % of the contact ratio: ",
        digits((1 - share) * i.states.natural_frequency[*one] + share * i.states.natural_frequency[*two]),
        " Hz");
  return {frequency, note};
}

Finding damping(const SceneResults& s) {
  const ImpactResult& i = s.ring_down(kFigureTorque);
  std::vector<Candidate> readings;
  for (const auto& [state, words] : {std::pair{ContactState::one, "one pair in mesh"},
                                     {ContactState::two, "two pairs in mesh"},
                                     {ContactState::mean, "mean over the cycle"}})
    if (const auto row = i.states.row_of(state))
      readings.push_back({words, 100 * i.states.damping_ratio[*row]});
  return nearest_reading(readings, 7, "%",
                         text("rayleigh_stiffness_s = ", digits(i.damping.rayleigh_stiffness, 3),
                              ", ring-down at ", kFigureTorque, " N m"));
}

Finding resonance(const SceneResults& s, int order, MotionModel model) {
  const Summit top = summit(s.branches(kFigureTorque, model).up, order);
  if (top.row < 0)
    return {kNone, text("no summit within 15 % of ", digits(top.natural_frequency / order), " Hz")};
  return {top.speed / top.natural_frequency,
          text(digits(top.speed), " Hz, f_n ", digits(top.natural_frequency), " Hz")};
}

Finding driven_by_harmonic(const SceneResults& s, int order) {
  const ResponseResult& up = s.branches(kFigureTorque).up;
  const Summit top = summit(up, order);
  if (top.row < 0) return {kNone, "no summit"};
  const int largest = Motion{&up, top.row}.largest_harmonic();
  return {largest == order ? 1.0 : 0.0, text("largest harmonic at ", digits(top.speed), " Hz: ", largest)};
}

Finding jumps_at(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque);
  if (jumps(b)) return {1, jumps_text(b)};
  return {0, text("one branch; ", loss_text(b), "; ", excitation(s, torque))};
}

Finding loses_contact(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque);
  const bool lost = !speeds_with_loss(b).empty();
  return {lost ? 1.0 : 0.0, lost ? loss_text(b) : text(loss_text(b), "; ", excitation(s, torque))};
}

Finding two_at(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) {
    Finding none = no_second_branch(s, kFigureTorque, at, f);
    none.value = 0;
    return none;
  }
  return {1, text("RMS ", digits(at.upper.rms() * kMicro, 3), " and ", digits(at.lower.rms() * kMicro, 3),
                  " µm at ", digits(at.upper.speed()), " Hz")};
}

namespace {

double load_of(const SceneResults& s, const Pair& p, Load which, LoadOf what) {
  const double lower = largest_load(s, p.lower, what), upper = largest_load(s, p.upper, what);
  return which == Load::lower ? lower : which == Load::upper ? upper : 100 * (upper / lower - 1);
}

}  // namespace

Finding load(const SceneResults& s, Load which) {
  const Pair at = printed_branches(s, kPrimary);
  if (!at.two()) {
    Finding none = no_second_branch(s, kFigureTorque, at, kPrimary);
    if (at.there())
      none.note += text("; it carries ", digits(largest_load(s, at.lower, LoadOf::tooth)),
                        " N on one tooth, ", digits(largest_load(s, at.lower, LoadOf::sum)), " N in all");
    return none;
  }
  // One reading for all three numbers: that of both loads which is nearest to P2000's 3000 and 4850 N.
  const auto off = [&](LoadOf what) {
    return std::abs(load_of(s, at, Load::lower, what) / 3000 - 1) +
           std::abs(load_of(s, at, Load::upper, what) / 4850 - 1);
  };
  const auto best =
      std::min_element(kLoadsOf.begin(), kLoadsOf.end(), [&](LoadOf a, LoadOf b) { return off(a) < off(b); });
  const std::string unit = which == Load::increase ? "%" : "N";
  std::string note = text("at ", digits(at.upper.speed()), " Hz, read as ");
  for (size_t i = 0; i < kLoadsOf.size(); ++i)
    note += text(i ? ", " : "", kLoadsInWords[i], " ", digits(load_of(s, at, which, kLoadsOf[i])), " ", unit);
  return {load_of(s, at, which, *best), note, kLoadsInWords[best - kLoadsOf.begin()]};
}

Finding upper_losses(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return {at.upper.losses(),
          text("without force for ", digits(100 * at.upper.sweep->separation_fraction(at.upper.row, 0), 3),
               " % of the period at ", digits(at.upper.speed()), " Hz")};
}

Finding lower_keeps_contact(const SceneResults& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return {at.lower.loses_contact() ? 0.0 : 1.0,
          text(digits(at.lower.losses(), 3), " losses a period at ", digits(at.lower.speed()), " Hz")};
}

Finding nearly_harmonic(const SceneResults& s, double f, int order) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double share = at.upper.share(order);
  return {share >= 0.95 ? 1.0 : 0.0, text("RMS of harmonic ", order, " is ", digits(100 * share, 3),
                                          " % of all at ", digits(at.upper.speed()), " Hz")};
}

Finding lower_more_distorted(const SceneResults& s, double f, int order) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double upper = at.upper.share(order), lower = at.lower.share(order);
  return {lower < upper ? 1.0 : 0.0, text("harmonic ", order, ": ", digits(100 * lower, 3), " % of the RMS, ",
                                          digits(100 * upper, 3), " % on the upper branch")};
}

Finding kink(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque);
  const std::vector<double> lost = speeds_with_loss(b);
  if (lost.empty()) return {kNone, text("contact never lost; ", excitation(s, torque))};
  const double ratio = lost.back() / b.up.natural_frequency;
  return {ratio >= 1 && ratio <= 1.1 ? 1.0 : 0.0,
          text(digits(lost.back()), " Hz, ", digits(ratio, 3), " f_n")};
}

Finding softening(const SceneResults& s) {
  const Branches b = s.branches(kFigureTorque);
  if (!jumps(b)) return jumps_at(s, kFigureTorque);
  // Where there are two, the larger motion is the one that falling speed leads to.
  bool any = false, all = true;
  for (double f : speeds_with_two(b)) {
    if (f < kSecondaryEnd * b.up.natural_frequency || f > b.up.jump_frequency.maxCoeff()) continue;
    any = true;
    const auto* larger = motions(b, f).upper.sweep;
    all = all && larger && larger->direction == Direction::down;
  }
  return {any && all ? 1.0 : 0.0, jumps_text(b)};
}

Finding superharmonic_weaker(const SceneResults& s) {
  const ResponseResult& up = s.branches(kFigureTorque).up;
  const double first = rise(up, 1), second = rise(up, 2), third = rise(up, 3);
  if (first == 0) return {kNone, "no jump near f_n"};
  return {second < first && third < first ? 1.0 : 0.0,
          text("rise near f_n, f_n/2, f_n/3: ", digits(first * kMicro, 3), ", ", digits(second * kMicro, 3),
               ", ", digits(third * kMicro, 3), " µm")};
}

Finding loss_down_to_the_jump(const SceneResults& s) {
  std::vector<double> kept;
  std::string at_torques;
  size_t branches_found = 0;
  double step = 0;
  for (int torque : kTorques) {
    const Branches b = s.branches(torque);
    const std::vector<double> lost = speeds_with_loss(b), two = speeds_with_two(b);
    step = step_of(b.up);
    if (two.empty()) continue;
    ++branches_found;
    at_torques += text(at_torques.empty() ? "" : ", ", torque);
    for (Index i = 0; i < b.up.mesh_frequency.size(); ++i) {
      const double f = b.up.mesh_frequency[i];
      const Pair at = motions(b, f);
      const bool above = f > two.back() && !lost.empty() && f < lost.back();
      if ((at.two() || above) && !at.upper.loses_contact()) kept.push_back(f);
    }
  }
  if (branches_found < kTorques.size())
    return {kNone, at_torques.empty()
                       ? "one branch at all three torques"
                       : text("two branches only at ", at_torques, " N m",
                              kept.empty() ? "; contact lost along all of the upper one" : "")};
  return {kept.empty() ? 1.0 : 0.0, kept.empty() ? "two branches at " + at_torques + " N m"
                                                 : "contact kept at " + speeds_text(kept, step)};
}

Finding loss_beyond_two_branches(const SceneResults& s) {
  std::string note;
  bool everywhere = true;
  for (int torque : kTorques) {
    const Branches b = s.branches(torque);
    const std::vector<double> two = speeds_with_two(b);
    std::vector<double> single;
    for (double f : speeds_with_loss(b))
      if (two.empty() || f > two.back()) single.push_back(f);
    everywhere = everywhere && !single.empty();
    note += text(note.empty() ? "" : "; ", torque, " N m: ", speeds_text(single, step_of(b.up)));
  }
  return {everywhere ? 1.0 : 0.0, note};
}

Finding lower_never_loses(const SceneResults& s) {
  std::string note, bands;
  bool ever = false;
  for (int torque : kTorques) {
    const Branches b = s.branches(torque);
    std::vector<double> lost, band;
    for (double f : speeds_with_two(b)) {
      // From there down the motion is that of the resonance at f_n / 2, which has an upper branch and losses of its own.
      if (f < kSecondaryEnd * b.up.natural_frequency) continue;
      band.push_back(f);
      if (motions(b, f).lower.loses_contact()) lost.push_back(f);
    }
    if (!band.empty())
      bands += text(bands.empty() ? "" : "; ", torque, " N m: ", speeds_text(band, step_of(b.up)));
    if (lost.empty()) continue;
    ever = true;
    note += text(note.empty() ? "lost at " : "; ", torque, " N m: ", speeds_text(lost, step_of(b.up)));
  }
  if (bands.empty()) return {kNone, "no lower branch: one branch at every torque"};
  return {ever ? 0.0 : 1.0, text(note, note.empty() ? "" : "; ", "looked at ", bands)};
}

Finding grows_with_torque(const SceneResults& s) {
  double last = 0;
  bool grows = true;
  std::string note;
  for (int torque : {100, 150, 200, 300}) {
    const double rms = largest_rms(s.branches(torque));
    grows = grows && rms > last;
    last = rms;
    note += text(note.empty() ? "" : ", ", digits(rms * kMicro, 3));
  }
  return {grows ? 1.0 : 0.0, text("largest RMS at 100, 150, 200, 300 N m: ", note,
                                  " µm; first harmonic of k at 100 and 300 N m: ",
                                  digits(100 * first_harmonic_share(s.at_rest(100)), 3), " and ",
                                  digits(100 * first_harmonic_share(s.at_rest(300)), 3), " % of its mean")};
}

Finding two_states_below(const SceneResults& s, int torque, double f) {
  const Branches b = s.branches(torque);
  // From there down two motions are those of the resonance at f_n / 2.
  const double end = kSecondaryEnd * b.up.natural_frequency;
  std::vector<double> two = speeds_with_two(b);
  std::erase_if(two, [&](double speed) { return speed < end; });
  if (two.empty()) return {0, text("one branch above ", digits(end), " Hz; ", jumps_text(b))};
  double low = two.front(), high = two.back();
  for (const ResponseResult* r : {&b.up, &b.down})
    for (const double jump : r->jump_frequency)
      if (jump >= end) {
        low = std::min(low, jump);
        high = std::max(high, jump);
      }
  return {low >= 0.86 * f && high <= 1.1 * f && two.front() < f ? 1.0 : 0.0,
          text("from ", digits(low), " to ", digits(high), " Hz")};
}

Finding width_at(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque);
  const std::vector<double> two = speeds_with_two(b);
  return {kNone, two.empty() ? "here one branch" : "here two branches at " + speeds_text(two, step_of(b.up))};
}

}  // namespace whine::paper
