#include "solid/factor.h"

#include <cholmod.h>

#include "base/error.h"

namespace whine {

struct HermitianFactor::Work {
  cholmod_common common;
  cholmod_factor* factor = nullptr;
  Eigen::Index size = 0;

  Work() {
    cholmod_start(&common);
    common.print = 0;
    common.supernodal = CHOLMOD_SUPERNODAL;  // L L^H: a pivot that is not positive ends it
    common.nmethods = 1;                     // one ordering: nothing that could differ between runs
    common.method[0].ordering = CHOLMOD_AMD;
    common.postorder = 1;
  }
  ~Work() {
    cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
};

namespace {

// A view of an Eigen matrix; CHOLMOD reads only its upper triangle.
cholmod_sparse view(const SparseComplex& a) {
  cholmod_sparse m{};
  m.nrow = static_cast<size_t>(a.rows());
  m.ncol = static_cast<size_t>(a.cols());
  m.nzmax = static_cast<size_t>(a.nonZeros());
  m.p = const_cast<int*>(a.outerIndexPtr());
  m.i = const_cast<int*>(a.innerIndexPtr());
  m.x = const_cast<std::complex<double>*>(a.valuePtr());
  m.stype = 1;
  m.itype = CHOLMOD_INT;
  m.xtype = CHOLMOD_COMPLEX;
  m.dtype = CHOLMOD_DOUBLE;
  m.sorted = 1;
  m.packed = 1;
  return m;
}

}  // namespace

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

}  // namespace whine
