#include "plot/figures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <sstream>
#include <tuple>

#include "base/error.h"
#include "files/summary.h"
#include "gear/pair.h"
#include "lumped/stiffness.h"
#include "motion/sweep.h"
#include "plot/wireframe.h"
#include "signal/response.h"
#include "signal/spectrum.h"

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

template <class Artifact>
auto gears_of(const Artifact& s) {
  const auto of_gear = [](const GearDesign& g) {
    return std::tuple(g.teeth, g.module, g.profile_shift, g.face_width, g.bore_radius);
  };
  return std::tuple(of_gear(s.driver), of_gear(s.driven), s.driver_inertia, s.driven_inertia,
                    s.mesh.centre_distance, s.mesh.corner.enabled, s.mesh.corner.largest_angle,
                    s.damping.rayleigh_stiffness, s.damping.rayleigh_mass, s.damping.bearing_ratio,
                    s.damping.undamped_depth);
}

// All that two sweeps must share to be one experiment, besides the torque.
template <class Sweep>
auto choices_of(const Sweep& s, const LumpedParameters& lumped) {
  return std::tuple(s.model, gears_of(s), s.fidelity.body, s.fidelity.contact, s.fidelity.integrator,
                    lumped.mass, lumped.damping_ratio, lumped.damper_acts);
}

template <class Sweep>
bool elastic(const Sweep& s) {
  return s.model == "finite elements";
}

std::string lumped_words(const LumpedParameters& lumped) {
  if (!(lumped.mass > 0)) return "mass and damping ratio: see its sweep.h5";
  return text("mass ", shown(lumped.mass, 5), " kg, damping ratio ",
              shown(lumped.damping_ratio * kPercent, 4), " %, damper ",
              lumped.damper_acts == "contact" ? "in contact only" : "always on");
}

template <class Sweep>
std::string choice_words(const Sweep& s) {
  if (!elastic(s))
    return text("one degree of freedom (Eq. 23), mesh stiffness: ", s.model, "; integrator ",
                s.fidelity.integrator, "; its statics: ", corner_words(s.mesh.corner));
  std::string words = "Rayleigh damping η = " + shown(s.damping.rayleigh_stiffness * kMicro, 6) + " µs";
  if (s.damping.rayleigh_mass != 0) words += ", µ = " + shown(s.damping.rayleigh_mass, 6) + " s⁻¹";
  return words + text(", undamped to ", shown(s.damping.undamped_depth * kMilli, 4),
                      " mm depth, bearing ratio ", shown(s.damping.bearing_ratio, 4), "; ",
                      corner_words(s.mesh.corner), "; body ", s.fidelity.body, ", contact ",
                      s.fidelity.contact, ", integrator ", s.fidelity.integrator);
}

std::string torque_words(double torque) {
  return shown(torque, 6) + " N m";
}

// Sweeps of the same choices, both directions at each torque (ascending), those of other flanks in the order in which they
// come.
template <class Sweep>
struct ChoicePanel {
  struct Curve {
    const Sweep *up = nullptr, *down = nullptr;
  };
  std::string choices, scene;
  LumpedParameters lumped;
  std::vector<Curve> curves;
};

// In the order in which the choices come. Throws Error(input) where a direction is missing or given twice.
template <class Sweep>
std::vector<ChoicePanel<Sweep>> panels_of(const std::vector<Sweep>& sweeps, const Background& told) {
  std::vector<ChoicePanel<Sweep>> panels;
  std::vector<const Sweep*> first;  // of each panel
  for (size_t i = 0; i < sweeps.size(); ++i) {
    const Sweep& s = sweeps[i];
    const LumpedParameters lumped = told.lumped.empty() ? LumpedParameters{} : told.lumped.at(i);
    if (s.direction != "up" && s.direction != "down")
      fail(Failure::input, "figure: a sweep of direction '", s.direction, "'; up and down are known");
    size_t p = 0;
    while (p < first.size() && choices_of(*first[p], panels[p].lumped) != choices_of(s, lumped)) ++p;
    if (p == first.size()) {
      first.push_back(&s);
      panels.push_back({choice_words(s), told.scenes.empty() ? "" : told.scenes.at(i), lumped, {}});
    }
    auto& curves = panels[p].curves;
    const auto of = [](const auto& c) { return c.up ? c.up : c.down; };
    const auto same = [&](const auto& c) {
      return of(c)->torque == s.torque && of(c)->mesh.modification == s.mesh.modification;
    };
    auto at = std::find_if(curves.begin(), curves.end(), same);
    if (at == curves.end())
      at = curves.emplace(std::find_if(curves.begin(), curves.end(),
                                       [&](const auto& c) { return of(c)->torque > s.torque; }));
    const Sweep*& place = s.direction == "up" ? at->up : at->down;
    if (place)
      fail(Failure::input, "figure: two sweeps ", s.direction, " at ", torque_words(s.torque), " with ",
           choice_words(s), "; give each once");
    place = &s;
  }
  for (const auto& panel : panels)
    for (const auto& c : panel.curves)
      if (!c.up || !c.down)
        fail(Failure::input, "figure: the sweep ", c.up ? "up" : "down", " at ",
             torque_words((c.up ? c.up : c.down)->torque), " with ", panel.choices, " has no sweep ",
             c.up ? "down" : "up",
             " of the same torque, gears, model, damping, corner rule and fidelity beside it; make both from "
             "one scene");
  return panels;
}

// Torques and damping of a panel: "150 N m; damping ratio 6.95 % with two pairs in contact, by ring-down". Without the
// impact.h5 of its sweeps the torques alone.
template <class Sweep>
std::string operating_words(const ChoicePanel<Sweep>& panel, const Background& told) {
  std::vector<std::string> torques, at;
  std::string ratios, state;
  const auto once = [](std::vector<std::string>& list, const std::string& word) {
    if (list.empty() || list.back() != word) list.push_back(word);
  };
  size_t known = 0;
  for (const auto& curve : panel.curves) {
    const Sweep& s = *curve.up;
    once(torques, shown(s.torque, 6));
    const auto found =
        std::find_if(told.impacts.begin(), told.impacts.end(), [&](const ImpactArtifact& impact) {
          return impact.torque == s.torque && gears_of(impact) == gears_of(s) &&
                 impact.mesh.modification == s.mesh.modification && impact.state_phase.size() > 0;
        });
    if (!elastic(s) || found == told.impacts.end()) continue;
    // Many pairs as without load; with any load there may be more.
    static const std::array<std::string, 4> kCounts{"one", "two", "three", "four"};
    const size_t many = static_cast<size_t>(
        std::ceil(GearPair(s.driver, s.driven, s.mesh.centre_distance).contact_ratio() - 1e-9));
    const auto& states = found->contact_state;
    const auto wanted = std::find(states.begin(), states.end(), many <= 4 ? kCounts[many - 1] : "");
    const Eigen::Index i = wanted != states.end() ? wanted - states.begin() : found->state_phase.size() - 1;
    state = known++ == 0 || state == states[i] ? states[i] : "most";
    ratios += (ratios.empty() ? "" : ", ") + fixed(found->damping_ratio[i] * kPercent, 2);
    once(at, shown(s.torque, 6));
  }
  const auto in_a_row = [](const std::vector<std::string>& list) {
    std::string row;
    for (const std::string& word : list) row += (row.empty() ? "" : ", ") + word;
    return row + " N m";
  };
  const std::string words = in_a_row(torques);
  if (!elastic(*panel.curves[0].up)) return words + "; " + lumped_words(panel.lumped);
  if (known == 0) return words;
  return words + "; damping ratio " + ratios + " %" + (at == torques ? "" : " at " + in_a_row(at)) +
         " with " + state + (state == "one" ? " pair" : " pairs") + " in contact, by ring-down";
}

