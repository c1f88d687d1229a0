// How wide a contact the undamped half-plane of a motion holds: closed form, scenes, motion.
#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "base/dense.h"
#include "base/model_range.h"
#include "io/scene_place.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "scene_file.h"
#include "system/undamped_depth.h"

using namespace whine;

TEST_CASE(
    "undamped depth: the half-planes of two materials are positive up to the width of the closed form") {
  const HalfPlaneSurface steel({207e9, 0.3, 7600, true}, 20e-3), plastic({3e9, 0.4, 1400, false}, 20e-3);
  constexpr double kDepth = 0.3e-3;
  const double widest = widest_half_width(steel, plastic, kDepth);
  for (const double share : {0.97, 1.03}) {
    constexpr int kStrips = 60;
    const double half = share * widest / kStrips;
    Eigen::MatrixXd h(kStrips, kStrips);
    for (int i = 0; i < kStrips; ++i)
      for (int j = 0; j < kStrips; ++j)
        h(i, j) = steel.mean_over_strip(2 * half * (i - j), half, half, kDepth) +
                  plastic.mean_over_strip(2 * half * (i - j), half, half, kDepth);
    CHECK((symmetric_eigen(h).values[0] > 0) == (share < 1));
  }
}

TEST_CASE(
    "undamped depth: a scene whose motion cannot hold its contact is rejected with the depth that does") {
  const SceneFile file;
  const auto said = [&](const std::string& damping) {
    const std::string path = file.path(with_section("[damping]\n" + damping));
    return message_of_input([&] {
      check_undamped_depth(read_scene(path), {}, [&](const auto& sections, const std::string& words) {
        return scene_place(path, sections, words);
      });
    });
  };
  CHECK(said("").empty());
  // Time steps of 4 microseconds at most.
  CHECK(said("undamped_depth_mm = 0.05\nrayleigh_stiffness_s = 1e-6\n").empty());
  const std::string words = said("undamped_depth_mm = 0.05\nrayleigh_stiffness_s = 1e-5\n");
  CHECK(names(words,
              {"x.toml:24", 150, "0.1096*", "0.05", "0.0489*", "undamped_depth_mm", "[damping]", "0.117*"}));
  CHECK(said("undamped_depth_mm = 0.13\nrayleigh_stiffness_s = 1e-5\n").empty());
  CHECK(!said("undamped_depth_mm = 0.05\nrayleigh_stiffness_s = 1e-6\n[fidelity]\ncontact = \"line\"\n")
             .empty());
}

TEST_CASE("undamped depth: a motion that fails beyond it says so in the same words") {
  const ReducedBody& body = paper_body(40e-3, 1.2e-3, 12);
  const StaticParameters statics = paper_statics(8);
  const GearMeshModel model(body, body, statics.mesh);
  DynamicParameters parameters = paper_parameters(463e6);
  parameters.damping.undamped_depth = 0.03e-3;
  parameters.damping.rayleigh_stiffness = 1e-4;
  RollingDynamics dynamics(model, parameters);
  dynamics.set_zone(candidate_zone(model, static_transmission(body, body, statics, 150),
                                   MotionBounds(model, static_transmission(body, body, statics, 150))),
                    64);
  dynamics.set_speed(2500, 64);
  const std::string words = message_of([&] {
    RollingDynamics::State state = dynamics.rest();
    RollingDynamics::Period period;
    for (int n = 0; n < 5; ++n) dynamics.integrate(state, period);
  });
  CHECK(names(words, {"undamped_depth_mm", "0.03", "0.031*"}));
  CHECK(!contains(words, "table"));
}
