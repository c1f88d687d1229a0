// Products of matrices against their sums of products, for every shape, order of storage and stride.
#include <doctest/doctest.h>

#include <Eigen/Dense>
#include <cstdint>
#include <vector>

#include "base/dense_products.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Numbers in [-1, 1] that depend on `seed` alone.
MatrixXd numbers(Index rows, Index columns, std::uint32_t seed) {
  MatrixXd m(rows, columns);
  for (Index i = 0; i < m.size(); ++i) {
    seed = seed * 1664525u + 1013904223u;
    m.data()[i] = seed / 2147483648.0 - 1;
  }
  return m;
}

MatrixXd by_definition(const MatrixXd& a, const MatrixXd& b) {
  MatrixXd c = MatrixXd::Zero(a.rows(), b.cols());
  for (Index i = 0; i < a.rows(); ++i)
    for (Index j = 0; j < b.cols(); ++j)
      for (Index k = 0; k < a.cols(); ++k) c(i, j) += a(i, k) * b(k, j);
  return c;
}

// A matrix in memory of its own, with `gap` numbers between the entries of a column (or row) and more between these.
struct Stored {
  std::vector<double> memory;
  Index rows, columns, row_stride, column_stride;
  Stored(const MatrixXd& m, bool by_rows, Index gap)
      : rows(m.rows()),
        columns(m.cols()),
        row_stride(by_rows ? (columns + 3) * (gap + 1) : gap + 1),
        column_stride(by_rows ? gap + 1 : (rows + 3) * (gap + 1)) {
    memory.assign(static_cast<size_t>(1 + rows * row_stride + columns * column_stride), 1e30);
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < columns; ++j) at(i, j) = m(i, j);
  }
  double& at(Index i, Index j) { return memory[static_cast<size_t>(i * row_stride + j * column_stride)]; }
  MatrixRead read() const { return {memory.data(), rows, columns, row_stride, column_stride}; }
  MatrixWritten written() { return {memory.data(), rows, columns, row_stride, column_stride}; }
  MatrixXd matrix() {
    MatrixXd m(rows, columns);
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < columns; ++j) m(i, j) = at(i, j);
    return m;
  }
  // What lies between the entries.
  double between() {
    for (Index i = 0; i < rows; ++i)
      for (Index j = 0; j < columns; ++j) at(i, j) = 1e30;
    double most = 0;
    for (double x : memory) most = std::max(most, std::abs(x - 1e30));
    return most;
  }
};

}  // namespace

TEST_CASE("products of matrices: the sum of products, whatever shape, order and stride") {
  int tried = 0;
  for (const Index rows : {1, 2, 7, 33})
    for (const Index columns : {1, 3, 8, 21})
      for (const Index depth : {0, 1, 5, 40})
        for (int stored = 0; stored < 64; ++stored) {
          const MatrixXd a = numbers(rows, depth, 1), b = numbers(depth, columns, 2),
                         c = numbers(rows, columns, 3);
          const Stored left(a, stored & 1, stored & 8 ? 1 : 0), right(b, stored & 2, stored & 16 ? 2 : 0);
          const MatrixXd ab = by_definition(a, b);
          const auto after = [&](auto product, double factor) {
            Stored to(c, stored & 4, stored & 32 ? 1 : 0);
            product(to.written(), left.read(), right.read(), factor);
            const MatrixXd found = to.matrix();
            CHECK(to.between() == 0);
            return found;
          };
          const double allowed = 1e-15 * (1 + static_cast<double>(depth));
          CHECK((after(set_product, -2) + 2 * ab).cwiseAbs().maxCoeff() <= allowed);
          CHECK((after(set_large_product, 1) - ab).cwiseAbs().maxCoeff() <= allowed);
          CHECK((after(add_product, 0.5) - c - 0.5 * ab).cwiseAbs().maxCoeff() <= allowed);
          CHECK((after(add_large_product, -1) - c + ab).cwiseAbs().maxCoeff() <= allowed);
          ++tried;
        }
  CHECK(tried == 4 * 4 * 4 * 64);
}

TEST_CASE("products of matrices: expressions of Eigen reach them with their transposition, scale and place") {
  for (const Index n : {3, 30}) {
    const MatrixXd a = numbers(n, n + 1, 4), b = numbers(n + 1, n, 5), c = numbers(n, n, 6);
    const VectorXd x = numbers(n, 1, 7);
    const double allowed = 1e-14 * static_cast<double>(n);
    const auto alike = [&](const MatrixXd& found, const MatrixXd& wanted) {
      return found.rows() == wanted.rows() && found.cols() == wanted.cols() &&
             (found - wanted).cwiseAbs().maxCoeff() <= allowed;
    };
    CHECK(alike(a * b, by_definition(a, b)));
    CHECK(alike(-2 * b.transpose() * (3 * a.transpose()), -6 * by_definition(a, b).transpose()));
    CHECK(alike(a * b * c, by_definition(by_definition(a, b), c)));
    CHECK(alike((a - b.transpose()) * b, by_definition(a - b.transpose(), b)));
    CHECK(alike(x.transpose() * a, by_definition(x.transpose(), a)));
    CHECK(alike(c.row(1) * c, by_definition(c.row(1), c)));
    CHECK(alike(c * c.row(1).transpose(), by_definition(c, c.row(1).transpose())));
    CHECK(alike(c * c.diagonal(), by_definition(c, c.diagonal())));
    CHECK(alike(a.leftCols(0) * b.topRows(0), MatrixXd::Zero(n, n)));
    MatrixXd d = c;
    d = d * d;  // through a copy
    CHECK(alike(d, by_definition(c, c)));
    d = c;
    d.row(1) -= x.transpose() * c;
    d.bottomRightCorner(2, 2).noalias() += a.topRows(2) * b.leftCols(2);
    MatrixXd wanted = c;
    wanted.row(1) -= by_definition(x.transpose(), c);
    wanted.bottomRightCorner(2, 2) += by_definition(a.topRows(2), b.leftCols(2));
    CHECK(alike(d, wanted));
  }
}
