#include "plot/figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "base/error.h"
#include "gear/pair.h"
#include "lumped/stiffness.h"
#include "plot/wireframe.h"

namespace whine {
namespace {

constexpr double kMicro = 1e6;  // m -> micrometre
constexpr double kMilli = 1e3;  // m -> mm
constexpr double kMega = 1e-6;  // N m-1 -> 1e6 N m-1
constexpr double kPercent = 100;
constexpr int kShownHarmonics = 10;
constexpr size_t kMostCurves = 6;  // colours, dashes and marks of the templates

// %.<digits>g: text() would show ten digits.
std::string shown(double value, int digits) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.*g", digits, value);
  return buffer;
}

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

// ---- frequency response
// --------------------------------------------------------------------------------------------

std::string corner_words(const CornerRule& corner) {
  if (!corner.enabled) return "corner contact off";
  if (!std::isfinite(corner.largest_angle)) return "corner contact on";
  return "corner contact up to " + shown(corner.largest_angle * 180.0 / std::numbers::pi, 4) + "°";
}

// The row after which the march crosses f; -1 if it never does.
Eigen::Index row_before(const Eigen::VectorXd& frequency, double f) {
  for (Eigen::Index i = 0; i + 1 < frequency.size(); ++i)
    if ((frequency[i] - f) * (frequency[i + 1] - f) <= 0) return i;
  return -1;
}

FigureBlock branch_block(const ResponseArtifact& r) {
  FigureBlock block{r.direction,
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_mean [µm]", "separation_fraction [1]",
                     "mesh_force_max [N]", "tooth_load_max [N]", "period_multiple [1]"},
                    {}};
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    block.rows.push_back({r.mesh_frequency[i], r.dte_rms[i] * kMicro, r.dte_mean[i] * kMicro,
                          r.separation_fraction[i], r.mesh_force_max[i], r.tooth_load_max[i],
                          static_cast<double>(r.period_multiple[i])});
    // The curve stops at a jump: the arrow shows the step, a line would pretend that there are states
    // between.
    for (Eigen::Index j = 0; j < r.jump_frequency.size(); ++j)
      if (row_before(r.mesh_frequency, r.jump_frequency[j]) == i) {
        block.rows.emplace_back();
        break;
      }
  }
  return block;
}

FigureBlock jump_block(const ResponseArtifact& r) {
  FigureBlock block{"jumps " + r.direction,
                    {"jump_frequency [Hz]", "dte_rms before [µm]", "dte_rms after [µm]", "jump_width [Hz]",
                     "label row [1]"},
                    {}};
  std::vector<Eigen::Index> order(static_cast<size_t>(r.jump_frequency.size()));
  for (size_t j = 0; j < order.size(); ++j) order[j] = static_cast<Eigen::Index>(j);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return r.jump_frequency[a] < r.jump_frequency[b]; });
  // Labels of jumps closer than this would overlap: the next one stands a row lower.
  const double span = r.mesh_frequency.maxCoeff() - r.mesh_frequency.minCoeff();
  double previous = -std::numeric_limits<double>::infinity();
  int row = 0;
  for (Eigen::Index j : order) {
    const double f = r.jump_frequency[j];
    const Eigen::Index i = row_before(r.mesh_frequency, f);
    if (i < 0)
      fail(Failure::input, "response: a jump at ", f, " Hz lies outside the sweep, ",
           r.mesh_frequency.minCoeff(), " to ", r.mesh_frequency.maxCoeff(), " Hz");
    row = f - previous < 0.03 * span ? row + 1 : 0;
    previous = f;
    block.rows.push_back(
        {f, r.dte_rms[i] * kMicro, r.dte_rms[i + 1] * kMicro, r.jump_width[j], static_cast<double>(row)});
  }
  return block;
}

// ---- statics
// -------------------------------------------------------------------------------------------------------

