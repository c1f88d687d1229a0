// An artifact is read whole or rejected by its name: damage, other kinds and versions, shapes, ranges, sizes.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "filled_artifact.h"
#include "io/artifact.h"
#include "io/artifacts.h"
#include "io/h5.h"
#include "io/pair_inputs.h"
#include "io/publish.h"
#include "io/ranges.h"
#include "own_folder.h"
#include "planetary_train.h"
#include "refusal.h"
#include "small_system.h"
#include "system/natural_modes.h"

using namespace whine;
namespace fs = std::filesystem;

namespace {

// An artifact that differs from a right one in what `change` does.
void write_like(const std::string& path, const std::function<void(h5::Writer&)>& change) {
  h5::Writer file;
  put_seal(file);
  change(file);
  publish(path, sealed(file.finish()));
}

void put_schema(h5::Writer& file, const std::string& schema, int version) {
  file.attribute("/", "schema", schema);
  file.attribute("/", "schema_version", version);
}

// Whether an artifact that is written and read is refused as input with these fields.
template <class Artifact>
Reasoned unread(const Artifact& a, const std::vector<Field>& fields) {
  write("a.h5", a, kMade);
  return refused([] { read<Artifact>("a.h5"); }, Failure::input, fields);
}

Reasoned unread_static(const std::string& path, Failure kind, const std::vector<Field>& fields) {
  return refused([&] { read_pair_statics(path); }, kind, fields);
}

}  // namespace

TEST_CASE("an artifact without its hash is rejected before HDF5 sees it") {
  OwnFolder folder;
  h5::Writer file;
  put_schema(file, "whine/static", 3);
  publish("out/bare.h5", file.finish());
  CHECK(unread_static("out/bare.h5", Failure::io, {"hash", "make out/bare.h5"}));
}

TEST_CASE("a file that is absent, empty, no HDF5 or cut at any of many places is rejected, never read") {
  OwnFolder folder;
  CHECK(unread_static("absent.h5", Failure::io, {"absent.h5"}));
  publish("empty.h5", "");
  CHECK(unread_static("empty.h5", Failure::io, {"empty.h5", "empty"}));
  publish("text.h5", "not an artifact at all");
  CHECK(unread_static("text.h5", Failure::io, {"text.h5", "HDF5"}));
  write("out/whole.h5", any<SystemStaticResult>(), kMade);
  const std::string bytes = read_bytes("out/whole.h5");
  for (std::size_t part = 1; part < 32; ++part) {
    publish("out/cut.h5", bytes.substr(0, bytes.size() * part / 32));
    CHECK(unread_static("out/cut.h5", Failure::io, {"make out/cut.h5"}));
    CHECK(fs::exists("out/cut.h5"));
  }
}

TEST_CASE("an artifact outside the working folder is rejected without a make target, which it has not") {
  OwnFolder folder;
  const fs::path place = fs::temp_directory_path() / "whine-nowhere" / "x.h5";
  for (const std::string& path : {place.string(), std::string("../whine-nowhere/x.h5")}) {
    CHECK(unread_static(path, Failure::io, {"make it again where it was made"}));
    CHECK(!contains(message_of([&] { read_pair_statics(path); }), "make .."));
  }
}

