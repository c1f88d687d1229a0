// What the drawings of gears in mesh say of their computation: face widths that differ, undercut.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "gear/pair.h"
#include "results/static.h"

namespace whine {

// Of gears of these names.
std::vector<Remark> drawing_remarks(const GearPair& pair, const std::array<std::string, 2>& name);

// Of all meshes of a system, each remark once.
std::vector<Remark> drawing_remarks(const SystemStaticResult& system);

}  // namespace whine
