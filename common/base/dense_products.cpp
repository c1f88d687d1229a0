#include "base/dense_products.h"

#include <type_traits>

namespace whine {

namespace {

using Eigen::ColMajor;
using Eigen::Dynamic;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowMajor;
using Eigen::VectorXd;

template <int Order>
using Mapped = Eigen::Map<const Eigen::Matrix<double, Dynamic, Dynamic, Order>, 0, Eigen::OuterStride<>>;
using Stride = Eigen::Stride<Dynamic, Dynamic>;
template <typename Entry>
using Strided = Eigen::Map<std::conditional_t<std::is_const_v<Entry>, const MatrixXd, MatrixXd>, 0, Stride>;
using StridedVector = Eigen::Map<VectorXd, 0, Eigen::InnerStride<>>;
using ReadVector = Eigen::Map<const VectorXd, 0, Eigen::InnerStride<>>;

template <typename Entry>
MatrixView<Entry> transposed(const MatrixView<Entry>& m) {
  return {m.data, m.columns, m.rows, m.column_stride, m.row_stride};
}

// Whether the entries of a row, or else of a column, stand beside each other. Of a single row or column both may.
template <typename Entry>
bool by_rows(const MatrixView<Entry>& m) {
  return m.row_stride != 1 && m.column_stride == 1;
}

// Whether its columns or its rows are.
template <typename Entry>
bool is_contiguous(const MatrixView<Entry>& m) {
  return m.row_stride == 1 || m.column_stride == 1;
}

// `m` with contiguous columns or rows, copied to `copy` if it has neither.
MatrixRead contiguous(const MatrixRead& m, MatrixXd& copy) {
  if (is_contiguous(m)) return m;
  copy = Strided<const double>(m.data, m.rows, m.columns, {m.column_stride, m.row_stride});
  return {copy.data(), m.rows, m.columns, 1, m.rows};
}

template <int Order>
Mapped<Order> map(const MatrixRead& m) {
  return {m.data, m.rows, m.columns,
          Eigen::OuterStride<>(Order == RowMajor ? m.row_stride : m.column_stride)};
}

// --- small: coefficient by coefficient

template <int OrderA, int OrderB>
void small(double* to, Index stride, const MatrixRead& a, const MatrixRead& b, double factor, bool add) {
  Eigen::Map<MatrixXd, 0, Eigen::OuterStride<>> result(to, a.rows, b.columns, Eigen::OuterStride<>(stride));
  const auto product = factor * map<OrderA>(a).lazyProduct(map<OrderB>(b));
  if (add)
    result += product;
  else
    result = product;
}

bool is_small(const MatrixWritten& to, Index depth) {
  return depth > 0 && is_contiguous(to) && depth + to.rows + to.columns < EIGEN_GEMM_TO_COEFFBASED_THRESHOLD;
}

void small_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor,
                   bool add) {
  if (to.row_stride != 1) return small_product(transposed(to), transposed(b), transposed(a), factor, add);
  MatrixXd copy_of_a, copy_of_b;
  const MatrixRead left = contiguous(a, copy_of_a), right = contiguous(b, copy_of_b);
  const auto run = by_rows(left) ? (by_rows(right) ? small<RowMajor, RowMajor> : small<RowMajor, ColMajor>)
                                 : (by_rows(right) ? small<ColMajor, RowMajor> : small<ColMajor, ColMajor>);
  run(to.data, to.column_stride, left, right, factor, add);
}

// --- matrix by vector: the kernels of Eigen

template <int Order>
using Entries = Eigen::internal::const_blas_data_mapper<double, Index, Order>;

void add_by_columns(StridedVector to, const MatrixRead& a, const ReadVector& x, double factor) {
  if (to.innerStride() != 1) {
    VectorXd sum = to;
    add_by_columns({sum.data(), sum.size(), Eigen::InnerStride<>(1)}, a, x, factor);
    to = sum;
    return;
  }
  Eigen::internal::general_matrix_vector_product<Index, double, Entries<ColMajor>, ColMajor, false, double,
                                                 Entries<RowMajor>, false>::run(a.rows, a.columns,
                                                                                {a.data, a.column_stride},
                                                                                {x.data(), x.innerStride()},
                                                                                to.data(), 1, factor);
}

void add_by_rows(StridedVector to, const MatrixRead& a, const ReadVector& x, double factor) {
  if (x.innerStride() != 1) {
    const VectorXd copy = x;
    return add_by_rows(to, a, {copy.data(), copy.size(), Eigen::InnerStride<>(1)}, factor);
  }
  Eigen::internal::general_matrix_vector_product<Index, double, Entries<RowMajor>, RowMajor, false, double,
                                                 Entries<ColMajor>, false>::run(a.rows, a.columns,
                                                                                {a.data, a.row_stride},
                                                                                {x.data(), 1}, to.data(),
                                                                                to.innerStride(), factor);
}

// `to` and b have one column.
void add_column(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor) {
  const ReadVector x(b.data, b.rows, Eigen::InnerStride<>(b.row_stride));
  if (a.rows == 1) {
    const ReadVector row(a.data, a.columns, Eigen::InnerStride<>(a.column_stride));
    *to.data += factor * row.dot(x);
    return;
  }
  const StridedVector sum(to.data, to.rows, Eigen::InnerStride<>(to.row_stride));
  by_rows(a) ? add_by_rows(sum, a, x, factor) : add_by_columns(sum, a, x, factor);
}

// --- matrix by matrix

template <int OrderA, int OrderB>
void add_matrix(double* to, Index stride, const MatrixRead& a, const MatrixRead& b, double factor) {
  Eigen::internal::gemm_blocking_space<ColMajor, double, double, Dynamic, Dynamic, Dynamic> blocking(
      a.rows, b.columns, a.columns, 1, true);
  Eigen::internal::general_matrix_matrix_product<Index, double, OrderA, false, double, OrderB, false,
                                                 ColMajor, 1>::run(a.rows, b.columns, a.columns, a.data,
                                                                   OrderA == RowMajor ? a.row_stride
                                                                                      : a.column_stride,
                                                                   b.data,
                                                                   OrderB == RowMajor ? b.row_stride
                                                                                      : b.column_stride,
                                                                   to, 1, stride, factor, blocking, nullptr);
}

void set_zero(const MatrixWritten& to) {
  for (Index j = 0; j < to.columns; ++j)
    for (Index i = 0; i < to.rows; ++i) to.data[i * to.row_stride + j * to.column_stride] = 0;
}

}  // namespace

