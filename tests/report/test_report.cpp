#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <regex>
#include <set>
#include <sstream>

#include "base/error.h"
#include "figure_block.h"
#include "gear/body_inertia.h"
#include "gear/train.h"
#include "io/publish.h"
#include "io/scene_keys.h"
#include "paper/beside.h"
#include "paper_pair.h"
#include "refusal.h"
#include "relative.h"
#include "report/engineering_axes.h"
#include "report/figure_list.h"
#include "report/measured_errors.h"
#include "report/report.h"
#include "report/report_figures.h"
#include "report/report_guide.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "signal/response.h"
#include "signal/spectrum.h"
#include "studies/sweep.h"
#include "system/flank_pressure.h"
#include "system/statics.h"

using namespace whine;

namespace {

constexpr double kPi = std::numbers::pi;

SystemStaticResult rest_of_paper(double torque) {
  constexpr int kPositions = 64;
  SystemStaticResult rest = pair_at_rest(paper_body(), paper_body(), paper_statics(kPositions), torque);
  set_harmonics(rest.mesh[0]);
  return rest;
}

StaticResult statics_of_paper(double torque) {
  return rest_of_paper(torque).mesh[0];
}

// Speeds of 1000, 1100, ... Hz; the transmission error has 3 um of order 1, 2 um of order 2 and, at the second speed, whose
// motion repeats after two periods, 1 um of order 1/2. One pair carries the load, 10 N more at each speed, 5 N more in the
// second of two periods.
SweepResult some_sweep(Direction direction, int speeds = 4) {
  constexpr int kSteps = 32;
  SweepResult s;
  s.gear[0].design = s.gear[1].design = paper_gear();
  s.mesh.gear[0] = "pinion";
  s.mesh.gear[1] = "wheel";
  s.mesh.centre_distance = 0.150;
  s.torque = 150;
  s.direction = direction;
  s.natural_frequency = 2900;
  s.inertia[0] = s.inertia[1] = 0.0148;
  s.time.steps_per_period = kSteps;
  s.mesh_frequency = Eigen::VectorXd::LinSpaced(speeds, 1000, 1000 + 100 * (speeds - 1));
  if (direction == Direction::down) s.mesh_frequency.reverseInPlace();
  s.pair.resize(1);
  s.pair << 0;
  s.place_pair(pair_system(s));
  s.transmission_error.assign(static_cast<size_t>(speeds), MatrixRM(2 * kSteps, 1));
  s.mesh_force = s.transmission_error;
  s.period_multiple = Eigen::VectorXi::Ones(speeds);
  s.period_multiple[1] = 2;
  s.periods = Eigen::VectorXi::Constant(speeds, 10);
  s.residual = s.energy_imbalance = s.drift_force = Eigen::VectorXd::Zero(speeds);
  s.energy.setZero(speeds, kEnergyLines.size());
  for (int i = 0; i < speeds; ++i) {
    MatrixRM load(2 * kSteps, 1);
    for (int t = 0; t < 2 * kSteps; ++t) {
      const double phase = 2 * kPi * t / kSteps;
      double& error = s.transmission_error[static_cast<size_t>(i)](t, 0);
      error = 1e-6 * (5 + 3 * std::cos(phase) + 2 * std::cos(2 * phase + 1));
      if (i == 1) error += 1e-6 * std::cos(0.5 * phase);
      load(t, 0) = 100 + 10 * i + (i == 1 && t >= kSteps ? 5 : 0);
      s.mesh_force[static_cast<size_t>(i)](t, 0) = load(t, 0);
    }
    s.tooth_load.push_back(load);
  }
  return s;
}

ResponseResult curve(const std::vector<double>& rms) {
  ResponseResult r;
  const auto n = static_cast<Eigen::Index>(rms.size());
  r.mesh_frequency = Eigen::VectorXd::LinSpaced(n, 1000, 1000 + 100 * static_cast<double>(n - 1));
  r.dte_rms = Eigen::Map<const Eigen::VectorXd>(rms.data(), n);
  return r;
}

}  // namespace

