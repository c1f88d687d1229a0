// What a scene says, in SI: gears, their meshes, damping, operation, fidelity and accuracy. No file: io/ reads and writes it.
#pragma once
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "base/error.h"
#include "model/gear.h"
#include "model/system.h"

namespace whine {

// BodyDiscretisation::modes that means every mode of the grid.
inline constexpr int kAllModes = -1;

// How the half-plane at the contact joins the finite elements: subtracted from them, or matched at a depth as in P2000.
enum class NearField { subtraction, matching };
template <>
inline constexpr const char* kWordsOf<NearField> = "subtraction matching";

// Of the third dimension of a body; see solid/width_body.h.
struct WidthDiscretisation {
  int degree = 0;           // of the polynomials over the face width; 0: a plane body
  double section_size = 0;  // m: elements of the section

  bool acts() const { return degree > 0; }
};

// Discretisation of a body: what gear-mesh and gear-reduce need beside the gear itself.
struct BodyDiscretisation {
  double element_size = 0;  // m on the flank; 0: left open
  int element_order = 2;    // 1 or 2
  int modes = 61;           // elastic modes of the whole gear, or kAllModes; doublets are never cut
  NearField near_field = NearField::subtraction;
  double matching_depth = 1e-3;  // m below the flank; without meaning to subtraction
  WidthDiscretisation width = {};
  double element_modules =
      0;                  // 1: element size over the module where it is left open; 0: the default of the key
  int flank_points = 24;  // of the flexibility table of a flank
};

// Off the line of action a tip edge may touch a flank.
struct CornerRule {
  bool enabled = true;
  double largest_angle = std::numeric_limits<double>::infinity();  // rad between the two normals
};

// Plane state of the contact: one of the two, or each body's own.
enum class ContactPlane { strain, stress, body };
template <>
inline constexpr const char* kWordsOf<ContactPlane> = "strain stress body";

// Where the coefficient of friction comes from: a number, or Schlenk's formula (gear/friction.h).
enum class FrictionLaw { constant, schlenk };
template <>
inline constexpr const char* kWordsOf<FrictionLaw> = "constant schlenk";

// Coulomb friction between the flanks, mu s N, s = v / sqrt(v^2 + v_0^2), v the sliding speed of the kinematics.
struct Friction {
  FrictionLaw law = FrictionLaw::constant;
  double coefficient = 0;       // 1, of FrictionLaw::constant; 0: no friction
  double smoothing = 0.01;      // 1: v_0 over the speed of the pitch line
  double viscosity = 0;         // Pa s, of the oil in the mesh; from here on: of Schlenk's formula
  double roughness = 0;         // m: Ra, mean of both flanks
  double lubricant_factor = 1;  // 1: X_L
  double static_frequency = 0;  // Hz: mesh frequency at which the coefficient of the pair at rest is taken

  bool acts() const { return law != FrictionLaw::constant || coefficient > 0; }
};

struct GearMeshSpec {
  std::array<std::string, kSides> gear;  // names: driver, driven gear
  double centre_distance = 0;            // m
  CornerRule corner;
  ContactPlane contact_plane = ContactPlane::body;
  std::array<FlankModification, kSides> modification = {};  // of each gear
  std::array<ToothErrors, kSides> errors = {};
  std::array<Bearing, kSides> bearing = {};
  Friction friction = {};
  // m over the common face width, in the plane of action: by how much more the flanks stand apart at the end that faces a viewer who sees
  // the driver turn counter-clockwise than at the other.
  double misalignment = 0;
  // m, along the axes as misalignment counts them: middle of the driven gear's face beyond that of the driver's. The narrower face
  // stands inside the wider one.
  double face_offset = 0;

