// Linear complementarity (Eq. 18): find p >= 0 with d = A p + e >= 0 and p . d = 0, A symmetric positive definite.
//
// Block principal pivoting (Judice and Pires; Portugal, Judice and Vicente, Math. Comp. 63 (1994) 625) from a
// guessed active set; when its block steps stop paying, least-index steps; if even they take too long, Lawson
// and Hanson's non-negative least squares on the same matrix, whose objective decreases with every step. Without a
// guess the set first grows with its Cholesky factor, each time by the strip that penetrates most; on contact
// patches nothing is left to pivot then. An active set that was right before is kept with the inverse of its
// block, so that a problem whose contact pattern repeats costs one matrix-vector product and a check; strips
// that come or go border the inverse.
//
// Memory is taken when the number of strips grows, never afterwards.
#pragma once
#include <Eigen/Core>
#include <memory_resource>
#include <vector>

namespace whine {

struct StripCompliance;

// A square matrix that changes its size without changing its memory. Columns are `stride` apart, a multiple
// of 4; what lies between their ends and the next multiple of 4 is finite.
class GrowingMatrix {
 public:
  using Block = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;
  using ConstBlock = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  explicit GrowingMatrix(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : store_(memory) {}

  // Room for (n, n). Loses the contents if it has to grow.
  void reserve(int n);
  void resize(int n) { size_ = n; }  // n at most what was reserved
  int rows() const { return size_; }
  int cols() const { return size_; }
  int stride() const { return stride_; }
  double* column(int j) { return store_.data() + static_cast<Eigen::Index>(j) * stride_; }
  const double* column(int j) const { return store_.data() + static_cast<Eigen::Index>(j) * stride_; }
  double operator()(int i, int j) const { return column(j)[i]; }
  ConstBlock block() const { return {store_.data(), size_, size_, Eigen::OuterStride<>(stride_)}; }
  operator ConstBlock() const { return block(); }
  template <class Vector>
  auto operator*(const Eigen::MatrixBase<Vector>& v) const {
    return block() * v.derived();
  }

 private:
  std::pmr::vector<double> store_;
  int size_ = 0, stride_ = 0;
};

// The active set of a solve and the inverse of A on it. One per problem family (for instance: one per mesh
// position); `forget` when A changes.
struct ActiveSet {
  explicit ActiveSet(std::pmr::memory_resource* memory = std::pmr::get_default_resource())
      : inverse(memory) {}

  std::vector<int> strips;  // indices with force, ascending
  GrowingMatrix inverse;    // (active, active) of A on them; valid if `known`
  bool known = false;
  bool shifted = false;  // the inverse is that of A + shift I
  int updates = 0;       // strips that came or went since the inverse was computed from A
  double least_diagonal = 0, largest_diagonal = 0;  // bounds of A's diagonal on them, as `inverse`
  void forget() { known = false; }
  // Nothing of a problem that failed: its set, of gaps beyond all sense or half made, would fail the next one as well.
  void restart() {
    strips.clear();
    known = shifted = false;
  }
};

// What a solve reached. A solution is returned only if all bounds hold (tolerances in solve).
struct Certificate {
  double least_gap = 0;    // m, over strips without force (0 if there is none); >= -gap tolerance
  double least_force = 0;  // N, over strips with force (0 if there is none); >= -force tolerance
  double residual = 0;     // max |min(d_i, p_i A_ii)| / max |e|, d as computed on every strip
  int factorisations = 0;  // 0: the kept inverse was right, or was bordered
  int iterations = 0;      // sets tried, a kept one included
  int degenerate = 0;      // strips that touch without force, within the tolerances
  bool fallback = false;   // Lawson-Hanson was needed
  double coupling = 0;     // m: by how much the gaps are off by friction, see contact/friction.h
  bool shifted =
      false;  // A is singular to round-off on the active strips: A + shift I was factorised instead
};

// Largest residual of a solution that a stage may go on with: a larger one (forces large relative to the gaps) leaves
// no digits for a pair's share of the load.
inline constexpr double kMostResidual = 1e-10;

// Throws Error(numerical) with the numbers unless the residual is a number within kMostResidual.
void require_residual(const Certificate& certificate);

// What to do with a problem whose A is singular to round-off on the strips that touch. Many force distributions then close the
// gaps, and a shift picks one of them arbitrarily: loads of tooth pairs and stiffnesses would depend on round-off.
enum class Singular { reject, shift };

class ComplementaritySolver {
 public:
  explicit ComplementaritySolver(Singular singular = Singular::reject) : singular_(singular) {}

