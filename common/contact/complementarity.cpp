#include "contact/complementarity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "contact/lanes.h"
#include "contact/strip_compliance.h"

namespace whine {

namespace {

// m. scale: largest |e|; diagonal: largest A_ii of the set; sum: of its |p|.
double tolerance_of_gaps(double scale, double diagonal, double sum) {
  return 1e-12 * scale + 16 * std::numeric_limits<double>::epsilon() * diagonal * sum;
}

// Bounds once more, with these strips.
void note_diagonal(const Eigen::Ref<const Eigen::MatrixXd>& a, const std::vector<int>& strips,
                   ActiveSet& active) {
  for (int i : strips) {
    active.least_diagonal = std::min(active.least_diagonal, a(i, i));
    active.largest_diagonal = std::max(active.largest_diagonal, a(i, i));
  }
}

void note_diagonal(const Eigen::Ref<const Eigen::MatrixXd>& a, ActiveSet& active) {
  active.least_diagonal = std::numeric_limits<double>::infinity();
  active.largest_diagonal = 0;
  note_diagonal(a, active.strips, active);
}

}  // namespace

// Fills p and d for the set, lists in wrong_ what breaks a sign and measures how well the set itself is met.
void ComplementaritySolver::verify(const Matrix& a, const Vector& e, const std::vector<int>& strips, Result p,
                                   Result d, Certificate& certificate) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const int n = static_cast<int>(e.size()), k = static_cast<int>(strips.size());
  p.setZero();
  d = e;
  const int whole = n / kLanes * kLanes;
  for (int j = 0; j < k; j += 4) {
    const double* column[4];
    double force[4];
    for (int m = 0; m < 4; ++m) {
      const bool there = j + m < k;
      column[m] = a.data() + strips[there ? j + m : j] * a.outerStride();
      force[m] = there ? p_active_[j + m] : 0;
    }
    double* gap = d.data();
    for (int i = 0; i < whole; i += kLanes)
      lanes(gap + i) += force[0] * lanes(column[0] + i) + force[1] * lanes(column[1] + i) +
                        force[2] * lanes(column[2] + i) + force[3] * lanes(column[3] + i);
    for (int i = whole; i < n; ++i)
      gap[i] += force[0] * column[0][i] + force[1] * column[1][i] + force[2] * column[2][i] +
                force[3] * column[3][i];
  }
  if (!std::isfinite(d.sum()))
    fail(Failure::numerical, "the gaps of ", n, " strips are not finite with ", k,
         " of them in contact: the compliance or the unloaded gap (largest ", scale_, " m) holds no number");

  double defect = 0, sum = 0, diagonal = 0, least_force = kInfinity, least_product = kInfinity;
  for (int i = 0; i < k; ++i) {
    const int strip = strips[i];
    const double force = p_active_[i], own = a(strip, strip);
    p[strip] = force;
    defect = std::max(defect, std::abs(d[strip]));
    sum += std::abs(force);
    diagonal = std::max(diagonal, own);
    least_force = std::min(least_force, force);
    least_product = std::min(least_product, force * own);
    right_[i] = d[strip];
    d[strip] = kInfinity;  // so that the least gap is that of the others
  }
  defect_ = defect;
  const double least_gap = n > k ? d.minCoeff() : 0;
  for (int i = 0; i < k; ++i) d[strips[i]] = 0;  // exact by the solve, round-off otherwise
  gap_tolerance_ = tolerance_of_gaps(scale_, diagonal, sum);
  certificate.least_gap = least_gap;
  certificate.least_force = k > 0 ? least_force : 0;
  certificate.degenerate = 0;
  wrong_.clear();
  double residual = std::max(defect_, -least_gap);
  if (least_product <= gap_tolerance_ || (n > k && least_gap <= gap_tolerance_)) {
    for (int i = 0, next = 0; i < n; ++i) {
      const bool active = next < k && strips[next] == i;
      next += active;
      const double value = active ? p[i] * a(i, i) : d[i];
      if (value < -gap_tolerance_)
        wrong_.push_back(i);
      else if (value <= gap_tolerance_)
        ++certificate.degenerate;
    }
    if (k > 0) residual = std::max(residual, -least_product);
  }
  certificate.residual = scale_ > 0 ? residual / scale_ : 0;
}

