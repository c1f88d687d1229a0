#include "io/mesh_codec.h"

#include "io/codec.h"
#include "io/vtk.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kMeshSchema{"mesh", 1};

// The two sectors of a mesh share no axes: names of the second one's are its own.
void describe_sector(Codec& file, const std::string& group, SectorGrid& a) {
  Codec c = file;  // axes of its own
  c.dataset({group + "/node_position", "m", "position of the nodes; gear centre at 0, tooth along +y",
             "node xy", kPlace},
            &a.node_position);
  c.dataset(
      {group + "/element_node", "1", "nodes of the elements: corners counter-clockwise, mid-sides, centre",
       "element corner", kNumber},
      &a.element_node);
  c.dataset({group + "/element_region", "1", "0: rim, 1: tooth, where the half-plane field is subtracted",
             "element", kFlag},
            &a.element_region);
  c.dataset({group + "/bore_node", "1", "nodes on the rigid hub", "bore_node", kNumber}, &a.bore_node);
  c.dataset(
      {group + "/side_node", "1", "node on the clockwise edge and its image on the counter-clockwise edge",
       "side_pair edge", kNumber},
      &a.side_node);
  c.dataset({group + "/flank_node", "1", "nodes of the driving flank, root to tip", "flank_node", kNumber},
            &a.flank_node);
  c.dataset(
      {group + "/flank_roll_angle", "rad", "involute roll angle of the flank nodes", "flank_node", kRoll},
      &a.flank_roll_angle);
  const Eigen::Index nodes = a.node_position.rows();
  require_indices(c, group + "/element_node", a.element_node, nodes);
  require_indices(c, group + "/bore_node", a.bore_node.transpose(), nodes);
  require_indices(c, group + "/side_node", a.side_node, nodes);
  require_indices(c, group + "/flank_node", a.flank_node.transpose(), nodes);
}

}  // namespace

void describe(Codec& c, SectorGrid& a) {
  describe_design(c, "gear", a.design);
  SceneParameters values;
  values.body = a.discretisation;
  c.parameters("discretisation", values, KeyGroup::body);
  if (c.in()) a.discretisation = values.body;
  describe_sector(c, "/sector", a);
  if (c.optional("/cracked_tooth/slit_node", !a.cracked_tooth.empty())) {
    if (a.cracked_tooth.empty()) a.cracked_tooth.emplace_back();
    SectorGrid& cracked = a.cracked_tooth.front();
    describe_sector(c, "/cracked_tooth", cracked);
    c.dataset({"/cracked_tooth/slit_node", "1",
               "the same point on the two faces of the slit, mouth to tip; the tip itself is one node",
               "slit_pair face", kNumber},
              &cracked.slit_node);
    if (c.in()) {
      cracked.design = a.design;
      cracked.discretisation = a.discretisation;
      require_indices(c, "/cracked_tooth/slit_node", cracked.slit_node, cracked.node_position.rows());
    }
  }
  if (c.out()) put_vtk(c.out()->file(), whole_gear(a));
}

void write(const std::string& path, const SectorGrid& a, const Provenance& provenance) {
  write_artifact(path, kMeshSchema, "Finite-element mesh of one tooth sector: " + gear_title(a.design), a,
                 provenance);
  link_for_paraview(path);
}

SectorGrid read_mesh(const std::string& path) {
  return read_artifact<SectorGrid>(path, kMeshSchema);
}

}  // namespace whine
