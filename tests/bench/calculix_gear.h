// A gear in three dimensions by CalculiX: the section of the whole gear in quadratic triangles (gear_mesh.h), extruded along axes that turn
// with the helix to wedges of fifteen nodes (C3D15), held at its bore. What is fine about one point of a flank, a patch, stays about the
// contact line through it: sections slide along the involute, all of whose parallels have the same normals.
#pragma once
#include <Eigen/CholmodSupport>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "base/error.h"
#include "bench/ccx.h"
#include "bench/gear_mesh.h"
#include "gear/helix.h"
#include "model/gear.h"

namespace whine {

class CalculixGear {
 public:
  // A point of a flank: [0: those that work, 1: the others][tooth], roll angle (rad), z (m).
  struct Point {
    std::size_t side, tooth;
    double roll, z;
  };
  using Weights = std::vector<std::pair<int, double>>;  // node of the deck, 1
  using Vectors = std::map<int, Eigen::Vector3d>;       // node of the deck; 1

  // border: m, ascending, of the layers of wedges; their middles are levels too. With a patch flanks of tooth 0 that work know points of it alone.
  CalculixGear(const GearDesign& design, const Material& material, const GearMeshPlan& plan,
               const std::vector<double>& border)
      : tooth_(design),
        material_(material),
        helix_(helix_twist(design)),
        turned_(plan.turned),
        patch_(plan.sides > 0 && helix_ != 0 ? plan.reach : 0),
        middle_(plan.middle),
        mesh_(GearMesher(tooth_, plan).mesh()) {
    level_.push_back(border[0]);
    for (std::size_t i = 1; i < border.size(); ++i) {
      level_.push_back(0.5 * (border[i - 1] + border[i]));
      level_.push_back(border[i]);
    }
    std::set<std::size_t> corners;
    for (const auto& element : mesh_.element) corners.insert(element.begin(), element.begin() + 3);
    for (const auto& [tag, at] : mesh_.node)
      for (std::size_t i = 0; i < level_.size(); ++i)
        if (i % 2 == 0 || corners.contains(tag)) {
          const Vec2 p = slid(at, level_[i]);
          place_.push_back(turned({p.x(), p.y(), level_[i]}, level_[i]));
          number_[{tag, i}] = static_cast<int>(place_.size());
        }
  }

  const ToothGeometry& tooth() const { return tooth_; }
  const GearMesh& mesh() const { return mesh_; }
  const std::vector<double>& level() const { return level_; }  // m
  std::size_t nodes() const { return place_.size(); }
  const Eigen::Vector3d& place(int node) const { return place_[static_cast<std::size_t>(node) - 1]; }  // m
  int number(std::size_t tag, std::size_t level) const { return number_.at({tag, level}); }

  // Of axes that turn with the helix, and of those of the section at z.
  Eigen::Vector3d turned(const Eigen::Vector3d& v, double z) const {
    return Eigen::AngleAxisd(helix_ * z, Eigen::Vector3d::UnitZ()) * v;
  }
  // Inward normal of the flank that works at a roll angle of a tooth, at z.
  Eigen::Vector3d inward(std::size_t tooth, double roll, double z) const {
    const Vec2 n = Eigen::Rotation2Dd(turned_ + 2 * std::numbers::pi * static_cast<double>(tooth) /
                                                    tooth_.design().teeth) *
                   tooth_.flank_normal(roll);
    return -turned({n.x(), n.y(), -helix_ * tooth_.base_radius()}, z).normalized();
  }

