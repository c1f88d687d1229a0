// No text in the pictures of a pair at rest and in motion is cut at an edge or lies on other text, and every picture has such a case.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "picture_inputs.h"
#include "refusal.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/figure_registry.h"
#include "report/response_figures.h"
#include "report/system_picture.h"

using namespace whine;
using namespace whine::pictures;
using Eigen::Index;
using Eigen::VectorXd;

TEST_CASE("pictures of a pair at rest: no text is cut or lies on other text, one torque, four and six") {
  for (const size_t count : {1, 3, 4, 6}) {
    CAPTURE(count);
    check(transmission_error_figure(six_at_rest(count)), "fig12");
    check(mesh_stiffness_figure(six_at_rest(count)), "fig13");
    check(load_sharing_figure(six_at_rest(count)), "load-sharing");
  }
  check(system_picture(at_rest(9999)), "system");
}

TEST_CASE("pictures of responses over speed: no text is cut or lies on other text, one torque and six") {
  const std::vector<ResponseResult> one = both_ways(9999), six = six_torques();
  check(response_figure(one, background_of(one)), "fig05");
  check(response_figure(six, background_of(six)), "fig05");
  check(response_figure(six, background_of(six), true), "fig16");
  check(response_figure(one, background_of(one), true), "fig16");
  Figure turned = response_figure(six, background_of(six));
  apply({"rpm:" + kLong[0]}, turned);
  check(turned, "fig05");
}

TEST_CASE("pictures of spectra over speed: no text is cut or lies on other text") {
  const std::vector<SweepResult> sweeps{sweep_at(9999, Direction::up), sweep_at(9999, Direction::down)};
  check(waterfall_figure(sweeps), "waterfall");
  check(waterfall_figure({sweeps[0]}), "waterfall");
}

TEST_CASE("pictures of motions: no text is cut or lies on other text") {
  const std::vector<ResponseResult> one = both_ways(9999), six = six_torques();
  check(order_figure(one), "order-cuts");
  Figure levels = order_figure(one);
  apply({"rpm:" + kLong[1], 1e-6}, levels);
  check(levels, "order-cuts");
  const std::vector<SweepResult> sweeps{sweep_at(9999, Direction::up), sweep_at(9999, Direction::down)};
  CaptionSources tell;
  tell.impacts = {ring_down_at(9999)};
  check(impact_figure(tell.impacts[0]), "ring-down");
  tell.scenes.assign(2, kScene);
  check(dynamic_load_figure(sweeps, tell), "tooth-loads");
  check(vibration_figure(sweeps, 5500, tell), "fig08");
  check(tooth_load_figure(sweeps, 5500, tell), "fig10");
  check(root_stress_figure(at_rest(9999), one), "root-stress");
  check(flank_pressure_figure(at_rest(9999), one), "flank-pressure");
  check(efficiency_figure(six_at_rest(), six), "efficiency");
}

TEST_CASE("pictures: every figure and every template has a case") {
  std::string cases;
  for (const auto& file : std::filesystem::directory_iterator("tests/features"))
    if (file.path().filename().string().starts_with("test_pictures")) {
      std::ifstream source(file.path());
      cases.append(std::istreambuf_iterator<char>(source), {});
    }
  std::set<std::string> names;
  for (const auto& [name, drawing] : drawings()) names.insert(name);
  for (const auto& file : std::filesystem::directory_iterator("pipelines/plots"))
    if (file.path().extension() == ".gp" && file.path().stem() != "common" && file.path().stem() != "panels")
      names.insert(file.path().stem());
  CHECK(names.size() > 30);
  for (const std::string& name : names)
    CHECK_MESSAGE(contains(cases, ", \"" + name + "\");"), "no case draws ", name);
}