TEST_CASE("load sharing: shares at a mesh phase add up to the whole load, periods follow each other") {
  const StaticResult light = statics_of_paper(100), heavy = statics_of_paper(300);
  const Figure figure = load_sharing_figure({heavy, light});
  const FigureBlock& share = block(figure, "share");
  std::map<long, std::array<double, 2>> sums;  // by mesh phase
  for (const auto& row : share.rows) {
    const long phase = std::lround((row[0] - std::floor(row[0])) * 64) % 64;
    for (int t = 0; t < 2; ++t) sums[phase][static_cast<size_t>(t)] += row[static_cast<size_t>(t) + 1];
    // At the pitch point one pair of the paper's gears carries all.
    if (row[0] == 0) CHECK(row[1] == relative(100, 1e-12));
  }
  CHECK(sums.size() == 64);
  for (const auto& [phase, sum] : sums)
    for (const double whole : sum) CHECK(whole == relative(100, 1e-12));
  // Torques stand as they are given, and tip edges under more load share for longer.
  CHECK(contains(share.columns[1], "300 N m"));
  const auto loaded = [&](size_t column) {
    return std::count_if(share.rows.begin(), share.rows.end(),
                         [&](const auto& row) { return row[column] > 0; });
  };
  CHECK(loaded(1) > loaded(2));
  CHECK(static_cast<double>(loaded(2)) / 64 > light.contact_ratio);
  // What a pair carries at the end of a period the one ahead of it carries at the start.
  const FigureBlock& loads = block(figure, "loads");
  REQUIRE(loads.rows.size() == 65);
  // They are of the torque that the scene lists first.
  CHECK(loads.rows[0][1] == relative(heavy.torque / ToothGeometry(heavy.gear[0].design).base_radius(), 1e-9));
  for (size_t pair = 2; pair + 1 < loads.columns.size(); ++pair)
    CHECK(loads.rows.back()[pair] == loads.rows.front()[pair + 1]);
  for (const auto& row : loads.rows) {
    double sum = 0;
    for (size_t pair = 2; pair < row.size(); ++pair) sum += row[pair];
    CHECK(sum == relative(row[1], 1e-12));
  }
}

TEST_CASE(
    "waterfall: lines stand at the orders of what is known, half orders where the motion repeats after two periods") {
  const Figure figure = waterfall_figure({some_sweep(Direction::up)});
  std::map<std::pair<double, double>, double> lines;
  for (const auto& row : block(figure, "spectra up").rows)
    if (!row.empty()) lines[{row[0], row[1]}] = row[2];
  CHECK(lines.size() == 4 * 2 + 1);
  for (const double f : {1000.0, 1100.0, 1200.0, 1300.0}) {
    CHECK(lines.at({f, f}) == relative(3, 1e-12));
    CHECK(lines.at({f, 2 * f}) == relative(2, 1e-12));
  }
  CHECK(lines.at({1100, 550}) == relative(1, 1e-12));
  // An order that is there at two speeds is not drawn between them.
  SweepResult apart = some_sweep(Direction::up);
  apart.period_multiple[3] = 2;
  apart.transmission_error[3] = apart.transmission_error[1];
  const std::vector<std::vector<double>> rays = block(waterfall_figure({apart}), "spectra up").rows;
  const auto half =
      std::find_if(rays.begin(), rays.end(), [](const auto& row) { return !row.empty() && row[1] == 550; });
  REQUIRE(rays.end() - half > 2);
  CHECK(half[1].empty());
  CHECK(half[2][0] == 1300);
  // In dB re 10 µm all lie below 0, and all are drawn.
  Figure levels = figure;
  apply({"", 1e-5}, levels);
  CHECK(block(levels, "spectra up").columns[2] == "amplitude [dB re 10 µm RMS]");
  CHECK(block(levels, "spectra up").rows[0][2] < 0);
  CHECK(levels.panels[0].colours->to > levels.panels[0].colours->from);
  CHECK(levels.panels[0].curves[1].where == 0);
  // Of many speeds those with the largest RMS: every second one of 320, but that of the half order.
  const Figure many = waterfall_figure({some_sweep(Direction::down, 320)});
  std::set<double> shown;
  for (const auto& row : block(many, "spectra down").rows)
    if (!row.empty()) shown.insert(row[0]);
  CHECK(shown.size() == 160);
  CHECK(shown.count(32800) == 1);
  // Of two sweeps the rising one comes first, each with blocks of its own. Lines of orders end at the frame.
  const Figure both = waterfall_figure({some_sweep(Direction::down), some_sweep(Direction::up)});
  REQUIRE(both.blocks.size() == 4);
  CHECK(both.blocks[0].rows == block(figure, "spectra up").rows);
  for (const PanelAxis& frequency : {both.panels[0].x, both.panels[1].x})
    for (const auto& row : block(both, "orders down").rows)
      if (!row.empty()) CHECK(row[1] <= frequency.to * (1 + 1e-12));
  CHECK_THROWS_AS(waterfall_figure({some_sweep(Direction::up), some_sweep(Direction::up)}), Error);
  SweepResult heavier = some_sweep(Direction::down);
  heavier.torque = 300;
  CHECK_THROWS_AS(waterfall_figure({some_sweep(Direction::up), heavier}), Error);
}

