// Changes of a scene by --set: what is written.
#include <doctest/doctest.h>

#include "io/variant.h"
#include "refusal.h"
#include "scene_file.h"

using namespace whine;

TEST_CASE("a variant has numbers as people write them, texts as they stand, whole ones whole") {
  const SceneFile file;
  const std::string path = file.path(
      "title = \"0.29999999999999999 of 1.5, it's\"\n[damping]\nrayleigh_stiffness_s = 7.7e-6\nrayleigh_mass_per_s = 200.0\n"
      "[operation]\ntorque_Nm = [0.1, -0.7, 150]\nmesh_frequency_Hz = { from = 600, to = 1000.2, step = 50.5 }\n");
  const std::string text =
      scene_variant(path, {"undamped_depth_mm=0.3", "bearing_ratio=0.30000000000000004"});
  for (const char* line : {"0.29999999999999999 of 1.5, it's", "rayleigh_stiffness_s = 7.7e-06\n",
                           "rayleigh_mass_per_s = 200.0\n", "[ 0.1, -0.7, 150 ]", "from = 600", "to = 1000.2",
                           "undamped_depth_mm = 0.3\n", "bearing_ratio = 0.30000000000000004\n"})
    CHECK(contains(text, line));
  // What is read again is the same number, and a variant of a variant the same text.
  CHECK(scene_variant(file.path(text), {"undamped_depth_mm=0.3"}) == text);
}
