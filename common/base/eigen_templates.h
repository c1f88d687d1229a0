// Templates of Eigen for matrices of doubles that many sources use, compiled once, in eigen_templates.cpp: products and
// decompositions took a sixth of the time of compiling the sources that use them. By way of precompiled.h.
#pragma once
#include <Eigen/Dense>
#include "base/dense_products.h"

#ifndef WHINE_EIGEN_TEMPLATE
#define WHINE_EIGEN_TEMPLATE extern template
#endif

namespace Eigen {

WHINE_EIGEN_TEMPLATE class PartialPivLU<MatrixXd>;
WHINE_EIGEN_TEMPLATE class LLT<MatrixXd>;
WHINE_EIGEN_TEMPLATE class LLT<MatrixXcd>;
WHINE_EIGEN_TEMPLATE class LDLT<MatrixXd>;
WHINE_EIGEN_TEMPLATE class ColPivHouseholderQR<MatrixXd>;
WHINE_EIGEN_TEMPLATE class SelfAdjointEigenSolver<MatrixXd>;
WHINE_EIGEN_TEMPLATE SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(
    const EigenBase<MatrixXd>&, int);

namespace internal {

using Kernel = gebp_traits<double, double>;
template <int Order>
using Entries = const_blas_data_mapper<double, Index, Order>;

WHINE_EIGEN_TEMPLATE struct gebp_kernel<double, double, Index,
                                        blas_data_mapper<double, Index, ColMajor, Unaligned, 1>, Kernel::mr,
                                        Kernel::nr, false, false>;
WHINE_EIGEN_TEMPLATE struct gemm_pack_lhs<double, Index, Entries<ColMajor>, Kernel::mr, Kernel::LhsProgress,
                                          Kernel::LhsPacket4Packing, ColMajor>;
WHINE_EIGEN_TEMPLATE struct gemm_pack_lhs<double, Index, Entries<RowMajor>, Kernel::mr, Kernel::LhsProgress,
                                          Kernel::LhsPacket4Packing, RowMajor>;
WHINE_EIGEN_TEMPLATE struct gemm_pack_rhs<double, Index, Entries<ColMajor>, Kernel::nr, ColMajor>;
WHINE_EIGEN_TEMPLATE struct gemm_pack_rhs<double, Index, Entries<RowMajor>, Kernel::nr, RowMajor>;
WHINE_EIGEN_TEMPLATE struct general_matrix_vector_product<Index, double, Entries<ColMajor>, ColMajor, false,
                                                          double, Entries<ColMajor>, false>;
WHINE_EIGEN_TEMPLATE struct general_matrix_vector_product<Index, double, Entries<ColMajor>, ColMajor, false,
                                                          double, Entries<RowMajor>, false>;
WHINE_EIGEN_TEMPLATE struct general_matrix_vector_product<Index, double, Entries<RowMajor>, RowMajor, false,
                                                          double, Entries<ColMajor>, false>;
WHINE_EIGEN_TEMPLATE struct general_matrix_vector_product<Index, double, Entries<RowMajor>, RowMajor, false,
                                                          double, Entries<RowMajor>, false>;
WHINE_EIGEN_TEMPLATE void evaluateProductBlockingSizesHeuristic<double, double, 1, Index>(Index&, Index&,
                                                                                          Index&, Index);
WHINE_EIGEN_TEMPLATE void evaluateProductBlockingSizesHeuristic<double, double, 4, Index>(Index&, Index&,
                                                                                          Index&, Index);

}  // namespace internal
}  // namespace Eigen
