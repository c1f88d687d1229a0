// Natural frequencies and mode shapes of a system at rest, with what a reader needs to draw them.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "model/system.h"
#include "results/loaded.h"

namespace whine {

// Of a planetary train, by how its central members (all but planets) move. mixed: without that structure. train: without
// planets, or with those of several carriers.
enum class ModeType { rotational, translational, planet, mixed, train };
template <>
inline constexpr const char* kWordsOf<ModeType> = "rotational translational planet mixed train";

struct ModesResult {
  Eigen::VectorXd natural_frequency;  // (mode) Hz, ascending
  std::vector<ModeType> type;         // (mode)
  // (mode) by how many turns the phase of the motion grows from planet to planet about the carrier, 0 to N/2; -1: the planets are
  // not alike or not equally spaced
  Eigen::VectorXi planet_harmonic;
  // [mode] (body; u, x, y) kg^-1/2: u = r theta in the body's own sense; unit modal mass, sum m (x^2 + y^2) + I / r^2 u^2 = 1
  std::vector<MatrixRM> shape;
  MatrixRM
      mesh_deflection;  // (mode, mesh) kg^-1/2: of the springs along the lines of action, positive where they close
  // (mode, mesh) 1: share of the potential energy; 0 of a mode without any, and below 0 where other meshes push through a common
  // body
  MatrixRM mesh_energy;
  MatrixRM bearing_energy;     // (mode, body) 1: the same of bearings, and of what holds a rotation
  MatrixRM kinetic_energy;     // (mode, body) 1: share of the kinetic energy
  double rigid_frequency = 0;  // Hz: motions slower than this count as free, with the frequency 0
  // Of elastic gears: natural frequencies with the contact of each phase, ascending; of rigid ones none.
  Eigen::VectorXd mesh_phase;  // (phase) 1
  MatrixRM frozen_frequency;   // (phase, mode) Hz

  // Where the frame turns with its carrier, else none: natural frequencies over speed, ascending.
  double frame_turns = 0;                  // 1: revolutions in a mesh period, counter-clockwise positive
  Eigen::VectorXd turning_mesh_frequency;  // (mesh_frequency) Hz
  MatrixRM turning_frequency;              // (mesh_frequency, mode) Hz

  System layout;

  // for looking; written, never read: gears as quadrilaterals between their teeth and the circle on which they are held, carriers as
  // lines to their pins, displacements of each mode
  struct View {
    MatrixRM point;                                          // (point, 2) m
    MatrixRMi cell, line;                                    // (cell, 4), (line, 2)
    std::vector<LoadedResult::Field> point_data, cell_data;  // (point, 2) m; (cell and line, 1)
  } view;
};

}  // namespace whine
