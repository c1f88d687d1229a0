#include "paper/claims.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <limits>
#include <numbers>
#include <sstream>

#include "base/error.h"
#include "lumped/stiffness.h"
#include "signal/branches.h"
#include "signal/response.h"

namespace whine {

std::string digits(double value, int count) {
  std::ostringstream out;
  // Whole numbers stay whole: 1.23e+04 is no way to write 12345.
  if (std::abs(value) >= std::pow(10.0, count))
    out << std::fixed << std::setprecision(0) << value;
  else
    out << std::setprecision(count) << value;
  return out.str();
}

namespace {

using Eigen::Index;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr double kMicro = 1e6;  // m -> micrometre
constexpr double kMega = 1e-6;  // N m-1 -> 1e6 N m-1

// The row whose speed is nearest to f, the lower one of two; -1 if the sweep does not come within 1 % of it.
Index row_at(const ResponseArtifact& r, double f) {
  Index nearest = 0;
  const auto off = [&](Index i) { return std::abs(r.mesh_frequency[i] - f); };
  for (Index i = 1; i < r.mesh_frequency.size(); ++i)
    if (off(i) < off(nearest) || (off(i) == off(nearest) && r.mesh_frequency[i] < r.mesh_frequency[nearest]))
      nearest = i;
  return off(nearest) <= 0.01 * f ? nearest : -1;
}

// A motion at a speed: one row of one direction.
struct Motion {
  const ResponseArtifact* sweep = nullptr;
  Index row = -1;

