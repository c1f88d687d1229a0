// Both gears at rest in one mesh position, loaded and deformed.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"

namespace whine {

// loaded_<phase>.h5: both gears at rest in one mesh position, loaded and deformed, with the pressure of their contact. Gears
// are in their places: the driver's centre at the origin, the driven gear's above it. Strips are numbered pair after pair;
// teeth count counter-clockwise on both gears.
struct LoadedResult : GearPairParameters {
  double torque = 0;              // N m on the driver
  double mesh_phase = 0;          // 1, whole part: the mesh period, for teeth that differ
  double transmission_error = 0;  // m
  Eigen::VectorXi pair;           // (pair) those that carry load
  Eigen::VectorXd tooth_load;     // (pair) N
  MatrixRMi tooth;                // (pair, gear)
  MatrixRM
      root_stress;  // (pair, gear) Pa: largest principal stress at the nodes of the fillet below the loaded flank
  Eigen::VectorXi strip_pair;  // (strip)
  MatrixRM strip_roll;         // (strip, gear) rad, of the strip's middle
  Eigen::VectorXd strip_width, strip_force, strip_pressure, strip_separation;  // (strip) m, N, Pa, m
  MatrixRM strip_deflection;  // (strip, gear) m: inward, mean over the strip, by the whole field
  // (gear) N m: what holds the hub, by the elements about the bore, and the moment of the forces along the flanks' normals
  Eigen::Vector2d hub_torque = Eigen::Vector2d::Zero(), contact_torque = Eigen::Vector2d::Zero();
  // (gear) J: by quadrature of the stresses, and half of what forces times deflections are
  Eigen::Vector2d strain_energy = Eigen::Vector2d::Zero(), contact_work = Eigen::Vector2d::Zero();
  // for looking; written, never read. Cells: elements of the driver, of the driven gear, then two-node lines, the strips of
  // the driver's flanks and those of the driven gear's.
  MatrixRM vtk_point;            // (point, 2) m
  MatrixRMi vtk_cell, vtk_line;  // (cell, 4 or 9), (line, 2)
  struct Field {
    std::string name, units;
    MatrixRM values;  // (point, or cell and line; 1, 2 or 3)
  };
  std::vector<Field> vtk_point_data, vtk_cell_data;
};

}  // namespace whine