TEST_CASE("tooth loads against speed: those of the sweeps, the period of the largest load in the middle") {
  const Figure figure = dynamic_load_figure({some_sweep(Direction::down), some_sweep(Direction::up)});
  for (const Direction direction : {Direction::up, Direction::down}) {
    const SweepResult sweep = some_sweep(direction);
    const ResponseResult r = response(sweep);
    size_t i = 0;
    for (const auto& row : block(figure, name_of(direction)).rows) {
      if (row.empty()) continue;
      CHECK(row[5] == r.tooth_load_max(static_cast<Eigen::Index>(i++), 0));
    }
    CHECK(i == 4);
  }
  // The half order has the largest RMS; at 1100 Hz on the way up, with 115 N in the second period.
  for (const auto& row : block(figure, "b tooth i+0").rows)
    if (!row.empty() && row[0] >= 0 && row[0] < 1) CHECK(row[1] == 115);
  SweepResult other = some_sweep(Direction::down);
  other.torque = 200;
  CHECK(failure_of([&] { dynamic_load_figure({some_sweep(Direction::up), other}); }) == Failure::input);
  SweepResult second = some_sweep(Direction::up);
  second.torque = 200;
  CHECK(failure_of([&] {
          dynamic_load_figure({some_sweep(Direction::up), some_sweep(Direction::down), second, other});
        }) == Failure::input);
}

TEST_CASE("resonances: peaks that stand out, no end of a sweep, in either order of the speeds") {
  const auto at = [](const std::vector<double>& rms) {
    std::vector<Eigen::Index> rows = resonances(curve(rms));
    return std::vector<long>(rows.begin(), rows.end());
  };
  CHECK(at({1, 3, 1, 1.1, 1, 5, 2}) == std::vector<long>{1, 5});
  CHECK(at({5, 3, 1}).empty());
  CHECK(at({1, 3, 5}).empty());
  CHECK(at({1, 5, 4.9, 5.1, 1}) == std::vector<long>{3});  // two tips of one
  CHECK(at({1, 2, 2, 1}) == std::vector<long>{1});
  ResponseResult down = curve({1, 3, 1, 1, 1, 5, 2});
  down.mesh_frequency.reverseInPlace();
  CHECK(resonances(down) == std::vector<Eigen::Index>{5, 1});  // ascending in frequency
}

TEST_CASE("base64: the vectors of RFC 4648") {
  for (const auto& [bytes, words] : std::map<std::string, std::string>{
           {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}})
    CHECK(base64(bytes) == words);
  CHECK(base64(std::string("\0\xff", 2)) == "AP8=");
}

