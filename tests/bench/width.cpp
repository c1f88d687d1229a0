// Bodies over the face width beside CalculiX: one loaded tooth of a whole gear, spur and with a helix of 20 degrees, under an even load, a
// tilted one, one on the middle fifth of the face and one on its last fifth. Both take the same section mesh: CalculiX extrudes it to
// hexahedra of twenty nodes (C3D20R), turned with the helix, Whine multiplies it with polynomials over the face.
//
// Compared: the displacement along the inward normal of the loaded flank over the face, away from the load: half a module below the flank, and
// on the flanks of both neighbours.
//
// Example: whine-bench-width
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/legendre.h"
#include "base/tool.h"
#include "bench/calculix.h"
#include "gear/helix.h"
#include "gear/involute.h"
#include "solid/elements.h"
#include "solid/mesher.h"
#include "solid/width_body.h"

namespace {
using namespace whine;
using Eigen::Index;

constexpr double kLimit = 0.01;  // of the largest displacement
constexpr double kWidth = 20e-3, kModule = 3e-3;
constexpr int kTeeth = 18, kDegree = 8;
// m: borders of the layers of hexahedra, of one half of the face; a fifth of it ends on them.
constexpr std::array kBorders{0.0, 2e-3, 4e-3, 6e-3, 8e-3, 10e-3};

GearDesign gear_of(double beta) {
  GearDesign d;
  d.teeth = kTeeth;
  d.module = kModule;
  d.pressure_angle = 20 * std::numbers::pi / 180;
  d.helix_angle = beta * std::numbers::pi / 180;
  d.face_width = kWidth;
  d.bore_radius = 12e-3;
  return d;
}

Material steel() {
  return {207e9, 0.3, 7800, false};
}

struct Load {
  const char* name;
  std::function<double(double)> at;  // N m-1 at z
  std::vector<double> jumps;         // m: z at which it jumps inside the face
};
const std::array kLoads{
    Load{"even", [](double) { return 1e5; }, {}},
    Load{"tilted", [](double z) { return 1e5 * (1 + 2 * z / kWidth); }, {}},
    Load{"middle fifth", [](double z) { return std::abs(z) < 2e-3 ? 1e5 : 0.0; }, {-2e-3, 2e-3}},
    Load{"last fifth", [](double z) { return z > 6e-3 ? 1e5 : 0.0; }, {6e-3}},
};

std::vector<double> levels() {  // m, ascending, middles of the layers between their ends
  std::vector<double> ends;
  for (size_t i = kBorders.size() - 1; i > 0; --i) ends.push_back(-kBorders[i]);
  ends.insert(ends.end(), kBorders.begin(), kBorders.end());
  std::vector<double> out{ends[0]};
  for (size_t i = 1; i < ends.size(); ++i) {
    out.push_back(0.5 * (ends[i - 1] + ends[i]));
    out.push_back(ends[i]);
  }
  return out;
}

// The gear, its section and where it is loaded and read.
struct Case {
  explicit Case(double beta)
      : design(gear_of(beta)),
        section(make_sector_mesh(design, {.element_size = 0.5 * kModule})),
        helix(helix_twist(design)) {
    const ToothGeometry tooth(design);
    const double pitch = tooth.roll_angle_at_radius(0.5 * kTeeth * kModule / std::cos(design.helix_angle));
    Index at = 0;
    (section.flank_roll_angle.array() - pitch).abs().minCoeff(&at);
    // A corner of elements: consecutive flank nodes are corners and middles in turn.
    const auto is_corner = [&](int node) { return (section.element_node.leftCols(4).array() == node).any(); };
    if (!is_corner(section.flank_node[at])) ++at;
    loaded = section.flank_node[at];
    const Vec2 n = tooth.flank_normal(section.flank_roll_angle[at]);
    normal = Eigen::Vector3d(n.x(), n.y(), -helix * tooth.base_radius()).normalized();
    const Vec2 below = section.node_position.row(loaded).transpose() - 0.5 * kModule * n;
    double least = 1;
    for (Index k = 0; k < section.element_node.rows(); ++k)
      for (int c = 0; c < 4; ++c) {
        const int node = section.element_node(k, c);
        const double off = (section.node_position.row(node).transpose() - below).norm();
        if (off < least) {
          least = off;
          deep = node;
        }
      }
  }
  GearDesign design;
  SectorGrid section;
  double helix;
  int loaded = 0, deep = 0;  // nodes of the section
  Eigen::Vector3d normal;    // outward, in turned axes
};

constexpr std::array kPlaces{"below the flank", "on the next tooth", "on the last tooth"};
using Reading = std::array<Eigen::VectorXd, 3>;  // [place] (level) m

// In turned axes a force along the inward normal and a reading along it are the same functional.
Reading by_polynomials(const Case& c, const Load& load) {
  SparseReal functional(3 * c.section.node_position.rows(), 2);
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 3; ++i) functional.insert(3 * (k == 0 ? c.loaded : c.deep) + i, k) = -c.normal[i];
  functional.makeCompressed();
  static std::map<const Case*, std::vector<MatrixRM>> known;
  auto& tables = known[&c];
  if (tables.empty()) tables = width_flexibility(c.section, steel(), c.helix, kDegree, functional, 1);
  const int all = kDegree + 1;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(all);
  const GaussRule rule = gauss_rule(10);
  const std::vector<double> z = levels();
  for (size_t i = 2; i < z.size(); i += 2)
    for (Index k = 0; k < rule.point.size(); ++k) {
      const double at = z[i - 1] + 0.5 * (z[i] - z[i - 2]) * rule.point[k];
      q += 0.5 * (z[i] - z[i - 2]) * rule.weight[k] * load.at(at) * face_polynomials(at, kWidth, kDegree);
    }
  const std::array<Eigen::VectorXd, 3> coefficient{tables[0].block(all, 0, all, all) * q,
                                                   tables[1].block(0, 0, all, all) * q,
                                                   tables[1].block(0, 0, all, all).transpose() * q};
  Reading out;
  for (size_t place = 0; place < out.size(); ++place) {
    out[place].resize(static_cast<Index>(z.size()));
    for (size_t i = 0; i < z.size(); ++i)
      out[place][static_cast<Index>(i)] = face_polynomials(z[i], kWidth, kDegree).dot(coefficient[place]);
  }
  return out;
}

