// The load over the face of a misaligned pair of equal gears, spur or helical, at the pitch point beside CalculiX.
//
// Signorini's problem: pressures p >= 0 on a patch of the flank, with gaps g = e - x + u(p) >= 0 and p g = 0 in the mean over the shape of each
// pressure, sum of all forces T / (r_b cos beta_b). u is CalculiX's alone, of a whole gear whose mesh on the patch is fine enough to hold the dent:
// no law of Hertz, no half-plane, no polynomials. The image of either gear in the
// pitch point, at the other end of the face, is the other one, of the other hand, so one body serves for both. Pressures are bilinear on the sides of
// the wedges, along the flank and over the face, about the contact line.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/accuracy_runs.h"
#include "bench/calculix_gear.h"
#include "contact/complementarity.h"
#include "gear/contact_lines.h"
#include "gear/helix.h"
#include "system/face_points.h"

namespace whine {

class MisalignedFlanks {
 public:
  // border: m, ascending, of the layers of wedges over the face; reach: m, of the patch to either side of the pitch point; sides: of wedges
  // on it along the flank.
  MisalignedFlanks(const GearDesign& design, const Material& material, double misalignment,
                   const std::vector<double>& border, double reach, int sides)
      : reach_(reach),
        sides_(sides),
        misalignment_(misalignment),
        tooth_(design),
        body_(design, material, plan(), border) {
    const std::vector<double>& z = body_.level();
    rows_ = static_cast<Index>(border.size());
    const Index pressures = rows_ * (sides_ + 1);
    area_.setZero(pressures);
    gap_.setZero(pressures);
    std::vector<CalculixGear::Vectors> force(static_cast<size_t>(pressures));
    const GaussRule rule = gauss_rule(4);
    const double step = 2 * reach_ / sides_;
    for (Index k = 0; k + 1 < rows_; ++k)
      for (int i = 0; i < sides_; ++i)
        for (Index p = 0; p < rule.point.size(); ++p)
          for (Index q = 0; q < rule.point.size(); ++q) {
            const double t = 0.5 * (1 + rule.point[p]), s = 0.5 * (1 + rule.point[q]),
                         low = z[static_cast<size_t>(2 * k)], high = z[static_cast<size_t>(2 * k + 2)],
                         arc = (i + t) * step - reach_, at = low + s * (high - low),
                         area = 0.25 * rule.weight[p] * rule.weight[q] * step * (high - low);
            for (const int a : {0, 1})
              for (const int b : {0, 1}) {
                const double shape = (a ? t : 1 - t) * (b ? s : 1 - s) * area;
                const Index pressure = (k + b) * (sides_ + 1) + i + a;
                area_[pressure] += shape;
                gap_[pressure] += shape * gap(arc, at);
                body_.add(force[static_cast<size_t>(pressure)], {0, 0, roll(arc, at), at},
                          shape * body_.inward(0, roll(0, at), at));
              }
          }
    const Eigen::MatrixXd own = body_.flexibility(force);
    Eigen::VectorXi image(pressures);
    for (Index k = 0; k < rows_; ++k)
      for (int i = 0; i <= sides_; ++i)
        image[k * (sides_ + 1) + i] = static_cast<int>((rows_ - 1 - k) * (sides_ + 1)) + sides_ - i;
    compliance_ = own + own(image, image);
    compliance_ = (0.5 * (compliance_ + compliance_.transpose())).eval();
  }

  // Under this force (N, normal): approach (m), N m-1 at the borders of the layers.
  struct Load {
    double approach = 0;  // along the transverse line of action
    Eigen::VectorXd line_load;
  };
  Load under(double force) const {
    double low = gap_.cwiseQuotient(area_).minCoeff(), high = low + 1e-4;  // m
    Eigen::VectorXd pressure(gap_.size()), open(gap_.size());
    ComplementaritySolver solver;
    ActiveSet active;
    constexpr int kHalvings = 45;
    for (int i = 0; i < kHalvings; ++i) {
      const double x = 0.5 * (low + high);
      solver.solve(compliance_, gap_ - x * area_, active, pressure, open);
      (pressure.dot(area_) > force ? high : low) = x;
    }
    Load out{low / cosine_, Eigen::VectorXd::Zero(rows_)};
    const double step = 2 * reach_ / sides_;
    for (Index k = 0; k < rows_; ++k) {
      const auto row = pressure.segment(k * (sides_ + 1), sides_ + 1);
      if (row[0] > 0 || row[sides_] > 0)
        fail(Failure::numerical, "the contact is wider than the patch of ", 2e3 * reach_, " mm");
      out.line_load[k] = step * row.sum();
    }
    return out;
  }
  const CalculixGear& body() const { return body_; }

 private:
  using Index = Eigen::Index;
  double pitch_roll() const { return tooth_.roll_angle_at_radius(tooth_.pitch_radius()); }
  // rad; arc: m from the contact line at z.
  double roll(double arc, double z) const {
    const double contact = pitch_roll() + twist_ * z;
    return std::sqrt(contact * contact + 2 * arc / tooth_.base_radius());
  }
  // Along the normal: the transverse one times cos beta_b. z: of the driver, whose mate has its own the other way in its image.
  double gap(double arc, double z) const {
    double out = 0;
    for (const double way : {1.0, -1.0}) {
      const double contact = roll(0, way * z);
      out -= tooth_.flank_normal(contact).dot(tooth_.flank_point(roll(way * arc, way * z)) -
                                              tooth_.flank_point(contact));
    }
    return misalignment_ * z / tooth_.design().face_width + cosine_ * out;
  }
  GearMeshPlan plan() const {
    GearMeshPlan out;
    const double module = tooth_.design().module, side = 2 * reach_ / sides_;
    const Vec2 normal = tooth_.flank_normal(pitch_roll());
    out.turned = -std::atan2(normal.y(), normal.x());
    out.coarse = 1.5 * module;
    out.growth = 0.4;
    out.middle = pitch_roll();
    out.reach = reach_;
    out.sides = sides_;
    const GearMesher bare(tooth_, out);
    out.fine = {{{bare.placed(0, tooth_.flank_point(pitch_roll()), false)}, side, 1.5 * reach_},
                bare.flanks_of_three(0.3 * module)};
    return out;
  }