TEST_CASE("report: numbers of the artifacts, words that are no marks, figures only of known names") {
  ReportContent content;
  content.scene = "pair: <Gears> & \"teeth\"";
  content.statics = {rest_of_paper(150), rest_of_paper(100)};
  content.sweeps = {response(some_sweep(Direction::up)), response(some_sweep(Direction::down))};
  content.sweeps[0].remarks = {remark(true, "back flanks < touch")};
  content.pictures = {{"transmission-error", "\x89PNG"}};
  const std::string page = report_html(content);
  const auto holds = [&](const std::string& words) { return contains(page, words); };
  CHECK(holds("<title>&lt;Gears&gt; &amp; &quot;teeth&quot;</title>"));
  CHECK(holds("back flanks &lt; touch"));
  CHECK(holds("src=\"data:image/png;base64,iVBORw==\""));
  CHECK(holds("<td>bore_radius_mm</td><td class=\"number\">40</td><td class=\"number\">40</td>"));
  CHECK_FALSE(holds("id=\"frequencies\""));
  // The torque of the scene's first line stands first.
  CHECK(holds(">100 N m</th>"));
  CHECK(page.find(">150 N m</th>") < page.find(">100 N m</th>"));
  CHECK(report_html(content) == page);
  // The page opens with the picture and five lines, which stand before the list of contents.
  const size_t opening = page.find("<section id=\"opening\""), contents = page.find("<nav aria-label");
  REQUIRE(opening < contents);
  const std::string first = page.substr(opening, contents - opening);
  CHECK(contains(first, "At 150 N m the transmission error swings from peak to peak by " +
                            significant(peak_to_peak(content.pair().transmission_error) * 1e6, 3) + " µm"));
  CHECK(contains(first, "(2900 Hz)"));
  CHECK(contains(first,
                 "From 1200 to 1560 rpm (1000 to 1300 Hz) teeth do not part, with speed rising or falling."));
  CHECK(contains(first,
                 "The mesh force reaches 0.06 times its mean at rest, at 1560 rpm (1300 Hz), where K_v"));
  // Groups of a dozen rows at most, each below its heading.
  size_t groups = 0;
  for (size_t at = page.find("<h3>"); at != std::string::npos; at = page.find("<h3>", at + 1), ++groups) {
    const std::string table = page.substr(at, page.find("</table>", at) - at);
    size_t rows = 0;
    for (size_t row = table.find("<tr>"); row != std::string::npos; row = table.find("<tr>", row + 1)) ++rows;
    CHECK(rows > 1);
    CHECK(rows <= 13);  // with the line of names
  }
  CHECK(groups == 10);
  CHECK(holds(
      "mesh frequency of that tooth load, rising / falling</td><td>Hz<br>rpm</td><td class=\"number\">1300 / 1000<br>1560 / 1200</td>"));

  const std::string table = report_tsv(content);
  CHECK(contains(table, "150\t\tlargest tooth load, speed rising\t130.0\tN\t\t\n"));
  CHECK(!contains(table, "100\t\tlargest tooth load"));
  CHECK(contains(
      table,
      "150\t\tmesh frequency of that tooth load, speed rising\t1300\tHz\t\t\n"
      "150\t\tmesh frequency of that tooth load, speed rising, as rotation of the driver\t1560\trpm\t\t\n"));
  // Loads jump by 5 N in the second of two periods at 1100 Hz alone: no order of the mesh frequency.
  CHECK(contains(table, "150\t\tlargest first order of the mesh force, speed rising\t"));
  CHECK(contains(table, "150\t\tcontact lost, speed rising\t\tHz\tnowhere\t\n"));
  CHECK(contains(table, "150\t\tcontact lost, speed falling\t\tHz\tnowhere\t\n"));

  const auto rejected = [&](auto change) {
    ReportContent other = content;
    change(other);
    return failure_of([&] { report_html(other); }) == Failure::input;
  };
  CHECK_FALSE(rejected([](ReportContent&) {}));
  CHECK(rejected([](ReportContent& c) { c.statics.clear(); }));
  CHECK(rejected([](ReportContent& c) { c.pictures[0].name = "fig99"; }));
  CHECK(rejected([](ReportContent& c) { c.pictures.push_back(c.pictures[0]); }));
  CHECK(rejected([](ReportContent& c) { c.statics[1].mesh[0].gear[1].design.teeth = 51; }));
}

TEST_CASE(
    "remarks that differ by torque alone are one, with their torques; both ways where these are the same") {
  ReportContent content;
  content.scene = "pair: gears";
  for (const double torque : {100.0, 150.0, 200.0, 300.0})
    for (const Direction direction : {Direction::up, Direction::down}) {
      ResponseResult r = response(some_sweep(direction));
      r.torque = torque;
      std::vector<Remark>& found = r.remarks = {remark(true, "the same of all")};
      if (direction == Direction::up && torque < 180) found.push_back(remark(false, "of two torques"));
      if (direction == Direction::down || torque > 250) found.push_back(remark(false, "of other torques"));
      if (torque == 200) found.push_back(remark(false, "the same of all"));  // no warning
      found.push_back(remark(false, "planet1 swings ", 0.01 * torque, " µm of 5. Lower it"));
      found.push_back(remark(false, "at ", 20 * torque, " Hz"));
      content.sweeps.push_back(r);
    }
  const std::string items = remarks_list(content);
  const auto count = [&](const std::string& words) {
    size_t n = 0;
    for (size_t at = 0; (at = items.find(words, at)) != std::string::npos; ++at) ++n;
    return n;
  };
  CHECK(count("the same of all") == 2);
  CHECK(
      count(
          "<strong>Warning.</strong> speed rising and speed falling, 100, 150, 200 and 300 N m: the same of all.") ==
      1);
  CHECK(count("<li>speed rising and speed falling, 200 N m: the same of all.") == 1);
  CHECK(count("speed rising, 100 and 150 N m: of two torques.") == 1);
  CHECK(count("100, 150, 200 and 300 N m: planet1 swings 1 to 3 µm of 5. Lower it.") == 1);
  CHECK(count(": at 2000, 3000, 4000 and 6000 Hz.") == 1);
  CHECK(count("speed falling, 100, 150, 200 and 300 N m; speed rising, 300 N m: of other torques.") == 1);
}

