// What make is given, as data: characters, targets, variables, numbers, files; and goals that a scene cannot reach.
#include <doctest/doctest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/make_request.h"
#include "io/scene.h"
#include "io/scene_goals.h"
#include "own_folder.h"
#include "refusal.h"

using namespace whine;

namespace {

void write_file(const std::string& path, const std::string& content) {
  if (const auto folder = std::filesystem::path(path).parent_path(); !folder.empty())
    std::filesystem::create_directories(folder);
  std::ofstream(path) << content;
}

bool begins(const std::string& said, const std::string& words) {
  INFO(said);
  return said.rfind(words, 0) == 0;
}

struct Project : OwnFolder {
  Project() {
    write_file("Makefile", "help: ## print this list\n");
    write_file("pipelines/figures.mk", "report: x ## a page\nstudy loaded: ##\nhelper: x\n");
    write_file("pipelines/help.txt", "Figures\n  report\n  fig05: a figure\n  fig07-600: another: of two\n");
    write_file("data/scenes/pair.toml", "of the project");
    write_file("data/studies/widths.toml", "");
    write_file("own.toml", "my own");
  }
  std::string said(const std::string& goals, const std::vector<std::string>& given = {}) const {
    return wrong_with(goals, given);
  }
};

}  // namespace

TEST_CASE("names that a shell or make would obey are rejected whole, wherever they stand") {
  const Project project;
  for (const char* name : {"$(touch mark).toml",
                           "${x}.toml",
                           "`touch mark`.toml",
                           "'; touch mark; '.toml",
                           "a\"b.toml",
                           "p%/s.toml",
                           "b\\s.toml",
                           "a#/s.toml",
                           "a=b.toml",
                           "a&b.toml",
                           "a|b.toml",
                           "a:b.toml",
                           "~/s.toml",
                           "a*.toml",
                           "a?.toml",
                           "[a].toml",
                           "{a,b}.toml",
                           "a!.toml",
                           "a>b.toml",
                           "a<b.toml",
                           "a^b.toml"})
    for (const char* variable : {"SCENE", "STUDY"}) {
      const std::string said = project.said("report", {std::string(variable) + "=" + name});
      CHECK(begins(said, std::string(variable) + "=" + name + ": it holds "));
      CHECK(said.find("and may hold letters, digits and . _ - + , @ / only; rename the file or its folder") !=
            std::string::npos);
    }
  CHECK(begins(project.said("out/a/T1;touch${IFS}mark;/static.h5"),
               "target out/a/T1;touch${IFS}mark;/static.h5: it holds ; $ { }"));
  for (const char* scene : {"SCENE=a\nb.toml", "SCENE=a\\nb.toml"})
    CHECK(begins(project.said("report", {scene}), "SCENE: it holds a line break"));
  CHECK(begins(project.said("report", {"SCENE=\x1b[31m.toml"}), "SCENE: it holds a control character"));
  CHECK(begins(project.said("report", {"TORQUE=1 2"}),
               "TORQUE=1 2: it holds blanks, and may hold letters, digits and . _ - + , @ only"));
  CHECK(begins(project.said("report", {"TORQUE=../.."}), "TORQUE=../..: it holds /"));
  CHECK(begins(project.said("report", {"DAMPING=5%"}), "DAMPING=5%: it holds %"));
  CHECK(project.said("report", {"JUMP_MAP_TORQUES=50 80", "AXIS=rpm:sun", "LAUNCH=srun -n1 | cat"}).empty());
  CHECK(project.said("report", {"SCENE=own.toml"}).empty());
  write_file("mü/ß@a+b,c/own_1.toml", "");
  CHECK(project.said("report", {"SCENE=mü/ß@a+b,c/own_1.toml"}).empty());
}

TEST_CASE("variables of the environment are judged like those of the command line, which come first") {
  const Project project;
  ::setenv("SCENE", "$(touch mark).toml", 1);
  CHECK(begins(project.said("report"), "SCENE=$(touch mark).toml: it holds $ ( )"));
  CHECK(project.said("report", {"SCENE=own.toml"}).empty());
  ::unsetenv("SCENE");
}

