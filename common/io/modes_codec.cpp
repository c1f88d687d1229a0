#include "io/artifacts.h"

#include "base/error.h"
#include "io/artifact_file.h"
#include "io/layout_codec.h"

namespace whine {
namespace {

using namespace ranges;

}  // namespace

void describe(Codec& c, ModesResult& a) {
  describe_layout(c, a.layout);
  const Range shape{-kAny, kAny};
  c(a.natural_frequency, "/natural_frequency", "Hz", kFrequency, "mode",
    "natural frequency, 0 of a free motion");
  c(a.rigid_frequency, "/free_motion_frequency", "Hz", kFrequency, "",
    "motions slower than this count as free");
  c(a.type, "/mode_type", "",
    "for each mode: rotational, translational, planet, mixed (no such structure) or train (no planets, or those of several carriers)");
  c(a.planet_harmonic, "/planet_harmonic", "1", {-1, 100}, "mode",
    "turns by which the phase grows over the planets; -1: they are not alike or not equally spaced");
  c(a.shape, "/mode_shape", "kg-1/2", shape, "mode body_number freedom",
    "u = radius times rotation in the body's sense, x, y of its axis; unit modal mass");
  c(a.mesh_deflection, "/mesh_deflection", "kg-1/2", shape, "mode mesh_number",
    "closing of each mesh along its line of action, at that shape");
  // Of springs shares are 0 to 1; terms off the diagonal of elastic bodies may take one below 0.
  const bool elastic = c.optional("/frozen_frequency", a.frozen_frequency.size() > 0);
  c(a.mesh_energy, "/mesh_energy", "1", elastic ? Range{-10, 10} : Range{0, 1 + 1e-9}, "mode mesh_number",
    "share of the potential energy in each mesh");
  c(a.bearing_energy, "/bearing_energy", "1", Range{0, 1 + 1e-9}, "mode body_number",
    "the same of each body's bearing and of what holds its rotation");
  c(a.kinetic_energy, "/kinetic_energy", "1", Range{0, 1 + 1e-9}, "mode body_number",
    "share of the kinetic energy of each body");
  if (elastic) {
    c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase", "of elastic gears: phase of the first mesh");
    c(a.frozen_frequency, "/frozen_frequency", "Hz", kFrequency, "mesh_phase mode",
      "natural frequencies with the contact of each phase, ascending; those of /natural_frequency have the mean stiffness");
  }
  if (c.optional("/turning_frequency", a.turning_frequency.size() > 0)) {
    c(a.frame_turns, "/carrier_turns", "1", {-1, 1}, "",
      "revolutions of the carrier in a mesh period, counter-clockwise positive");
    c(a.turning_mesh_frequency, "/mesh_frequency", "Hz", kFrequency, "mesh_frequency",
      "mesh frequencies of /turning_frequency");
    c(a.turning_frequency, "/turning_frequency", "Hz", kFrequency, "mesh_frequency mode",
      "natural frequencies in the frame of the carrier as it turns, with Coriolis and centrifugal terms, ascending");
  }
  c.picture({a.view.point, a.view.cell, {}, {}, a.view.line, a.view.point_data, a.view.cell_data});
  if (!c.in()) return;
  if (static_cast<Eigen::Index>(a.type.size()) != a.natural_frequency.size())
    c.in()->reject("dataset /mode_type has not one word for each mode");
}

std::string title(const ModesResult& a) {
  return text("Natural modes: ", a.layout.bodies.size(), " bodies, ", a.layout.meshes.size(), " meshes");
}

template struct ArtifactFile<ModesResult>;

}  // namespace whine
