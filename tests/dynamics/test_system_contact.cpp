// Contact of many pairs followed from visit to visit is that of solve_line_contact(), which starts anew.
#include "dynamics/system_contact.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "contact/line_contact.h"
#include "memory.h"
#include "refusal.h"

using namespace whine;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

struct Pairs {
  explicit Pairs(int count) : compliance(MatrixXd::Zero(padded(count), count)) {
    const HalfPlaneSurface surface({206e9, 0.3, 7850, true}, 20e-3);
    for (int i = 0; i < count; ++i) {
      // Some end at a tip edge.
      law.emplace_back(surface, surface, 8e-3 + 1e-3 * (i % 5), 0.5e-3,
                       i % 4 == 3 ? -0.002 : -std::numeric_limits<double>::infinity());
      for (int j = 0; j < count; ++j) compliance(i, j) = 4e-9 * std::exp(-0.7 * std::abs(i - j)) + 1e-10;
    }
    followed.reserve(count);
  }
  VectorXd gap(double t) const {  // about every third pair carries; they come and go
    VectorXd out = VectorXd::Zero(compliance.rows());
    for (size_t i = 0; i < law.size(); ++i)
      out[static_cast<Index>(i)] = 1e-5 * std::sin(2.1 * static_cast<double>(i) + t) + offset;
    return out;
  }
  MatrixXd compliance;
  std::vector<HertzLine> law;
  FollowedContact followed;
  double offset = 0;
};

// Largest difference of a force to the solution from nothing, relative to the largest force; forces: start and result.
double difference(Pairs& of, double t, VectorXd& force) {
  const auto n = static_cast<Index>(of.law.size());
  const VectorXd e = of.gap(t);
  VectorXd alone = VectorXd::Zero(n), gap(n), d = VectorXd::Zero(of.compliance.rows());
  solve_line_contact(of.compliance.topRows(n), of.law, e.head(n), alone, gap);
  const Certificate certificate = of.followed.solve(of.compliance, of.law, e, force, d);
  CHECK(certificate.least_gap >= -1e-20);
  CHECK((force.array() >= 0).all());
  CHECK((d.head(n) - gap).cwiseAbs().maxCoeff() < 1e-12 * e.cwiseAbs().maxCoeff());
  return (force - alone).cwiseAbs().maxCoeff() / alone.maxCoeff();
}

}  // namespace

TEST_CASE("contact of many pairs, followed from visit to visit, is that of a start from nothing") {
  Pairs pairs(20);
  VectorXd force = VectorXd::Zero(20);
  double worst = 0;
  for (int visit = 0; visit < 400; ++visit) {
    const double step = visit < 100 ? 0.05 : visit < 200 ? 1.3 : visit < 300 ? 1e-4 : 1e-9;
    if (visit % 50 == 0) pairs.followed.forget();
    worst = std::max(worst, difference(pairs, step * visit, force));
  }
  CHECK(worst < 1e-12);

  const VectorXd e = pairs.gap(0.4);
  VectorXd d = VectorXd::Zero(pairs.compliance.rows());
  pairs.followed.solve(pairs.compliance, pairs.law, e, force, d);
  const long before = memory_requests;
  const Certificate again = pairs.followed.solve(pairs.compliance, pairs.law, e, force, d);
  const Certificate third = pairs.followed.solve(pairs.compliance, pairs.law, e, force, d);
  CHECK(memory_requests == before);
  CHECK(again.factorisations == 0);
  CHECK(third.iterations == 1);
}

TEST_CASE("contact of more pairs than are followed, of none, and gaps that are no numbers") {
  Pairs many(48);
  many.offset = -2e-5;  // all carry
  VectorXd force = VectorXd::Zero(48);
  for (const double t : {0.0, 0.1, 0.2}) CHECK(difference(many, t, force) < 1e-12);

  Pairs few(3);
  few.offset = 1e-3;
  VectorXd none = VectorXd::Constant(3, 10), d = VectorXd::Zero(few.compliance.rows());
  const Certificate open = few.followed.solve(few.compliance, few.law, few.gap(0), none, d);
  CHECK(none.isZero(0));
  CHECK(open.least_gap == few.gap(0).head(3).minCoeff());
  few.offset = std::nan("");
  CHECK(failure_of([&] { few.followed.solve(few.compliance, few.law, few.gap(0), none, d); }) ==
        Failure::numerical);
}
