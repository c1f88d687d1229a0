// Root stress of a sweep by the loads that its teeth carry.
#pragma once
#include "results/sweep.h"
#include "system/system.h"

namespace whine {

// Fills root_stress, root_stress_angle and root_stress_phase by system/root_stress.h from /tooth_load, at the samples that are stored.
// They stay empty where no mesh has bodies with tables of root stress.
void add_root_stress(const SystemModel& system, SweepResult& sweep);

}  // namespace whine
