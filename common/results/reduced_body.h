// A gear body reduced to what the contact of a rolling gear needs of it.
#pragma once
#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "base/matrix.h"
#include "model/stages.h"
#include "results/width_tables.h"

namespace whine {

// body.h5: all that the contact of a rolling gear needs of its solid. Per real mode (doublets: two columns,
// cosine then sine: on tooth j, counted counter-clockwise, the shape is Re and Im of exp(i n 2 pi j / teeth)
// phi).
struct ReducedBody : BodyParameters {
  double inertia = 0;                // kg m2 of the meshed body about its axis (hub ring included)
  double mass = 0;                   // kg of the meshed body (hub ring included)
  Eigen::VectorXd eigenfrequency;    // (mode) Hz, hub fixed
  Eigen::VectorXi nodal_diameter;    // (mode)
  Eigen::VectorXi component;         // (mode) 0: cosine or single, 1: sine
  Eigen::VectorXd inertia_coupling;  // (mode) kg^1/2 m: gamma = phi^T M_fr, not zero for zero diameters only
  // (mode, 2) kg^1/2: phi^T M_fr of the hub's translations along x and y of the mesh, tooth 0 along +y; not zero for one
  // diameter only. With the column above it is the (mode, 3) coupling G to the rigid motions of the hub.
  MatrixRM translation_coupling;
  Eigen::VectorXd flank_position;  // (flank) rad: roll angle of the table points, ascending
  MatrixRM flank_mode;  // (flank, mode) kg^-1/2: outward normal displacement, M-normal modes, tooth 0
  int offsets = 0;      // tables hold tooth offsets 0 .. offsets
  // [offset] (flank, flank) m N-1: inward normal displacement of tooth `offset` (counter-clockwise of the
  // loaded one) per unit total normal force on tooth 0; offset 0: less the half-plane relative to
  // reference_depth
  std::vector<MatrixRM> compliance;
  double reference_depth = 0;  // m
  // The same between teeth that are farther apart, and between the two flanks of teeth: what joins the meshes of one gear with
  // several others. Pairs of one mesh take nothing of it.
  // (offset flank, flank) m N-1: as compliance, offsets + 1 .. teeth / 2, one below the other
  MatrixRM far_compliance;
  // (tooth flank, flank) m N-1: of the other flank of tooth 0 .. teeth - 1; no half-plane is taken off
  MatrixRM back_compliance;
  MatrixRM back_flank_mode;  // (flank, mode) kg^-1/2: as flank_mode, on the other flank
  // (tooth flank, tooth flank) m N-1, or empty: what the crack adds to the compliance between the teeth from `offsets`
  // clockwise of the cracked one to `offsets` counter-clockwise of it, tooth by tooth
  MatrixRM crack_compliance;
  // Stress along the roots of teeth; see solid/root_stress.h. Both roots of a tooth in one column: the points of the driving
  // flank's side from the flank on, then those of the other side.
  Eigen::VectorXd root_arc_length;  // (root) m: from the flank along the root curve
  Eigen::VectorXd root_angle;       // (root) rad: of the tangent against the centre line of the tooth
  // [offset + offsets] (2 root, flank) Pa N-1: tangential stress, tension positive, of the tooth `offset` counter-clockwise of
  // the loaded one, -offsets .. offsets, per unit total normal force
  std::vector<MatrixRM> root_stress;
  // (tooth root, tooth flank) Pa N-1, or empty: what the crack adds to it along the driving flank's root, between the teeth of
  // crack_compliance
  MatrixRM crack_root_stress;
  WidthTables width;            // empty unless discretisation.width acts
  double asymmetry = 0;         // relative, before symmetrisation
  double least_eigenvalue = 0;  // m N-1 of the compliance of all offsets less the stored modes
  // for looking: the whole gear with mode shapes and the displacement under a unit force at mid flank; written, never
  // read: no stage needs them, and they are most of the file
  MatrixRM vtk_point;                                            // (point, 2) m
  MatrixRMi vtk_cell;                                            // (cell, 4 or 9), node order as element_node
  std::vector<std::pair<std::string, MatrixRM>> vtk_point_data;  // name, (point, 2)
};

}  // namespace whine
