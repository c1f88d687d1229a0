// A scene: every number that a user may change, read from TOML with checked keys and turned into SI.
//
// Each key is declared once, in keys.cpp, with name, unit, range, default and one line of documentation;
// the reader, the canonical slices that make compares, /parameters in the artifacts and `--help` all come
// from that declaration.
#pragma once
#include <array>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <vector>

namespace whine {

// A slit from the root of one tooth into it; see gear/crack.h.
struct Crack {
  int tooth = 0;                        // its number, counter-clockwise from tooth 0
  double depth = 0;                     // m, length of the slit; 0: there is none
  double start = std::numbers::pi / 6;  // rad, of the fillet's tangent at the mouth against the centre line
  double angle = std::numbers::pi / 3;  // rad, of the slit against the centre line
};

// One gear's geometry; what is true of the tooth and the blank, nothing of load or motion.
struct GearDesign {
  int teeth = 0;
  double module = 0;              // m
  double pressure_angle = 0;      // rad
  double profile_shift = 0;       // in modules
  double addendum = 1.0;          // in modules
  double dedendum = 1.25;         // in modules
  double rack_tip_radius = 0.38;  // in modules; the root is the trochoid that this rack cuts
  double tooth_thinning = 0;      // m at the pitch circle
  double face_width = 0;          // m
  double bore_radius = 0;         // m; rigid hub
  Crack crack;                    // of one tooth
};

// Material taken off a flank between a start on it and one of its ends.
struct Relief {
  double amount = 0;  // m normal to the flank, at the end: the tip edge, or the foot of the involute
  // Where it starts, by one of these; 0: not given.
  double start_roll = 0;         // rad
  double start_radius = 0;       // m
  double length = 0;             // m, length of roll (base radius times roll angle) from the start to the end
  std::string shape = "linear";  // in the roll angle; or "parabolic"

  bool operator==(const Relief&) const = default;
};

// What is taken off the driving flanks of a gear, all of its teeth alike. Parts add up.
struct FlankModification {
  Relief tip, root;
  double crowning = 0;                        // m at both ends of the involute, 0 midway in the roll angle
  double slope = 0;                           // m at the tip, 0 at the foot; below 0: material stands
  std::vector<std::array<double, 2>> points;  // rad, m: roll angle, ascending, and what is taken off there

  bool operator==(const FlankModification&) const = default;
};

// What a machine leaves on the driving flanks of a gear, tooth by tooth; signs as an inspection sheet has them, positive where
// material stands. An empty list is none; parts add up.
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

// BodyDiscretisation::modes that stands for every mode of the mesh.
inline constexpr int kAllModes = -1;

// Discretisation of a body: what gear-mesh and gear-reduce need beside the gear itself.
struct BodyDiscretisation {
  double element_size = 0;  // m on the flank
  int element_order = 2;    // 1 or 2
  int modes = 61;           // elastic modes of the whole gear, or kAllModes; doublets are never cut
  std::string near_field =
      "subtraction";             // of the half-plane in the finite elements; or "matching" at a depth
  double matching_depth = 1e-3;  // m below the flank; without meaning to subtraction
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
};

// Off the line of action a tip edge may touch a flank.
struct CornerRule {
  bool enabled = true;
  double largest_angle = std::numeric_limits<double>::infinity();  // rad between the two normals
};

struct GearMeshSpec {
  std::string driver, driven;  // names of gears
  double centre_distance = 0;  // m
  CornerRule corner;
  std::string contact_plane = "body";  // plane state of the contact: "strain", "stress", or each body's own
  std::array<FlankModification, 2> modification = {};  // of driver and driven gear
  std::array<ToothErrors, 2> errors = {};              // the same
  std::array<Bearing, 2> bearing = {};                 // the same

  bool on_bearings() const { return bearing[0].elastic() || bearing[1].elastic(); }
  const std::string& gear(int g) const { return g == 0 ? driver : driven; }
};

inline constexpr int kSides = 2;  // of a mesh: first the one that pushes

// A flank of a tooth: the one that leads in counter-clockwise rotation, and its mirror image.
enum class FlankSide { leading, trailing };

// The gears of a scene together: bodies that turn, meshes that join two of them each, drives. Gears stand in the order of the
// flow of power, so that the first side of a mesh pushes the second one.
struct System {
  struct Body {
    std::string name;                // of its gear
    int teeth = 0;                   // which shift by one, in the sense of rotation, in a mesh period
    int sense = 1;                   // of its rotation: 1 counter-clockwise, -1 clockwise
    double angle = 0;                // rad, counter-clockwise from +y: of tooth 0 at phase 0
    std::array<double, 2> centre{};  // m
    Bearing bearing = {};

    int rigid_freedoms() const {
      return bearing.elastic() ? 3 : 1;
    }  // rotation; and translation along x and y
  };
  struct Side {
    int body = 0;
    FlankSide flank = FlankSide::leading;
    int sense = 1;  // of its body's rotation
    int first_tooth =
        0;  // of the reference pair, in the mesh period that begins with that pair at the pitch point

