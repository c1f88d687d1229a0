#include "paper/findings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/error.h"
#include "lumped/stiffness.h"
#include "signal/branches.h"
#include "signal/response.h"

namespace whine::paper {

namespace {

// The load of a tooth pair on its whole way through the mesh: pair j at the end of a period is pair j + 1 of the next one.
Eigen::VectorXd load_of_a_pair(const SweepResult& sweep, Index row) {
  const MatrixRM& load = sweep.tooth_load[static_cast<size_t>(row)];
  Eigen::VectorXd way(load.size());
  for (Index pair = 0; pair < load.cols(); ++pair)
    way.segment(pair * load.rows(), load.rows()) = load.col(pair);
  return way;
}

}  // namespace

Finding lumped_jumps(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque, MotionModel::rectangular);
  if (jumps(b)) return {1, jumps_text(b)};
  const RectangularWave& wave = s.at_rest(kTorques[0]).rectangular_wave;
  return {0, text("one branch; ", loss_text(b), "; levels ", digits(wave.low * kMega), " and ",
                  digits(wave.high * kMega), " N/µm, ratio ", digits(wave.high / wave.low, 3),
                  "; first harmonic ", digits(100 * wave.amplitude(1) / wave.mean(), 3), " % of their mean")};
}

Finding torque_independent(const SceneResults& s) {
  const auto marks = [&](int torque) {
    const Branches b = s.branches(torque, MotionModel::rectangular);
    std::vector<double> at;
    for (const ResponseResult* r : {&b.up, &b.down})
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
    const Branches low = s.branches(100, MotionModel::rectangular),
                   high = s.branches(300, MotionModel::rectangular);
    const double off =
        ((high.up.dte_rms / 3 - low.up.dte_rms).array() / low.up.dte_rms.array()).abs().maxCoeff();
    return {kNone, text("no jumps; RMS over torque is the same at 100 and 300 N m ",
                        off < 1e-12 ? "to round-off" : "to " + digits(off, 2) + " of itself")};
  }
  return {largest <= 1 ? 1.0 : 0.0,
          text("jumps at the three torques differ by ", digits(largest, 3), " Hz at most")};
}

Finding mean_jumps(const SceneResults& s, bool less) {
  const Branches b = s.branches(kFigureTorque, MotionModel::rectangular);
  bool holds = true;
  std::string note;
  for (const ResponseResult* r : {&b.up, &b.down})
    for (const Index i : rows_before_jumps(*r)) {
      if (i < 0) continue;
      const double rms = r->dte_rms(i + 1, 0) - r->dte_rms(i, 0),
                   mean = r->dte_mean(i + 1, 0) - r->dte_mean(i, 0);
      if (less ? std::abs(mean) >= std::abs(rms) : mean * rms >= 0) holds = false;
      note += text(note.empty() ? "" : "; ", r->direction, ": RMS ", digits(rms * kMicro, 3), ", mean ",
                   digits(mean * kMicro, 3), " µm");
    }
  if (note.empty()) return {kNone, "no jumps; " + loss_text(b)};
  return {holds ? 1.0 : 0.0, note};
}

Finding lumped_two(const SceneResults& s, double f) {
  const Branches b = s.branches(kFigureTorque, MotionModel::rectangular);
  const Pair at = motions(b, f);
  if (!at.two()) return {0, text("one branch; ", jumps_text(b))};
  return {1, text("RMS ", digits(at.upper.rms() * kMicro, 3), " and ", digits(at.lower.rms() * kMicro, 3),
                  " µm at ", digits(at.upper.speed()), " Hz")};
}

Finding lumped_loss(const SceneResults& s, double f, bool upper) {
  const Pair at = motions(s.branches(kFigureTorque, MotionModel::rectangular), f);
  if (!at.there() || (upper && !at.two())) return {kNone, text("one branch at ", digits(f), " Hz")};
  const Motion& m = upper ? at.upper : at.lower;
  return {m.loses_contact() == upper ? 1.0 : 0.0,
          text(at.two() ? "" : "the only branch; ", digits(m.losses(), 3), " losses a period at ",
               digits(m.speed()), " Hz")};
}

