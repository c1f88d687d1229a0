#include "report/compare_figures.h"

#include <algorithm>
#include <array>
#include <set>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "report/figure_words.h"
#include "report/response_figures.h"

namespace whine {
namespace {

using Eigen::Index;

// Pairs are compared at one torque; torque: of one of `designs` designs, 0: of a train.
struct Compared {
  std::string design;
  double torque;
};

void require_all_designs(const std::vector<Compared>& all, size_t curves, const char* artifact) {
  std::set<std::string> designs;
  for (const Compared& one : all) designs.insert(one.design);
  if (designs.size() < 2 || designs.size() > kMostCurves)
    fail(Failure::input, "figure: ", designs.size(), " designs given; two to ", kMostCurves,
         " can be compared");
  if (curves > kMostCurves)
    fail(Failure::input, "figure: the designs have ", curves, " kinds of meshes together; up to ",
         kMostCurves, " can be told apart, so compare fewer of them");
  const bool trains =
      std::any_of(all.begin(), all.end(), [](const Compared& one) { return one.torque == 0; });
  for (const Compared& one : all)
    if (!trains && one.torque != all[0].torque)
      fail(Failure::input, "figure: the ", artifact, " of ", one.design, " is at ", torque_words(one.torque),
           ", that of ", all[0].design, " at ", torque_words(all[0].torque),
           "; designs are compared at one torque");
}

// Of a train one mesh for each pair of gears, planets of one gear being alike.
std::vector<size_t> shown_meshes(const System& layout) {
  std::vector<size_t> out;
  std::set<std::string> seen;
  for (size_t m = 0; m < layout.meshes.size(); ++m) {
    std::string gears;
    for (const System::Side& side : layout.meshes[m].side) {
      const System::Body& body = layout.bodies[static_cast<size_t>(side.body)];
      const size_t letters =
          body.on == System::kGround ? body.name.size() : body.name.find_last_not_of("0123456789") + 1;
      gears += body.name.substr(0, letters) + "-";
    }
    if (seen.insert(gears).second) out.push_back(m);
  }
  return out;
}

std::string curve_name(const std::string& design, const std::string& mesh) {
  return mesh.empty() ? design : design + ", " + mesh;
}

}  // namespace

RestCurve rest_curve(const std::string& design, const StaticResult& s) {
  return {design,
          "",
          pair_words(s),
          s.torque,
          s.hunting_periods,
          s.mesh_phase,
          s.transmission_error,
          s.stiffness_secant,
          s.transmission_error_harmonic};
}

std::vector<RestCurve> rest_curves(const std::string& design, const SystemStaticResult& s) {
  if (!s.of_train()) return {rest_curve(design, s.mesh.at(0))};
  std::vector<RestCurve> out;
  for (const size_t m : shown_meshes(s.settings.layout)) {
    RestCurve& curve = out.emplace_back(rest_curve(design, s.mesh[m]));
    curve.mesh = s.mesh_names[m];
    curve.words = text("contact ratio ", rounded(s.mesh[m].contact_ratio, 3), ", mean mesh force ",
                       rounded(s.mesh_force.col(static_cast<Index>(m)).mean() * 1e-3, 3), " kN");
    curve.torque = 0;
    curve.mesh_phase = s.mesh_phase;
  }
  return out;
}

Figure compared_rest_figure(const std::vector<RestCurve>& curves) {
  std::vector<Compared> all;
  all.reserve(curves.size());
  for (const RestCurve& curve : curves) all.push_back({curve.design, curve.torque});
  require_all_designs(all, curves.size(), "static.h5");
  Figure figure;
  figure.title = "Designs at rest";
  if (std::none_of(all.begin(), all.end(), [](const Compared& one) { return one.torque == 0; }))
    figure.title += ", " + torque_words(curves[0].torque);
  std::vector<std::string> names;
  Panel error{.x = {.from = 0, .to = 1}, .y = {.label = "Static TE (µm)"}, .height = 300},
      stiffness{.x = {.label = "Mesh phase", .from = 0, .to = 1},
                .y = {.label = "Mesh stiffness (N/µm)", .from_zero = true},
                .key = PanelKey::none,
                .height = 260},
      amplitudes{.x = {.label = "Harmonic of the mesh frequency", .from = 0.4, .to = kShownHarmonics + 0.6},
                 .y = {.label = "Amplitude of TE (µm)", .from_zero = true},
                 .key = PanelKey::none,
                 .height = 240};
  const double wide = 0.8 / static_cast<double>(curves.size());
  for (size_t i = 0; i < curves.size(); ++i) {
    const RestCurve& s = curves[i];
    const std::string name = curve_name(s.design, s.mesh);
    if (std::find(names.begin(), names.end(), name) != names.end())
      fail(Failure::input, "figure: two static.h5 of ", name, " given; one of each design is wanted");
    names.push_back(name);
    FigureBlock period{text("period ", i + 1),
                       {"mesh_phase [1]", "transmission_error [µm]", "mesh_stiffness_secant [N/µm]"},
                       {},
                       "period",
                       name};
    for (Index k = 0; k < s.transmission_error.size(); ++k)
      period.rows.push_back({s.mesh_phase[k], s.transmission_error[k] * kMicro, s.stiffness[k] * kMega});
    // The mesh period closes.
    if (s.hunting_periods == 1 && !period.rows.empty())
      period.rows.push_back({period.rows.front()[0] + 1, period.rows.front()[1], period.rows.front()[2]});
    FigureBlock harmonics{
        text("harmonics ", i + 1), {"harmonic [1]", "transmission_error [µm]"}, {}, "harmonics", name};
    const Index last = std::min<Index>(kShownHarmonics, s.harmonic.size() - 1);
    for (Index n = 1; n <= last; ++n)
      harmonics.rows.push_back({static_cast<double>(n), s.harmonic[n] * kMicro});
    constexpr std::array kDash{1, 3, 5, 7, 4, 6};
    PanelCurve line{.block = period.name,
                    .colour = static_cast<int>(i) + 1,
                    .label = without_markup(name),
                    .width = 2.6,
                    .dash = kDash.at(i)};
    error.curves.push_back(line);
    line.y = 3;
    stiffness.curves.push_back(line);
    amplitudes.curves.push_back({.block = harmonics.name,
                                 .style = PanelStyle::bars,
                                 .colour = static_cast<int>(i) + 1,
                                 .width = 0.92 * wide,
                                 .shift = wide * (static_cast<double>(i) + 0.5) - 0.4});
    figure.blocks.push_back(std::move(period));
    figure.blocks.push_back(std::move(harmonics));
    figure.notes.push_back(name + ": " + s.words);
  }
  plain_captions(names.size(), figure);
  figure.panels = {error, stiffness, amplitudes};
  return figure;
}

namespace {

// A curve of designs in motion: a design, and a mesh of it.
struct MotionCurve {
  std::string design;
  Index mesh;
  std::string name;
};

// Rows over speed of one curve in one direction, parted where the response jumps to the branch of the other direction.
FigureBlock motion_block(const ResponseResult& r, const ResponseResult* other, const MotionCurve& curve,
                         size_t number, bool trains) {
  const double force = trains ? 1e3 : normal_force(r.gear[0].design, r.torque);
  FigureBlock block{text(number, " ", r.direction),
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_harmonic_1 [µm]",
                     trains ? "tooth_load_max [kN]" : "tooth_load_max [T / r_b]"},
                    {},
                    "motion",
                    text(curve.name, " ", r.direction)};
  const std::vector<bool> broken = broken_after(r, other);
  for (Index k = 0; k < r.mesh_frequency.size(); ++k) {
    block.rows.push_back(
        {r.mesh_frequency[k], r.dte_rms(k, curve.mesh) * kMicro,
         r.harmonics() > 0 ? r.dte_harmonic[static_cast<size_t>(k)](0, curve.mesh) * kMicro : 0,
         r.tooth_load_max(k, curve.mesh) / force});
    if (broken[static_cast<size_t>(k)]) block.rows.emplace_back();
  }
  return block;
}

// "rising 2158 2634": speeds at which the response jumps, in Hz.
std::string jump_words(const ResponseResult& r) {
  std::string words = r.direction == Direction::up ? "rising" : "falling";
  std::vector<double> at(r.jump_frequency.begin(), r.jump_frequency.end());
  std::sort(at.begin(), at.end());
  for (const double f : at) words += " " + fixed(f, 0);
  return at.empty() ? words + " none" : words;
}

// The one sweep of a design in a direction.
const ResponseResult& swept(const std::vector<OfDesign<ResponseResult>>& sweeps, const std::string& design,
                            Direction direction) {
  const auto is = [&](const auto& one) {
    return one.design == design && one.artifact.direction == direction;
  };
  if (const auto found = std::count_if(sweeps.begin(), sweeps.end(), is); found != 1)
    fail(Failure::input, "figure: ", found, " sweeps ", direction, " of ", design,
         " given; one up and one down of each design are wanted");
  return std::find_if(sweeps.begin(), sweeps.end(), is)->artifact;
}

}  // namespace