TEST_CASE(
    "a missing dataset, a wrong shape, a value that is not finite, an index that leads nowhere: rejected by name") {
  OwnFolder folder;
  write_like("none.h5", [](h5::Writer& file) { put_schema(file, "whine/mesh", 1); });
  CHECK(refused([] { read<SectorGrid>("none.h5"); }, Failure::input,
                {"none.h5", "/parameters/gear/teeth", "schema version", 1, "make"}));
  write_like("ragged.h5", [](h5::Writer& file) {
    put_schema(file, "whine/readings", 1);
    const std::string at = "/parameters/readings/";
    const int none = 0;
    const double values[] = {1, 2, 3};
    for (const char* word : {"title", "contact"})
      file.put(at + word, std::string("line"), {"1", "word", "", ""});
    file.put(at + "outside", &none, {}, {"1", "number", "", ""});
    file.put("/claim", std::vector<std::string>{"a", "b"}, {"1", "names", "claim", ""});
    file.put("/value", values, {1, 3}, {"1", "numbers", "row column", ""});
  });
  CHECK(refused([] { read<ReadingsResult>("ragged.h5"); }, Failure::input, {"/value", "1 x 3", "any x 2"}));

  // What cannot be read is not written.
  const auto unwritten = [](const auto& a, const std::vector<Field>& fields) {
    CHECK(refused([&] { write("x.h5", a, kMade); }, Failure::numerical, fields));
    CHECK(!fs::exists("x.h5"));
  };
  ReducedBody ragged = any<ReducedBody>();
  const auto modes = ragged.flank_mode.cols();
  ragged.flank_mode.conservativeResize(Eigen::NoChange, modes - 1);
  unwritten(ragged, {"/flank_mode", static_cast<int>(modes - 1), static_cast<int>(modes), "mode"});
  SweepResult sweep = any<SweepResult>();
  sweep.pair.conservativeResize(sweep.pair.size() - 1);
  unwritten(sweep, {"tooth_pair"});
  SystemStaticResult broken = any<SystemStaticResult>();
  broken.mesh[0].transmission_error[1] = std::nan("");
  unwritten(broken, {"/transmission_error"});

  SectorGrid lost = any<SectorGrid>();
  lost.flank_node[1] = 99;
  CHECK(unread(lost, {"/sector/flank_node", 99}));
}

TEST_CASE("an artifact of another schema or version is rejected with what it is and how to rebuild it") {
  OwnFolder folder;
  write("out/static.h5", any<SystemStaticResult>(), kMade);
  CHECK(refused([] { read<SweepResult>("out/static.h5"); }, Failure::input,
                {"whine/static", "whine/sweep", "make out/static.h5"}));
  write_like("out/old.h5", [](h5::Writer& file) { put_schema(file, "whine/static", 0); });
  CHECK(unread_static("out/old.h5", Failure::input,
                      {"version", 0, kind_of<SystemStaticResult>().version, "make out/old.h5"}));
  write_like("out/alien.h5", [](h5::Writer& file) { file.group("/data"); });
  CHECK(unread_static("out/alien.h5", Failure::input, {"out/alien.h5"}));
}

TEST_CASE("one flipped bit in any byte of an artifact is found, whatever reads it") {
  OwnFolder folder;
  write("out/static.h5", any<SystemStaticResult>(), kMade);
  const std::string whole = read_bytes("out/static.h5");
  std::mt19937 random(8);
  // Bytes of the signature make it no HDF5 file; all others are under the hash.
  for (std::size_t place = 0; place < whole.size(); place += 1 + random() % 64) {
    std::string bytes = whole;
    bytes[place] = static_cast<char>(bytes[place] ^ (1 << random() % 8));
    publish("out/static.h5", bytes);
    if (unread_static("out/static.h5", Failure::io, {"make out/static.h5"}) &&
        failure_of([] { read_origin("out/static.h5"); }) == Failure::io)
      continue;
    FAIL("the flipped bit in byte " << place << " of " << whole.size() << " was not found");
  }
  publish("out/static.h5", whole);
  CHECK_NOTHROW(read_pair_statics("out/static.h5"));
}