// Rows after which a curve breaks: where the march left a branch that ends at a jump, and where the RMS changes by half of
// itself at once and 2.5 times as much as in the steps beside, which is another branch, too.
std::vector<bool> broken_after(const ResponseArtifact& r) {
  const Eigen::Index n = r.mesh_frequency.size();
  std::vector<bool> jumps(n, false), broken;
  for (const Eigen::Index i : rows_before_jumps(r))
    if (i >= 0) jumps[i] = true;
  broken = jumps;
  const auto change = [&](Eigen::Index i) {
    return i < 0 || i + 1 >= n || jumps[i] ? 0.0 : std::abs(std::log(r.dte_rms[i + 1] / r.dte_rms[i]));
  };
  for (Eigen::Index i = 0; i + 1 < n; ++i)
    if (r.dte_rms[i] > 0 && r.dte_rms[i + 1] > 0 &&
        change(i) > std::max(std::log(1.5), 2.5 * std::max(change(i - 1), change(i + 1))))
      broken[i] = true;
  return broken;
}

FigureBlock branch_block(const std::string& name, const ResponseArtifact& r) {
  FigureBlock block{name,
                    {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_mean [µm]", "separation_fraction [1]",
                     "mesh_force_max [N]", "tooth_load_max [N]", "period_multiple [1]"},
                    {}};
  const std::vector<bool> broken = broken_after(r);
  for (Eigen::Index i = 0; i < r.mesh_frequency.size(); ++i) {
    block.rows.push_back({r.mesh_frequency[i], r.dte_rms[i] * kMicro, r.dte_mean[i] * kMicro,
                          r.separation_fraction[i], r.mesh_force_max[i], r.tooth_load_max[i],
                          static_cast<double>(r.period_multiple[i])});
    // A line across would pretend that there are states between.
    if (broken[i]) block.rows.emplace_back();
  }
  return block;
}

// In order of frequency. What the RMS and the mean are after a jump is read off the branch on which the march goes on.
FigureBlock jump_block(const std::string& name, const ResponseArtifact& r) {
  FigureBlock block{name,
                    {"jump_frequency [Hz]", "dte_rms before [µm]", "dte_rms after [µm]", "jump_width [Hz]",
                     "dte_mean before [µm]", "dte_mean after [µm]", "last speed before [Hz]"},
                    {}};
  const std::vector<Eigen::Index> left = rows_before_jumps(r);
  for (Eigen::Index j = 0; j < r.jump_frequency.size(); ++j) {
    const double f = r.jump_frequency[j];
    const Eigen::Index at = row_before(r.mesh_frequency, f), i = left[j];
    if (at < 0)
      fail(Failure::input, "response: a jump at ", f, " Hz lies outside the sweep, ",
           r.mesh_frequency.minCoeff(), " to ", r.mesh_frequency.maxCoeff(), " Hz");
    const double share = (f - r.mesh_frequency[at]) / (r.mesh_frequency[at + 1] - r.mesh_frequency[at]);
    const auto after = [&](const Eigen::VectorXd& v) {
      return (i == at ? v[at + 1] : (1 - share) * v[at] + share * v[at + 1]) * kMicro;
    };
    block.rows.push_back({f, r.dte_rms[i] * kMicro, after(r.dte_rms), r.jump_width[j], r.dte_mean[i] * kMicro,
                          after(r.dte_mean), r.mesh_frequency[i]});
  }
  std::sort(block.rows.begin(), block.rows.end());
  return block;
}

// " 1241, 1410" of a block of jumps; after the sixth only how many more there are.
std::string listed(const FigureBlock& jumps) {
  constexpr size_t kMostListed = 6;
  std::string list;
  for (size_t j = 0; j < std::min(jumps.rows.size(), kMostListed); ++j)
    list += (j ? ", " : " ") + fixed(jumps.rows[j][0], 0);
  return jumps.rows.size() > kMostListed ? text(list, " and ", jumps.rows.size() - kMostListed, " more")
                                         : list;
}

// Ranges of neighbouring speeds at which either sweep loses contact.
std::string loss_words(const ResponseArtifact& up, const ResponseArtifact& down) {
  std::map<double, bool> parts;
  for (const ResponseArtifact* r : {&up, &down})
    for (Eigen::Index f = 0; f < r->mesh_frequency.size(); ++f)
      parts[r->mesh_frequency[f]] |= r->separation_fraction[f] > 0;
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
}

// What tells the curves of a panel apart: their torques, or their flanks where those differ at one torque.
template <class Sweep>
std::string curve_label(const ChoicePanel<Sweep>& panel, const Sweep& s) {
  bool others = false, torques = false;
  for (const auto& curve : panel.curves) {
    others |= curve.up->torque == s.torque && curve.up->mesh.modification != s.mesh.modification;
    torques |= curve.up->torque != s.torque;
  }
  if (!others) return torque_words(s.torque);
  const auto& both = s.mesh.modification;
  const std::string flanks = both[0] == both[1]
                                 ? in_words(both[0])
                                 : "driver " + in_words(both[0]) + ", driven " + in_words(both[1]);
  return flanks + (torques ? ", " + torque_words(s.torque) : "");
}

std::string loss_words(const ChoicePanel<ResponseArtifact>& panel) {
  const auto& curves = panel.curves;
  const std::string first = loss_words(*curves[0].up, *curves[0].down);
  std::string each;
  bool alike = true;
  for (const auto& c : curves) {
    const std::string words = loss_words(*c.up, *c.down);
    alike = alike && words == first;
    const std::string label = curve_label(panel, *c.up);
    each += (each.empty() ? " " : "; ") + (label == torque_words(c.up->torque) ? "at " + label : label) +
            ": " + words;
  }
  if (alike && first == "nowhere") return "contact is never lost";
  return alike && curves.size() > 1 ? "contact lost at every torque: " + first : "contact lost" + each;
}

// ---- motions at one speed
// -------------------------------------------------------------------------------------------

struct Motion {
  const SweepArtifact* sweep = nullptr;
  Eigen::Index row = 0;
  int periods = 1;    // of one orbit, or all that is stored of a motion that is not periodic
  std::string title;  // which branch of which choices

  Eigen::Index per_period() const { return sweep->time.steps_per_period; }
  Eigen::VectorXd orbit(const MatrixRM& rows) const {
    return rows.row(row).head(periods * per_period()).transpose();
  }
};