Figure compared_motion_figure(const std::vector<OfDesign<ResponseResult>>& sweeps) {
  std::vector<MotionCurve> curves;
  std::vector<Compared> all;
  std::vector<ResponseResult> responses;
  responses.reserve(sweeps.size());
  for (const auto& one : sweeps) {
    const ResponseResult& r = responses.emplace_back(one.artifact);
    all.push_back({one.design, r.of_train() ? 0 : r.torque});
    if (std::any_of(curves.begin(), curves.end(), [&](const auto& c) { return c.design == one.design; }))
      continue;
    for (const size_t m : r.of_train() ? shown_meshes(r.layout) : std::vector<size_t>{0})
      curves.push_back(
          {one.design, static_cast<Index>(m), curve_name(one.design, r.of_train() ? r.mesh_names[m] : "")});
  }
  const bool trains =
      std::any_of(responses.begin(), responses.end(), [](const auto& r) { return r.of_train(); });
  require_all_designs(all, curves.size(), "response.h5");
  Figure figure;
  figure.title = "Designs in motion" + (trains ? "" : ", " + torque_words(sweeps.at(0).artifact.torque));
  const PanelAxis speed{.speed = true};
  figure.panels = {{.x = speed, .y = {.label = "RMS of DTE (µm)", .from_zero = true, .level = true}},
                   {.x = speed,
                    .y = {.label = "Order 1 of DTE (µm)", .from_zero = true, .level = true},
                    .key = PanelKey::none},
                   {.x = {.label = "Mesh frequency (Hz)", .speed = true},
                    .y = {.label = trains ? "Tooth load (kN)" : "Tooth load / (T / r_b)", .from_zero = true},
                    .key = PanelKey::none}};
  for (size_t i = 0; i < curves.size(); ++i) {
    const MotionCurve& curve = curves[i];
    const int colour = static_cast<int>(i) + 1;
    const auto &up = swept(sweeps, curve.design, Direction::up),
               down = swept(sweeps, curve.design, Direction::down);
    for (const ResponseResult* r : {&up, &down}) {
      const bool rising = r == &up;
      figure.blocks.push_back(motion_block(*r, rising ? &down : &up, curve, i + 1, trains));
      for (size_t p = 0; p < figure.panels.size(); ++p) {
        // The second stands on the first, and lets it show where both are alike.
        figure.panels[p].curves.push_back({.block = figure.blocks.back().name,
                                           .y = static_cast<int>(p) + 2,
                                           .colour = colour,
                                           .label = rising ? without_markup(curve.name) : "",
                                           .width = i == 0 ? 4.4 : 2.6,
                                           .dash = rising ? 1 : 3});
        if (rising && !r->of_train())
          figure.panels[p].rules.push_back({'x', r->natural_frequency, p ? "" : "f_n", colour});
      }
    }
    figure.notes.push_back(curve.name + ": jumps in Hz, " + jump_words(up) + ", " + jump_words(down));
  }
  if (std::any_of(all.begin(), all.end(), [](const Compared& one) { return one.torque > 0; }))
    figure.notes.push_back(
        "f_n: mean natural frequency over the mesh period, contact frozen under the static load");
  plain_captions(curves.size(), figure);
  figure.panels[0].curves.push_back({.colour = kDark, .label = "dashed: speed falling", .dash = 3});
  if (trains)
    figure.no_shafts = "designs among which a train is have no shaft in common";
  else
    figure.shafts = shafts_of_all(responses);
  figure.levels = {{"dte_rms [µm]", false}, {"dte_harmonic_1 [µm]", true}};
  return figure;
}

}  // namespace whine
