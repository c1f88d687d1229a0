// Gears in three dimensions beside CalculiX: what their bodies give way, and the load over the face of a misaligned pair.
//
// Bodies: one tooth of a whole gear is loaded along its contact line, spur and with a helix of 20 degrees, evenly, tilted, on the middle fifth
// and on the last fifth of the face; then that of parker2000-helical-1_0. CalculiX takes wedges of fifteen nodes (calculix_gear.h), Whine its
// section times polynomials over the face. Compared over the face, along the inward normal of the loaded flank: displacements on the other
// flank of the loaded tooth, behind the line, and on the flanks of both neighbours. That is what the polynomials have to hold. Nearer
// to the load they are no model: there the program has the plane tables, half-planes and completion (solid/width_tables.h), which real
// contact of a misaligned pair puts to the test (width_contact.h).
//
// Example: whine-bench-width data/scenes/parker2000-misaligned.toml
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/legendre.h"
#include "base/tool.h"
#include "bench/calculix_gear.h"
#include "bench/width_contact.h"
#include "bench/width_roots.h"
#include "solid/flank_loads.h"
#include "solid/flank_table.h"
#include "solid/mesher.h"
#include "solid/width_body.h"

namespace {
using namespace whine;
using Eigen::Index;
using Eigen::VectorXd;

constexpr double kLimit = 0.01;  // of the largest displacement

struct Load {
  const char* name;
  std::function<double(double)> at;  // N m-1 at z over the face width, -0.5 to 0.5
};
const std::array kLoads{
    Load{"even", [](double) { return 1e5; }},
    Load{"tilted", [](double t) { return 1e5 * (1 + 2 * t); }},
    Load{"middle fifth", [](double t) { return std::abs(t) < 0.1 ? 1e5 : 0.0; }},
    Load{"last fifth", [](double t) { return t > 0.3 ? 1e5 : 0.0; }},
};
// Behind the line twice: all of it, and what motions along the axis have in it.
constexpr std::array kPlaces{"behind the line", "along the axis in it", "on the next tooth",
                             "on the last tooth"};
constexpr size_t kAxial = 1;
using Reading = std::array<VectorXd, kPlaces.size()>;  // [place] (level) m

// Where the gear is loaded and read: the contact line through the pitch point.
struct Case {
  GearDesign design;
  Material material{207e9, 0.3, 7800, false};
  double twist = helix_twist(design);
  ToothGeometry tooth{design};
  double roll(double z) const { return tooth.roll_angle_at_radius(tooth.pitch_radius()) + twist * z; }
  double width() const { return design.face_width; }
};

std::vector<double> borders(double width) {  // m: of ten layers, fifths of the face on them
  std::vector<double> out;
  for (int i = 0; i <= 10; ++i) out.push_back(width * (0.1 * i - 0.5));
  return out;
}
std::vector<double> levels(double width) {
  std::vector<double> out;
  for (int i = 0; i <= 20; ++i) out.push_back(width * (0.05 * i - 0.5));
  return out;
}

// f(z, dz) at the Gauss points of all layers.
template <class F>
void along_the_face(double width, const F& f) {
  const std::vector<double> border = borders(width);
  const GaussRule rule = gauss_rule(16);
  for (size_t i = 1; i < border.size(); ++i)
    for (Index k = 0; k < rule.point.size(); ++k) {
      const double half = 0.5 * (border[i] - border[i - 1]);
      f(0.5 * (border[i] + border[i - 1]) + half * rule.point[k], half * rule.weight[k]);
    }
}

class ByPolynomials {
 public:
  ByPolynomials(const Case& gear, int degree)
      : gear_(gear), degree_(degree), flank_(gear.tooth, 32), points_(flank_.size() * (degree + 1)) {
    const SectorGrid section = make_sector_mesh(gear.design, {.element_size = 0.25 * gear.design.module});
    const SparseReal normal = inward_normal(section, gear.twist, flank_.points());
    // The same directions on the mirror images of the nodes: the other flank.
    std::vector<Eigen::Triplet<double>> entries;
    const Index points = flank_.size();
    for (Index k = 0; k < normal.outerSize(); ++k)
      for (SparseReal::InnerIterator it(normal, k); it; ++it) {
        entries.emplace_back(it.row(), k, it.value());
        Vec2 there = section.node_position.row(it.row() / 3);
        there.x() *= -1;
        Index image = 0;
        (section.node_position.rowwise() - there.transpose()).rowwise().squaredNorm().minCoeff(&image);
        entries.emplace_back(3 * image + it.row() % 3, points + k, it.value());
        if (it.row() % 3 == 2) entries.emplace_back(3 * image + 2, 2 * points + k, it.value());
      }
    SparseReal functional(normal.rows(), 3 * points);
    functional.setFromTriplets(entries.begin(), entries.end());
    table_ = width_flexibility(section, gear.material, gear.twist, degree, {functional, {}}, 1);
  }

