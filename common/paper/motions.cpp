#include "paper/motions.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"

namespace whine::paper {

Index row_at(const ResponseResult& r, double f) {
  Index nearest = 0;
  const auto off = [&](Index i) { return std::abs(r.mesh_frequency[i] - f); };
  for (Index i = 1; i < r.mesh_frequency.size(); ++i)
    if (off(i) < off(nearest) || (off(i) == off(nearest) && r.mesh_frequency[i] < r.mesh_frequency[nearest]))
      nearest = i;
  return off(nearest) <= 0.01 * f ? nearest : -1;
}

Pair motions(const Branches& b, double f) {
  const Motion up{&b.up, row_at(b.up, f)}, down{&b.down, row_at(b.down, f)};
  if (up.row < 0 || down.row < 0 || up.speed() != down.speed()) return {};
  Pair pair = up.rms() > down.rms() ? Pair{up, down} : Pair{down, up};
  pair.order = f < kSecondaryEnd * b.up.natural_frequency ? 2 : 1;
  return pair;
}

Pair printed_branches(const SceneResults& s, double f) {
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

double step_of(const ResponseResult& r) {
  return r.mesh_frequency.size() < 2 ? 0 : std::abs(r.mesh_frequency[1] - r.mesh_frequency[0]);
}

std::vector<double> speeds_with_loss(const Branches& b) {
  std::vector<double> speeds;
  for (const ResponseResult* r : {&b.up, &b.down})
    for (Index i = 0; i < r->mesh_frequency.size(); ++i)
      if (r->separation_fraction(i, 0) > 0) speeds.push_back(r->mesh_frequency[i]);
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
  for (const ResponseResult* r : {&b.up, &b.down}) {
    words += text(words.empty() ? "" : "; ", r->direction, " ");
    std::vector<double> at(r->jump_frequency.data(), r->jump_frequency.data() + r->jump_frequency.size());
    std::sort(at.begin(), at.end());
    for (size_t j = 0; j < at.size(); ++j) words += (j ? ", " : "") + digits(at[j]);
    words += at.empty() ? "none" : " Hz";
  }
  return "jumps " + words;
}

double first_harmonic_share(const StaticResult& s) {
  return s.stiffness_harmonic[1] / s.stiffness_harmonic[0];
}

std::string excitation(const SceneResults& s, int torque) {
  std::string words = text("first harmonic of k ", digits(100 * first_harmonic_share(s.at_rest(torque)), 3),
                           " % of its mean");
  const auto damped = s.impacts.find(text("T", torque, "/impact.h5"));
  if (damped != s.impacts.end())
    words += text(", damping ", digits(100 * damped->second.states.damping_ratio.tail(1)[0], 3), " %");
  return words;
}

std::string loss_text(const Branches& b) {
  const std::vector<double> lost = speeds_with_loss(b);
  return lost.empty() ? "contact never lost" : "contact lost at " + speeds_text(lost, step_of(b.up));
}

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

}  // namespace whine::paper
