// What a report says first: five sentences with the numbers that a designer acts on. Each is made of numbers that artifacts hold; nothing
// is computed here. Lengths in m, forces in N, speeds as mesh frequencies in Hz.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/speed_words.h"

namespace whine {

// Of meshes that are alike, such as those of planets, the least and the largest.
struct Spread {
  double least = 0, most = 0;
  double error = -1;  // of `most`; below 0: not known
};

struct MeshExcitation {
  std::string mesh;  // "": the only one
  Spread peak_to_peak, first_order;
};
// How much the transmission error swings. load: "150 N m".
std::string excitation_line(const std::string& load, const std::vector<MeshExcitation>& meshes);

inline constexpr int kOrders = 3;  // of the mesh frequency, which excite most
struct CriticalSpeeds {
  struct Natural {
    double frequency = 0;
    std::string name;                                     // "the natural frequency", "mode 5 (rotational)"
    double error = -1;                                    // Hz; below 0: not known
    std::array<bool, kOrders> excited{true, true, true};  // by order 1, 2, 3
  };
  TurningMember member;
  std::optional<SpeedRange> speeds;  // those that are computed; none: gears at rest alone
  std::vector<Natural> natural;      // the most important one first
  std::vector<double> peaks;         // speeds at which the computed vibration has a peak
};
// Where the orders 1 to 3 of the mesh frequency meet natural frequencies that they excite, order 1 outside of the speeds, too, and
// where the vibration peaks.
std::string critical_speed_line(const CriticalSpeeds& critical);

struct Parting {
  struct Sweep {
    std::vector<SpeedRange> apart;  // speeds with loss of contact
    std::vector<double> jumps;
  };
  TurningMember member;
  std::optional<SpeedRange> speeds;
  std::optional<Sweep> rising, falling;         // none: not computed
  std::vector<SpeedRange> only_falling;         // speeds with loss of contact with falling speed alone
  std::string meshes;                           // which lose contact, of several
  std::vector<std::string> parts_at, holds_at;  // other torques
};
// Whether teeth part within the speeds, and whether a drive that starts from rest comes to it.
std::string parting_line(const Parting& parting);

struct DynamicFactor {
  std::string mesh;                // "": the only one
  double factor = 0;               // largest mesh force over the mean one at rest
  double at = 0;                   // where
  std::optional<double> standard;  // K_v there
  double error = -1;               // of the factor; below 0: not known
};
// meshes: none, nothing moves. no_standard: why there is no K_v.
std::string dynamic_factor_line(const TurningMember& member, const std::vector<DynamicFactor>& meshes,
                                const std::string& no_standard);

struct Advice {
  struct Relief {
    std::string gears;     // "both gears", "sun-planet"
    double amount = 0;     // the deflection of the teeth under the load
    double edge_load = 0;  // what tip edges carry
  };
  TurningMember member;
  std::vector<Relief> relief;
  std::vector<SpeedRange> avoid;  // speeds where teeth part or the vibration is largest
  bool parts = false;             // whether teeth part there
  std::optional<double> stiffness_swing,
      damping_ratio;              // 1: first harmonic of the mesh stiffness over its mean; of the mesh
  std::vector<std::string> more;  // sentences of their own
  bool edges = true,
       moves = true;  // whether contact of tip edges off the line of action, and motion, are computed
};
// What to change first.
std::string advice_line(const Advice& advice);

// The lines as a list of HTML, each behind its word; picture: marks above it, "" if there is none.
std::string opening_html(const std::vector<std::string>& lines, const std::string& picture);

}  // namespace whine
