// Teeth that differ, or of which one is cracked, in motion: transmission error over the hunting period, orders with sidebands, kurtosis.
#pragma once
#include "report/figures.h"
#include "results/response.h"
#include "results/sweep.h"

namespace whine {

// Of a pair or a train, of a train the mesh with the largest residual signal: at the speed at which that is largest transmission error and
// residual signal over the hunting period and their orders; over speed RMS and kurtosis of the residual signal. Error(input) unless both
// are of the same speeds and of teeth that differ or are cracked.
Figure residual_figure(const SweepResult& sweep, const ResponseResult& response);

}  // namespace whine