  // A: (n, n); e: (n); p, d: (n), results. active: start and result. Gap tolerance: 1e-12 of the largest |e|
  // and the round-off of A p; force tolerance: that over A_ii. A block of A that is singular to round-off is
  // shifted by 1e-13 of its largest diagonal (or a little more); the residual is that of A itself. At most 20 n + 100
  // sets are tried, then 30 n + 30 steps of n factorisations at most. Throws Error(numerical) if A is not positive
  // definite beyond that on a set that is tried or, where the set grows from nothing, on that set and any one strip; if a
  // number that the solution depends on is not finite; if no set passes; by require_residual; or if the solution's own
  // block had to be shifted (Singular::reject).
  Certificate solve(const Eigen::Ref<const Eigen::MatrixXd>& a, const Eigen::Ref<const Eigen::VectorXd>& e,
                    ActiveSet& active, Eigen::Ref<Eigen::VectorXd> p, Eigen::Ref<Eigen::VectorXd> d);

  // The same for the strips of all pairs; only the entries of A that are needed are computed. A set that is strictly complementary
  // (every force and gap exceeds its tolerance) needs its own rows and columns, once. nodes: as
  // StripCompliance::add_product, of the solution.
  Certificate solve(const StripCompliance& a, const Eigen::Ref<const Eigen::VectorXd>& e, ActiveSet& active,
                    Eigen::Ref<Eigen::VectorXd> p, Eigen::Ref<Eigen::VectorXd> d, double* nodes);

 private:
  using Matrix = Eigen::Ref<const Eigen::MatrixXd>;
  using Vector = Eigen::Ref<const Eigen::VectorXd>;
  using Result = Eigen::Ref<Eigen::VectorXd>;
  void reserve(int n);
  void factorise(const Matrix& a, ActiveSet& active);
  void grow(const Matrix& a, const Vector& e, ActiveSet& active);
  void invert(GrowingMatrix& inverse);
  bool border(const Matrix& a, ActiveSet& active);
  void list(std::vector<int>& strips) const;
  void apply(const ActiveSet& active, const double* right, double* result);
  bool attempt(const Matrix& a, const Vector& e, const ActiveSet& active, Result p, Result d,
               Certificate& certificate);
  Certificate certified(const Certificate& certificate, const Matrix& a, ActiveSet& active) const;
  bool repeat(const StripCompliance& a, const Vector& e, const ActiveSet& active, Result p, Result d,
              double* nodes, Certificate& certificate);
  void verify(const Matrix& a, const Vector& e, const std::vector<int>& strips, Result p, Result d,
              Certificate& certificate);
  void lawson_hanson(const Matrix& a, const Vector& e, ActiveSet& active);

  Singular singular_;
  std::vector<char> in_;                     // (n) 1: in the active set
  std::vector<int> wrong_;                   // indices that break a sign
  std::vector<int> next_, fresh_;            // the set that `border` goes to; what comes to it
  GrowingMatrix factor_;                     // L of A = L L^T on the set
  GrowingMatrix grown_;                      // its rows for all strips, in `grow`
  Eigen::VectorXd reciprocal_;               // 1 / L_jj
  Eigen::VectorXd right_, p_active_, work_;  // (n, padded)
  Eigen::VectorXd force_, target_;           // (n) of Lawson-Hanson
  Eigen::VectorXd assembled_;                // (n, n) of a StripCompliance, as far as it is needed
  double gap_tolerance_ = 0, scale_ = 0;     // m
  double defect_ = 0;                        // m: largest |d| on the active strips
  bool factored_ = false;                    // factor_ belongs to the set, otherwise its inverse does
};

}  // namespace whine
