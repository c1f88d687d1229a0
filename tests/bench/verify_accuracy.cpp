// Whether an accepted error is kept: each scene is swept with the settings that [accuracy] chooses and with far finer ones, and the largest
// difference of the RMS of the transmission error over the speeds of both is told, with CPU times.
//
// Runs and their reference are those of bench/accuracy_runs.h; the bounds of the reference are a quarter of the least accepted error. Its
// discretisation a scene leaves out; 1 % is chosen as by scenes that say nothing.
// Above the accepted error: what each setting alone changes when it is that of the reference.
// Cheapest: of the settings for 1.4, 2, 2.8 ... 11 times the accepted error those that keep it with the least time.
//
// Reads   scenes, whose paths are its arguments; "random:7", "random-helical:0-3": legal pairs that it makes up, by their index
// Writes  a table on standard output; status 1 if an error is above twice the accepted one, or above it in more than 5 %
// Example: build/bin/whine-verify-accuracy 2,0.5 data/scenes/first-pair.toml random:0-1
#include <cstdio>
#include <filesystem>
#include <numbers>
#include <random>
#include <sstream>

#include "base/error.h"
#include "bench/accuracy_runs.h"
#include "gear/involute.h"
#include "gear/scene_geometry.h"

namespace {

using namespace whine;

struct Verdict {
  int runs = 0, above = 0, far_above = 0;
};

// Takes one setting of another scene over.
using TakeSetting = void (*)(Scene&, const Scene&);
constexpr std::pair<const char*, TakeSetting> kSettings[] = {
    {"elements", [](Scene& to, const Scene& of) { to.body.element_modules = of.body.element_modules; }},
    {"modes", [](Scene& to, const Scene& of) { to.body.modes = of.body.modes; }},
    {"flank points", [](Scene& to, const Scene& of) { to.body.flank_points = of.body.flank_points; }},
    {"strips", [](Scene& to, const Scene& of) { to.contact.strips = of.contact.strips; }},
    {"face points", [](Scene& to, const Scene& of) { to.contact.face_points = of.contact.face_points; }},
    {"steps", [](Scene& to, const Scene& of) { to.time.min_sample_rate = of.time.min_sample_rate; }},
    {"periodicity", [](Scene& to, const Scene& of) { to.time.periodicity = of.time.periodicity; }}};

void tell_causes(const Scene& chosen, const SceneRun& own, const Scene& reference) {
  std::printf("  alone as the reference:");
  for (const auto& [name, take] : kSettings) {
    Scene other = chosen;
    take(other, reference);
    const RmsDifference found = difference(own.response, run_scene(other).response);
    std::printf(" %s %.3f %% at %.0f Hz;", name, found.most * 100, found.mesh_frequency);
  }
  std::printf("\n");
}

void verify(const std::string& name, const Scene& whole, const std::vector<double>& accepted,
            Verdict& verdict) {
  const Scene scene = at_few_speeds(whole);
  const Scene reference = reference_of(scene, *std::min_element(accepted.begin(), accepted.end()));
  const SceneRun fine = run_scene(reference);
  for (const double error : accepted) {
    const Scene chosen = error == kAcceptedError ? unasked(scene) : accepting(scene, error);
    const SceneRun own = run_scene(chosen);
    const RmsDifference found = difference(own.response, fine.response);
    double cheapest = own.seconds;
    for (double looser = std::numbers::sqrt2; looser < 12 && found.most <= error;
         looser *= std::numbers::sqrt2) {
      const SceneRun other = run_scene(accepting(scene, std::min(0.5, error * looser)));
      if (difference(other.response, fine.response).most > error) break;
      cheapest = std::min(cheapest, other.seconds);
    }
    ++verdict.runs;
    verdict.above += found.most > error;
    verdict.far_above += found.most > 2 * error;
    const double bound = discretisation_plan(chosen, no_key).error();
    std::printf("%-26s %8.2f %8.3f %7.0f %6d %6.2f %5.1f %5d %6d %6.0f %8.1f %8.1f %6.2f %9.1f\n",
                name.c_str(), error * 100, found.most * 100, found.mesh_frequency, found.compared,
                bound * 100, 1 / chosen.body.element_modules, chosen.body.modes, chosen.contact.strips,
                chosen.time.min_sample_rate / 1e3, own.seconds, cheapest, own.seconds / cheapest,
                fine.seconds);
    if (found.most > error) tell_causes(chosen, own, reference);
    std::fflush(stdout);
  }
}

// A legal pair without backlash but for thinned teeth: profile shifts cancel out, 150 to 400 N/mm of face in modules of 3 mm, 5 % damping.
Scene random_pair(std::mt19937& random, bool helical) {
  const auto between = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  for (;;) {
    Scene scene;
    scene.meshes.resize(1);
    const double module = between(1, 6) * 1e-3, shift = between(0, 0.4), width = between(5, 9) * module,
                 helix = helical ? between(10, 25) * std::numbers::pi / 180 : 0;
    for (int g = 0; g < kSides; ++g) {
      SceneGear gear;
      gear.name = kRole[g];
      GearDesign& d = gear.design;
      d.teeth = static_cast<int>(between(18, 60));
      d.module = module;
      d.pressure_angle = 20 * std::numbers::pi / 180;
      d.helix_angle = helix;
      d.hand = g == 0 ? Hand::left : Hand::right;
      d.profile_shift = g == 0 ? shift : -shift;
      d.tooth_thinning = 0.01 * module;
      d.face_width = width;
      d.bore_radius = between(0.4, 0.7) * module * d.teeth / 2;
      gear.material = {206e9, 0.3, 7850, false};
      gear.total_inertia = between(1.1, 3) * least_body_inertia(ToothGeometry(d), gear.material);
      scene.gears.push_back(gear);
      scene.mesh().gear[g] = gear.name;
    }
    const int teeth = scene.gears[0].design.teeth + scene.gears[1].design.teeth;
    scene.mesh().centre_distance = 0.5 * module * teeth / std::cos(helix);
    if (helical) scene.fidelity.width = WidthModel::slices;
    const double f = expected_natural_frequency(scene);
    scene.damping.rayleigh_stiffness = 2 * 0.05 / (2 * std::numbers::pi * f);
    scene.damping.undamped_depth = module / 6;
    scene.operation = {
        {0.25 * f, 1.4 * f, 0.05 * f},
        {between(150e3, 400e3) * module / 3e-3 * width * module * scene.gears[0].design.teeth / 2}};
    try {
      check_geometry(scene, [](const auto&...) { return std::string(); });
      return scene;
    } catch (const Error&) {
    }
  }
}

void verify_made_up(unsigned index, bool helical, const std::vector<double>& accepted, Verdict& verdict) {
  std::mt19937 random(1000 * helical + index);
  const Scene scene = random_pair(random, helical);
  verify(text(helical ? "helical " : "", scene.gears[0].design.teeth, "/", scene.gears[1].design.teeth, " m ",
              std::round(scene.gears[0].design.module * 1e5) / 1e2),
         scene, accepted, verdict);
}

void verify_argument(const std::string& word, const std::vector<double>& accepted, Verdict& verdict) {
  if (!word.starts_with("random")) {
    const std::string name = std::filesystem::path(word).stem();
    return verify(name, read_scene(word), accepted, verdict);
  }
  const std::string range = word.substr(word.find(':') + 1);
  const size_t dash = range.find('-');
  const unsigned long first = std::stoul(range),
                      last = dash == std::string::npos ? first : std::stoul(range.substr(dash + 1));
  for (unsigned long i = first; i <= last; ++i)
    verify_made_up(static_cast<unsigned>(i), word.starts_with("random-helical"), accepted, verdict);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<double> accepted;
  std::istringstream list(argc > 1 ? argv[1] : "");
  for (std::string word; std::getline(list, word, ',');) accepted.push_back(std::stod(word) / 100);
  std::printf("%-26s %8s %8s %7s %6s %6s %5s %5s %6s %6s %8s %8s %6s %9s\n", "scene", "accepted", "true (%)",
              "at Hz", "speeds", "bound", "m / h", "modes", "strips", "kHz", "CPU (s)", "cheapest", "ratio",
              "reference");
  Verdict verdict;
  for (int i = 2; i < argc; ++i) {
    try {
      verify_argument(argv[i], accepted, verdict);
    } catch (const std::exception& e) {
      std::printf("%s: %s\n", argv[i], e.what());
      ++verdict.runs;
      ++verdict.far_above;
    }
  }
  std::printf("%d runs, %d above the accepted error, %d above twice it\n", verdict.runs, verdict.above,
              verdict.far_above);
  return verdict.far_above > 0 || 20 * verdict.above > verdict.runs;
}
