// How large the inertia forces of a turning carrier are, and what of them systems in motion leave out.
#pragma once
#include <vector>

#include "results/reduced_body.h"
#include "results/sweep.h"

namespace whine {

// One carrier at the highest speed of a sweep. Its frame turns at Omega = 2 pi f / z against the gear of z teeth at rest.
struct TurningCarrier {
  int carrier = 0;     // number of the body
  bool turns = false;  // in the scene; false: it is held, and would turn if the gear below were held instead
  int still =
      -1;  // the held gear that meshes with its planets; -1: none, Omega does not follow from the scene
  double mesh_frequency = 0;  // Hz
  double speed = 0;           // rad s-1: Omega
  double centrifugal_force =
      0;  // N, on a planet: m r Omega^2, constant in the frame of the carrier; largest of its planets
  double mesh_force = 0;  // N: largest mean force of the meshes of its planets at that speed
  double coriolis =
      0;  // 1: 2 Omega over 2 pi f, by which motion at the mesh frequency is changed; 2 / z at any speed
  bool in_motion =
      false;  // both are in the motions of the sweep, see frame_turns(); false: they are left out
  // Of elastic modes they are left out: 1, the largest 2 |Omega_b| / w over the lowest mode of each gear b, with its speed and frequency;
  // number of the body, and Hz. Without bodies 0.
  double elastic = 0, elastic_frequency = 0;
  int elastic_body = -1;
  double relative_force() const { return mesh_force > 0 ? centrifugal_force / mesh_force : 0; }
};

// Carriers whose planets mesh with a held gear, or that turn. Planets without a mass count as weightless. bodies: of settings.body, or none.
std::vector<TurningCarrier> turning_carriers(const SweepResult& sweep,
                                             const SystemStaticParameters& settings = {},
                                             const std::vector<ReducedBody>& bodies = {});

// The same in words.
std::vector<Remark> remarks_on_carriers(const SweepResult& sweep, const SystemStaticParameters& settings = {},
                                        const std::vector<ReducedBody>& bodies = {});

}  // namespace whine