Motion motion_at(const SweepArtifact& s, double frequency) {
  Motion m;
  m.sweep = &s;
  (s.mesh_frequency.array() - frequency).abs().minCoeff(&m.row);
  if (std::abs(s.mesh_frequency[m.row] - frequency) > 1e-6 * frequency)
    fail(Failure::input, "figure: the sweep ", s.direction, " at ", torque_words(s.torque),
         " holds no speed of ", frequency, " Hz; the nearest is ", s.mesh_frequency[m.row], " Hz");
  m.periods = s.period_multiple[m.row] > 0
                  ? s.period_multiple[m.row]
                  : static_cast<int>(s.transmission_error.cols() / s.time.steps_per_period);
  return m;
}

std::vector<LumpedParameters> lumped_of(const std::vector<SweepArtifact>& sweeps) {
  std::vector<LumpedParameters> lumped;
  for (const SweepArtifact& s : sweeps) lumped.push_back(s.lumped);
  return lumped;
}

std::vector<Motion> motions_at(const std::vector<SweepArtifact>& sweeps, double frequency, Background told,
                               Figure& figure) {
  constexpr double kSameBranch = 0.02;  // of the larger RMS: far above what periodicity leaves open
  if (sweeps.empty()) fail(Failure::input, "figure: no sweep.h5 given; an up and a down sweep are the least");
  std::vector<Motion> motions;
  told.lumped = lumped_of(sweeps);
  for (const auto& panel : panels_of(sweeps, told)) {
    constexpr size_t kWidth = 170;  // characters that fit into a line
    const std::string operating = operating_words(panel, told);
    if (panel.scene.size() + operating.size() > kWidth) {
      figure.notes.push_back(panel.scene);
      figure.notes.push_back(operating);
    } else {
      figure.notes.push_back(panel.scene + (panel.scene.empty() ? "" : "; ") + operating);
    }
    figure.notes.push_back(panel.choices);
    for (const auto& curve : panel.curves) {
      Motion up = motion_at(*curve.up, frequency), down = motion_at(*curve.down, frequency);
      const std::string damping =
          elastic(*curve.up)
              ? "η = " + shown(curve.up->damping.rayleigh_stiffness * kMicro, 6) + " µs"
              : curve.up->model + " at " + shown(panel.lumped.damping_ratio * kPercent, 4) + " %";
      const auto rms = [](const Motion& m) { return harmonics(m.orbit(m.sweep->transmission_error), 0).rms; };
      const double of_up = rms(up), of_down = rms(down);
      if (std::abs(of_up - of_down) <= kSameBranch * std::max(of_up, of_down)) {
        up.title = damping + ": no second branch here, speed rising and falling agree";
        motions.push_back(up);
        continue;
      }
      Motion& upper = of_up > of_down ? up : down;
      Motion& lower = of_up > of_down ? down : up;
      upper.title = damping + ": upper branch, speed " + (of_up > of_down ? "rising" : "falling");
      lower.title = damping + ": lower branch, speed " + (of_up > of_down ? "falling" : "rising");
      motions.push_back(upper);
      motions.push_back(lower);
    }
  }
  if (motions.size() > kMostCurves)
    fail(Failure::input, "figure: ", motions.size(), " motions at ", frequency, " Hz; ", kMostCurves,
         " fit into a figure");
  return motions;
}

void set_motion_title(Figure& figure, const std::string& what, const std::vector<Motion>& motions,
                      double frequency) {
  figure.title = what + " at a mesh frequency of " + shown(frequency, 6) + " Hz, " +
                 torque_words(motions[0].sweep->torque);
  for (size_t i = 0; i < figure.notes.size(); ++i)
    figure.words.emplace_back(text("line", i + 1), without_markup(figure.notes[i]));
  figure.numbers.emplace_back("lines", static_cast<double>(figure.notes.size()));
  figure.numbers.emplace_back("motions", static_cast<double>(motions.size()));
}

std::string letter_of(size_t i) {
  return std::string(1, static_cast<char>('a' + i));
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
  for (const auto& s : statics) {
    if (s.hunting_periods > 1)
      fail(Failure::input, "figure: the teeth of ", s.torque,
           " N m differ from each other, and this figure shows one mesh period; make sidebands");
    if (s.mesh_phase.size() != statics[0].mesh_phase.size() || s.mesh_phase != statics[0].mesh_phase)
      fail(Failure::input, "figure: the static.h5 of ", s.torque, " N m and of ", statics[0].torque,
           " N m have different mesh phases; make them with the same `positions`");
  }
}

std::string torque_label(const StaticArtifact& s) {
  return torque_words(s.torque);
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

// Closed outlines of the elements of tooth 0 in which the half-plane field is subtracted.
Strokes tooth_elements(const MeshArtifact& mesh, const Placement& at, double scale) {
  Strokes rows;
  const int sides = mesh.element_node.cols() == 9 ? 2 : 1;
  for (Eigen::Index e = 0; e < mesh.element_node.rows(); ++e) {
    if (mesh.element_region[e] != 1) continue;
    for (int k = 0; k <= 4 * sides; ++k) {
      const int corner = k / sides % 4, node = mesh.element_node(e, k % sides ? 4 + corner : corner);
      const Vec2 p = at(mesh.node_position.row(node).transpose()) * scale;
      rows.push_back({p.x(), p.y()});
    }
    rows.emplace_back();
  }
  return rows;
}

}  // namespace

