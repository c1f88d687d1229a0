// Matrices whose rows are contiguous, as datasets of HDF5 are.
#pragma once
#include <Eigen/Core>

namespace whine {

using MatrixRM = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using MatrixRMi = Eigen::Matrix<int, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace whine