void add_large_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor) {
  if (to.rows == 0 || to.columns == 0 || a.columns == 0) return;
  if (to.rows != 1 && to.columns != 1 && !is_contiguous(to)) {
    Strided<double> target(to.data, to.rows, to.columns, {to.column_stride, to.row_stride});
    MatrixXd sum = target;
    add_large_product(view<double>(sum), a, b, factor);
    target = sum;
    return;
  }
  if (to.columns != 1 && (to.rows == 1 || to.row_stride != 1))
    return add_large_product(transposed(to), transposed(b), transposed(a), factor);
  MatrixXd copy_of_a, copy_of_b;
  const MatrixRead left = contiguous(a, copy_of_a);
  if (to.columns == 1) return add_column(to, left, b, factor);
  const MatrixRead right = contiguous(b, copy_of_b);
  const auto run = by_rows(left)
                       ? (by_rows(right) ? add_matrix<RowMajor, RowMajor> : add_matrix<RowMajor, ColMajor>)
                       : (by_rows(right) ? add_matrix<ColMajor, RowMajor> : add_matrix<ColMajor, ColMajor>);
  run(to.data, to.column_stride, left, right, factor);
}

void set_large_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor) {
  set_zero(to);
  add_large_product(to, a, b, factor);
}

void set_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor) {
  is_small(to, a.columns) ? small_product(to, a, b, factor, false) : set_large_product(to, a, b, factor);
}

void add_product(const MatrixWritten& to, const MatrixRead& a, const MatrixRead& b, double factor) {
  is_small(to, a.columns) ? small_product(to, a, b, factor, true) : add_large_product(to, a, b, factor);
}

}  // namespace whine
