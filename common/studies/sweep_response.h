// What a sweep says: response() of signal/response.h with losses, flank pressures and friction. The content of response.h5.
#pragma once
#include "results/response.h"
#include "results/sweep.h"

namespace whine {

// Throws as response() does. Of lumped models, trains and pairs in slices without loss factors and pressures.
ResponseResult sweep_response(const SweepResult& sweep);

}  // namespace whine
