#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>

#include "base/error.h"
#include "one_mesh.h"
#include "own_folder.h"
#include "paper/scorecard.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"

using namespace whine;

namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();

const std::vector<Claim>& paper_claims() {
  static const std::vector<Claim> all = read_claims("data/published/claims.toml");
  return all;
}

const Claim& claim(const std::string& id) {
  for (const Claim& c : paper_claims())
    if (c.id == id) return c;
  FAIL("there is no claim ", id);
  return paper_claims().front();
}

Verdict verdict_at(Scale scale, double printed, double tolerance, double value) {
  Claim c;
  c.scale = scale;
  c.printed = printed;
  c.tolerance = tolerance;
  return verdict(c, {value, ""}, false);
}

// Speeds of 20 Hz; RMS 1 µm and a pure first harmonic unless changed.
ResponseResult flat_response(double torque, Direction direction) {
  ResponseResult r;
  r.torque = torque;
  r.direction = direction;
  r.natural_frequency = 2900;
  const Eigen::Index n = 171;
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(n, 600, 4000);
  if (direction == Direction::down) r.mesh_frequency.reverseInPlace();
  r.dte_rms = Eigen::VectorXd::Constant(n, 1e-6);
  r.dte_mean = Eigen::VectorXd::Constant(n, 5e-6);
  MatrixRM harmonic = MatrixRM::Zero(n, 10);
  harmonic.col(0) = r.dte_rms * std::numbers::sqrt2;
  r.dte_harmonic = of_one_mesh(harmonic);
  r.tooth_load_max = Eigen::VectorXd::Constant(n, 3000);
  r.mesh_force_max = Eigen::VectorXd::Constant(n, 4000);
  r.separation_fraction = r.separations_per_period = Eigen::VectorXd::Zero(n);
  r.period_multiple = Eigen::VectorXi::Ones(n);
  return r;
}

Eigen::Index row_of(const ResponseResult& r, double f) {
  Eigen::Index row;
  (r.mesh_frequency.array() - f).abs().minCoeff(&row);
  return row;
}

// One branch at 150 N m.
SceneResults flat_results() {
  SceneResults s;
  s.name = "flat";
  StaticResult& statics = s.statics["T150/static.h5"];
  statics.gear[0].design = statics.gear[1].design = paper_gear();
  statics.contact_ratio = 1.7547;
  statics.stiffness_harmonic = Eigen::Vector3d(460e6, 46e6, 1e6);
  statics.mean_stiffness = 460e6;
  for (const Direction direction : {Direction::up, Direction::down}) {
    const std::string folder = text("T150/", direction);
    const ResponseResult& r = s.responses[folder + "/response.h5"] = flat_response(150, direction);
    SweepResult& sweep = s.sweeps[folder + "/sweep.h5"];
    sweep.time.steps_per_period = 128;
    sweep.tooth_load.assign(static_cast<size_t>(r.mesh_frequency.size()), MatrixRM::Constant(128, 1, 3000));
  }
  return s;
}

}  // namespace

TEST_CASE("scorecard: every claim says where, what, in which unit and what decides; ids are unique") {
  std::set<std::string> ids;
  for (const Claim& c : paper_claims()) {
    CAPTURE(c.id);
    CHECK(ids.insert(c.id).second);
    for (const std::string& words : {c.id, c.place, c.text, c.unit, c.basis}) {
      CHECK_FALSE(words.empty());
      CHECK(words.find_first_of("|\t\n") == std::string::npos);  // cells of tables
    }
    CHECK(!contains(c.id, " "));
    CHECK(c.find);
    if (c.scale == Scale::statement) {
      CHECK(c.unit == "yes/no");
      CHECK(c.printed == 1);
      CHECK(c.tolerance == 0);
    } else if (c.scale != Scale::incomparable) {
      CHECK(std::isfinite(c.printed));
      CHECK(c.tolerance >= 0);
    }
    // Words of degree have no number: the criterion says so, or takes one that the text prints.
    for (const char* word : {"considerably", "strikingly", "nearly", "sharply", "modestly"})
      if (c.scale == Scale::statement && contains(c.text, word)) CHECK(contains(c.basis, "has no number"));
  }
}

