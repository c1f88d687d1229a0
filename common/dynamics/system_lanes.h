// What a step of a system does to rows of coordinates and of relaxed loads, four numbers at a time (contact/lanes.h); rows and sums of
// contacts by their numbers, a sum of each in four lanes.
#pragma once
#include <type_traits>

#include "contact/lanes.h"

namespace whine {

// Coefficients of a coordinate in run_lanes(): a11, a12, a21, a22, what a force takes off z and off v.
inline constexpr int kRun = 6;

// visit(count) with a constant; of more than four with 4.
template <class Visit>
void as_constant(int count, const Visit& visit) {
  switch (count) {
    case 0:
      return visit(std::integral_constant<int, 0>());
    case 1:
      return visit(std::integral_constant<int, 1>());
    case 2:
      return visit(std::integral_constant<int, 2>());
    case 3:
      return visit(std::integral_constant<int, 3>());
    default:
      return visit(std::integral_constant<int, 4>());
  }
}

// visit(rows, first): contacts in fours from number `first` on, then what is left; rows is a constant.
template <class Visit>
void in_fours(int first, int count, const Visit& visit) {
  for (; first < count; first += 4)
    as_constant(count - first, [&](auto rows) {
      if constexpr (rows > 0) visit(rows, first);
    });
}

// sum[i] -= row[i] . z lane by lane up to number `end`, rows `length` apart; of few rows two sums each, which do not wait for each other.
template <int kRows>
void subtract_rows(const double* rows, int length, int end, const double* z, double* sums,
                   const int* contact) {
  constexpr bool kTwice = kRows < 4;
  Lanes total[kRows], other[kRows] = {};
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) total[r] = lanes(sums + contact[r] * kLanes);
  int i = 0;
  for (; kTwice && i + 2 * kLanes <= end; i += 2 * kLanes)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      total[r] -= lanes(rows + r * length + i) * lanes(z + i);
      other[r] -= lanes(rows + r * length + i + kLanes) * lanes(z + i + kLanes);
    }
  for (; i < end; i += kLanes)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) total[r] -= lanes(rows + r * length + i) * lanes(z + i);
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) lanes(sums + contact[r] * kLanes) = kTwice ? total[r] + other[r] : total[r];
}

// z and v of four coordinates in turn to the end of the next step, from what they are at the end of this one without its new forces, by kRun
// coefficients each; force: of the rows `pushed`. Gaps there: sum[i] -= row[i] . z, rows `length` apart.
template <int kPushed, int kRead>
void run_lanes(const double* coefficients, int count, const double* const* pushed, const double* force,
               double* z, double* v, const double* rows, int length, double* sums, const int* contact) {
  const double* push[kPushed + 1];
  double by[kPushed + 1];
  for (int j = 0; j < kPushed; ++j) push[j] = pushed[j], by[j] = force[j];
  Lanes total[kRead + 1];
#pragma GCC unroll 4
  for (int r = 0; r < kRead; ++r) total[r] = lanes(sums + contact[r] * kLanes);
  for (int i = 0; i < count; i += kLanes, coefficients += kRun * kLanes) {
    const auto of = [&](int which) { return lanes(coefficients + which * kLanes); };
    Lanes sum{};
#pragma GCC unroll 4
    for (int j = 0; j < kPushed; ++j) sum += by[j] * lanes(push[j] + i);
    const Lanes before = lanes(z + i), speed = lanes(v + i),
                after = of(0) * before + of(1) * speed - of(4) * sum;
    lanes(v + i) = of(2) * before + of(3) * speed - of(5) * sum;
    lanes(z + i) = after;
#pragma GCC unroll 4
    for (int r = 0; r < kRead; ++r) total[r] -= lanes(rows + r * length + i) * after;
  }
#pragma GCC unroll 4
  for (int r = 0; r < kRead; ++r) lanes(sums + contact[r] * kLanes) = total[r];
}

// visit(i, sum[i] of factor[j] * row[j]) up to number `end`, in lanes.
template <class Visit>
void sum_rows(const double* const* row, const double* factor, int count, int end, const Visit& visit) {
  int i = 0;
  for (; i + 2 * kLanes <= end; i += 2 * kLanes) {
    Lanes sum{}, next{};
    for (int j = 0; j < count; ++j) {
      sum += factor[j] * lanes(row[j] + i);
      next += factor[j] * lanes(row[j] + i + kLanes);
    }
    visit(i, sum);
    visit(i + kLanes, next);
  }
  if (i == end) return;
  Lanes sum{};
  for (int j = 0; j < count; ++j) sum += factor[j] * lanes(row[j] + i);
  visit(i, sum);
}

// sum[i] += w[i] . fields of all pairs, which lie `apart` from one another in w.
template <int kFields, int kRows>
void add_readings(const double* w, int apart, const double* fields, int pairs, double* sums,
                  const int* contact) {
  Lanes total[kRows], other[kRows] = {};
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) total[r] = lanes(sums + contact[r] * kLanes);
  for (int pair = 0; pair < pairs; ++pair, w += apart, fields += kFields)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      const double* of = w + r * kFields;
      total[r] += lanes(of) * lanes(fields) + lanes(of + 4) * lanes(fields + 4);
      other[r] += lanes(of + 8) * lanes(fields + 8);
    }
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) lanes(sums + contact[r] * kLanes) = total[r] + other[r];
}

}  // namespace whine