  Reading read(const Load& load) const {
    VectorXd force = VectorXd::Zero(points_);
    along_the_face(gear_.width(),
                   [&](double z, double dz) { force += dz * load.at(z / gear_.width()) * at(z); });
    const std::array<VectorXd, kPlaces.size()> field{
        table_[0].block(points_, 0, points_, points_) * force,
        table_[0].block(2 * points_, 0, points_, points_) * force,
        table_[1].topLeftCorner(points_, points_) * force,
        table_[1].topLeftCorner(points_, points_).transpose() * force};
    Reading out;
    for (size_t place = 0; place < out.size(); ++place) {
      const std::vector<double> z = levels(gear_.width());
      out[place].resize(static_cast<Index>(z.size()));
      for (size_t i = 0; i < z.size(); ++i) out[place][static_cast<Index>(i)] = at(z[i]).dot(field[place]);
    }
    return out;
  }

 private:
  VectorXd at(double z) const {  // (flank polynomial)
    const VectorXd over = face_polynomials(z, gear_.width(), degree_);
    const Eigen::RowVectorXd along = flank_.weights(gear_.roll(z));
    return (over * along).reshaped();
  }
  const Case& gear_;
  int degree_;
  FlankTable flank_;
  Index points_;
  std::vector<MatrixRM> table_;
};

class ByCalculix {
 public:
  explicit ByCalculix(const Case& gear)
      : gear_(gear), body_(gear.design, gear.material, plan(gear), borders(gear.width())) {}

  // Of all loads.
  std::vector<Reading> read() {
    std::vector<CalculixGear::Vectors> functional(kLoads.size());
    for (size_t l = 0; l < kLoads.size(); ++l)
      along_the_face(gear_.width(), [&](double z, double dz) {
        const double roll = gear_.roll(z), force = dz * kLoads[l].at(z / gear_.width());
        if (force != 0) body_.add(functional[l], {0, 0, roll, z}, force * body_.inward(0, roll, z));
      });
    const auto last = static_cast<size_t>(gear_.design.teeth) - 1;
    const std::array<std::array<size_t, 2>, kPlaces.size()> place{{{1, 0}, {1, 0}, {0, 1}, {0, last}}};
    for (size_t k = 0; k < place.size(); ++k)
      for (const double z : body_.level()) {
        Eigen::Vector3d n = body_.inward(place[k][1], gear_.roll(z), z);
        if (k == kAxial) n.head<2>().setZero();
        body_.add(functional.emplace_back(), {place[k][0], place[k][1], gear_.roll(z), z}, n);
      }
    const Eigen::MatrixXd moved = body_.flexibility(functional);
    const auto levels = static_cast<Index>(body_.level().size());
    std::vector<Reading> out(kLoads.size());
    for (size_t l = 0; l < out.size(); ++l)
      for (size_t k = 0; k < place.size(); ++k)
        out[l][k] = moved.col(static_cast<Index>(l))
                        .segment(static_cast<Index>(kLoads.size()) + static_cast<Index>(k) * levels, levels);
    return out;
  }
  size_t nodes() const { return body_.nodes(); }
  double seconds() const { return body_.seconds(); }