TEST_CASE("report: the inertia that moves stands beside that of the drawing") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  const StaticResult& s = content.pair();
  CHECK(!contains(report_html(content), "inertia in motion"));
  ImpactResult a;
  a.gear[0].design = s.gear[0].design;
  a.gear[1].design = s.gear[1].design;
  a.gear[0].material = s.gear[0].material;
  a.gear[1].material = s.gear[1].material;
  a.mesh = s.mesh;
  a.torque = 150;
  a.inertia[0] = 1.01 * least_body_inertia(ToothGeometry(s.gear[0].design), s.gear[0].material);
  a.inertia[1] = 0.5;
  content.impacts = {a};
  const std::string page = report_html(content);
  const size_t row = page.find("inertia in motion");
  REQUIRE(row != std::string::npos);
  const std::string cells = page.substr(row, page.find("</tr>", row) - row);
  CHECK(contains(cells, ", as drawn"));
  CHECK(cells.find(", as drawn", cells.find(", as drawn") + 1) == std::string::npos);
  CHECK(contains(cells, "0.5"));
}

TEST_CASE("report: what the numbers mean is said of what is on the page, and of every figure") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  const auto guide = [&] {
    const std::string page = report_html(content);
    const size_t begin = page.find("<section id=\"guide\">");
    REQUIRE(begin != std::string::npos);
    return page.substr(begin, page.find("</section>", begin) - begin);
  };
  const std::string at_rest = guide();
  CHECK(contains(at_rest, "Static transmission error"));
  CHECK(contains(at_rest, "DTE is the dynamic transmission error"));
  CHECK(!contains(at_rest, "Damping"));
  CHECK(!contains(at_rest, "ring-down"));
  for (const std::string& name : report_figures()) content.pictures.push_back({name, "\x89PNG"});
  content.sweeps = {response(some_sweep(Direction::up))};
  const std::string all = guide();
  CHECK(contains(all, "As good as your guess"));
  content.statics[0].mesh[0].face.line_load.resize(1);
  content.impacts.resize(1);
  content.modes.emplace();
  const std::string over_face = guide_to_numbers(content);
  for (const std::string& name : report_figures()) {
    CAPTURE(name);
    const std::string link = "<a href=\"#" + name + "\">";
    CHECK((contains(all, link) || contains(over_face, link)));
  }
}

TEST_CASE(
    "report: every accuracy that it quotes stands in tests/accuracy.tsv, and every one of the table in the report") {
  ReportContent content;
  content.statics = {rest_of_paper(150)};
  content.impacts.resize(1);
  content.sweeps.resize(1);
  content.pictures = {{"response-branches", "\x89PNG"}, {"flank-pressure", "\x89PNG"}};
  const std::string guide = guide_to_numbers(content);
  // "<tr><td>what, links</td><td>reading</td><td>trust</td>..." of the row of a name
  const auto row = [&](const std::string& name) {
    const size_t begin = guide.find("<tr><td>" + name);
    return begin == std::string::npos ? std::string()
                                      : guide.substr(begin, guide.find("</tr>", begin) - begin);
  };
  std::ifstream table("tests/accuracy.tsv");
  std::string line;
  std::set<std::string> errors;
  while (std::getline(table, line)) {
    if (line.starts_with("#")) continue;
    CAPTURE(line);
    std::istringstream columns(line);
    std::string quantity, error, command, name;
    std::getline(
        std::getline(std::getline(std::getline(columns, quantity, '\t'), error, '\t'), command, '\t'), name,
        '\t');
    CHECK(contains(row(name), error));
    errors.insert(error);
  }
  CHECK(errors.size() > 5);
  const std::regex leading("<td>([0-9.]+( to [0-9.]+)? (%|Hz))");
  for (std::sregex_iterator found(guide.begin(), guide.end(), leading), none; found != none; ++found) {
    CAPTURE(found->str());
    CHECK(errors.contains((*found)[1].str()));
  }
}

