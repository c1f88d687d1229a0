// How the value of each claim is read from a scene's results.
#pragma once
#include <string>

#include "paper/motions.h"

namespace whine::paper {

// P2000 does not say of what its largest loads are the largest, nor how it samples them.
enum class LoadOf { tooth, sum, sustained_tooth };
enum class Load { lower, upper, increase };

// Of the elastic pair.
// Why there are not two motions at a speed f (Hz).
Finding no_second_branch(const SceneResults& s, int torque, const Pair& at, double f);
// Largest load of a motion, N.
double largest_load(const SceneResults& s, const Motion& m, LoadOf what);
Finding table_frequency(const SceneResults& s, int torque, ContactState state);
Finding damping(const SceneResults& s);
Finding resonance(const SceneResults& s, int order, MotionModel model = MotionModel::finite_elements);
// Eq. 22, mesh force as harmonics of the mesh frequency: whether harmonic `order` is the largest of the motion at f_n / order.
Finding driven_by_harmonic(const SceneResults& s, int order);
Finding jumps_at(const SceneResults& s, int torque);
Finding loses_contact(const SceneResults& s, int torque);
Finding two_at(const SceneResults& s, double f);
Finding load(const SceneResults& s, Load which);
Finding upper_losses(const SceneResults& s, double f);
Finding lower_keeps_contact(const SceneResults& s, double f);
Finding nearly_harmonic(const SceneResults& s, double f, int order);
Finding lower_more_distorted(const SceneResults& s, double f, int order);
Finding kink(const SceneResults& s, int torque);
// A second steady state below the resonance of the rising sweep.
Finding softening(const SceneResults& s);
Finding superharmonic_weaker(const SceneResults& s);
// Speeds on the branch between the kink and the jump down: those with two branches, and all above them up to the highest
// speed with loss of contact.
Finding loss_down_to_the_jump(const SceneResults& s);
Finding loss_beyond_two_branches(const SceneResults& s);
Finding lower_never_loses(const SceneResults& s);
Finding grows_with_torque(const SceneResults& s);
Finding width_at(const SceneResults& s, int torque);
// Whether all speeds (Hz) above the resonance at f_n / 2 with two motions lie just below f or not far above it.
Finding two_states_below(const SceneResults& s, int torque, double f);

// Of the models with one degree of freedom, and of the stiffness that they take.
Finding lumped_jumps(const SceneResults& s, int torque);
Finding torque_independent(const SceneResults& s);
// The rows before and after each jump.
Finding mean_jumps(const SceneResults& s, bool less);
Finding lumped_two(const SceneResults& s, double f);
Finding lumped_loss(const SceneResults& s, double f, bool upper);
// Whether the force of one pair, or of all, has a step or none, at the speed nearest to f.
Finding force_step(const SweepResult& sweep, double f, bool one_pair, bool smooth);
Finding secant_reduced(const SceneResults& s);
Finding secant_linear(const SceneResults& s, int torque);
Finding stiffness_spectrum(const SceneResults& s);
Finding spectrum_lost(const SceneResults& s);
Finding modest_difference(const SceneResults& s);

}  // namespace whine::paper
