// Studies: what their reader rejects and by which words, what a grid and a sample hold, stage parameters, plans and artifacts.
// Answers beside those of the stages one by one: tests/study.sh.
#include "io/scene.h"
#include "io/study.h"

#include <doctest/doctest.h>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <numbers>
#include <set>

#include "base/error.h"
#include "own_folder.h"
#include "picture_inputs.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "report/gnuplot.h"

using namespace whine;

namespace {

const std::string kScene = std::filesystem::absolute("data/scenes/parker2000-standard-tooth.toml").string();

// A file that goes with its end.
struct Written : TemporaryFolder {
  std::string path;
  explicit Written(const std::string& content, const std::string& name = "study.toml")
      : path(file(name, content)) {}
};

Study study_of(const std::string& content) {
  return read_study(Written("scene = '" + kScene + "'\n" + content).path);
}

// What read_study, or the first variants, reject; the scene stands in line 1.
std::string rejection_of(const std::string& content) {
  const std::string said = message_of([&] {
    const Written file("scene = '" + kScene + "'\n" + content);
    const Study study = read_study(file.path);
    for (long i = 0; i < study.variants; ++i) study_variant(study, i, variant_values(study, i));
  });
  return said.empty() ? said : said.substr(said.find("study.toml") + 10);
}

void rejects(const std::string& content, const std::vector<Field>& fields) {
  CAPTURE(content);
  CHECK(names(rejection_of(content), fields));
}

const std::string kDamping = "[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [4e-6, 5.5e-6]\n";

}  // namespace

TEST_CASE("a study marks two variants to compare: the changes that make scenes of them") {
  const Study study = study_of("compare = [1, 2]\n[set]\nbore_radius_mm = 38\n" + kDamping +
                               "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 150]\n");
  CHECK(design_changes(study, 0) ==
        std::vector<std::string>{"bore_radius_mm=38",
                                 "damping.rayleigh_stiffness_s=" + study.keys[0].values[0],
                                 "operation.torque_Nm=" + study.keys[1].values[1]});
  CHECK(design_changes(study, 1)[1] == "damping.rayleigh_stiffness_s=" + study.keys[0].values[1]);
  for (const char* marked :
       {"[1]", "[1, 1]", "[0, 2]", "[-1, 1]", "[0, 1, 1]", "['a', 'b']", "1", "[0.5, 1]"})
    rejects(std::string("compare = ") + marked + "\n" + kDamping, {":2", "compare", 0, 1});
  CHECK(failure_of([] { design_changes(study_of(kDamping), 0); }) == Failure::input);
}

