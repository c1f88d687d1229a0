// Slices over the face: what a step and a position of a system have in addition where the points of a contact line are contacts.
#include <algorithm>

#include "contact/lanes.h"
#include "dynamics/system_dynamics.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// What sections give way each by itself.
void SystemDynamics::put_uneven(const SystemPosition& at, Position& position) const {
  const int n = position.size();
  position.uneven = MatrixXd::Zero(n, n);
  position.width.resize(n);
  for (size_t m = 0; m < at.mesh.size(); ++m) {
    const FaceMesh& face = *position.face.emplace_back(at.mesh[m].face);
    position.uneven(at.strips_of(m), at.strips_of(m)) = face.uneven;
    position.width(at.strips_of(m)) = face.points.weight;
  }
  add_uneven_between(system_, at, position.uneven);
  position.uneven_reading = MatrixXd::Zero(padded(n), n);
  position.uneven_reading.topRows(n) = position.uneven * position.width.asDiagonal();
}

// Forces of teeth, from those of their slices.
void SystemDynamics::sum_teeth() {
  if (points_ == 1) return;
  for (Index tooth = 0; tooth < p_of_tooth_.size(); ++tooth)
    p_of_tooth_[tooth] = p_of_slot_.segment(tooth * points_, points_).sum();
}

// Gaps by the relaxed line loads, without those of the new forces.
void SystemDynamics::read_uneven(const Position& position) {
  const int n = position.size(), whole = padded(n);
  for (int k = 0; k < n; ++k) read_line_load_[k] = line_load_[position.contact[static_cast<size_t>(k)].slot];
  add_columns(e_.data(), position.uneven_reading.data(), whole, read_line_load_.data(), n, 0, whole);
}

// Line loads at the end of a step; those of lines that have gone are 0.
void SystemDynamics::load_uneven(const Position& position) {
  next_line_load_.setZero();
  present_line_load_.setZero();
  for (int k = 0; k < position.size(); ++k) {
    const int slot = position.contact[static_cast<size_t>(k)].slot;
    present_line_load_[slot] = p_[k] / position.width[k];
    next_line_load_[slot] = line_load_[slot] + relaxed_step_.from_new * present_line_load_[slot];
  }
  line_load_.swap(next_line_load_);
}

// In slices: the load of a pair of teeth is that of all its points.
void SystemDynamics::record_face(const Position& position, int sample, Period& period) const {
  int first = 0;
  for (int m = 0; m < meshes(); ++m) {
    FacePeak& peak = period.face[static_cast<size_t>(m)];
    const FaceContact& contact = *system_.face[static_cast<size_t>(m)];
    const FacePoints& points = position.face[static_cast<size_t>(m)]->points;
    double largest = 0;
    for (Index line = 0; line < static_cast<Index>(points.line.size()); ++line) {
      const auto own = Eigen::seqN(line * points_, points_);
      const auto force = p_.segment(first + line * points_, points_);
      const double load = force.sum();
      largest = std::max(largest, load);
      for (Index q = 0; q < points_; ++q)
        if (contact.inside(points.path[line * points_ + q], points.z[line * points_ + q]))
          peak.line_load = std::max(peak.line_load, force[q] / points.weight[line * points_ + q]);
      if (!(load > peak.tooth_load)) continue;
      peak.tooth_load = load;
      peak.load_factor =
          face_load_factor(points.z(own), points.weight(own), force.cwiseQuotient(points.weight(own)),
                           points.line[static_cast<size_t>(line)], contact.degree() > 0 ? kInnerFace : 1);
    }
    period.largest_tooth_force(m, sample) = largest;
    first += points.size();
  }
}

}  // namespace whine
