// Loops over four numbers at a time, for vectors and columns whose length is a multiple of 4. Blocks of 10 to 40 rows
// are too small for a BLAS, and most of a time step runs down such columns.
#pragma once
#include <cstddef>

namespace whine {

inline constexpr int kLanes = 4;
typedef double Lanes __attribute__((vector_size(8 * kLanes), aligned(8), may_alias));
typedef long long LaneIndex __attribute__((vector_size(8 * kLanes)));

constexpr int padded(int n) {
  return (n + kLanes - 1) / kLanes * kLanes;
}

inline const Lanes& lanes(const double* x) {
  return *reinterpret_cast<const Lanes*>(x);
}
inline Lanes& lanes(double* x) {
  return *reinterpret_cast<Lanes*>(x);
}

// y[first..last) += sum over j < count of f[j] * column j; first and last multiples of 4.
inline void add_columns(double* y, const double* columns, int stride, const double* f, int count, int first,
                        int last) {
  int j = 0;
  for (; j + 4 <= count; j += 4) {
    const double *c0 = columns + static_cast<std::ptrdiff_t>(j) * stride, *c1 = c0 + stride,
                 *c2 = c1 + stride, *c3 = c2 + stride;
    const double f0 = f[j], f1 = f[j + 1], f2 = f[j + 2], f3 = f[j + 3];
    for (int i = first; i < last; i += kLanes)
      lanes(y + i) += f0 * lanes(c0 + i) + f1 * lanes(c1 + i) + f2 * lanes(c2 + i) + f3 * lanes(c3 + i);
  }
  for (; j < count; ++j) {
    const double* c = columns + static_cast<std::ptrdiff_t>(j) * stride;
    const double f0 = f[j];
    for (int i = first; i < last; i += kLanes) lanes(y + i) += f0 * lanes(c + i);
  }
}

inline double sum(Lanes a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

inline double dot(const double* x, const double* y, int first, int last) {
  Lanes total{};
  for (int i = first; i < last; i += kLanes) total += lanes(x + i) * lanes(y + i);
  return sum(total);
}

// The sums of four vectors, one in each lane.
inline Lanes sums(Lanes a, Lanes b, Lanes c, Lanes d) {
  constexpr LaneIndex even{0, 4, 2, 6}, odd{1, 5, 3, 7}, low{0, 1, 4, 5}, high{2, 3, 6, 7};
  const Lanes ab = __builtin_shuffle(a, b, even) + __builtin_shuffle(a, b, odd);
  const Lanes cd = __builtin_shuffle(c, d, even) + __builtin_shuffle(c, d, odd);
  return __builtin_shuffle(ab, cd, low) + __builtin_shuffle(ab, cd, high);
}

// result[j] = column j . x, j < count; rows and count multiples of 4.
inline void dot_columns(double* result, const double* columns, int stride, int count, const double* x,
                        int rows) {
  for (int j = 0; j < count; j += 4) {
    const double *c0 = columns + static_cast<std::ptrdiff_t>(j) * stride, *c1 = c0 + stride,
                 *c2 = c1 + stride, *c3 = c2 + stride;
    Lanes a{}, b{}, c{}, d{};
    for (int i = 0; i < rows; i += kLanes) {
      const Lanes right = lanes(x + i);
      a += lanes(c0 + i) * right;
      b += lanes(c1 + i) * right;
      c += lanes(c2 + i) * right;
      d += lanes(c3 + i) * right;
    }
    lanes(result + j) = sums(a, b, c, d);
  }
}

}  // namespace whine
