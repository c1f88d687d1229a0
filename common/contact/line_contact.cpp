#include "contact/line_contact.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/model_range.h"

namespace whine {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kRoundOff = 16 * std::numeric_limits<double>::epsilon();

// Most: kMostPairs or kMostContacts, for which no memory is taken, or any number (Eigen::Dynamic).
template <int Most>
using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Most, 1>;
template <int Most>
using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Most, Most>;
// Which pairs carry force: the numbers of the first `count`, and for each pair whether it is one of them.
template <int Most>
struct Carrying {
  explicit Carrying(Eigen::Index pairs) : in(pairs), number(pairs) { in.setZero(); }
  Eigen::Matrix<int, Eigen::Dynamic, 1, 0, Most, 1> in, number;
  int count = 0;

  void list() {
    count = 0;
    for (int i = 0; i < in.size(); ++i)
      if (in[i]) number[count++] = i;
  }
};

struct Energy {
  double value = 0;
  double magnitude = 0;  // sum of the terms' sizes, for the round-off
};

template <int Most>
Energy energy(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
              const Eigen::Ref<const VectorXd>& e, const Vector<Most>& force) {
  Energy result;
  for (Eigen::Index i = 0; i < force.size(); ++i) {
    if (force[i] == 0) continue;
    const double own = law[i].at(force[i]).energy, shared = 0.5 * force[i] * c.row(i).dot(force),
                 work = e[i] * force[i];
    result.value += own + shared + work;
    result.magnitude += std::abs(own) + std::abs(shared) + std::abs(work);
  }
  return result;
}

// (carrying, carrying) of C + slopes, factorised.
template <int Most>
Eigen::LLT<Matrix<Most>> factorise(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                                   const Eigen::Ref<const VectorXd>& force, const Carrying<Most>& carrying) {
  Matrix<Most> tangent(carrying.count, carrying.count);
  for (int i = 0; i < carrying.count; ++i) {
    const int own = carrying.number[i];
    for (int j = 0; j < carrying.count; ++j) tangent(i, j) = c(own, carrying.number[j]);
    tangent(i, i) += law[own].at(force[own]).slope;
  }
  Eigen::LLT<Matrix<Most>> factor(tangent);
  if (factor.info() != Eigen::Success)
    fail(Failure::numerical, "line contact: the compliance of ", carrying.count,
         " pairs and their Hertz laws is not positive definite (least diagonal term ",
         tangent.diagonal().minCoeff(), " m/N); take the laws relative to a smaller depth");
  return factor;
}

// At s.at: all that a Newton step from there needs but e. False where the tangent is not positive definite.
template <int n>
bool linearise(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law, LineStart& s) {
  Eigen::Matrix<double, n, n> tangent;
  for (int i = 0; i < n; ++i) {
    const HertzLine& own_law = law[s.carrying[i]];
    const HertzLine::Point own = own_law.at(s.at[i]);
    s.d[i] = own.indentation;
    s.size[i] = std::abs(own.indentation);
    s.bend[i] = 0.5 * own_law.coefficient();
    for (int j = 0; j < n; ++j) {
      const double shared = c(s.carrying[i], s.carrying[j]);
      tangent(i, j) = shared;
      s.d[i] += shared * s.at[j];
      s.size[i] += std::abs(shared) * s.at[j];
    }
    tangent(i, i) += own.slope;
  }
  const double determinant = tangent.determinant();
  if (!(tangent(0, 0) > 0 && determinant > 0)) return false;
  if constexpr (n == 3)
    if (!(tangent(0, 0) * tangent(1, 1) > tangent(0, 1) * tangent(1, 0))) return false;
  const Eigen::Matrix<double, n, n> inverse = tangent.inverse();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) s.inverse[i][j] = inverse(i, j);
  return true;
}

// d of the pairs that carry, without a look at the others; f: (pair that carries) N, result.
template <int n>
bool follow(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
            const Eigen::Ref<const VectorXd>& e, LineStart& s, double* f, Certificate& certificate) {
  constexpr int kMostSteps = 6;
  for (int step = 0; step < kMostSteps; ++step) {
    if (step > 0) {
      for (int i = 0; i < n; ++i) s.at[i] = f[i];
      if (!linearise<n>(c, law, s)) return false;
    }
    bool met = true;
    double d[n], left[n], least[n];  // left of d at the next force: what the law's slope can have changed
    for (int i = 0; i < n; ++i) d[i] = s.d[i] + e[s.carrying[i]];
    for (int i = 0; i < n; ++i) {
      double change = 0;
      for (int j = 0; j < n; ++j) change -= s.inverse[i][j] * d[j];
      f[i] = s.at[i] + change;
      if (!(f[i] > 0)) return false;
      left[i] = s.bend[i] * change * change;
      least[i] = std::min(s.at[i], f[i]);
      met = met && left[i] <= kRoundOff * (s.size[i] + std::abs(e[s.carrying[i]])) * least[i];
    }
    if (!met) continue;
    certificate.iterations = certificate.factorisations = step + 1;
    for (int i = 0; i < n; ++i) certificate.residual = std::max(certificate.residual, left[i] / least[i]);
    return true;
  }
  return false;
}