// True if the set solves the problem.
bool ComplementaritySolver::attempt(const Matrix& a, const Vector& e, const ActiveSet& active, Result p,
                                    Result d, Certificate& certificate) {
  const int k = static_cast<int>(active.strips.size());
  ++certificate.iterations;
  certificate.shifted = active.shifted;
  for (int i = 0; i < k; ++i) right_[i] = -e[active.strips[i]];
  apply(active, right_.data(), p_active_.data());
  verify(a, e, active.strips, p, d, certificate);
  // Iterative refinement: an inverse, or a shifted factor, leaves a defect that its next use removes.
  for (int again = 0; again < 3 && defect_ > gap_tolerance_; ++again) {
    apply(active, right_.data(), target_.data());
    p_active_.head(k) -= target_.head(k);
    verify(a, e, active.strips, p, d, certificate);
  }
  return wrong_.empty() && defect_ <= gap_tolerance_;
}

void require_residual(const Certificate& certificate) {
  if (!(certificate.residual <= kMostResidual))
    fail(Failure::numerical, "the contact is met to ", certificate.residual,
         " of the largest unloaded gap only, ", kMostResidual, " is needed: least gap ",
         certificate.least_gap, " m, least force ", certificate.least_force,
         " N; the compliance is nearly singular where the flanks touch");
}

// What solve hands out: nothing that the problem does not determine.
Certificate ComplementaritySolver::certified(const Certificate& certificate, const Matrix& a,
                                             ActiveSet& active) const {
  note_diagonal(a, active);
  require_residual(certificate);
  if (certificate.shifted && singular_ == Singular::reject)
    fail(Failure::numerical, "the compliance of the ", active.strips.size(),
         " strips that touch is singular to round-off (largest diagonal ", active.largest_diagonal,
         " m/N) and does not say how they share the load: strips coincide, or the body's table is wrong");
  return certificate;
}

Certificate ComplementaritySolver::solve(const StripCompliance& a, const Vector& e, ActiveSet& active,
                                         Result p, Result d, double* nodes) try {
  const int n = a.size();
  if (a.strips % kLanes != 0)
    fail(Failure::numerical, "a contact problem has pairs of ", a.strips, " strips, no multiple of ", kLanes);
  if (e.size() != n || p.size() != n || d.size() != n)
    fail(Failure::numerical, "a contact problem of ", e.size(), " gaps has a compliance of ", n,
         " strips and room for ", p.size(), " forces and ", d.size(), " gaps");
  reserve(n);
  if (assembled_.size() < static_cast<Eigen::Index>(n) * n)
    assembled_.setZero(static_cast<Eigen::Index>(n) * n);
  const Eigen::Map<const Eigen::MatrixXd> whole(assembled_.data(), n, n);
  constexpr int kTries = 4;  // sets that follow from each other's wrong signs
  Certificate certificate;
  const auto take = [&] {  // next_, with its inverse; false if it has none without a shift
    if (active.known) {
      fresh_.clear();
      std::set_difference(next_.begin(), next_.end(), active.strips.begin(), active.strips.end(),
                          std::back_inserter(fresh_));
      a.assemble_columns(fresh_, next_, assembled_.data());
      if (border(whole, active)) {
        note_diagonal(whole, fresh_, active);
        return true;
      }
    }
    a.assemble_columns(next_, next_, assembled_.data());
    active.strips = next_;
    factorise(whole, active);
    ++certificate.factorisations;
    if (active.shifted) return false;
    invert(active.inverse);
    active.known = true;
    note_diagonal(whole, active);
    return true;
  };
  active.strips.reserve(n);
  active.inverse.reserve(n);
  if (static_cast<int>(active.strips.size()) != active.inverse.rows()) active.known = false;
  bool tried = active.known && !active.shifted;
  if (!active.known && !active.strips.empty()) {
    for (size_t i = 0; i < active.strips.size(); ++i)
      if (active.strips[i] < (i > 0 ? active.strips[i - 1] + 1 : 0) || active.strips[i] >= n)
        fail(Failure::numerical, "strip ", active.strips[i], " of the first guess is none of the ", n,
             " strips, or not in their order");
    next_ = active.strips;
    tried = take();
  }
  bool renewed = false;
  for (int n_tried = 1; tried; ++n_tried) {
    if (repeat(a, e, active, p, d, nodes, certificate)) return certificate;
    if (n_tried == kTries) break;
    if (wrong_.empty()) {  // a set within the tolerances, or an inverse that has lost digits
      if (renewed || defect_ <= gap_tolerance_) break;
      renewed = true;
      active.known = false;
    }
    std::fill(in_.begin(), in_.end(), 0);
    for (int i : active.strips) in_[i] = 1;
    for (int i : wrong_) in_[i] ^= 1;
    list(next_);
    tried = take();
  }
  a.assemble(assembled_.data());
  const Certificate before = certificate;
  certificate = solve(whole, e, active, p, d);
  certificate.factorisations += before.factorisations;
  certificate.iterations += before.iterations;
  for (int j = 0; j < a.pairs; ++j)
    dot_columns(nodes + j * StripCompliance::kPairNodes, a.interpolation[j], a.strips,
                StripCompliance::kPairNodes, p.data() + j * a.strips, a.strips);
  return certificate;
} catch (...) {
  active.restart();
  throw;
}