TEST_CASE("report: measured errors stand beside numbers of their torque, rounded up, and nowhere else") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150), rest_of_paper(100)};
  const SweepResult sweep = some_sweep(Direction::up);
  content.sweeps = {response(sweep)};
  CHECK(words_on_errors(content).empty());
  const ResponseResult& r = content.sweeps[0];
  const Eigen::Index speeds = r.mesh_frequency.size();
  ErrorBudgetResult budget;
  static_cast<GearPairParameters&>(budget) = content.pair();
  budget.torque = 150;
  budget.gear_names = content.statics[0].settings.gears();
  budget.refinement = {"strips, elements",
                       Eigen::Vector2d(1e-3, -2e-3),
                       Eigen::Vector2d(3e-3, 1e-3),
                       {},
                       MatrixRM::Constant(2, 5, 5e-3)};
  content.budget = budget;
  CHECK(contains(words_on_errors(content), "make motion-errors"));
  SweepErrorsResult errors;
  static_cast<MotionSource&>(errors) = r;
  errors.direction = Direction::up;
  errors.mesh_frequency = r.mesh_frequency;
  errors.compared = MatrixRMi::Ones(1, speeds);
  errors.natural_frequency_error = 2e-3;
  for (auto quantity :
       {&SweepErrorsResult::dte_rms, &SweepErrorsResult::dte_first_order, &SweepErrorsResult::tooth_load_max,
        &SweepErrorsResult::tooth_load_sustained, &SweepErrorsResult::mesh_force_max})
    (errors.*quantity).error = MatrixRM::Constant(speeds, 1, 0.013);
  content.errors = {errors};
  const auto number = [&](double torque, const std::string& quantity) {
    for (const ReportNumber& n : report_numbers(content))
      if (n.torque == torque && n.quantity == quantity) return n;
    FAIL("there is no ", quantity);
    return ReportNumber{};
  };
  const StaticResult& s = content.pair();
  const ReportNumber stiffness = number(150, "mean mesh stiffness");
  CHECK(stiffness.value == told(s.mean_stiffness * 1e-6, 3e-3 * s.mean_stiffness * 1e-6, 5).value);
  CHECK(std::stod(stiffness.error) >= 3e-3 * s.mean_stiffness * 1e-6);
  CHECK(std::stod(stiffness.error) < 6.1e-3 * s.mean_stiffness * 1e-6);
  CHECK(number(100, "mean mesh stiffness").error.empty());
  // 130 N with 1.3 %: 1.69 N, rounded up.
  CHECK(number(150, "largest tooth load, speed rising").value == "130.0");
  CHECK(number(150, "largest tooth load, speed rising").error == "1.7");
  CHECK(number(150, "natural frequency f_n, contact frozen, mean over the period").error == "6");
  const std::string page = report_html(content);
  CHECK(contains(page, "130.0 ± 1.7"));
  CHECK(contains(page, "(2900 ± 6 Hz)"));
  CHECK(contains(report_tsv(content), "largest tooth load, speed rising\t130.0\tN\t\t1.7\n"));
  // Where a refined sweep is on another branch nothing is told.
  content.errors[0].compared.setZero();
  CHECK(number(150, "largest tooth load, speed rising").error.empty());
}

TEST_CASE("results: one line of names, geometry without a torque, as many cells in each line") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  content.sweeps = {response(some_sweep(Direction::up))};
  std::istringstream lines(report_tsv(content));
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(lines, line);) {
    if (line[0] == '#') continue;
    CHECK(!contains(line, "#"));
    std::vector<std::string> cells{""};
    for (const char c : line)
      if (c == '\t')
        cells.emplace_back();
      else
        cells.back() += c;
    REQUIRE(cells.size() == 7);
    rows.push_back(cells);
  }
  CHECK(rows[0] ==
        std::vector<std::string>{"torque [N m]", "part", "quantity", "value", "unit", "remark", "error"});
  const auto value = [&](const std::string& quantity, const std::string& part = "") {
    for (const auto& row : rows)
      if (row[2] == quantity && row[1] == part && row[0].empty()) return std::stod(row[3]);
    return -1.0;
  };
  CHECK(value("contact ratio") == relative(content.pair().contact_ratio, 1e-4));
  // Two equal gears: the driver's points mirror the driven gear's; where a pair comes the driven gear touches with its tip.
  const std::string sap = "diameter where the active profile starts (SAP), ";
  CHECK(value(sap + "pinion (driver)") > 0);
  CHECK(value(sap + "pinion (driver)") == value(sap + "wheel (driven)"));
  CHECK(value("diameter at B, from where one pair carries alone, pinion (driver)") ==
        value("diameter at D, up to where it does, wheel (driven)"));
  CHECK(value("working pitch diameter, pinion (driver)") == 150);
  CHECK(value("tip diameter", "wheel") == 156);
  CHECK(value("root diameter", "wheel") == 142.5);
  CHECK(value("tooth thickness at the reference circle (transverse and normal)", "wheel") == 4.7124);
  CHECK(value("teeth k in the span", "pinion") == 6);
  CHECK(value("span W_k over these teeth", "pinion") == 50.811);  // 3 x 16.9370 mm of handbooks
  CHECK(value("tip clearance, to the root circle of the mate, pinion (driver)") == 0.75);
  CHECK(value("root clearance, to the tip circle of the mate, wheel (driven)") == 0.75);
  CHECK(value("specific sliding where a pair comes into contact, pinion (driver)") == -0.8691);
}

