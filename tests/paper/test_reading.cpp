#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.h"
#include "dynamics/impact.h"
#include "gear/involute.h"
#include "gear/rack_tip.h"
#include "io/artifacts.h"
#include "io/claim_sets.h"
#include "io/readings.h"
#include "own_folder.h"
#include "paper/consistency.h"
#include "paper/reading.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "results/impact.h"
#include "results/static.h"

using namespace whine;

namespace {

std::string file_of(const std::string& words) {
  const auto path = std::filesystem::temp_directory_path() / "whine-test-reading.toml";
  std::ofstream(path) << words;
  return path.string();
}

const char* const kPlan = R"(title = "t"
scene = "x.toml"
seed = 4
readings = 3
[pair]
dedendum = [1.25, 1.4]
rack_tip_share = [0.5]
tooth_thinning_mm = [0.1]
plane = ["stress", "strain"]
corner_contact = [false, 0.5, true]
[draw]
inertia_from = ["two", "mass"]
frequency_offset_percent = [0.0, 0.5]
damped_state = ["one", "two"]
mass_share = [0.0, 0.5]
undamped_depth_mm = [0.5, 1.0]
steps_per_period = [32, 128]
)";

// Three claims; verdicts as given.
Reading reading_with(std::vector<int> verdict) {
  Reading r;
  r.verdict = std::move(verdict);
  r.value = {1, 2, 3};
  r.exists = {1, 0, 1};
  r.total_inertia = 0.014;
  return r;
}

}  // namespace

TEST_CASE("readings: a plan says its pairs in order and draws that depend on seed, pair and index alone") {
  const ReadingPlan plan = read_reading_plan(file_of(kPlan));
  const std::vector<OpenChoices> pairs = pairs_of(plan);
  REQUIRE(pairs.size() == 12);
  CHECK(pairs[0].dedendum == 1.25);
  CHECK(pairs[0].tooth_thinning == 0.1 / 1000);
  CHECK(!pairs[0].corner.enabled);
  CHECK(pairs[1].corner.largest_angle == relative(0.5 * std::numbers::pi / 180, 1e-15));
  CHECK(std::isinf(pairs[2].corner.largest_angle));
  CHECK(pairs[3].plane == "strain");
  CHECK(pairs[6].dedendum == 1.4);
  const OpenChoices one = draw(plan, pairs[5], 5, 2), again = draw(plan, pairs[5], 5, 2);
  CHECK(one.mass_share == again.mass_share);
  CHECK(one.inertia_from == again.inertia_from);
  int differ = 0;
  for (int i = 0; i < 40; ++i) differ += draw(plan, pairs[5], 5, i).mass_share != one.mass_share;
  CHECK(differ > 8);
}

TEST_CASE("readings: what a plan cannot mean is rejected with line, key and limit") {
  const auto with = [](std::string from, const std::string& to) {
    std::string words = kPlan;
    words.replace(words.find(from), from.size(), to);
    return message_of([&] { read_reading_plan(file_of(words)); });
  };
  CHECK(names(with("[1.25, 1.4]", "[0.2]"), {":6", "dedendum", "0.2", 1, 2}));
  CHECK(names(with("dedendum", "dedendun"), {"dedendum"}));
  CHECK(names(with("\"mass\"", "\"guess\""), {"inertia_from"}));
  CHECK(names(with("readings = 3", "readings = 0"), {1, 1000}));
  CHECK(names(with("[false, 0.5, true]", "[-1]"), {"corner_contact"}));
  CHECK(names(with("[draw]", "[drawn]"), {"drawn", "draw"}));
  for (const char* plan : {"reading", "reading-shallow", "reading-deep", "reading-best"})
    CHECK(pairs_of(read_reading_plan(std::string("data/studies/") + plan + ".toml")).size() > 15);
}

TEST_CASE("readings: the largest tip radius of a rack is where its tooth becomes one arc") {
  GearDesign d = paper_gear();
  for (const double dedendum : {1.25, 1.75})
    for (const double thinning : {0.0, 1e-4}) {
      d.dedendum = dedendum;
      d.tooth_thinning = thinning;
      const double largest = largest_rack_tip_radius(d);
      d.rack_tip_radius = largest * (1 - 1e-9);
      CHECK_NOTHROW(ToothGeometry{d});
      d.rack_tip_radius = largest * (1 + 1e-9);
      CHECK_THROWS_AS(ToothGeometry{d}, Error);
    }
}