TEST_CASE("scorecard: what is wrong in a file of claims is named with its line") {
  const TemporaryFolder folder;
  const std::string file = folder / "claims.toml";
  const auto said = [&](const std::string& changed, const std::string& into) {
    std::string words =
        "[[claim]]\nid = \"kink\"\nplace = \"2.1\"\nsays = \"x\"\nkind = \"number\"\nunit = \"Hz\"\n"
        "printed = 2\ntolerance = 0.5\nbasis = \"y\"\ntorque_Nm = 100\n";
    if (!changed.empty()) words.replace(words.find(changed), changed.size(), into);
    std::ofstream(file) << words;
    const std::string message = message_of_input([&] { read_claims(file); });
    const size_t path = message.find(file);
    return path == std::string::npos ? message : message.substr(path + file.size());
  };
  REQUIRE(said("", "").empty());
  CHECK(read_claims(file)[0].tolerance == 0.5);
  const std::string row = "torque_Nm = 100";
  CHECK(names(said("torque_Nm", "torque"), {":10", "torque", "torque_Nm", "id, place"}));
  CHECK(names(said("printed = 2", "printed = \"2\""), {":7", "printed", "number"}));
  CHECK(names(said("printed = 2", "printed = inf"), {":7", "printed", "inf"}));
  CHECK(names(said(row, "torque_Nm = 1.5"), {":10", "torque_Nm", "whole"}));
  CHECK(names(said("printed = 2\n", ""), {":1", "kink", "printed"}));
  CHECK(names(said("tolerance = 0.5", "tolerance = -1"), {":1", "kink", "tolerance", "-1", 0}));
  CHECK(names(said("kind = \"number\"", "kind = \"statement\""), {":1", "kink", "statement", "unit"}));
  CHECK(names(said("kind = \"number\"", "kind = \"count\""), {":1", "kind", "count", "number"}));
  CHECK(names(said("basis = \"y\"", "basis = \"\""), {":1", "[[claim]]", "basis"}));
  CHECK(names(said(row + "\n", ""), {":1", "kink", "torque_Nm"}));
  CHECK(names(said(row, row + "\norder = 2"), {":1", "kink", "order"}));
  CHECK(names(said("id = \"kink\"", "id = \"k\""), {":1", "k", "known"}));
  CHECK(names(said(row + "\n", row + "\n[[claims]]\n"), {":11", "claims", "[[claim]]"}));
  CHECK(names(said("id = ", "id "), {"TOML"}));
  std::ofstream(file) << "";
  CHECK(names(message_of([&] { read_claims(file); }), {":1", "[[claim]]"}));
}

TEST_CASE("scorecard: Table 1 is nine claims, each with its torque and contact state") {
  int rows = 0;
  for (const Claim& c : paper_claims()) {
    if (c.value != kNaturalFrequency) continue;
    CHECK(c.id == text("table1-", c.contact, "-", c.torque));
    CHECK(c.place == "Table 1");
    ++rows;
  }
  CHECK(rows == 9);
}

TEST_CASE("scorecard: verdicts at the edges of the tolerance") {
  CHECK(verdict_at(Scale::number, 2480, 20, 2500) == Verdict::agrees);
  CHECK(verdict_at(Scale::number, 2480, 20, 2460) == Verdict::agrees);
  CHECK(verdict_at(Scale::number, 2480, 20, 2500.001) == Verdict::differs);
  CHECK(verdict_at(Scale::number, 2480, 20, 2459.999) == Verdict::differs);
  CHECK(verdict_at(Scale::number, 2, 0, 2) == Verdict::agrees);
  CHECK(verdict_at(Scale::number, 2, 0, 1) == Verdict::differs);
  CHECK(verdict_at(Scale::statement, 1, 0, 1) == Verdict::agrees);
  CHECK(verdict_at(Scale::statement, 1, 0, 0) == Verdict::differs);
  // a state that does not exist
  CHECK(verdict_at(Scale::number, 4850, 242.5, kNone) == Verdict::differs);
  CHECK(verdict_at(Scale::statement, 1, 0, kNone) == Verdict::differs);
  CHECK(verdict_at(Scale::incomparable, kNone, 0, kNone) == Verdict::incomparable);
  CHECK(verdict_at(Scale::incomparable, 20, 0, 20) == Verdict::incomparable);
  // a misprint stays one whatever the value; a choice of P2000's method counts against nobody who does otherwise
  CHECK(verdict_at(Scale::misprint, 7.047, 0, 70.47) == Verdict::misprint);
  CHECK(verdict_at(Scale::choice, 0.25, 0, 0.25) == Verdict::given);
  CHECK(verdict_at(Scale::choice, 0.25, 0, kNone) == Verdict::incomparable);
  CHECK(verdict_at(Scale::choice, 1.2, 0, 1.000001) == Verdict::incomparable);
}