TEST_CASE("report of a pair: its bodies are in balance, with forces along the axes of the picture") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  const auto value = [&](const std::string& body, const std::string& quantity) {
    for (const ReportNumber& n : report_numbers(content))
      if (n.part == body && n.quantity == quantity) return std::stod(n.value);
    FAIL("there is no ", quantity);
    return 0.0;
  };
  CHECK(value("pinion", "torque, mean") == 150);
  CHECK(value("wheel", "torque, mean") == relative(-150, 1e-3));
  // The driver turns counter-clockwise and pushes the gear to its right upwards, so that its own bearing is pressed down, along the line of
  // action at 20 degrees; the mesh force is the torque over the base radius but where tip edges carry load.
  const double force = static_force(content.pair()), angle = 20 * kPi / 180;
  const std::string x = "its mean along x, to the right", y = "its mean along y, upwards";
  CHECK(value("pinion", "force on the bearing, mean") == relative(force, 0.01));
  CHECK(value("pinion", x) == relative(-force * std::sin(angle), 0.03));
  CHECK(value("pinion", y) == relative(-force * std::cos(angle), 0.01));
  for (const std::string& along : {x, y}) CHECK(value("pinion", along) + value("wheel", along) == 0);
}

TEST_CASE("report: numbers of motions beyond the backlash are marked, with the speeds") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  content.pictures = {{"responses-by-torque", "\x89PNG"}};
  SweepResult up = some_sweep(Direction::up), down = some_sweep(Direction::down);
  // The half order at the second speed swings farthest back.
  up.backlash_margin = -1e-7;
  down.backlash_margin = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd left = backlash_left(up);
  CHECK(left.minCoeff() == relative(-1e-7, 1e-9));
  CHECK((left.array() <= 0).count() == 1);
  CHECK(left[1] < 0);
  CHECK(std::isinf(backlash_left(down).minCoeff()));
  const std::vector<Remark> said = remarks(up, content.pair());
  CHECK(std::any_of(said.begin(), said.end(), [](const Remark& r) {
    return r.warning && contains(r.words, "at 1100 Hz the motion goes up to 0.1 µm beyond");
  }));
  for (SweepResult* s : {&up, &down}) {
    s->backlash_left = backlash_left(*s);
    s->remarks = remarks(*s, content.pair());
    content.sweeps.push_back(response(*s));
  }
  name_figures_of_paper(content);
  const std::string table = report_tsv(content), page = report_html(content);
  CHECK(contains(table, "mesh frequency of that RMS, speed rising\t1100\tHz\tbeyond the backlash\t\n"));
  CHECK(contains(table, "150\t\tmotion beyond the backlash, speed rising\t1100\tHz\t\t\n"));
  CHECK(contains(table, "150\t\tlargest tooth load, speed rising\t130.0\tN\t\t\n"));  // at 1300 Hz
  CHECK(!contains(table, "motion beyond the backlash, speed falling"));
  CHECK(contains(page, ">1100 * / 1200<br>1320 * / 1440</td>"));
  CHECK(contains(page, "not modelled: 150 N m, speed rising: 1100 Hz (1320 rpm)."));  // below the responses
  CHECK(contains(page, "what Figure 7 of P2000 shows"));
  for (ResponseResult& s : content.sweeps) s.backlash_left.setConstant(1e-6);
  CHECK(!contains(report_html(content), "1100 *"));
}

TEST_CASE("an energy balance that does not close is warned of, with its speed and its size") {
  SweepResult sweep = some_sweep(Direction::up);
  const StaticResult statics = statics_of_paper(150);
  const auto warned = [&] {
    const std::vector<Remark> said = remarks(sweep, statics);
    return std::any_of(said.begin(), said.end(), [](const Remark& r) {
      return r.warning &&
             contains(r.words,
                      "the energy balance does not close: at 1100 Hz it is off by 0.057 of the energy");
    });
  };
  sweep.energy_imbalance = Eigen::VectorXd::Constant(sweep.mesh_frequency.size(), -9e-7);
  CHECK(!warned());
  sweep.energy_imbalance[1] = -0.057;
  CHECK(warned());
}

