// Signals known at instants that are dense but not evenly spaced, as samples of one rate below a low-pass filter.
//
// y(t_k) = sum over j of w_j h(t_k - t_j) x_j / sum over j of w_j h(t_k - t_j),   t_k = k / rate
//
// h: sinc(t rate) in a Kaiser window of 20 samples on either side: flat within 1e-4 up to 5/12 of the rate (20 kHz at 48 kHz),
// half at 1/2, below 1e-4 from 7/12 on, so that what folds back lies between 5/12 and 1/2. w_j: weights of a quadrature over
// time (s). Instants that are a smooth function of j with w_j = dt/dj make the trapezoidal rule, whose error falls faster
// than any power of the spacing.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "base/matrix.h"

namespace whine {

class UniformSampler {
 public:
  static constexpr int kHalfWidth = 20;  // samples

  // rate: Hz; count: samples 0 to count - 1; a sample needs instants from kHalfWidth / rate before to as long after it.
  UniformSampler(double rate, Eigen::Index count, int channels);

  // The next instant t (s, ascending) with its weight (s); x: (channel).
  void push(double t, double weight, const double* x);
  // Samples that no later instant can change: (sample, channel), in order, without those taken before.
  MatrixRM take();
  // Whether all `count` samples are ready or taken.
  bool complete() const { return first_ == count_; }

 private:
  double* row(Eigen::Index k) { return &sums_[static_cast<size_t>(k % rows_ * (channels_ + 1))]; }

  double rate_;
  Eigen::Index count_, first_ = 0;  // first_: sample that may still change
  int channels_, rows_;
  std::vector<double> table_;  // h over the distance in samples
  std::vector<double> sums_;   // (sample, channel and weight), of the samples from first_ on in turn
  std::vector<double> ready_;  // (sample, channel)
};

}  // namespace whine