  double speed() const { return sweep->mesh_frequency[row]; }
  double rms() const { return sweep->dte_rms[row]; }
  bool loses_contact() const { return sweep->separation_fraction[row] > 0; }
  double losses() const { return sweep->separations_per_period[row]; }
  int largest_harmonic() const {
    Index largest;
    sweep->dte_harmonic.row(row).maxCoeff(&largest);
    return static_cast<int>(largest) + 1;
  }
  // RMS of the harmonic over that of all that oscillates
  double share(int harmonic) const {
    return harmonic > sweep->dte_harmonic.cols()
               ? 0
               : sweep->dte_harmonic(row, harmonic - 1) / std::numbers::sqrt2 / rms();
  }
};

// P2000 gives two speeds for one pair of branches: those of captions and those of its text.
constexpr double kPrimary = 2400, kPrimaryText = 2500;      // Hz: captions of Figs 8 and 10; text
constexpr double kSecondary = 1300, kSecondaryText = 1350;  // Hz: captions of Figs 9 and 11; text
constexpr double kSecondaryEnd = 0.575;  // of f_n: 15 % above f_n / 2, where `summit` looks

// The two motions at a speed; equal in size where there is one branch. Empty if the sweeps do not reach the speed.
struct Pair {
  Motion upper, lower;
  int order = 1;  // of the resonance that P2000's branches at this speed belong to: f_n / order
  bool there() const { return upper.sweep != nullptr; }
  // Whether both are there, and the upper one belongs to this resonance: the upper branch of f_n may reach down to f_n / 2.
  bool two() const {
    return there() && like_a_jump(upper.rms(), lower.rms()) &&
           (order == 1 || upper.largest_harmonic() == order);
  }
};

Pair motions(const Branches& b, double f) {
  const Motion up{&b.up, row_at(b.up, f)}, down{&b.down, row_at(b.down, f)};
  if (up.row < 0 || down.row < 0 || up.speed() != down.speed()) return {};
  Pair pair = up.rms() > down.rms() ? Pair{up, down} : Pair{down, up};
  pair.order = f < kSecondaryEnd * b.up.natural_frequency ? 2 : 1;
  return pair;
}

// The motions at a speed that P2000 prints for 150 N m; where there are not two, those of the nearest speed that has two
// between caption and text.
Pair printed_branches(const SceneAnswers& s, double f) {
  const Branches b = s.branches(kFigureTorque);
  const Pair there = motions(b, f);
  if (there.two()) return there;
  const bool primary = f == kPrimary || f == kPrimaryText;
  const double low = primary ? kPrimary : kSecondary, high = primary ? kPrimaryText : kSecondaryText;
  Pair nearest = there;
  for (Index i = 0; i < b.up.mesh_frequency.size(); ++i) {
    const double other = b.up.mesh_frequency[i];
    if (other < low || other > high) continue;
    const Pair at = motions(b, other);
    if (at.two() && (!nearest.two() || std::abs(other - f) < std::abs(nearest.upper.speed() - f)))
      nearest = at;
  }
  return nearest;
}

std::string speeds_text(std::vector<double> speeds, double step) {
  if (speeds.empty()) return "nowhere";
  std::sort(speeds.begin(), speeds.end());
  std::string words;
  for (size_t i = 0; i < speeds.size();) {
    size_t last = i;
    while (last + 1 < speeds.size() && speeds[last + 1] - speeds[last] < 1.5 * step) ++last;
    words += text(words.empty() ? "" : ", ", digits(speeds[i]));
    if (last > i) words += " to " + digits(speeds[last]);
    i = last + 1;
  }
  return words + " Hz";
}

double step_of(const ResponseArtifact& r) {
  return r.mesh_frequency.size() < 2 ? 0 : std::abs(r.mesh_frequency[1] - r.mesh_frequency[0]);
}

std::vector<double> speeds_with_loss(const Branches& b) {
  std::vector<double> speeds;
  for (const ResponseArtifact* r : {&b.up, &b.down})
    for (Index i = 0; i < r->mesh_frequency.size(); ++i)
      if (r->separation_fraction[i] > 0) speeds.push_back(r->mesh_frequency[i]);
  std::sort(speeds.begin(), speeds.end());
  speeds.erase(std::unique(speeds.begin(), speeds.end()), speeds.end());
  return speeds;
}

std::vector<double> speeds_with_two(const Branches& b) {
  std::vector<double> speeds;
  for (Index i = 0; i < b.up.mesh_frequency.size(); ++i)
    if (motions(b, b.up.mesh_frequency[i]).two()) speeds.push_back(b.up.mesh_frequency[i]);
  return speeds;
}

double largest_rms(const Branches& b) {
  return std::max(b.up.dte_rms.maxCoeff(), b.down.dte_rms.maxCoeff());
}

bool jumps(const Branches& b) {
  return b.up.jump_frequency.size() > 0 && b.down.jump_frequency.size() > 0;
}

std::string jumps_text(const Branches& b) {
  std::string words;
  for (const ResponseArtifact* r : {&b.up, &b.down}) {
    words += text(words.empty() ? "" : "; ", r->direction, " ");
    std::vector<double> at(r->jump_frequency.data(), r->jump_frequency.data() + r->jump_frequency.size());
    std::sort(at.begin(), at.end());
    for (size_t j = 0; j < at.size(); ++j) words += (j ? ", " : "") + digits(at[j]);
    words += at.empty() ? "none" : " Hz";
  }
  return "jumps " + words;
}

double first_harmonic_share(const StaticArtifact& s) {
  return s.stiffness_harmonic[1] / s.stiffness_harmonic[0];
}

Index state_of(const ImpactArtifact& i, const std::string& state) {
  for (size_t k = 0; k < i.contact_state.size(); ++k)
    if (i.contact_state[k] == state) return static_cast<Index>(k);
  return -1;
}

// What decides whether contact is lost: how strongly the stiffness varies, and the damping.
std::string excitation(const SceneAnswers& s, int torque) {
  std::string words = text("first harmonic of k ", digits(100 * first_harmonic_share(s.at_rest(torque)), 3),
                           " % of its mean");
  const auto damped = s.impacts.find(text("T", torque, "/impact.h5"));
  if (damped != s.impacts.end())
    words += text(", damping ", digits(100 * damped->second.damping_ratio.tail(1)[0], 3), " %");
  return words;
}

std::string loss_text(const Branches& b) {
  const std::vector<double> lost = speeds_with_loss(b);
  return lost.empty() ? "contact never lost" : "contact lost at " + speeds_text(lost, step_of(b.up));
}

// The largest change between neighbouring samples of a period, the last of which is followed by the first.
struct Step {
  double before = 0, after = 0;
  double beside = 0;  // the larger of the changes to either side of it: a steep slope has such ones, too
};

Step largest_step(const Eigen::Ref<const Eigen::VectorXd>& period) {
  Step largest;
  for (Index i = 0; i < period.size(); ++i) {
    const Step step{period[i], period[(i + 1) % period.size()]};
    if (std::abs(step.after - step.before) > std::abs(largest.after - largest.before)) {
      largest = step;
      const Index size = period.size();
      largest.beside = std::max(std::abs(period[i] - period[(i + size - 1) % size]),
                                std::abs(period[(i + 2) % size] - period[(i + 1) % size]));
    }
  }
  return largest;
}

// ---- findings that several claims share
// --------------------------------------------------------------------------

Finding no_second_branch(const SceneAnswers& s, int torque, const Pair& at, double f) {
  if (!at.there()) return {kNone, text("the sweeps do not come to ", digits(f), " Hz")};
  if (like_a_jump(at.upper.rms(), at.lower.rms()))
    return {kNone, text("the upper branch at ", digits(f), " Hz is that of f_n: its largest harmonic is ",
                        at.upper.largest_harmonic(), ", not ", at.order)};
  return {kNone, text("one branch at ", digits(f), " Hz, RMS ", digits(at.upper.rms() * kMicro, 3),
                      " µm: ", excitation(s, torque))};
}

// Mean mesh stiffness against that at 100 N m.
double stiffening(const SceneAnswers& s, int torque) {
  return s.at_rest(torque).mean_stiffness / s.at_rest(kTorques[0]).mean_stiffness - 1;
}

Finding table_frequency(const SceneAnswers& s, int torque, const std::string& state) {
  const ImpactArtifact& i = s.ring_down(torque);
  const Index k = state_of(i, state);
  if (k < 0) return {kNone, "no part of the period has " + state + " loaded pairs"};
  if (state != "mean")
    return {i.natural_frequency[k], torque == kTorques[0]
                                        ? std::string()
                                        : text("mean stiffness ", digits(100 * stiffening(s, torque), 2),
                                               " % above that at ", kTorques[0], " N m")};
  const double loaded =
      (i.loaded_pairs.array() >= 2).cast<double>().sum() / static_cast<double>(i.loaded_pairs.size());
  std::string note =
      text("two pairs loaded for ", digits(100 * loaded, 3), " % of the period, tip edges included");
  const Index one = state_of(i, "one"), two = state_of(i, "two");
  const double share = s.at_rest(torque).contact_ratio - 1;
  if (one >= 0 && two >= 0)
    note += text("; weighted with the ", digits(100 * share, 3), " % of the contact ratio: ",
                 digits((1 - share) * i.natural_frequency[one] + share * i.natural_frequency[two]), " Hz");
  return {i.natural_frequency[k], note};
}

// One printed number that the text lets one read in several ways: the reading that is nearest to it.
struct Reading {
  std::string name;
  double value;  // in the unit of the claim
};
Finding nearest_reading(const std::vector<Reading>& readings, double printed, const std::string& unit,
                        const std::string& note) {
  const Reading* best = nullptr;
  std::string words;
  for (const Reading& r : readings) {
    if (std::isnan(r.value)) continue;
    if (!best || std::abs(r.value - printed) < std::abs(best->value - printed)) best = &r;
    words += text(words.empty() ? "" : ", ", r.name, " ", digits(r.value), " ", unit);
  }
  if (!best) return {kNone, note};
  return {best->value, text("read as ", words, note.empty() ? "" : "; ", note), best->name};
}

Finding damping(const SceneAnswers& s) {
  const ImpactArtifact& i = s.ring_down(kFigureTorque);
  std::vector<Reading> readings;
  for (const char* state : {"one", "two", "mean"})
    if (const Index k = state_of(i, state); k >= 0)
      readings.push_back({state == std::string("mean")  ? "mean over the cycle"
                          : state == std::string("one") ? "one pair in mesh"
                                                        : "two pairs in mesh",
                          100 * i.damping_ratio[k]});
  return nearest_reading(readings, 7, "%",
                         text("rayleigh_stiffness_s = ", digits(i.damping.rayleigh_stiffness, 3),
                              ", ring-down at ", kFigureTorque, " N m"));
}

// Where the response of a rising sweep has its summit near f_n / order.
struct Summit {
  Index row = -1;
  double speed = 0, natural_frequency = 0;
};

Summit summit(const ResponseArtifact& up, int order) {
  Summit found;
  found.natural_frequency = up.natural_frequency;
  const double centre = up.natural_frequency / order;
  for (Index i = 1; i + 1 < up.mesh_frequency.size(); ++i)
    if (std::abs(up.mesh_frequency[i] / centre - 1) < 0.15 && up.dte_rms[i] > up.dte_rms[i - 1] &&
        up.dte_rms[i] >= up.dte_rms[i + 1] && (found.row < 0 || up.dte_rms[i] > up.dte_rms[found.row]))
      found.row = i;
  if (found.row >= 0) found.speed = up.mesh_frequency[found.row];
  return found;
}

Finding resonance(const SceneAnswers& s, int order, const std::string& model = "") {
  const Summit top = summit(s.branches(kFigureTorque, model).up, order);
  if (top.row < 0)
    return {kNone, text("no summit within 15 % of ", digits(top.natural_frequency / order), " Hz")};
  return {top.speed / top.natural_frequency,
          text(digits(top.speed), " Hz, f_n ", digits(top.natural_frequency), " Hz")};
}

Finding driven_by_harmonic(const SceneAnswers& s, int order) {
  const ResponseArtifact& up = s.branches(kFigureTorque).up;
  const Summit top = summit(up, order);
  if (top.row < 0) return {kNone, "no summit"};
  const int largest = Motion{&up, top.row}.largest_harmonic();
  return {largest == order ? 1.0 : 0.0, text("largest harmonic at ", digits(top.speed), " Hz: ", largest)};
}

Finding jumps_at(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque);
  if (jumps(b)) return {1, jumps_text(b)};
  return {0, text("one branch; ", loss_text(b), "; ", excitation(s, torque))};
}

Finding loses_contact(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque);
  const bool lost = !speeds_with_loss(b).empty();
  return {lost ? 1.0 : 0.0, lost ? loss_text(b) : text(loss_text(b), "; ", excitation(s, torque))};
}

Finding two_at(const SceneAnswers& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) {
    Finding none = no_second_branch(s, kFigureTorque, at, f);
    none.value = 0;
    return none;
  }
  return {1, text("RMS ", digits(at.upper.rms() * kMicro, 3), " and ", digits(at.lower.rms() * kMicro, 3),
                  " µm at ", digits(at.upper.speed()), " Hz")};
}

// P2000 does not say of what its largest loads are the largest, nor how it samples them.
enum class LoadOf { tooth, sum, held_tooth };
constexpr std::array kLoadsOf{LoadOf::tooth, LoadOf::sum, LoadOf::held_tooth};
constexpr std::array kLoadsInWords{"one tooth", "sum over the teeth", "one tooth, held for 1/64 of a period"};