// The solution if it carries where the start does; otherwise false.
bool follow_start(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                  const Eigen::Ref<const VectorXd>& e, LineStart& start, Eigen::Ref<VectorXd> force,
                  Eigen::Ref<VectorXd> d, Certificate& certificate) {
  const int n = static_cast<int>(e.size()), count = start.count;
  const int* carrying = start.carrying;
  double f[LineStart::kMost] = {};
  if (count <= 0 || (count == 1 && !follow<1>(c, law, e, start, f, certificate)) ||
      (count == 2 && !follow<2>(c, law, e, start, f, certificate)) ||
      (count == 3 && !follow<3>(c, law, e, start, f, certificate)))
    return false;
  double scale = 0, least_gap = std::numeric_limits<double>::infinity();
  certificate.least_force = f[0];
  for (int i = 0, k = 0; i < n; ++i) {
    scale = std::max(scale, std::abs(e[i]));
    d[i] = 0;
    if (k < count && carrying[k] == i) {
      certificate.least_force = std::min(certificate.least_force, f[k++]);
      continue;
    }
    double size = std::abs(e[i]);
    d[i] = e[i];
    for (int j = 0; j < count; ++j) {
      d[i] += c(i, carrying[j]) * f[j];
      size += std::abs(c(i, carrying[j])) * f[j];
    }
    if (!(d[i] >= -kRoundOff * size)) return false;
    certificate.degenerate += std::abs(d[i]) <= kRoundOff * size;
    least_gap = std::min(least_gap, d[i]);
    certificate.residual = std::max(certificate.residual, -d[i]);
  }
  for (int i = 0, k = 0; i < n; ++i) force[i] = k < count && carrying[k] == i ? f[k++] : 0;
  certificate.least_gap = count < n ? least_gap : 0;
  certificate.residual /= scale;
  return true;
}

}  // namespace

void LineStart::look(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                     const Eigen::Ref<const VectorXd>& start) {
  forget();
  int n = 0;
  for (int i = 0; i < start.size(); ++i) {
    if (!(start[i] > 0)) continue;
    if (n == kMost || !std::isfinite(start[i])) return;
    at[n] = start[i];
    carrying[n++] = i;
  }
  if (n == 0 || (n == 1   ? linearise<1>(c, law, *this)
                 : n == 2 ? linearise<2>(c, law, *this)
                          : linearise<3>(c, law, *this)))
    count = n;
}

Certificate solve_line_contact(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                               const Eigen::Ref<const VectorXd>& e, Eigen::Ref<VectorXd> force,
                               Eigen::Ref<VectorXd> d) {
  LineStart start;
  start.look(c, law, force);
  return solve_line_contact(c, law, e, start, force, d);
}