 private:
  static GearMeshPlan plan(const Case& gear) {
    GearMeshPlan out;
    const double module = gear.design.module;
    out.coarse = 1.5 * module;
    out.growth = 0.4;
    out.fine.push_back(GearMesher(gear.tooth, out).flanks_of_three(0.2 * module));
    return out;
  }
  const Case& gear_;
  CalculixGear body_;
};

// Polynomials to this degree under the first of the loads.
struct Judged {
  int degree;
  size_t loads;
};

// Prints differences in % of the largest displacement of theirs at each place, and returns the largest of them all.
double compare(const char* name, const Case& gear, const std::vector<Judged>& all) {
  ByCalculix body(gear);
  const std::vector<Reading> theirs = body.read();
  std::printf("  %s: CalculiX: %zu nodes, CPU %.0f s\n", name, body.nodes(), body.seconds());
  double worst = 0;
  for (const auto& [degree, loads] : all) {
    const ByPolynomials ours(gear, degree);
    for (size_t l = 0; l < loads; ++l) {
      const Reading a = ours.read(kLoads[l]);
      const Reading& b = theirs[l];
      std::printf("    degree %d, %-12s:", degree, kLoads[l].name);
      for (size_t place = 0; place < kPlaces.size(); ++place) {
        if (place == kAxial && gear.twist == 0) continue;
        const double largest = b[place == kAxial ? 0 : place].cwiseAbs().maxCoeff(),
                     off = (a[place] - b[place]).cwiseAbs().maxCoeff() / largest;
        worst = std::max(worst, off);
        std::printf("%s %.3f %% of %.4f um %s (mean %.4f, %.4f)", place == 0 ? "" : ",", 100 * off,
                    1e6 * largest, kPlaces[place], 1e6 * a[place].mean(), 1e6 * b[place].mean());
      }
      std::puts("");
      std::fflush(stdout);
    }
  }
  return worst;
}

GearDesign gear_of(int teeth, double beta, double width, double bore) {
  GearDesign d;
  d.teeth = teeth;
  d.module = 3e-3;
  d.pressure_angle = 20 * std::numbers::pi / 180;
  d.helix_angle = beta * std::numbers::pi / 180;
  d.face_width = width;
  d.bore_radius = bore;
  return d;
}

constexpr double kFactorLimit = 0.02;  // of K_Hbeta
constexpr double kRootLimit = 0.02;    // of the largest root stress

// 30 teeth with 20 degrees of helix, so short that at the pitch point one pair alone touches: transverse contact ratio 1.2, overlap ratio 0.7.
Scene short_helical_pair() {
  return through_file(
      R"([gear.pinion]
teeth = 30
module_mm = 3
pressure_angle_deg = 20
helix_angle_deg = 20
addendum = 0.72
face_width_mm = 19
bore_radius_mm = 25
material = "steel"
[gear.wheel]
like = "pinion"
hand = "left"
[material.steel]
youngs_modulus_GPa = 207
poisson_ratio = 0.3
density_kgm3 = 7800
plane = "strain"
[[mesh]]
driver = "pinion"
driven = "wheel"
centre_distance_mm = 95.776
misalignment_um = 10
[operation]
torque_Nm = [80]
mesh_frequency_Hz = { from = 600, to = 4000, step = 20 }
)",
      read_scene);
}

void body(int argc, char** argv) {
  if (!calculix_installed()) {
    std::printf("(no CalculiX to compare with: make deps-bench)\n");
    return;
  }
  double factor = 0, worst = 0;
  for (int i = 1; i < argc; ++i) factor = std::max(factor, compare_face_load(argv[i], read_scene(argv[i])));
  factor = std::max(factor, compare_face_load("short teeth, 20 deg", short_helical_pair()));
  // Degree 8 is what the program takes at this width. A fifth of the face of 25.4 mm it does not resolve.
  worst = std::max(worst, compare("18 teeth, spur", {gear_of(18, 0, 20e-3, 12e-3)}, {{8, 4}}));
  worst = std::max(worst, compare("18 teeth, 20 deg", {gear_of(18, 20, 20e-3, 12e-3)}, {{8, 4}}));
  worst = std::max(worst, compare("gear of parker2000-helical-1_0", {gear_of(50, 21.780650, 25.4e-3, 40e-3)},
                                  {{8, 2}, {12, 4}}));
  double root = 0;
  const std::vector<std::pair<const char*, RootsOverFace::Load>> loads{{kLoads[0].name, kLoads[0].at},
                                                                       {kLoads[1].name, kLoads[1].at}};
  for (const double beta : {0.0, 20.0}) {
    const Case gear{gear_of(18, beta, 20e-3, 12e-3)};
    root = std::max(root, compare_roots(beta > 0 ? "18 teeth, 20 deg" : "18 teeth, spur", gear.design,
                                        gear.material, 8, loads));
  }
  if (root > kRootLimit)
    fail(Failure::numerical, "root stresses differ from CalculiX's by ", 100 * root,
         " % of the largest within 90 % of the face, at most ", 100 * kRootLimit, " % is allowed");
  if (worst > kLimit)
    fail(Failure::numerical, "displacements differ from CalculiX's by ", 100 * worst,
         " % of the largest, at most ", 100 * kLimit, " % is allowed");
  if (factor > kFactorLimit)
    fail(Failure::numerical, "K_Hbeta differs from CalculiX's by ", 100 * factor, " %, at most ",
         100 * kFactorLimit, " % is allowed");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