// Largest load of a motion, N.
double largest_load(const SceneAnswers& s, const Motion& m, LoadOf what) {
  if (what == LoadOf::sum) return m.sweep->mesh_force_max[m.row];
  if (what == LoadOf::tooth) return m.sweep->tooth_load_max[m.row];
  const SweepArtifact& sweep = s.sweep(kFigureTorque, m.sweep->direction);
  return held_load(sweep.tooth_load[static_cast<size_t>(m.row)], sweep.time.steps_per_period);
}

enum class Load { lower, upper, increase };

double load_of(const SceneAnswers& s, const Pair& p, Load which, LoadOf what) {
  const double lower = largest_load(s, p.lower, what), upper = largest_load(s, p.upper, what);
  return which == Load::lower ? lower : which == Load::upper ? upper : 100 * (upper / lower - 1);
}

Finding load(const SceneAnswers& s, Load which) {
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

Finding upper_losses(const SceneAnswers& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return {at.upper.losses(),
          text("without force for ", digits(100 * at.upper.sweep->separation_fraction[at.upper.row], 3),
               " % of the period at ", digits(at.upper.speed()), " Hz")};
}

Finding lower_keeps_contact(const SceneAnswers& s, double f) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  return {at.lower.loses_contact() ? 0.0 : 1.0,
          text(digits(at.lower.losses(), 3), " losses a period at ", digits(at.lower.speed()), " Hz")};
}

Finding nearly_harmonic(const SceneAnswers& s, double f, int order) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double share = at.upper.share(order);
  return {share >= 0.95 ? 1.0 : 0.0, text("RMS of harmonic ", order, " is ", digits(100 * share, 3),
                                          " % of all at ", digits(at.upper.speed()), " Hz")};
}

Finding lower_more_distorted(const SceneAnswers& s, double f, int order) {
  const Pair at = printed_branches(s, f);
  if (!at.two()) return no_second_branch(s, kFigureTorque, at, f);
  const double upper = at.upper.share(order), lower = at.lower.share(order);
  return {lower < upper ? 1.0 : 0.0, text("harmonic ", order, ": ", digits(100 * lower, 3), " % of the RMS, ",
                                          digits(100 * upper, 3), " % on the upper branch")};
}

Finding kink(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque);
  const std::vector<double> lost = speeds_with_loss(b);
  if (lost.empty()) return {kNone, text("contact never lost; ", excitation(s, torque))};
  const double ratio = lost.back() / b.up.natural_frequency;
  return {ratio >= 1 && ratio <= 1.1 ? 1.0 : 0.0,
          text(digits(lost.back()), " Hz, ", digits(ratio, 3), " f_n")};
}

// A second steady state below the resonance of the rising sweep.
Finding softening(const SceneAnswers& s) {
  const Branches b = s.branches(kFigureTorque);
  if (!jumps(b)) return jumps_at(s, kFigureTorque);
  // Where there are two, the larger motion is the one that falling speed leads to.
  bool any = false, all = true;
  for (double f : speeds_with_two(b)) {
    if (f < kSecondaryEnd * b.up.natural_frequency || f > b.up.jump_frequency.maxCoeff()) continue;
    any = true;
    const auto* larger = motions(b, f).upper.sweep;
    all = all && larger && larger->direction == "down";
  }
  return {any && all ? 1.0 : 0.0, jumps_text(b)};
}

// Largest growth of the RMS across a jump of the rising sweep within 15 % of f_n / order; 0 without a jump there.
double rise(const ResponseArtifact& up, int order) {
  double largest = 0;
  const std::vector<Index> left = rows_before_jumps(up);
  for (size_t j = 0; j < left.size(); ++j)
    if (const Index i = left[j];
        i >= 0 &&
        std::abs(up.jump_frequency[static_cast<Index>(j)] * order / up.natural_frequency - 1) <= 0.15)
      largest = std::max(largest, up.dte_rms[i + 1] - up.dte_rms[i]);
  return largest;
}

Finding superharmonic_weaker(const SceneAnswers& s) {
  const ResponseArtifact& up = s.branches(kFigureTorque).up;
  const double first = rise(up, 1), second = rise(up, 2), third = rise(up, 3);
  if (first == 0) return {kNone, "no jump near f_n"};
  return {second < first && third < first ? 1.0 : 0.0,
          text("rise near f_n, f_n/2, f_n/3: ", digits(first * kMicro, 3), ", ", digits(second * kMicro, 3),
               ", ", digits(third * kMicro, 3), " µm")};
}