TEST_CASE(
    "scorecard: what a scene takes over or was fitted to is no success of that scene, and of that one only") {
  Claim c;
  c.scale = Scale::number;
  c.printed = 7;
  c.tolerance = 0.5;
  CHECK(verdict(c, {7.2, ""}, true) == Verdict::fitted);
  CHECK(verdict(c, {7.2, ""}, false) == Verdict::agrees);
  CHECK(verdict(c, {7.6, ""}, true) == Verdict::differs);
  c.given = true;
  CHECK(verdict(c, {7.2, ""}, false) == Verdict::given);
  CHECK(verdict(c, {6.4, ""}, false) == Verdict::differs);

  c.given = false;
  c.id = "mine";
  c.find = [](const SceneResults&) { return Finding{7.2, ""}; };
  SceneResults one, other;
  one.name = "one";
  other.name = "other";
  const Scorecard card =
      score({c}, {one, other}, {{"one", "eta", {"mine"}}, {"one", "dedendum", {}}, {"other", "bore", {}}});
  CHECK(verdict(card, card.rows[0], 0) == Verdict::fitted);
  CHECK(verdict(card, card.rows[0], 1) == Verdict::agrees);
  CHECK(contains(bottom_line(card)[0], "1 numbers fitted to 1 claims, 1 chosen for"));
  CHECK(failure_of([&] { score({c}, {one}, {{"one", "eta", {"yours"}}}); }) == Failure::input);
}

TEST_CASE("scorecard: the project's table of fitted numbers names claims that there are") {
  const auto fitted = read_fitted_numbers("data/published/fitted.toml");
  CHECK(fitted.size() > 3);
  for (const FittedNumber& n : fitted)
    for (const std::string& id : n.claims) CHECK(claim(id).id == id);
}

TEST_CASE("scorecard: one branch: what the paper says of either of two has no value, with the reason") {
  const SceneResults s = flat_results();
  CHECK(claim("branches-2400").find(s).value == 0);
  CHECK(claim("jumps-150").find(s).value == 0);
  CHECK(contains(claim("jumps-150").find(s).note, "first harmonic of k 10 %"));
  CHECK(std::isnan(claim("load-upper").find(s).value));
  CHECK(std::isnan(claim("upper-two-losses-1300").find(s).value));
  CHECK(std::isnan(claim("load-lower").find(s).value));
  CHECK(contains(claim("load-lower").find(s).note, "3000 N on one tooth, 4000 N in all"));
  CHECK(std::isnan(claim("lower-keeps-contact-1350").find(s).value));
  CHECK(std::isnan(claim("smooth-transition").find(s).value));
  CHECK(std::isnan(claim("resonance-1").find(s).value));
}