  double reach_;
  int sides_;
  double misalignment_;
  ToothGeometry tooth_;
  double twist_ = helix_twist(tooth_.design());
  double cosine_ = std::cos(base_helix_angle(tooth_.design()));
  CalculixGear body_;
  Index rows_ = 0;
  Eigen::VectorXd area_, gap_;  // (pressure) m2, m3: of its shape
  Eigen::MatrixXd compliance_;  // (pressure, pressure) m5 N-1
};

// Difference of K_Hbeta, 1, of a misaligned scene of two equal gears at its first torque on bodies in three dimensions, with one pair of teeth
// in contact at the pitch point. Both are read at the points of the program by its rule for the ends, over the mean of the whole face.
inline double compare_face_load(const std::string& name, Scene scene) {
  const auto& [driver, driven] = scene.mesh().gear;
  const GearDesign design = scene.gear(driver).design;
  scene.fidelity.width = WidthModel::body;
  scene.body.width.degree = degree_of_width(design, scene.gear(driven).design);
  const double torque = scene.operation.torques.front();
  const std::vector<ReducedBody> body =
      bodies_of({body_parameters(scene, driver), body_parameters(scene, driven)});
  const StaticResult rest = static_transmission(
      body[0], body[1], through_file(static_parameters(scene), read_static_parameters), torque);
  const auto reference = std::find(rest.pair.begin(), rest.pair.end(), 0) - rest.pair.begin();
  const double force = helical_forces(GearPair(rest), torque).normal, width = design.face_width;
  const Eigen::VectorXd z = rest.face.position[0].row(reference), weight = rest.face.width[0].row(reference),
                        ours = rest.face.line_load[0].row(reference);
  if (std::abs(ours.dot(weight) / force - 1) > 1e-6)
    fail(Failure::input, name, ": other teeth carry ", 100 * (1 - ours.dot(weight) / force),
         " % at the pitch point");

  std::vector<double> border;
  for (const double t : {0.0, 0.12, 0.24, 0.34, 0.41, 0.455, 0.48, 0.5}) {
    border.push_back(width * t);
    if (t > 0) border.push_back(-width * t);
  }
  std::sort(border.begin(), border.end());
  const double modulus = scene.gear(driver).material.youngs_modulus /
                         (2 * (1 - std::pow(scene.gear(driver).material.poisson_ratio, 2)));
  const double radius = 0.5 * ToothGeometry(design).pitch_radius() *
                        std::sin(transverse_section(design).pressure_angle);                   // m, relative
  const double half = std::sqrt(4 * ours.maxCoeff() * radius / (std::numbers::pi * modulus));  // m
  const MisalignedFlanks flanks(design, scene.gear(driver).material, scene.mesh().misalignment, border,
                                1.6 * half, 10);
  const MisalignedFlanks::Load load = flanks.under(force);
  Eigen::VectorXd theirs(z.size());
  for (Eigen::Index i = 0; i < z.size(); ++i) {
    size_t k = 0;
    while (k + 2 < border.size() && border[k + 1] < z[i]) ++k;
    const double t = (z[i] - border[k]) / (border[k + 1] - border[k]);
    const auto row = static_cast<Eigen::Index>(k);
    theirs[i] = (1 - t) * load.line_load[row] + t * load.line_load[row + 1];
  }
  const ContactLine line{0, -0.5 * width, 0.5 * width};
  const auto factor = [&](const Eigen::VectorXd& w) {
    return face_load_factor(z, weight, w, line, kInnerFace) * w.dot(weight) / force;
  };
  std::printf("  %s at %g N m, pitch point: z (mm), line load here and in CalculiX (N/mm)\n", name.c_str(),
              torque);
  for (Eigen::Index i = 0; i < z.size(); ++i)
    std::printf("    %8.3f %9.3f %9.3f\n", 1e3 * z[i], 1e-3 * ours[i], 1e-3 * theirs[i]);
  std::printf("    at the borders of CalculiX's layers:");
  for (size_t k = 0; k < border.size(); ++k)
    std::printf(" %.2f: %.2f", 1e3 * border[k], 1e-3 * load.line_load[static_cast<Eigen::Index>(k)]);
  const double off = factor(ours) / factor(theirs) - 1;
  std::printf(
      "\n  K_Hbeta %.4f, CalculiX %.4f: %.2f %%; transmission error %.4f, %.4f um: %.2f %%; CalculiX: %zu nodes, CPU %.0f s\n",
      factor(ours), factor(theirs), 100 * off, 1e6 * rest.transmission_error[0], 1e6 * load.approach,
      100 * (rest.transmission_error[0] / load.approach - 1), flanks.body().nodes(), flanks.body().seconds());
  std::fflush(stdout);
  return std::abs(off);
}

}  // namespace whine