TEST_CASE(
    "report: Hertz's pressure of the largest load is that of the statics, and warned of where no steel carries it") {
  ReportContent content;
  content.scene = "pair: gears";
  content.statics = {rest_of_paper(150)};
  const StaticResult& s = content.pair();
  Eigen::Index pair = 0;
  const double load = s.tooth_load.row(0).maxCoeff(&pair);  // at the pitch point, of one pair alone
  SweepResult sweep = some_sweep(Direction::up);
  for (MatrixRM& loads : sweep.tooth_load) loads.setConstant(load);
  for (MatrixRM& force : sweep.mesh_force) force.setConstant(load);
  content.sweeps = {response(sweep)};
  const std::string
      table = report_tsv(content),
      name = "nominal contact pressure of the largest tooth load (Hertz, at the pitch point), speed rising\t";
  const size_t at = table.find(name);
  REQUIRE(at != std::string::npos);
  CHECK(std::stod(table.substr(at + name.size())) == relative(s.contact_pressure(0, pair) * 1e-6, 5e-3));

  CHECK(!contains(report_html(content), "hardened steel"));
  // A jump between speeds that stand wide apart, and between near ones.
  ResponseResult& swept = content.sweeps[0];
  const Eigen::VectorXd speeds = swept.mesh_frequency;
  REQUIRE(speeds.size() > 1);
  const double step = std::abs(speeds[1] - speeds[0]), jump = 0.5 * (speeds[0] + speeds[1]);
  swept.jump_frequency = swept.jump_width = Eigen::VectorXd::Constant(1, jump);
  CHECK((contains(report_html(content), "a sweep may leave a branch before its end")) ==
        (step > 0.02 * jump));
  swept.mesh_frequency = jump + (speeds.array() - speeds.mean()) * 0.03 * jump / step;
  CHECK(contains(report_html(content), " % of the speed: with steps above 2 % a sweep may leave a branch"));
  // Of two ways it is said once, with the speeds of both.
  ReportContent two = content;
  two.sweeps.push_back(two.sweeps[0]);
  ResponseResult& other = two.sweeps[1];
  other.direction = Direction::down;
  other.mesh_frequency *= 1.1;
  other.jump_frequency *= 1.1;
  const std::string both = report_html(two), words = "a sweep may leave a branch before its end";
  CHECK(both.find(words) == both.rfind(words));
  CHECK(contains(both, "the motion jumps at " + fixed(jump, 0) + " and " + fixed(1.1 * jump, 0) + " Hz (" +
                           fixed(1.2 * std::round(jump), 0) + " and " +
                           fixed(1.2 * std::round(1.1 * jump), 0) + " rpm), where"));
  swept.mesh_frequency = jump + (speeds.array() - speeds.mean()) * 0.015 * jump / step;
  CHECK(!contains(report_html(content), "a sweep may leave a branch"));
  swept.mesh_frequency = speeds;
  swept.jump_frequency = swept.jump_width = Eigen::VectorXd(0);
  StaticResult pressed = s;
  pressed.contact_pressure(0, pair) = 1.6e9;
  pressed.flank_pressure = flank_pressure(pressed);
  const std::vector<Remark> said = remarks(pressed);
  CHECK(std::any_of(said.begin(), said.end(),
                    [](const Remark& r) { return r.warning && contains(r.words, "of 1.6 GPa is above"); }));
  content.sweeps[0].tooth_load_max *= 20;
  CHECK(contains(report_html(content), "hardened steel"));
}

TEST_CASE("keys of a scene from its artifacts: in the scene's units, motion only where there is one") {
  const auto value = [](const SceneKeys& keys, const std::string& name) {
    for (const SceneKeys::Row& key : keys.rows)
      if (key.name == name) return key.value[0] + "|" + (key.value.size() > 1 ? key.value[1] : "");
    return std::string("none");
  };
  StaticResult s = statics_of_paper(100);
  const SceneKeys keys = scene_keys_of(s);
  CHECK(value(keys, "teeth") == "50|50");
  CHECK(value(keys, "youngs_modulus_GPa") == "207|207");
  CHECK(value(keys, "pressure_angle_deg") == "20|20");
  CHECK(value(keys, "centre_distance_mm") == "150|");
  CHECK(value(keys, "corner_contact") == "true|");
  CHECK(value(keys, "rayleigh_stiffness_s") == "none");
  CHECK(value(keys, "tip_relief_um") == "none");
  s.mesh.modification[1].points = {{0.3, 1e-6}, {0.4, 2e-6}};
  s.mesh.errors[0].single_pitch = {1e-6, -1e-6};
  CHECK(value(scene_keys_of(s), "points") == "|[[17.1887, 1], [22.9183, 2]]");
  CHECK(value(scene_keys_of(s), "single_pitch_um") == "[1, -1]|");
  const ResponseResult r = response(some_sweep(Direction::up));
  CHECK(value(scene_keys_of(r), "total_inertia_kgm2") == "0.0148|0.0148");
  CHECK(value(scene_keys_of(r), "undamped_depth_mm") == "0.5|");
}