TEST_CASE("scorecard: two branches with known loads, losses and harmonics") {
  SceneResults s = flat_results();
  ResponseResult& down = s.responses["T150/down/response.h5"];
  ResponseResult& up = s.responses["T150/up/response.h5"];
  const Eigen::Index primary = row_of(down, 2400), secondary = row_of(down, 1300);
  down.dte_rms(primary, 0) = 7e-6;
  down.dte_harmonic[static_cast<size_t>(primary)](0, 0) = 0.96 * 7e-6 * std::numbers::sqrt2;
  down.tooth_load_max(primary, 0) = 4500;
  down.separation_fraction(primary, 0) = 0.3;
  down.separations_per_period(primary, 0) = 1;
  down.dte_rms(secondary, 0) = 4e-6;
  down.dte_harmonic[static_cast<size_t>(secondary)](1, 0) = 0.94 * 4e-6 * std::numbers::sqrt2;
  down.separation_fraction(secondary, 0) = 0.2;
  down.separations_per_period(secondary, 0) = 2;
  down.jump_frequency = Eigen::VectorXd::Constant(1, 1290);
  up.jump_frequency = Eigen::VectorXd::Constant(1, 2410);
  up.dte_rms(row_of(up, 2820), 0) = 3e-6;

  CHECK(claim("branches-2400").find(s).value == 1);
  // caption and text name 2400 and 2500 Hz for one pair of branches: one speed between them is enough
  CHECK(claim("branches-2500").find(s).value == 1);
  CHECK(claim("jumps-150").find(s).value == 1);
  CHECK(claim("softening").find(s).value == 1);
  // 4500 N on one tooth, 4000 N in all: all three numbers take the reading that both loads are nearer to
  CHECK(claim("load-upper").find(s).value == 4500);
  CHECK(claim("load-upper").find(s).reading == "one tooth");
  down.mesh_force_max(primary, 0) = 4800;
  CHECK(claim("load-upper").find(s).value == 4500);
  CHECK(claim("load-upper").find(s).reading == "one tooth");
  CHECK(contains(claim("load-upper").find(s).note, "read as one tooth 4500 N, sum over the teeth 4800 N"));
  CHECK(claim("load-lower").find(s).reading == "one tooth");
  CHECK(claim("load-increase").find(s).value == relative(50, 1e-12));
  // ... or what a tooth sustains for 1/64 of a period: a spike of one sample is left out
  MatrixRM& sustained = s.sweeps["T150/down/sweep.h5"].tooth_load[static_cast<size_t>(primary)];
  sustained.setConstant(4850);
  sustained(7, 0) = 9000;
  CHECK(claim("load-upper").find(s).value == 4850);
  CHECK(claim("load-upper").find(s).reading == "one tooth, sustained for 1/64 of a period");
  CHECK(claim("upper-loses-contact-2400").find(s).value == 1);
  CHECK(claim("upper-two-losses-1300").find(s).value == 2);
  CHECK(claim("upper-harmonic-1").find(s).value == 1);
  CHECK(claim("upper-harmonic-2").find(s).value == 0);
  CHECK(claim("lower-keeps-contact-2400").find(s).value == 1);
  CHECK(claim("resonance-1").find(s).value == relative(2820.0 / 2900, 1e-12));
  // 1350 Hz lies between two speeds: the lower one is taken on both sweeps
  down.dte_rms(row_of(down, 1340), 0) = 4e-6;
  // ... and are those of the resonance at f_n / 2 only if the second harmonic is the largest of the upper one; otherwise the
  // speed of the caption counts
  CHECK(contains(claim("lower-keeps-contact-1350").find(s).note, "1300 Hz"));
  SceneResults first = s;
  first.responses["T150/down/response.h5"].dte_harmonic[static_cast<size_t>(secondary)](1, 0) = 0;
  CHECK(std::isnan(claim("lower-keeps-contact-1350").find(first).value));
  CHECK(contains(claim("lower-keeps-contact-1350").find(first).note, "that of f_n"));
  CHECK(claim("branches-1300").find(first).value == 0);
  down.dte_harmonic[static_cast<size_t>(row_of(down, 1340))](1, 0) = 4e-6;
  CHECK(claim("branches-1350").find(s).value == 1);
  CHECK(contains(claim("lower-keeps-contact-1350").find(s).note, "1340 Hz"));

  up.separation_fraction(row_of(up, 2400), 0) = 0.1;
  CHECK(claim("lower-keeps-contact-2400").find(s).value == 0);
}

TEST_CASE("scorecard: shares of harmonics and the tolerance of the increase are what decides the verdict") {
  SceneResults s = flat_results();
  ResponseResult& down = s.responses["T150/down/response.h5"];
  const Eigen::Index primary = row_of(down, 2400);
  down.dte_rms(primary, 0) = 2e-6;
  const Claim& increase = claim("load-increase");
  down.tooth_load_max(primary, 0) = 1.700 * 3000;
  CHECK(verdict(increase, increase.find(s), false) == Verdict::agrees);
  down.tooth_load_max(primary, 0) = 1.702 * 3000;
  CHECK(verdict(increase, increase.find(s), false) == Verdict::differs);
  const Claim& harmonic = claim("upper-harmonic-1");
  for (double share : {0.949, 0.951}) {
    down.dte_harmonic[static_cast<size_t>(primary)](0, 0) = share * 2e-6 * std::numbers::sqrt2;
    CHECK(verdict(harmonic, harmonic.find(s), false) == (share > 0.95 ? Verdict::agrees : Verdict::differs));
  }
}

