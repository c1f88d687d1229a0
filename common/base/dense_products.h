// Products of matrices of doubles as calls of functions that are compiled once. Eigen compiles each pair of types anew, in four ways
// (coefficient by coefficient, matrix by column, row by matrix, matrix by matrix), which took half of the time of compiling dynamics/
// and a tenth of a build. By way of precompiled.h; without it Eigen's own product takes the same ways to the same numbers.
#pragma once
#include <Eigen/Core>
#include <type_traits>

namespace whine {

// rows x columns; entry (i, j) is data[i row_stride + j column_stride].
template <typename Entry>
struct MatrixView {
  Entry* data;
  Eigen::Index rows, columns, row_stride, column_stride;
};
using MatrixRead = MatrixView<const double>;
using MatrixWritten = MatrixView<double>;

// to (+)= factor a b, with to m x n, a m x k, b k x n; `to` overlaps neither. The ways are those of Eigen 3.4, generic_product_impl of
// GemmProduct (the first two: where m + n + k is below 20 the blocks of its kernels cost more than they save) and of GemvProduct.
void set_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor);
void add_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor);
void set_large_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor);
void add_large_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor);

// `m` has its entries in memory.
template <typename Entry, typename Dense>
MatrixView<Entry> view(Dense& m) {
  const Eigen::Index inner = m.innerStride(), outer = m.outerStride();
  return {m.data(), m.rows(), m.cols(), Dense::IsRowMajor ? outer : inner, Dense::IsRowMajor ? inner : outer};
}

// What Eigen asks of a product: the factors without the transposition and scale that they are written with.
template <typename Left, typename Right, auto& Set, auto& Add>
struct ProductByCall {
  template <auto& Function, typename To>
  static void call(To& to, const Left& left, const Right& right, double factor) {
    using LeftTraits = Eigen::internal::blas_traits<Left>;
    using RightTraits = Eigen::internal::blas_traits<Right>;
    const typename LeftTraits::DirectLinearAccessType& a = LeftTraits::extract(left);
    const typename RightTraits::DirectLinearAccessType& b = RightTraits::extract(right);
    Function(view<double>(to), view<const double>(a), view<const double>(b),
             Eigen::internal::combine_scalar_factors(factor, left, right));
  }
  template <typename To>
  static void evalTo(To& to, const Left& left, const Right& right) {
    call<Set>(to, left, right, 1);
  }
  template <typename To>
  static void addTo(To& to, const Left& left, const Right& right) {
    call<Add>(to, left, right, 1);
  }
  template <typename To>
  static void subTo(To& to, const Left& left, const Right& right) {
    call<Add>(to, left, right, -1);
  }
  template <typename To>
  static void scaleAndAddTo(To& to, const Left& left, const Right& right, double factor) {
    call<add_large_product>(to, left, right, factor);
  }
};

template <typename Left, typename Right>
concept OfDoubles =
    std::is_same_v<typename Left::Scalar, double> && std::is_same_v<typename Right::Scalar, double>;

}  // namespace whine

namespace Eigen::internal {

template <typename Left, typename Right>
requires whine::OfDoubles<Left, Right>
struct generic_product_impl<Left, Right, DenseShape, DenseShape, GemmProduct>
    : whine::ProductByCall<Left, Right, whine::set_product, whine::add_product> {
};

template <typename Left, typename Right>
requires whine::OfDoubles<Left, Right>
struct generic_product_impl<Left, Right, DenseShape, DenseShape, GemvProduct>
    : whine::ProductByCall<Left, Right, whine::set_large_product, whine::add_large_product> {
};

}  // namespace Eigen::internal
