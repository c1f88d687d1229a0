#include "io/modes_codec.h"

#include "base/error.h"
#include "io/codec.h"
#include "io/layout_codec.h"
#include "io/vtk.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kModesSchema{"modes", 1};

}  // namespace

void describe(Codec& c, ModesResult& a) {
  describe_layout(c, a.layout);
  const Range shape{-kAny, kAny};
  c.dataset({"/natural_frequency", "Hz", "natural frequency, 0 of a free motion", "mode", kFrequency},
            &a.natural_frequency);
  c.dataset({"/free_motion_frequency", "Hz", "motions slower than this count as free", "", kFrequency},
            &a.rigid_frequency);
  c.choices(
      {"/mode_type", "1",
       "for each mode: rotational, translational, planet, mixed (no such structure) or train (no planets, or those of several carriers)",
       ""},
      a.type);
  c.dataset({"/planet_harmonic",
             "1",
             "turns by which the phase grows over the planets; -1: they are not alike or not equally spaced",
             "mode",
             {-1, 100}},
            &a.planet_harmonic);
  c.dataset({"/mode_shape", "kg-1/2",
             "u = radius times rotation in the body's sense, x, y of its axis; unit modal mass",
             "mode body_number freedom", shape},
            &a.shape);
  c.dataset({"/mesh_deflection", "kg-1/2", "closing of each mesh along its line of action, at that shape",
             "mode mesh_number", shape},
            &a.mesh_deflection);
  // Of springs shares are 0 to 1; terms off the diagonal of elastic bodies may take one below 0.
  const bool elastic = c.optional("/frozen_frequency", a.frozen_frequency.size() > 0);
  c.dataset({"/mesh_energy", "1", "share of the potential energy in each mesh", "mode mesh_number",
             elastic ? Range{-10, 10} : Range{0, 1 + 1e-9}},
            &a.mesh_energy);
  c.dataset({"/bearing_energy", "1", "the same of each body's bearing and of what holds its rotation",
             "mode body_number", Range{0, 1 + 1e-9}},
            &a.bearing_energy);
  c.dataset({"/kinetic_energy", "1", "share of the kinetic energy of each body", "mode body_number",
             Range{0, 1 + 1e-9}},
            &a.kinetic_energy);
  if (elastic) {
    c.dataset({"/mesh_phase", "1", "of elastic gears: phase of the first mesh", "mesh_phase", kPhase},
              &a.mesh_phase);
    c.dataset(
        {"/frozen_frequency", "Hz",
         "natural frequencies with the contact of each phase, ascending; those of /natural_frequency have the mean stiffness",
         "mesh_phase mode", kFrequency},
        &a.frozen_frequency);
  }
  if (c.out() && a.view.point.rows() > 0)
    put_vtk(c.out()->file(),
            {a.view.point, a.view.cell, {}, {}, a.view.line, a.view.point_data, a.view.cell_data});
  if (!c.in()) return;
  if (static_cast<Eigen::Index>(a.type.size()) != a.natural_frequency.size())
    c.in()->file().reject("dataset /mode_type has not one word for each mode");
}

void write(const std::string& path, const ModesResult& a, const Provenance& provenance) {
  write_artifact(
      path, kModesSchema,
      text("Natural modes: ", a.layout.bodies.size(), " bodies, ", a.layout.meshes.size(), " meshes"), a,
      provenance);
  if (a.view.point.rows() > 0) link_for_paraview(path);
}

ModesResult read_modes(const std::string& path) {
  return read_artifact<ModesResult>(path, kModesSchema);
}

}  // namespace whine