  // Adds the nodal forces of the force n at a point, or its reading of displacements.
  void add(Vectors& to, const Point& point, const Eigen::Vector3d& n) const {
    for (const auto& [node, weight] : at(point))
      to.try_emplace(node, Eigen::Vector3d::Zero()).first->second += weight * n;
  }
  // What the eight nodes of a side of a wedge say of a point on it; as a load, the nodal forces of a unit force.
  Weights at(const Point& point) const {
    const std::vector<FlankNode>& flank = mesh_.flank[point.side][point.tooth];
    const auto arc = [&](double roll) { return tooth_.arc_length(roll); };
    const double own =
        arc(point.roll) - (point.side == 0 && point.tooth == 0 && patch_ > 0 ? slide(point.z) : 0);
    std::size_t i = 0, k = 0;
    while (i + 4 < flank.size() && arc(flank[i + 2].roll) < own) i += 2;
    while (k + 4 < level_.size() && level_[k + 2] < point.z) k += 2;
    const double a = arc(flank[i].roll), m = arc(flank[i + 1].roll), b = arc(flank[i + 2].roll);
    double x = 0;
    for (int step = 0; step < 5; ++step)
      x -=
          (m + 0.5 * (b - a) * x + (0.5 * (a + b) - m) * x * x - own) / (0.5 * (b - a) + (a + b - 2 * m) * x);
    const double y = (point.z - level_[k + 1]) / (0.5 * (level_[k + 2] - level_[k]));
    Weights out;
    for (int p = -1; p <= 1; ++p)
      for (int q = -1; q <= 1; ++q) {
        if (p == 0 && q == 0) continue;
        const double weight = p == 0   ? 0.5 * (1 - x * x) * (1 + q * y)
                              : q == 0 ? 0.5 * (1 + p * x) * (1 - y * y)
                                       : 0.25 * (1 + p * x) * (1 + q * y) * (p * x + q * y - 1);
        out.emplace_back(
            number(flank[i + 1 + static_cast<std::size_t>(p)].tag, k + 1 + static_cast<std::size_t>(q)),
            weight);
      }
    return out;
  }

