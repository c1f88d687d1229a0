// Headings of the tables of results, in the order of the page.
#pragma once
#include <array>

namespace whine::groups {

inline constexpr const char* kExcitation = "Excitation, at rest";
inline constexpr const char* kSharing = "Load sharing";
inline constexpr const char* kNatural = "Natural frequencies and damping";
inline constexpr const char* kSpeeds = "Speeds";
inline constexpr const char* kVibration = "Vibration";
inline constexpr const char* kLoads = "Loads";
inline constexpr const char* kForce = "Mesh force";
inline constexpr const char* kFace = "Load over the face";
inline constexpr const char* kTorques = "Torques";
inline constexpr const char* kBearings = "Forces on the bearings";
inline constexpr const char* kMovingBearings = "Forces on the bearings in motion";
inline constexpr const char* kStress = "Stress";
inline constexpr const char* kLosses = "Losses";
inline constexpr const char* kSweeps = "The sweeps";
inline constexpr std::array kGroups{kExcitation,     kSharing, kNatural, kSpeeds,  kVibration,
                                    kLoads,          kForce,   kFace,    kTorques, kBearings,
                                    kMovingBearings, kStress,  kLosses,  kSweeps};

}  // namespace whine::groups