TEST_CASE("what HDF5 would follow for ever is rejected although the hash is right") {
  OwnFolder folder;
  write("out/static.h5", any<SystemStaticResult>(), kMade);
  const std::string whole = read_bytes("out/static.h5");
  const std::size_t heap = whole.find("GCOL");
  REQUIRE(heap != std::string::npos);
  // After the header of the heap, of 16 bytes, and number and use of the object.
  constexpr std::size_t kFirstSize = 24;
  for (const char byte : {'\xf0', '\x7f'}) {
    // -16 is the size with which HDF5 1.10 never gets on; the other one leads out of the file.
    std::string bytes = whole;
    bytes.replace(heap + kFirstSize, 8, std::string(1, byte) + std::string(7, '\xff'));
    publish("out/static.h5", sealed(bytes));
    CHECK(unread_static("out/static.h5", Failure::io, {"damaged", "make out/static.h5"}));
  }
  // All else that HDF5 follows has a checksum of its own, here that of the root group.
  std::string bytes = whole;
  const std::size_t root = bytes.find("schema_version");
  bytes[root] = 'S';
  publish("out/static.h5", sealed(bytes));
  CHECK_THROWS_AS(read_pair_statics("out/static.h5"), Error);

  // The heap's mark among numbers is no heap.
  const std::string mark = "a GCOL\1 and what follows it by accident";
  write_like("out/numbers.h5", [&](h5::Writer& file) {
    file.attribute("/", "schema", std::string("whine/none"));
    file.put("/bytes", reinterpret_cast<const std::uint8_t*>(mark.data()), {mark.size()},
             {"1", "bytes", "byte", ""});
  });
  CHECK(h5::Reader(read_bytes("out/numbers.h5"), "out/numbers.h5", "").shape("/bytes").at(0) == mark.size());
}

TEST_CASE("a file that is little else than marks of heaps is looked through in no time") {
  h5::Writer file;
  file.attribute("/", "schema", std::string("whine/none"));
  std::string bytes = file.finish();
  // What follows the end that the superblock names is not HDF5's concern. Numbers before it refer to some of so many places by
  // accident, first of all that end itself: then the file is rejected.
  for (const std::string mark : {"GCOL\1", "GCOL\1\2\3"}) {
    std::string marks = bytes + std::string(1 << 16, '-');
    while (marks.size() < std::size_t(1) << 20) marks += mark;
    const std::clock_t start = std::clock();
    message_of([&] { h5::Reader(marks, "marks.h5", ""); });
    CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 1);
  }

  // Many heaps to which the file refers, one within the other, all with the same objects.
  const std::size_t first = bytes.size();
  constexpr std::size_t kHeaps = 2000, kHeap = 32, kObjects = 30000;
  const auto number = [](std::uint64_t value) {
    std::string out(8, '\0');
    for (char& byte : out) {
      byte = static_cast<char>(value & 255);
      value >>= 8;
    }
    return out;
  };
  const std::size_t objects = first + kHeaps * kHeap, end = objects + kObjects * 16;
  for (std::size_t at = first; at < objects; at += kHeap)
    bytes += "GCOL\1" + std::string(3, '\0') + number(end - at) + std::string("\xff\xff", 2) +
             std::string(6, '\0') + number(objects - at - kHeap);
  for (std::size_t i = 0; i < kObjects; ++i) bytes += number(1 + i) + number(0);
  for (std::size_t at = first; at < objects; at += kHeap) bytes += number(at);
  const std::clock_t start = std::clock();
  CHECK(names(message_of([&] { h5::Reader(bytes, "nested.h5", ""); }), {"nested.h5", "damaged"}));
  CHECK(double(std::clock() - start) / CLOCKS_PER_SEC < 0.1);
}