void sort_by_torque(std::vector<StaticArtifact>& statics) {
  if (statics.empty()) fail(Failure::input, "figure: no static.h5 given; 1 is the least");
  if (statics.size() > kMostCurves)
    fail(Failure::input, "figure: ", statics.size(), " static.h5 given; ", kMostCurves,
         " curves can be told apart");
  std::sort(statics.begin(), statics.end(), [](const auto& a, const auto& b) { return a.torque < b.torque; });
  for (size_t i = 0; i + 1 < statics.size(); ++i)
    if (statics[i].torque == statics[i + 1].torque)
      fail(Failure::input, "figure: two static.h5 of the same torque, ", statics[i].torque,
           " N m; give each once");
  for (const auto& s : statics)
    if (s.mesh_phase.size() != statics[0].mesh_phase.size() || s.mesh_phase != statics[0].mesh_phase)
      fail(Failure::input, "figure: the static.h5 of ", s.torque, " N m and of ", statics[0].torque,
           " N m have different mesh phases; make them with the same `positions`");
}

std::string torque_label(const StaticArtifact& s) {
  return shown(s.torque, 6) + " N m";
}

// One column per curve, first column the phase; the first point again at phase 1, so that the period closes.
FigureBlock period_block(const std::vector<StaticArtifact>& statics, const std::string& quantity,
                         const std::string& unit, Eigen::VectorXd StaticArtifact::*curve, double factor) {
  FigureBlock block{quantity, {"mesh_phase [1]"}, {}};
  for (const auto& s : statics)
    block.columns.push_back(text(quantity, " ", torque_label(s), " [", unit, "]"));
  const Eigen::Index n = statics[0].mesh_phase.size();
  for (Eigen::Index i = 0; i <= n; ++i) {
    std::vector<double> row{i < n ? statics[0].mesh_phase[i] : 1.0};
    for (const auto& s : statics) row.push_back((s.*curve)[i % n] * factor);
    block.rows.push_back(row);
  }
  return block;
}

FigureBlock spectrum_block(const std::vector<StaticArtifact>& statics, const std::string& quantity,
                           const std::string& unit, Eigen::VectorXd StaticArtifact::*harmonic,
                           double factor) {
  FigureBlock block{quantity + " harmonics", {"harmonic [1]"}, {}};
  Eigen::Index last = kShownHarmonics;
  for (const auto& s : statics) {
    block.columns.push_back(text("amplitude ", torque_label(s), " [", unit, "]"));
    last = std::min(last, (s.*harmonic).size() - 1);
  }
  if (last < 1) fail(Failure::input, "figure: the static.h5 holds no harmonics; 1 is the least");
  for (Eigen::Index k = 1; k <= last; ++k) {
    std::vector<double> row{static_cast<double>(k)};
    for (const auto& s : statics) row.push_back((s.*harmonic)[k] * factor);
    block.rows.push_back(row);
  }
  return block;
}

std::string pair_words(const StaticArtifact& s) {
  return text(s.driver.teeth, "/", s.driven.teeth, " teeth, module ", shown(s.driver.module * kMilli, 4),
              " mm, centre distance ", shown(s.mesh.centre_distance * kMilli, 6), " mm, contact ratio ",
              fixed(s.contact_ratio, 4), ", ", corner_words(s.mesh.corner));
}

double wrapped(double phase) {
  return phase - std::floor(phase);
}

void require_same_gear(const char* role, const GearDesign& mesh, const GearDesign& pair) {
  if (mesh.teeth != pair.teeth || mesh.module != pair.module || mesh.profile_shift != pair.profile_shift ||
      mesh.bore_radius != pair.bore_radius)
    fail(Failure::input, "figure: the mesh.h5 of the ", role, " (", mesh.teeth, " teeth, module ",
         mesh.module, " m, bore ", mesh.bore_radius, " m) is not that of the static.h5 (", pair.teeth,
         " teeth, module ", pair.module, " m, bore ", pair.bore_radius,
         " m); give driver, driven, static in this order");
}

}  // namespace

