// Bodies that tests reduce, each once: within a run of the test program, and among the runs that share the folder WHINE_TEST_BODIES,
// which tests/run sets.
#pragma once
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "base/error.h"
#include "io/artifacts.h"
#include "io/scene.h"
#include "results/reduced_body.h"
#include "solid/mesher.h"
#include "solid/reduce.h"

namespace whine {

// With discretisation.modes modes.
inline const ReducedBody& kept_body(const GearDesign& design, const Material& material,
                                    const BodyDiscretisation& discretisation) {
  static std::map<std::string, ReducedBody> known;
  const std::string key = body_hash(body_parameters({design, material, discretisation}));
  if (const auto at = known.find(key); at != known.end()) return at->second;
  const char* folder = std::getenv("WHINE_TEST_BODIES");
  const std::string kept = folder ? text(folder, "/", key, ".h5") : std::string();
  if (folder && std::filesystem::exists(kept)) return known[key] = read<ReducedBody>(kept);
  ReducedBody body = reduce(make_sector_mesh(design, discretisation), material, discretisation.modes);
  if (folder) write(kept, body, Provenance());
  return known[key] = std::move(body);
}

inline const ReducedBody& kept_body(const GearDesign& design, const Material& material, double element_size,
                                    int modes) {
  BodyDiscretisation discretisation;
  discretisation.element_size = element_size;
  discretisation.modes = modes;
  return kept_body(design, material, discretisation);
}

}  // namespace whine
