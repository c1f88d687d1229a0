#include "io/vtk.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>

#include "base/error.h"
#include "io/publish.h"

namespace whine {
namespace {

// To a multiple of 2^exponent, so that deflate finds zeros behind.
double to_multiple(double x, int exponent) {
  return std::ldexp(std::round(std::ldexp(x, -exponent)), exponent);
}

constexpr int kEightNanometres = -27, kFourMicrometres = -18;

// To 12 bits behind the leading one, 1.2e-4.
float to_three_digits(double x) {
  int exponent = 0;
  const double share = std::frexp(x, &exponent);
  return static_cast<float>(std::ldexp(std::round(std::ldexp(share, 13)), exponent - 13));
}

constexpr std::uint8_t kLine = 3, kQuad = 9, kBiquadraticQuad = 28;  // VTK cell types

}  // namespace

namespace {

Eigen::Vector2d turned(const MatrixRM& position, Eigen::Index node, int copy, int teeth) {
  const double angle = 2.0 * std::numbers::pi * copy / teeth, c = std::cos(angle), s = std::sin(angle);
  const double x = position(node, 0), y = position(node, 1);
  return {c * x - s * y, s * x + c * y};
}

// Nodes of the copies of a sector: one on the clockwise edge of copy j is its image on the counter-clockwise edge of copy j - 1.
class CopiedNodes {
 public:
  explicit CopiedNodes(const SectorGrid& sector)
      : teeth_(sector.design.teeth),
        image_(static_cast<std::size_t>(sector.node_position.rows()), -1),
        own_(image_.size(), -1) {
    for (Eigen::Index k = 0; k < sector.side_node.rows(); ++k)
      image_.at(static_cast<std::size_t>(sector.side_node(k, 0))) = sector.side_node(k, 1);
    for (std::size_t i = 0; i < image_.size(); ++i)
      if (image_[i] < 0) own_[i] = per_copy_++;
  }

  Eigen::Index count() const { return per_copy_ * teeth_; }
  bool is_own(Eigen::Index node) const { return own_[static_cast<std::size_t>(node)] >= 0; }
  Eigen::Index number(int copy, Eigen::Index node) const {
    if (const Eigen::Index partner = image_[static_cast<std::size_t>(node)]; partner >= 0) {
      copy = (copy + teeth_ - 1) % teeth_;
      node = partner;
    }
    if (!is_own(node)) fail(Failure::numerical, "sector node ", node, " lies on both edges of the sector");
    return copy * per_copy_ + own_[static_cast<std::size_t>(node)];
  }

 private:
  int teeth_;
  std::vector<Eigen::Index> image_, own_;
  Eigen::Index per_copy_ = 0;
};

void require_closed(const SectorGrid& sector) {
  const int teeth = sector.design.teeth;
  for (Eigen::Index k = 0; k < sector.side_node.rows(); ++k) {
    const Eigen::Vector2d low = turned(sector.node_position, sector.side_node(k, 0), 1, teeth),
                          high = turned(sector.node_position, sector.side_node(k, 1), 0, teeth);
    if ((low - high).norm() > 1e-9 * high.norm())
      fail(Failure::numerical, "the sector does not close: nodes ", sector.side_node(k, 0), " and ",
           sector.side_node(k, 1), " are ", (low - high).norm(), " m apart after a turn of one tooth");
  }
}

// The cells of a cracked tooth in the place of the intact one's. Its nodes on the sector edges are those of its neighbours, all
// others are added.
void replace_tooth(const SectorGrid& sector, const SectorGrid& cracked, const CopiedNodes& nodes,
                   VtkGrid& out, Eigen::VectorXi& region, Eigen::VectorXi& tooth) {
  const int teeth = sector.design.teeth, copy = sector.design.crack.tooth;
  const Eigen::Index elements = sector.element_node.rows();
  std::vector<Eigen::Index> shown(static_cast<std::size_t>(cracked.node_position.rows()), -1);
  for (Eigen::Index k = 0; k < sector.side_node.size(); ++k)
    shown.at(static_cast<std::size_t>(cracked.side_node.data()[k])) =
        nodes.number(copy, sector.side_node.data()[k]);
  const Eigen::Index before = out.point.rows(), kept = elements * (teeth - 1),
                     all = kept + cracked.element_node.rows();
  Eigen::Index count = before;
  for (Eigen::Index& at : shown)
    if (at < 0) at = count++;
  out.point.conservativeResize(count, 2);
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i] >= before)
      out.point.row(shown[i]) =
          turned(cracked.node_position, static_cast<Eigen::Index>(i), copy, teeth).transpose();
  MatrixRMi cell(all, out.cell.cols());
  Eigen::VectorXi own_region(all), own_tooth(all);
  const Eigen::Index first = copy * elements, rest = kept - first;
  cell << out.cell.topRows(first), out.cell.bottomRows(rest), cracked.element_node.unaryExpr([&shown](int i) {
    return static_cast<int>(shown[static_cast<std::size_t>(i)]);
  });
  own_region << region.head(first), region.tail(rest), cracked.element_region;
  own_tooth << tooth.head(first), tooth.tail(rest),
      Eigen::VectorXi::Constant(cracked.element_node.rows(), copy);
  out.cell = cell;
  region = own_region;
  tooth = own_tooth;
}

}  // namespace