Figure mesh_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& s) {
  require_same_gear("driver", driver.design, s.driver);
  require_same_gear("driven gear", driven.design, s.driven);
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const double alpha = pair.working_pressure_angle();

  // Phase 0: the flank point of roll angle tan(alpha_w) stands on the line of centres. Seen from its own
  // centre the driven gear is the same construction, turned by half a turn.
  const auto placed = [&](int g) {
    const Vec2 p = pair.gear(g).flank_point(std::tan(alpha));
    Placement at;
    at.angle = 0.5 * std::numbers::pi - std::atan2(p.y(), p.x()) + (g == 1 ? std::numbers::pi : 0.0);
    at.centre = Vec2(0.0, g == 1 ? s.mesh.centre_distance : 0.0);
    return at;
  };
  const Vec2 pitch_point(0.0, pair.gear(0).base_radius() / std::cos(alpha));
  const double pitch = std::numbers::pi * s.driver.module;
  const double half_window = 1.45 * pitch;

  Figure figure;
  figure.title = "Finite element mesh of the gear pair";
  long elements = 0, nodes = 0;
  for (int g = 0; g < 2; ++g) {
    const MeshArtifact& mesh = g == 0 ? driver : driven;
    const std::string name = g == 0 ? "driver" : "driven";
    const Wireframe wire(mesh);
    const Placement at = placed(g);
    const std::vector<std::string> columns{"x [mm]", "y [mm]"};
    figure.blocks.push_back({name + " outline", columns, wire.outline(at, kMilli)});
    figure.blocks.push_back({name + " bore", columns, wire.bore(at, kMilli)});
    figure.blocks.push_back({name + " gear", columns, wire.whole(at, kMilli)});
    figure.blocks.push_back({name + " teeth", columns, wire.window(at, kMilli, pitch_point, half_window)});
    elements += static_cast<long>(mesh.element_node.rows()) * mesh.design.teeth;
    nodes += static_cast<long>(mesh.node_position.rows() - mesh.side_node.rows()) * mesh.design.teeth;
  }
  // The driver turns counter-clockwise: contact moves along the outward normal of its flank.
  const Vec2 along(-std::cos(alpha), std::sin(alpha));
  FigureBlock path{"path of contact", {"x [mm]", "y [mm]"}, {}};
  for (double x : {pair.path_start(), 0.0, pair.path_end()}) {
    const Vec2 p = (pitch_point + x * along) * kMilli;
    path.rows.push_back({p.x(), p.y()});
  }
  figure.blocks.push_back(path);
  figure.blocks.push_back({"pitch point", {"x [mm]", "y [mm]"}, {{0.0, pitch_point.y() * kMilli}}});

  figure.notes.push_back(pair_words(s));
  figure.notes.push_back(
      text(elements, driver.discretisation.element_order == 2 ? " nine" : " four", "-node elements, ", nodes,
           " nodes; ", shown(driver.discretisation.element_size * kMilli, 4),
           " mm on the flank; rigid hub of ", shown(s.driver.bore_radius * kMilli, 4), " mm radius",
           s.driven.bore_radius == s.driver.bore_radius
               ? std::string()
               : " (driven: " + shown(s.driven.bore_radius * kMilli, 4) + " mm)"));
  figure.notes.push_back("unloaded, mesh phase 0: the reference pair touches at the pitch point");
  figure.numbers = {{"pitch_y", pitch_point.y() * kMilli},
                    {"half_window", half_window * kMilli},
                    {"driver_tip", pair.gear(0).tip_radius() * kMilli},
                    {"driven_tip", pair.gear(1).tip_radius() * kMilli},
                    {"centre_distance", s.mesh.centre_distance * kMilli}};
  return figure;
}

