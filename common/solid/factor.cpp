#include "solid/factor.h"

#include <cholmod.h>

#include <algorithm>
#include <type_traits>

#include "base/error.h"

namespace whine {

struct Cholmod {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  Eigen::Index size = 0;

  Cholmod() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;  // L L^H: a pivot that is not positive ends it
    common.nmethods = 1;                     // one ordering: nothing that could differ between runs
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
  }
  ~Cholmod() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;
};

namespace {

// A view of an Eigen matrix; CHOLMOD reads only its upper triangle.
template <class Scalar>
cholmod_sparse view(const Eigen::SparseMatrix<Scalar>& a) {
  cholmod_sparse m{};
  m.nrow = static_cast<size_t>(a.rows());
  m.ncol = static_cast<size_t>(a.cols());
  m.nzmax = static_cast<size_t>(a.nonZeros());
  m.p = const_cast<int*>(a.outerIndexPtr());
  m.i = const_cast<int*>(a.innerIndexPtr());
  m.x = const_cast<Scalar*>(a.valuePtr());
  m.stype = 1;
  m.itype = CHOLMOD_INT;
  m.xtype = std::is_same_v<Scalar, double> ? CHOLMOD_REAL : CHOLMOD_COMPLEX;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = 1;
  m.packed = 1;
  return m;
}

// L22 of the factor's last `kept` columns, out of its supernodes. (kept, kept), lower triangle
Eigen::MatrixXd last_block(const cholmod_factor& factor, Eigen::Index kept) {
  const Eigen::Index first = static_cast<Eigen::Index>(factor.n) - kept;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(kept, kept);
  const int *super = static_cast<int*>(factor.super), *pi = static_cast<int*>(factor.pi),
            *px = static_cast<int*>(factor.px), *row = static_cast<int*>(factor.s);
  const double* x = static_cast<double*>(factor.x);
  for (size_t k = 0; k < factor.nsuper; ++k)
    for (Eigen::Index column = std::max<Eigen::Index>(super[k], first); column < super[k + 1]; ++column)
      for (int r = pi[k]; r < pi[k + 1]; ++r)
        if (row[r] >= column)
          block(row[r] - first, column - first) =
              x[px[k] + (column - super[k]) * (pi[k + 1] - pi[k]) + r - pi[k]];
  return block;
}

}  // namespace

struct HermitianFactor::Work : Cholmod {};

HermitianFactor::HermitianFactor(const SparseComplex& a) : work_(std::make_unique<Work>()) {
  if (!a.isCompressed() || a.rows() != a.cols())
    fail(Failure::numerical, "factorisation: the matrix is ", a.rows(), " x ", a.cols(),
         a.isCompressed() ? "" : " and not compressed", ", it must be square and compressed");
  cholmod_sparse m = view(a);
  work_->size = a.rows();
  work_->factor = cholmod_analyze(&m, &work_->common);
  if (!work_->factor)
    fail(Failure::numerical, "CHOLMOD could not analyse a matrix of size ", a.rows(), " (status ",
         work_->common.status, ")");
}

HermitianFactor::~HermitianFactor() = default;

void HermitianFactor::factorise(const SparseComplex& a, const std::string& what) {
  if (a.rows() != work_->size)
    fail(Failure::numerical, "factorisation of ", what, ": size ", a.rows(), " is not the analysed size ",
         work_->size);
  cholmod_sparse m = view(a);
  cholmod_factorize(&m, work_->factor, &work_->common);
  if (work_->common.status != CHOLMOD_OK)
    fail(Failure::numerical, "factorisation of ", what, " stopped at column ", work_->factor->minor, " of ",
         a.rows(), " (CHOLMOD status ", work_->common.status,
         "): the matrix is not positive definite; check the mesh, its bore nodes and the material");
}

