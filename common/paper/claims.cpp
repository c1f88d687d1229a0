#include "paper/claims.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "lumped/stiffness.h"
#include "paper/findings.h"

namespace whine {

std::string digits(double value, int count) {
  std::ostringstream out;
  // Whole numbers stay whole: 1.23e+04 is no way to write 12345.
  if (std::abs(value) >= std::pow(10.0, count))
    out << std::fixed << std::setprecision(0) << value;
  else
    out << std::setprecision(count) << value;
  return out.str();
}

namespace paper {
namespace {

using Find = std::function<Finding(const SceneAnswers&)>;

Claim number(std::string id, std::string place, std::string text, std::string unit, double printed,
             double tolerance, std::string basis, Find find) {
  return {std::move(id), std::move(place), std::move(text),  Scale::number,  std::move(unit),
          printed,       tolerance,        std::move(basis), std::move(find)};
}

Claim statement(std::string id, std::string place, std::string text, std::string basis, Find find) {
  return {std::move(id),    std::move(place), std::move(text), Scale::statement, "yes/no", 1, 0,
          std::move(basis), std::move(find)};
}

Claim incomparable(std::string id, std::string place, std::string text, std::string unit, double printed,
                   std::string basis, Find find) {
  return {
      std::move(id),    std::move(place), std::move(text), Scale::incomparable, std::move(unit), printed, 0,
      std::move(basis), std::move(find)};
}

Claim given(Claim claim) {
  claim.given = true;
  return claim;
}

Claim given_number(std::string id, std::string place, std::string text, std::string unit, double printed,
                   double tolerance, std::string basis, Find find) {
  return given(number(std::move(id), std::move(place), std::move(text), std::move(unit), printed, tolerance,
                      std::move(basis), std::move(find)));
}

Claim of_scale(Scale scale, Claim claim) {
  claim.scale = scale;
  return claim;
}

Find nothing() {
  return [](const SceneAnswers&) { return Finding{kNone, ""}; };
}

// Largest RMS of all speeds at each torque of a model.
Find largest_text(const std::string& model) {
  return [=](const SceneAnswers& s) {
    std::string note;
    for (int torque : kTorques)
      note += text(note.empty() ? "" : ", ", digits(largest_rms(s.branches(torque, model)) * kMicro, 3));
    return Finding{kNone, "here largest RMS at 100, 200, 300 N m: " + note + " µm"};
  };
}

std::vector<Claim> make_claims() {
  std::vector<Claim> c;
  const std::string given_basis = "input: the scene takes it over";
  const std::string grid = "one step: Table 1 has multiples of 20 Hz only";
  const std::string rig = "no numbers of the rig's curves are printed";
  const std::string curve = "a curve without numbers in the text";
  const auto torques = [](int torque) { return text(torque, " N m"); };

  // --- 1, 2
  c.push_back(incomparable(
      "rig-phenomena", "1", "rig: jumps, sub- and superharmonic resonances, parametric instability, chaos",
      "yes/no", kNone, "measured, no numbers", [](const SceneAnswers& s) {
        Index other = 0;
        for (int torque : kSweptTorques)
          for (const ResponseArtifact* r : {&s.branches(torque).up, &s.branches(torque).down})
            other += (r->period_multiple.array() != 1).count();
        return Finding{
            kNone, text("here ", other, " speeds, of all sweeps, that do not repeat with the mesh period")};
      }));
  const auto newmark = [](double value) {
    return [=](const SceneAnswers& s) {
      const Integrator integrator = s.branches(kFigureTorque).up.fidelity.integrator;
      return integrator == Integrator::newmark
                 ? Finding{value, ""}
                 : Finding{kNone, text("integrator = \"", integrator, "\" has no such number")};
    };
  };
  c.push_back(of_scale(
      Scale::choice, number("newmark-gamma", "2", "Newmark's gamma", "1", 0.5, 0,
                            "how P2000 computes, no result; given with integrator = newmark", newmark(0.5))));
  c.push_back(of_scale(Scale::choice, number("newmark-beta", "2", "Newmark's beta", "1", 0.25, 0,
                                             "how P2000 computes, no result; given with integrator = newmark",
                                             newmark(0.25))));

  // --- 2.1, the gears
  const auto gear = [](auto of) {
    return [=](const SceneAnswers& s) { return Finding{of(s.at_rest(100)), ""}; };
  };
  c.push_back(given_number("teeth", "2.1", "teeth of each gear", "1", 50, 0, given_basis,
                           gear([](const StaticArtifact& a) { return double(a.driver.teeth); })));
  c.push_back(given_number("module", "2.1", "module", "mm", 3, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.module; })));
  c.push_back(given_number(
      "pressure-angle", "2.1", "pressure angle", "deg", 20, 1e-9, given_basis,
      gear([](const StaticArtifact& a) { return a.driver.pressure_angle * 180 / std::numbers::pi; })));
  c.push_back(of_scale(
      Scale::misprint,
      number("base-radius", "2.1, 3", "base radius (printed twice)", "mm", 7.047, 0,
             "P2000's own numbers give ten times as much: 75 mm cos 20 deg", [](const SceneAnswers& s) {
               const StaticArtifact& a = s.at_rest(100);
               const double r = a.driver.module * a.driver.teeth * std::cos(a.driver.pressure_angle) / 2;
               return Finding{
                   1e3 * r, text(a.driver.teeth, " teeth of module ", digits(1e3 * a.driver.module),
                                 " mm have ", digits(1e3 * r, 5),
                                 " mm, and only with it k = (T / r) / STE gives the printed mean stiffness")};
             })));
  c.push_back(number("contact-ratio", "2.1", "contact ratio", "1", 1.75, 0.005,
                     "half of the last printed digit",
                     gear([](const StaticArtifact& a) { return a.contact_ratio; })));
  c.push_back(incomparable("rig-face-width", "2.1", "face width of the rig's gears", "mm", 20,
                           "P2000 computes with 25.4 mm, and so do the scenes",
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.face_width; })));
  c.push_back(given_number("face-width", "2.1", "face width of the model", "mm", 25.4, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return 1e3 * a.driver.face_width; })));
  c.push_back(
      given_number("youngs-modulus", "2.1", "elasticity modulus", "GPa", 207, 1e-9, given_basis,
                   gear([](const StaticArtifact& a) { return 1e-9 * a.driver_material.youngs_modulus; })));
  c.push_back(given_number("density", "2.1", "density", "kg/m3", 7600, 1e-9, given_basis,
                           gear([](const StaticArtifact& a) { return a.driver_material.density; })));

  // --- 2.1, impact tests
  c.push_back(incomparable("rig-natural-frequency", "2.1", "natural frequency of the rig, \"around\"", "Hz",
                           2700, "the rig's gears are 20 mm wide", [](const SceneAnswers& s) {
                             return Finding{table_frequency(s, 100, "mean").value, "25.4 mm wide, 100 N m"};
                           }));
  c.push_back(of_scale(
      Scale::choice, number("impact-torque", "2.1", "torque of the impact over the steady torque", "1", 1.2,
                            0, "how P2000 measures, no result; given with gear-impact --torque-step 0.2",
                            [](const SceneAnswers& s) {
                              const double step = s.ring_down(100).torque_step;
                              return Finding{1 + step, text("here a step of ", digits(step, 2),
                                                            " is let go: so small that the decay is linear")};
                            })));
  const double scaled_rig = 2700 * std::sqrt(25.4 / 20);
  for (int torque : kTorques)
    c.push_back(
        statement(text("within-5-percent-", torque), "2.1",
                  text("mean natural frequency within 5 % of 2700 sqrt(25.4/20) Hz, ", torques(torque)),
                  "5 % of 3043 Hz", [=](const SceneAnswers& s) {
                    const double off = table_frequency(s, torque, "mean").value / scaled_rig - 1;
                    return Finding{std::abs(off) <= 0.05 ? 1.0 : 0.0, text(digits(100 * off, 2), " %")};
                  }));
  struct Row {
    const char *state, *words;
    std::array<double, 3> printed;
  };
  for (const Row& row : {Row{"one", "one pair in mesh", {2480, 2480, 2560}},
                         Row{"two", "two pairs in mesh", {3040, 3040, 3040}},
                         Row{"mean", "mean over the mesh cycle", {2900, 2900, 2920}}})
    for (size_t t = 0; t < kTorques.size(); ++t) {
      const int torque = kTorques[t];
      const std::string state = row.state, id = text("table1-", state, "-", torque), place = "Table 1";
      const std::string words = text("natural frequency, ", row.words, ", ", torques(torque));
      const Find find = [=](const SceneAnswers& s) { return table_frequency(s, torque, state); };
      c.push_back(number(id, place, words, "Hz", row.printed[t], 20, grid, find));
    }
  c.push_back(statement(
      "weak-function-of-load", "2.1", "natural frequency a weak function of load",
      "each row of Table 1 from 100 to 300 N m by 5 % at most, as P2000 allows against the rig "
      "there; its own rows "
      "have up to 3.2 %",
      [](const SceneAnswers& s) {
        bool weak = true;
        std::string note;
        for (const char* state : {"one", "two", "mean"}) {
          double low = std::numeric_limits<double>::infinity(), high = 0;
          for (int torque : kTorques) {
            const double f = table_frequency(s, torque, state).value;
            low = std::min(low, f);
            high = std::max(high, f);
          }
          weak = weak && high <= 1.05 * low;
          note += text(note.empty() ? "" : ", ", state, " ", digits(100 * (high / low - 1), 2), " %");
        }
        return Finding{weak ? 1.0 : 0.0, note};
      }));
  c.push_back(number("damping", "2.1", "damping ratio by ring-down, the text does not say in which contact",
                     "%", 7, 0.5, "half of the last printed digit", damping));
  c.push_back(given(statement("bearing-damping", "2.1", "bearing damping below 1 %", given_basis,
                              [](const SceneAnswers& s) {
                                const double ratio = s.branches(kFigureTorque).up.damping.bearing_ratio;
                                return Finding{ratio < 0.01 ? 1.0 : 0.0, text(digits(100 * ratio, 2), " %")};
                              })));
  c.push_back(incomparable("bearing-damping-drift", "2.1",
                           "bearing damping is the least that removes numerical drift", "yes/no", kNone,
                           "the rigid motion of the pair is projected out here: nothing drifts", nothing()));

  // --- 2.1, resonances at 150 N m
  const std::string about = "\"approximately\"; the rig's own jump below 2500 Hz lies 7 % under its 2700 Hz";
  c.push_back(number("resonance-1", "2.1, Fig 5", "primary resonance, f_m over f_n, rising speed, 150 N m",
                     "1", 1, 0.1, about, [](const SceneAnswers& s) { return resonance(s, 1); }));
  c.push_back(number("resonance-2", "2.1, Fig 5", "resonance at half of it (rig: 1350 Hz)", "1", 0.5, 0.05,
                     about, [](const SceneAnswers& s) { return resonance(s, 2); }));
  c.push_back(number("resonance-3", "2.1, Fig 5", "resonance at a third of it", "1", 1 / 3.0, 1 / 30.0, about,
                     [](const SceneAnswers& s) { return resonance(s, 3); }));
  for (int order : {2, 3})
    c.push_back(statement(text("driven-by-harmonic-", order), "2.1, Eq 22",
                          text("the resonance at f_n/", order, " is driven by harmonic ", order, " of f_m"),
                          "it is the largest harmonic there",
                          [=](const SceneAnswers& s) { return driven_by_harmonic(s, order); }));
  c.push_back(statement(
      "softening", "2.1, Fig 5", "the primary peak bends to lower speeds, with two steady states",
      "falling speed keeps the larger motion to a lower speed than rising speed reaches it", softening));
  c.push_back(statement(
      "superharmonic-weaker", "2.1", "jumps less pronounced in the superharmonic resonances",
      "lower rise of the RMS across a jump of the rising sweep than near f_n", superharmonic_weaker));
  c.push_back(incomparable("rig-two-states", "2.1, Fig 4", "rig, 150 N m: two steady states just below", "Hz",
                           2500, "the rig's gears are 20 mm wide, its branches have no printed ends",
                           [](const SceneAnswers& s) { return width_at(s, kFigureTorque); }));
  c.push_back(incomparable("sound-pressure", "2.1", "rig: sound pressure of the branches 10 to 40 dB apart",
                           "dB", kNone, "sound is not computed", [](const SceneAnswers& s) {
                             const Pair at = printed_branches(s, kPrimary);
                             if (!at.two()) return no_second_branch(s, kFigureTorque, at, kPrimary);
                             return Finding{kNone,
                                            text("RMS of the DTE ",
                                                 digits(20 * std::log10(at.upper.rms() / at.lower.rms()), 3),
                                                 " dB apart at ", digits(at.upper.speed()), " Hz")};
                           }));
  c.push_back(incomparable("jumps-above-rig", "2.1", "computed resonances and jumps slightly above the rig's",
                           "yes/no", kNone, rig, [](const SceneAnswers& s) {
                             return Finding{kNone, jumps_text(s.branches(kFigureTorque))};
                           }));
  c.push_back(incomparable("amplitudes-as-rig", "2.1, Figs 4 to 7",
                           "computed amplitudes agree quite well with the rig's", "yes/no", kNone, rig,
                           largest_text("")));
  c.push_back(incomparable("fig5-fig7", "Figs 5, 7", "computed RMS of the DTE against speed", "µm", kNone,
                           curve, largest_text("")));

  // --- 2.1, torques
  for (int torque : {100, 150, 200, 300})
    c.push_back(statement(text("jumps-", torque), torque == kFigureTorque ? "2.1, Fig 5" : "2.1, Fig 7",
                          "jumps, rising and falling speed, " + torques(torque), "both sweeps have one",
                          [=](const SceneAnswers& s) { return jumps_at(s, torque); }));
  c.push_back(statement("amplitude-grows", "2.1, Figs 6, 7",
                        "amplitude at resonance larger for larger torque",
                        "the largest RMS grows from torque to torque", grows_with_torque));
  c.push_back(incomparable("overlap-100", "2.1",
                           "100 N m: two steady states over a wider range than on the rig", "yes/no", kNone,
                           rig, [](const SceneAnswers& s) { return width_at(s, 100); }));
  c.push_back(incomparable("damping-fitted", "2.1",
                           "damping chosen so that the jump down at 100 N m agrees with the rig", "yes/no",
                           kNone, "the rig's jump is not printed", [](const SceneAnswers& s) {
                             return Finding{kNone, jumps_text(s.branches(100))};
                           }));

  // --- 2.1, both branches at 150 N m
  struct Speed {
    double f;
    const char* where;
  };
  for (const Speed& at : {Speed{kPrimary, "Figs 8, 10"}, Speed{kPrimaryText, "2.1"},
                          Speed{kSecondary, "Figs 9, 11"}, Speed{kSecondaryText, "2.1"}}) {
    const double f = at.f;
    c.push_back(statement(
        text("branches-", f), at.where, text("two steady states at ", f, " Hz, 150 N m"),
        text("RMS more than 20 % apart: neighbouring speeds of one branch are closer",
             f < kPrimary ? "; the upper one of the resonance at f_n / 2: its largest harmonic is 2" : "",
             "; where caption and text name two speeds, at one between them"),
        [=](const SceneAnswers& s) { return two_at(s, f); }));
    c.push_back(statement(text("lower-keeps-contact-", f), at.where,
                          text("lower branch at ", f, " Hz: no contact loss"), "force above zero throughout",
                          [=](const SceneAnswers& s) { return lower_keeps_contact(s, f); }));
    if (f >= kPrimaryText || f == kPrimary)
      c.push_back(statement(text("upper-loses-contact-", f), at.where,
                            text("upper branch at ", f, " Hz: no force over part of each mesh cycle"),
                            "one loss a cycle or more", [=](const SceneAnswers& s) {
                              Finding losses = upper_losses(s, f);
                              if (!std::isnan(losses.value)) losses.value = losses.value >= 1;
                              return losses;
                            }));
    else
      c.push_back(number(text("upper-two-losses-", f), at.where,
                         text("upper branch at ", f, " Hz: contact losses in a mesh cycle"), "1", 2, 0,
                         "a count", [=](const SceneAnswers& s) { return upper_losses(s, f); }));
  }
  const std::string pure =
      "\"nearly\" has no number: RMS of that harmonic at least 95 % of all, the others a third of it";
  c.push_back(statement("upper-harmonic-1", "2.1, Fig 8", "upper branch at 2400 Hz nearly harmonic at f_m",
                        pure, [](const SceneAnswers& s) { return nearly_harmonic(s, kPrimary, 1); }));
  c.push_back(statement("lower-distorted-1", "2.1, Fig 8",
                        "lower branch at 2400 Hz: some distortion from higher harmonics",
                        "smaller share of harmonic 1 than on the upper branch",
                        [](const SceneAnswers& s) { return lower_more_distorted(s, kPrimary, 1); }));
  c.push_back(statement("upper-harmonic-2", "2.1, Fig 9", "upper branch at 1300 Hz nearly harmonic at 2 f_m",
                        pure, [](const SceneAnswers& s) { return nearly_harmonic(s, kSecondary, 2); }));
  c.push_back(statement("lower-distorted-2", "2.1, Fig 9",
                        "lower branch at 1300 Hz has more distortion than the upper",
                        "smaller share of harmonic 2 than on the upper branch",
                        [](const SceneAnswers& s) { return lower_more_distorted(s, kSecondary, 2); }));
  c.push_back(statement("upper-larger-2", "2.1, Fig 9",
                        "upper branch at 1300 Hz: considerably higher amplitude",
                        "\"considerably\" has no number: by half at least, less than the 62 % of the loads",
                        [](const SceneAnswers& s) {
                          const Pair at = printed_branches(s, kSecondary);
                          if (!at.two()) return no_second_branch(s, kFigureTorque, at, kSecondary);
                          const double ratio = at.upper.rms() / at.lower.rms();
                          return Finding{ratio >= 1.5 ? 1.0 : 0.0, text(digits(ratio, 3), " times")};
                        }));
  c.push_back(incomparable("time-domain-as-rig", "2.1", "time histories closely match the measured ones",
                           "yes/no", kNone, rig, nothing()));

  // --- 2.1, loads at 150 N m
  c.push_back(statement(
      "smooth-transition", "2.1, Fig 10", "lower branch at 2400 Hz: load passes smoothly from tooth to tooth",
      "no step between samples above 10 % of the largest load, as in a drawn curve, and thrice those beside "
      "it, as on no slope",
      [](const SceneAnswers& s) {
        const Pair at = printed_branches(s, kPrimary);
        if (!at.two()) return no_second_branch(s, kFigureTorque, at, kPrimary);
        return force_step(s.sweep(kFigureTorque, at.lower.sweep->direction), at.lower.speed(), true, true);
      }));
  const std::string speeds =
      "5 %: caption and text differ by 4 % in the speed, the load is printed to 1 to 2 %";
  c.push_back(number("load-lower", "2.1, Fig 10",
                     "largest load, lower branch at 2400 Hz, of one tooth or in sum", "N", 3000, 150, speeds,
                     [](const SceneAnswers& s) { return load(s, Load::lower); }));
  c.push_back(number("load-upper", "2.1, Fig 10",
                     "largest load, upper branch at 2400 Hz, of one tooth or in sum", "N", 4850, 242.5,
                     speeds, [](const SceneAnswers& s) { return load(s, Load::upper); }));
  c.push_back(number("load-increase", "2.1, Fig 10",
                     "its increase from branch to branch, of one tooth or in sum", "%", 62, 8.1,
                     "5 % of the ratio 1.62, as of the loads",
                     [](const SceneAnswers& s) { return load(s, Load::increase); }));
  c.push_back(statement(
      "load-larger-2", "2.1, Fig 11", "1300 Hz: largest tooth load considerably larger with contact loss",
      "\"considerably\" has no number: by a fifth at least, a third of the 62 % at 2400 Hz",
      [](const SceneAnswers& s) {
        const Pair at = printed_branches(s, kSecondary);
        if (!at.two()) return no_second_branch(s, kFigureTorque, at, kSecondary);
        const double upper = largest_load(s, at.upper, LoadOf::tooth),
                     lower = largest_load(s, at.lower, LoadOf::tooth);
        return Finding{upper >= 1.2 * lower ? 1.0 : 0.0, text(digits(upper), " and ", digits(lower), " N")};
      }));

  // --- 2.1, contact loss
  c.push_back(statement("loss-300", "2.1, Fig 7", "contact loss even at 300 N m", "at one speed at least",
                        [](const SceneAnswers& s) { return loses_contact(s, 300); }));
  c.push_back(statement("loss-600", "2.1", "contact loss at 600 N m", "at one speed at least",
                        [](const SceneAnswers& s) { return loses_contact(s, 600); }));
  c.push_back(statement("jumps-600", "2.1", "jumps at 600 N m", "both sweeps have one",
                        [](const SceneAnswers& s) { return jumps_at(s, 600); }));
  c.push_back(statement(
      "amplitude-600", "2.1", "largest amplitude at 600 N m considerably greater than at 300 N m",
      "\"considerably\" has no number: by half at least, the torque being twice as large",
      [](const SceneAnswers& s) {
        const double ratio = largest_rms(s.branches(600)) / largest_rms(s.branches(300));
        return Finding{ratio >= 1.5 ? 1.0 : 0.0, text(digits(ratio, 3), " times; at 600 N m ",
                                                      loss_text(s.branches(600)), ", ", excitation(s, 600))};
      }));
  for (int torque : kTorques)
    c.push_back(statement(text("kink-", torque), "2.1, Fig 7",
                          text("contact loss begins just above f_n, ", torques(torque)),
                          "\"just above\": highest speed with contact loss 1 to 1.1 f_n, P2000's kink of the "
                          "lumped model being at 1.07",
                          [=](const SceneAnswers& s) { return kink(s, torque); }));
  c.push_back(statement(
      "loss-down-to-jump", "2.1, Fig 7", "contact loss along the whole upper branch, kink to jump down",
      "at every speed of it, and there is one at 100, 200 and 300 N m", loss_down_to_the_jump));
  c.push_back(
      statement("loss-beyond-jumps", "2.1, Fig 7", "contact loss also where there is one steady state",
                "above the highest speed with two, at 100, 200 and 300 N m", loss_beyond_two_branches));
  c.push_back(statement(
      "lower-never-loses", "2.1, Fig 7", "contact loss never along the lower branch",
      "of the primary resonance, which the sentence is about: at no speed with two steady states above "
      "1.15 f_n / 2, at 100, 200 and 300 N m",
      lower_never_loses));

  // --- 3, the lumped models
  const auto lumped = [](auto of) {
    return [=](const SceneAnswers& s) {
      return Finding{of(s.sweep(kFigureTorque, "up", "rectangular")), ""};
    };
  };
  c.push_back(given_number("sdof-damping", "3", "damping ratio of the lumped model", "%", 8, 1e-9,
                           "input: gear-lumped takes it over",
                           lumped([](const SweepArtifact& a) { return 100 * a.lumped.damping_ratio; })));
  c.push_back(given_number("sdof-mass", "3", "mass of the lumped model", "kg", 1.4, 1e-9,
                           "input: gear-lumped takes it over",
                           lumped([](const SweepArtifact& a) { return a.lumped.mass; })));
  c.push_back(number("mean-stiffness", "3", "mean mesh stiffness, 100 N m", "N/µm", 462.1, 4.6,
                     "1 %: the torque is not said, and Table 1's mean frequency moves by 0.7 % with it",
                     [](const SceneAnswers& s) {
                       return Finding{s.at_rest(100).mean_stiffness * kMega, ""};
                     }));
  c.push_back(number(
      "sdof-natural-frequency", "3", "sqrt(k_avg / m) / 2 pi", "Hz", 2900, 20,
      "one step of 20 Hz: the printed k_avg and m themselves give 2891.5 Hz", [](const SceneAnswers& s) {
        const SweepArtifact& a = s.sweep(kFigureTorque, "up", "rectangular");
        return Finding{std::sqrt(s.at_rest(100).mean_stiffness / a.lumped.mass) / (2 * std::numbers::pi),
                       "secant stiffness at 100 N m"};
      }));
  c.push_back(incomparable("fig12", "Fig 12", "static transmission error and spectrum", "µm", kNone, curve,
                           [](const SceneAnswers& s) {
                             std::string note;
                             for (int torque : kTorques)
                               note +=
                                   text(note.empty() ? "" : ", ",
                                        digits(s.at_rest(torque).transmission_error_harmonic[0] * kMicro));
                             return Finding{kNone, "mean at 100, 200, 300 N m: " + note + " µm"};
                           }));
  c.push_back(incomparable("fig13", "Fig 13", "mesh stiffness and spectrum", "N/µm", kNone, curve,
                           [](const SceneAnswers& s) {
                             const RectangularWave wave = rectangular_wave(s.at_rest(100));
                             return Finding{kNone, text("rectangular wave ", digits(wave.low * kMega),
                                                        " and ", digits(wave.high * kMega), " N/µm")};
                           }));
  c.push_back(statement(
      "mean-stiffness-torque", "3, Fig 13", "mean mesh stiffness changes little with torque",
      "2.8 % from 100 to 300 N m: what Table 1 leaves room for, whose mean frequency rises from 2900 to 2920 "
      "Hz, each to 10 Hz: "
      "1.4 % at most, the stiffness twice that",
      [](const SceneAnswers& s) {
        const double low = s.at_rest(100).mean_stiffness, high = s.at_rest(300).mean_stiffness;
        return Finding{
            std::abs(high / low - 1) <= 0.028 ? 1.0 : 0.0,
            text("by ", digits(100 * (high / low - 1), 2), " %: ", digits(low * kMega), ", ",
                 digits(s.at_rest(200).mean_stiffness * kMega), ", ", digits(high * kMega), " N/µm")};
      }));
  c.push_back(statement("stiffness-spectrum", "3, Fig 13", "spectrum of k changes sharply with torque",
                        "\"sharply\" has no number: first harmonic over the mean falls with torque, by a "
                        "fifth at least, while the mean changes by a "
                        "few per cent",
                        stiffness_spectrum));
  c.push_back(statement(
      "stiffness-modest", "3, Fig 13", "k of the statics differs modestly from the rectangular wave",
      "\"modestly\" has no number: by an RMS of 20 % of the mean at most, what the wave itself swings",
      modest_difference));
  c.push_back(statement(
      "spectrum-lost", "4, Fig 13", "low harmonics of the rectangular wave are lost in k of the statics",
      "\"lost\" has no number: harmonics 1 to 3 smaller at each torque, by half at 300 N m", spectrum_lost));
  c.push_back(incomparable("sdof-as-rig", "3, Fig 14",
                           "rectangular wave: amplitudes and jumps of the rig with reasonable accuracy",
                           "yes/no", kNone, rig, largest_text("rectangular")));
  for (int torque : kTorques)
    c.push_back(statement(text("sdof-jumps-", torque), "3, Fig 14",
                          "rectangular wave: jumps, " + torques(torque), "both sweeps have one",
                          [=](const SceneAnswers& s) { return lumped_jumps(s, torque); }));
  c.push_back(number("sdof-resonance-2", "3, Fig 14", "rectangular wave: resonance at half of f_n", "1", 0.5,
                     0.05, about, [](const SceneAnswers& s) { return resonance(s, 2, "rectangular"); }));
  c.push_back(statement(
      "sdof-torque-independent", "3, Fig 14", "rectangular wave: jump frequencies independent of torque",
      "apart by 1 Hz at most at 100, 200, 300 N m: ends of branches are found to less", torque_independent));
  c.push_back(
      statement("sdof-mean-opposite", "3, Fig 14", "the mean DTE jumps up where its RMS jumps down, and back",
                "opposite signs at every jump", [](const SceneAnswers& s) { return mean_jumps(s, false); }));
  c.push_back(statement("sdof-mean-less", "3, Fig 14", "changes of the mean DTE less than those of its RMS",
                        "at every jump", [](const SceneAnswers& s) { return mean_jumps(s, true); }));
  c.push_back(number("sdof-kink", "3, Fig 14", "rectangular wave: contact loss begins around", "Hz", 3100, 50,
                     "\"around\": half of the last printed digit", [](const SceneAnswers& s) {
                       const std::vector<double> lost =
                           speeds_with_loss(s.branches(kFigureTorque, "rectangular"));
                       if (lost.empty()) return Finding{kNone, "contact never lost"};
                       const double f_n = s.branches(kFigureTorque, "rectangular").up.natural_frequency;
                       return Finding{lost.back(), text(digits(lost.back() / f_n, 3), " f_n")};
                     }));
  c.push_back(statement("sdof-upper-2200", "Fig 15", "rectangular wave, 150 N m: upper branch at 2200 Hz",
                        "two steady states there",
                        [](const SceneAnswers& s) { return lumped_two(s, 2200); }));
  c.push_back(statement("sdof-upper-loses", "3, Fig 15", "contact loss on it", "one loss a cycle or more",
                        [](const SceneAnswers& s) { return lumped_loss(s, 2200, true); }));
  c.push_back(statement("sdof-lower-2150", "Fig 15", "lower branch at 2150 Hz",
                        "a motion without contact loss there, the only one or not: P2000's upper branch, "
                        "still there at 2200 Hz, may have ended",
                        [](const SceneAnswers& s) { return lumped_loss(s, 2150, false); }));
  c.push_back(statement("sdof-force-step", "3, Fig 15", "the net mesh force is discontinuous where k steps",
                        "a step between samples above 10 % of the largest force, as in a drawn curve, and "
                        "thrice those beside it, as on no slope",
                        [](const SceneAnswers& s) {
                          return force_step(s.sweep(kFigureTorque, "up", "rectangular"), 2150, false, false);
                        }));
  c.push_back(statement(
      "secant-reduced", "3, Fig 16", "k of the statics: amplitudes strikingly reduced",
      "\"strikingly\" has no number: half of those of the rectangular wave at most, 100, 200, 300 N m",
      secant_reduced));
  c.push_back(statement(
      "secant-loss-100", "3, Fig 16", "k of the statics: contact loss at the low torque, 100 N m",
      "at one speed at least", [](const SceneAnswers& s) {
        const Branches b = s.branches(100, "secant");
        return Finding{speeds_with_loss(b).empty() ? 0.0 : 1.0,
                       text(loss_text(b), "; first harmonic of k ",
                            digits(100 * first_harmonic_share(s.at_rest(100)), 3), " % of its mean")};
      }));
  for (int torque : {200, 300})
    c.push_back(statement(text("secant-linear-", torque), "3, Fig 16",
                          "k of the statics: linear at " + torques(torque), "no contact loss, no jump",
                          [=](const SceneAnswers& s) { return secant_linear(s, torque); }));
  c.push_back(incomparable("fig14-fig16", "Figs 14, 16", "RMS and mean of the DTE against speed", "µm", kNone,
                           curve, largest_text("secant")));
  c.push_back(incomparable("secant-against-rig", "3, Fig 16",
                           "k of the statics: results do not agree with the rig", "yes/no", kNone, rig,
                           nothing()));
  return c;
}

}  // namespace
}  // namespace paper

const std::vector<Claim>& paper_claims() {
  static const std::vector<Claim> claims = paper::make_claims();
  return claims;
}

}  // namespace whine