Figure response_figure(const ResponseArtifact& one, const ResponseArtifact& other) {
  const ResponseArtifact& up = one.direction == "up" ? one : other;
  const ResponseArtifact& down = one.direction == "up" ? other : one;
  if (up.direction != "up" || down.direction != "down")
    fail(Failure::input, "figure: the two response.h5 are sweeps '", one.direction, "' and '",
         other.direction, "'; give one up and one down");
  if (up.torque != down.torque)
    fail(Failure::input, "figure: the up sweep is at ", up.torque, " N m, the down sweep at ", down.torque,
         " N m; give two of the same torque");
  if (up.model != down.model || up.damping.rayleigh_stiffness != down.damping.rayleigh_stiffness ||
      up.damping.rayleigh_mass != down.damping.rayleigh_mass ||
      up.damping.bearing_ratio != down.damping.bearing_ratio || up.fidelity.body != down.fidelity.body ||
      up.fidelity.integrator != down.fidelity.integrator ||
      up.mesh.corner.enabled != down.mesh.corner.enabled ||
      up.mesh.corner.largest_angle != down.mesh.corner.largest_angle)
    fail(Failure::input,
         "figure: the up and the down sweep were computed with different model, damping, corner rule ",
         "or fidelity; make both from one scene");

  Figure figure;
  figure.title = text("RMS of the oscillating dynamic transmission error, ", shown(up.torque, 6), " N m");
  std::string choices =
      text("Rayleigh damping η = ", shown(up.damping.rayleigh_stiffness * kMicro, 6), " µs");
  if (up.damping.rayleigh_mass != 0) choices += text(", µ = ", shown(up.damping.rayleigh_mass, 6), " s⁻¹");
  choices += text(", undamped to ", shown(up.damping.undamped_depth * kMilli, 4), " mm depth; bearing ratio ",
                  shown(up.damping.bearing_ratio, 4), "; ", corner_words(up.mesh.corner));
  figure.notes.push_back(choices);
  figure.notes.push_back(text(up.model, ": body ", up.fidelity.body, ", contact ", up.fidelity.contact,
                              ", integrator ", up.fidelity.integrator));
  figure.notes.push_back(
      text("f_n = ", fixed(up.natural_frequency, 0),
           " Hz: mean over the mesh period with the contact frozen under the static load"));
  figure.blocks = {branch_block(up), branch_block(down), jump_block(up), jump_block(down)};
  figure.numbers = {
      {"natural_frequency", up.natural_frequency},
      {"frequency_from", std::min(up.mesh_frequency.minCoeff(), down.mesh_frequency.minCoeff())},
      {"frequency_to", std::max(up.mesh_frequency.maxCoeff(), down.mesh_frequency.maxCoeff())},
      {"rms_max", std::max(up.dte_rms.maxCoeff(), down.dte_rms.maxCoeff()) * kMicro},
      {"jumps_up", static_cast<double>(up.jump_frequency.size())},
      {"jumps_down", static_cast<double>(down.jump_frequency.size())},
      {"contact_lost",
       up.separation_fraction.maxCoeff() > 0 || down.separation_fraction.maxCoeff() > 0 ? 1.0 : 0.0}};
  return figure;
}

Figure transmission_error_figure(std::vector<StaticArtifact> statics) {
  sort_by_torque(statics);
  Figure figure;
  figure.title = "Static transmission error";
  figure.notes.push_back(pair_words(statics[0]));
  figure.blocks.push_back(
      period_block(statics, "transmission_error", "µm", &StaticArtifact::transmission_error, kMicro));
  figure.blocks.push_back(spectrum_block(statics, "transmission_error", "µm",
                                         &StaticArtifact::transmission_error_harmonic, kMicro));
  figure.numbers = {{"curves", static_cast<double>(statics.size())}};
  std::string labels;
  for (const auto& s : statics) labels += text("'", torque_label(s), "' ");
  figure.words = {{"labels", labels}};
  return figure;
}