    // Number of the tooth, counter-clockwise, that works in a pair; pairs count in the sense of motion.
    int tooth(int pair) const { return first_tooth + sense * pair; }
  };
  struct Mesh {
    std::array<Side, 2> side;
    double centre_distance = 0;  // m
    double direction = 0;  // rad, counter-clockwise from +x: from the first side's centre to the second's
    double phase = 0;      // 0 to 1, mesh periods: what this mesh is ahead of the first one
  };
  enum class DriveKind { torque, held };
  struct Drive {
    int body = 0;
    DriveKind kind = DriveKind::torque;
    double torque = 0;  // N m, in the sense of the body's rotation
  };
  std::vector<Body> bodies;
  std::vector<Mesh> meshes;
  std::vector<Drive> drives;  // a body without one is free of torque

  bool held(int body) const {
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::held) return true;
    return false;
  }
  double torque(int body) const {  // N m
    double sum = 0;
    for (const Drive& drive : drives)
      if (drive.body == body && drive.kind == DriveKind::torque) sum += drive.torque;
    return sum;
  }
};

struct Damping {
  double rayleigh_mass = 0;        // mu of eq. 21, s-1
  double rayleigh_stiffness = 0;   // eta of eq. 21, s
  double undamped_depth = 0.5e-3;  // m
  double bearing_ratio = 0.005;    // 1
};

struct Operation {
  std::vector<double> torques;                                      // N m on the driver
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;  // mesh frequency, Hz
};

struct Fidelity {
  std::string body = "modal";        // rigid, quasi-static, lagged, modal, full
  std::string contact = "strips";    // line, strips
  std::string integrator = "exact";  // newmark, exact
};

// The choice of a key of [fidelity] that stands after `choice` on its ladder, cheapest first; empty after the last.
std::string next_rung(const std::string& key, const std::string& choice);

struct ContactDiscretisation {
  int strips = 8;  // across the contact width at the mean load
  int positions =
      0;  // of the static stage per mesh period; 0: as steps_per_period, 128 at least, fewer where teeth differ
};

struct TimeDiscretisation {
  int steps_per_period = 128;                // stored samples per mesh period
  double min_sample_rate = 250e3;            // Hz; steps per period are doubled until it is reached
  double periodicity = 1e-5;                 // relative change of the state at which a speed counts as steady
  std::string steady_state = "extrapolate";  // or "march": every period on the way, as a rig would
};

struct Scene {
  std::string title;
  std::vector<SceneGear> gears;  // `like` resolved
  GearMeshSpec mesh;
  Damping damping;
  Operation operation;
  Fidelity fidelity;
  BodyDiscretisation body;
  ContactDiscretisation contact;
  TimeDiscretisation time;

  const SceneGear& gear(const std::string& name) const;  // throws Error(input) if there is none
};

// Reads and checks a whole scene. Error(input) names file:line, key, value and limit, and for an unknown key
// or section the nearest known one; Error(io) if the file cannot be read.
Scene read_scene(const std::string& path);

// The parts of a scene that a stage depends on, and nothing else, so that make redoes a stage only if one of
// its own numbers changed. SI units throughout.

// For gear-mesh and gear-reduce: the gear without name, inertia, torque or motion.
struct BodySlice {
  GearDesign design;
  Material material;
  BodyDiscretisation discretisation;
};

// For gear-static; `contact.positions` is resolved (never 0), `fidelity` holds the contact rung only.
struct StaticSlice {
  GearMeshSpec mesh;
  Fidelity fidelity;
  ContactDiscretisation contact;
  std::string driver_body, driven_body;  // hashes of the bodies' slices; empty: the slice names none
};

// For gear-impact.
struct ImpactSlice {
  double driver_inertia = 0, driven_inertia = 0;  // kg m2, total
  Damping damping;
  double reference_torque = 0;  // N m: first torque listed, whose mean stiffness sets the bearing dampers
  Fidelity fidelity;
};

// For gear-sweep.
struct SweepSlice : ImpactSlice {
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;  // mesh frequency, Hz
  TimeDiscretisation time;
};

// For gear-jump-map: a sweep whose speeds and Rayleigh stiffness factor the map chooses; both are 0.
SweepSlice read_map_slice(const std::string& path);

// For gear-lumped: a sweep of which nothing is read that only elastic bodies have; damping, body and integrator are defaults.
// speeds: false leaves those of the scene out, for a map of jumps, which chooses its own.
SweepSlice read_lumped_slice(const std::string& path, bool speeds);

// Canonical text of a slice: TOML in SI, keys in a fixed order, numbers with all digits. Depends on values
// only, not on comments, order or defaults left out. Errors: Error(input) for a gear that does not exist.
std::string body_slice(const Scene& scene, const std::string& gear);
std::string body_slice(const BodySlice& values);
std::string static_slice(const Scene& scene);
std::string impact_slice(const Scene& scene);
std::string sweep_slice(const Scene& scene);
std::string map_slice(const Scene& scene);
std::string lumped_slice(const Scene& scene, bool speeds);

// First 16 hexadecimal digits of the SHA-256 of a body slice: the folder out/bodies/<hash>/.
std::string body_hash(const std::string& slice);

// Read what the functions above wrote; errors as read_scene.
BodySlice read_body_slice(const std::string& path);
StaticSlice read_static_slice(const std::string& path);
ImpactSlice read_impact_slice(const std::string& path);
SweepSlice read_sweep_slice(const std::string& path);

// The table of keys as Markdown: section, key, range, default, meaning.
std::string scene_key_table();

}  // namespace whine
