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

// What pairs and trains in motion were computed from: /layout, damping, model levels, of a pair the parameters of its gears; /mesh and
// /body; `time`: its discretisation, too.
void describe_source(Codec& codec, MotionSource& source, bool time = true);
// /mesh and /body, the coordinates of the axes mesh and body.
void describe_names(Codec& codec, std::vector<std::string>& meshes, std::vector<std::string>& bodies);
// Load over the face in slices, (speed, mesh); left out of what has one slice.
void describe_face_load(Codec& codec, MatrixRM& load_factor, MatrixRM& line_load);

}  // namespace whine
