// What the artifacts of branches have in common, those of pairs (BranchResult) and of systems (SystemBranchResult): multipliers and
// stability of each orbit, folds, period doublings, tori.
//
// Private to the layer io/.
#pragma once
#include "io/codec.h"

namespace whine {

// Of each point of the branch. Orbits of several mesh periods and parts of a branch are those of pairs.
template <class Branch>
void describe_stability(Codec& c, Branch& a) {
  using namespace ranges;
  c.dataset({"/floquet_multiplier", "1",
             "multipliers over the orbit, largest modulus first: real and imaginary part",
             "point multiplier part", kMultiplier},
            &a.floquet_multiplier);
  c.dataset({"/stable", "1", "1: all multipliers lie inside the unit circle", "point", kFlag}, &a.stable);
  c.dataset({"/steps", "1", "time steps per mesh period", "point", kNumber}, &a.steps);
  if constexpr (requires { a.period_multiple; }) {
    c.dataset({"/period_multiple", "1", "mesh periods after which the orbit repeats", "point", kNumber},
              &a.period_multiple);
    c.dataset(
        {"/branch", "1",
         "number of the part: its points follow each other along the arc; parts begin at one orbit or beside a period doubling",
         "point", kNumber},
        &a.part);
  }
  c.dataset({"/residual", "1", "relative change of the state over the orbit", "point", {0, 1e300}},
            &a.residual);
  c.dataset({"/segment_mismatch", "1", "relative change of the orbit where the number of steps changes",
             "segment", kPositive},
            &a.segment_mismatch);
}

// Where the branch turns and orbits lose their stability. The RMS of a fold is that of pairs.
template <class Branch>
void describe_folds(Codec& c, Branch& a) {
  using namespace ranges;
  c.dataset({"/fold_frequency", "Hz", "mesh frequency at which the branch turns", "fold", kFrequency},
            &a.fold_frequency);
  c.dataset({"/fold_width", "Hz",
             "of the interval in which it lies; at a kink that in which a smooth map would have it", "fold",
             kFrequency},
            &a.fold_width);
  if constexpr (requires { a.fold_rms; })
    c.dataset({"/fold_rms", "m", "RMS of the oscillating transmission error there", "fold", kSize},
              &a.fold_rms);
  c.dataset({"/fold_smooth", "1", "1: a multiplier is 1 there; 0: at a kink, where contacts of a step change",
             "fold", kFlag},
            &a.fold_smooth);
  c.dataset({"/fold_multiplier", "1", "real multiplier nearest to 1, before and after the fold", "fold side",
             kMultiplier},
            &a.fold_multiplier);
  c.dataset({"/flip_frequency", "Hz", "mesh frequency at which a multiplier passes -1", "flip", kFrequency},
            &a.flip_frequency);
  c.dataset({"/flip_width", "Hz", "as fold_width", "flip", kFrequency}, &a.flip_width);
  c.dataset(
      {"/torus_frequency", "Hz",
       "mesh frequency at which the modulus of a complex pair of multipliers passes 1", "torus", kFrequency},
      &a.torus_frequency);
  c.dataset({"/torus_width", "Hz", "as fold_width", "torus", kFrequency}, &a.torus_width);
}

}  // namespace whine