Figure mesh_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& s) {
  require_same_gear("driver", driver.design, s.driver);
  require_same_gear("driven gear", driven.design, s.driven);
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const double alpha = pair.working_pressure_angle();

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
    const Placement at = placed(pair, g);
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

Figure contact_zone_figure(const MeshArtifact& driver, const MeshArtifact& driven, const StaticArtifact& s,
                           const ContactZone& zone) {
  require_same_gear("driver", driver.design, s.driver);
  require_same_gear("driven gear", driven.design, s.driven);
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const double alpha = pair.working_pressure_angle();
  const PairStrips& strips = zone.strips;
  const Vec2 touch(0.0, pair.gear(0).base_radius() / std::cos(alpha));
  // Out of the driver's flank along the line of action; along the flank to the driver's tip.
  const Vec2 normal(-std::cos(alpha), std::sin(alpha)), tangent(std::sin(alpha), std::cos(alpha));
  const double half_window = 2 * s.driver.module;

  Figure figure;
  figure.title = text("Contact zone of the reference pair at the pitch point, ", torque_words(s.torque));
  for (int g = 0; g < 2; ++g) {
    const MeshArtifact& mesh = g == 0 ? driver : driven;
    const std::string name = g == 0 ? "driver" : "driven";
    const Wireframe wire(mesh);
    const Placement at = placed(pair, g);
    const std::vector<std::string> columns{"x [mm]", "y [mm]"};
    figure.blocks.push_back({name + " outline", columns, wire.outline(at, kMilli)});
    figure.blocks.push_back({name + " teeth", columns, wire.window(at, kMilli, touch, half_window)});
    const BodyDiscretisation& body = g == 0 ? s.driver_body : s.driven_body;
    FigureBlock inner{name + " inner region", columns, {}};
    if (body.near_field == "matching") {
      const ToothGeometry& tooth = pair.gear(g);
      for (double t = 0; t <= 1.0001; t += 0.02) {
        const double roll = tooth.form_roll_angle() + t * (tooth.tip_roll_angle() - tooth.form_roll_angle());
        const Vec2 p = at(tooth.flank_point(roll) - body.matching_depth * tooth.flank_normal(roll)) * kMilli;
        inner.rows.push_back({p.x(), p.y()});
      }
    } else {
      inner.rows = tooth_elements(mesh, at, kMilli);
    }
    figure.blocks.push_back(inner);
  }
  FigureBlock action{"line of action", {"x [mm]", "y [mm]"}, {}};
  for (double side : {-1.0, 1.0}) {
    const Vec2 p = (touch + side * half_window * normal) * kMilli;
    action.rows.push_back({p.x(), p.y()});
  }
  figure.blocks.push_back(action);

  const FlankDeviation deviation[2] = {{pair.gear(0), s.mesh.modification[0]},
                                       {pair.gear(1), s.mesh.modification[1]}};
  const auto on_flanks = [&](double x) {
    const FlankGap at = pair.gap_at(strips.contact, x);
    std::array<Vec2, 2> local;  // along the flank, out of the driver
    for (int g = 0; g < 2; ++g) {
      const ToothGeometry& gear = pair.gear(g);
      const Vec2 place =
          gear.flank_point(at.roll[g]) - deviation[g].at(at.roll[g], 0) * gear.flank_normal(at.roll[g]);
      const Vec2 p = placed(pair, g)(place) - touch;
      local[g] = Vec2(p.dot(tangent), p.dot(normal));
    }
    return local;
  };
  FigureBlock flanks{"flanks", {"along flank [mm]", "driver [µm]", "driven [µm]"}, {}};
  const Eigen::Index n = strips.size();
  const double reach = 0.5 * (strips.border[n] - strips.border[0]);
  for (int k = -60; k <= 60; ++k) {
    const double x = std::clamp(reach * 1.3 * k / 60, strips.contact.x_min, strips.contact.x_max);
    const auto local = on_flanks(x);
    flanks.rows.push_back({x * kMilli, local[0].y() * kMicro, local[1].y() * kMicro});
  }
  FigureBlock candidates{
      "candidate pairs",
      {"along flank [mm]", "P on driver [µm]", "G on driven gear [µm]", "strip from [mm]", "strip to [mm]",
       "gap of strip [µm]", "separation under load [µm]", "pressure [MPa]"},
      {}};
  const double face_width = std::min(s.driver.face_width, s.driven.face_width);
  for (int i = 0; i < n; ++i) {
    const auto local = on_flanks(strips.middle(i));
    candidates.rows.push_back({strips.middle(i) * kMilli, local[0].y() * kMicro, local[1].y() * kMicro,
                               strips.border[i] * kMilli, strips.border[i + 1] * kMilli,
                               strips.gap[i] * kMicro, zone.separation[i] * kMicro,
                               1e-6 * zone.force[i] / (strips.width(i) * face_width)});
  }
  // Hertz's line contact (Johnson, Contact Mechanics, 4.2c) of the same force.
  const double force = zone.force.sum();
  const double compliance = HalfPlaneSurface(s.driver_material, face_width).coefficient() +
                            HalfPlaneSurface(s.driven_material, face_width).coefficient();
  const double half_width = std::sqrt(2 * pair.relative_curvature_radius(0.0) * force * compliance);
  const double peak = 2 * force / (std::numbers::pi * half_width * face_width);
  FigureBlock hertz{"Hertz", {"along flank [mm]", "pressure [MPa]"}, {}};
  for (int k = 0; k <= 120; ++k) {
    const double x = -std::cos(std::numbers::pi * k / 120);
    hertz.rows.push_back({x * half_width * kMilli, 1e-6 * peak * std::sqrt(std::max(0.0, 1 - x * x))});
  }
  figure.blocks.insert(figure.blocks.end(), {flanks, candidates, hertz});

  figure.notes.push_back(pair_words(s));
  const std::string inner =
      s.driver_body.near_field == "matching"
          ? "matched to the finite elements at " + shown(s.driver_body.matching_depth * kMilli, 4) +
                " mm depth"
          : "the half-plane's field is subtracted there, finite elements carry the smooth rest";
  figure.notes.push_back("inner region: " + inner + "; outer region: finite elements");
  figure.notes.push_back(text(n, " strips in the window; tooth force ", fixed(force, 0),
                              " N; approach of the gears ", shown(zone.approach * kMicro, 4),
                              " µm; Hertz: half-width ", shown(half_width * kMicro, 4), " µm, peak ",
                              shown(peak * 1e-6, 4), " MPa"));
  figure.numbers = {{"matching", s.driver_body.near_field == "matching"},
                    {"touch_y", touch.y() * kMilli},
                    {"half_window", half_window * kMilli},
                    {"reach", 1.3 * reach * kMilli},
                    {"peak", peak * 1e-6},
                    {"strips", static_cast<double>(n)}};
  return figure;
}

Figure response_figure(const std::vector<ResponseArtifact>& sweeps, const Background& told) {
  if (sweeps.empty())
    fail(Failure::input, "figure: no response.h5 given; an up and a down sweep are the least");
  std::vector<ChoicePanel<ResponseArtifact>> panels = panels_of(sweeps, told);
  Figure figure;
  std::vector<double> torques;
  bool any_elastic = false, any_lumped = false;
  for (const auto& r : sweeps) {
    torques.push_back(r.torque);
    (elastic(r) ? any_elastic : any_lumped) = true;
  }
  std::sort(torques.begin(), torques.end());
  torques.erase(std::unique(torques.begin(), torques.end()), torques.end());
  figure.title = "Dynamic transmission error against mesh frequency, ";
  for (size_t i = 0; i < torques.size(); ++i) figure.title += (i ? ", " : "") + shown(torques[i], 6);
  figure.title += " N m";
  figure.notes.push_back(
      std::string("f_n: ") +
      (any_elastic ? "mean natural frequency over the mesh period, contact frozen under the static load"
                   : "") +
      (any_elastic && any_lumped ? "; one degree of freedom: " : "") +
      (any_lumped ? "natural frequency of the mass on the mean stiffness" : ""));
  figure.height = panels.size() == 1 ? 1060 : 240 + 660 * static_cast<int>(panels.size());
  double from = std::numeric_limits<double>::infinity(), to = 0;
  const auto number = [&](const std::string& name, double value) {
    figure.numbers.emplace_back(name, value);
  };
  for (size_t p = 0; p < panels.size(); ++p) {
    const std::string letter = letter_of(p);
    const auto& curves = panels[p].curves;
    if (curves.size() > kMostCurves)
      fail(Failure::input, "figure: ", curves.size(), " torques of the same choices given; ", kMostCurves,
           " curves can be told apart");
    std::string labels, jumps, found_jumps;
    double rms = 0, mean_high = -std::numeric_limits<double>::infinity(), mean_low = -mean_high;
    bool lost = false;
    for (size_t c = 0; c < curves.size(); ++c) {
      const std::string label = curve_label(panels[p], *curves[c].up);
      labels += "'" + label + "' ";
      std::string found;
      for (const ResponseArtifact* r : {curves[c].up, curves[c].down}) {
        const std::string name = letter + " " + label + " ";
        figure.blocks.push_back(branch_block(name + r->direction, *r));
        figure.blocks.push_back(jump_block(name + "jumps " + r->direction, *r));
        const std::string at = listed(figure.blocks.back());
        if (!at.empty())
          found +=
              (found.empty() ? " " : ", ") + std::string(r->direction == "up" ? "rising" : "falling") + at;
        number(text("jumps_", r->direction, "_", letter, "_", c + 1),
               static_cast<double>(r->jump_frequency.size()));
        from = std::min(from, r->mesh_frequency.minCoeff());
        to = std::max(to, r->mesh_frequency.maxCoeff());
        rms = std::max(rms, r->dte_rms.maxCoeff());
        mean_high = std::max(mean_high, r->dte_mean.maxCoeff());
        mean_low = std::min(mean_low, r->dte_mean.minCoeff());
        lost |= r->separation_fraction.maxCoeff() > 0;
      }
      const std::string words = label + (found.empty() ? ": no jump" : ": jumps" + found + " Hz");
      jumps += "'" + words + "' ";
      found_jumps += (c ? "; " : "") + words;
      number(text("natural_frequency_", letter, "_", c + 1), curves[c].up->natural_frequency);
    }
    // Scene, operating point, choices: lines above the panel.
    std::vector<std::string> lines{operating_words(panels[p], told), panels[p].choices};
    if (!panels[p].scene.empty()) lines.insert(lines.begin(), panels[p].scene);
    std::string note, heading;
    for (size_t i = 0; i < lines.size(); ++i) {
      note += (i ? "; " : "") + lines[i];
      heading += (i ? "\n" : "") + without_markup(lines[i]);
    }
    const std::string loss = loss_words(panels[p]);
    figure.notes.push_back("(" + letter + ") " + note);
    figure.notes.push_back("(" + letter + ") " + found_jumps + "; " + loss);
    figure.words.emplace_back("heading_" + letter, heading);
    figure.words.emplace_back("loss_" + letter, loss);
    number("heading_lines_" + letter, static_cast<double>(lines.size()));
    figure.words.emplace_back("labels_" + letter, labels);
    figure.words.emplace_back("jump_labels_" + letter, jumps);
    number("curves_" + letter, static_cast<double>(curves.size()));
    number("rms_max_" + letter, rms * kMicro);
    number("mean_max_" + letter, mean_high * kMicro);
    number("mean_min_" + letter, mean_low * kMicro);
    number("contact_lost_" + letter, lost);
  }
  Eigen::Index speeds = 0;
  for (const auto& r : sweeps) speeds = std::max(speeds, r.mesh_frequency.size());
  number("speeds", static_cast<double>(speeds));
  number("panels", static_cast<double>(panels.size()));
  number("frequency_from", from);
  number("frequency_to", to);
  return figure;
}

Figure profile_figure(const StaticArtifact& s) {
  const GearPair pair(s.driver, s.driven, s.mesh.centre_distance);
  const double degree = std::numbers::pi / 180, pitch = pair.base_pitch(),
               tangent = std::tan(pair.working_pressure_angle());
  Figure figure;
  figure.title = "Profile charts of the driving flanks";
  double low = 0, high = 0;
  for (int g = 0; g < 2; ++g) {
    const std::string name = g == 0 ? "driver" : "driven";
    const ToothGeometry& gear = pair.gear(g);
    const FlankDeviation deviation(gear, s.mesh.modification[g]);
    figure.notes.push_back((g == 0 ? s.mesh.driver : s.mesh.driven) + ", " + name + ": " +
                           in_words(s.mesh.modification[g]));
    figure.words.emplace_back("title_" + name, figure.notes.back());
    FigureBlock trace{name, {"roll angle [deg]", "length of roll [mm]", "material [µm]"}, {}};
    const double form = gear.form_roll_angle(), tip = gear.tip_roll_angle();
    constexpr int kPlaces = 400;
    for (int i = 0; i <= kPlaces; ++i) {
      const double roll = form + (tip - form) * i / kPlaces, removed = deviation.at(roll, 0);
      trace.rows.push_back({roll / degree, gear.base_radius() * roll * kMilli, -removed * kMicro});
      low = std::min(low, -removed * kMicro);
      high = std::max(high, -removed * kMicro);
    }
    figure.blocks.push_back(trace);
    // Start of the active profile, lowest and highest point of single-pair contact: where along the path of contact.
    const double first = g == 0 ? pair.path_start() : -pair.path_end(),
                 last = g == 0 ? pair.path_end() : -pair.path_start();
    for (const auto& [mark, path] : {std::pair{"sap", first}, std::pair{"lpstc", last - pitch},
                                     std::pair{"pitch", 0.0}, std::pair{"hpstc", first + pitch}})
      figure.numbers.emplace_back(std::string(mark) + "_" + name,
                                  (tangent + path / gear.base_radius()) / degree);
    figure.numbers.emplace_back("form_" + name, form / degree);
    figure.numbers.emplace_back("tip_" + name, tip / degree);
  }
  figure.numbers.emplace_back("lowest", low);
  figure.numbers.emplace_back("highest", high);
  return figure;
}

Figure vibration_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                        const Background& told) {
  constexpr int kShownPeriods = 3;
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, told, figure);
  set_motion_title(figure, "Oscillating dynamic transmission error", motions, mesh_frequency);
  figure.height = 960 + 29 * static_cast<int>(figure.notes.size());
  double time_end = 0, largest = 0, largest_amplitude = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    const Motion& m = motions[i];
    const Eigen::VectorXd x = m.orbit(m.sweep->transmission_error);
    const int count = resolved_harmonics(x.size(), kShownHarmonics * m.periods);
    if (count < 1)
      fail(Failure::input, "figure: ", x.size(),
           " samples do not resolve the mesh frequency; raise steps_per_period");
    const Harmonics h = harmonics(x, count);
    FigureBlock history{letter_of(i) + " history", {"time [ms]", "oscillating dte [µm]"}, {}};
    const Eigen::Index shown_samples = std::max(kShownPeriods, m.periods) * m.per_period();
    for (Eigen::Index n = 0; n <= shown_samples; ++n) {
      const double value = (x[n % x.size()] - h.mean) * kMicro;
      history.rows.push_back({1e3 * n / (m.per_period() * mesh_frequency), value});
      largest = std::max(largest, std::abs(value));
    }
    time_end = std::max(time_end, history.rows.back()[0]);
    FigureBlock spectrum{letter_of(i) + " spectrum", {"frequency [Hz]", "amplitude [µm]"}, {}};
    for (int k = 1; k <= count; ++k)
      spectrum.rows.push_back({k * mesh_frequency / m.periods, h.amplitude[k - 1] * kMicro});
    Eigen::Index strongest = 0;
    const double amplitude = h.amplitude.maxCoeff(&strongest);
    largest_amplitude = std::max(largest_amplitude, amplitude * kMicro);
    figure.words.emplace_back("title_" + letter_of(i), m.title);
    figure.words.emplace_back(
        "result_" + letter_of(i),
        text("RMS ", shown(h.rms * kMicro, 3), " µm, ", shown(50 * std::pow(amplitude / h.rms, 2), 3),
             " % of its square at ", shown((strongest + 1.0) / m.periods, 3), " × mesh frequency; mean ",
             shown(h.mean * kMicro, 3), " µm"));
    figure.blocks.push_back(history);
    figure.blocks.push_back(spectrum);
  }
  for (const auto& [name, value] : {std::pair{"time_end", time_end},
                                    {"largest", largest},
                                    {"largest_amplitude", largest_amplitude},
                                    {"frequency_end", kShownHarmonics * mesh_frequency}})
    figure.numbers.emplace_back(name, value);
  return figure;
}

