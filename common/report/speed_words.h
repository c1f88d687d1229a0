// Speeds in words: the rotation of a member in rpm beside the mesh frequency in Hz.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace whine {

// Hz; from = to: a single speed.
struct SpeedRange {
  double from = 0, to = 0;
};

// Neighbouring speeds (Hz) that are marked, joined; ascending.
std::vector<SpeedRange> marked_ranges(const std::map<double, bool>& speeds);
// Marked where the first is and the second is not.
std::map<double, bool> but_not(std::map<double, bool> speeds, const std::map<double, bool>& others);

// The gear or carrier whose rotation stands beside the mesh frequency.
struct TurningMember {
  std::string name;
  double turns = 0;  // revolutions in a mesh period, >= 0: of a gear on a fixed axis 1 / teeth; 0: not known
  std::string with = {};  // against what it turns: "carrier at rest"; "": nothing that has to be said

  double rpm(double mesh_frequency) const { return 60 * turns * mesh_frequency; }
};

// "3168 rpm (2640 Hz)"; "2640 Hz" where the rotation is not known.
std::string speed_words(const TurningMember& member, double mesh_frequency);
// "1200 to 3168 rpm (1000 to 2640 Hz)", several joined by "and"; of more than four the widest, and how many are left out.
std::string speed_words(const TurningMember& member, const std::vector<SpeedRange>& ranges);

// Words in which each speed in Hz, "2640 Hz" or "1000, 1200 to 1400 and 1600 Hz", has the rotation behind it: "2640 Hz (3168 rpm)".
std::string with_rpm(const TurningMember& member, const std::string& words);

}  // namespace whine
