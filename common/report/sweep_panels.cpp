#include "report/sweep_panels.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "base/error.h"
#include "gear/pair.h"
#include "io/summary.h"
#include "signal/response.h"

namespace whine {
namespace {

template <class Artifact>
auto gears_with_model(const Artifact& s) {
  const auto of_gear = [](const GearDesign& g) {
    return std::tuple(g.teeth, g.module, g.profile_shift, g.face_width, g.clamped_radius());
  };
  return std::tuple(of_gear(s.gear[0].design), of_gear(s.gear[1].design), s.inertia[0], s.inertia[1],
                    s.mesh.centre_distance, s.mesh.corner.enabled, s.mesh.corner.largest_angle,
                    s.mesh.contact_plane, s.damping.rayleigh_stiffness, s.damping.rayleigh_mass,
                    s.damping.bearing_ratio, s.damping.undamped_depth);
}

// All that two sweeps must share to be one experiment, besides the torque.
template <class Sweep>
auto choices_of(const Sweep& s, const LumpedParameters& lumped) {
  return std::tuple(s.model, gears_with_model(s), s.fidelity.body, s.fidelity.contact, s.fidelity.integrator,
                    lumped.mass, lumped.damping_ratio, lumped.damper_acts);
}

}  // namespace

bool beyond_backlash(const ResponseResult& r, Eigen::Index row) {
  return row < r.backlash_left.size() && r.backlash_left[row] <= 0;
}

std::string speeds_beyond_backlash(std::initializer_list<const ResponseResult*> sweeps, double scale) {
  std::map<double, bool> beyond;
  for (const ResponseResult* r : sweeps)
    for (Eigen::Index i = 0; i < r->mesh_frequency.size(); ++i)
      beyond[r->mesh_frequency[i] * scale] |= beyond_backlash(*r, i);
  return speed_ranges(beyond);
}

std::string lumped_words(const LumpedParameters& lumped) {
  if (!(lumped.mass > 0)) return "mass and damping ratio: see its sweep.h5";
  return text("mass ", shown(lumped.mass, 5), " kg, damping ratio ",
              shown(lumped.damping_ratio * kPercent, 4), " %, damper ",
              lumped.damper_acts == DamperActs::contact ? "in contact only" : "always on");
}

template <class Sweep>
std::string choice_words(const Sweep& s) {
  if (!elastic(s))
    return text("one degree of freedom (Eq. 23), mesh stiffness: ", s.model, "; integrator ",
                s.fidelity.integrator, "; its statics: ", corner_words(s));
  std::string words = "Rayleigh damping η = " + shown(s.damping.rayleigh_stiffness * kMicro, 6) + " µs";
  if (s.damping.rayleigh_mass != 0) words += ", µ = " + shown(s.damping.rayleigh_mass, 6) + " s⁻¹";
  return words + text(", undamped to ", shown(s.damping.undamped_depth * kMilli, 4),
                      " mm depth, bearing ratio ", shown(s.damping.bearing_ratio, 4), "; ", corner_words(s),
                      "; body ", s.fidelity.body, ", contact ", s.fidelity.contact, ", integrator ",
                      s.fidelity.integrator);
}

template <class Sweep>
std::vector<ChoicePanel<Sweep>> panels_of(const std::vector<Sweep>& sweeps,
                                          const CaptionSources& background) {
  std::vector<ChoicePanel<Sweep>> panels;
  std::vector<const Sweep*> first;  // of each panel
  for (size_t i = 0; i < sweeps.size(); ++i) {
    const Sweep& s = sweeps[i];
    const LumpedParameters lumped = background.lumped.empty() ? LumpedParameters{} : background.lumped.at(i);
    size_t p = 0;
    while (p < first.size() && choices_of(*first[p], panels[p].lumped) != choices_of(s, lumped)) ++p;
    if (p == first.size()) {
      first.push_back(&s);
      panels.push_back(
          {choice_words(s), background.scenes.empty() ? "" : background.scenes.at(i), lumped, {}});
    }
    auto& curves = panels[p].curves;
    const auto of = [](const auto& c) { return c.up ? c.up : c.down; };
    const auto same = [&](const auto& c) {
      return of(c)->torque == s.torque && of(c)->mesh.modification == s.mesh.modification;
    };
    auto at = std::find_if(curves.begin(), curves.end(), same);
    if (at == curves.end()) at = curves.emplace(at);
    const Sweep*& place = s.direction == Direction::up ? at->up : at->down;
    if (place)
      fail(Failure::input, "figure: two sweeps ", s.direction, " at ", torque_words(s.torque), " with ",
           choice_words(s), "; give each once");
    place = &s;
  }
  for (const auto& panel : panels)
    for (const auto& c : panel.curves)
      if (!c.up || !c.down)
        fail(
            Failure::input, "figure: the sweep ", c.up ? "up" : "down", " at ",
            torque_words((c.up ? c.up : c.down)->torque), " with ", panel.choices, " has no sweep ",
            c.up ? "down" : "up",
            " of the same torque, gears, model, damping, corner rule and fidelity beside it; make both from one scene");
  return panels;
}

template <class Sweep>
std::string operating_words(const ChoicePanel<Sweep>& panel, const CaptionSources& background) {
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
        std::find_if(background.impacts.begin(), background.impacts.end(), [&](const ImpactResult& impact) {
          return impact.torque == s.torque && gears_with_model(impact) == gears_with_model(s) &&
                 impact.mesh.modification == s.mesh.modification && impact.states.mesh_phase.size() > 0;
        });
    if (!elastic(s) || found == background.impacts.end()) continue;
    // Many pairs as without load; with any load there may be more.
    const auto many = static_cast<ContactState>(std::ceil(GearPair(s).contact_ratio() - 1e-9));
    const auto& states = found->states.contact_state;
    const Eigen::Index i = found->states.row_of(many).value_or(found->states.mesh_phase.size() - 1);
    const std::string own = name_of(states[static_cast<size_t>(i)]);
    state = known++ == 0 || state == own ? own : "most";
    ratios += (ratios.empty() ? "" : ", ") + fixed(found->states.damping_ratio[i] * kPercent, 2);
    if (i > 0 && states[0] == ContactState::one)
      with_one += (with_one.empty() ? "" : ", ") + fixed(found->states.damping_ratio[0] * kPercent, 2);
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

namespace {

template <class Artifact>
const Artifact* found_for(const ResponseResult& r, const std::vector<Artifact>& all, const auto& also) {
  if (!elastic(r)) return nullptr;
  for (const Artifact& a : all)
    if (a.torque == r.torque && gears_with_model(a) == gears_with_model(r) &&
        a.mesh.modification == r.mesh.modification && a.fidelity.body == r.fidelity.body &&
        a.fidelity.contact == r.fidelity.contact && a.fidelity.integrator == r.fidelity.integrator && also(a))
      return &a;
  return nullptr;
}

}  // namespace

const BranchResult* branch_of(const ResponseResult& r, const CaptionSources& background) {
  return found_for(r, background.branches, [](const BranchResult&) { return true; });
}

const SweepErrorsResult* errors_of(const ResponseResult& r, const CaptionSources& background) {
  return found_for(r, background.errors,
                   [&](const SweepErrorsResult& errors) { return errors.direction == r.direction; });
}

template <class Sweep>
const typename ChoicePanel<Sweep>::Curve& only_curve(const std::vector<ChoicePanel<Sweep>>& panels,
                                                     const std::string& what) {
  if (panels.size() != 1 || panels[0].curves.size() != 1)
    fail(Failure::input, "figure: sweeps of ",
         panels.empty() ? 0 : std::max(panels.size(), panels[0].curves.size()),
         " torques or sets of choices given; ", what, " are of one");
  return panels[0].curves[0];
}

template std::vector<ChoicePanel<ResponseResult>> panels_of(const std::vector<ResponseResult>&,
                                                            const CaptionSources&);
template const ChoicePanel<ResponseResult>::Curve& only_curve(const std::vector<ChoicePanel<ResponseResult>>&,
                                                              const std::string&);
template std::string choice_words(const ResponseResult&);
template std::string operating_words(const ChoicePanel<ResponseResult>&, const CaptionSources&);
template std::string curve_label(const ChoicePanel<ResponseResult>&, const ResponseResult&);
template std::vector<ChoicePanel<SweepResult>> panels_of(const std::vector<SweepResult>&,
                                                         const CaptionSources&);
template const ChoicePanel<SweepResult>::Curve& only_curve(const std::vector<ChoicePanel<SweepResult>>&,
                                                           const std::string&);
template std::string choice_words(const SweepResult&);
template std::string operating_words(const ChoicePanel<SweepResult>&, const CaptionSources&);
template std::string curve_label(const ChoicePanel<SweepResult>&, const SweepResult&);

}  // namespace whine