// The whole gear as a deck. Number of a node: its section node of a sector at a level, edges shared.
class Deck {
 public:
  Deck(const Case& c, const Load& load) : case_(c), z_(levels()) {
    for (const auto& side : c.section.side_node.rowwise()) low_of_[side[1]] = side[0];
    std::filesystem::path folder = std::filesystem::temp_directory_path() / "whine-width-XXXXXX";
    folder_ = folder.string();
    if (!mkdtemp(folder_.data())) fail(Failure::io, "no folder ", folder_, " for the deck of CalculiX");
    elements_.reserve(static_cast<size_t>(kTeeth * c.section.element_node.rows()) * z_.size() / 2);
    for (int sector = 0; sector < kTeeth; ++sector)
      for (Index e = 0; e < c.section.element_node.rows(); ++e)
        for (size_t layer = 0; layer + 2 < z_.size(); layer += 2) add_element(sector, e, layer);
    write(load);
  }
  ~Deck() { std::filesystem::remove_all(folder_); }
  Deck(const Deck&) = delete;
  Deck& operator=(const Deck&) = delete;

  size_t nodes() const { return place_.size(); }

  Usage solve() const {
    std::fflush(nullptr);
    const pid_t child = fork();
    if (child == 0) {
      setenv("OMP_NUM_THREADS", "1", 1);
      setenv("CCX_NPROC_EQUATION_SOLVER", "1", 1);
      if (chdir(folder_.c_str()) == 0 && std::freopen("ccx.log", "w", stdout) &&
          std::freopen("ccx.err", "w", stderr))
        execlp("ccx", "ccx", "-i", "gear", static_cast<char*>(nullptr));
      _exit(127);
    }
    return wait_for(child, "ccx in " + folder_);
  }

