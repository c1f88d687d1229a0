#include "io/artifacts.h"

#include "io/artifact_file.h"

namespace whine {
namespace {

using namespace ranges;

// The two sectors of a mesh share no axes: names of the second one's are its own.
void describe_sector(Codec& file, const std::string& group, SectorGrid& a) {
  Codec c = file;  // axes of its own
  c(a.node_position, group + "/node_position", "m", kPlace, "node xy",
    "position of the nodes; gear centre at 0, tooth along +y");
  c(a.element_node, group + "/element_node", "1", kNumber, "element corner",
    "nodes of the elements: corners counter-clockwise, mid-sides, centre");
  c(a.element_region, group + "/element_region", "1", kFlag, "element",
    "0: rim, 1: tooth, where the half-plane field is subtracted");
  c(a.bore_node, group + "/bore_node", "1", kNumber, "bore_node", "nodes on the rigid hub");
  c(a.side_node, group + "/side_node", "1", kNumber, "side_pair edge",
    "node on the clockwise edge and its image on the counter-clockwise edge");
  c(a.flank_node, group + "/flank_node", "1", kNumber, "flank_node",
    "nodes of the driving flank, root to tip");
  c(a.flank_roll_angle, group + "/flank_roll_angle", "rad", kRoll, "flank_node",
    "involute roll angle of the flank nodes");
  const Eigen::Index nodes = a.node_position.rows();
  require_indices(c, group + "/element_node", a.element_node, nodes);
  require_indices(c, group + "/bore_node", a.bore_node.transpose(), nodes);
  require_indices(c, group + "/side_node", a.side_node, nodes);
  require_indices(c, group + "/flank_node", a.flank_node.transpose(), nodes);
}

}  // namespace

void describe(Codec& c, SectorGrid& a) {
  describe_design(c, "gear", a.design);
  c.parameters("discretisation", keys(a.discretisation).plain());
  describe_sector(c, "/sector", a);
  if (c.optional("/cracked_tooth/slit_node", !a.cracked_tooth.empty())) {
    if (a.cracked_tooth.empty()) a.cracked_tooth.emplace_back();
    SectorGrid& cracked = a.cracked_tooth.front();
    describe_sector(c, "/cracked_tooth", cracked);
    c(cracked.slit_node, "/cracked_tooth/slit_node", "1", kNumber, "slit_pair face",
      "the same point on the two faces of the slit, mouth to tip; the tip itself is one node");
    if (c.in()) {
      cracked.design = a.design;
      cracked.discretisation = a.discretisation;
      require_indices(c, "/cracked_tooth/slit_node", cracked.slit_node, cracked.node_position.rows());
    }
  }
  if (c.out()) c.picture(whole_gear(a));
}

std::string title(const SectorGrid& a) {
  return "Finite-element mesh of one tooth sector: " + gear_title(a.design);
}

template struct ArtifactFile<SectorGrid>;

}  // namespace whine
