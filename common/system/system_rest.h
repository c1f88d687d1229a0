// A scene's system of elastic gears at rest over a mesh period: bodies, teeth, bearings, carriers.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "results/reduced_body.h"
#include "results/static.h"
#include "system/system.h"

namespace whine {

// Checks of a scene before its bodies are computed. Throws SectionError with the section that is wrong: a carrier that may
// turn without an inertia, meshes of different contact_plane, torques that are not balanced, that pull a mesh apart or that no mesh
// carries; of pairs, too, contact that leaves an involute at its root.
void check_at_rest(const Scene& scene, const System& layout);

// Of bodies ([gear] of settings.body) that of a gear, by its name.
const ReducedBody& body_of(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                           const std::string& gear);

// The system that the settings describe, with friction as its meshes have it; bodies: [gear] of settings.body. depth: of contact in slices,
// see sliced_system().
SystemModel elastic_system(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                           double depth = 0);

// Coefficients of friction of its meshes under the loads of its drives, as they say.
void take_friction(SystemModel& system);
// With friction in a train that can roll as a whole, what leaves the train follows from the losses: holds output_of() in place of its
// torque. Result: that body; -1: nothing has changed.
int hold_output(SystemModel& system);

// 1: power out over power in of bodies on the ground under their torques (body; N m in their own sense), while body `at_rest` is at rest
// and the frame of the layout turns by that; -1: at rest in this frame. 0 where no power goes in.
double efficiency_at_rest(const System& layout, const Eigen::VectorXd& torque, int at_rest);

// Inertias and masses as the gears are drawn, where the scene does not say them.
void take_masses(const SystemStaticParameters& settings, const std::vector<ReducedBody>& bodies,
                 System& layout);

// bodies: [gear] of settings.body. Throws Error(input) for torques that are not balanced, more positions than memory holds and what
// SystemModel and hunting_periods() reject, and what over_period() throws.
//
// What holds a carrier, T_c = -sum (P - C) x F over its planets, and its bearing force, sum F, F what a planet presses its pin
// with, follow from the planets. Where all axes of a train but those of planets are one, sum of sense T over bodies on the
// ground is 0.
//
// zone_factor: as pair_at_rest() takes it.
SystemStaticResult system_at_rest(const SystemStaticParameters& settings,
                                  const std::vector<ReducedBody>& bodies, double zone_factor = 1);

}  // namespace whine