Figure tooth_load_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                         const Background& told) {
  constexpr int kFirstPeriod = -1, kPeriods = 3, kFirstTooth = -2, kLastTooth = 3;
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, told, figure);
  set_motion_title(figure, "Tooth loads", motions, mesh_frequency);
  figure.height = 150 + 29 * static_cast<int>(figure.notes.size()) + 330 * static_cast<int>(motions.size());
  double largest = 0;
  const double static_force =
      motions[0].sweep->torque / ToothGeometry(motions[0].sweep->driver).base_radius();
  for (size_t i = 0; i < motions.size(); ++i) {
    const Motion& m = motions[i];
    const Eigen::Index n = m.per_period();
    const Eigen::VectorXd force = m.orbit(m.sweep->mesh_force);
    const MatrixRM& loads = m.sweep->tooth_load[m.row];
    // Sample k of the shown periods: its place in the orbit, its period, its phase.
    const auto row_of = [&](Eigen::Index k) {
      return (k + kPeriods * m.periods * n + kFirstPeriod * n) % force.size();
    };
    const auto phase_of = [&](Eigen::Index k) { return kFirstPeriod + static_cast<double>(k) / n; };
    FigureBlock net{letter_of(i) + " mesh force", {"phase of tooth i [1]", "mesh force [N]"}, {}};
    FigureBlock lost{letter_of(i) + " contact lost", {"from phase [1]", "to phase [1]"}, {}};
    for (Eigen::Index k = 0; k <= kPeriods * n; ++k) {
      const double f = force[row_of(k)];
      net.rows.push_back({phase_of(k), f});
      if (f > 0) continue;
      if (k > 0 && !lost.rows.empty() && force[row_of(k - 1)] == 0)
        lost.rows.back()[1] = phase_of(k);
      else
        lost.rows.push_back({phase_of(k), phase_of(k)});
    }
    figure.numbers.emplace_back("lost_" + letter_of(i), static_cast<double>(lost.rows.size()));
    figure.blocks.push_back(net);
    figure.blocks.push_back(lost);
    // Pair j is j places ahead of the reference pair, which touches at the pitch point at the start of a period: the tooth
    // that does so t periods after tooth i is pair (period - t). Drawn while it carries load, with a sample on either side.
    for (int t = kFirstTooth; t <= kLastTooth; ++t) {
      FigureBlock tooth{
          text(letter_of(i), " tooth i", t < 0 ? "" : "+", t), {"phase of tooth i [1]", "load [N]"}, {}};
      const auto load_at = [&](Eigen::Index k) {
        const Eigen::Index j = kFirstPeriod + k / n - t - m.sweep->pair[0];
        return k >= 0 && k < kPeriods * n && j >= 0 && j < loads.cols() ? loads(row_of(k), j) : 0.0;
      };
      for (Eigen::Index k = 0; k < kPeriods * n; ++k)
        if (load_at(k - 1) > 0 || load_at(k) > 0 || load_at(k + 1) > 0)
          tooth.rows.push_back({phase_of(k), load_at(k)});
        else if (!tooth.rows.empty() && !tooth.rows.back().empty())
          tooth.rows.emplace_back();
      figure.numbers.emplace_back(text("shown_", letter_of(i), "_", t - kFirstTooth), !tooth.rows.empty());
      figure.blocks.push_back(tooth);
    }
    const Separations apart = separations(force);
    const double most = loads.topRows(force.size()).maxCoeff();
    largest = std::max({largest, most, force.maxCoeff()});
    std::string result =
        text("largest tooth load ", fixed(most, 0), " N = ", fixed(most / static_force, 2), " T / r_b; ");
    result += apart.intervals == 0
                  ? "contact is never lost"
                  : text("contact lost ", shown(static_cast<double>(apart.intervals) / m.periods, 3),
                         apart.intervals == m.periods ? " time" : " times", " a mesh period, for ",
                         fixed(100 * apart.fraction, 1), " % of it");
    figure.words.emplace_back("title_" + letter_of(i), m.title);
    figure.words.emplace_back("result_" + letter_of(i), result);
  }
  figure.numbers.emplace_back("largest", largest);
  figure.numbers.emplace_back("static_force", static_force);
  figure.numbers.emplace_back("phase_from", kFirstPeriod);
  figure.numbers.emplace_back("phase_to", kFirstPeriod + kPeriods);
  figure.numbers.emplace_back("first_tooth", kFirstTooth);
  figure.numbers.emplace_back("last_tooth", kLastTooth);
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

