// Load over the face of one mesh in slices at rest, position after position.
#pragma once
#include <vector>

#include "results/static.h"
#include "system/face_contact.h"
#include "system/face_root_stress.h"

namespace whine {

class FaceRecord {
 public:
  // contact is kept by reference.
  explicit FaceRecord(const FaceContact& contact);
  // Position `row`; force: (point) N; compliance: (point, point) m N-1, of all but the laws.
  void take(Eigen::Index row, const FaceMesh& mesh, const std::vector<HertzLine>& law,
            const Eigen::Ref<const Eigen::VectorXd>& force,
            const Eigen::Ref<const Eigen::MatrixXd>& compliance);
  // Positions are taken again from the first one on.
  void restart() { *this = FaceRecord(*contact_); }
  // Fills `face` but for the load factor and errors, loss factor and root stresses of a result with its torque, pairs and phases. Throws
  // Error(numerical) where the compliance is not positive definite.
  void finish(StaticResult& result) const;

 private:
  struct Row {
    FacePoints points;
    Eigen::VectorXd force;                // (point) N
    std::array<Eigen::MatrixXd, 2> load;  // [gear] (functional, line) of the roots
  };
  void finish_roots(StaticResult& result) const;
  const FaceContact* contact_;
  FaceRootStresses roots_;
  std::vector<Row> rows_;
  FaceLoad face_;
  double lost_ = 0;  // N m rad-1, over all positions
};

// K_Hbeta of the pair nearest to the pitch point; 0 where nothing touches.
double load_factor(const FaceContact& contact, const FacePoints& points, double phase,
                   const Eigen::Ref<const Eigen::VectorXd>& force);

}  // namespace whine