namespace {

template <int Most>
// NOLINTNEXTLINE(readability-function-size): the innermost loop of contact lines, whose steps share all of its state
Certificate solve_by_energy(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                            const Eigen::Ref<const VectorXd>& e, Eigen::Ref<VectorXd> force,
                            Eigen::Ref<VectorXd> d) {
  const Eigen::Index n = e.size();
  Certificate certificate;
  Vector<Most> f(n);
  Carrying<Most> carrying(n);
  auto& in = carrying.in;
  for (int i = 0; i < n; ++i) {
    in[i] = force[i] > 0 && std::isfinite(force[i]);
    f[i] = in[i] ? force[i] : 0;
  }
  const double scale = n ? e.cwiseAbs().maxCoeff() : 0;
  Vector<Most> tolerance(n);  // m: round-off of each pair's terms, however far the others are
  // Pairs come in one by one, each after four or five steps of those that are in.
  const Eigen::Index most_steps = 200 + 8 * n;
  for (int step = 0;; ++step) {
    double worst = 0, least = 0;
    int incoming = -1;
    bool met = true;
    for (int i = 0; i < n; ++i) {
      const double own = f[i] > 0 ? law[i].at(f[i]).indentation : 0;
      d[i] = c.row(i).dot(f) + own + e[i];
      tolerance[i] = kRoundOff * (c.row(i).cwiseAbs().dot(f) + std::abs(own) + std::abs(e[i]));
      if (in[i]) {
        met = met && std::abs(d[i]) <= tolerance[i];
        worst = std::max(worst, std::abs(d[i]));
      } else if (d[i] < std::min(least, -tolerance[i])) {
        least = d[i];
        incoming = i;
      }
    }
    certificate.iterations = step + 1;
    if (met) {
      if (incoming < 0) break;
      in[incoming] = 1;
    }
    if (step == most_steps)
      fail(Failure::numerical, "line contact did not converge: a gap of ", worst, " m where ", n,
           " pairs touch, largest |e| ", scale, " m, after ", step, " steps");

    // A pair that has just come to zero, or came in, and is pulled below zero by the others stays out.
    Vector<Most> change(n), right;
    for (bool again = true; again;) {
      again = false;
      carrying.list();
      right.resize(carrying.count);
      for (int i = 0; i < carrying.count; ++i) right[i] = -d[carrying.number[i]];
      ++certificate.factorisations;
      right = factorise(c, law, f, carrying).solve(right);
      for (int i = 0; i < carrying.count; ++i)
        if (f[carrying.number[i]] == 0 && right[i] < 0) {
          in[carrying.number[i]] = 0;
          again = true;
        }
    }
    change.setZero();
    for (int i = 0; i < carrying.count; ++i) change[carrying.number[i]] = right[i];

    double reach = 1;
    for (int i = 0; i < n; ++i)
      if (f[i] + reach * change[i] < 0) reach = -f[i] / change[i];
    const double fall = change.dot(d);
    const Energy before = energy<Most>(c, law, e, f);
    Vector<Most> next(n);
    constexpr int kMostHalvings = 30;
    double part = reach;
    for (int halving = 0;; ++halving, part *= 0.5) {
      next = (f + part * change).cwiseMax(0.0);
      const Energy after = energy<Most>(c, law, e, next);
      const double slack = kRoundOff * (before.magnitude + after.magnitude);
      if (after.value <= before.value + 1e-4 * part * fall + slack) break;
      if (halving == kMostHalvings)
        fail(Failure::numerical, "line contact: after ", step, " steps the energy ", before.value, " N m of ",
             carrying.count, " pairs with force does not fall along Newton's step (to ", after.value,
             " N m over ", part, " of it, slope ", fall, " N m, gap ", worst,
             " m): the compliance is not symmetric and positive definite");
    }
    for (int i = 0; i < n; ++i) {
      if (part == reach && reach < 1 && change[i] < 0 && next[i] <= kRoundOff * f[i]) next[i] = 0;
      if (next[i] == 0) in[i] = 0;
    }
    f = next;
  }

  force = f;
  certificate.least_gap = certificate.least_force = std::numeric_limits<double>::infinity();
  for (int i = 0; i < n; ++i) {
    if (f[i] > 0) {
      certificate.least_force = std::min(certificate.least_force, f[i]);
    } else {
      certificate.least_gap = std::min(certificate.least_gap, d[i]);
      certificate.degenerate += std::abs(d[i]) <= tolerance[i];
    }
    const double compliance = c(i, i) + law[i].at(f[i]).slope;
    if (scale > 0)
      certificate.residual =
          std::max(certificate.residual, std::abs(std::min(d[i], f[i] * compliance)) / scale);
  }
  if (std::isinf(certificate.least_gap)) certificate.least_gap = 0;
  if (std::isinf(certificate.least_force)) certificate.least_force = 0;
  require_residual(certificate);
  return certificate;
}

template <int Most>
double stiffness_of(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                    const Eigen::Ref<const VectorXd>& approach, const Eigen::Ref<const VectorXd>& force) {
  Carrying<Most> carrying(force.size());
  for (int i = 0; i < force.size(); ++i) carrying.in[i] = force[i] > 0;
  carrying.list();
  if (carrying.count == 0) return 0;
  Vector<Most> reduced(carrying.count);
  for (int i = 0; i < carrying.count; ++i) reduced[i] = approach[carrying.number[i]];
  return reduced.dot(factorise(c, law, force, carrying).solve(reduced));
}

}  // namespace

Certificate solve_line_contact(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                               const Eigen::Ref<const VectorXd>& e, LineStart& start,
                               Eigen::Ref<VectorXd> force, Eigen::Ref<VectorXd> d) {
  Certificate certificate;
  if (follow_start(c, law, e, start, force, d, certificate)) return certificate;
  if (!e.allFinite() || !c.allFinite()) fail(Failure::numerical, "line contact: a number is not finite");
  start.forget();
  return e.size() > kMostContacts ? solve_by_energy<Eigen::Dynamic>(c, law, e, force, d)
         : e.size() > kMostPairs  ? solve_by_energy<kMostContacts>(c, law, e, force, d)
                                  : solve_by_energy<kMostPairs>(c, law, e, force, d);
}

double line_contact_stiffness(const Eigen::Ref<const MatrixXd>& c, std::span<const HertzLine> law,
                              const Eigen::Ref<const VectorXd>& approach,
                              const Eigen::Ref<const VectorXd>& force) {
  return force.size() > kMostPairs ? stiffness_of<Eigen::Dynamic>(c, law, approach, force)
                                   : stiffness_of<kMostPairs>(c, law, approach, force);
}

void require_hertz_range(std::span<const HertzLine> law, const Eigen::Ref<const VectorXd>& force) {
  for (int i = 0; i < force.size(); ++i)
    if (!(force[i] <= law[i].largest_force()))
      fail_outside_range(Failure::numerical, "line contact: a pair carries ", force[i], " N on a width of ",
                         law[i].width(force[i]) * 1e3, " mm; Hertz's law relative to its depth holds up to ",
                         law[i].largest_force(), " N, width ", law[i].width(law[i].largest_force()) * 1e3,
                         " mm; lower the load, take a larger depth or contact = \"strips\"");
}

}  // namespace whine