Eigen::MatrixXcd HermitianFactor::solve(const Eigen::MatrixXcd& right) const {
  cholmod_dense b{};
  b.nrow = static_cast<size_t>(right.rows());
  b.ncol = static_cast<size_t>(right.cols());
  b.d = b.nrow;
  b.nzmax = b.nrow * b.ncol;
  b.x = const_cast<std::complex<double>*>(right.data());
  b.xtype = CHOLMOD_COMPLEX;
  b.dtype = CHOLMOD_DOUBLE;
  if (right.rows() != work_->size)
    fail(Failure::numerical, "solve: ", right.rows(), " rows on the right for a matrix of size ",
         work_->size);
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, work_->factor, &b, &work_->common);
  if (!x) fail(Failure::numerical, "CHOLMOD could not solve (status ", work_->common.status, ")");
  Eigen::MatrixXcd result =
      Eigen::Map<Eigen::MatrixXcd>(static_cast<std::complex<double>*>(x->x), right.rows(), right.cols());
  cholmod_free_dense(&x, &work_->common);
  if (!result.allFinite()) fail(Failure::numerical, "the solution of a factorised system is not finite");
  return result;
}

std::vector<int> elimination_order(const Eigen::SparseMatrix<double>& graph, const std::vector<char>& last) {
  Cholmod work;
  cholmod_sparse m = view(graph);
  std::vector<int> member(last.begin(), last.end()), order(last.size());
  if (!cholmod_camd(&m, nullptr, 0, member.data(), order.data(), &work.common))
    fail(Failure::numerical, "CHOLMOD could not order a graph of ", graph.rows(), " nodes (status ",
         work.common.status, ")");
  work.common.method[0].ordering = CHOLMOD_GIVEN;  // and its elimination tree in postorder
  work.factor = cholmod_analyze_p(&m, order.data(), nullptr, 0, &work.common);
  if (!work.factor)
    fail(Failure::numerical, "CHOLMOD could not analyse a graph of ", graph.rows(), " nodes (status ",
         work.common.status, ")");
  const int* perm = static_cast<int*>(work.factor->Perm);
  order.assign(perm, perm + order.size());
  if (!std::is_sorted(order.begin(), order.end(), [&last](int a, int b) {
        return last[static_cast<size_t>(a)] < last[static_cast<size_t>(b)];
      }))
    fail(Failure::numerical, "a graph of ", graph.rows(),
         " nodes falls apart where its last ones are taken off; check the mesh");
  return order;
}

CondensedSystem condensed_system(const Eigen::SparseMatrix<double>& stiffness, Eigen::Index kept,
                                 const Eigen::MatrixXd& load, const std::string& what) {
  Cholmod work;
  work.common.method[0].ordering = CHOLMOD_NATURAL;
  work.common.postorder = 0;
  cholmod_sparse m = view(stiffness);
  work.factor = cholmod_analyze(&m, &work.common);
  if (work.factor) cholmod_factorize(&m, work.factor, &work.common);
  if (!work.factor || work.common.status != CHOLMOD_OK)
    fail(
        Failure::numerical, "condensation of ", what, " of size ", stiffness.rows(), " (CHOLMOD status ",
        work.common.status,
        "): the matrix is not positive definite, or there is too little memory; check the mesh, its bore nodes and the material");
  cholmod_dense b{};
  b.nrow = b.d = static_cast<size_t>(load.rows());
  b.ncol = static_cast<size_t>(load.cols());
  b.nzmax = b.nrow * b.ncol;
  b.x = const_cast<double*>(load.data());
  b.xtype = CHOLMOD_REAL;
  cholmod_dense* x = cholmod_solve(CHOLMOD_L, work.factor, &b, &work.common);
  if (!x) fail(Failure::numerical, "CHOLMOD could not solve (status ", work.common.status, ")");
  const Eigen::Map<Eigen::MatrixXd> forward(static_cast<double*>(x->x), load.rows(), load.cols());
  const Eigen::Index inner = load.rows() - kept;
  const Eigen::MatrixXd block = last_block(*work.factor, kept), top = forward.topRows(inner);
  CondensedSystem result{block * block.transpose(), block * forward.bottomRows(kept), top.transpose() * top};
  cholmod_free_dense(&x, &work.common);
  if (!result.stiffness.allFinite() || !result.load.allFinite() || !result.flexibility.allFinite())
    fail(Failure::numerical, "the condensation of ", what, " is not finite");
  return result;
}

}  // namespace whine
