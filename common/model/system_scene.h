// What a scene of several meshes says, in SI: gears, carriers, meshes, drives. Positions of the bodies follow from it
// (gear/system_layout.h).
#pragma once
#include <string>
#include <vector>

#include "base/error.h"
#include "model/system.h"

namespace whine {

struct SystemScene {
  struct Gear : SceneGear {
    double equivalent_mass = 0;  // kg: I / r_b^2, in place of total_inertia; 0: not given
  };
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
  std::vector<Gear> gears;
  std::vector<Carrier> carriers;
  std::vector<Pin> pins;  // of planets that stand beside their places
  std::vector<Mesh> meshes;
  std::vector<Drive> drives;
  Fidelity fidelity;
  // Of elastic bodies, of which natural modes need statics first.
  BodyDiscretisation body;
  ContactDiscretisation contact;
  // Of elastic bodies in motion: speeds (the torques are those of the drives; no speeds: no motion is asked for), damping, time steps.
  Operation operation;
  Damping damping;
  TimeDiscretisation time;

  bool rigid() const { return fidelity.body == BodyModel::rigid; }
};

// An error about one section of a list ([[mesh]], [[carrier]], [[drive]]), which who reads the file gives its line.
class SystemSceneError : public Error {
 public:
  SystemSceneError(const char* section, size_t number, const std::string& message)
      : Error(Failure::input, message), section_(section), number_(number) {}
  const char* section() const { return section_; }
  size_t number() const { return number_; }  // from 0, in the order of the file

 private:
  const char* section_;
  size_t number_;
};

}  // namespace whine