// Speeds on the branch between the kink and the jump down: those with two branches, and all above them up to the highest
// speed with loss of contact.
Finding loss_down_to_the_jump(const SceneAnswers& s) {
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

Finding loss_beyond_two_branches(const SceneAnswers& s) {
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

Finding lower_never_loses(const SceneAnswers& s) {
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

Finding grows_with_torque(const SceneAnswers& s) {
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

Finding width_at(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque);
  const std::vector<double> two = speeds_with_two(b);
  return {kNone, two.empty() ? "here one branch" : "here two branches at " + speeds_text(two, step_of(b.up))};
}

// ---- lumped models
// -----------------------------------------------------------------------------------------------

Finding lumped_jumps(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque, "rectangular");
  if (jumps(b)) return {1, jumps_text(b)};
  const RectangularWave wave = rectangular_wave(s.at_rest(kTorques[0]));
  return {0, text("one branch; ", loss_text(b), "; levels ", digits(wave.low * kMega), " and ",
                  digits(wave.high * kMega), " N/µm, ratio ", digits(wave.high / wave.low, 3),
                  "; first harmonic ", digits(100 * wave.amplitude(1) / wave.mean(), 3), " % of their mean")};
}

Finding torque_independent(const SceneAnswers& s) {
  const auto marks = [&](int torque) {
    const Branches b = s.branches(torque, "rectangular");
    std::vector<double> at;
    for (const ResponseArtifact* r : {&b.up, &b.down})
      at.insert(at.end(), r->jump_frequency.data(), r->jump_frequency.data() + r->jump_frequency.size());
    return at;
  };
  const std::vector<double> first = marks(kTorques[0]);
  double largest = 0;
  for (int torque : kTorques) {
    const std::vector<double> other = marks(torque);
    if (other.size() != first.size()) return {0, text("another number of jumps at ", torque, " N m")};
    for (size_t j = 0; j < first.size(); ++j) largest = std::max(largest, std::abs(other[j] - first[j]));
  }
  if (first.empty()) {
    const Branches low = s.branches(100, "rectangular"), high = s.branches(300, "rectangular");
    const double off =
        ((high.up.dte_rms / 3 - low.up.dte_rms).array() / low.up.dte_rms.array()).abs().maxCoeff();
    return {kNone, text("no jumps; RMS over torque is the same at 100 and 300 N m ",
                        off < 1e-12 ? "to round-off" : "to " + digits(off, 2) + " of itself")};
  }
  return {largest <= 1 ? 1.0 : 0.0,
          text("jumps at the three torques differ by ", digits(largest, 3), " Hz at most")};
}

// The rows before and after each jump.
Finding mean_jumps(const SceneAnswers& s, bool less) {
  const Branches b = s.branches(kFigureTorque, "rectangular");
  bool holds = true;
  std::string note;
  for (const ResponseArtifact* r : {&b.up, &b.down})
    for (const Index i : rows_before_jumps(*r)) {
      if (i < 0) continue;
      const double rms = r->dte_rms[i + 1] - r->dte_rms[i], mean = r->dte_mean[i + 1] - r->dte_mean[i];
      if (less ? std::abs(mean) >= std::abs(rms) : mean * rms >= 0) holds = false;
      note += text(note.empty() ? "" : "; ", r->direction, ": RMS ", digits(rms * kMicro, 3), ", mean ",
                   digits(mean * kMicro, 3), " µm");
    }
  if (note.empty()) return {kNone, "no jumps; " + loss_text(b)};
  return {holds ? 1.0 : 0.0, note};
}

Finding lumped_two(const SceneAnswers& s, double f) {
  const Branches b = s.branches(kFigureTorque, "rectangular");
  const Pair at = motions(b, f);
  if (!at.two()) return {0, text("one branch; ", jumps_text(b))};
  return {1, text("RMS ", digits(at.upper.rms() * kMicro, 3), " and ", digits(at.lower.rms() * kMicro, 3),
                  " µm at ", digits(at.upper.speed()), " Hz")};
}

Finding lumped_loss(const SceneAnswers& s, double f, bool upper) {
  const Pair at = motions(s.branches(kFigureTorque, "rectangular"), f);
  if (!at.there() || (upper && !at.two())) return {kNone, text("one branch at ", digits(f), " Hz")};
  const Motion& m = upper ? at.upper : at.lower;
  return {m.loses_contact() == upper ? 1.0 : 0.0,
          text(at.two() ? "" : "the only branch; ", digits(m.losses(), 3), " losses a period at ",
               digits(m.speed()), " Hz")};
}

// The load of a tooth pair on its whole way through the mesh: pair j at the end of a period is pair j + 1 of the next one.
Eigen::VectorXd load_of_a_pair(const SweepArtifact& sweep, Index row) {
  const MatrixRM& load = sweep.tooth_load[static_cast<size_t>(row)];
  Eigen::VectorXd way(load.size());
  for (Index pair = 0; pair < load.cols(); ++pair)
    way.segment(pair * load.rows(), load.rows()) = load.col(pair);
  return way;
}

// Whether the force of one pair, or of all, has a step or none, at the speed nearest to f.
Finding force_step(const SweepArtifact& sweep, double f, bool one_pair, bool smooth) {
  Index row;
  (sweep.mesh_frequency.array() - f).abs().minCoeff(&row);
  const Eigen::VectorXd load =
      one_pair ? load_of_a_pair(sweep, row) : Eigen::VectorXd(sweep.mesh_force.row(row));
  const Step step = largest_step(load);
  const double change = std::abs(step.after - step.before), share = change / load.maxCoeff();
  return {(share > 0.1 && change > 3 * step.beside) == smooth ? 0.0 : 1.0,
          text("largest step between neighbouring samples from ", digits(step.before), " to ",
               digits(step.after), " N, ", digits(100 * share, 3), " % of the largest load, beside it ",
               digits(step.beside), " N, at ", digits(sweep.mesh_frequency[row]), " Hz")};
}

Finding secant_reduced(const SceneAnswers& s) {
  bool reduced = true;
  std::string note;
  for (int torque : kTorques) {
    const double ratio =
        largest_rms(s.branches(torque, "secant")) / largest_rms(s.branches(torque, "rectangular"));
    reduced = reduced && ratio <= 0.5;
    note += text(note.empty() ? "" : ", ", digits(ratio, 3));
  }
  return {reduced ? 1.0 : 0.0, "largest RMS over that of the rectangular wave at 100, 200, 300 N m: " + note};
}

Finding secant_linear(const SceneAnswers& s, int torque) {
  const Branches b = s.branches(torque, "secant");
  const double difference =
      ((b.up.dte_rms - b.down.dte_rms.reverse()).array() / b.up.dte_rms.array()).abs().maxCoeff();
  const bool linear = speeds_with_loss(b).empty() && !jumps(b);
  return {linear ? 1.0 : 0.0,
          text(loss_text(b), "; up and down differ by ", digits(100 * difference, 2), " % at most")};
}

Finding stiffness_spectrum(const SceneAnswers& s) {
  std::array<double, 3> share{};
  std::string note;
  for (size_t t = 0; t < kTorques.size(); ++t) {
    share[t] = first_harmonic_share(s.at_rest(kTorques[t]));
    note += text(note.empty() ? "" : ", ", digits(100 * share[t], 3));
  }
  const bool falls = share[0] > share[1] && share[1] > share[2] && share[2] < 0.8 * share[0];
  return {falls ? 1.0 : 0.0, "first harmonic of k over its mean at 100, 200, 300 N m: " + note + " %"};
}

Finding spectrum_lost(const SceneAnswers& s) {
  const RectangularWave wave = rectangular_wave(s.at_rest(100));
  const auto strength = [](auto amplitude) {
    double sum = 0;
    for (int n = 1; n <= 3; ++n) sum += amplitude(n) * amplitude(n);
    return std::sqrt(sum);
  };
  const double whole = strength([&](int n) { return wave.amplitude(n); });
  bool less = true;
  double ratio = 1;
  std::string note;
  for (int torque : kTorques) {
    const StaticArtifact& a = s.at_rest(torque);
    ratio = strength([&](int n) { return a.stiffness_harmonic[n]; }) / whole;
    less = less && ratio < 1;
    note += text(note.empty() ? "" : ", ", digits(ratio, 3));
  }
  return {less && ratio <= 0.5 ? 1.0 : 0.0,
          "harmonics 1 to 3 of k over those of the rectangular wave at 100, 200, 300 N m: " + note};
}

Finding modest_difference(const SceneAnswers& s) {
  double largest = 0;
  const RectangularWave wave = rectangular_wave(s.at_rest(100));
  for (int torque : kTorques) {
    const StaticArtifact& a = s.at_rest(torque);
    double sum = 0;
    for (Index i = 0; i < a.mesh_phase.size(); ++i)
      sum += std::pow(a.stiffness_secant[i] - wave.at(a.mesh_phase[i]), 2);
    largest = std::max(largest, std::sqrt(sum / static_cast<double>(a.mesh_phase.size())) / a.mean_stiffness);
  }
  return {largest <= 0.2 ? 1.0 : 0.0,
          text("RMS difference at most ", digits(100 * largest, 3), " % of the mean stiffness")};
}

// ---- the claims
// --------------------------------------------------------------------------------------------------

using Find = std::function<Finding(const SceneAnswers&)>;

Claim number(std::string id, std::string place, std::string text, std::string unit, double printed,
             double tolerance, std::string basis, Find find) {
  return {std::move(id), std::move(place), std::move(text),  Scale::number,  std::move(unit),
          printed,       tolerance,        std::move(basis), std::move(find)};
}

Claim statement(std::string id, std::string place, std::string text, std::string basis, Find find) {
  return {std::move(id),    std::move(place), std::move(text), Scale::statement, "yes/no", 1, 0,
          std::move(basis), std::move(find)};
}

Claim incomparable(std::string id, std::string place, std::string text, std::string unit, double printed,
                   std::string basis, Find find) {
  return {
      std::move(id),    std::move(place), std::move(text), Scale::incomparable, std::move(unit), printed, 0,
      std::move(basis), std::move(find)};
}

Claim given(Claim claim) {
  claim.given = true;
  return claim;
}

Claim given_number(std::string id, std::string place, std::string text, std::string unit, double printed,
                   double tolerance, std::string basis, Find find) {
  return given(number(std::move(id), std::move(place), std::move(text), std::move(unit), printed, tolerance,
                      std::move(basis), std::move(find)));
}

Claim of_scale(Scale scale, Claim claim) {
  claim.scale = scale;
  return claim;
}

Find nothing() {
  return [](const SceneAnswers&) { return Finding{kNone, ""}; };
}

// Largest RMS of all speeds at each torque of a model.
Find largest_text(const std::string& model) {
  return [=](const SceneAnswers& s) {
    std::string note;
    for (int torque : kTorques)
      note += text(note.empty() ? "" : ", ", digits(largest_rms(s.branches(torque, model)) * kMicro, 3));
    return Finding{kNone, "here largest RMS at 100, 200, 300 N m: " + note + " µm"};
  };
}

std::vector<Claim> make_claims() {
  std::vector<Claim> c;
  const std::string given_basis = "input: the scene takes it over";
  const std::string grid = "one step: Table 1 has multiples of 20 Hz only";
  const std::string rig = "no numbers of the rig's curves are printed";
  const std::string curve = "a curve without numbers in the text";
  const auto torques = [](int torque) { return text(torque, " N m"); };

  // --- 1, 2
  c.push_back(incomparable(
      "rig-phenomena", "1", "rig: jumps, sub- and superharmonic resonances, parametric instability, chaos",
      "yes/no", kNone, "measured, no numbers", [](const SceneAnswers& s) {
        Index other = 0;
        for (int torque : kSweptTorques)
          for (const ResponseArtifact* r : {&s.branches(torque).up, &s.branches(torque).down})
            other += (r->period_multiple.array() != 1).count();
        return Finding{
            kNone, text("here ", other, " speeds, of all sweeps, that do not repeat with the mesh period")};
      }));
  const auto newmark = [](double value) {
    return [=](const SceneAnswers& s) {
      const std::string& integrator = s.branches(kFigureTorque).up.fidelity.integrator;
      return integrator == "newmark"
                 ? Finding{value, ""}
                 : Finding{kNone, "integrator = \"" + integrator + "\" has no such number"};
    };
  };
  c.push_back(of_scale(
      Scale::choice, number("newmark-gamma", "2", "Newmark's gamma", "1", 0.5, 0,
                            "how P2000 computes, no result; given with integrator = newmark", newmark(0.5))));
  c.push_back(of_scale(Scale::choice, number("newmark-beta", "2", "Newmark's beta", "1", 0.25, 0,
                                             "how P2000 computes, no result; given with integrator = newmark",
                                             newmark(0.25))));

  // --- 2.1, the gears
  const auto gear = [](auto of) {
    return [=](const SceneAnswers& s) { return Finding{of(s.at_rest(100)), ""}; };
  };
  c.push_back(given_number("teeth", "2.1", "teeth of each gear", "1", 50, 0, given_basis,
                           gear([](const StaticArtifact& a) { return double(a.driver.teeth); })));
  c.push_back(given_number("module", "2.1", "module", "mm", 3, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.module; })));
  c.push_back(given_number(
      "pressure-angle", "2.1", "pressure angle", "deg", 20, 1e-9, given_basis,
      gear([](const StaticArtifact& a) { return a.driver.pressure_angle * 180 / std::numbers::pi; })));
  c.push_back(of_scale(
      Scale::misprint,
      number("base-radius", "2.1, 3", "base radius (printed twice)", "mm", 7.047, 0,
             "P2000's own numbers give ten times as much: 75 mm cos 20 deg", [](const SceneAnswers& s) {
               const StaticArtifact& a = s.at_rest(100);
               const double r = a.driver.module * a.driver.teeth * std::cos(a.driver.pressure_angle) / 2;
               return Finding{
                   1e3 * r, text(a.driver.teeth, " teeth of module ", digits(1e3 * a.driver.module),
                                 " mm have ", digits(1e3 * r, 5),
                                 " mm, and only with it k = (T / r) / STE gives the printed mean stiffness")};
             })));
  c.push_back(number("contact-ratio", "2.1", "contact ratio", "1", 1.75, 0.005,
                     "half of the last printed digit",
                     gear([](const StaticArtifact& a) { return a.contact_ratio; })));
  c.push_back(incomparable("rig-face-width", "2.1", "face width of the rig's gears", "mm", 20,
                           "P2000 computes with 25.4 mm, and so do the scenes",
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.face_width; })));
  c.push_back(given_number("face-width", "2.1", "face width of the model", "mm", 25.4, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.face_width; })));
  c.push_back(
      given_number("youngs-modulus", "2.1", "elasticity modulus", "GPa", 207, 1e-9, given_basis,
                   gear([](const StaticArtifact& a) { return 1e-9 * a.driver_material.youngs_modulus; })));
  c.push_back(given_number("density", "2.1", "density", "kg/m3", 7600, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return a.driver_material.density; })));

  // --- 2.1, impact tests
  c.push_back(incomparable("rig-natural-frequency", "2.1", "natural frequency of the rig, \"around\"", "Hz",
                           2700, "the rig's gears are 20 mm wide", [](const SceneAnswers& s) {
                             return Finding{table_frequency(s, 100, "mean").value, "25.4 mm wide, 100 N m"};
                           }));
  c.push_back(of_scale(
      Scale::choice, number("impact-torque", "2.1", "torque of the impact over the steady torque", "1", 1.2,
                            0, "how P2000 measures, no result; given with gear-impact --torque-step 0.2",
                            [](const SceneAnswers& s) {
                              const double step = s.ring_down(100).torque_step;
                              return Finding{1 + step, text("here a step of ", digits(step, 2),
                                                            " is let go: so small that the decay is linear")};
                            })));
  const double scaled_rig = 2700 * std::sqrt(25.4 / 20);
  for (int torque : kTorques)
    c.push_back(
        statement(text("within-5-percent-", torque), "2.1",
                  text("mean natural frequency within 5 % of 2700 sqrt(25.4/20) Hz, ", torques(torque)),
                  "5 % of 3043 Hz", [=](const SceneAnswers& s) {
                    const double off = table_frequency(s, torque, "mean").value / scaled_rig - 1;
                    return Finding{std::abs(off) <= 0.05 ? 1.0 : 0.0, text(digits(100 * off, 2), " %")};
                  }));
  struct Row {
    const char *state, *words;
    std::array<double, 3> printed;
  };
  for (const Row& row : {Row{"one", "one pair in mesh", {2480, 2480, 2560}},
                         Row{"two", "two pairs in mesh", {3040, 3040, 3040}},
                         Row{"mean", "mean over the mesh cycle", {2900, 2900, 2920}}})
    for (size_t t = 0; t < kTorques.size(); ++t) {
      const int torque = kTorques[t];
      const std::string state = row.state, id = text("table1-", state, "-", torque), place = "Table 1";
      const std::string words = text("natural frequency, ", row.words, ", ", torques(torque));
      const Find find = [=](const SceneAnswers& s) { return table_frequency(s, torque, state); };
      c.push_back(number(id, place, words, "Hz", row.printed[t], 20, grid, find));
    }
  c.push_back(statement(
      "weak-function-of-load", "2.1", "natural frequency a weak function of load",
      "each row of Table 1 from 100 to 300 N m by 5 % at most, as P2000 allows against the rig "
      "there; its own rows "
      "have up to 3.2 %",
      [](const SceneAnswers& s) {
        bool weak = true;
        std::string note;
        for (const char* state : {"one", "two", "mean"}) {
          double low = std::numeric_limits<double>::infinity(), high = 0;
          for (int torque : kTorques) {
            const double f = table_frequency(s, torque, state).value;
            low = std::min(low, f);
            high = std::max(high, f);
          }
          weak = weak && high <= 1.05 * low;
          note += text(note.empty() ? "" : ", ", state, " ", digits(100 * (high / low - 1), 2), " %");
        }
        return Finding{weak ? 1.0 : 0.0, note};
      }));
  c.push_back(number("damping", "2.1", "damping ratio by ring-down, the text does not say in which contact",
                     "%", 7, 0.5, "half of the last printed digit", damping));
  c.push_back(given(statement("bearing-damping", "2.1", "bearing damping below 1 %", given_basis,
                              [](const SceneAnswers& s) {
                                const double ratio = s.branches(kFigureTorque).up.damping.bearing_ratio;
                                return Finding{ratio < 0.01 ? 1.0 : 0.0, text(digits(100 * ratio, 2), " %")};
                              })));
  c.push_back(incomparable("bearing-damping-drift", "2.1",
                           "bearing damping is the least that removes numerical drift", "yes/no", kNone,
                           "the rigid motion of the pair is projected out here: nothing drifts", nothing()));

  // --- 2.1, resonances at 150 N m
  const std::string about = "\"approximately\"; the rig's own jump below 2500 Hz lies 7 % under its 2700 Hz";
  c.push_back(number("resonance-1", "2.1, Fig 5", "primary resonance, f_m over f_n, rising speed, 150 N m",
                     "1", 1, 0.1, about, [](const SceneAnswers& s) { return resonance(s, 1); }));
  c.push_back(number("resonance-2", "2.1, Fig 5", "resonance at half of it (rig: 1350 Hz)", "1", 0.5, 0.05,
                     about, [](const SceneAnswers& s) { return resonance(s, 2); }));
  c.push_back(number("resonance-3", "2.1, Fig 5", "resonance at a third of it", "1", 1 / 3.0, 1 / 30.0, about,
                     [](const SceneAnswers& s) { return resonance(s, 3); }));
  for (int order : {2, 3})
    c.push_back(statement(text("driven-by-harmonic-", order), "2.1, Eq 22",
                          text("the resonance at f_n/", order, " is driven by harmonic ", order, " of f_m"),
                          "it is the largest harmonic there",
                          [=](const SceneAnswers& s) { return driven_by_harmonic(s, order); }));
  c.push_back(statement(
      "softening", "2.1, Fig 5", "the primary peak bends to lower speeds, with two steady states",
      "falling speed keeps the larger motion to a lower speed than rising speed reaches it", softening));
  c.push_back(statement(
      "superharmonic-weaker", "2.1", "jumps less pronounced in the superharmonic resonances",
      "lower rise of the RMS across a jump of the rising sweep than near f_n", superharmonic_weaker));
  c.push_back(incomparable("rig-two-states", "2.1, Fig 4", "rig, 150 N m: two steady states just below", "Hz",
                           2500, "the rig's gears are 20 mm wide, its branches have no printed ends",
                           [](const SceneAnswers& s) { return width_at(s, kFigureTorque); }));
  c.push_back(incomparable("sound-pressure", "2.1", "rig: sound pressure of the branches 10 to 40 dB apart",
                           "dB", kNone, "sound is not computed", [](const SceneAnswers& s) {
                             const Pair at = printed_branches(s, kPrimary);
                             if (!at.two()) return no_second_branch(s, kFigureTorque, at, kPrimary);
                             return Finding{kNone,
                                            text("RMS of the DTE ",
                                                 digits(20 * std::log10(at.upper.rms() / at.lower.rms()), 3),
                                                 " dB apart at ", digits(at.upper.speed()), " Hz")};
                           }));
  c.push_back(incomparable("jumps-above-rig", "2.1", "computed resonances and jumps slightly above the rig's",
                           "yes/no", kNone, rig, [](const SceneAnswers& s) {
                             return Finding{kNone, jumps_text(s.branches(kFigureTorque))};
                           }));
  c.push_back(incomparable("amplitudes-as-rig", "2.1, Figs 4 to 7",
                           "computed amplitudes agree quite well with the rig's", "yes/no", kNone, rig,
                           largest_text("")));
  c.push_back(incomparable("fig5-fig7", "Figs 5, 7", "computed RMS of the DTE against speed", "µm", kNone,
                           curve, largest_text("")));

  // --- 2.1, torques
  for (int torque : {100, 150, 200, 300})
    c.push_back(statement(text("jumps-", torque), torque == kFigureTorque ? "2.1, Fig 5" : "2.1, Fig 7",
                          "jumps, rising and falling speed, " + torques(torque), "both sweeps have one",
                          [=](const SceneAnswers& s) { return jumps_at(s, torque); }));
  c.push_back(statement("amplitude-grows", "2.1, Figs 6, 7",
                        "amplitude at resonance larger for larger torque",
                        "the largest RMS grows from torque to torque", grows_with_torque));
  c.push_back(incomparable("overlap-100", "2.1",
                           "100 N m: two steady states over a wider range than on the rig", "yes/no", kNone,
                           rig, [](const SceneAnswers& s) { return width_at(s, 100); }));
  c.push_back(incomparable("damping-fitted", "2.1",
                           "damping chosen so that the jump down at 100 N m agrees with the rig", "yes/no",
                           kNone, "the rig's jump is not printed", [](const SceneAnswers& s) {
                             return Finding{kNone, jumps_text(s.branches(100))};
                           }));

  // --- 2.1, both branches at 150 N m
  struct Speed {
    double f;
    const char* where;
  };
  for (const Speed& at : {Speed{kPrimary, "Figs 8, 10"}, Speed{kPrimaryText, "2.1"},
                          Speed{kSecondary, "Figs 9, 11"}, Speed{kSecondaryText, "2.1"}}) {
    const double f = at.f;
    c.push_back(statement(
        text("branches-", f), at.where, text("two steady states at ", f, " Hz, 150 N m"),
        text("RMS more than 20 % apart: neighbouring speeds of one branch are closer",
             f < kPrimary ? "; the upper one of the resonance at f_n / 2: its largest harmonic is 2" : "",
             "; where caption and text name two speeds, at one between them"),
        [=](const SceneAnswers& s) { return two_at(s, f); }));
    c.push_back(statement(text("lower-keeps-contact-", f), at.where,
                          text("lower branch at ", f, " Hz: no contact loss"), "force above zero throughout",
                          [=](const SceneAnswers& s) { return lower_keeps_contact(s, f); }));
    if (f >= kPrimaryText || f == kPrimary)
      c.push_back(statement(text("upper-loses-contact-", f), at.where,
                            text("upper branch at ", f, " Hz: no force over part of each mesh cycle"),
                            "one loss a cycle or more", [=](const SceneAnswers& s) {
                              Finding losses = upper_losses(s, f);
                              if (!std::isnan(losses.value)) losses.value = losses.value >= 1;
                              return losses;
                            }));
    else
      c.push_back(number(text("upper-two-losses-", f), at.where,
                         text("upper branch at ", f, " Hz: contact losses in a mesh cycle"), "1", 2, 0,
                         "a count", [=](const SceneAnswers& s) { return upper_losses(s, f); }));
  }
  const std::string pure =
      "\"nearly\" has no number: RMS of that harmonic at least 95 % of all, the others a third of it";
  c.push_back(statement("upper-harmonic-1", "2.1, Fig 8", "upper branch at 2400 Hz nearly harmonic at f_m",
                        pure, [](const SceneAnswers& s) { return nearly_harmonic(s, kPrimary, 1); }));
  c.push_back(statement("lower-distorted-1", "2.1, Fig 8",
                        "lower branch at 2400 Hz: some distortion from higher harmonics",
                        "smaller share of harmonic 1 than on the upper branch",
                        [](const SceneAnswers& s) { return lower_more_distorted(s, kPrimary, 1); }));
  c.push_back(statement("upper-harmonic-2", "2.1, Fig 9", "upper branch at 1300 Hz nearly harmonic at 2 f_m",
                        pure, [](const SceneAnswers& s) { return nearly_harmonic(s, kSecondary, 2); }));
  c.push_back(statement("lower-distorted-2", "2.1, Fig 9",
                        "lower branch at 1300 Hz has more distortion than the upper",
                        "smaller share of harmonic 2 than on the upper branch",
                        [](const SceneAnswers& s) { return lower_more_distorted(s, kSecondary, 2); }));
  c.push_back(statement("upper-larger-2", "2.1, Fig 9",
                        "upper branch at 1300 Hz: considerably higher amplitude",
                        "\"considerably\" has no number: by half at least, less than the 62 % of the loads",
                        [](const SceneAnswers& s) {
                          const Pair at = printed_branches(s, kSecondary);
                          if (!at.two()) return no_second_branch(s, kFigureTorque, at, kSecondary);
                          const double ratio = at.upper.rms() / at.lower.rms();
                          return Finding{ratio >= 1.5 ? 1.0 : 0.0, text(digits(ratio, 3), " times")};
                        }));
  c.push_back(incomparable("time-domain-as-rig", "2.1", "time histories closely match the measured ones",
                           "yes/no", kNone, rig, nothing()));

  // --- 2.1, loads at 150 N m
  c.push_back(statement(
      "smooth-transition", "2.1, Fig 10", "lower branch at 2400 Hz: load passes smoothly from tooth to tooth",
      "no step between samples above 10 % of the largest load, as in a drawn curve, and thrice those beside "
      "it, as on no slope",
      [](const SceneAnswers& s) {
        const Pair at = printed_branches(s, kPrimary);
        if (!at.two()) return no_second_branch(s, kFigureTorque, at, kPrimary);
        return force_step(s.sweep(kFigureTorque, at.lower.sweep->direction), at.lower.speed(), true, true);
      }));
  const std::string speeds =
      "5 %: caption and text differ by 4 % in the speed, the load is printed to 1 to 2 %";
  c.push_back(number("load-lower", "2.1, Fig 10",
                     "largest load, lower branch at 2400 Hz, of one tooth or in sum", "N", 3000, 150, speeds,
                     [](const SceneAnswers& s) { return load(s, Load::lower); }));
  c.push_back(number("load-upper", "2.1, Fig 10",
                     "largest load, upper branch at 2400 Hz, of one tooth or in sum", "N", 4850, 242.5,
                     speeds, [](const SceneAnswers& s) { return load(s, Load::upper); }));
  c.push_back(number("load-increase", "2.1, Fig 10",
                     "its increase from branch to branch, of one tooth or in sum", "%", 62, 8.1,
                     "5 % of the ratio 1.62, as of the loads",
                     [](const SceneAnswers& s) { return load(s, Load::increase); }));
  c.push_back(statement(
      "load-larger-2", "2.1, Fig 11", "1300 Hz: largest tooth load considerably larger with contact loss",
      "\"considerably\" has no number: by a fifth at least, a third of the 62 % at 2400 Hz",
      [](const SceneAnswers& s) {
        const Pair at = printed_branches(s, kSecondary);
        if (!at.two()) return no_second_branch(s, kFigureTorque, at, kSecondary);
        const double upper = largest_load(s, at.upper, LoadOf::tooth),
                     lower = largest_load(s, at.lower, LoadOf::tooth);
        return Finding{upper >= 1.2 * lower ? 1.0 : 0.0, text(digits(upper), " and ", digits(lower), " N")};
      }));

  // --- 2.1, contact loss
  c.push_back(statement("loss-300", "2.1, Fig 7", "contact loss even at 300 N m", "at one speed at least",
                        [](const SceneAnswers& s) { return loses_contact(s, 300); }));
  c.push_back(statement("loss-600", "2.1", "contact loss at 600 N m", "at one speed at least",
                        [](const SceneAnswers& s) { return loses_contact(s, 600); }));
  c.push_back(statement("jumps-600", "2.1", "jumps at 600 N m", "both sweeps have one",
                        [](const SceneAnswers& s) { return jumps_at(s, 600); }));
  c.push_back(statement(
      "amplitude-600", "2.1", "largest amplitude at 600 N m considerably greater than at 300 N m",
      "\"considerably\" has no number: by half at least, the torque being twice as large",
      [](const SceneAnswers& s) {
        const double ratio = largest_rms(s.branches(600)) / largest_rms(s.branches(300));
        return Finding{ratio >= 1.5 ? 1.0 : 0.0, text(digits(ratio, 3), " times; at 600 N m ",
                                                      loss_text(s.branches(600)), ", ", excitation(s, 600))};
      }));
  for (int torque : kTorques)
    c.push_back(statement(text("kink-", torque), "2.1, Fig 7",
                          text("contact loss begins just above f_n, ", torques(torque)),
                          "\"just above\": highest speed with contact loss 1 to 1.1 f_n, P2000's kink of the "
                          "lumped model being at 1.07",
                          [=](const SceneAnswers& s) { return kink(s, torque); }));
  c.push_back(statement(
      "loss-down-to-jump", "2.1, Fig 7", "contact loss along the whole upper branch, kink to jump down",
      "at every speed of it, and there is one at 100, 200 and 300 N m", loss_down_to_the_jump));
  c.push_back(
      statement("loss-beyond-jumps", "2.1, Fig 7", "contact loss also where there is one steady state",
                "above the highest speed with two, at 100, 200 and 300 N m", loss_beyond_two_branches));
  c.push_back(statement(
      "lower-never-loses", "2.1, Fig 7", "contact loss never along the lower branch",
      "of the primary resonance, which the sentence is about: at no speed with two steady states above "
      "1.15 f_n / 2, at 100, 200 and 300 N m",
      lower_never_loses));

  // --- 3, the lumped models
  const auto lumped = [](auto of) {
    return [=](const SceneAnswers& s) {
      return Finding{of(s.sweep(kFigureTorque, "up", "rectangular")), ""};
    };
  };
  c.push_back(given_number("sdof-damping", "3", "damping ratio of the lumped model", "%", 8, 1e-9,
                           "input: gear-lumped takes it over",
                           lumped([](const SweepArtifact& a) { return 100 * a.lumped.damping_ratio; })));
  c.push_back(given_number("sdof-mass", "3", "mass of the lumped model", "kg", 1.4, 1e-9,
                           "input: gear-lumped takes it over",
                           lumped([](const SweepArtifact& a) { return a.lumped.mass; })));
  c.push_back(number("mean-stiffness", "3", "mean mesh stiffness, 100 N m", "N/µm", 462.1, 4.6,
                     "1 %: the torque is not said, and Table 1's mean frequency moves by 0.7 % with it",
                     [](const SceneAnswers& s) {
                       return Finding{s.at_rest(100).mean_stiffness * kMega, ""};
                     }));
  c.push_back(number(
      "sdof-natural-frequency", "3", "sqrt(k_avg / m) / 2 pi", "Hz", 2900, 20,
      "one step of 20 Hz: the printed k_avg and m themselves give 2891.5 Hz", [](const SceneAnswers& s) {
        const SweepArtifact& a = s.sweep(kFigureTorque, "up", "rectangular");
        return Finding{std::sqrt(s.at_rest(100).mean_stiffness / a.lumped.mass) / (2 * std::numbers::pi),
                       "secant stiffness at 100 N m"};
      }));
  c.push_back(incomparable("fig12", "Fig 12", "static transmission error and spectrum", "µm", kNone, curve,
                           [](const SceneAnswers& s) {
                             std::string note;
                             for (int torque : kTorques)
                               note +=
                                   text(note.empty() ? "" : ", ",
                                        digits(s.at_rest(torque).transmission_error_harmonic[0] * kMicro));
                             return Finding{kNone, "mean at 100, 200, 300 N m: " + note + " µm"};
                           }));
  c.push_back(incomparable("fig13", "Fig 13", "mesh stiffness and spectrum", "N/µm", kNone, curve,
                           [](const SceneAnswers& s) {
                             const RectangularWave wave = rectangular_wave(s.at_rest(100));
                             return Finding{kNone, text("rectangular wave ", digits(wave.low * kMega),
                                                        " and ", digits(wave.high * kMega), " N/µm")};
                           }));
  c.push_back(statement(
      "mean-stiffness-torque", "3, Fig 13", "mean mesh stiffness changes little with torque",
      "2.8 % from 100 to 300 N m: what Table 1 leaves room for, whose mean frequency rises from 2900 to 2920 "
      "Hz, each to 10 Hz: "
      "1.4 % at most, the stiffness twice that",
      [](const SceneAnswers& s) {
        const double low = s.at_rest(100).mean_stiffness, high = s.at_rest(300).mean_stiffness;
        return Finding{
            std::abs(high / low - 1) <= 0.028 ? 1.0 : 0.0,
            text("by ", digits(100 * (high / low - 1), 2), " %: ", digits(low * kMega), ", ",
                 digits(s.at_rest(200).mean_stiffness * kMega), ", ", digits(high * kMega), " N/µm")};
      }));
  c.push_back(statement("stiffness-spectrum", "3, Fig 13", "spectrum of k changes sharply with torque",
                        "\"sharply\" has no number: first harmonic over the mean falls with torque, by a "
                        "fifth at least, while the mean changes by a "
                        "few per cent",
                        stiffness_spectrum));
  c.push_back(statement(
      "stiffness-modest", "3, Fig 13", "k of the statics differs modestly from the rectangular wave",
      "\"modestly\" has no number: by an RMS of 20 % of the mean at most, what the wave itself swings",
      modest_difference));
  c.push_back(statement(
      "spectrum-lost", "4, Fig 13", "low harmonics of the rectangular wave are lost in k of the statics",
      "\"lost\" has no number: harmonics 1 to 3 smaller at each torque, by half at 300 N m", spectrum_lost));
  c.push_back(incomparable("sdof-as-rig", "3, Fig 14",
                           "rectangular wave: amplitudes and jumps of the rig with reasonable accuracy",
                           "yes/no", kNone, rig, largest_text("rectangular")));
  for (int torque : kTorques)
    c.push_back(statement(text("sdof-jumps-", torque), "3, Fig 14",
                          "rectangular wave: jumps, " + torques(torque), "both sweeps have one",
                          [=](const SceneAnswers& s) { return lumped_jumps(s, torque); }));
  c.push_back(number("sdof-resonance-2", "3, Fig 14", "rectangular wave: resonance at half of f_n", "1", 0.5,
                     0.05, about, [](const SceneAnswers& s) { return resonance(s, 2, "rectangular"); }));
  c.push_back(statement(
      "sdof-torque-independent", "3, Fig 14", "rectangular wave: jump frequencies independent of torque",
      "apart by 1 Hz at most at 100, 200, 300 N m: ends of branches are found to less", torque_independent));
  c.push_back(
      statement("sdof-mean-opposite", "3, Fig 14", "the mean DTE jumps up where its RMS jumps down, and back",
                "opposite signs at every jump", [](const SceneAnswers& s) { return mean_jumps(s, false); }));
  c.push_back(statement("sdof-mean-less", "3, Fig 14", "changes of the mean DTE less than those of its RMS",
                        "at every jump", [](const SceneAnswers& s) { return mean_jumps(s, true); }));
  c.push_back(number("sdof-kink", "3, Fig 14", "rectangular wave: contact loss begins around", "Hz", 3100, 50,
                     "\"around\": half of the last printed digit", [](const SceneAnswers& s) {
                       const std::vector<double> lost =
                           speeds_with_loss(s.branches(kFigureTorque, "rectangular"));
                       if (lost.empty()) return Finding{kNone, "contact never lost"};
                       const double f_n = s.branches(kFigureTorque, "rectangular").up.natural_frequency;
                       return Finding{lost.back(), text(digits(lost.back() / f_n, 3), " f_n")};
                     }));
  c.push_back(statement("sdof-upper-2200", "Fig 15", "rectangular wave, 150 N m: upper branch at 2200 Hz",
                        "two steady states there",
                        [](const SceneAnswers& s) { return lumped_two(s, 2200); }));
  c.push_back(statement("sdof-upper-loses", "3, Fig 15", "contact loss on it", "one loss a cycle or more",
                        [](const SceneAnswers& s) { return lumped_loss(s, 2200, true); }));
  c.push_back(statement("sdof-lower-2150", "Fig 15", "lower branch at 2150 Hz",
                        "a motion without contact loss there, the only one or not: P2000's upper branch, "
                        "still there at 2200 Hz, may have ended",
                        [](const SceneAnswers& s) { return lumped_loss(s, 2150, false); }));
  c.push_back(statement("sdof-force-step", "3, Fig 15", "the net mesh force is discontinuous where k steps",
                        "a step between samples above 10 % of the largest force, as in a drawn curve, and "
                        "thrice those beside it, as on no slope",
                        [](const SceneAnswers& s) {
                          return force_step(s.sweep(kFigureTorque, "up", "rectangular"), 2150, false, false);
                        }));
  c.push_back(statement(
      "secant-reduced", "3, Fig 16", "k of the statics: amplitudes strikingly reduced",
      "\"strikingly\" has no number: half of those of the rectangular wave at most, 100, 200, 300 N m",
      secant_reduced));
  c.push_back(statement(
      "secant-loss-100", "3, Fig 16", "k of the statics: contact loss at the low torque, 100 N m",
      "at one speed at least", [](const SceneAnswers& s) {
        const Branches b = s.branches(100, "secant");
        return Finding{speeds_with_loss(b).empty() ? 0.0 : 1.0,
                       text(loss_text(b), "; first harmonic of k ",
                            digits(100 * first_harmonic_share(s.at_rest(100)), 3), " % of its mean")};
      }));
  for (int torque : {200, 300})
    c.push_back(statement(text("secant-linear-", torque), "3, Fig 16",
                          "k of the statics: linear at " + torques(torque), "no contact loss, no jump",
                          [=](const SceneAnswers& s) { return secant_linear(s, torque); }));
  c.push_back(incomparable("fig14-fig16", "Figs 14, 16", "RMS and mean of the DTE against speed", "µm", kNone,
                           curve, largest_text("secant")));
  c.push_back(incomparable("secant-against-rig", "3, Fig 16",
                           "k of the statics: results do not agree with the rig", "yes/no", kNone, rig,
                           nothing()));
  return c;
}

}  // namespace

const std::vector<Claim>& paper_claims() {
  static const std::vector<Claim> claims = make_claims();
  return claims;
}

}  // namespace whine