TEST_CASE("a file that deflates to little is not read into a thousand times its size") {
  OwnFolder folder;
  const std::vector<std::uint8_t> bytes(8 << 20);
  const std::vector<std::string> words(1 << 20);
  const std::vector<double> doubles(1 << 14);
  write_like("out/wide.h5", [&](h5::Writer& file) {
    const auto along = [](const char* axis) { return h5::Label{"1", "zeros", axis, ""}; };
    file.put("/bytes", bytes.data(), {bytes.size()}, along("bytes"));
    file.put("/words", words, along("words"));
    file.put("/doubles", doubles.data(), {doubles.size()}, along("doubles"));
  });
  const std::string whole = read_bytes("out/wide.h5");
  const h5::Reader file(whole, "out/wide.h5", "");
  // As doubles 64 MiB, as whole numbers 32, as texts 34.
  REQUIRE(whole.size() < (30 << 20) / 1020);
  for (const auto& read : std::vector<std::function<void()>>{
           [&] { file.doubles("/bytes"); }, [&] { file.ints("/bytes"); }, [&] { file.strings("/words"); }})
    CHECK(refused(read, Failure::input, {"memory"}));
  CHECK(file.doubles("/doubles").size() == doubles.size());
}

TEST_CASE("a range holds its ends, an open one not its least, and none a number that is not one") {
  CHECK(outside({0, 1, true}, 0) == "holds 0, allowed is more than 0 to 1");
  CHECK(outside({0, 1}, 0).empty());
  CHECK(outside({0, 1}, 1).empty());
  CHECK(!outside({0, 1}, 1.1).empty());
  CHECK(!outside({0, 1}, std::numeric_limits<double>::quiet_NaN()).empty());
}

TEST_CASE(
    "a number out of its range is rejected by its dataset, its value and the range, whatever the hash") {
  const OwnFolder folder;
  const auto body = [](auto&& spoil, const std::vector<Field>& fields) {
    ReducedBody a = any<ReducedBody>();
    spoil(a);
    CHECK(unread(a, fields));
  };
  body(
      [](ReducedBody& a) {
        a.offsets = -1;
        a.compliance.clear();
        const Eigen::Index points = a.flank_position.size();
        a.far_compliance = MatrixRM::Constant(points * (a.design.teeth / 2 + 1), points, 1e-11);
      },
      {"/compliance/offsets", "-1", 0, 1000});
  body([](ReducedBody& a) { a.design.module = -0.003; }, {"/parameters/gear/module", "-0.003"});
  body([](ReducedBody& a) { a.discretisation.near_field = static_cast<NearField>(7); },
       {"near_field", "subtraction", "matching"});
  body([](ReducedBody& a) { a.nodal_diameter[1] = -3; }, {"/nodal_diameter", "-3", 0, 2000});
  const auto statics = [](auto&& spoil, const std::vector<Field>& fields) {
    SystemStaticResult a = any<SystemStaticResult>();
    spoil(a);
    CHECK(unread(a, fields));
  };
  statics([](SystemStaticResult& a) { a.mesh[0].torque = 1e300; },
          {"/parameters/operation/torque", "1e+300", 0});
  statics([](SystemStaticResult& a) { a.mesh[0].mesh.centre_distance = -1; },
          {"/parameters/mesh/centre_distance", "-1"});
  statics([](SystemStaticResult& a) { a.hunting_periods = 1 << 30; }, {"/hunting_periods", 1 << 30, 1});
  const auto sweep = [](auto&& spoil, const std::vector<Field>& fields) {
    SweepResult a = any<SweepResult>();
    spoil(a);
    CHECK(unread(a, fields));
  };
  sweep([](SweepResult& a) { a.tooth_load[1](0, 0) = 1e18; }, {"/tooth_load", "1e+18"});
  sweep([](SweepResult& a) { a.mesh_frequency[0] = 0; }, {"/mesh_frequency", 0});
  SystemStaticResult rest = small_system();
  rest.settings.layout.bodies[0].radius = 1e-300;
  CHECK(unread(rest, {"/layout/body/radius", "1e-300", "1e-06", 10}));
  SweepResult motion = small_sweep(small_system(), Direction::up);
  motion.residual[0] = 1e301;
  CHECK(unread(motion, {"/residual", "1e+301", 0, "1e+300"}));
  motion = small_sweep(small_system(), Direction::up);
  motion.energy_imbalance[0] = 1e301;
  CHECK(unread(motion, {"/energy_imbalance", "1e+301", "-1e+300", "1e+300"}));
}

