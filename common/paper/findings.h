// How the value of each claim is read from what a scene answers.
#pragma once
#include <string>

#include "paper/motions.h"

namespace whine::paper {

// P2000 does not say of what its largest loads are the largest, nor how it samples them.
enum class LoadOf { tooth, sum, held_tooth };
enum class Load { lower, upper, increase };

// Of the elastic pair.
// Why there are not two motions at a speed f (Hz).
Finding no_second_branch(const SceneAnswers& s, int torque, const Pair& at, double f);
// Largest load of a motion, N.
double largest_load(const SceneAnswers& s, const Motion& m, LoadOf what);
Finding table_frequency(const SceneAnswers& s, int torque, const std::string& state);
Finding damping(const SceneAnswers& s);
Finding resonance(const SceneAnswers& s, int order, const std::string& model = "");
Finding driven_by_harmonic(const SceneAnswers& s, int order);
Finding jumps_at(const SceneAnswers& s, int torque);
Finding loses_contact(const SceneAnswers& s, int torque);
Finding two_at(const SceneAnswers& s, double f);
Finding load(const SceneAnswers& s, Load which);
Finding upper_losses(const SceneAnswers& s, double f);
Finding lower_keeps_contact(const SceneAnswers& s, double f);
Finding nearly_harmonic(const SceneAnswers& s, double f, int order);
Finding lower_more_distorted(const SceneAnswers& s, double f, int order);
Finding kink(const SceneAnswers& s, int torque);
// A second steady state below the resonance of the rising sweep.
Finding softening(const SceneAnswers& s);
Finding superharmonic_weaker(const SceneAnswers& s);
// Speeds on the branch between the kink and the jump down: those with two branches, and all above them up to the highest
// speed with loss of contact.
Finding loss_down_to_the_jump(const SceneAnswers& s);
Finding loss_beyond_two_branches(const SceneAnswers& s);
Finding lower_never_loses(const SceneAnswers& s);
Finding grows_with_torque(const SceneAnswers& s);
Finding width_at(const SceneAnswers& s, int torque);

// Of the models with one degree of freedom, and of the stiffness that they take.
Finding lumped_jumps(const SceneAnswers& s, int torque);
Finding torque_independent(const SceneAnswers& s);
// The rows before and after each jump.
Finding mean_jumps(const SceneAnswers& s, bool less);
Finding lumped_two(const SceneAnswers& s, double f);
Finding lumped_loss(const SceneAnswers& s, double f, bool upper);
// Whether the force of one pair, or of all, has a step or none, at the speed nearest to f.
Finding force_step(const SweepArtifact& sweep, double f, bool one_pair, bool smooth);
Finding secant_reduced(const SceneAnswers& s);
Finding secant_linear(const SceneAnswers& s, int torque);
Finding stiffness_spectrum(const SceneAnswers& s);
Finding spectrum_lost(const SceneAnswers& s);
Finding modest_difference(const SceneAnswers& s);

}  // namespace whine::paper