TEST_CASE(
    "scorecard: the lower branch of the primary resonance is looked at, not that of the resonance at half its speed") {
  SceneResults s = flat_results();
  for (int torque : {100, 200, 300})
    for (const Direction direction : {Direction::up, Direction::down})
      s.responses[text("T", torque, "/", direction, "/response.h5")] = flat_response(torque, direction);
  const auto two_at = [&](int torque, double f, double lower_loss) {
    ResponseResult& down = s.responses[text("T", torque, "/down/response.h5")];
    down.dte_rms(row_of(down, f), 0) = 4e-6;
    ResponseResult& up = s.responses[text("T", torque, "/up/response.h5")];
    up.separation_fraction(row_of(up, f), 0) = lower_loss;
  };
  const Claim& never = claim("lower-never-loses");
  CHECK(std::isnan(never.find(s).value));
  two_at(150, 2400, 0.1);  // a torque of Fig. 5, not of Fig. 7
  two_at(100, 1400, 0.1);  // below 1.15 f_n / 2 = 1667.5 Hz
  CHECK(std::isnan(never.find(s).value));
  two_at(200, 2400, 0);
  CHECK(never.find(s).value == 1);
  two_at(300, 1680, 0.1);
  CHECK(never.find(s).value == 0);
  CHECK(contains(never.find(s).note, "lost at 300 N m: 1680 Hz; looked at 200 N m: 2400 Hz"));
}

TEST_CASE(
    "scorecard: two states stand just below 2500 Hz if all speeds and jumps of the band of f_n are near it") {
  SceneResults s = flat_results();
  ResponseResult& down = s.responses["T150/down/response.h5"];
  ResponseResult& up = s.responses["T150/up/response.h5"];
  const Claim& below = claim("two-states-below-2500");
  const auto two = [&](double from, double to) {
    for (Eigen::Index i = 0; i < down.dte_rms.size(); ++i)
      if (down.mesh_frequency[i] >= from && down.mesh_frequency[i] <= to) down.dte_rms(i, 0) = 4e-6;
    down.jump_frequency = Eigen::VectorXd::Constant(1, from - 5);
    up.jump_frequency = Eigen::VectorXd::Constant(1, to + 5);
  };
  CHECK(below.find(s).value == 0);
  CHECK(below.find(s).note.find("one branch above 166") == 0);
  two(1300, 1320);  // of the resonance at f_n / 2: not looked at
  CHECK(below.find(s).value == 0);
  two(2520, 2700);  // none below 2500 Hz
  CHECK(below.find(s).value == 0);
  two(2160, 2700);
  CHECK(below.find(s).value == 1);
  CHECK(below.find(s).note == "from 2155 to 2705 Hz");
  up.jump_frequency[0] = 2751;
  CHECK(below.find(s).value == 0);
  up.jump_frequency[0] = 2749;
  CHECK(below.find(s).value == 1);
  down.jump_frequency[0] = 2149;
  CHECK(below.find(s).value == 0);
  two(1680, 2160);  // a branch that goes on far below
  CHECK(below.find(s).value == 0);
}