TEST_CASE("targets and variables that do not exist get the one that is spelt alike") {
  const Project project;
  constexpr std::pair<const char*, const char*> kFormerTargets[] = {{"system-static", "static"},
                                                                    {"system-sweep", "sweep"},
                                                                    {"system-ringdown", "impact"},
                                                                    {"system-branch", "branches"}};
  for (const auto& [before, now] : kFormerTargets)
    CHECK(
        begins(project.said(before), text(before, ": it is called ", now, " for every scene: make SCENE=")));
  CHECK(begins(project.said("raport"),
               "raport: there is no such target; did you mean report? `make help` lists them"));
  CHECK(begins(project.said("xyzzyq"), "xyzzyq: there is no such target; `make help` lists them"));
  CHECK(begins(project.said("helper"), "helper: there is no such target;"));
  CHECK(
      begins(project.said("fig06"), "fig06: there is no such figure; there are fig05 fig07-600 and table1"));
  CHECK(begins(project.said("own.toml"),
               "own.toml: a scene is given by SCENE in front of a target: make SCENE=own.toml report"));
  CHECK(begins(project.said("report", {"BRANCH=yes"}),
               "BRANCH: there is no such variable; did you mean BRANCHES?"));
  CHECK(project.said("report fig05 pipelines out/pair/T1/static.h5", {"LAUNCH_sweep=srun", "MAKEFLAGS=-k"})
            .empty());
}

TEST_CASE("numbers and words of goals say their range") {
  const Project project;
  const auto said = [](const std::string& goals, const std::vector<std::string>& given) {
    return message_of_input([&] { check_request(make_request("out/x/y " + goals, given)); });
  };
  // the goals here need not be documented
  std::ofstream("Makefile") << "calibrate: ##  x\nhistories: ## x\nsound: ## x\nrunup: ## x\nloaded: ## x\n";
  CHECK(begins(said("calibrate", {"DAMPING=5"}),
               "DAMPING=5: it is a share of critical damping, above 0 and below 1"));
  CHECK(begins(said("calibrate", {"DAMPING=0,05"}), "DAMPING=0,05: it is a share"));
  CHECK(begins(said("histories", {}), "histories: AT=: say the mesh frequency in Hz"));
  CHECK(begins(said("sound", {"AT=fast"}), "sound: AT=fast: say the mesh frequency"));
  CHECK(
      begins(said("sound", {"AT=1300", "RATE=500"}), "sound: AT=1300 and RATE=500: a sound is of one speed"));
  CHECK(begins(said("runup", {"RATE=0"}), "RATE=0: it is the change of the driver's speed in rpm/s"));
  CHECK(begins(said("runup", {"FROM=2400"}), "FROM=2400 TO=: give both or none"));
  CHECK(begins(said("runup", {"WAY=left"}), "WAY=left: it is up or down"));
  CHECK(begins(said("runup", {}), "runup: RATE=: say the rate in rpm/s"));
  CHECK(begins(said("loaded", {"PHASE=1.0"}),
               "PHASE=1.0: it is a share of the mesh period, 0 up to, not including, 1"));
  CHECK(begins(said("loaded", {"TORQUE=080"}), "out/parker2000/T080: the torque in a path"));
  CHECK(begins(said("out/a/T080/static.h5", {}),
               "out/a/T080: the torque in a path is a number in N m as printed by %g"));
  CHECK(begins(said("out/a/Tx/static.h5", {}), "out/a/Tx: the torque"));
  CHECK(begins(said("", {"AXIS=order:1"}), "AXIS=order:1: it is rpm:<gear>"));
  CHECK(begins(said("", {"DB=0"}), "DB=0: it is the length in m that is 0 dB"));
  CHECK(begins(said("", {"JUMP_MAP=finer"}), "JUMP_MAP=finer: it is coarse or fine"));
  CHECK(begins(said("", {"FOLDS_OVER=x"}),
               "FOLDS_OVER=x: it is damping, torque, bearing_stiffness or tip_relief"));
  CHECK(begins(said("", {"VARIANTS=../.."}), "VARIANTS: ../..: write name:key=value"));
  CHECK(begins(said("", {"VARIANTS=../..:a=1"}), "VARIANTS: ../..:a=1: the name '../..' becomes a folder"));
  CHECK(said("calibrate histories loaded runup out/a/T62.5/static.h5 out/a/T1e+06/static.h5",
             {"DAMPING=0.05", "AT=1300", "PHASE=0", "RATE=100", "FROM=1", "TO=2", "DB=1e-6",
              "TORQUE=62.5"}) == "");
}