Figure sidebands_figure(const StaticArtifact& s, const ResponseArtifact& r) {
  const int periods = s.hunting_periods;
  if (periods < 2)
    fail(Failure::input,
         "figure: the teeth are all alike and have no sidebands; give a gear of the scene a "
         "section [gear.<name>.error]");
  if (r.hunting_periods != periods || r.torque != s.torque)
    fail(Failure::input, "figure: the sweep is of ", r.hunting_periods, " mesh periods at ", r.torque,
         " N m, the statics are of ", periods, " at ", s.torque, " N m; give those of one scene and torque");
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;  // m: below, nothing but round-off
  Eigen::Index peak = 0;
  r.dte_rms.maxCoeff(&peak);
  Figure figure;
  figure.title = "Sidebands of teeth that differ";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(
      "the same teeth meet after ", periods, " mesh periods; orders of the mesh frequency, of the shafts ",
      shown(1.0 / s.driver.teeth, 4), " (driver) and ", shown(1.0 / s.driven.teeth, 4)));
  FigureBlock error{"transmission_error", {"mesh_phase [1]", "transmission_error [µm]"}, {}};
  for (Eigen::Index i = 0; i < s.mesh_phase.size(); ++i)
    error.rows.push_back({s.mesh_phase[i], s.transmission_error[i] * kMicro});
  const auto orders = [&](const std::string& name, Eigen::Index count, const auto& amplitude) {
    FigureBlock block{name, {"order [1]", "amplitude [µm]"}, {}};
    for (Eigen::Index k = 1; k <= count && k <= kLastOrder * periods; ++k)
      block.rows.push_back({static_cast<double>(k) / periods, std::max(kFloor, amplitude(k)) * kMicro});
    return block;
  };
  figure.blocks = {error,
                   orders("orders at rest", s.transmission_error_order.size() - 1,
                          [&](Eigen::Index k) { return s.transmission_error_order[k]; }),
                   orders("orders in motion", r.dte_order.cols(),
                          [&](Eigen::Index k) { return r.dte_order(peak, k - 1); })};
  figure.numbers = {{"periods", static_cast<double>(periods)}, {"last_order", kLastOrder}};
  figure.words = {{"speed", fixed(r.mesh_frequency[peak], 0) + " Hz"}};
  figure.height = 1300;
  return figure;
}