TEST_CASE("scorecard: the bottom line counts what the rows say, in every rendering") {
  const auto always = [](double value) {
    return [=](const SceneResults&) { return Finding{value, "a note"}; };
  };
  const auto claim_of = [](const std::string& id, const std::string& place, const std::string& words,
                           Scale scale, const std::string& unit, double printed, double tolerance,
                           const auto& find) {
    Claim c;
    c.id = id;
    c.place = place;
    c.text = words;
    c.scale = scale;
    c.unit = unit;
    c.printed = printed;
    c.tolerance = tolerance;
    c.basis = "why";
    c.find = find;
    return c;
  };
  const auto readings = [](const SceneResults& s) {
    s.at_rest(100);
    s.at_rest(300);
    s.branches(150);
    return Finding{3000, "read as a 1 N, b 3000 N", "b"};
  };
  std::vector<Claim> claims{claim_of("a", "1", "agrees", Scale::number, "Hz", 100, 1, always(100.5)),
                            claim_of("b", "1", "taken over", Scale::number, "1", 50, 0, always(50)),
                            claim_of("c", "2", "differs", Scale::statement, "yes/no", 1, 0, always(kNone)),
                            claim_of("d", "3", "rig", Scale::incomparable, "yes/no", kNone, 0, always(kNone)),
                            claim_of("e", "3", "misprint", Scale::misprint, "mm", 7, 0, always(70)),
                            claim_of("f", "3", "a fit", Scale::number, "%", 7, 0.5, always(7.25)),
                            claim_of("g", "3", "readings", Scale::number, "N", 3000, 1, readings)};
  claims[1].given = true;
  SceneResults scene;
  scene.name = "x";
  for (const char* file : {"T100/static.h5", "T300/static.h5"}) scene.statics[file] = {};
  for (const char* file : {"T150/up/response.h5", "T150/down/response.h5"}) scene.responses[file] = {};
  const Scorecard card = score(claims, {scene}, {{"x", "eta", {"f"}}});
  REQUIRE(bottom_line(card).size() == 1);
  const std::string line = bottom_line(card)[0];
  CHECK(
      line ==
      "x: 2 agree, 1 differ, 2 given or fitted, 1 cannot be compared, 1 misprint of P2000; 1 numbers fitted to 1 claims");
  CHECK(contains(scorecard_text(card), line));
  CHECK(contains(scorecard_tsv(card, {"out/x/T100/static.h5"}),
                 "# " + line + "\n# from out/x/T100/static.h5\n"));
  const std::string table = scorecard_tsv(card, {});
  CHECK(contains(table, "\tHz\t100\t1\twhy\t100.5\t+0.5 %\t\tagrees\t"));
  CHECK(contains(table, "\t50\t0\twhy\t50\t\t\tgiven\t"));
  CHECK(contains(table, "\twhy\t-\t\t\tdiffers\ta note\t"));
  CHECK(contains(table, "\twhy\t-\t\t\tcannot be compared\ta note\t"));
  CHECK(contains(table, "\tmm\t7\t0\twhy\t70\t+900.0 %\t\tmisprint of P2000\ta note\t"));
  CHECK(contains(table, "\t7.25\t+0.2 percentage points\t\tfitted\t"));
  const std::string sources = "T{100,300}/static.h5 T150/{up,down}/response.h5";
  CHECK(contains(table, "\t3000\t\tb\tagrees\tread as a 1 N, b 3000 N\t" + sources + "\n"));
  // reasons and artifacts in the terminal's table, too
  CHECK(contains(scorecard_text(card), "    why: a note\n"));
  CHECK(contains(scorecard_text(card), "    from, in out/x/: " + sources + "\n"));
  // the rows that data/published/scorecard.tsv is checked against are those of the table, without the scenes
  std::istringstream rows(claims_tsv(claims));
  std::string row;
  while (std::getline(rows, row)) CHECK(contains(table, row));
}

TEST_CASE("scorecard: artifacts that are missing, foreign or given twice are rejected by name") {
  const std::vector<std::string> files = scorecard_files();
  CHECK(std::set<std::string>(files.begin(), files.end()).size() == files.size());
  std::vector<std::string> paths;
  for (const std::string& f : files) paths.push_back("out/x/" + f);
  const auto said = [](const std::vector<std::string>& given) {
    return message_of_input([&] { read_results(given); });
  };
  std::vector<std::string> fewer = paths;
  fewer.erase(std::find(fewer.begin(), fewer.end(), "out/x/T200/impact.h5"));
  CHECK(names(said(fewer), {"T200/impact.h5 of x", "make out/x/T200/impact.h5"}));
  std::vector<std::string> more = paths;
  more.push_back("out/x/T120/static.h5");
  CHECK(names(said(more), {"out/x/T120/static.h5:", "claim"}));
  std::vector<std::string> apart;
  for (const std::string& f : files)
    if (f != "T200/impact.h5") apart.push_back("results/x/" + f);
  CHECK(names(said(apart), {"T200/impact.h5 of x", "results/x/T200/impact.h5"}));
  more.back() = "elsewhere/x/T200/impact.h5";
  CHECK(names(said(more), {"elsewhere/x/T200/impact.h5:", "T200/impact.h5 of x", "twice"}));
  // what a claim asks for and memory does not hold
  const SceneResults nothing{"y", {}, {}, {}, {}};
  CHECK(names(message_of([&] { claim("table1-one-300").find(nothing); }), {"T300/impact.h5", "y"}));
}

TEST_CASE("scorecard: no claim reads an artifact that is not on the list of files") {
  // Artifacts without content: whatever a claim does with them, it asks for one of the list first.
  const std::vector<std::string> files = scorecard_files();
  for (const Claim& c : paper_claims()) {
    CAPTURE(c.id);
    const std::string said = message_of([&] { c.find(SceneResults{"y", {}, {}, {}, {}}); });
    if (said.empty()) continue;  // reads none
    const size_t begin = said.find("scorecard: ") + 11;
    const std::string file = said.substr(begin, said.find(" of y") - begin);
    CHECK(std::find(files.begin(), files.end(), file) != files.end());
  }
}
