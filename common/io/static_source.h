// What static.h5 was computed from: /layout and [[mesh]] of a train, the parameters of two gears of a pair.
//
// Private to the layer io/.
#pragma once
#include "results/static.h"

namespace whine {

class Codec;

// Of a pair the drawings of its mesh and the torque; a reader of a train rejects bodies without their drawing.
void describe_static_source(Codec& codec, SystemStaticResult& a);

}  // namespace whine