  // Whether the load is not the same all over the face, helices aside.
  bool uneven() const {
    return misalignment != 0 || !modification[0].lead.none() || !modification[1].lead.none();
  }
  bool on_bearings() const { return bearing[0].elastic() || bearing[1].elastic(); }
};

// Of a scene that says nothing; it is that of the pair of P2000.
inline constexpr double kDefaultRayleighStiffness = 7.7e-6;  // s

struct Damping {
  double rayleigh_mass = 0;        // mu of eq. 21, s-1
  double rayleigh_stiffness = 0;   // eta of eq. 21, s
  double undamped_depth = 0.5e-3;  // m
  double bearing_ratio = 0.005;    // 1
};

// Mesh frequencies of a sweep, Hz.
struct MeshSpeeds {
  double frequency_from = 0, frequency_to = 0, frequency_step = 0;
};

struct Operation : MeshSpeeds {
  std::vector<double> torques;  // N m on the driver
};

// What of the elastic body moves by itself, cheapest first.
enum class BodyModel { rigid, quasi_static, relaxed, modal, full };
template <>
inline constexpr const char* kWordsOf<BodyModel> = "rigid quasi-static relaxed modal full";

// One force a tooth pair and Hertz's law, or pressure on strips.
enum class ContactModel { line, strips };
template <>
inline constexpr const char* kWordsOf<ContactModel> = "line strips";

// Newmark's (Eq. 8), or modal propagators.
enum class Integrator { newmark, exact };
template <>
inline constexpr const char* kWordsOf<Integrator> = "newmark exact";

// Contact over the face width, coarsest first: one slice; points that the teeth carry each by itself; points on bodies in three
// dimensions.
enum class WidthModel { one, slices, body };
template <>
inline constexpr const char* kWordsOf<WidthModel> = "one slices body";

struct Fidelity {
  BodyModel body = BodyModel::modal;
  ContactModel contact = ContactModel::strips;
  Integrator integrator = Integrator::exact;
  WidthModel width = WidthModel::one;
};

// Gauss points along the contact line of a tooth pair, under even load and where a part of the face may open.
inline constexpr int kFacePoints = 8, kFacePointsUneven = 12;

struct ContactDiscretisation {
  int strips = 8;  // across the contact width at the mean load
  int positions =
      0;  // of the static stage per mesh period; 0: as steps_per_period, 128 at least, fewer where teeth differ
  int face_points =
      0;  // Gauss points along the contact line of a tooth pair; 0: kFacePoints or kFacePointsUneven
};

// How a steady motion is found: transients are skipped where they can be, or run through period by period, as a rig would.
enum class SteadyState { extrapolate, integrate };
template <>
inline constexpr const char* kWordsOf<SteadyState> = "extrapolate integrate";

struct TimeDiscretisation {
  int steps_per_period = 128;      // stored samples per mesh period
  double min_sample_rate = 250e3;  // Hz; steps per period are doubled until it is reached
  double periodicity = 1e-5;       // relative change of the state at which a speed counts as steady
  SteadyState steady_state = SteadyState::extrapolate;
  // 1: of the RMS of the transmission error in motion, for which gear/accuracy.h chose what the scene leaves open; 0: for none.
  double accepted_error = 0;
};

// What a scene says: gears and carriers, the meshes that join them, drives. A pair is a scene of one mesh whose torques stand in
// `operation`; a train has drives. Positions of the bodies of a train follow from it (gear/system_layout.h).
struct Scene {
  struct Carrier {
    std::string name, planet;       // planet: the gear at each position
    int planets = 0;                // at equal spacing; 0: at `positions`
    std::vector<double> positions;  // (planet) rad, counter-clockwise from +x
    // kg m2: I, of the carrier about its axis. Planets on elastic pins are not included, each has its own mass. Planets on rigid pins
    // are point masses of it: + N m r^2, r the radius of the pins. Likewise the mass of the carrier's bearing: + N m.
    double inertia = 0;
    double equivalent_mass = 0;  // kg: I / r^2, in place of inertia, of the same masses; 0: not given
    Bearing bearing = {};
  };
  // Position error of the pin of one planet, from where the carrier should have it.
  struct Pin {
    std::string planet;                 // planet2: the gear of the carrier and a number, from 1
    double radial = 0, tangential = 0;  // m: away from the carrier's axis; counter-clockwise about it
  };
  struct Mesh {
    GearMeshSpec spec;  // that of one planet is for all planets
    double direction =
        0;  // rad, counter-clockwise from +x: to the pitch point; of planets their positions say it
    double stiffness = 0;  // N m-1 along the line of action, mean; of rigid bodies
  };
  struct Drive {
    std::string gear;  // or carrier
    System::DriveKind kind = System::DriveKind::free;
    double torque = 0, stiffness = 0;  // as System::Drive
  };
  std::string title;
  std::vector<SceneGear> gears;  // `like` resolved
  std::vector<Carrier> carriers;
  std::vector<Pin> pins;  // of planets that stand beside their places
  std::vector<Mesh> meshes;
  std::vector<Drive> drives;
  Damping damping;
  Operation operation;  // of a train the speeds alone; no speeds: no motion is asked for
  Fidelity fidelity;
  BodyDiscretisation body;
  ContactDiscretisation contact;
  TimeDiscretisation time;

  bool pair() const { return carriers.empty() && drives.empty() && meshes.size() == 1; }
  // Bodies of a train between springs, which have natural modes alone.
  bool rigid() const { return !pair() && fidelity.body == BodyModel::rigid; }
  const SceneGear& gear(const std::string& name) const;  // throws Error(input) if there is none
  // Of a pair, or the first one.
  GearMeshSpec& mesh() { return meshes.front().spec; }
  const GearMeshSpec& mesh() const { return meshes.front().spec; }
  std::vector<GearMeshSpec> specs() const;  // [mesh]
};

// An error about one section of a list ([[mesh]], [[carrier]], [[drive]]), which who reads the file gives its line.
class SectionError : public Error {
 public:
  SectionError(const char* section, size_t number, const std::string& message)
      : Error(Failure::input, message), section_(section), number_(number) {}
  const char* section() const { return section_; }
  size_t number() const { return number_; }  // from 0, in the order of the file

 private:
  const char* section_;
  size_t number_;
};

}  // namespace whine
