// Which orders excite which natural modes of planetary trains, beside the rule of whole numbers.
#include <doctest/doctest.h>

#include <set>

#include "gear/system_layout.h"
#include "planetary_train.h"
#include "signal/mode_excitation.h"
#include "system/natural_modes.h"

using namespace whine;

TEST_CASE(
    "an order excites the modes whose phase grows from planet to planet as its own: l z = k or -k modulo N") {
  struct Train {
    int planets, sun, planet;
  };
  std::set<int> excited_harmonics;
  for (const Train& of :
       {Train{3, 27, 36}, Train{3, 28, 35}, Train{4, 27, 35}, Train{4, 28, 36}, Train{5, 33, 32}}) {
    CAPTURE(of.planets);
    CAPTURE(of.sun);
    Scene scene = planetary_train(of.planets);
    const std::array teeth{of.sun, of.planet, of.sun + 2 * of.planet};
    for (size_t g = 0; g < 3; ++g) scene.gears[g].design = rigid_gear(teeth[g], g == 2);
    for (Scene::Mesh& mesh : scene.meshes) mesh.spec.centre_distance = 0.5 * (of.sun + of.planet) * 2.776e-3;
    const ModesResult modes = natural_modes(layout_of(scene));
    std::vector<size_t> suns, rings;
    for (size_t m = 0; m < modes.layout.meshes.size(); ++m)
      (m < static_cast<size_t>(of.planets) ? suns : rings).push_back(m);
    for (Eigen::Index i = 0; i < modes.natural_frequency.size(); ++i)
      for (int order = 1; order <= 5; ++order) {
        const int k = modes.planet_harmonic[i], turns = order * of.sun % of.planets;
        const bool meets = turns == k || turns == (of.planets - k) % of.planets;
        const double left =
            std::max(excitation_left(modes, i, order, suns), excitation_left(modes, i, order, rings));
        CAPTURE(i);
        CAPTURE(order);
        // A motion without any deflection of a mesh has nothing to be excited by.
        if (modes.mesh_deflection.row(i).cwiseAbs().maxCoeff() > 1e-9) CHECK((left > 1e-6) == meets);
        if (left > 1e-6) excited_harmonics.insert(k);
      }
  }
  CHECK(excited_harmonics == std::set{0, 1, 2});
}