  Reading read() const {
    std::map<int, Eigen::Vector3d> moved;
    std::ifstream in(folder_ + "/gear.dat");
    std::string line;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      int node = 0;
      Eigen::Vector3d u;
      if (words >> node >> u[0] >> u[1] >> u[2]) moved[node] = 1e-3 * u;
    }
    Reading out;
    for (size_t place = 0; place < out.size(); ++place) {
      out[place].resize(static_cast<Index>(z_.size()));
      for (size_t i = 0; i < z_.size(); ++i) {
        const auto [sector, node] = reading(place);
        const auto found = moved.find(number_.at({sector, node, static_cast<int>(i)}));
        if (found == moved.end())
          fail(Failure::numerical, "ccx in ", folder_, " printed no displacement of a node");
        out[place][static_cast<Index>(i)] = -found->second.dot(turned(case_.normal, sector, z_[i]));
      }
    }
    return out;
  }

 private:
  struct Place {
    int sector, node, level;
    auto operator<=>(const Place&) const = default;
  };
  std::pair<int, int> reading(size_t place) const {
    if (place == 0) return {0, case_.deep};
    return {place == 1 ? 1 : kTeeth - 1, case_.loaded};
  }
  Eigen::Vector3d turned(const Eigen::Vector3d& v, int sector, double z) const {
    return Eigen::AngleAxisd(2 * std::numbers::pi * sector / kTeeth + case_.helix * z,
                             Eigen::Vector3d::UnitZ()) *
           v;
  }
  int number(int sector, int node, size_t level) {
    if (const auto low = low_of_.find(node); low != low_of_.end()) {
      node = low->second;
      sector = (sector + 1) % kTeeth;
    }
    const auto [at, fresh] =
        number_.try_emplace({sector, node, static_cast<int>(level)}, static_cast<int>(place_.size()) + 1);
    if (fresh) {
      const auto p = case_.section.node_position.row(node);
      place_.push_back(turned({p[0], p[1], z_[level]}, sector, z_[level]));
    }
    return at->second;
  }
  void add_element(int sector, Index e, size_t layer) {
    const auto node = [&](int k, size_t level) {
      return number(sector, case_.section.element_node(e, k), level);
    };
    std::array<int, 20> all{};
    for (int k = 0; k < 4; ++k) {
      const auto at = static_cast<size_t>(k);
      all[at] = node(k, layer);
      all[4 + at] = node(k, layer + 2);
      all[8 + at] = node(4 + k, layer);
      all[12 + at] = node(4 + k, layer + 2);
      all[16 + at] = node(k, layer + 1);
    }
    elements_.push_back(all);
  }
  // N: consistent with the quadratic sides along the face.
  std::vector<double> forces(const Load& load) const {
    std::vector<double> out(z_.size(), 0);
    const GaussRule rule = gauss_rule(6);
    for (size_t i = 0; i + 2 < z_.size(); i += 2)
      for (Index k = 0; k < rule.point.size(); ++k) {
        const double t = rule.point[k], half = 0.5 * (z_[i + 2] - z_[i]),
                     force = half * rule.weight[k] * load.at(z_[i + 1] + half * t);
        out[i] += 0.5 * t * (t - 1) * force;
        out[i + 1] += (1 - t * t) * force;
        out[i + 2] += 0.5 * t * (t + 1) * force;
      }
    return out;
  }
  void write(const Load& load) {
    std::ofstream out(folder_ + "/gear.inp");
    out.precision(12);
    out << "*NODE, NSET=ALL\n";
    for (size_t i = 0; i < place_.size(); ++i)
      out << i + 1 << ", " << 1e3 * place_[i].x() << ", " << 1e3 * place_[i].y() << ", "
          << 1e3 * place_[i].z() << "\n";
    out << "*ELEMENT, TYPE=C3D20R, ELSET=GEAR\n";
    for (size_t e = 0; e < elements_.size(); ++e) {
      out << e + 1;
      for (size_t k = 0; k < 20; ++k) out << (k == 10 ? ",\n" : ", ") << elements_[e][k];
      out << "\n";
    }
    out << "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
        << steel().youngs_modulus * 1e-6 << ", " << steel().poisson_ratio
        << "\n*SOLID SECTION, ELSET=GEAR, MATERIAL=STEEL\n*NSET, NSET=BORE\n";
    for (const auto& [place, number] : number_)
      if ((case_.section.bore_node.array() == place.node).any()) out << number << ",\n";
    out << "*BOUNDARY\nBORE, 1, 3\n*NSET, NSET=READ\n";
    for (size_t place = 0; place < kPlaces.size(); ++place)
      for (size_t i = 0; i < z_.size(); ++i) {
        const auto [sector, node] = reading(place);
        out << number_.at({sector, node, static_cast<int>(i)}) << ",\n";
      }
    out << "*STEP\n*STATIC\n*CLOAD\n";
    const std::vector<double> force = forces(load);
    for (size_t i = 0; i < z_.size(); ++i) {
      const Eigen::Vector3d f = -force[i] * turned(case_.normal, 0, z_[i]);
      for (int k = 0; k < 3; ++k)
        out << number_.at({0, case_.loaded, static_cast<int>(i)}) << ", " << k + 1 << ", " << f[k] << "\n";
    }
    out << "*NODE PRINT, NSET=READ\nU\n*END STEP\n";
  }

  const Case& case_;
  std::vector<double> z_;
  std::map<int, int> low_of_;  // of nodes on the counter-clockwise edge those of the next sector
  std::map<Place, int> number_;
  std::vector<Eigen::Vector3d> place_;  // m
  std::vector<std::array<int, 20>> elements_;
  std::string folder_;
};