Figure crack_figure(const StaticArtifact& s) {
  const std::array<const GearDesign*, 2> gears{&s.driver, &s.driven};
  std::string cracks;
  for (size_t g = 0; g < 2; ++g)
    if (const Crack& crack = gears[g]->crack; crack.depth > 0)
      cracks += text(cracks.empty() ? "" : "; ", "tooth ", crack.tooth,
                     g ? " of the driven gear" : " of the driver", ": a slit of ",
                     shown(crack.depth * 1e3, 4), " mm from the fillet, ",
                     shown(crack.angle * 180 / std::numbers::pi, 4), "° to the tooth's centre line");
  if (cracks.empty())
    fail(Failure::input,
         "figure: no tooth has a crack; give a gear of the scene a section [gear.<name>.crack]");
  for (const ToothErrors& errors : s.mesh.errors)
    if (!errors.none())
      fail(
          Failure::input,
          "figure: teeth have errors of their own beside the crack; use a scene without [gear.<name>.error]");
  const Eigen::Index positions = s.mesh_phase.size() / s.hunting_periods;
  const auto period = [&](Eigen::Index k) { return s.transmission_error.segment(k * positions, positions); };
  Eigen::Index stiffest = 0, most = 0;
  double largest = 0;
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (period(k).mean() < period(stiffest).mean()) stiffest = k;
  const Eigen::VectorXd intact = period(stiffest);
  for (Eigen::Index k = 0; k < s.hunting_periods; ++k)
    if (const double here = (period(k) - intact).maxCoeff(); here > largest) {
      largest = here;
      most = k;
    }
  constexpr int kAround = 5;  // mesh periods either side
  constexpr double kLastOrder = 3.5, kFloor = 1e-12;
  Figure figure;
  figure.title = "The mark of a cracked tooth in the transmission error";
  figure.notes.push_back(text(pair_words(s), ", ", torque_words(s.torque)));
  figure.notes.push_back(text(cracks, "; adds up to ", shown(largest * kMicro, 3), " µm, ",
                              shown(100 * largest / intact.mean(), 3), " % of the mean"));
  FigureBlock error{"transmission_error",
                    {"mesh periods [1]", "with the crack [µm]", "without [µm]", "difference [µm]"},
                    {}};
  for (Eigen::Index k = -kAround; k <= kAround; ++k) {
    const Eigen::Index at = ((most + k) % s.hunting_periods + s.hunting_periods) % s.hunting_periods;
    for (Eigen::Index i = 0; i < positions; ++i)
      error.rows.push_back({static_cast<double>(k) + static_cast<double>(i) / static_cast<double>(positions),
                            period(at)[i] * kMicro, intact[i] * kMicro,
                            (period(at)[i] - intact[i]) * kMicro});
  }
  FigureBlock orders{"orders", {"order [1]", "amplitude [µm]"}, {}};
  for (Eigen::Index k = 1; k < s.transmission_error_order.size() && k <= kLastOrder * s.hunting_periods; ++k)
    orders.rows.push_back({static_cast<double>(k) / s.hunting_periods,
                           std::max(kFloor, s.transmission_error_order[k]) * kMicro});
  FigureBlock without{"orders without", {"order [1]", "amplitude [µm]"}, {}};
  const Harmonics of_intact = harmonics(intact, static_cast<int>(kLastOrder));
  for (Eigen::Index k = 0; k < of_intact.amplitude.size(); ++k)
    without.rows.push_back({static_cast<double>(k + 1), of_intact.amplitude[k] * kMicro});
  figure.blocks = {error, orders, without};
  figure.numbers = {{"around", kAround}, {"last_order", kLastOrder}};
  return figure;
}

Figure natural_frequency_table(std::vector<ImpactArtifact> impacts, const std::string& published) {
  if (impacts.empty()) fail(Failure::input, "table: no impact.h5 given; 1 is the least");
  std::sort(impacts.begin(), impacts.end(), [](const auto& a, const auto& b) { return a.torque < b.torque; });
  std::map<std::pair<double, std::string>, double> printed;
  if (!published.empty()) {
    std::ifstream file(published);
    if (!file) fail(Failure::io, published, ": cannot be read; it holds the frequencies to compare with");
    for (std::string line; std::getline(file, line);) {
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      double torque = 0, frequency = 0;
      std::string state;
      if (!(words >> torque >> state >> frequency) || !(frequency > 0))
        fail(Failure::input, published, ": '", line,
             "' is not a torque in N m, a contact state and a frequency in Hz");
      printed[{torque, state}] = frequency;
    }
  }

  Figure table;
  table.title = "Natural frequencies by ring-down";
  const ImpactArtifact& first = impacts[0];
  table.notes.push_back("Rayleigh damping η = " + shown(first.damping.rayleigh_stiffness * kMicro, 6) +
                        " µs; " + corner_words(first.mesh.corner));
  const double ratio = GearPair(first.driver, first.driven, first.mesh.centre_distance).contact_ratio();
  const double share = ratio - std::floor(ratio);
  const std::vector<std::string> counts{"one", "two", "three", "four"};
  const size_t few = static_cast<size_t>(ratio) - 1;
  if (few + 1 >= counts.size())
    fail(Failure::input, "table: a contact ratio of ", ratio, "; below ", counts.size(), " is known");
  table.notes.push_back("phase mean: over the phases of a mesh period; contact ratio mean: " +
                        fixed(1 - share, 4) + " of it with " + counts[few] + ", " + fixed(share, 4) +
                        " with " + counts[few + 1] + " pairs, as without load");
  FigureBlock block{"natural frequencies", {"torque [N m]"}, {}};
  for (size_t i = 0; i < impacts.size(); ++i) {
    const ImpactArtifact& a = impacts[i];
    if (i > 0 && a.torque == impacts[i - 1].torque)
      fail(Failure::input, "table: two impact.h5 of the same torque, ", torque_words(a.torque),
           "; give each once");
    const auto at = [&](const std::string& state) {
      const auto found = std::find(a.contact_state.begin(), a.contact_state.end(), state);
      if (found == a.contact_state.end())
        fail(Failure::input, "table: at ", torque_words(a.torque), " the impact.h5 holds no contact state '",
             state, "'; with this load no phase has it");
      return a.natural_frequency[found - a.contact_state.begin()];
    };
    const double low = at(counts[few]), high = at(counts[few + 1]);
    std::vector<double> row{a.torque};
    for (const auto& [name, state, value] :
         {std::tuple{counts[few] + (few == 0 ? " pair" : " pairs"), counts[few], low},
          {counts[few + 1] + " pairs", counts[few + 1], high},
          {std::string("phase mean"), std::string("mean"), at("mean")},
          {std::string("contact ratio mean"), std::string("mean"), (1 - share) * low + share * high}}) {
      if (i == 0) block.columns.push_back(name + " [Hz]");
      row.push_back(value);
      if (published.empty()) continue;
      const auto entry = printed.find({a.torque, state});
      if (entry == printed.end())
        fail(Failure::input, published, ": no frequency for ", torque_words(a.torque), ", contact '", state,
             "'");
      if (i == 0) {
        block.columns.push_back(name + ", published [Hz]");
        block.columns.push_back(name + ", deviation [%]");
      }
      row.push_back(entry->second);
      row.push_back(100 * (value / entry->second - 1));
    }
    block.rows.push_back(row);
  }
  table.blocks.push_back(block);
  return table;
}