// The kept set once more. If it is not right beyond doubt, false, and the strips of wrong sign in wrong_.
bool ComplementaritySolver::repeat(const StripCompliance& a, const Vector& e, const ActiveSet& active,
                                   Result p, Result d, double* nodes, Certificate& certificate) {
  const int n = a.size(), k = static_cast<int>(active.strips.size());
  const int* strips = active.strips.data();
  ++certificate.iterations;
  wrong_.clear();
  double *gap = d.data(), *force = p.data(), *of_set = p_active_.data();
  const auto larger = [](Lanes x, Lanes y) { return x > y ? x : y; };
  const auto smaller = [](Lanes x, Lanes y) { return x < y ? x : y; };
  const auto size = [](Lanes x) { return x < 0 ? -x : x; };
  Lanes largest{};
  for (int i = 0; i < n; i += kLanes) {
    lanes(gap + i) = lanes(e.data() + i);
    largest = larger(size(lanes(gap + i)), largest);
    lanes(force + i) = Lanes{};
  }
  for (int i = 0; i < k; ++i) right_[i] = -e[strips[i]];
  factored_ = false;
  apply(active, right_.data(), of_set);
  for (int i = 0; i < k; ++i) force[strips[i]] = of_set[i];
  a.add_product(force, nodes, gap);

  // A strip of the set whose force is 0 counts as one without, whose gap is then within the tolerance: not beyond doubt.
  const Lanes infinity = Lanes{} + std::numeric_limits<double>::infinity();
  Lanes all{}, forces{}, defects{}, least_gaps = infinity, least_forces = infinity;
  for (int i = 0; i < n; i += kLanes) {
    const Lanes x = lanes(gap + i), f = lanes(force + i);
    const auto loaded = f != 0;
    all += x;
    forces += size(f);
    defects = larger(loaded ? size(x) : Lanes{}, defects);
    least_gaps = smaller(loaded ? infinity : x, least_gaps);
    least_forces = smaller(loaded ? f : infinity, least_forces);
    lanes(gap + i) = loaded ? Lanes{} : x;  // exact by the solve, round-off otherwise
  }
  const auto most = [](Lanes x) { return std::max(std::max(x[0], x[1]), std::max(x[2], x[3])); };
  const auto least = [](Lanes x) { return std::min(std::min(x[0], x[1]), std::min(x[2], x[3])); };
  const double scale = most(largest), defect = most(defects), least_gap = least(least_gaps),
               least_force = least(least_forces),
               tolerance = tolerance_of_gaps(scale, active.largest_diagonal, sum(forces));
  if (!(std::isfinite(sum(all)) && defect <= tolerance && defect <= kMostResidual * scale &&
        least_gap > tolerance && (k == 0 || least_force * active.least_diagonal > tolerance))) {
    for (int i = 0; i < n; ++i)
      if (force[i] * active.least_diagonal < -tolerance || gap[i] < -tolerance) wrong_.push_back(i);
    defect_ = defect;
    gap_tolerance_ = tolerance;
    return false;
  }
  certificate.least_gap = n > k ? least_gap : 0;
  certificate.least_force = k > 0 ? least_force : 0;
  certificate.residual = scale > 0 ? defect / scale : 0;
  return true;
}

