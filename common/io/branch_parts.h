// What the artifacts of branches have in common, those of pairs (BranchResult) and of systems (SystemBranchResult): multipliers and
// stability of each orbit, folds, period doublings, tori.
//
// Private to the layer io/.
#pragma once
#include "io/codec.h"

namespace whine {

// Of each point of the branch.
template <class Branch>
void describe_stability(Codec& c, Branch& a) {
  using namespace ranges;
  c(a.floquet_multiplier, "/floquet_multiplier", "1", kMultiplier, "point multiplier part",
    "multipliers over the orbit, largest modulus first: real and imaginary part");
  c(a.stable, "/stable", "1", kFlag, "point", "1: all multipliers lie inside the unit circle");
  c(a.steps, "/steps", "1", kNumber, "point", "time steps per mesh period");
  c(a.period_multiple, "/period_multiple", "1", kNumber, "point",
    "mesh periods after which the orbit repeats");
  c(a.part, "/branch", "1", kNumber, "point",
    "number of the part: its points follow each other along the arc; parts begin at one orbit or beside a period doubling");
  c(a.residual, "/residual", "1", {0, 1e300}, "point", "relative change of the state over the orbit");
  c(a.segment_mismatch, "/segment_mismatch", "1", kPositive, "segment",
    "relative change of the orbit where the number of steps changes");
}

// Where the branch turns, orbits lose their stability and contacts begin to come or go. The RMS of a fold is that of pairs.
template <class Branch>
void describe_folds(Codec& c, Branch& a) {
  using namespace ranges;
  c(a.fold_frequency, "/fold_frequency", "Hz", kFrequency, "fold",
    "mesh frequency at which the branch turns");
  c(a.fold_width, "/fold_width", "Hz", kFrequency, "fold",
    "of the interval in which it lies; at a kink that in which a smooth map would have it");
  if constexpr (requires { a.fold_rms; })
    c(a.fold_rms, "/fold_rms", "m", kSize, "fold", "RMS of the oscillating transmission error there");
  c(a.fold_smooth, "/fold_smooth", "1", kFlag, "fold",
    "1: a multiplier is 1 there; 0: at a kink, where contacts of a step change");
  c(a.fold_multiplier, "/fold_multiplier", "1", kMultiplier, "fold side",
    "real multiplier nearest to 1, before and after the fold");
  c(a.flip_frequency, "/flip_frequency", "Hz", kFrequency, "flip",
    "mesh frequency at which a multiplier passes -1");
  c(a.flip_width, "/flip_width", "Hz", kFrequency, "flip", "as fold_width");
  c(a.torus_frequency, "/torus_frequency", "Hz", kFrequency, "torus",
    "mesh frequency at which the modulus of a complex pair of multipliers passes 1");
  c(a.torus_width, "/torus_width", "Hz", kFrequency, "torus", "as fold_width");
  c(a.grazing_frequency, "/grazing_frequency", "Hz", kFrequency, "grazing",
    "mesh frequency at which the sequence of contacts changes");
  c(a.grazing_phase, "/grazing_phase", "1", kShare, "grazing",
    "mesh phase of the contact that comes or goes");
  if constexpr (requires { a.grazing_mesh; })
    c(a.grazing_mesh, "/grazing_mesh", "1", kNumber, "grazing", "its mesh, the number of its axis");
  c(a.grazing_pair, "/grazing_pair", "1", kPair, "grazing", "its tooth pair");
  c(a.grazing_closes, "/grazing_closes", "1", kFlag, "grazing", "1: it closes, 0: it opens");
}

}  // namespace whine
