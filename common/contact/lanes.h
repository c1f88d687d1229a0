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

// y[0..4 kBlock) += sum over j < count of f[j] * column j, all of y in registers.
template <int kBlock>
inline void add_to_block(double* y, const double* columns, int stride, const double* f, int count) {
  Lanes even[kBlock], odd[kBlock] = {};
#pragma GCC unroll 5
  for (int k = 0; k < kBlock; ++k) even[k] = lanes(y + k * kLanes);
  int j = 0;
  for (; j + 2 <= count; j += 2, columns += 2 * static_cast<std::ptrdiff_t>(stride))
#pragma GCC unroll 5
    for (int k = 0; k < kBlock; ++k) {
      even[k] += f[j] * lanes(columns + k * kLanes);
      odd[k] += f[j + 1] * lanes(columns + stride + k * kLanes);
    }
#pragma GCC unroll 5
  for (int k = 0; k < kBlock; ++k) {
    if (j < count) even[k] += f[j] * lanes(columns + k * kLanes);
    lanes(y + k * kLanes) = even[k] + odd[k];
  }
}

// y[first..last) += sum over j < count of f[j] * column j; first and last multiples of 4.
inline void add_columns(double* y, const double* columns, int stride, const double* f, int count, int first,
                        int last) {
  for (int i = first; i < last;) {
    const int left = (last - i) / kLanes;  // in blocks as large as registers hold, none of them small
    switch (left <= 5 ? left : left < 9 ? 4 : 5) {
      case 1:
        add_to_block<1>(y + i, columns + i, stride, f, count);
        return;
      case 2:
        add_to_block<2>(y + i, columns + i, stride, f, count);
        return;
      case 3:
        add_to_block<3>(y + i, columns + i, stride, f, count);
        return;
      case 4:
        add_to_block<4>(y + i, columns + i, stride, f, count);
        i += 4 * kLanes;
        break;
      default:
        add_to_block<5>(y + i, columns + i, stride, f, count);
        i += 5 * kLanes;
    }
  }
}

inline double sum(Lanes a) {
  return (a[0] + a[1]) + (a[2] + a[3]);
}

inline double dot(const double* x, const double* y, int first, int last) {
  Lanes total{}, other{};
  int i = first;
  for (; i + kLanes < last; i += 2 * kLanes) {
    total += lanes(x + i) * lanes(y + i);
    other += lanes(x + i + kLanes) * lanes(y + i + kLanes);
  }
  if (i < last) total += lanes(x + i) * lanes(y + i);
  return sum(total + other);
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

// kRows rows of `length`, a multiple of 4, side by side: four numbers of each in turn. Row j . x in lane j.
template <int kRows>
inline Lanes dot_rows(const double* rows, int length, const double* x) {
  static_assert(kRows <= kLanes);
  Lanes even[kLanes] = {}, odd[kLanes] = {};
  int i = 0;
  for (; i + 2 * kLanes <= length; i += 2 * kLanes, rows += 2 * kRows * kLanes)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      even[r] += lanes(rows + r * kLanes) * lanes(x + i);
      odd[r] += lanes(rows + (kRows + r) * kLanes) * lanes(x + i + kLanes);
    }
  for (int r = 0; i < length && r < kRows; ++r) even[r] += lanes(rows + r * kLanes) * lanes(x + i);
  return sums(even[0] + odd[0], even[1] + odd[1], even[2] + odd[2], even[3] + odd[3]);
}

// y[0..rows) = before + sum over k of f[k apart] * column k of six, `stride` apart; any number of rows.
inline void add_six_columns(double* y, const double* before, const double* columns, int stride,
                            const double* f, int apart, int rows) {
  const double *c0 = columns, *c1 = c0 + stride, *c2 = c1 + stride, *c3 = c2 + stride, *c4 = c3 + stride,
               *c5 = c4 + stride;
  const double f0 = f[0], f1 = f[apart], f2 = f[2 * apart], f3 = f[3 * apart], f4 = f[4 * apart],
               f5 = f[5 * apart];
  int i = 0;
  for (; i + kLanes <= rows; i += kLanes)
    lanes(y + i) = (lanes(before + i) + f0 * lanes(c0 + i) + f1 * lanes(c1 + i) + f2 * lanes(c2 + i)) +
                   (f3 * lanes(c3 + i) + f4 * lanes(c4 + i) + f5 * lanes(c5 + i));
  for (; i < rows; ++i)
    y[i] = (before[i] + f0 * c0[i] + f1 * c1[i] + f2 * c2[i]) + (f3 * c3[i] + f4 * c4[i] + f5 * c5[i]);
}

// y[0..12) += sum over j < count of f[j] * column j, all of y in registers; count even.
inline void add_columns_of_12(double* y, const double* columns, int stride, const double* f, int count) {
  Lanes a0 = lanes(y), a1 = lanes(y + 4), a2 = lanes(y + 8), b0{}, b1{}, b2{};
  const double *c = columns, *d = columns + stride;
  for (int j = 0; j < count; j += 2, c += 2 * stride, d += 2 * stride) {
    const double f0 = f[j], f1 = f[j + 1];
    a0 += f0 * lanes(c);
    a1 += f0 * lanes(c + 4);
    a2 += f0 * lanes(c + 8);
    b0 += f1 * lanes(d);
    b1 += f1 * lanes(d + 4);
    b2 += f1 * lanes(d + 8);
  }
  lanes(y) = a0 + b0;
  lanes(y + 4) = a1 + b1;
  lanes(y + 8) = a2 + b2;
}

// y[0..8) += sum over j < count of f[j] * column j of 8, one after the other; count a multiple of 4.
inline void add_columns_of_8(double* y, const double* columns, const double* f, int count) {
  Lanes a0 = lanes(y), a1 = lanes(y + 4), b0{}, b1{}, c0{}, c1{}, d0{}, d1{};
  for (int j = 0; j < count; j += 4, columns += 32) {
    a0 += f[j] * lanes(columns);
    a1 += f[j] * lanes(columns + 4);
    b0 += f[j + 1] * lanes(columns + 8);
    b1 += f[j + 1] * lanes(columns + 12);
    c0 += f[j + 2] * lanes(columns + 16);
    c1 += f[j + 2] * lanes(columns + 20);
    d0 += f[j + 3] * lanes(columns + 24);
    d1 += f[j + 3] * lanes(columns + 28);
  }
  lanes(y) = (a0 + b0) + (c0 + d0);
  lanes(y + 4) = (a1 + b1) + (c1 + d1);
}

}  // namespace whine
