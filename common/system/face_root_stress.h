// Stress at the roots over the face of a mesh of bodies in three dimensions, beside the loaded flanks.
//
//   sigma_q(s, z) = sum over the contact lines p of P_i(z) T_ij(j_q - j_p; s, xi) f_pj,   f_pj = sum over the points of p of F P_j(z)
// s along the root, z over the gear's own face, j_p the tooth of the gear in the pair of line p, T the tables over the width: the stress
// across the helix (solid/root_stress.h), largest along s at each z. The largest of all z is that of the inner 90 % of the face: at its
// very ends, where a line of contact comes in, the load of a line model has no limit.
#pragma once
#include <array>
#include <vector>

#include "system/face_contact.h"
#include "system/face_mesh.h"
#include "system/root_stress.h"

namespace whine {

// Places over the face at which stresses are read, even from one end to the other.
inline constexpr int kFaceStations = 41;

struct RootOverFace {
  Eigen::VectorXd stress;  // (station) Pa: largest along the root, tension positive
  RootStress most;         // largest of these in the inner 90 % of the face
};

class FaceRootStresses {
 public:
  // contact is kept by reference.
  explicit FaceRootStresses(const FaceContact& contact);
  // False in slices, which do not hold each other, and of bodies without such tables; then nothing else may be asked.
  bool known() const { return known_; }
  // (station) m, of gear g from the middle of the common face.
  Eigen::VectorXd position(size_t g) const;
  // [gear] (functional, line) N m^-1/2: what the forces (point) N load the tables with.
  std::array<Eigen::MatrixXd, 2> loads(const FaceMesh& mesh,
                                       const Eigen::Ref<const Eigen::VectorXd>& force) const;
  // Of the tooth of gear g in pair `of`. load: (functional, line) of this gear.
  RootOverFace of_tooth(size_t g, int of, const std::vector<ContactLine>& line,
                        const Eigen::MatrixXd& load) const;
  // 1: K_Fbeta, the largest over the mean on the common face.
  double load_factor(size_t g, const RootOverFace& tooth) const;

 private:
  const FaceContact* contact_;
  std::array<Eigen::MatrixXd, 2> polynomials_;  // [gear] (polynomial, station) m^-1/2
  bool known_;
};

}  // namespace whine
