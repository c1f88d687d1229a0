// The discretisation that an accepted error of the motion asks for, and the error that a discretisation stands for, before anything is
// computed.
//
//   e^2 = sum e_i^2,   e_i: bounds of the RMS of the transmission error over all speeds, relative
//   time steps     22 (f_n / r)^2          f_n: natural frequency of a mesh of 20 N/(mm um), r: least sample rate;
//                  400 (f_n / r)^2       where most of the damping at f_n is of the mass, which damps no fast mode
//   modes          4.5e-3 (z / n)^1.6      n: of the whole gear, z: teeth of the largest one and 11
//   strips         5.5e-3 (4 / n)^1.6      across the contact width; of pairs
//   elements       4.7e-2 (h / m)^2        second order; h / m: in modules
//   face points    2.4e-3 (8 / n)^1.4      along a contact line; of slices; one of six pairs is above it, 6.6e-3 at 10 points
//   periodicity    3e-4 (p / 1e-4)         of trains and of gears on bearings, whose slow modes are hardly damped, 1e-2
//   flank points   1.1e-3 (24 / n)^2       of the flexibility table of a flank
// Bounds of what refinements changed on nine spur pairs, three helical pairs and three gears in line (tests/README.md). A whole gear has one
// band of modes in which its teeth bend, as many as it has teeth and a few of its disc: with a part of them the inertia of the loaded
// teeth is off by that share.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "model/scene.h"

namespace whine {

struct SettingError {
  std::string key;   // "element_mm"
  double value = 0;  // in the key's unit
  double error = 0;  // 1: e_i
  bool given = false;
  bool known =
      true;  // whether its law is that of what the scene asks for; error means nothing where it is not
};

struct DiscretisationPlan {
  double natural_frequency = 0;  // Hz: f_n, the highest of all meshes
  std::vector<SettingError> settings;
  double error() const;  // 1: e, of what is known
};

// 1: size of the elements on a flank over the module (m) of its gear.
double relative_element_size(const BodyDiscretisation& body, double module);

// Hz. Inertias that a scene leaves open are those of discs from the bore to the pitch circle.
double expected_natural_frequency(const Scene& scene);

// Whether the scene gives a key of [fidelity] or [discretisation]: "modes".
using KeyGiven = std::function<bool(const std::string& key)>;

// The plan of a scene as it stands.
DiscretisationPlan discretisation_plan(const Scene& scene, const KeyGiven& given);

// 1: what a scene accepts that does not say.
constexpr double kAcceptedError = 0.01;

// Chooses what the scene leaves open so that e is at most scene.time.accepted_error, if what it gives allows that; 0: changes nothing.
void choose_discretisation(Scene& scene, const KeyGiven& given);

// The same for a scene that says nothing of accuracy: kAcceptedError for each key that is open and whose law is known for what
// the scene asks (the others have their defaults); accepted_error stays 0 if there is none. What is given moves nothing else.
void choose_by_default(Scene& scene, const KeyGiven& given);

}  // namespace whine
