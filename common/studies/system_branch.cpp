#include "studies/system_branch.h"

#include <numbers>
#include <vector>

#include "base/error.h"
#include "dynamics/dynamics.h"
#include "studies/branch_rows.h"
#include "studies/train_statistics.h"

namespace whine {

using Eigen::Index;
using Eigen::VectorXd;

SystemBranchResult system_branch(const SystemSweepParameters& settings,
                                 const std::vector<ReducedBody>& bodies,
                                 const std::function<void(long, long, const std::string&)>& report,
                                 const BranchPlan& plan) {
  require_like_teeth(settings, "a branch of a system");
  require_relaxation_range(settings.damping, settings.fidelity.body, settings.frequency_to);
  TrainRig rig(settings, bodies);
  const size_t meshes = rig.train().system().mesh.size(), all = settings.layout.bodies.size();
  BranchFollower<TrainRig> follower(rig, speeds_of(settings));
  TrainStatistics statistics;
  // Of an orbit, for each mesh and then each body: the columns of the artifact, one after the other.
  follower.measure([&](const SystemDynamics::Period& period, int number, int /*periods*/) {
    if (number == 0) statistics.clear();
    statistics.take(period);
    VectorXd out(static_cast<Index>(5 * meshes + all));
    out << statistics.dte_rms(), statistics.dte_mean(), statistics.mesh_force_max(),
        statistics.tooth_load_max(), statistics.separation_fraction(), statistics.bearing_force_rms();
    return out;
  });
  const auto& segments = follower.follow(plan, report);

  SystemBranchResult a;
  a.settings = rig.train().used();
  a.torque.setZero(static_cast<Index>(all));
  for (size_t b = 0; b < all; ++b)
    a.torque[static_cast<Index>(b)] = settings.layout.torque(static_cast<int>(b));
  a.axis_frequency = rig.train().motion().axis_frequency / (2 * std::numbers::pi);
  const Index points = points_of(segments), columns = static_cast<Index>(meshes);
  const std::array of_mesh{&a.dte_rms, &a.dte_mean, &a.mesh_force_max, &a.tooth_force_max,
                           &a.separation_fraction};
  for (MatrixRM* x : of_mesh) x->resize(points, columns);
  a.bearing_force_rms.resize(points, static_cast<Index>(all));
  const auto point = [&](Index i, const BranchPosition& p, int /*multiple*/) {
    Index at = 0;
    for (MatrixRM* x : of_mesh) {
      x->row(i) = p.peaks.segment(at, columns).transpose();
      at += columns;
    }
    a.bearing_force_rms.row(i) = p.peaks.tail(p.peaks.size() - at).transpose();
  };
  std::vector<int> mesh, pair;
  fill_branch(
      segments, follower.mismatch(), point, [](Index, const BranchPlace&) {},
      [&](int of_mesh, int of_pair) {
        mesh.push_back(of_mesh);
        pair.push_back(of_pair);
      },
      a);
  a.grazing_mesh = Eigen::Map<const Eigen::VectorXi>(mesh.data(), static_cast<Index>(mesh.size()));
  a.grazing_pair = Eigen::Map<const Eigen::VectorXi>(pair.data(), static_cast<Index>(pair.size()));
  return a;
}

}  // namespace whine
