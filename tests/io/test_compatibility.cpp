// Which files belong together: bodies and their gears, artifacts and their inputs, scene and folder; and what makes them anew.
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>

#include "base/tool.h"
#include "filled_artifact.h"
#include "io/artifact.h"
#include "io/artifact_place.h"
#include "io/artifacts.h"
#include "io/compatibility.h"
#include "io/named_files.h"
#include "io/picture_sources.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/scene_words.h"
#include "own_folder.h"
#include "refusal.h"
#include "small_system.h"

using namespace whine;
namespace fs = std::filesystem;

TEST_CASE("artifacts of systems belong to their scene and, sweeps, to their direction, whoever wrote them") {
  OwnFolder folder;
  const auto write_sweep = [](std::string output) {
    publish("out/a/params/sweep.toml", "of = 'a'\n");
    char name[] = "gear-sweep", option[] = "--output";
    char* arguments[] = {name, option, output.data(), nullptr};
    write("sweep.h5", small_sweep(small_system(), Direction::down),
          made_by(3, arguments, {"params=out/a/params/sweep.toml"}));
    return read_origin("sweep.h5");
  };
  // Made where it lies, and made by hand under another name and moved: its own parameters tell.
  for (const char* output : {"out/a/T60/down/sweep.h5", "sweep.h5"}) {
    const Origin down = write_sweep(output);
    CHECK(misplaced("out/a/T60/down/sweep.h5", down).empty());
    CHECK(names(misplaced("out/a/T60/up/sweep.h5", down), {"sweep down", "in up"}));
    CHECK(names(misplaced("out/b/T60/down/sweep.h5", down), {"out/a/params/sweep.toml", "out/b"}));
    CHECK(names(misplaced("out/a/T60/branch.h5", down), {"whine/branch"}));
  }
  // A name is of pairs and of trains, and of nothing else.
  write("static.h5", small_system(), kMade);
  CHECK(misplaced("out/train/T60/static.h5", read_origin("static.h5")).empty());
  Origin of_pair;
  of_pair.schema = "whine/static";
  CHECK(misplaced("out/pair/T60/static.h5", of_pair).empty());
  of_pair.schema = "whine/impact";
  CHECK(names(misplaced("out/train/T60/static.h5", of_pair), {"whine/static", "whine/impact"}));
}

TEST_CASE("bodies are given by the names of their gears, in any order, one for each") {
  GearMeshSpec mesh;
  mesh.gear[0] = "pinion";
  mesh.gear[1] = "wheel";
  const NamedFiles both("--body", {"wheel=out/b=c/body.h5", "pinion=a.h5"});
  CHECK(both.of(mesh) == std::vector<std::string>{"a.h5", "out/b=c/body.h5"});
  CHECK(both.role("wheel") == "body wheel");
  CHECK(both.and_inputs({"params=x"}) ==
        std::vector<std::string>{"params=x", "body wheel=out/b=c/body.h5", "body pinion=a.h5"});
  const auto rejected = [&](const std::vector<std::string>& words, const std::vector<Field>& fields) {
    CHECK(refused([&] { NamedFiles("--body", words).of(mesh); }, Failure::usage, fields));
  };
  for (const char* word : {"a.h5", "=a.h5", "pinion="}) rejected({word}, {"--body <gear>=<path>"});
  rejected({"pinion=a.h5", "pinion=b.h5"}, {"pinion", "twice"});
  rejected({"pinion=a.h5"}, {"wheel", "--body wheel=<path>"});
  rejected({"pinion=a.h5", "whel=b.h5"}, {"whel", "wheel"});
  rejected({"pinion=a.h5", "wheel=b.h5", "carrier=c.h5"}, {"carrier", "pinion", "wheel"});
  // A system may have two gears, too.
  CHECK(refused(
      [] {
        NamedFiles("--body", {"sun=a.h5", "moon=b.h5"}).of({"sun", "ring"}, "system");
      },
      Failure::usage, {"system", "moon"}));
}