VtkGrid whole_gear(const SectorGrid& sector) {
  const int teeth = sector.design.teeth;
  const Eigen::Index elements = sector.element_node.rows();
  if (teeth < 1 || sector.node_position.rows() == 0)
    fail(Failure::numerical, "a sector without nodes or teeth cannot be a gear");
  const CopiedNodes nodes(sector);
  require_closed(sector);
  VtkGrid out;
  out.point.resize(nodes.count(), 2);
  out.cell.resize(elements * teeth, sector.element_node.cols());
  Eigen::VectorXi region(elements * teeth), tooth(elements * teeth);
  for (int copy = 0; copy < teeth; ++copy) {
    for (Eigen::Index i = 0; i < sector.node_position.rows(); ++i)
      if (nodes.is_own(i))
        out.point.row(nodes.number(copy, i)) = turned(sector.node_position, i, copy, teeth).transpose();
    for (Eigen::Index e = 0; e < elements; ++e) {
      for (Eigen::Index k = 0; k < sector.element_node.cols(); ++k)
        out.cell(copy * elements + e, k) = static_cast<int>(nodes.number(copy, sector.element_node(e, k)));
      region[copy * elements + e] = e < sector.element_region.size() ? sector.element_region[e] : 0;
      tooth[copy * elements + e] = copy;
    }
  }
  for (const SectorGrid& cracked : sector.cracked_tooth)
    replace_tooth(sector, cracked, nodes, out, region, tooth);
  out.cell_numbers = {{"region", region}, {"tooth", tooth}};
  return out;
}

namespace {

const std::string kGroup = "/VTKHDF/";

// Which points belong to whole cells of nine nodes or to lines: the others are far from load.
std::vector<bool> near_load(const VtkGrid& grid) {
  std::vector<bool> out(static_cast<std::size_t>(grid.point.rows()));
  const auto add = [&](const auto& points) {
    for (const int point : points)
      if (point >= 0) out.at(static_cast<std::size_t>(point)) = true;
  };
  for (Eigen::Index e = 0; e < grid.cell.rows(); ++e)
    if (grid.cell.cols() == 4 || grid.cell(e, 4) >= 0) add(grid.cell.row(e));
  for (Eigen::Index e = 0; e < grid.line.rows(); ++e) add(grid.line.row(e));
  return out;
}

// (point, 2) m. near: empty, or as near_load() has it, and places are rounded.
MatrixRM shown_places(MatrixRM point, const std::vector<bool>& near) {
  for (std::size_t i = 0; i < near.size(); ++i)
    for (double& x : point.row(static_cast<Eigen::Index>(i)))
      x = to_multiple(x, near[i] ? kEightNanometres : kFourMicrometres);
  return point;
}

// What is smaller than this step is left out of values far from load: 1/128 to 1/64 of the largest of them, a power of two.
int far_exponent(const MatrixRM& values, const std::vector<bool>& near) {
  double most = 0;
  for (std::size_t i = 0; i < near.size(); ++i)
    if (!near[i]) most = std::max(most, values.row(static_cast<Eigen::Index>(i)).cwiseAbs().maxCoeff());
  int exponent = 0;
  std::frexp(most, &exponent);
  return exponent - 7;
}

// Values of points or cells, which `of` names ("PointData"), as many rows as there are of them. `near` is empty, or says of each
// point whether it keeps three digits.
void put_fields(h5::Writer& file, const std::vector<LoadedResult::Field>& fields, const std::string& of,
                const std::string& axis, std::size_t rows, bool rounded, const std::vector<bool>& near) {
  for (const auto& [name, units, values] : fields) {
    const auto columns = static_cast<std::size_t>(values.cols());
    if (values.rows() != static_cast<Eigen::Index>(rows) || columns < 1 || columns > 3) {
      fail(Failure::numerical, of, " '", name, "' is ", values.rows(), " x ", values.cols(), ", expected ",
           rows, " x 1, 2 or 3");
    }
    const std::size_t width = columns == 2 ? 3 : columns;
    const int step = far_exponent(values, near);
    std::vector<float> data(rows * width, 0.0F);
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t k = 0; k < columns; ++k) {
        double value = values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
        if (!near.empty() && !near[i]) value = to_multiple(value, step);
        data[i * width + k] = rounded ? to_three_digits(value) : static_cast<float>(value);
      }
    const h5::Shape shape = width == 1 ? h5::Shape{rows} : h5::Shape{rows, width};
    const char* digits = !rounded ? ", for looking: single precision"
                         : near.empty()
                             ? ", for looking: three digits"
                             : ", for looking: three digits; far from load two of the largest there";
    file.put(kGroup + of + "/" + name, data.data(), shape,
             {units, name + digits, axis + (width == 1 ? "" : " component"), ""});
  }
}

}  // namespace

