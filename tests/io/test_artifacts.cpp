// Every kind of artifact gives back what was written, by describe() alone: a new kind is tested without a line here.
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>

#include "filled_artifact.h"
#include "io/h5.h"
#include "io/publish.h"
#include "own_folder.h"

using namespace whine;

namespace {

// Values of a study pass through text with 12 digits, others as they are.
bool same(double a, double b) {
  return a == b || std::abs(a - b) <= 1e-11 * std::abs(a);
}
bool same(const std::string& a, const std::string& b) {
  return a == b;
}

template <class Value>
std::vector<Value> values_in(const h5::Reader& file, const std::string& name) {
  if constexpr (std::is_same_v<Value, double>) return file.doubles(name);
  if constexpr (std::is_same_v<Value, int>) return file.ints(name);
  if constexpr (std::is_same_v<Value, std::string>) return file.strings(name);
}

// The file holds under each name what the member behind it was given.
void require_given(const std::string& path, const std::map<std::string, AnyBlock>& given) {
  const h5::Reader file(read_bytes(path), path, "");
  for (const auto& [name, any] : given)
    std::visit(
        [&, &name = name]<class Value>(const Block<Value>& block) {
          CAPTURE(name);
          REQUIRE(file.has(name));
          CHECK(file.shape(name) == block.shape);
          const std::vector<Value> found = values_in<Value>(file, name);
          REQUIRE(found.size() == block.values.size());
          for (std::size_t i = 0; i < found.size(); ++i) {
            INFO(block.values[i], " was given, the file holds ", found[i]);
            CHECK(same(block.values[i], found[i]));
          }
        },
        any);
}

template <class Artifact>
constexpr std::size_t kBase = std::is_base_of_v<MotionParameters, Artifact>     ? sizeof(MotionParameters)
                              : std::is_base_of_v<GearPairParameters, Artifact> ? sizeof(GearPairParameters)
                                                                                : 0;

// First and last byte of a member.
using Bytes = std::pair<const char*, const char*>;
template <class Member>
Bytes bytes_of(const Member& member) {
  const char* const first = reinterpret_cast<const char*>(&member);
  return {first, first + sizeof member};
}

// What describe() does not name for a reason: pictures are never read, parameters are the keys of a scene, and of a sector the
// cracked one alone has a slit.
template <class Artifact>
std::vector<Bytes> not_described(const Artifact& a) {
  std::vector<Bytes> out;
  if constexpr (std::is_base_of_v<GearPairParameters, Artifact>)
    out.push_back(bytes_of(static_cast<const GearPairParameters&>(a)));
  if constexpr (std::is_base_of_v<MotionParameters, Artifact>)
    out.push_back(bytes_of(static_cast<const MotionParameters&>(a)));
  if constexpr (requires { a.design; }) out.push_back(bytes_of(a.design));
  if constexpr (requires { a.discretisation; }) out.push_back(bytes_of(a.discretisation));
  if constexpr (requires { a.settings; }) out.push_back(bytes_of(a.settings));
  if constexpr (requires { a.train; }) out.push_back(bytes_of(a.train));
  if constexpr (requires { a.plan; }) out.push_back(bytes_of(a.plan));
  if constexpr (requires { a.view; }) out.push_back(bytes_of(a.view));
  if constexpr (requires { a.slit_node; }) out.push_back(bytes_of(a.slit_node));
  if constexpr (requires { a.vtk_point; })
    out.insert(out.end(), {bytes_of(a.vtk_point), bytes_of(a.vtk_cell), bytes_of(a.vtk_point_data)});
  if constexpr (requires { a.vtk_line; })
    out.insert(out.end(), {bytes_of(a.vtk_line), bytes_of(a.vtk_cell_data)});
  return out;
}

template <class Artifact>
using Image = std::array<std::uint64_t, sizeof(Artifact) / 8>;

// Calls look(artifact) for one that is made where all bytes were `padding`, which what no member holds keeps, and gives its bytes.
template <class Artifact, class Look>
Image<Artifact> image(int padding, const Look& look) {
  struct Place {
    alignas(Artifact) Image<Artifact> words;
  };
  static std::vector<std::unique_ptr<Place>> places;  // kept, so that short strings differ in their address
  Place* const place = places.emplace_back(std::make_unique<Place>()).get();
  std::memset(place->words.data(), padding, sizeof place->words);
  auto* const a = new (place->words.data()) Artifact;
  look(*a);
  Image<Artifact> out;
  std::memcpy(out.data(), static_cast<const void*>(a), sizeof out);
  a->~Artifact();
  return out;
}

// Offsets of the words of 8 bytes that filling leaves as they are in a new artifact: no value that fills is the default, and no
// list is empty.
template <class Artifact>
std::string left_alone() {
  std::vector<bool> described(sizeof(Artifact) / 8, false);
  const Image<Artifact> made = image<Artifact>(0, [&](const Artifact& a) {
    const char* const start = reinterpret_cast<const char*>(&a);
    for (const auto& [first, last] : not_described(a))
      for (const char* at = first; at < last; ++at)
        described[static_cast<std::size_t>(at - start) / 8] = true;
  });
  const Image<Artifact> other = image<Artifact>(1, [](const Artifact&) {});
  for (std::size_t i = 0; i < made.size(); ++i)
    if (made[i] == 0 && other[i] == 0x0101010101010101) described[i] = true;
  for (const Optional optional : kOptionals) {
    const Image<Artifact> full = image<Artifact>(0, [&](Artifact& a) { fill(a, optional); });
    for (std::size_t i = 0; i < full.size(); ++i) described[i] = described[i] || full[i] != made[i];
  }
  std::string out;
  for (std::size_t i = 0; i < described.size(); ++i)
    if (!described[i]) out += text(" ", 8 * i);
  return out;
}

}  // namespace

TEST_CASE("describe() names every member of every kind of artifact") {
  for_each_kind([]<class A>(const ArtifactKind<A>& kind) {
    CAPTURE(std::string(kind.name));
    INFO("not described: the members at these bytes of ", sizeof(A));
    CHECK(left_alone<A>() == "");
  });
}

TEST_CASE("every kind of artifact gives back every value, whatever optional parts it has") {
  for (const Optional optional : kOptionals)
    for_each_kind([&]<class A>(const ArtifactKind<A>& kind) {
      CAPTURE(std::string(kind.name));
      CAPTURE(static_cast<int>(optional));
      const OwnFolder folder;
      A a;
      const std::map<std::string, AnyBlock> given = fill(a, optional);
      write("a.h5", a, kMade);
      require_given("a.h5", given);
      write("b.h5", read<A>("a.h5"), kMade);
      CHECK(read_bytes("a.h5") == read_bytes("b.h5"));
    });
}