  // (i, j) of f_i^T K^-1 f_j, nodal vectors f of forces or readings (1) and K the stiffness that CalculiX stores: m N-1.
  Eigen::MatrixXd flexibility(const std::vector<Vectors>& functional) {
    return responses(functional, functional);
  }
  // (reading, force) of r_i^T K^-1 f_j. K is factored here, once, where ccx would do so for each load. Throws Error(numerical) if the files are
  // not those of this gear.
  Eigen::MatrixXd responses(const std::vector<Vectors>& force, const std::vector<Vectors>& reading) {
    const CalculixFolder folder;
    std::ofstream out(folder.file("gear.inp"));
    write_model(out);
    out << "*STEP\n*FREQUENCY, SOLVER=MATRIXSTORAGE\n1\n*END STEP\n";
    if (!out) fail(Failure::io, folder.file("gear.inp"), " could not be written");
    out.close();
    usage_ = folder.run("gear");
    std::map<std::pair<int, int>, Eigen::Index> unknown;  // node, direction
    std::ifstream in(folder.file("gear.dof"));
    int node = 0, direction = 0;
    for (char point = 0; in >> node >> point >> direction;)
      unknown.try_emplace({node, direction}, unknown.size());
    const auto size = static_cast<Eigen::Index>(unknown.size());
    std::vector<Eigen::Triplet<double>> entries;  // upper triangle, N mm-1
    std::ifstream stored(folder.file("gear.sti"));
    for (std::string line; std::getline(stored, line);) {
      char* at = line.data();
      const long row = std::strtol(at, &at, 10) - 1, column = std::strtol(at, &at, 10) - 1;
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), std::strtod(at, nullptr));
    }
    Eigen::SparseMatrix<double> stiffness(size, size);
    stiffness.setFromTriplets(entries.begin(), entries.end());
    const auto each = [&](const std::vector<Vectors>& of, const auto& take) {
      for (std::size_t k = 0; k < of.size(); ++k)
        for (const auto& [at, value] : of[k])
          for (int c = 0; c < 3; ++c)
            if (value[c] != 0) take(static_cast<Eigen::Index>(k), unknown.at({at, c + 1}), value[c]);
    };
    Eigen::MatrixXd moved = Eigen::MatrixXd::Zero(size, static_cast<Eigen::Index>(force.size()));
    each(force, [&](Eigen::Index k, Eigen::Index row, double value) { moved(row, k) = value; });
    Eigen::CholmodSupernodalLLT<Eigen::SparseMatrix<double>, Eigen::Upper> factor(stiffness);
    if (factor.info() != Eigen::Success)
      fail(Failure::numerical, "the stiffness in ", folder.file("gear.sti"), " is not positive definite");
    moved = factor.solve(moved).eval();
    Eigen::MatrixXd read = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(reading.size()), moved.cols());
    each(reading, [&](Eigen::Index k, Eigen::Index row, double value) {
      read.row(k) += 1e-3 * value * moved.row(row);
    });
    return read;
  }
  double seconds() const { return usage_.seconds; }  // CPU of ccx

 private:
  // m of arc: how far the contact line has gone along the flank at z.
  double slide(double z) const {
    return tooth_.arc_length(middle_ + helix_ * z) - tooth_.arc_length(middle_);
  }
  // A point of the section in that at z: the patch and what is near it go with the contact line, the less the deeper and the nearer to the ends
  // of the flank. A point lies at the depth d below the flank on the normal of a roll angle xi, which meets the base circle at r_b xi - d.
  Vec2 slid(const Vec2& at, double z) const {
    const double base = tooth_.base_radius(),
                 tangent = std::sqrt(std::max(0.0, at.squaredNorm() - base * base));
    if (patch_ == 0 || tangent == 0) return at;
    const Vec2 p = Eigen::Rotation2Dd(-turned_) * at, n = tooth_.flank_normal(middle_),
               pitch = tooth_.flank_point(middle_), later = tooth_.flank_normal(middle_ + 0.1);
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    const double sense = cross(n, later) > 0 ? 1 : -1, side = std::copysign(base, cross(n, pitch));
    const Vec2 own = Eigen::Rotation2Dd(-std::atan2(side, tangent)) * p;
    const double roll = middle_ + sense * std::atan2(cross(n, own), n.dot(own)),
                 depth = base * roll - tangent, first = tooth_.form_roll_angle(),
                 last = tooth_.tip_roll_angle(), room = 0.45 * tooth_.design().module, even = 1.5 * patch_;
    if (roll <= first || roll >= last || depth < -1e-9 || depth >= room + even) return at;
    const double arc = tooth_.arc_length(roll), from = arc - tooth_.arc_length(middle_),
                 free = std::abs(tooth_.arc_length(from > 0 ? last : first) - tooth_.arc_length(middle_)),
                 share = std::min(1.0, (free - std::abs(from)) / (free - even)) *
                         std::min(1.0, (room + even - depth) / room),
                 now = std::sqrt(2 * (arc + share * slide(z)) / base);
    return Eigen::Rotation2Dd(turned_) * Vec2(tooth_.flank_point(now) - depth * tooth_.flank_normal(now));
  }
  void write_model(std::ofstream& out) const {
    out.precision(12);
    out << "*NODE, NSET=ALL\n";
    for (std::size_t i = 0; i < place_.size(); ++i)
      out << i + 1 << ", " << 1e3 * place_[i].x() << ", " << 1e3 * place_[i].y() << ", "
          << 1e3 * place_[i].z() << "\n";
    out << "*ELEMENT, TYPE=C3D15, ELSET=GEAR\n";
    int wedge = 0;
    for (const auto& e : mesh_.element)
      for (std::size_t k = 0; k + 2 < level_.size(); k += 2) {
        out << ++wedge;
        for (const std::size_t up : {std::size_t{0}, std::size_t{2}})
          for (std::size_t n = 0; n < 3; ++n) out << ", " << number(e[n], k + up);
        for (const std::size_t up : {std::size_t{0}, std::size_t{2}})
          for (std::size_t n = 3; n < 6; ++n) out << ", " << number(e[n], k + up);
        out << ",\n"
            << number(e[0], k + 1) << ", " << number(e[1], k + 1) << ", " << number(e[2], k + 1) << "\n";
      }
    out << "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
        << material_.youngs_modulus * 1e-6 << ", " << material_.poisson_ratio << "\n*DENSITY\n1e-9"
        << "\n*SOLID SECTION, ELSET=GEAR, MATERIAL=STEEL\n*NSET, NSET=BORE\n";
    for (const std::size_t tag : mesh_.bore)
      for (std::size_t i = 0; i < level_.size(); ++i)
        if (const auto found = number_.find({tag, i}); found != number_.end()) out << found->second << ",\n";
    out << "*BOUNDARY\nBORE, 1, 3\n";
  }

  ToothGeometry tooth_;
  Material material_;
  double helix_, turned_, patch_,
      middle_;  // rad m-1; rad; m of arc to either side of the roll angle (rad), 0: none slides
  GearMesh mesh_;
  std::vector<double> level_;
  std::map<std::pair<std::size_t, std::size_t>, int> number_;  // node of the section, level
  std::vector<Eigen::Vector3d> place_;                         // m
  Usage usage_;
};

}  // namespace whine
