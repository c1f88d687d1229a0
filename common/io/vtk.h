// The group /VTKHDF (version 1.0, unstructured grid) by which ParaView opens an artifact as it is.
//
// Private to the layer io/.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "io/h5.h"
#include "results/loaded.h"
#include "results/sector_grid.h"

namespace whine {

struct VtkGrid {
  MatrixRM point;  // (point, 2) m
  MatrixRMi
      cell;  // (cell, 4 or 9): corners, mid-sides, centre; a row of 9 with -1 from the fifth on: corners alone
  std::vector<std::pair<std::string, MatrixRM>> vectors;              // name, (point, 2)
  std::vector<std::pair<std::string, Eigen::VectorXi>> cell_numbers;  // name, (cell)
  MatrixRMi line;                                                     // (line, 2) cells after those
  // Of 1, 2 or 3 columns; two are a vector in the plane.
  std::vector<LoadedResult::Field> point_data;  // (point, k)
  std::vector<LoadedResult::Field> cell_data;   // (cell and line, k)
  // Places to 8 nm and values to three digits; points of four-node cells alone, far from load, to 4 um and to 1/64 or less of the
  // largest value among them: a fifth of the file.
  bool rounded = false;
};

// The whole gear from one sector: copies turned counter-clockwise by 2 pi / teeth, edge nodes merged with
// their images. Error(numerical) if an edge node and its turned image are further apart than 1e-9 of the
// radius.
VtkGrid whole_gear(const SectorGrid& sector);

void put_vtk(h5::Writer& file, const VtkGrid& grid);

// Beside out/x/mesh.h5 the link mesh.hdf -> mesh.h5, because ParaView's file dialog offers VTKHDF under .hdf
// only.
void link_for_paraview(const std::string& path);

}  // namespace whine
