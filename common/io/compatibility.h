// Whether artifacts belong to the stage parameters of a scene that a stage is given: mixed files are rejected by name.
#pragma once
#include <string>
#include <vector>

#include "io/named_files.h"
#include "io/scene.h"
#include "model/system_stages.h"
#include "results/reduced_body.h"
#include "results/sector_grid.h"
#include "results/static.h"

namespace whine {

// Error(input), with both values and the make target, unless `mesh` (read from `path`) is of the gear, the
// element size and the order of the stage parameters. The number of modes does not change a mesh.
void require_mesh(const SectorGrid& mesh, const BodyParameters& settings, const std::string& path);

// Error(input), with both hashes and the make target, unless `body` (read from `path`) is the one whose stage parameters
// has this hash: keeps bodies of other scenes, or of the other role ("driver", "driven"), out of a pair. An
// empty hash is of stage parameters that name no bodies: any body will do.
void require_body(const ReducedBody& body, const std::string& hash, const std::string& role,
                  const std::string& path);

// The bodies of a system's gears, in the order of settings.body, each the one that the stage parameters name. Throws as
// NamedFiles::of(), read<ReducedBody>() and require_body().
std::vector<ReducedBody> read_bodies(const NamedFiles& files, const SystemStaticParameters& settings);

// Error(input), with both model levels and the make target, unless `statics` (read from `path`) has the contact that the
// stage parameters of a later stage say.
void require_contact(const StaticResult& statics, const Fidelity& wanted, const std::string& path);

// The file that gear-scene last cut into the folder `home` (out/<scene>), from the working folder; empty if not known.
std::string recorded_scene(const std::string& home);

// Records it for `home`. Error(input) if another file is recorded there, is still there and says otherwise: files of one
// name in two folders would take turns in one folder of results.
void record_scene(const std::string& home, const std::string& scene);

}  // namespace whine
