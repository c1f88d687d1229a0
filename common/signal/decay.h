// The slowest oscillation of a free decay, from its samples.
//
// Matrix pencil (Hua and Sarkar, IEEE Trans. Acoust. Speech Signal Process. 38 (1990) 814): the samples of a sum
// of damped exponentials a_k z_k^j fill a Hankel matrix of as many singular values as there are exponentials,
// and the z_k follow from the shift between its rows. Other modes get roots of their own, so they do not
// disturb the one that is asked for, as they would peaks and zero crossings. How many there are is read from the
// singular values: those above round-off (1e-9 of the largest) and noise.
#pragma once
#include <Eigen/Core>
#include <limits>

namespace whine {

// A root s of a damped oscillation.
struct DampedRoot {
  double frequency = 0;      // Hz: Im s / 2 pi, of the decaying oscillation itself
  double damping_ratio = 0;  // 1: -Re s / |s|
};

struct Decay {
  // Lowest frequency among the pairs that hold a tenth of the strongest one's energy or more; or, asked for, the one whose
  // modulus is nearest to a frequency, among those that hold a millionth.
  DampedRoot root;
  double residual = 0;   // 1: RMS of samples less all exponentials over RMS of samples
  int exponentials = 0;  // how many were fitted; two for an oscillation
};

// samples: (sample) of a signal that decays to zero, at equal steps (s) from any start on; several oscillations, and
// more than two samples in each. Throws Error(input) for fewer than 16 samples, values that are not finite, or no
// signal; Error(numerical) if nothing in it oscillates and decays.
// near: Hz, 0 for the lowest. most: exponentials that are fitted at most; a third of the samples bounds them, too. Bound them where
// the signal may be no sum of exponentials: enough of them fit anything.
Decay fit_decay(const Eigen::Ref<const Eigen::VectorXd>& samples, double step, double near = 0,
                int most = std::numeric_limits<int>::max());

}  // namespace whine