TEST_CASE("files of scenes, studies and models are there, can be read to the end and take nobody's place") {
  const Project project;
  std::ofstream("Makefile")
      << "report: ## x\ncompare: ## x\nstudy: ## x\nexport: ## x\nsound: ## x\nscorecard: ## x\n";
  CHECK(begins(project.said("report", {"SCENE=none.toml"}), "SCENE=none.toml: there is no such file\n"));
  CHECK(begins(project.said("report", {"SCENE=pair"}),
               "SCENE=pair: there is no such file; there is data/scenes/pair.toml"));
  CHECK(begins(project.said("report", {"SCENE=Makefile"}), "SCENE=Makefile: a scene is a .toml file"));
  CHECK(begins(project.said("report", {"SCENE=-t.toml"}),
               "SCENE=-t.toml: programs take a name that begins with -"));
  REQUIRE(::mkfifo("pipe.toml", 0600) == 0);
  for (const char* given : {"SCENE=pipe.toml", "STUDY=pipe.toml", "MODEL=pipe.toml", "TRANSFER=/dev/zero"})
    CHECK(begins(project.said("report", {given}), std::string(given) + ": it is no regular file"));
  for (const char* name : {"h/.toml", "a.b.toml", "figures.toml"}) write_file(name, "");
  CHECK(
      begins(project.said("report", {"SCENE=h/.toml"}), "SCENE=h/.toml: the file has no name before .toml"));
  CHECK(begins(project.said("report", {"SCENE=a.b.toml"}),
               "SCENE=a.b.toml: the name 'a.b' becomes a folder and a target"));
  CHECK(begins(project.said("report", {"SCENE=figures.toml"}),
               "SCENE=figures.toml: out/figures has another use"));
  write_file("mine/pair.toml", "mine");
  CHECK(begins(project.said("report", {"SCENE=mine/pair.toml"}),
               "SCENE=mine/pair.toml: out/pair is of data/scenes/pair.toml, which says otherwise"));
  write_file("mine/pair.toml", "of the project");
  CHECK(project.said("report", {"SCENE=mine/pair.toml"}).empty());
  CHECK(begins(project.said("scorecard", {"SCENE=own.toml"}), "scorecard: it is what P2000 prints"));

  CHECK(begins(project.said("study"), "study: which study? make study STUDY=<name>; there are: widths"));
  CHECK(begins(project.said("study", {"STUDY=other"}),
               "STUDY=other: there is no data/studies/other.toml; there are: widths"));
  CHECK(begins(project.said("study", {"STUDY=a/b"}), "STUDY=a/b: a study is a .toml file"));
  for (const char* share : {"0/3", "4/3", "1", "1/2/3", "18446744073709551617/18446744073709551617"})
    CHECK(begins(project.said("study", {"STUDY=widths", std::string("SHARE=") + share}),
                 std::string("SHARE=") + share + ": it is i/n"));
  CHECK(project.said("study", {"STUDY=widths", "SHARE=3/10"}).empty());

  CHECK(begins(project.said("compare"), "compare: which scenes? two to six of them"));
  CHECK(begins(project.said("compare", {"SCENES=own.toml none.toml"}),
               "SCENES=none.toml: there is no such file"));
  CHECK(begins(project.said("compare", {"SCENES=data/scenes/pair.toml mine/pair.toml"}),
               "SCENES: two files are called pair.toml"));
  write_file("other/own.toml", "");
  CHECK(begins(
      project.said("report compare", {"SCENE=other/own.toml", "SCENES=own.toml data/scenes/pair.toml"}),
      "SCENE=other/own.toml: out/own is of own.toml, which is compared"));
  CHECK(
      project.said("report compare", {"SCENE=./own.toml", "SCENES=own.toml data/scenes/pair.toml"}).empty());
  CHECK(begins(project.said("export"), "export: which model?"));
  CHECK(begins(project.said("export", {"MODEL=none.rexs"}), "MODEL=none.rexs: there is no such file"));
  CHECK(begins(project.said("sound", {"AT=100", "TRANSFER=none.csv"}),
               "TRANSFER=none.csv: there is no such file"));
}

TEST_CASE("an axis and a speed that a scene does not have are rejected before anything is computed") {
  const std::string pair = "data/scenes/first-pair.toml", train = "data/scenes/oh58-planetary.toml";
  const Scene two = read_scene(pair);
  const Scene planets = read_scene(train);
  const System layout = layout_in(planets, train);
  const auto of_pair = [&](const std::string& axis, double at) {
    return message_of([&] { check_asked({{"report"}, axis, "", at}, two, {}, pair); });
  };
  const auto of_train = [&](const std::string& axis, double at) {
    return message_of([&] { check_asked({{"report"}, axis, "", at}, planets, layout, train); });
  };
  for (const char* axis : {"", "rpm:pinion", "rpm:driven"})
    CHECK(of_pair(axis, two.operation.frequency_from) == "");
  CHECK(begins(of_pair("rpm:sun", 0), "AXIS=rpm:sun: there is no gear sun; there are pinion, wheel"));
  for (const char* axis : {"", "rpm:sun", "rpm:planet3", "rpm:ring"}) CHECK(of_train(axis, 1450) == "");
  CHECK(begins(of_train("rpm:carrier", 0), "AXIS=rpm:carrier: carrier stands still"));
  CHECK(
      begins(of_train("rpm:pinion", 0), "AXIS=rpm:pinion: there is no gear pinion; there are sun, planet1"));
  CHECK(names(of_train("", 1470), {"AT=1470", "1450", 600, 6000, 50}));
  CHECK(names(of_train("", 9000), {"AT=9000", "6000"}));
  CHECK(names(of_train("", 7), {"AT=7", "600 Hz"}));
  const auto mesh = [&](const char* name) {
    return message_of([&] { check_asked({{"sound"}, "", name, 0}, planets, layout, train); });
  };
  CHECK(mesh("planet4-ring") == "");
  CHECK(names(mesh("planet5-ring"), {"MESH=planet5-ring", "sun-planet1", "planet4-ring"}));
}

