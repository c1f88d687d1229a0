#include "solid/tooth_bending.h"

#include "contact/half_plane.h"
#include "gear/face_width.h"
#include "solid/flank_table.h"
#include "solid/loaded_gear.h"
#include "solid/reduce.h"

namespace whine {
namespace {

constexpr double kForceWidth = 0.1;  // of a module

class BendingTeeth {
 public:
  BendingTeeth(const SectorGrid& mesh, const Material& material, double contact_width,
               const std::vector<int>& nodes)
      : tooth_(mesh.design),
        moduli_(plane_strain_equivalent(material)),
        concentration_(mesh.design.face_width / carrying_width(mesh.design, contact_width)),
        table_(tooth_, mesh.discretisation.flank_points) {
    const FlankLoads unit = make_flank_loads(mesh, material, table_.points());
    for (const int node : nodes) {
      position_.emplace_back(mesh.node_position.row(node));
      holds_rest_.push_back(unit.holds_rest[static_cast<size_t>(node)]);
    }
    for (const Eigen::MatrixXd& x : teeth_under(mesh, material, unit.force)) {
      Eigen::MatrixXd& own = under_.emplace_back(2 * static_cast<Eigen::Index>(nodes.size()), x.cols());
      for (size_t i = 0; i < nodes.size(); ++i)
        own.middleRows(2 * static_cast<Eigen::Index>(i), 2) = x.middleRows(2 * nodes[i], 2);
    }
  }

  Eigen::VectorXd operator()(int j, const std::vector<FlankForce>& forces) const {
    const GearDesign& design = tooth_.design();
    Eigen::VectorXd u = Eigen::VectorXd::Zero(2 * static_cast<Eigen::Index>(position_.size()));
    for (const FlankForce& at : forces) {
      const int offset = ((j - at.tooth) % design.teeth + design.teeth) % design.teeth;
      u += concentration_ * at.force *
           (under_[static_cast<size_t>(offset)] * table_.weights(at.roll).transpose());
      if (offset != 0) continue;
      const StripLoadField near(tooth_.flank_point(at.roll), tooth_.flank_normal(at.roll),
                                kForceWidth * design.module, moduli_, design.face_width, kReferenceDepth);
      for (size_t i = 0; i < position_.size(); ++i)
        if (holds_rest_[i])
          u.segment<2>(2 * static_cast<Eigen::Index>(i)) +=
              concentration_ * at.force * near.displacement(position_[i]);
    }
    return u;
  }

 private:
  ToothGeometry tooth_;
  PlaneModuli moduli_;
  double concentration_;  // 1: of the load on the part of the width that carries it
  FlankTable table_;
  std::vector<Vec2> position_;  // m: of the nodes
  std::vector<char> holds_rest_;
  std::vector<Eigen::MatrixXd> under_;  // [offset] (2 node, table point) m N-1
};

}  // namespace

ToothBending tooth_bending(const SectorGrid& mesh, const Material& material, double contact_width,
                           const std::vector<int>& nodes) {
  return BendingTeeth(mesh, material, contact_width, nodes);
}

}  // namespace whine
