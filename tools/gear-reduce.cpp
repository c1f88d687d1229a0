// gear-reduce: modes and flank flexibility of a gear from the mesh of one tooth sector.
//
// Reads      params     stage parameters of a scene: gear, material, number of modes
//            mesh.h5    geometry; rejected unless it is of the gear of the stage parameters
// Writes     body.h5    eigenfrequencies with the hub fixed, mode shapes and compliance on the flank, inertia
//                       coupling, and what the crack of a tooth adds to the compliance, if the gear has one; with
//                       width_degree also flexibility between polynomials over the face width
// Equations  K u = omega^2 M u and M_fr of Eq. 3-6, sector by sector in the harmonics of cyclic symmetry;
//            flexibility K x = f with the half-plane solution of the line load subtracted in the tooth, or matched
//            at a depth

#include <optional>

#include "base/error.h"
#include "base/progress.h"
#include "base/tool.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/provenance.h"
#include "io/scene.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "solid/reduce.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Modes and flank flexibility of a gear by cyclic symmetry", "gear-reduce"};
  std::string params, mesh, output;
  options.add("--params", params, "stage parameters of the scene: out/bodies/<hash>/body.toml").required();
  options.add("--mesh", mesh, "mesh.h5 of the gear").required();
  options.add("--output", output, "body.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-reduce --params out/parker2000/pinion/body.toml --mesh out/parker2000/pinion/mesh.h5 --output body.h5");
  options.parse(argc, argv);

  const whine::Provenance provenance = whine::made_by(argc, argv, {"params=" + params, "mesh=" + mesh});
  const whine::BodyParameters settings = whine::read_body_parameters(params);
  whine::SectorGrid sector = whine::read<whine::SectorGrid>(mesh);
  whine::require_mesh(sector, settings, mesh);
  sector.discretisation = settings.discretisation;  // a mesh does not say how its near field is reduced
  std::optional<whine::StepsShown> steps(std::in_place, "gear-reduce");
  const whine::ReducedBody result = whine::reduce(sector, settings.material, settings.discretisation.modes);
  steps.reset();

  whine::write(output, result, provenance);
  Eigen::Index torsional = 0;
  result.inertia_coupling.cwiseAbs().maxCoeff(&torsional);
  whine::log_line("gear-reduce: ", result.eigenfrequency.size(), " modes from ",
                  result.eigenfrequency.minCoeff(), " Hz, first torsional ", result.eigenfrequency[torsional],
                  " Hz, body inertia ", result.inertia, " kg m2, near field by ",
                  settings.discretisation.near_field,
                  settings.discretisation.near_field == whine::NearField::matching
                      ? whine::text(" at ", settings.discretisation.matching_depth * 1e3, " mm")
                      : "",
                  ", asymmetry of the flexibility ", result.asymmetry, " -> ", output);
  if (const whine::WidthTables& width = result.width; width.degree > 0)
    whine::log_line("gear-reduce: polynomials of degree ", width.degree, " over the face width of ",
                    width.face_width * 1e3, " mm");
  if (settings.design.crack.depth > 0)
    whine::log_line("gear-reduce: the crack in tooth ", settings.design.crack.tooth, " adds up to ",
                    result.crack_compliance.maxCoeff() * 1e9, " µm/kN to ",
                    result.compliance[0].maxCoeff() * 1e9);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