TEST_CASE("goals that a scene cannot reach name what there is of it") {
  const auto said = [](const std::vector<std::string>& goals, const Traits& scene) {
    return message_of_input([&] { check_goals(goals, scene, "my.toml"); });
  };
  const auto refuses = [&](const std::string& goal, const Traits& scene, const std::string& why) {
    return begins(said({"report", goal}, scene), "SCENE=my.toml: " + goal + " does not take " + why);
  };
  using enum Trait;
  const Traits plain{{pair, ""}};
  CHECK(said({"teeth", "report", "sweep"}, plain) == "");
  CHECK(refuses("modes", plain, "a pair: natural modes are of systems"));
  CHECK(refuses("flank-load", {{train, ""}, {one_slice, ""}},
                "one slice over the face: it carries the same load"));
  CHECK(refuses("efficiency", {{pair, ""}, {no_friction, ""}}, "a scene without friction: "));
  CHECK(refuses("teeth", {{pair, ""}, {unlike_pair, "[gear.a.error]"}},
                "a pair whose teeth differ or are cracked ([gear.a.error]): "));
  CHECK(names(said({"teeth"}, {{pair, ""}, {unlike_pair, "[gear.a.crack]"}}),
              {"cracked", "make SCENE=my.toml report", " crack residual-signal"}));

  const Traits rigid{{rigid_gears, ""}, {no_speeds, ""}, {no_planets, ""}},
      elastic{{train, ""}, {no_speeds, ""}, {no_planets, ""}},
      moving{{train, ""}, {one_slice, ""}, {like_teeth, ""}};
  const std::vector<std::string> all{"report",      "mesh",          "reduce",      "static",       "sweep",
                                     "impact",      "branches",      "order-cuts",  "load-sharing", "modes",
                                     "mode-shapes", "runup",         "sound",       "harris-map",   "compare",
                                     "histories",   "motion-errors", "error-budget"};
  CHECK(said(all, moving) == "");
  CHECK(said({"teeth"}, {{train, ""}, {differing, ""}}) == "");
  CHECK(said({"report", "modes", "mode-shapes"}, rigid) == "");
  CHECK(refuses("load-sharing", rigid, "rigid gears"));
  CHECK(refuses("load-sharing", elastic, "a scene without planets"));
  CHECK(
      said({"modes", "static"}, rigid) ==
      "SCENE=my.toml: static does not take rigid gears: they have natural modes alone; write another body in [fidelity]; for it there is: make SCENE=my.toml report, or of it modes mode-shapes");
  for (const char* goal : {"sweep", "impact", "branches", "order-cuts"})
    CHECK(refuses(goal, elastic, "a scene without speeds: "));
  CHECK(refuses("compare", rigid, "rigid gears"));
  for (const char* goal : {"waterfall", "fig05", "lumped", "no-such-goal"}) {
    CHECK(refuses(goal, moving, "a system of several meshes, carriers or drives: "));
    CHECK(
        said({goal}, moving)
            .ends_with(
                "report, or of it mesh reduce static error-budget load-sharing sweep motion-errors order-cuts histories sound runup branches multipliers fold-curves impact teeth harris-map compare modes mode-shapes"));
  }
}

TEST_CASE(
    "what goals and stages do not take: each says what, where, why and what instead; the table shows all of it") {
  using enum Trait;
  CHECK(refusal("loaded", {{pair, ""}}) == "");
  const std::string words = refusal("loaded", {{pair, ""}, {friction, "[friction]"}});
  CHECK(
      words ==
      "loaded does not take friction ([friction]): forces are along the normals alone; take the section out");
  CHECK(message_of_input([] { require_able("loaded", {{friction, "[friction]"}}); }) == words);
  CHECK(refusal("sweep", {{pair_of_bodies, ""}}).ends_with("write width = \"slices\" in [fidelity]"));
  CHECK(refusal("static", {{pair_of_bodies, ""}, {bearings, ""}, {friction, ""}, {internal, ""}}) == "");
  // One row for each reason; a cell is no longer than pages allow.
  const std::string table = capability_table();
  for (const char* row :
       {"| rigid gears | all but `report`, `modes`, `mode-shapes` | they have natural modes alone | ",
        "| friction | `width`, `harris-map`, `lumped`, `loaded` | "})
    CHECK(table.find(row) != std::string::npos);
}