Certificate ComplementaritySolver::solve(const Matrix& a, const Vector& e, ActiveSet& active, Result p,
                                         Result d) try {
  const int n = static_cast<int>(e.size());
  if (a.rows() != n || a.cols() != n || p.size() != n || d.size() != n)
    fail(Failure::numerical, "a contact problem of ", n, " gaps has a compliance of ", a.rows(), " x ",
         a.cols(), " and room for ", p.size(), " forces and ", d.size(), " gaps");
  reserve(n);
  active.inverse.reserve(n);
  active.strips.reserve(n);
  scale_ = n > 0 ? e.cwiseAbs().maxCoeff() : 0.0;
  Certificate certificate;
  factored_ = false;
  if (static_cast<int>(active.strips.size()) != active.inverse.rows()) active.known = false;
  if (!active.known && active.strips.empty()) {
    grow(a, e, active);
    ++certificate.factorisations;
  }
  bool rebuild = !active.known;
  if (active.known) {
    if (attempt(a, e, active, p, d, certificate)) return certified(certificate, a, active);
    rebuild = defect_ > gap_tolerance_;
  }

  std::fill(in_.begin(), in_.end(), 0);
  for (int i : active.strips) {
    if (i < 0 || i >= n)
      fail(Failure::numerical, "strip ", i, " of the first guess is none of the ", n, " strips");
    in_[i] = 1;
  }
  constexpr int kPatience = 10;  // block steps that may fail to improve before least-index steps begin
  int fewest = n + 1, patience = kPatience;
  const int limit = 20 * n + 100;
  for (int iteration = 0; iteration < limit; ++iteration) {
    if (rebuild || iteration > 0) {
      bool solved = false;
      list(next_);
      factored_ = rebuild || !active.known || !border(a, active);
      if (!factored_) solved = attempt(a, e, active, p, d, certificate);
      if (factored_ || defect_ > gap_tolerance_) {
        active.strips = next_;
        factorise(a, active);
        ++certificate.factorisations;
        solved = attempt(a, e, active, p, d, certificate);
      }
      rebuild = false;
      if (solved) {
        if (factored_) invert(active.inverse), active.known = true;
        return certified(certificate, a, active);
      }
    }
    const int count = static_cast<int>(wrong_.size());
    if (count == 0) break;  // the signs are right, the set is not met: round-off is too large
    if (count < fewest) {
      fewest = count;
      patience = kPatience;
    } else if (patience > 0) {
      --patience;
    } else {
      in_[wrong_.back()] ^=
          1;  // Murty's rule: one index, always the same end; finite for positive definite A
      continue;
    }
    for (int i : wrong_) in_[i] ^= 1;
  }
  lawson_hanson(a, e, active);
  certificate.fallback = true;
  ++certificate.factorisations;
  if (!attempt(a, e, active, p, d, certificate))
    fail(Failure::numerical, "the contact problem of ", n, " strips has no certified solution: least gap ",
         certificate.least_gap, " m, least force ", certificate.least_force,
         " N, largest gap of a strip with force ", defect_, " m, tolerance of gaps ", gap_tolerance_, " m");
  invert(active.inverse);
  active.known = true;
  return certified(certificate, a, active);
} catch (...) {
  active.restart();
  throw;
}

// min 1/2 p'Ap + e'p, p >= 0: the objective falls with every outer step, so no set returns.
void ComplementaritySolver::lawson_hanson(const Matrix& a, const Vector& e, ActiveSet& active) {
  const int n = static_cast<int>(e.size());
  const double tolerance = 1e-12 * scale_;
  force_.head(n).setZero();
  std::fill(in_.begin(), in_.end(), 0);
  active.strips.clear();
  for (int outer = 0; outer < 30 * n + 30; ++outer) {
    target_.head(n) = e;
    for (int i : active.strips) target_.head(n).noalias() += force_[i] * a.col(i);
    int enter = -1;
    double least = -tolerance;
    for (int i = 0; i < n; ++i)
      if (!in_[i] && target_[i] < least) least = target_[i], enter = i;
    if (enter < 0) break;
    in_[enter] = 1;
    for (;;) {
      list(active.strips);
      factorise(a, active);
      const int k = static_cast<int>(active.strips.size());
      for (int i = 0; i < k; ++i) right_[i] = -e[active.strips[i]];
      apply(active, right_.data(), p_active_.data());
      double step = 1;
      for (int i = 0; i < k; ++i) {
        const double force = force_[active.strips[i]];
        if (p_active_[i] <= 0 && (force > 0 || p_active_[i] < 0))
          step = std::min(step, force / (force - p_active_[i]));
      }
      for (int i = 0; i < k; ++i) {
        double& force = force_[active.strips[i]];
        force = step < 1 ? force + step * (p_active_[i] - force) : p_active_[i];
      }
      if (step >= 1) break;
      bool left = false;
      for (int i : active.strips)
        if (force_[i] <= 0) in_[i] = 0, force_[i] = 0, left = true;
      if (!left) break;  // round-off kept the blocking strip above 0
    }
    list(active.strips);
  }
  list(active.strips);
  factorise(a, active);
}

}  // namespace whine