TEST_CASE("provenance names tool, command, inputs with their SHA-256, and the stages before") {
  OwnFolder folder;
  // SHA-256 of "abc", FIPS 180-2 example.
  CHECK(sha256("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  publish("out/body.toml", "abc");
  SectorGrid mesh = any<SectorGrid>();
  write("out/mesh.h5", mesh, {"gear-mesh", "gear-mesh --params out/body.toml", {"params=out/body.toml"}});
  const std::string absolute = fs::current_path().string() + "/out/mesh.h5";
  write("out/body.h5", any<ReducedBody>(),
        {"gear-reduce", "gear-reduce", {"params=out/body.toml", "mesh=" + absolute}});
  const Origin origin = read_origin("out/body.h5");
  CHECK(origin.schema == "whine/body");
  CHECK(origin.tool == "gear-reduce");
  CHECK(origin.version == kVersion);
  REQUIRE(origin.inputs.size() == 2);
  CHECK(origin.inputs[0].role == "params");
  CHECK(origin.inputs[0].sha256 == sha256("abc"));
  CHECK(origin.inputs[1].path == "out/mesh.h5");
  CHECK(origin.inputs[1].sha256 == sha256_of_file("out/mesh.h5"));
  CHECK(origin.history == std::vector<std::string>{"gear-mesh 0.1.0: gear-mesh --params out/body.toml"});

  CHECK_NOTHROW(require_made_from("out/body.h5", "mesh", "out/mesh.h5"));
  mesh.design.addendum *= 2;
  write("out/mesh.h5", mesh, kMade);
  CHECK(refused([] { require_made_from("out/body.h5", "mesh", "out/mesh.h5"); }, Failure::input,
                {"out/body.h5", "stale", "make out/body.h5"}));
  CHECK(failure_of([&] { write("x.h5", mesh, {"t", "t", {"mesh=absent.h5"}}); }) == Failure::io);
}

TEST_CASE("an input that was replaced, before or while a stage ran, is named and nothing is written") {
  OwnFolder folder;
  char name[] = "build/bin/gear-test";
  char* arguments[] = {name, nullptr};
  publish("slice.toml", "a = 1\n");
  ReducedBody body = any<ReducedBody>();
  write("out/body.h5", body, made_by(1, arguments, {"params=slice.toml"}));
  const Provenance now = made_by(1, arguments, {"driver=out/body.h5"});
  CHECK_NOTHROW(require_fresh("out/body.h5"));

  publish("slice.toml", "a = 2\n");
  CHECK(refused([&] { made_by(1, arguments, {"driver=out/body.h5"}); }, Failure::input,
                {"out/body.h5", "stale", "params", "slice.toml", "make out/body.h5"}));
  fs::remove("slice.toml");  // what is not there contradicts nothing
  CHECK_NOTHROW(require_fresh("out/body.h5"));

  body.inertia *= 2;
  write("out/body.h5", body, kMade);
  CHECK(refused([&] { write("static.h5", any<SystemStaticResult>(), now); }, Failure::input,
                {"static.h5", "out/body.h5", "replaced"}));
  CHECK_FALSE(fs::exists("static.h5"));
}

TEST_CASE("no file holds a path of the machine: commands and inputs are relative to the working folder") {
  OwnFolder folder;
  const std::string here = fs::current_path().string();
  CHECK(recorded_path(here + "/out/x.h5") == "out/x.h5");
  CHECK(recorded_path("out/x.h5") == "out/x.h5");
  CHECK(recorded_path("/somewhere/else/x.h5") == ".../x.h5");
  std::vector<std::string> words = {"/usr/bin/gear-x", "--input", here + "/a.h5",
                                    "--out=" + here + "/b c.h5"};
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  CHECK(command_line(4, argv.data()) == "gear-x --input a.h5 '--out=b c.h5'");
}

TEST_CASE("a mesh of another gear, element size or order is rejected with both values; modes do not matter") {
  const SectorGrid mesh = any<SectorGrid>();
  const auto with = [&](auto&& change) {
    BodyParameters settings{mesh.design, {}, mesh.discretisation};
    change(settings.design, settings.discretisation);
    return [&mesh, settings] { require_mesh(mesh, settings, "out/a/mesh.h5"); };
  };
  CHECK_NOTHROW(with([](GearDesign&, BodyDiscretisation&) {})());
  CHECK_NOTHROW(with([](GearDesign&, BodyDiscretisation& d) { d.modes += 1; })());
  const std::string remedy = "make SCENE=path/to/a.toml out/a/mesh.h5";
  CHECK(refused(with([](GearDesign& g, BodyDiscretisation&) { g.teeth += 1; }), Failure::input,
                {"teeth", mesh.design.teeth, mesh.design.teeth + 1, remedy}));
  CHECK(refused(
      with([](GearDesign& g, BodyDiscretisation&) { g.bore_radius = std::nextafter(g.bore_radius, 1.0); }),
      Failure::input, {"bore_radius"}));
  CHECK(refused(with([](GearDesign&, BodyDiscretisation& d) { d.element_order = 3 - d.element_order; }),
                Failure::input, {"element_order", mesh.discretisation.element_order}));
  CHECK(refused(with([](GearDesign&, BodyDiscretisation& d) { d.element_size *= 2; }), Failure::input,
                {"element"}));
}

TEST_CASE(
    "a body read back has the hash of its stage parameters, and another body is rejected with both hashes") {
  OwnFolder folder;
  const ReducedBody body = any<ReducedBody>();
  write("body.h5", body, kMade);
  const std::string hash = body_hash(body_parameters({body.design, body.material, body.discretisation}));
  CHECK(hash.size() == 16);
  CHECK_NOTHROW(require_body(read<ReducedBody>("body.h5"), hash, "driver", "body.h5"));
  CHECK_NOTHROW(require_body(body, "", "driver", "body.h5"));
  ReducedBody other = body;
  other.material.density *= 2;
  CHECK(refused([&] { require_body(other, hash, "driven", "out/s/wheel/body.h5"); }, Failure::input,
                {"out/s/wheel/body.h5", "driven", hash, "make out/bodies/" + hash + "/body.h5"}));
}

TEST_CASE("a static result of another contact level than a later stage's is rejected with both") {
  StaticResult statics = any<SystemStaticResult>().mesh[0];
  statics.fidelity.contact = ContactModel::line;
  Fidelity wanted;
  wanted.contact = ContactModel::line;
  CHECK_NOTHROW(require_contact(statics, wanted, "out/s/T100/static.h5"));
  wanted.contact = ContactModel::strips;
  CHECK(
      refused([&] { require_contact(statics, wanted, "out/s/T100/static.h5"); }, Failure::input,
              {"out/s/T100/static.h5", "line", "strips", "make SCENE=path/to/s.toml out/s/T100/static.h5"}));
}

TEST_CASE("only what lies below out/ has a make target") {
  CHECK(rebuild_advice("out/parker2000/T0.75/static.h5") ==
        "rebuild it with: make out/parker2000/T0.75/static.h5");
  CHECK(rebuild_advice("out/bodies/0123/body.h5") == "rebuild it with: make out/bodies/0123/body.h5");
  // Of a scene that is none of the project's.
  CHECK(rebuild_advice("out/s/T150/static.h5") ==
        "rebuild it with: make SCENE=path/to/s.toml out/s/T150/static.h5");
  CHECK(rebuild_advice("out/studies/thousand/study.h5") ==
        "rebuild it with: make out/studies/thousand/study.h5");
  CHECK(rebuild_advice("out/studies/own/variants/ab/abcd.h5") ==
        "rebuild it with: make STUDY=path/to/own.toml out/studies/own/variants/ab/abcd.h5");
  CHECK(!contains(rebuild_advice("results/static.h5"), "make results"));
  CHECK(contains(rebuild_advice("results/static.h5"), "below out/ only"));
}

TEST_CASE("a picture says what it was drawn from, and one of other files or of another scene is rejected") {
  const OwnFolder folder;
  const std::string header("\x89PNG\r\n\x1a\n\0\0\0\rIHDR0123456789abcCRC!", 33),
      end("\0\0\0\0IEND\xae\x42\x60\x82", 12);
  for (const std::string scene : {"one", "other"}) {
    publish("out/" + scene + "/params/title.txt", "Pair " + scene + "\n");
    publish("out/" + scene + "/T100/static.h5", scene);
  }
  const std::string scene = scene_words("out/one/T100/static.h5");
  REQUIRE(contains(scene, "Pair one"));
  const std::string picture = with_sources(header + end, {"out/one/T100/static.h5"});
  const auto sources = picture_sources("a.png", picture);
  REQUIRE(sources.size() == 1);
  CHECK(sources[0].path == "out/one/T100/static.h5");
  CHECK(sources[0].sha256 == sha256_of_file("out/one/T100/static.h5"));
  const auto message = [&](const std::string& bytes) {
    return message_of([&] { require_fresh_picture("fig12.png", bytes, scene); });
  };
  CHECK(message(picture).empty());
  CHECK_NOTHROW(require_fresh_picture("fig12.png", picture, ""));
  CHECK(names(message(header + end), {"fig12.png"}));
  CHECK(names(message(with_sources(header + end, {"out/other/T100/static.h5"})),
              {"out/other/T100/static.h5", "other", "Pair other", "Pair one"}));
  publish("out/one/T100/static.h5", "made anew");
  CHECK(names(message(picture), {"another out/one/T100/static.h5"}));
  for (size_t length = header.size() + 1; length + end.size() < picture.size(); ++length)
    CHECK(names(message(picture.substr(0, length)), {"whole PNG"}));
}