TEST_CASE("a study that says nothing sensible is rejected by line, value and limit") {
  rejects("", {"nothing", "varies"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stifness_s'\nvalues = [1e-6, 2e-6]\n",
          {":3", "damping.rayleigh_stifness_s", "damping.rayleigh_stiffness_s"});
  rejects("[[vary]]\nkey = 'gear.pinion.rayleigh_stiffness_s'\nvalues = [1e-6, 2e-6]\n",
          {"damping.rayleigh_stiffness_s"});
  rejects("[[vary]]\nkey = 'gear.pinon.bore_radius_mm'\nvalues = [38, 40]\n",
          {0, "gear.pinon.bore_radius_mm", 38});
  rejects("[[vary]]\nkey = 'gear.pinon.bore_radius_mm'\nvalues = [38, 40]\n", {"[gear.pinon]", "pinion"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = []\n", {":4", "values"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [1e-6]\n", {":2"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [1e-6, 1.0e-6]\n", {"1e-06"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [1e-6, 'much']\n",
          {":4", "values", "damping.rayleigh_stiffness_s", "much"});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [1e-6, 2]\n",
          {":3", 1, "damping.rayleigh_stiffness_s", 2});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalues = [1e-6, 2]\n", {1, "most"});
  rejects(kDamping + kDamping, {"damping.rayleigh_stiffness_s", 3});
  rejects(
      "[[vary]]\nkey = 'bore_radius_mm'\nvalues = [38, 40]\n[[vary]]\nkey = 'gear.wheel.bore_radius_mm'\nvalues = [38, 40]\n",
      {"varies", "twice"});
  rejects("[set]\n'damping.rayleigh_stiffness_s' = 1e-6\n" + kDamping, {"[set]"});
  rejects("[set]\n'damping.rayleigh' = 1e-6\n" + kDamping, {":3", "[set]", "damping.rayleigh"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 200\nto = 100\nstep = 10\n",
          {":5", "operation.torque_Nm"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 100\nto = 200\n", {"step", "count"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 100\nto = 200\nstep = -1\n", {0, "greater"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 100\nto = 200\nstep = 10\ncount = 3\n",
          {"step", "count"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 0\nto = 200\nstep = 100\n", {0, "greater"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 1\nto = 2\nstep = 1e-9\n", {200000, "values"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nmean = 100\ndeviation = 10\n", {"random", "drawn"});
  rejects("[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [1, 2]\nmean = 100\ndeviation = 10\n", {"ways"});
  rejects("[[vary]]\nkey = 'fidelity.modes'\nvalues = [5, 5.5]\n", {"number", "whole"});
  rejects("[[vary]]\nkey = 'gear.pinion.error.seed'\nfrom = 1\nto = 1e300\ncount = 2\n", {2147483647});
  rejects("[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nvalue = [5, 5.5]\n",
          {":4", "value", "[[vary]]", "values"});
  rejects("stage = 'sweeps'\n" + kDamping, {":2", "stage", "sweeps"});
  rejects("directions = ['up']\n" + kDamping, {"stage", "sweep"});
  rejects("plan = 'sample'\n" + kDamping, {"samples", "lacks"});
  rejects("plan = 'sample'\nsamples = 0\n" + kDamping, {1, 200000});
  rejects("samples = 5\n" + kDamping, {"sample"});
  rejects("quantities = ['te_peak_to_peek']\n" + kDamping, {"te_peak_to_peak"});
  rejects("answers=['rms_max_up']\n" + kDamping, {"quantities"});
  rejects("quantities = ['rms_max_up']\n" + kDamping, {"rms_max_up"});
  rejects("[figure]\nkeys = ['damping']\n" + kDamping, {"varied", "key"});
  rejects("[figure]\nkeys = ['gear.pinion.error.seed']\n" + kDamping +
              "[[vary]]\nkey = 'gear.pinion.error.seed'\nvalues = [1, 2]\n",
          {"varied", "key"});
  const std::string torque = "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [1, 2]\n",
                    map = "[figure]\nmap = ['te_mean', 'damping.rayleigh_stiffness_s']\n";
  rejects(map + kDamping, {":3", "map", "two", 1});
  rejects(map + "colour = 'operation.torque_Nm'\n" + kDamping + torque, {":4", "colour", "map"});
  rejects("[figure]\nmap = ['te_mean']\n" + kDamping + torque, {":3", "map", "two", 1});
  rejects("[figure]\nmap = ['te_mean', 'te_meen']\n" + kDamping + torque, {":3", "te_meen", "te_mean"});
  rejects("tilte = 'x'\n" + kDamping, {":2", "tilte", "title"});
  rejects(
      "plan = 'sample'\nsamples = 5\n[[vary]]\nkey = 'operation.torque_Nm'\nmean = 100\ndeviation = 1\nleast = 150\n",
      {"hardly", "leave"});
  rejects("title\n", {":2"});
  std::string wide = "[[vary]]\nkey = 'operation.torque_Nm'\nfrom = 1\nto = 1000\nstep = 1\n";
  wide += "[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nfrom = 1e-6\nto = 1e-5\ncount = 1000\n";
  wide += "[[vary]]\nkey = 'damping.bearing_ratio'\nfrom = 0.001\nto = 0.1\ncount = 1000\n";
  rejects(wide, {1000000000, 200000});
  CHECK(rejection_of(kDamping) == "");
}

TEST_CASE("a grid holds all combinations, the last key fastest") {
  const Study study = study_of(
      "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 150.0]\n"
      "[[vary]]\nkey = 'gear.pinion.modification.tip_relief_um'\nfrom = 0\nto = 0.3\nstep = 0.1\n"
      "[set]\n'gear.pinion.modification.tip_relief_start_deg' = 22\n");
  REQUIRE(study.variants == 8);
  std::set<std::vector<std::string>> seen;
  for (long i = 0; i < study.variants; ++i) seen.insert(variant_values(study, i));
  CHECK(seen.size() == 8);
  CHECK(variant_values(study, 0) == std::vector<std::string>{"100", "0"});
  CHECK(variant_values(study, 3) == std::vector<std::string>{"100", "0.3"});  // not 0.30000000000000004
  CHECK(variant_values(study, 4) == std::vector<std::string>{"150", "0"});
  const StudyVariant third = study_variant(study, 7, variant_values(study, 7));
  CHECK(third.torque == 150);
  CHECK(third.scene.operation.torques.front() == 100);  // which sets the dampers
  // The wheel is like the pinion.
  for (int g = 0; g < kSides; ++g)
    CHECK(third.scene.mesh().modification[g].tip.amount == relative(0.3e-6, 1e-15));
}

TEST_CASE("variants are the scene as if their keys were edited in it") {
  const Study study = study_of(
      "[set]\n[set.fidelity]\ncontact = 'line'\n[[vary]]\nkey = 'gear.wheel.bore_radius_mm'\nvalues = [35, 40]\n"
      "[[vary]]\nkey = 'mesh.corner_contact'\nvalues = [true, 5.0]\n");
  const Scene base = read_scene(kScene), first = study_variant(study, 1, variant_values(study, 1)).scene,
              last = study_variant(study, 2, variant_values(study, 2)).scene;
  CHECK(first.gear("wheel").design.bore_radius == 0.035);
  CHECK(first.gear("pinion").design.bore_radius == base.gear("pinion").design.bore_radius);
  CHECK(first.mesh().corner.largest_angle == relative(5 * std::numbers::pi / 180, 1e-15));
  CHECK(first.fidelity.contact == ContactModel::line);
  CHECK(!study.keys[1].number);
  // A variant with the scene's own values is the scene, stage parameters and all.
  CHECK(body_parameters(last, "wheel") == body_parameters(base, "wheel"));
  CHECK(body_parameters(last, "wheel") == body_parameters(base, "pinion"));
}

TEST_CASE(
    "draws keep within their bounds, are what their seed says, and a longer sample begins with a shorter one") {
  const auto sample = [](int samples, int seed) {
    return study_of("plan = 'sample'\nsamples = " + std::to_string(samples) +
                    "\nseed = " + std::to_string(seed) +
                    "\n[[vary]]\nkey = 'damping.rayleigh_stiffness_s'\nmean = 6e-6\ndeviation = 1e-6\n"
                    "[[vary]]\nkey = 'operation.torque_Nm'\nmean = 100\ndeviation = 30\nleast = 90\n"
                    "[[vary]]\nkey = 'damping.bearing_ratio'\nfrom = 0.001\nto = 0.009\n"
                    "[[vary]]\nkey = 'gear.pinion.error.seed'\nfrom = 1\nto = 4\n"
                    "[[vary]]\nkey = 'fidelity.contact'\nvalues = ['line', 'strips']\n");
  };
  const int n = 4000;
  const Study study = sample(n, 1), other = sample(50, 2), shorter = sample(50, 1);
  REQUIRE(study.variants == n);
  double sum = 0, squares = 0, least_torque = HUGE_VAL, low = HUGE_VAL, high = 0, line = 0;
  std::set<std::string> seeds;
  int same = 0;
  for (long i = 0; i < n; ++i) {
    const std::vector<std::string> values = variant_values(study, i);
    const double eta = std::stod(values[0]), ratio = std::stod(values[2]);
    sum += eta;
    squares += eta * eta;
    least_torque = std::min(least_torque, std::stod(values[1]));
    low = std::min(low, ratio);
    high = std::max(high, ratio);
    seeds.insert(values[3]);
    line += values[4] == "'line'" || values[4] == "\"line\"";
    if (i >= 50) continue;
    CHECK(variant_values(shorter, i) == values);
    same += variant_values(other, i) == values;
  }
  const double mean = sum / n, deviation = std::sqrt(squares / n - mean * mean);
  CHECK(same == 0);
  CHECK(mean == relative(6e-6, 0.01));  // 4 standard errors
  CHECK(deviation == relative(1e-6, 0.045));
  CHECK(least_torque >= 90);
  CHECK(low >= 0.001);
  CHECK(low < 0.0011);
  CHECK(high <= 0.009);
  CHECK(high > 0.0089);
  CHECK(seeds == std::set<std::string>{"1", "2", "3", "4"});
  CHECK(line / n == relative(0.5, 0.065));
}

TEST_CASE("stage parameters of variants depend on what their stage computes, on nothing else") {
  const Scene scene = read_scene(kScene);
  Scene damped = scene;
  damped.damping.rayleigh_stiffness *= 2;
  CHECK(variant_stage_parameters(scene, 150, {}) == variant_stage_parameters(damped, 150, {}));
  CHECK(variant_stage_parameters(scene, 150, {Direction::up}) !=
        variant_stage_parameters(damped, 150, {Direction::up}));
  CHECK(variant_stage_parameters(scene, 150, {}) != variant_stage_parameters(scene, 151, {}));
  Scene relieved = scene;
  relieved.mesh().modification[0].tip.amount = 1e-6;
  CHECK(variant_stage_parameters(scene, 150, {}) != variant_stage_parameters(relieved, 150, {}));
  const Written file(variant_stage_parameters(relieved, 150, {Direction::up, Direction::down}), "slice.toml");
  const VariantParameters settings = read_variant_parameters(file.path);
  CHECK(settings.torque == 150);
  CHECK(settings.directions == std::vector<Direction>{Direction::up, Direction::down});
  CHECK(settings.motion.reference_torque == 100);
  CHECK(settings.statics.mesh.modification[0].tip.amount == 1e-6);
  CHECK(settings.motion.damping.rayleigh_stiffness == scene.damping.rayleigh_stiffness);
  CHECK(settings.motion.frequency_to == 4000);
}

TEST_CASE("plans come back as they were written") {
  const Study study = study_of("stage = 'sweep'\ntitle = 'Quotes \"and\" more'\n" + kDamping +
                               "[[vary]]\nkey = 'mesh.corner_contact'\nvalues = [true, 5.0]\n");
  std::vector<GatheredVariant> variants;
  for (long i = 0; i < study.variants; ++i)
    variants.push_back({"abcd" + std::to_string(i), variant_values(study, i)});
  const Written file(plan_text(study, variants), "plan.toml");
  const auto [plan, back] = read_plan(file.path);
  CHECK(plan_text(plan, back) == plan_text(study, variants));
  CHECK(plan.keys[0].units == "s");
  CHECK(!plan.marks_outside);
  const Study mapped = study_of("stage = 'sweep'\n" + kDamping +
                                "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 200]\n[figure]\n"
                                "map = ['operation.torque_Nm', 'rayleigh_damping_ratio']\n");
  const Written map(plan_text(mapped, {{"abcd0", variant_values(mapped, 0)}}), "plan.toml");
  CHECK(read_plan(map.path).first.figure_map ==
        std::vector<std::string>{"operation.torque_Nm", "rayleigh_damping_ratio"});
  const Study marking = study_of("outside_model = 'mark'\n" + kDamping);
  const Written marked(plan_text(marking, {{"abcd0", variant_values(marking, 0)}}), "plan.toml");
  CHECK(read_plan(marked.path).first.marks_outside);
  const Written other("title = 'x'\n", "plan.toml");
  CHECK_THROWS_AS(read_plan(other.path), Error);
}

TEST_CASE("a plan with a response quantity, direction or key that the study does not have is rejected") {
  const Study study = study_of("stage = 'sweep'\nquantities = ['rms_max_up', 'jumps_up']\n" + kDamping);
  std::vector<GatheredVariant> variants;
  for (long i = 0; i < study.variants; ++i)
    variants.push_back({"abcd" + std::to_string(i), variant_values(study, i)});
  const auto rejected = [&](const std::function<void(StudyPlan&)>& change) {
    StudyPlan plan = study;
    change(plan);
    const Written file(plan_text(plan, variants), "plan.toml");
    return names(message_of([&] { read_plan(file.path); }), {"study", "plan"});
  };
  CHECK_FALSE(rejected([](StudyPlan&) {}));
  CHECK(rejected([](StudyPlan& plan) { plan.quantities.push_back("rms_max_sideways"); }));
  CHECK(rejected([](StudyPlan& plan) { plan.directions = {Direction::down}; }));
  CHECK(rejected([](StudyPlan& plan) { plan.figure_quantities = {"te_mean"}; }));
  CHECK(rejected([](StudyPlan& plan) { plan.figure_keys = {"fidelity.contact"}; }));
  CHECK(rejected([](StudyPlan& plan) { plan.figure_colour = "fidelity.contact"; }));
}

TEST_CASE("no figure of a study stands against a seed, as long as anything else varies") {
  const std::string seeds =
      "[[vary]]\nkey = 'gear.pinion.error.seed'\nvalues = [1, 2]\n[[vary]]\nkey = 'gear.wheel.error.seed'\nvalues = [3, 4]\n";
  const Study study = study_of(seeds + kDamping);
  CHECK(study.figure_keys == std::vector<std::string>{"damping.rayleigh_stiffness_s"});
  CHECK(study.figure_colour.empty());
  CHECK(study_of(seeds).figure_keys.size() == 2);
}

TEST_CASE("the study of tolerances draws the errors of both gears") {
  const Study study = read_study("data/studies/tolerances.toml");
  CHECK(study.variants >= 30);
  for (const std::string gear : {"pinion", "wheel"})
    for (const std::string key : {"iso_share", "seed"}) {
      const std::string name = "gear." + gear + ".error." + key;
      CHECK(std::any_of(study.keys.begin(), study.keys.end(), [&](const auto& k) { return k.name == name; }));
    }
}

namespace {

Study study_of_train(const std::string& content) {
  const std::string scene = std::filesystem::absolute("data/scenes/oh58-planetary.toml").string();
  return read_study(Written("scene = '" + scene + "'\n" + content).path);
}
const std::string kPin = "[[vary]]\nkey = 'pin.planet2.tangential_um'\nvalues = [0, 20]\n";

}  // namespace

TEST_CASE(
    "a study of a train: quantities of meshes, bodies and shared meshes; its variants are the scene with edited lists") {
  const Study study = study_of_train(
      "quantities = ['load_sharing_factor.sun-planet', 'te_peak_to_peak.planet4-ring', 'bearing_force_static.sun']\n" +
      kPin +
      "[[vary]]\nkey = 'drive.sun.torque_Nm'\nvalues = [300, 500]\n[set]\n'mesh.planet-ring.corner_contact' = false\n");
  REQUIRE(study.variants == 4);
  CHECK(study.train.meshes.size() == 8);
  CHECK(study.train.shared == std::vector<std::string>{"sun-planet", "planet-ring"});
  const StudyVariant last = study_variant(study, 3, variant_values(study, 3)),
                     first = study_variant(study, 0, variant_values(study, 0));
  REQUIRE(!last.scene.pair());
  CHECK(last.layout.torque(0) == 500);
  CHECK(std::hypot(last.layout.bodies[2].offset[0], last.layout.bodies[2].offset[1]) ==
        relative(20e-6, 1e-12));
  CHECK(last.scene.meshes[0].spec.corner.enabled);
  CHECK(!last.scene.meshes[1].spec.corner.enabled);
  // The pin of variant 0 stands where the drawing has it: the scene itself, but for torque and corners.
  CHECK(first.layout.bodies[2].offset == std::array{0.0, 0.0});
  const Written file(variant_stage_parameters(last, {Direction::down}), "variant.toml"),
      rest(variant_stage_parameters(last, {}), "variant.toml");
  const VariantParameters moving = read_variant_parameters(file.path),
                          still = read_variant_parameters(rest.path);
  CHECK(moving.of_train());
  CHECK(moving.directions == std::vector<Direction>{Direction::down});
  CHECK(moving.train.frequency_to == 6000);
  CHECK(moving.train.layout.bodies[2].offset == last.layout.bodies[2].offset);
  CHECK(still.directions.empty());
  CHECK(train_names(still.train) == study.train);
}

TEST_CASE(
    "a study of a train rejects quantities that it does not have, rigid gears and sweeps without speeds") {
  const auto why = [](const std::string& content) { return message_of([&] { study_of_train(content); }); };
  CHECK(names(why("quantities = ['te_peak_to_peak']\n" + kPin), {":2", "te_peak_to_peak"}));
  CHECK(names(why("quantities = ['te_peak_to_peak.sun-planet5']\n" + kPin), {"te_peak_to_peak.sun-planet1"}));
  CHECK(names(why("quantities = ['rms_max_up.sun-planet1']\n" + kPin), {":2", "rms_max_up.sun-planet1"}));
  CHECK(why("stage = 'sweep'\nquantities = ['rms_max_up.sun-planet1']\n" + kPin).empty());
  CHECK(names(why("[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [1, 2]\n"), {":3", "[[drive]]"}));
  for (const auto& [scene, word] :
       {std::pair{"oh58-planetary-rigid", "rigid"}, std::pair{"lin-parker-planetary", "rigid"}}) {
    const std::string path =
        std::filesystem::absolute(std::string("data/scenes/") + scene + ".toml").string();
    const Written file("scene = '" + path + "'\n[[vary]]\nkey = 'module_mm'\nvalues = [2, 3]\n");
    CHECK(names(message_of([&] { read_study(file.path); }), {":1", word}));
  }
}

TEST_CASE("the plan of a study of a train comes back as it was written") {
  const Study study = study_of_train("stage = 'sweep'\n" + kPin);
  std::vector<GatheredVariant> variants;
  for (long i = 0; i < study.variants; ++i)
    variants.push_back({"abcd" + std::to_string(i), variant_values(study, i)});
  const Written file(plan_text(study, variants), "plan.toml");
  const auto [plan, back] = read_plan(file.path);
  CHECK(plan.train == study.train);
  CHECK(plan_text(plan, back) == plan_text(study, variants));
}

TEST_CASE("what is gathered of a study comes back from its artifact") {
  StudyResult a;
  a.plan = study_of("stage = 'sweep'\n" + kDamping +
                    "[[vary]]\nkey = 'mesh.corner_contact'\nvalues = [true, 5.0]\n");
  a.plan.quantities = {"rms_max_up", "jumps_up"};
  a.plan.figure_quantities = a.plan.quantities;
  for (const char* eta : {"4e-06", "5.5e-06"})
    for (const char* corner : {"true", "5"})
      a.variants.push_back({std::string("ab") + eta + corner, {eta, corner}});
  a.quantity = MatrixRM::Random(4, 2);
  a.quantity.row(2).setZero();
  a.rejection = {"", "", "it jams", ""};
  a.unsteady = Eigen::Vector4i(0, 3, 0, 0);
  const Written file("", "study.h5");
  write(file.path, a, {"test", "test", {}, {}});
  const StudyResult b = read<StudyResult>(file.path);
  CHECK(b.quantity == a.quantity);
  CHECK(b.rejection == a.rejection);
  CHECK(b.unsteady == a.unsteady);
  REQUIRE(b.variants.size() == 4);
  for (size_t v = 0; v < 4; ++v) {
    CHECK(b.variants[v].name == a.variants[v].name);
    CHECK(b.variants[v].values == a.variants[v].values);
  }
  const Figure figure = study_figure(b);
  REQUIRE(figure.blocks[0].rows.size() == 4);
  CHECK(figure.blocks[0].rows[2][1] == 1);  // marked
  CHECK(figure.blocks[0].rows[1][2] == 3);
  CHECK(contains(figure.notes[0], "1 has speeds that did not settle"));
  size_t drawn = 0, crossed = 0;
  for (const auto& row : figure.blocks[1].rows) {
    drawn += !row.empty();
    crossed += !row.empty() && row[3] > 0;
  }
  CHECK(drawn == 3);
  CHECK(crossed == 1);
  StudyResult steady = b;
  steady.unsteady.setZero();
  CHECK(!contains(study_figure(steady).notes[0], "settle"));
  StudyResult none = b;
  none.rejection = {"a", "b", "c", "d"};
  CHECK_THROWS_AS(study_figure(none), Error);
}

TEST_CASE("keys without effect: those of variants that differ in them alone and are the same") {
  const Study study = study_of(kDamping + "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 200]\n");
  const std::string damping = study.keys[0].name;
  const std::vector<GatheredVariant> grid{
      {"aa", {"4e-06", "100"}}, {"bb", {"4e-06", "200"}}, {"aa", {"5e-06", "100"}}, {"bb", {"5e-06", "200"}}};
  CHECK(keys_without_effect(study, grid) == std::vector<std::string>{damping});
  std::vector<GatheredVariant> acts = grid;
  acts[3].name = "cc";  // at one torque of two
  CHECK(keys_without_effect(study, acts).empty());
  // Where no two variants differ in one key alone nothing is known.
  CHECK(keys_without_effect(study, {grid[0], grid[3]}).empty());
}

TEST_CASE("a study's figure has no panel for what never varies and no column for a key that does nothing") {
  StudyResult a;
  a.plan = study_of(kDamping + "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 200]\n");
  REQUIRE(a.plan.quantities[0] == "contact_ratio");
  for (const char* eta : {"4e-06", "5e-06"})
    for (const char* torque : {"100", "200"})
      a.variants.push_back({std::string("ab") + torque, {eta, torque}});
  a.rejection.resize(4);
  a.unsteady = Eigen::VectorXi::Zero(4);
  a.quantity = MatrixRM::Constant(4, static_cast<Eigen::Index>(a.plan.quantities.size()), 1.7);
  a.quantity.rightCols(a.quantity.cols() - 1) = MatrixRM::Random(4, a.quantity.cols() - 1);
  const Figure figure = study_figure(a);
  // Another answer has taken the place. The last panel is the legend.
  CHECK(figure.panels.size() == a.plan.figure_quantities.size() + 1);
  CHECK(figure.panels.back().bare);
  CHECK(figure.columns == 1);
  REQUIRE(figure.notes.size() >= 2);
  CHECK(contains(figure.notes[1], "contact ratio 1.7"));
  CHECK(contains(figure.notes[1], a.plan.keys[0].name + " changes nothing"));
  for (const FigureBlock& block : figure.blocks)
    if (block.name.starts_with("panel")) CHECK(block.columns[1] != "contact_ratio");
  a.quantity.setConstant(1.7);
  const Figure level = study_figure(a);
  CHECK(std::count_if(level.blocks.begin(), level.blocks.end(),
                      [](const FigureBlock& block) { return block.name.starts_with("panel"); }) == 1);
}

TEST_CASE("a study's figure shows words of the study and runs none of them") {
  const TemporaryFolder folder;
  const std::string mark = folder / "mark";
  const std::string command = "touch " + mark;
  StudyResult a;
  a.plan = study_of("[[vary]]\nkey = 'fidelity.contact'\nvalues = ['strips', 'line']\n");
  a.plan.title = "`" + command + "`";
  const std::vector<std::string> levels{"5 % of _it_", "`" + command + "`",
                                        "\" 1); system(\"" + command + "\"); set xtics (\""};
  for (const std::string& level : levels) a.variants.push_back({"ab" + level, {level}});
  a.rejection.resize(3);
  a.unsteady = Eigen::VectorXi::Zero(3);
  a.quantity = MatrixRM::Random(3, static_cast<Eigen::Index>(a.plan.quantities.size()));
  const Figure figure = study_figure(a);
  const Written table(plot_data(figure), "study.tsv");
  const std::string svg =
      draw(figure, table.path, template_of(figure, "pipelines/plots", "study"), Picture::svg);
  CHECK(contains(svg, "5 % of _it_"));
  CHECK(contains(svg, "system("));
  CHECK(!std::filesystem::exists(mark));
}

TEST_CASE("a study's figure: vibration from 0 on, units as text has them") {
  StudyResult a;
  a.plan = study_of(
      "stage = 'sweep'\nquantities = ['rms_max_up']\n"
      "[[vary]]\nkey = 'gear.pinion.modification.tip_relief_um'\nvalues = [5, 10]\n");
  for (const char* level : {"5", "10"}) a.variants.push_back({std::string("ab") + level, {level}});
  a.rejection.resize(2);
  a.unsteady = Eigen::VectorXi::Zero(2);
  a.quantity = MatrixRM::Constant(2, 1, 7e-6);
  a.quantity(1, 0) = 8e-6;
  const Figure figure = study_figure(a);
  const std::string data = plot_data(figure);
  CHECK(contains(data, "tip_relief_um [µm]\trms_max_up [µm]"));
  const Written table(data, "study.tsv");
  const std::string svg =
      draw(figure, table.path, template_of(figure, "pipelines/plots", "study"), Picture::svg);
  CHECK(contains(svg, ">0</tspan>"));
}

TEST_CASE("a study's figure of many keys: numbers below an axis stand apart") {
  StudyResult a;
  a.plan = study_of(kDamping +
                    "[[vary]]\nkey = 'operation.torque_Nm'\nvalues = [100, 200, 300, 400]\n"
                    "[[vary]]\nkey = 'damping.bearing_ratio'\nvalues = [0.2, 0.4, 0.7, 1.0]\n"
                    "[[vary]]\nkey = 'damping.rayleigh_mass_per_s'\nvalues = [0.2, 0.4, 0.7, 1.0]\n");
  const char* levels[4][4] = {{"3.4e-06", "100", "0.2", "0.7"},
                              {"3.9e-06", "200", "0.4", "1"},
                              {"4.4e-06", "300", "0.7", "0.2"},
                              {"5e-06", "400", "1", "0.4"}};
  for (const auto& level : levels)
    a.variants.push_back({std::string("ab") + level[1], {level[0], level[1], level[2], level[3]}});
  a.rejection.resize(4);
  a.unsteady = Eigen::VectorXi::Zero(4);
  a.quantity = MatrixRM::Random(4, static_cast<Eigen::Index>(a.plan.quantities.size()));
  const Figure figure = study_figure(a);
  for (const std::string& fault : pictures::faults(figure, "study"))  // names at the left edge are cut
    CHECK_MESSAGE(contains(fault, "cut: "), fault);
}

TEST_CASE("rank correlation: known values, ties, what does not vary") {
  CHECK(rank_correlation({1, 2, 3, 4}, {1, 8, 27, 64}) == relative(1.0, 1e-15));
  CHECK(rank_correlation({1, 2, 3, 4}, {9, 7, 3, 1}) == relative(-1.0, 1e-15));
  CHECK(rank_correlation({1, 2, 3, 4, 5}, {2, 1, 4, 3, 5}) == relative(0.8, 1e-14));  // 1 - 6 x 4 / (5 x 24)
  CHECK(rank_correlation({1, 2, 2, 3}, {1, 2, 3, 4}) ==
        relative(0.9486832980505138, 1e-14));  // R: cor(method = "spearman")
  CHECK(rank_correlation({1, 1, 1}, {1, 2, 3}) == 0);
}