// Largest difference over the largest displacement of theirs: where the load of the same tooth jumps less than a module away, and elsewhere.
// Half a module below a jump a polynomial of kDegree over the face shows how far it resolves the jump, not the body's flexibility.
struct Difference {
  double near_jump = 0, elsewhere = 0, largest = 0;
};
Difference difference(const Load& load, const Eigen::VectorXd& ours, const Eigen::VectorXd& theirs,
                      bool loaded_tooth) {
  Difference out;
  out.largest = theirs.cwiseAbs().maxCoeff();
  const std::vector<double> z = levels();
  for (size_t i = 0; i < z.size(); ++i) {
    const auto at = static_cast<Index>(i);
    const bool near = loaded_tooth && std::any_of(load.jumps.begin(), load.jumps.end(), [&](double jump) {
                        return std::abs(z[i] - jump) < kModule;
                      });
    double& worst = near ? out.near_jump : out.elsewhere;
    worst = std::max(worst, std::abs(ours[at] - theirs[at]) / out.largest);
  }
  return out;
}

void body(int argc, char** argv) {
  Options options{"Bodies over the face width beside CalculiX", "whine-bench-width"};
  options.parse(argc, argv);
  if (!CalculixPair::installed()) {
    std::printf("(no CalculiX to compare with: make deps-bench)\n");
    return;
  }
  double worst = 0;
  for (const double beta : {0.0, 20.0}) {
    const Case gear(beta);
    for (const Load& load : kLoads) {
      const Reading ours = by_polynomials(gear, load);
      const Deck deck(gear, load);
      const Usage usage = deck.solve();
      const Reading theirs = deck.read();
      std::printf("  helix %4.1f deg, %-12s:", beta, load.name);
      for (size_t place = 0; place < kPlaces.size(); ++place) {
        const Difference off = difference(load, ours[place], theirs[place], place == 0);
        worst = std::max(worst, off.elsewhere);
        std::printf(" %.3f %% of %.4f um %s%s", 100 * off.elsewhere, 1e6 * off.largest, kPlaces[place],
                    place + 1 < kPlaces.size() ? "," : "");
        if (off.near_jump > 0) std::printf(" (%.3f %% near the ends of the load),", 100 * off.near_jump);
      }
      std::printf("; CalculiX: %zu nodes, CPU %.0f s\n", deck.nodes(), usage.seconds);
      std::fflush(stdout);
    }
  }
  if (worst > kLimit)
    fail(Failure::numerical, "displacements differ from CalculiX's by ", 100 * worst,
         " % of the largest, at most ", 100 * kLimit, " % is allowed");
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
