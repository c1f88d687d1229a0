// Ring-downs at a fixed mesh phase, of pairs and of trains: the eigenvalues of the frozen contact, the fit of a decay, and what results say of
// a mode.
#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/fixed_phase_motion.h"
#include "results/impact.h"
#include "signal/decay.h"

namespace whine {

// s-1: all eigenvalues of gears at a fixed phase with these strips in contact: modes, relaxed loads and the local compliance as one
// linear system z'' + c z' + w^2 z = -H^T p, eta P' + P = p, A p = H z - R P. The first coordinate is a rigid rotation that the
// strips feel. Throws Error(numerical) if the contact has no stiffness, or if they are not found.
Eigen::VectorXcd frozen_roots(const FixedPhaseMesh& mesh, const std::vector<int>& touching);
// Those that oscillate, one of each pair of them: Im s > 0.
std::vector<std::complex<double>> oscillating_roots(const FixedPhaseMesh& mesh,
                                                    const std::vector<int>& touching);
// The first of those whose modulus is nearest to that of a frequency (Hz); the end of none.
std::vector<std::complex<double>>::iterator nearest_root(std::vector<std::complex<double>>& roots,
                                                         double frequency);
DampedRoot damped_root(const std::complex<double>& s);
// (mode) damped roots of the modes of these undamped frequencies (Hz, ascending), all contacts of the mesh frozen: to each the root of
// nearest modulus that no other mode has. Frequency 0 and ratio 1 where none lies within a third: damped above critical. Throws as
// frozen_roots().
std::vector<DampedRoot> damped_roots(const FixedPhaseMesh& mesh, const Eigen::VectorXd& frequency);

// fit_decay() of a ring-down in which contact changed at so many steps: with a bound of the exponentials where it did.
Decay fit_ring_down(const Eigen::Ref<const Eigen::VectorXd>& samples, double step, double near,
                    int contact_changes);

// What the decay of a mode at a phase, and its eigenvalue, say of it; undamped_frequency is there.
void set_decay(const Decay& fit, int contact_changes, Eigen::Index phase, Eigen::Index mode,
               ImpactResult& out);
void set_root(const DampedRoot& root, Eigen::Index phase, Eigen::Index mode, ImpactResult& out);

}  // namespace whine
