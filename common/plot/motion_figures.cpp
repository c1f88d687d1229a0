#include "plot/motion_figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/error.h"
#include "gear/pair.h"
#include "io/summary.h"
#include "motion/sweep.h"
#include "signal/response.h"
#include "signal/spectrum.h"

namespace whine {
namespace {

template <class Artifact>
auto gears_of(const Artifact& s) {
  const auto of_gear = [](const GearDesign& g) {
    return std::tuple(g.teeth, g.module, g.profile_shift, g.face_width, g.bore_radius);
  };
  return std::tuple(of_gear(s.driver), of_gear(s.driven), s.driver_inertia, s.driven_inertia,
                    s.mesh.centre_distance, s.mesh.corner.enabled, s.mesh.corner.largest_angle,
                    s.mesh.contact_plane, s.damping.rayleigh_stiffness, s.damping.rayleigh_mass,
                    s.damping.bearing_ratio, s.damping.undamped_depth);
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

// Torques and damping of a panel: "150 N m; damping ratio 5.81 % with one pair, 6.95 % with two pairs in contact, by ring-down". Without the
// impact.h5 of its sweeps the torques alone.
template <class Sweep>
std::string operating_words(const ChoicePanel<Sweep>& panel, const Background& told) {
  std::vector<std::string> torques, at;
  std::string ratios, state, with_one;
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
    if (i > 0 && states[0] == "one")
      with_one += (with_one.empty() ? "" : ", ") + fixed(found->damping_ratio[0] * kPercent, 2);
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
  return words + "; damping ratio " + (with_one.empty() ? "" : with_one + " % with one pair, ") + ratios +
         " %" + (at == torques ? "" : " at " + in_a_row(at)) + " with " + state +
         (state == "one" ? " pair" : " pairs") + " in contact, by ring-down";
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
                    {},
                    "responses",
                    name};
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
                    {},
                    "jumps",
                    name};
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

// The branch of a sweep's pair at its torque; none if it is not among them.
const BranchArtifact* branch_of(const ResponseArtifact& r, const Background& told) {
  if (!elastic(r)) return nullptr;
  const auto found = std::find_if(told.branches.begin(), told.branches.end(), [&](const BranchArtifact& b) {
    return b.torque == r.torque && gears_of(b) == gears_of(r) && b.mesh.modification == r.mesh.modification &&
           b.fidelity.body == r.fidelity.body && b.fidelity.contact == r.fidelity.contact &&
           b.fidelity.integrator == r.fidelity.integrator;
  });
  return found == told.branches.end() ? nullptr : &*found;
}

// Unstable orbits in the order of the arc, each stretch from the fold, or the last stable orbit, to the next.
FigureBlock unstable_block(const std::string& name, const BranchArtifact& b) {
  FigureBlock block{
      name, {"mesh_frequency [Hz]", "dte_rms [µm]", "dte_mean [µm]"}, {}, "unstable orbits", name};
  const auto add = [&](Eigen::Index i) {
    block.rows.push_back({b.mesh_frequency[i], b.dte_rms[i] * kMicro, b.dte_mean[i] * kMicro});
  };
  const Eigen::Index n = b.mesh_frequency.size();
  for (Eigen::Index i = 0; i < n; ++i) {
    if (b.stable[i]) continue;
    if (i > 0 && b.stable[i - 1]) add(i - 1);
    add(i);
    if (i + 1 == n || !b.stable[i + 1]) continue;
    add(i + 1);
    block.rows.emplace_back();
  }
  return block;
}

FigureBlock fold_block(const std::string& name, const BranchArtifact& b) {
  FigureBlock block{name,
                    {"fold_frequency [Hz]", "dte_rms [µm]", "multiplier before [1]", "multiplier after [1]"},
                    {},
                    "folds",
                    name};
  for (Eigen::Index i = 0; i < b.fold_frequency.size(); ++i)
    block.rows.push_back(
        {b.fold_frequency[i], b.fold_rms[i] * kMicro, b.fold_multiplier(i, 0), b.fold_multiplier(i, 1)});
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
  const auto loss_words = [](const auto& curve) {
    const std::string ranges = loss_ranges(*curve.up, *curve.down);
    return ranges == "nowhere" ? ranges : ranges + " Hz";
  };
  const std::string first = loss_words(curves[0]);
  std::string each;
  bool alike = true;
  for (const auto& c : curves) {
    const std::string words = loss_words(c);
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
  int first = 0;      // of these periods: the one that is shown amid its neighbours
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
  lumped.reserve(sweeps.size());
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

// Shown of tooth loads: mesh periods about the middle one, teeth from two before tooth i to three after it.
constexpr int kFirstPeriod = -1, kPeriods = 3, kFirstTooth = -2, kLastTooth = 3;

double static_force(const SweepArtifact& s) {
  return s.torque / ToothGeometry(s.driver).base_radius();
}

// Panel `letter`: loads of successive teeth and of all of them, phases at which contact is lost, and the result in words. The
// largest force of it, N.
double add_tooth_loads(Figure& figure, const std::string& letter, const Motion& m) {
  const Eigen::Index n = m.per_period();
  const Eigen::VectorXd force = m.orbit(m.sweep->mesh_force);
  const MatrixRM& loads = m.sweep->tooth_load[m.row];
  // Sample k of the shown periods: its place in the orbit, its period, its phase.
  const auto row_of = [&](Eigen::Index k) {
    return (k + (kPeriods * m.periods + m.first + kFirstPeriod) * n) % force.size();
  };
  const auto phase_of = [&](Eigen::Index k) { return kFirstPeriod + static_cast<double>(k) / n; };
  FigureBlock net{
      letter + " mesh force", {"phase of tooth i [1]", "force [N]"}, {}, "loads", letter + " all teeth"};
  FigureBlock lost{letter + " contact lost", {"from phase [1]", "to phase [1]"}, {}, "contact lost", letter};
  for (Eigen::Index k = 0; k <= kPeriods * n; ++k) {
    const double f = force[row_of(k)];
    net.rows.push_back({phase_of(k), f});
    if (f > 0) continue;
    if (k > 0 && !lost.rows.empty() && force[row_of(k - 1)] == 0)
      lost.rows.back()[1] = phase_of(k);
    else
      lost.rows.push_back({phase_of(k), phase_of(k)});
  }
  figure.numbers.emplace_back("lost_" + letter, static_cast<double>(lost.rows.size()));
  figure.blocks.push_back(net);
  figure.blocks.push_back(lost);
  // Pair j is j places ahead of the reference pair, which touches at the pitch point at the start of a period: the tooth
  // that does so t periods after tooth i is pair (period - t). Drawn while it carries load, with a sample on either side.
  for (int t = kFirstTooth; t <= kLastTooth; ++t) {
    FigureBlock tooth{
        text(letter, " tooth i", t < 0 ? "" : "+", t), {"phase of tooth i [1]", "force [N]"}, {}, "loads"};
    tooth.curve = tooth.name;
    const auto load_at = [&](Eigen::Index k) {
      const Eigen::Index j = kFirstPeriod + k / n - t - m.sweep->pair[0];
      return k >= 0 && k < kPeriods * n && j >= 0 && j < loads.cols() ? loads(row_of(k), j) : 0.0;
    };
    for (Eigen::Index k = 0; k < kPeriods * n; ++k)
      if (load_at(k - 1) > 0 || load_at(k) > 0 || load_at(k + 1) > 0)
        tooth.rows.push_back({phase_of(k), load_at(k)});
      else if (!tooth.rows.empty() && !tooth.rows.back().empty())
        tooth.rows.emplace_back();
    figure.numbers.emplace_back(text("shown_", letter, "_", t - kFirstTooth), !tooth.rows.empty());
    figure.blocks.push_back(tooth);
  }
  const Separations apart = separations(force);
  const double most = loads.topRows(force.size()).maxCoeff();
  std::string result = text("largest tooth load ", fixed(most, 0),
                            " N = ", fixed(most / static_force(*m.sweep), 2), " T / r_b; ");
  result += apart.intervals == 0
                ? "contact is never lost"
                : text("contact lost ", shown(static_cast<double>(apart.intervals) / m.periods, 3),
                       apart.intervals == m.periods ? " time" : " times", " a mesh period, for ",
                       fixed(100 * apart.fraction, 1), " % of it");
  figure.words.emplace_back("result_" + letter, result);
  return std::max(most, force.maxCoeff());
}

void add_load_axes(Figure& figure, const SweepArtifact& sweep, double largest) {
  figure.numbers.emplace_back("largest", largest);
  figure.numbers.emplace_back("static_force", static_force(sweep));
  figure.numbers.emplace_back("phase_from", kFirstPeriod);
  figure.numbers.emplace_back("phase_to", kFirstPeriod + kPeriods);
  figure.numbers.emplace_back("first_tooth", kFirstTooth);
  figure.numbers.emplace_back("last_tooth", kLastTooth);
}

}  // namespace

std::string loss_ranges(const ResponseArtifact& up, const ResponseArtifact& down) {
  std::map<double, bool> parts;
  for (const ResponseArtifact* r : {&up, &down})
    for (Eigen::Index f = 0; f < r->mesh_frequency.size(); ++f)
      parts[r->mesh_frequency[f]] |= r->separation_fraction[f] > 0;
  const std::string ranges = speed_ranges(parts);
  if (ranges.empty()) return "nowhere";
  return parts.rbegin()->second ? ranges + " or more" : ranges;  // lost at the last speed, too
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
  figure.title = "Dynamic transmission error (DTE) against mesh frequency, ";
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
      if (const BranchArtifact* branch = branch_of(*curves[c].up, told)) {
        const std::string name = letter + " " + label + " ";
        figure.blocks.push_back(unstable_block(name + "unstable", *branch));
        number(text("unstable_", letter, "_", c + 1), static_cast<double>(figure.blocks.back().rows.size()));
        figure.blocks.push_back(fold_block(name + "folds", *branch));
        number(text("folds_", letter, "_", c + 1), static_cast<double>(branch->fold_frequency.size()));
        rms = std::max(rms, branch->dte_rms.maxCoeff());
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

Figure vibration_figure(const std::vector<SweepArtifact>& sweeps, double mesh_frequency,
                        const Background& told) {
  constexpr int kShownPeriods = 3;
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, told, figure);
  set_motion_title(figure, "Oscillating dynamic transmission error (DTE)", motions, mesh_frequency);
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
    const std::string curve = letter_of(i) + " " + m.title;
    FigureBlock history{
        letter_of(i) + " history", {"time [ms]", "oscillating dte [µm]"}, {}, "histories", curve};
    const Eigen::Index shown_samples = std::max(kShownPeriods, m.periods) * m.per_period();
    for (Eigen::Index n = 0; n <= shown_samples; ++n) {
      const double value = (x[n % x.size()] - h.mean) * kMicro;
      history.rows.push_back({1e3 * n / (m.per_period() * mesh_frequency), value});
      largest = std::max(largest, std::abs(value));
    }
    time_end = std::max(time_end, history.rows.back()[0]);
    FigureBlock spectrum{
        letter_of(i) + " spectrum", {"frequency [Hz]", "amplitude [µm]"}, {}, "spectra", curve};
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
  Figure figure;
  const std::vector<Motion> motions = motions_at(sweeps, mesh_frequency, told, figure);
  set_motion_title(figure, "Tooth loads", motions, mesh_frequency);
  figure.height = 150 + 29 * static_cast<int>(figure.notes.size()) + 330 * static_cast<int>(motions.size());
  double largest = 0;
  for (size_t i = 0; i < motions.size(); ++i) {
    largest = std::max(largest, add_tooth_loads(figure, letter_of(i), motions[i]));
    figure.words.emplace_back("title_" + letter_of(i), motions[i].title);
  }
  add_load_axes(figure, *motions[0].sweep, largest);
  return figure;
}

Figure dynamic_load_figure(const std::vector<SweepArtifact>& sweeps, Background told) {
  told.lumped = lumped_of(sweeps);
  const auto panels = panels_of(sweeps, told);
  if (panels.size() != 1 || panels[0].curves.size() != 1)
    fail(Failure::input, "figure: sweeps of ",
         panels.empty() ? 0 : std::max(panels.size(), panels[0].curves.size()),
         " torques or sets of choices given; tooth loads against speed are of one");
  const auto& curve = panels[0].curves[0];
  Figure figure;
  figure.title = "Tooth loads against mesh frequency, " + torque_words(curve.up->torque);
  figure.notes = {operating_words(panels[0], told), panels[0].choices};
  figure.height = 1240;
  Motion worst;
  double rms = -1, from = std::numeric_limits<double>::infinity(), to = 0, most = 0;
  bool lost = false;
  for (const SweepArtifact* sweep : {curve.up, curve.down}) {
    const ResponseArtifact r = response(*sweep);
    figure.blocks.push_back(branch_block(sweep->direction, r));
    Eigen::Index row = 0;
    if (const double here = r.dte_rms.maxCoeff(&row); here > rms) {
      rms = here;
      worst = motion_at(*sweep, r.mesh_frequency[row]);
    }
    from = std::min(from, r.mesh_frequency.minCoeff());
    to = std::max(to, r.mesh_frequency.maxCoeff());
    most = std::max(most, r.tooth_load_max.maxCoeff());
    lost |= r.separation_fraction.maxCoeff() > 0;
  }
  // Of several periods that differ the one with the largest load in the middle.
  Eigen::Index sample = 0;
  worst.sweep->tooth_load[worst.row]
      .topRows(worst.periods * worst.per_period())
      .rowwise()
      .maxCoeff()
      .maxCoeff(&sample);
  worst.first = static_cast<int>(sample / worst.per_period());
  const double speed = worst.sweep->mesh_frequency[worst.row];
  const double largest = add_tooth_loads(figure, "b", worst);
  add_load_axes(figure, *curve.up, largest);
  figure.words.emplace_back(
      "title_b",
      text("at ", shown(speed, 6), " Hz, speed ", worst.sweep->direction == "up" ? "rising" : "falling",
           ", where the RMS of the transmission error is largest (", shown(rms * kMicro, 3), " µm)"));
  figure.numbers.insert(figure.numbers.end(),
                        {{"frequency_from", from},
                         {"frequency_to", to},
                         {"speeds", static_cast<double>(curve.up->mesh_frequency.size())},
                         {"load_max", most},
                         {"worst_speed", speed},
                         {"contact_lost", lost}});
  return figure;
}

Figure bearing_force_figure(const std::vector<ResponseArtifact>& sweeps, const Background& told) {
  const auto panels = panels_of(sweeps, told);
  if (panels.size() != 1 || panels[0].curves.size() != 1)
    fail(Failure::input, "figure: sweeps of ",
         panels.empty() ? 0 : std::max(panels.size(), panels[0].curves.size()),
         " torques or sets of choices given; bearing forces against speed are of one");
  const auto& curve = panels[0].curves[0];
  const GearMeshSpec& mesh = curve.up->mesh;
  if (!mesh.on_bearings())
    fail(Failure::input,
         "figure: no gear of this pair is on an elastic bearing; add [[bearing]] to the scene");
  Figure figure;
  figure.title = "Forces on the bearings against mesh frequency, " + torque_words(curve.up->torque);
  figure.notes = {operating_words(panels[0], told), panels[0].choices};
  std::string labels;
  double rms = 0, most = 0;
  int curves = 0;
  for (int g = 0; g < 2; ++g) {
    const Bearing& bearing = mesh.bearing[g];
    if (!bearing.elastic()) continue;
    ++curves;
    labels += text("'", mesh.gear(g), ", ", shown(bearing.stiffness * 1e-6, 4), " N/µm' ");
    for (const ResponseArtifact* r : {curve.up, curve.down}) {
      const std::string name = text(curves, " ", r->direction);
      FigureBlock block{name,
                        {"mesh_frequency [Hz]", "bearing_force_rms [N]", "bearing_force_max [N]"},
                        {},
                        "forces",
                        mesh.gear(g) + " " + r->direction};
      const std::vector<bool> broken = broken_after(*r);
      for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i) {
        block.rows.push_back({r->mesh_frequency[i], r->bearing_force_rms[g][i], r->bearing_force_max[g][i]});
        if (broken[i]) block.rows.emplace_back();
      }
      rms = std::max(rms, r->bearing_force_rms[g].maxCoeff());
      most = std::max(most, r->bearing_force_max[g].maxCoeff());
      figure.blocks.push_back(block);
    }
  }
  figure.words.emplace_back("labels", labels);
  const GearPair gears(curve.up->driver, curve.up->driven, mesh.centre_distance);
  figure.numbers = {{"curves", curves},
                    {"rms_max", rms},
                    {"force_max", most},
                    {"static_force", curve.up->torque / gears.gear(0).base_radius()},
                    {"frequency_from", curve.up->mesh_frequency.minCoeff()},
                    {"frequency_to", curve.up->mesh_frequency.maxCoeff()},
                    {"natural_frequency", curve.up->natural_frequency}};
  return figure;
}

Figure waterfall_figure(const std::vector<SweepArtifact>& sweeps) {
  constexpr Eigen::Index kMostSpectra = 160;
  constexpr int kOrders = 5;
  constexpr double kLeast = 1e-4;  // of the largest amplitude
  if (sweeps.empty() || sweeps.size() > 2)
    fail(Failure::input, "figure: ", sweeps.size(),
         " sweep.h5 given; a waterfall is of a sweep, or of those up and down");
  if (sweeps.size() == 2) panels_of(sweeps, Background{{}, lumped_of(sweeps), {}});
  std::vector<const SweepArtifact*> shown;
  for (const char* direction : {"up", "down"})
    for (const SweepArtifact& sweep : sweeps)
      if (sweep.direction == direction) shown.push_back(&sweep);
  if (shown.empty())
    fail(Failure::input, "figure: a sweep of direction '", sweeps[0].direction, "'; up and down are known");
  const auto words_of = [](const SweepArtifact& sweep) {
    return std::string("speed ") + (sweep.direction == "up" ? "rising" : "falling");
  };
  const SweepArtifact& first = *shown.front();
  Figure figure;
  figure.title =
      text("Spectra of the dynamic transmission error against mesh frequency, ", torque_words(first.torque),
           ", ", shown.size() == 1 ? words_of(first) : "speed rising and falling");
  figure.notes.push_back(elastic(first) ? choice_words(first)
                                        : choice_words(first) + "; " + lumped_words(first.lumped));
  figure.height = shown.size() == 1 ? 1000 : 1760;

  double largest = 0, slowest = std::numeric_limits<double>::infinity(), fastest = 0, end = 0;
  Eigen::Index group = 1, known = kOrders;
  for (const SweepArtifact* sweep : shown) {
    slowest = std::min(slowest, sweep->mesh_frequency.minCoeff());
    fastest = std::max(fastest, sweep->mesh_frequency.maxCoeff());
    end = std::max({end, 2.5 * sweep->natural_frequency, 1.5 * fastest});
    group = std::max(group, (sweep->mesh_frequency.size() + kMostSpectra - 1) / kMostSpectra);
  }
  std::string directions;
  for (const SweepArtifact* sweep : shown) {
    const ResponseArtifact r = response(*sweep);
    const Eigen::Index speeds = r.mesh_frequency.size();
    const std::string& d = sweep->direction;
    FigureBlock lines{
        "spectra " + d, {"mesh_frequency [Hz]", "frequency [Hz]", "amplitude [µm]"}, {}, "spectra", d};
    for (Eigen::Index g = 0; g < speeds; g += group) {
      Eigen::Index row = 0;
      r.dte_rms.segment(g, std::min(group, speeds - g)).maxCoeff(&row);
      const double f = r.mesh_frequency[g + row];
      const Motion m = motion_at(*sweep, f);
      const Eigen::VectorXd x = m.orbit(sweep->transmission_error);
      const int count = resolved_harmonics(x.size(), static_cast<int>(std::floor(end / f * m.periods)));
      const Harmonics h = harmonics(x, count);
      for (int k = 1; k <= count; ++k) {
        lines.rows.push_back({f, k * f / m.periods, h.amplitude[k - 1] * kMicro});
        largest = std::max(largest, lines.rows.back()[2]);
      }
    }
    FigureBlock orders{"orders " + d, {"mesh_frequency [Hz]"}, {}, "orders", d};
    known = std::min(known, r.dte_harmonic.cols());
    for (Eigen::Index k = 1; k <= known; ++k)
      orders.columns.push_back(text("amplitude of order ", k, " [µm]"));
    const std::vector<bool> broken = broken_after(r);
    for (Eigen::Index i = 0; i < speeds; ++i) {
      std::vector<double> row{r.mesh_frequency[i]};
      for (Eigen::Index k = 0; k < known; ++k) row.push_back(r.dte_harmonic(i, k) * kMicro);
      orders.rows.push_back(row);
      if (broken[i]) orders.rows.emplace_back();
    }
    figure.blocks.insert(figure.blocks.end(), {lines, orders});
    directions += (directions.empty() ? "" : " ") + d;
  }
  figure.notes.push_back(
      group == 1 ? "a spectrum at each speed"
                 : text("of ", group, " neighbouring speeds the spectrum of the one with the largest RMS"));
  for (FigureBlock& block : figure.blocks)
    if (block.name.starts_with("spectra"))
      std::erase_if(block.rows, [&](const std::vector<double>& row) { return row[2] < kLeast * largest; });
  figure.words = {{"directions", directions}};
  figure.numbers = {
      {"orders", static_cast<double>(known)},
      {"largest", largest},
      {"speed_step",
       (fastest - slowest) / std::max<double>(1, std::ceil(static_cast<double>(first.mesh_frequency.size()) /
                                                           static_cast<double>(group)) -
                                                     1)},
      {"natural_frequency", first.natural_frequency},
      {"frequency_end", end},
      {"rows", static_cast<double>(shown.size())},
      {"frequency_from", slowest},
      {"frequency_to", fastest}};
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
                        {},
                        "forces",
                        text(shown(f, 6), " Hz, sweep ", s + 1)};
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

}  // namespace whine
