// What artifacts of systems in motion have in common: bodies, meshes, torques, damping, model levels, discretisation of time.
//
// Private to the layer io/.
#pragma once
#include <string>
#include <vector>

#include "io/layout_codec.h"
#include "results/motion_source.h"

namespace whine {

class Codec;

void describe_system(Codec& codec, SystemSweepParameters& settings, Eigen::VectorXd& torque,
                     const LayoutPlace& place = {});
// What pairs and trains in motion were computed from: /layout of a train, the parameters of two gears of a pair; `time`: its
// discretisation, too.
void describe_source(Codec& codec, MotionSource& source, bool time = true);
// /mesh and /body, the coordinates of the axes mesh and body: of a pair one mesh and two bodies, else those of the layout.
void describe_names(Codec& codec, bool of_train, std::vector<std::string>& meshes,
                    std::vector<std::string>& bodies);
// Load over the face in slices, (speed, mesh); left out of what has one slice.
void describe_face_load(Codec& codec, MatrixRM& load_factor, MatrixRM& line_load);

}  // namespace whine