void put_vtk(h5::Writer& file, const VtkGrid& grid) {
  const auto points = static_cast<std::size_t>(grid.point.rows());
  const auto lines = static_cast<std::size_t>(grid.line.rows());
  const auto cells = static_cast<std::size_t>(grid.cell.rows()) + lines;
  const auto corners = static_cast<std::size_t>(grid.cell.cols());
  if (corners != 4 && corners != 9) {
    fail(Failure::numerical, "cells of ", corners, " nodes cannot be shown; 4 or 9 are known");
  }
  file.group("/VTKHDF");
  file.attribute("/VTKHDF", "Version", std::vector<std::int64_t>{1, 0});
  file.ascii_attribute("/VTKHDF", "Type", "UnstructuredGrid");

  const auto count = [&](const std::string& name, std::size_t value, const std::string& meaning) {
    const auto number = static_cast<std::int64_t>(value);
    file.put(kGroup + name, &number, {1}, {"1", meaning, "partition", ""});
  };
  count("NumberOfPoints", points, "number of points");
  count("NumberOfCells", cells, "number of cells");
  const auto corners_of = [&](Eigen::Index e) {
    return corners == 9 && grid.cell(e, 4) < 0 ? std::size_t{4} : corners;
  };
  std::size_t ids = 2 * lines;
  for (Eigen::Index e = 0; e < grid.cell.rows(); ++e) ids += corners_of(e);
  count("NumberOfConnectivityIds", ids, "length of Connectivity");

  const auto in_space = [&](const MatrixRM& plane, auto zero) {
    std::vector<decltype(zero)> out(points * 3, zero);
    for (std::size_t i = 0; i < points; ++i) {
      for (std::size_t k = 0; k < 2; ++k) {
        out[3 * i + k] =
            static_cast<decltype(zero)>(plane(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)));
      }
    }
    return out;
  };
  const std::vector<bool> near = grid.rounded ? near_load(grid) : std::vector<bool>();
  const MatrixRM place = shown_places(grid.point, near);
  file.put(kGroup + "Points", in_space(place, 0.0).data(), {points, 3},
           {"m", "position of the points", "point xyz", ""});

  std::vector<std::int64_t> connectivity, offsets;
  for (const MatrixRMi* kind : {&grid.cell, &grid.line}) {
    for (Eigen::Index e = 0; e < kind->rows(); ++e) {
      offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
      const auto own = kind == &grid.cell ? static_cast<Eigen::Index>(corners_of(e)) : kind->cols();
      for (Eigen::Index k = 0; k < own; ++k) {
        const int node = (*kind)(e, k);
        if (node < 0 || node >= grid.point.rows()) {
          fail(Failure::numerical, "cell ", e, " names point ", node, " of ", points);
        }
        connectivity.push_back(node);
      }
    }
  }
  offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  std::vector<std::uint8_t> types(cells, corners == 4 ? kQuad : kBiquadraticQuad);
  for (Eigen::Index e = 0; e < grid.cell.rows(); ++e)
    if (corners_of(e) == 4) types[static_cast<std::size_t>(e)] = kQuad;
  std::fill(types.end() - static_cast<std::ptrdiff_t>(lines), types.end(), kLine);
  file.put(kGroup + "Connectivity", connectivity.data(), {connectivity.size()},
           {"1", "points of each cell", "connectivity", ""});
  file.put(kGroup + "Offsets", offsets.data(), {offsets.size()},
           {"1", "where each cell begins in Connectivity", "cell", ""});
  file.put(kGroup + "Types", types.data(), {types.size()}, {"1", "VTK cell type: 3, 9 or 28", "cell", ""});

  for (const auto& [name, values] : grid.vectors) {
    if (values.rows() != grid.point.rows() || values.cols() != 2) {
      fail(Failure::numerical, "point data '", name, "' is ", values.rows(), " x ", values.cols(),
           ", expected ", points, " x 2");
    }
    file.put(kGroup + "PointData/" + name, in_space(values, 0.0F).data(), {points, 3},
             {"1", name + ", for looking: single precision", "point xyz", ""});
  }
  for (const auto& [name, values] : grid.cell_numbers) {
    file.put(kGroup + "CellData/" + name, values.data(), {cells}, {"1", name + " of the cell", "cell", ""});
  }
  put_fields(file, grid.point_data, "PointData", "point", points, grid.rounded, near);
  put_fields(file, grid.cell_data, "CellData", "cell", cells, grid.rounded, {});
}

void link_for_paraview(const std::string& path) {
  const std::filesystem::path file(path);
  if (file.extension() != ".h5") return;
  std::filesystem::path link(file);
  publish_link(link.replace_extension(".hdf").string(), file.filename().string());
}

}  // namespace whine