std::string natural_frequency_text(const Figure& table) {
  const FigureBlock& block = table.blocks.at(0);
  const bool compared = block.columns.size() == 13;
  std::string out = table.title + "\n";
  for (const auto& note : table.notes) out += note + "\n";
  char line[200];
  std::snprintf(line, sizeof line, "\n%-20s %10s %10s", "contact", "torque N m", "Whine Hz");
  out += line;
  if (compared) {
    std::snprintf(line, sizeof line, " %12s %12s", "published Hz", "deviation %");
    out += line;
  }
  for (size_t c = 1; c < block.columns.size(); c += compared ? 3 : 1)
    for (const auto& row : block.rows) {
      const std::string name = block.columns[c].substr(0, block.columns[c].find(" ["));
      std::snprintf(line, sizeof line, "\n%-20s %10.6g %10.1f", name.c_str(), row[0], row[c]);
      out += line;
      if (!compared) continue;
      std::snprintf(line, sizeof line, " %12.0f %+12.2f", row[c + 1], row[c + 2]);
      out += line;
    }
  return out + "\n";
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

Figure mesh_force_figure(const std::vector<SweepArtifact>& sweeps,
                         const std::vector<double>& mesh_frequencies) {
  if (sweeps.empty()) fail(Failure::input, "figure: no sweep.h5 given; 1 is the least");
  if (sweeps.size() > kMostCurves)
    fail(Failure::input, "figure: ", sweeps.size(), " sweep.h5 given; ", kMostCurves,
         " curves can be told apart");
  if (mesh_frequencies.empty() || mesh_frequencies.size() > 2)
    fail(Failure::input, "figure: ", mesh_frequencies.size(),
         " mesh frequencies given; one or two are shown");
  Figure figure;
  const double torque = sweeps[0].torque;
  figure.title = text("Net mesh force of one degree of freedom (Eq. 23), ", torque_words(torque));
  double largest = 0;
  std::vector<std::string> labels(mesh_frequencies.size());
  const std::vector<std::string> dashes{"solid",       "dashed",      "dotted",
                                        "dash-dotted", "long dashes", "fine dots"};
  for (size_t s = 0; s < sweeps.size(); ++s) {
    const SweepArtifact& sweep = sweeps[s];
    if (sweep.lumped.cell_end.size() == 0)
      fail(Failure::input, "figure: a sweep of elastic gears given; give those of lumped models");
    if (sweep.torque != torque)
      fail(Failure::input, "figure: sweeps at ", torque, " and ", sweep.torque,
           " N m; give those of one torque");
    const double low = sweep.lumped.stiffness.minCoeff(), high = sweep.lumped.stiffness.maxCoeff();
    const bool rising = sweep.direction == "up";
    std::string jumps;
    for (double f : sweep.jump_frequency) jumps += (jumps.empty() ? ", jump at " : ", ") + fixed(f, 1);
    figure.notes.push_back(text(dashes[s], ": ", sweep.model, " stiffness, ", fixed(low * kMega, 1), " to ",
                                fixed(high * kMega, 1), " × 10⁶ N/m (ratio ", fixed(high / low, 3),
                                "), mean ", fixed(sweep.mean_stiffness * kMega, 1), "; ",
                                lumped_words(sweep.lumped), "; speed ", rising ? "rising" : "falling",
                                jumps.empty() ? ", no jump" : jumps + " Hz"));
    for (size_t k = 0; k < mesh_frequencies.size(); ++k) {
      Eigen::Index row = 0;
      (sweep.mesh_frequency.array() - mesh_frequencies[k]).abs().minCoeff(&row);
      const double f = sweep.mesh_frequency[row];
      const Eigen::Index samples = sweep.time.steps_per_period, stored = sweep.mesh_force.cols();
      FigureBlock block{text(letter_of(k), " ", s + 1),
                        {"time [mesh periods]", "mesh_force [N]", "transmission_error [µm]"},
                        {}};
      for (Eigen::Index i = 0; i <= 2 * samples; ++i)
        block.rows.push_back({static_cast<double>(i) / static_cast<double>(samples),
                              sweep.mesh_force(row, i % stored),
                              sweep.transmission_error(row, i % stored) * kMicro});
      figure.blocks.push_back(block);
      largest = std::max(largest, sweep.mesh_force.row(row).maxCoeff());
      // The jump that the sweep comes to next, else the one that it has behind it.
      double next = 0, behind = 0;
      for (double jump : sweep.jump_frequency) {
        double& side = (jump > f) == rising ? next : behind;
        if (side == 0 || std::abs(jump - f) < std::abs(side - f)) side = jump;
      }
      labels[k] += text("'", shown(f, 6), " Hz, ratio ", fixed(high / low, 3),
                        next > 0     ? ", before its jump at " + fixed(next, 0) + " Hz' "
                        : behind > 0 ? ", after its jump at " + fixed(behind, 0) + " Hz' "
                                     : ", no jump' ");
    }
  }
  figure.numbers = {{"curves", static_cast<double>(sweeps.size())},
                    {"panels", static_cast<double>(mesh_frequencies.size())},
                    {"force_max", largest},
                    {"static_force", torque / ToothGeometry(sweeps[0].driver).base_radius()}};
  for (size_t k = 0; k < labels.size(); ++k) figure.words.emplace_back("labels_" + letter_of(k), labels[k]);
  return figure;
}

std::string without_markup(const std::string& words) {
  std::string out;
  for (char c : words) {
    if (std::string("_^{}@&~\\").find(c) != std::string::npos) out += '\\';
    out += c;
  }
  return out;
}

std::string tsv(const Figure& figure, const std::vector<std::string>& sources) {
  std::string out = "# " + figure.title + "\n";
  for (const auto& scene : figure.scenes) out += "# scene " + scene + "\n";
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