Figure error_budget_figure(const ErrorBudgetArtifact& budget) {
  Figure figure;
  figure.title = text("Error budget of the static transmission error, ", shown(budget.torque, 6), " N m");
  figure.notes.push_back(
      text("each discretisation alone twice as fine; sum of the changes of the mean stiffness ",
           shown(budget.refinement.mean_stiffness_change.cwiseAbs().sum() * kPercent, 3), " %"));
  figure.notes.push_back(
      text("contact = ", budget.fidelity.contact, ", near field by ", budget.driver_body.near_field,
           "; beyond the line what another choice changes, which is no error of this one"));
  for (const auto& [name, labels, count, changes] :
       {std::tuple{"changes", "labels", "entries", &budget.refinement},
        std::tuple{"choices", "choice_labels", "choices", &budget.choice}}) {
    FigureBlock block{name, {"entry", "mean_stiffness [%]", "peak_to_peak [%]"}, {}};
    for (Eigen::Index n = 1; n <= changes->harmonic_change.cols(); ++n)
      block.columns.push_back(text("harmonic_", n, " [% of the first]"));
    std::string words, names, rest = changes->entry;
    for (Eigen::Index i = 0; i < changes->mean_stiffness_change.size(); ++i) {
      std::vector<double> row{static_cast<double>(i), std::abs(changes->mean_stiffness_change[i]) * kPercent,
                              std::abs(changes->peak_to_peak_change[i]) * kPercent};
      for (Eigen::Index n = 0; n < changes->harmonic_change.cols(); ++n)
        row.push_back(std::abs(changes->harmonic_change(i, n)) * kPercent);
      block.rows.push_back(row);
      const size_t comma = rest.find(", ");
      std::string label = rest.substr(0, comma);
      names += text(i ? "; " : "", i, " ", label);
      // The values on a line of their own: '|' to the template.
      const size_t value = std::min(label.find(" at "), label.find_first_of("0123456789") - 1);
      if (value < label.size()) label[value] = '|';
      words += "'" + label + "' ";
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
    block.columns[0] = text("entry [", names, "]");
    figure.blocks.push_back(block);
    figure.words.emplace_back(labels, words);
    figure.numbers.emplace_back(count, static_cast<double>(block.rows.size()));
  }
  return figure;
}

Figure mesh_stiffness_figure(std::vector<StaticArtifact> statics) {
  sort_by_torque(statics);
  const RectangularWave wave = rectangular_wave(statics[0]);
  Figure figure;
  figure.title = "Mesh stiffness: torque / (base radius × static transmission error)";
  figure.notes.push_back(pair_words(statics[0]));
  figure.notes.push_back(
      text("rectangular wave: levels at the middle of the zones of few and of many pairs at ",
           torque_label(statics[0]), ", steps where pairs come and go without load"));

  const std::string unit = "1e6 N/m";
  FigureBlock rectangle{"rectangular wave", {"mesh_phase [1]", "mesh_stiffness [" + unit + "]"}, {}};
  std::vector<double> steps{wrapped(wave.high_begin), wrapped(wave.high_end)};
  std::sort(steps.begin(), steps.end());
  const double tiny = 1e-9;  // of a period: the two sides of a step
  rectangle.rows.push_back({0.0, wave.at(tiny) * kMega});
  for (double step : steps)
    for (double side : {-tiny, tiny}) rectangle.rows.push_back({step, wave.at(step + side) * kMega});
  rectangle.rows.push_back({1.0, wave.at(1.0 - tiny) * kMega});

  FigureBlock spectrum =
      spectrum_block(statics, "mesh_stiffness", unit, &StaticArtifact::stiffness_harmonic, kMega);
  FigureBlock rectangle_spectrum{
      "rectangular wave harmonics", {"harmonic [1]", "amplitude [" + unit + "]"}, {}};
  for (const auto& row : spectrum.rows)
    rectangle_spectrum.rows.push_back({row[0], wave.amplitude(static_cast<int>(row[0])) * kMega});

  figure.blocks = {period_block(statics, "mesh_stiffness", unit, &StaticArtifact::stiffness_secant, kMega),
                   rectangle, spectrum, rectangle_spectrum};
  figure.numbers = {{"curves", static_cast<double>(statics.size())}};
  std::string labels;
  for (const auto& s : statics)
    labels += text("'", torque_label(s), ", mean ", fixed(s.mean_stiffness * kMega, 1), "' ");
  figure.words = {{"labels", labels},
                  {"rectangle_label", "rectangular wave, mean " + fixed(wave.mean() * kMega, 1)}};
  return figure;
}

Figure lumped_response_figure(std::vector<ResponseArtifact> responses) {
  if (responses.empty()) fail(Failure::input, "figure: no response.h5; an up and a down sweep are the least");
  std::stable_sort(responses.begin(), responses.end(), [](const auto& a, const auto& b) {
    return a.torque != b.torque ? a.torque < b.torque : a.direction > b.direction;  // up before down
  });
  if (responses.size() > 2 * kMostCurves)
    fail(Failure::input, "figure: ", responses.size(), " sweeps given; ", kMostCurves,
         " torques can be told apart");
  Figure figure;
  const std::string model = responses[0].model;
  figure.title = text("One degree of freedom (Eq. 23), mesh stiffness: ", model);
  double from = responses[0].mesh_frequency[0], to = from, rms = 0, mean = 0;
  std::string labels, jumps;
  for (size_t i = 0; i < responses.size(); ++i) {
    const ResponseArtifact& r = responses[i];
    const bool up = i % 2 == 0;
    if (r.model != model || r.model == "finite elements")
      fail(Failure::input, "figure: sweeps of the models ", model, " and ", r.model,
           " given; give those of one lumped model");
    if (r.direction != (up ? "up" : "down") || (!up && r.torque != responses[i - 1].torque) ||
        (up && i + 1 == responses.size()) || (up && i > 0 && r.torque == responses[i - 1].torque))
      fail(Failure::input, "figure: at ", r.torque, " N m there is not one sweep up and one down");
    FigureBlock curve{text(shown(r.torque, 6), " ", r.direction), {}, {}};
    const FigureBlock branch = branch_block(r);
    curve.columns = branch.columns;
    curve.rows = branch.rows;
    figure.blocks.push_back(curve);
    FigureBlock arrows{text("jumps ", curve.name),
                       {"jump_frequency [Hz]", "dte_rms before [µm]", "dte_rms after [µm]",
                        "dte_mean before [µm]", "dte_mean after [µm]"},
                       {}};
    for (Eigen::Index j = 0; j < r.jump_frequency.size(); ++j) {
      const Eigen::Index row = row_before(r.mesh_frequency, r.jump_frequency[j]);
      if (row < 0)
        fail(Failure::input, "figure: a jump at ", r.jump_frequency[j], " Hz lies outside the sweep");
      arrows.rows.push_back({r.jump_frequency[j], r.dte_rms[row] * kMicro, r.dte_rms[row + 1] * kMicro,
                             r.dte_mean[row] * kMicro, r.dte_mean[row + 1] * kMicro});
      jumps += text(jumps.empty() ? "jumps: " : "; ", shown(r.torque, 6), " N m ", r.direction, " ",
                    fixed(r.jump_frequency[j], 1), " Hz");
    }
    figure.blocks.push_back(arrows);
    figure.numbers.emplace_back(text("jumps_", r.direction, "_", i / 2 + 1),
                                static_cast<double>(arrows.rows.size()));
    from = std::min(from, r.mesh_frequency.minCoeff());
    to = std::max(to, r.mesh_frequency.maxCoeff());
    rms = std::max(rms, r.dte_rms.maxCoeff() * kMicro);
    mean = std::max(mean, r.dte_mean.maxCoeff() * kMicro);
    if (up) labels += text("'", shown(r.torque, 6), " N m' ");
  }
  figure.notes.push_back(jumps.empty() ? "no jumps" : jumps);
  // Ranges of neighbouring speeds at which either sweep parts.
  const auto apart = [&](size_t i) {
    std::map<double, bool> parts;
    for (size_t k : {i, i + 1})
      for (Eigen::Index f = 0; f < responses[k].mesh_frequency.size(); ++f)
        parts[responses[k].mesh_frequency[f]] |= responses[k].separation_fraction[f] > 0;
    std::string ranges;
    for (auto first = parts.begin(); first != parts.end(); ++first) {
      if (!first->second) continue;
      auto last = first;
      while (std::next(last) != parts.end() && std::next(last)->second) ++last;
      ranges += (ranges.empty() ? "" : ", ") + fixed(first->first, 0);
      if (last != first) ranges += " to " + fixed(last->first, 0);
      first = last;
    }
    return ranges.empty() ? "nowhere" : ranges + " Hz";
  };
  std::string lost = "contact lost at every torque: " + apart(0);
  for (size_t i = 2; i < responses.size(); i += 2)
    if (apart(i) != apart(0)) {
      lost = "contact lost";
      for (size_t k = 0; k < responses.size(); k += 2)
        lost += text(k > 0 ? "; " : " ", "at ", shown(responses[k].torque, 6), " N m: ", apart(k));
      break;
    }
  figure.notes.push_back(lost);
  figure.numbers.insert(figure.numbers.end(), {{"curves", static_cast<double>(responses.size() / 2)},
                                               {"natural_frequency", responses[0].natural_frequency},
                                               {"frequency_from", from},
                                               {"frequency_to", to},
                                               {"rms_max", rms},
                                               {"mean_max", mean}});
  figure.words = {{"labels", labels}};
  return figure;
}

Figure mesh_force_figure(const std::vector<SweepArtifact>& sweeps) {
  // Where P2000's Fig. 15 shows them.
  constexpr std::array<double, 2> kSpeeds{2200, 2150};
  if (sweeps.empty()) fail(Failure::input, "figure: no sweep.h5 given; 1 is the least");
  Figure figure;
  const double torque = sweeps[0].torque;
  figure.title = text("Net mesh force of one degree of freedom (Eq. 23), rectangular stiffness, ",
                      shown(torque, 6), " N m");
  double largest = 0;
  std::array<std::string, 2> labels;
  for (size_t s = 0; s < sweeps.size(); ++s) {
    const SweepArtifact& sweep = sweeps[s];
    if (sweep.lumped.cell_end.size() == 0)
      fail(Failure::input, "figure: a sweep of elastic gears given; give those of lumped models");
    if (sweep.torque != torque)
      fail(Failure::input, "figure: sweeps at ", torque, " and ", sweep.torque,
           " N m; give those of one torque");
    const double low = sweep.lumped.stiffness.minCoeff(), high = sweep.lumped.stiffness.maxCoeff();
    std::string jumps;
    for (double f : sweep.jump_frequency) jumps += (jumps.empty() ? ", jump at " : ", ") + fixed(f, 1);
    figure.notes.push_back(text("levels ", fixed(low * kMega, 1), " and ", fixed(high * kMega, 1),
                                "e6 N/m (ratio ", fixed(high / low, 3), "), speed ",
                                sweep.direction == "up" ? "rising" : "falling",
                                jumps.empty() ? ", no jump" : jumps + " Hz"));
    for (size_t k = 0; k < kSpeeds.size(); ++k) {
      Eigen::Index row = 0;
      (sweep.mesh_frequency.array() - kSpeeds[k]).abs().minCoeff(&row);
      const Eigen::Index samples = sweep.time.steps_per_period, stored = sweep.mesh_force.cols();
      FigureBlock block{text(k == 0 ? "upper " : "lower ", s + 1),
                        {"time [mesh periods]", "mesh_force [N]", "transmission_error [µm]"},
                        {}};
      for (Eigen::Index i = 0; i <= 2 * samples; ++i)
        block.rows.push_back({static_cast<double>(i) / static_cast<double>(samples),
                              sweep.mesh_force(row, i % stored),
                              sweep.transmission_error(row, i % stored) * kMicro});
      figure.blocks.push_back(block);
      largest = std::max(largest, sweep.mesh_force.row(row).maxCoeff());
      labels[k] += text("'", fixed(sweep.mesh_frequency[row], 0), " Hz, ratio ", fixed(high / low, 3),
                        jumps.empty() ? " (no jump)' " : "' ");
    }
  }
  const GearPair pair(sweeps[0].driver, sweeps[0].driven, sweeps[0].mesh.centre_distance);
  figure.numbers = {{"curves", static_cast<double>(sweeps.size())},
                    {"force_max", largest},
                    {"static_force", torque / pair.gear(0).base_radius()}};
  figure.words = {{"labels_upper", labels[0]}, {"labels_lower", labels[1]}};
  return figure;
}

std::string tsv(const Figure& figure, const std::vector<std::string>& sources) {
  std::string out = "# " + figure.title + "\n";
  for (const auto& note : figure.notes) out += "# " + note + "\n";
  for (const auto& source : sources) out += "# from " + source + "\n";
  for (const auto& block : figure.blocks) {
    // gnuplot's `index "[name]"` looks for the comments that begin with it: the brackets keep titles and
    // names that begin alike apart.
    out += "\n\n# [" + block.name + "]\n# ";
    for (size_t c = 0; c < block.columns.size(); ++c) out += (c ? "\t" : "") + block.columns[c];
    out += "\n";
    for (const auto& row : block.rows) {
      for (size_t c = 0; c < row.size(); ++c) {
        if (!std::isfinite(row[c]))
          fail(Failure::numerical, "figure: ", block.name, " holds a value that is not finite in column ", c);
        out += (c ? "\t" : "") + shown(row[c], 9);
      }
      out += "\n";
    }
  }
  return out;
}

}  // namespace whine