Finding force_step(const SweepResult& sweep, double f, bool one_pair, bool smooth) {
  Index row;
  (sweep.mesh_frequency.array() - f).abs().minCoeff(&row);
  const Eigen::VectorXd load = one_pair ? load_of_a_pair(sweep, row)
                                        : Eigen::VectorXd(sweep.mesh_force[static_cast<size_t>(row)].col(0));
  const Step step = largest_step(load);
  const double change = std::abs(step.after - step.before), share = change / load.maxCoeff();
  return {(share > 0.1 && change > 3 * step.beside) == smooth ? 0.0 : 1.0,
          text("largest step between neighbouring samples from ", digits(step.before), " to ",
               digits(step.after), " N, ", digits(100 * share, 3), " % of the largest load, beside it ",
               digits(step.beside), " N, at ", digits(sweep.mesh_frequency[row]), " Hz")};
}

Finding secant_reduced(const SceneResults& s) {
  bool reduced = true;
  std::string note;
  for (int torque : kTorques) {
    const double ratio = largest_rms(s.branches(torque, MotionModel::secant)) /
                         largest_rms(s.branches(torque, MotionModel::rectangular));
    reduced = reduced && ratio <= 0.5;
    note += text(note.empty() ? "" : ", ", digits(ratio, 3));
  }
  return {reduced ? 1.0 : 0.0, "largest RMS over that of the rectangular wave at 100, 200, 300 N m: " + note};
}

Finding secant_linear(const SceneResults& s, int torque) {
  const Branches b = s.branches(torque, MotionModel::secant);
  const double difference =
      ((b.up.dte_rms - b.down.dte_rms.colwise().reverse()).array() / b.up.dte_rms.array()).abs().maxCoeff();
  const bool linear = speeds_with_loss(b).empty() && !jumps(b);
  return {linear ? 1.0 : 0.0,
          text(loss_text(b), "; up and down differ by ", digits(100 * difference, 2), " % at most")};
}

Finding stiffness_spectrum(const SceneResults& s) {
  std::array<double, 3> share{};
  std::string note;
  for (size_t t = 0; t < kTorques.size(); ++t) {
    share[t] = first_harmonic_share(s.at_rest(kTorques[t]));
    note += text(note.empty() ? "" : ", ", digits(100 * share[t], 3));
  }
  const bool falls = share[0] > share[1] && share[1] > share[2] && share[2] < 0.8 * share[0];
  return {falls ? 1.0 : 0.0, "first harmonic of k over its mean at 100, 200, 300 N m: " + note + " %"};
}

Finding spectrum_lost(const SceneResults& s) {
  const RectangularWave& wave = s.at_rest(100).rectangular_wave;
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
    const StaticResult& a = s.at_rest(torque);
    ratio = strength([&](int n) { return a.stiffness_harmonic[n]; }) / whole;
    less = less && ratio < 1;
    note += text(note.empty() ? "" : ", ", digits(ratio, 3));
  }
  return {less && ratio <= 0.5 ? 1.0 : 0.0,
          "harmonics 1 to 3 of k over those of the rectangular wave at 100, 200, 300 N m: " + note};
}

Finding modest_difference(const SceneResults& s) {
  double largest = 0;
  const RectangularWave& wave = s.at_rest(100).rectangular_wave;
  for (int torque : kTorques) {
    const StaticResult& a = s.at_rest(torque);
    double sum = 0;
    for (Index i = 0; i < a.mesh_phase.size(); ++i)
      sum += std::pow(a.stiffness_secant[i] - wave.at(a.mesh_phase[i]), 2);
    largest = std::max(largest, std::sqrt(sum / static_cast<double>(a.mesh_phase.size())) / a.mean_stiffness);
  }
  return {largest <= 0.2 ? 1.0 : 0.0,
          text("RMS difference at most ", digits(100 * largest, 3), " % of the mean stiffness")};
}

}  // namespace whine::paper
