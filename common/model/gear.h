// One gear as a drawing has it: tooth, blank, material, what is taken off its flanks, what a machine leaves on them, its
// bearing.
#pragma once
#include <array>
#include <numbers>
#include <string>
#include <vector>

#include "base/choice.h"

namespace whine {

inline constexpr int kSides = 2;  // of a mesh: first the one that pushes
inline constexpr std::array<const char*, kSides> kRole{"driver", "driven"};  // in keys, datasets, figures
inline constexpr std::array<const char*, kSides> kGearName{"driver", "driven gear"};  // in messages

// A slit from the root of one tooth into it; see gear/crack.h.
struct Crack {
  int tooth = 0;                        // its number, counter-clockwise from tooth 0
  double depth = 0;                     // m, length of the slit; 0: there is none
  double start = std::numbers::pi / 6;  // rad, of the fillet's tangent at the mouth against the centre line
  double angle = std::numbers::pi / 3;  // rad, of the slit against the centre line
};

// Of a helix: right-hand if a section turns counter-clockwise as one moves towards the viewer.
enum class Hand { right, left };
template <>
inline constexpr const char* kWordsOf<Hand> = "right left";

// One gear's geometry; what is true of the tooth and the blank, nothing of load or motion.
// Of a helical gear module, pressure angle, shift and heights are those of the normal section, as drawings give them (ISO 21771: m_n,
// alpha_n, x, h*); its transverse section: gear/helix.h.
struct GearDesign {
  int teeth = 0;
  double module = 0;          // m
  double pressure_angle = 0;  // rad
  double helix_angle = 0;     // rad at the reference circle (beta); 0: a spur gear
  Hand hand = Hand::right;    // of a helical gear
  double profile_shift = 0;   // in modules
  double addendum = 1.0;      // in modules
  double dedendum = 1.25;     // in modules
  // In modules. External: of the rack that cuts the root, a trochoid. Internal: of the circular fillet at the root.
  double rack_tip_radius = 0.38;
  double tooth_thinning = 0;    // m along the pitch circle
  double face_width = 0;        // m
  double bore_radius = 0;       // m; rigid hub of an external gear; 0: none
  bool internal = false;        // teeth on the inside of a ring; see gear/involute.h
  double rim_outer_radius = 0;  // m; of an internal gear, where its rim is held; 0: none
  // N m-1 per m of circumference: of an even support of the outside of the rim; 0: rigid. See solid/rim_support.h.
  double rim_radial_stiffness = 0, rim_tangential_stiffness = 0;
  Crack crack;  // of one tooth

  // m: of the circle on which the body is held, the bore or, of an internal gear, the outside of the rim.
  double clamped_radius() const { return internal ? rim_outer_radius : bore_radius; }
  bool helical() const { return helix_angle > 0; }
  bool elastic_rim() const { return internal && rim_radial_stiffness > 0; }
};

// How a relief grows with the roll angle.
enum class ReliefShape { linear, parabolic };
template <>
inline constexpr const char* kWordsOf<ReliefShape> = "linear parabolic";

// Material taken off a flank between a start on it and one of its ends.
struct Relief {
  double amount = 0;  // m normal to the flank, at the end: the tip edge, or the foot of the involute
  // Where it starts, by one of these; 0: not given.
  double start_roll = 0;    // rad
  double start_radius = 0;  // m
  double length = 0;        // m, length of roll (base radius times roll angle) from the start to the end
  ReliefShape shape = ReliefShape::linear;

  bool operator==(const Relief&) const = default;
};

// What is taken off along the face of a gear, the same at every roll angle; z from the middle of its face towards the viewer who sees
// the driver turn counter-clockwise, b its width. Parts add up.
struct LeadModification {
  double crowning = 0;           // m at both ends of the face, 0 in the middle: a parabola
  double slope = 0;              // m at z = b / 2, 0 at -b / 2; below 0: excess material
  double end_relief = 0;         // m at both ends of the face, linear
  double end_relief_length = 0;  // m from where it starts to the end of the face

  bool none() const { return crowning == 0 && slope == 0 && end_relief == 0; }
  bool operator==(const LeadModification&) const = default;
};

// What is taken off the driving flanks of a gear, all of its teeth alike. Parts add up.
struct FlankModification {
  Relief tip, root;
  double crowning = 0;                        // m at both ends of the involute, 0 midway in the roll angle
  double slope = 0;                           // m at the tip, 0 at the foot; below 0: excess material
  std::vector<std::array<double, 2>> points;  // rad, m: roll angle, ascending, and what is taken off there
  LeadModification lead;

  bool of_profile() const {
    FlankModification profile = *this;
    profile.lead = {};
    return profile != FlankModification{};
  }
  bool operator==(const FlankModification&) const = default;
};

// What a machine leaves on the driving flanks of a gear, tooth by tooth; signs as an inspection sheet has them, positive where
// excess material. An empty list is none; parts add up.
struct ToothErrors {
  std::vector<double>
      single_pitch;  // (tooth) m along the reference circle: from the flank before to this one
  std::vector<double> cumulative_pitch;  // (tooth) m along the reference circle
  double eccentricity = 0;               // m: of the toothing's axis from that of rotation
  double eccentric_tooth = 0;            // number of the tooth, or of a place between two, towards which
  std::vector<double> profile_slope;     // (tooth) m: rise from the foot of the involute to the tip
  std::vector<double> profile_form;      // (tooth) m: from peak to valley of waves along the flank
  double profile_form_waves = 3;         // along the flank
  int iso_class = 0;                     // of ISO 1328-1, deviations drawn at random within it; 0: none
  double iso_share = 1;                  // of the limit that is used most
  int seed = 1;

  bool none() const {
    for (const auto* list : {&single_pitch, &cumulative_pitch, &profile_slope, &profile_form})
      for (const double deviation : *list)
        if (deviation != 0) return false;
    return eccentricity == 0 && iso_class == 0;
  }
};

struct Material {
  double youngs_modulus = 0;  // Pa
  double poisson_ratio = 0;   // 1
  double density = 0;         // kg m-3
  bool plane_stress = true;   // false: plane strain
};

// What carries a gear's hub, alike in all radial directions. The hub of a gear without one turns and does not move.
struct Bearing {
  double stiffness = 0;  // N m-1, radial; 0: rigid
  double damping = 0;    // N s m-1, radial
  double mass = 0;       // kg of all that moves with the hub, body included; 0: as drawn

  bool elastic() const { return stiffness > 0; }
};

struct SceneGear {
  std::string name;
  GearDesign design;
  Material material;
  double total_inertia = 0;  // kg m2 about the axis, body included
  FlankModification modification = {};
  ToothErrors errors = {};
  Bearing bearing = {};
  double equivalent_mass =
      0;  // kg: I / r_b^2, in place of total_inertia, of a rigid gear of a train; 0: not given

  bool teeth_differ() const { return !errors.none() || design.crack.depth > 0; }
};

}  // namespace whine