TEST_CASE("readings: eigenvalues of the frozen contact stand for ring-downs in a search") {
  const ReducedBody& body = paper_body(40e-3, 1e-3, 21);
  const StaticResult statics = static_transmission(body, body, paper_statics(64), 150);
  SweepParameters settings = paper_sweep(0, 0, 0);
  settings.damping.rayleigh_mass = 300;
  ImpactPlan plan;
  plan.phases = 16;
  const ImpactResult level = impact(body, body, statics, statics.mean_stiffness, settings, plan, no_report);
  const ImpactResult frozen =
      frozen_impact(body, body, statics, statics.mean_stiffness, settings, plan.phases);
  REQUIRE(frozen.states.contact_state == level.states.contact_state);
  for (Eigen::Index i = 0; i + 1 < level.states.natural_frequency.size(); ++i) {
    CHECK(frozen.states.natural_frequency[i] == relative(level.states.natural_frequency[i], 5e-5));
    CHECK(frozen.states.damping_ratio[i] == relative(level.states.damping_ratio[i], 1e-3));
  }
  // The mean takes each phase as its contact state: 0.1 % and 2 % are what states vary in themselves.
  const Eigen::Index mean = level.states.natural_frequency.size() - 1;
  CHECK(frozen.states.natural_frequency[mean] == relative(level.states.natural_frequency[mean], 1e-3));
  CHECK(frozen.states.damping_ratio[mean] == relative(level.states.damping_ratio[mean], 0.02));
}

TEST_CASE("readings: an artifact gives back what it was given") {
  const ReadingPlan plan = read_reading_plan(file_of(kPlan));
  ReadingsResult a;
  a.title = "t";
  a.claim = {"a", "b", "c"};
  a.outside = 2;
  a.readings = {reading_with({0, 1, 4}), reading_with({1, 1, 3})};
  a.readings[0].choices = draw(plan, pairs_of(plan)[1], 1, 0);
  a.readings[1].choices = draw(plan, pairs_of(plan)[2], 2, 0);
  a.readings[1].bore_radius = 0.047;
  const TemporaryFolder folder;
  const std::string path = folder / "a.h5";
  write(path, a, {"test", "test", {}});
  const ReadingsResult b = read<ReadingsResult>(path);
  CHECK(b.claim == a.claim);
  CHECK(b.outside == 2);
  REQUIRE(b.readings.size() == 2);
  CHECK(b.readings[0].verdict == a.readings[0].verdict);
  CHECK(b.readings[0].exists == a.readings[0].exists);
  CHECK(b.readings[1].bore_radius == 0.047);
  CHECK(b.readings[1].choices.inertia_from == a.readings[1].choices.inertia_from);
  CHECK(b.readings[0].choices.corner.largest_angle == a.readings[0].choices.corner.largest_angle);
  CHECK(std::isinf(b.readings[1].choices.corner.largest_angle));
  CHECK(b.readings[1].choices.steps_per_period == a.readings[1].choices.steps_per_period);
}

TEST_CASE("consistency: sets that hold, the closest reading of those that do not, claims that never meet") {
  ReadingsResult a;
  a.claim = {"a", "b", "c"};
  // a and b hold in one reading each and never together; c never.
  a.readings = {reading_with({0, 1, 1}), reading_with({1, 0, 1}), reading_with({0, 1, 1})};
  const std::vector<ClaimSet> sets = read_claim_sets(file_of(R"([[set]]
name = "first"
says = "x"
claims = ["a"]
[[set]]
name = "either"
says = "x"
any = [["b", "c"], ["a"]]
[[set]]
name = "all"
says = "x"
with = ["first"]
claims = ["b"]
)"));
  const Consistency found = consistency(a, sets);
  CHECK(found.agreeing == std::vector<int>{1, 1, 1});
  CHECK(found.never == std::vector<std::string>{"c"});
  REQUIRE(found.sets.size() == 3);
  CHECK(found.sets[0].readings == 2);
  CHECK(found.sets[1].readings == 2);
  CHECK(found.sets[1].failing.empty());
  CHECK(found.sets[2].readings == 0);
  CHECK(found.sets[2].failing.size() == 1);
  CHECK(found.sets[2].size == 2);
  REQUIRE(found.conflicts.size() == 1);
  CHECK(found.conflicts[0].one == "a");
  CHECK(found.conflicts[0].with_one == 2);
  CHECK(contains(claim_sets_tsv(a, found), "\nall\tx\t0\t1 of 2: b\tdedendum "));

  CHECK(names(message_of([&] { consistency(a, {{"s", "x", {{"z"}}}}); }), {"z"}));
  CHECK(names(message_of([&] { consistency({}, sets); }), {"readings"}));
  CHECK(names(message_of([] { read_claim_sets(file_of("[[set]]\nname = \"n\"\nwith = [\"m\"]\n")); }),
              {":1", "with", "m"}));
}

TEST_CASE("consistency: the project's sets name claims that there are") {
  ReadingsResult a;
  for (const Claim& c : read_claims("data/published/claims.toml")) a.claim.push_back(c.id);
  Reading r;
  r.verdict.assign(a.claim.size(), 1);
  r.value.assign(a.claim.size(), 0);
  r.exists.assign(a.claim.size(), 1);
  a.readings = {r};
  CHECK_NOTHROW(consistency(a, read_claim_sets("data/published/claim_sets.toml")));
}