TEST_CASE("modes.h5 whose bodies stand on nothing, or whose meshes join none, is rejected with its dataset") {
  OwnFolder folder;
  const ModesResult good = natural_modes(layout_of(planetary_train(3)));
  const int carrier = good.layout.bodies[1].on;
  const auto rejects = [&](const auto& spoil, const std::vector<Field>& fields) {
    ModesResult a = good;
    spoil(a.layout);
    CHECK(unread(a, fields));
  };
  for (const int on : {0, carrier, carrier + 1})
    rejects([&](System& s) { s.bodies[static_cast<size_t>(carrier)].on = on; }, {"-1", "ground", "carrier"});
  rejects([](System& s) { s.bodies[1].on = 0; }, {"/body/stands_on", 0, 1});
  rejects([](System& s) { s.bodies[1].sense = 0; }, {"/body/sense", 0, 1});
  rejects([](System& s) { s.meshes[0].side[1].body = 99; }, {"/mesh/body_number", 99});
  // What figures divide by and look up.
  rejects([](System& s) { s.bodies[2].teeth = 0; }, {"/body/teeth", 0, 2});
  rejects([](System& s) { s.bodies[2].radius = 0; }, {"/body/radius", 0, "1e-06", 10});
  rejects([](System& s) { s.bodies[2].name = "a/b"; }, {"/body/name", "a/b"});
  for (const int other : {carrier, good.layout.meshes[0].side[0].body})
    rejects([&](System& s) { s.meshes[0].side[1].body = other; }, {"two gears", "differ"});
  // Springs have no energy below 0; elastic bodies may join meshes that have.
  ModesResult negative = good;
  negative.mesh_energy(0, 0) = -0.5;
  CHECK(unread(negative, {"/mesh_energy", "-0.5"}));
  negative.mesh_phase = Eigen::VectorXd::Zero(1);
  negative.frozen_frequency = good.natural_frequency.transpose();
  write("elastic.h5", negative, kMade);
  CHECK(read<ModesResult>("elastic.h5").mesh_energy(0, 0) == -0.5);
  // The system as it is stored has the same modes.
  CHECK(natural_modes(read<ModesResult>("elastic.h5").layout).shape == good.shape);
}

TEST_CASE(
    "static.h5 of a train without a pair, of a gear that there is not, or drawn as another, is rejected") {
  OwnFolder folder;
  const auto rejects = [](const auto& spoil, const std::vector<Field>& fields) {
    SystemStaticResult a = small_system();
    spoil(a);
    CHECK(unread(a, fields));
  };
  rejects(
      [](SystemStaticResult& a) {
        for (StaticResult& mesh : a.mesh) {
          mesh.pair.resize(0);
          for (MatrixRM* list : {&mesh.tooth_load, &mesh.contact_pressure, &mesh.contact_half_width,
                                 &mesh.root_stress[0], &mesh.root_stress[1]})
            list->resize(2, 0);
        }
      },
      {"/tooth_pair"});
  rejects([](SystemStaticResult& a) { a.drawing[0].design.teeth += 1; }, {"/layout/body/teeth", 27, 0, 28});
  rejects([](SystemStaticResult& a) { a.settings.gear[1] = "moon"; }, {"moon"});
  const SystemStaticResult a = small_system();
  write("a.h5", a, kMade);
  const SystemStaticResult b = read<SystemStaticResult>("a.h5");
  for (const char* gear : {"sun", "planet", "ring"})
    CHECK(a.settings.modification(gear) == b.settings.modification(gear));
  CHECK(a.settings.modification("sun") != a.settings.modification("planet"));
  CHECK(b.settings.mesh[0].modification[1] == b.settings.mesh[1].modification[0]);
  CHECK(b.settings.modification("ring") == FlankModification{});
}
