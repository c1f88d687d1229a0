// What a scene will compute with: its discretisation, the error that this stands for, expected times. Nothing is computed.
#pragma once
#include <string>

namespace whine {

// A table in words: settings, whether the scene gives them or [accuracy] chose them, their errors of the RMS in motion; CPU time and
// memory of the stages. Errors as read_scene(); Error(input) for a system of rigid gears.
std::string plan_words(const std::string& path);

}  // namespace whine
