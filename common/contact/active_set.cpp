// The linear algebra of active sets: factors and inverses of A on them, grown, bordered and applied.
#include "contact/complementarity.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/error.h"
#include "contact/lanes.h"

namespace whine {

using Eigen::VectorXd;

void GrowingMatrix::reserve(int n) {
  const int stride = padded(n);
  if (stride <= stride_) return;
  store_.assign(static_cast<size_t>(stride) * static_cast<size_t>(stride), 0.0);
  stride_ = stride;
  size_ = 0;
}

void ComplementaritySolver::reserve(int n) {
  if (static_cast<int>(in_.size()) >= n) return;
  in_.resize(n);
  wrong_.reserve(n);
  next_.reserve(n);
  fresh_.reserve(n);
  factor_.reserve(n);
  grown_.reserve(n);
  for (VectorXd* v : {&right_, &p_active_, &work_, &reciprocal_, &force_, &target_}) v->setZero(padded(n));
}

// Cholesky, column by column from the left, of A on active.strips. What stands above the diagonal is 0.
void ComplementaritySolver::factorise(const Matrix& a, ActiveSet& active) {
  constexpr double kLeastPivot = 1e-13;                      // of the diagonal: below it is round-off
  constexpr double kFirstShift = 1e-13, kLastShift = 1e-10;  // of the largest diagonal
  const int k = static_cast<int>(active.strips.size()), end = padded(k);
  const int* strips = active.strips.data();
  active.known = active.shifted = false;
  active.updates = 0;
  factored_ = true;
  factor_.resize(k);
  double largest = 0, least = std::numeric_limits<double>::infinity();
  for (int j = 0; j < k; ++j) {
    const double diagonal = a(strips[j], strips[j]);
    if (!std::isfinite(diagonal))
      fail(Failure::numerical, "the compliance of strip ", strips[j], " is ", diagonal,
           " m/N: the body's table holds no number");
    largest = std::max(largest, diagonal);
    least = std::min(least, diagonal);
  }
  double pivot = least, diagonal = least;
  double* row = work_.data();
  for (double shift = 0; least > 0; shift = shift == 0 ? kFirstShift * largest : 10 * shift) {
    if (shift > kLastShift * largest) break;
    active.shifted = shift > 0;
    int j = 0;
    for (; j < k; ++j) {
      double* column = factor_.column(j);
      const int first = j / kLanes * kLanes;
      const double* from = a.data() + strips[j] * a.outerStride();
      for (int i = j; i < k; ++i) column[i] = from[strips[i]];
      std::fill(column + k, column + end, 0.0);
      diagonal = column[j] += shift;
      for (int i = 0; i < j; ++i) row[i] = -factor_.column(i)[j];
      add_columns(column, factor_.column(0), factor_.stride(), row, j, first, end);
      pivot = column[j];
      if (!(pivot > kLeastPivot * diagonal * (shift > 0 ? 0.1 : 1.0))) break;
      std::fill(column, column + j, 0.0);
      const double scale = reciprocal_[j] = 1 / std::sqrt(pivot);
      for (int i = first; i < end; i += kLanes) lanes(column + i) *= scale;
    }
    if (j == k) return;
  }
  if (k == 0) return;
  fail(Failure::numerical, "the compliance of ", k, " active strips is not positive definite: pivot ", pivot,
       " m/N of the diagonal ", diagonal, " m/N (at least ", kLeastPivot,
       " of it is needed); the least diagonal is ", least,
       " m/N: the body's table is wrong or strips coincide with different gaps");
}

// An active set from nothing: Cholesky of A whose next pivot is the strip with the least gap, until no gap is
// negative or the pivot is round-off. The rows of L below the set carry the gaps of all strips along. Ends with the
// inverse, which the next problem with this A needs anyway.
void ComplementaritySolver::grow(const Matrix& a, const Vector& e, ActiveSet& active) {
  constexpr double kLeastPivot = 1e-10;  // of the diagonal
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int n = static_cast<int>(e.size()), end = padded(n);
  const double tolerance = 1e-12 * scale_;
  double *gap = target_.data(), *row = work_.data();
  std::copy(e.data(), e.data() + n, gap);
  std::fill(gap + n, gap + end, kInfinity);
  active.shifted = false;
  active.updates = 0;
  int k = 0;
  for (; k < n; ++k) {
    Lanes least = lanes(gap);
    for (int i = kLanes; i < end; i += kLanes) {
      const Lanes other = lanes(gap + i);
      least = other < least ? other : least;
    }
    const double value = std::min(std::min(least[0], least[1]), std::min(least[2], least[3]));
    if (!(value < -tolerance)) break;
    const int strip = static_cast<int>(std::find(gap, gap + n, value) - gap);
    double* column = grown_.column(k);
    std::copy(a.data() + strip * a.outerStride(), a.data() + strip * a.outerStride() + n, column);
    std::fill(column + n, column + end, 0.0);
    for (int j = 0; j < k; ++j) row[j] = -grown_.column(j)[strip];
    add_columns(column, grown_.column(0), grown_.stride(), row, k, 0, end);
    const double pivot = column[strip];
    if (!(pivot > kLeastPivot * a(strip, strip))) break;
    const double scale = reciprocal_[k] = 1 / std::sqrt(pivot), step = -value * scale;
    for (int i = 0; i < end; i += kLanes) {
      Lanes& l = lanes(column + i);
      l *= scale;
      lanes(gap + i) += step * l;
    }
    gap[strip] = kInfinity;
    for (int j = 0; j < k; ++j) factor_.column(j)[k] = -row[j];
    std::fill(factor_.column(k), factor_.column(k) + end, 0.0);
    factor_.column(k)[k] = pivot * scale;
    active.strips.push_back(strip);
  }
  factor_.resize(k);

  // What the factor leaves of each diagonal is negative only if A is not semidefinite, whether or not that strip would
  // come to carry force: another set may then solve the same problem, and this one is no answer.
  double* left = force_.data();
  for (int i = 0; i < n; ++i) left[i] = a(i, i);
  for (int i = 0; i < end; i += kLanes) {
    Lanes carried{};
    const double* row_of_factor = grown_.column(0) + i;
    for (int j = 0; j < k; ++j, row_of_factor += grown_.stride())
      carried += lanes(row_of_factor) * lanes(row_of_factor);
    lanes(left + i) -= carried;
  }
  for (int i = 0; i < n; ++i)
    if (left[i] < -kLeastPivot * a(i, i))
      fail(Failure::numerical, "the compliance of ", n, " strips is not positive definite: pivot ", left[i],
           " m/N of the diagonal ", a(i, i), " m/N at strip ", i, " beside ", k,
           " active strips: the body's table is wrong");
  invert(grown_);

  // From the order of the pivots to that of the strips.
  std::vector<int>&strips = active.strips, &rank = next_;
  wrong_.assign(n, 0);
  for (int strip : strips) wrong_[strip] = 1;
  std::exclusive_scan(wrong_.begin(), wrong_.end(), wrong_.begin(), 0);
  rank.clear();
  for (int strip : strips) rank.push_back(wrong_[strip]);
  active.inverse.resize(k);
  for (int j = 0; j < k; ++j) {
    const double* from = grown_.column(j);
    double* to = active.inverse.column(rank[j]);
    for (int i = 0; i < k; ++i) to[rank[i]] = from[i];
  }
  std::sort(strips.begin(), strips.end());
  active.known = true;
}

// The inverse B of the set from its factor: B L = L^-T, whose lower triangle is 1 / L_jj on the diagonal, gives
// the columns of B from the last to the first.
void ComplementaritySolver::invert(GrowingMatrix& b) {
  const int k = factor_.rows(), end = padded(k);
  b.resize(k);
  double* f = work_.data();
  for (int j = k - 1; j >= 0; --j) {
    double *column = b.column(j), *l = factor_.column(j);
    const double scale = reciprocal_[j];
    for (int i = j + 1; i < k; ++i) f[i] = -scale * l[i];
    const int first = j / kLanes * kLanes;
    std::fill(column + first, column + end, 0.0);
    if (j + 1 < k) add_columns(column, b.column(j + 1), b.stride(), f + j + 1, k - j - 1, first, end);
    std::fill(column + first, column + j + 1, 0.0);
    column[j] = scale * (scale - dot(column, l, first, end));
    for (int i = j + 1; i < k; ++i) b.column(i)[j] = column[i];
  }
}

// From the kept inverse B of active.strips to that of next_, one strip at a time:
//   goes: B - b b^T / b_i;  comes: [B + v v^T / s, -v / s; -v^T / s, 1 / s], v = B a, s = a_ii - a . v.
// False if that would cost more than a factorisation or lose digits; the set is then to be factorised.
bool ComplementaritySolver::border(const Matrix& a, ActiveSet& active) {
  constexpr int kMostUpdates = 50;      // round-off of many updates adds up
  constexpr double kLeastPivot = 1e-6;  // of the diagonal
  std::vector<int>& strips = active.strips;
  GrowingMatrix& b = active.inverse;
  int changes = 0;
  for (size_t i = 0, j = 0; i < strips.size() || j < next_.size();) {
    const int old = i < strips.size() ? strips[i] : std::numeric_limits<int>::max();
    const int now = j < next_.size() ? next_[j] : std::numeric_limits<int>::max();
    changes += old != now;
    i += old <= now;
    j += now <= old;
  }
  if (active.shifted || active.updates + changes > kMostUpdates ||
      4 * changes > static_cast<int>(next_.size()) + 3)
    return false;
  active.updates += changes;
  double *v = work_.data(), *right = right_.data();
  for (int position = static_cast<int>(strips.size()) - 1; position >= 0; --position) {
    if (in_[strips[position]]) continue;
    const int k = b.rows();
    std::copy(b.column(position), b.column(position) + padded(k), v);
    const double scale = -1 / v[position];
    for (int j = 0; j < k; ++j) {
      if (j == position) continue;
      double *from = b.column(j), *to = b.column(j > position ? j - 1 : j);
      const double f = scale * v[j];
      add_columns(from, v, 0, &f, 1, 0, padded(k));
      if (to != from) std::copy(from, from + position, to);
      std::copy(from + position + 1, from + k, to + position);
    }
    b.resize(k - 1);
    strips.erase(strips.begin() + position);
  }
  for (int position = 0; position < static_cast<int>(next_.size()); ++position) {
    const int strip = next_[position], k = b.rows(), end = padded(k);
    if (position < k && strips[position] == strip) continue;
    const double* column = a.data() + strip * a.outerStride();
    for (int i = 0; i < k; ++i) right[i] = column[strips[i]];
    std::fill(right + k, right + end, 0.0);
    std::fill(v, v + end, 0.0);
    add_columns(v, b.column(0), b.stride(), right, k, 0, end);
    std::fill(v + k, v + end, 0.0);
    const double s = column[strip] - dot(v, right, 0, end);
    if (!(s > kLeastPivot * column[strip])) return false;
    for (int j = k - 1; j >= 0; --j) {
      double *from = b.column(j), *to = b.column(j >= position ? j + 1 : j);
      const double f = v[j] / s;
      add_columns(from, v, 0, &f, 1, 0, end);
      std::copy_backward(from + position, from + k, to + k + 1);
      if (to != from) std::copy(from, from + position, to);
      to[position] = -f;
    }
    double* added = b.column(position);
    for (int i = 0; i < k; ++i) added[i < position ? i : i + 1] = -v[i] / s;
    added[position] = 1 / s;
    b.resize(k + 1);
    strips.insert(strips.begin() + position, strip);
  }
  return true;
}

void ComplementaritySolver::list(std::vector<int>& strips) const {
  strips.clear();
  for (int i = 0; i < static_cast<int>(in_.size()); ++i)
    if (in_[i]) strips.push_back(i);
}

// result = A^-1 right on the active set, both padded.
void ComplementaritySolver::apply(const ActiveSet& active, const double* right, double* result) {
  const int k = static_cast<int>(active.strips.size()), end = padded(k);
  if (!factored_) {
    std::fill(result, result + end, 0.0);
    add_columns(result, active.inverse.column(0), active.inverse.stride(), right, k, 0, end);
    return;
  }
  double* y = work_.data();
  std::copy(right, right + k, y);
  std::fill(y + k, y + end, 0.0);
  std::fill(result, result + end, 0.0);
  for (int j = 0; j < k; ++j) {
    const double value = y[j] * reciprocal_[j], negative = -value;
    add_columns(y, factor_.column(j), 0, &negative, 1, j / kLanes * kLanes, end);
    y[j] = value;
  }
  for (int j = k - 1; j >= 0; --j)
    result[j] = (y[j] - dot(factor_.column(j), result, j / kLanes * kLanes, end)) * reciprocal_[j];
}

}  // namespace whine
