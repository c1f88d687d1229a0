// gear-mesh: one tooth sector of a spur gear as a structured mesh of quadrilaterals, exact on every boundary.
//
// Reads      params     stage parameters of a scene: the gear's own keys and its discretisation
// Writes     mesh.h5    nodes, elements, regions and node sets of the sector; the whole gear for ParaView
//                       under /VTKHDF; the sector of the cracked tooth beside it if the gear has one
// Equations  involute of the base circle, root cut by a rounded rack; the tooth is mirror symmetric

#include "base/error.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/sector_grid.h"
#include "solid/elements.h"
#include "solid/mesher.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Mesh of one tooth sector of a spur gear", "gear-mesh"};
  std::string params, output;
  options.add("--params", params, "stage parameters of the scene: out/bodies/<hash>/body.toml").required();
  options.add("--output", output, "mesh.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-mesh --params out/parker2000/pinion/body.toml --output mesh.h5");
  options.parse(argc, argv);

  const whine::Provenance provenance = whine::made_by(argc, argv, {"params=" + params});
  const whine::BodyParameters settings = whine::read_body_parameters(params);
  const whine::SectorGrid mesh = whine::make_sector_mesh(settings.design, settings.discretisation);

  whine::write(output, mesh, provenance);
  const double area = whine::mesh_area(mesh.node_position, mesh.element_node);
  whine::log_line("gear-mesh: ", settings.design.teeth, " teeth, ", mesh.element_node.rows(),
                  " elements and ", mesh.node_position.rows(), " nodes a sector, least Jacobian ",
                  whine::least_jacobian(mesh.node_position, mesh.element_node), " of the mean, area ",
                  area * 1e6, " mm2 (relative error ", area / whine::exact_sector_area(settings.design) - 1,
                  ") -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
