#include "studies/sweep_response.h"

#include "signal/response.h"
#include "studies/sweep_losses.h"
#include "studies/sweep_pressure.h"

namespace whine {

ResponseResult sweep_response(const SweepResult& sweep) {
  ResponseResult out = response(sweep);
  out.friction = sweep.friction;
  if (sweep.of_train() || sweep.face_load_factor.size() > 0) return out;
  out.loss_factor = loss_factors(sweep);
  add_flank_pressure(sweep, out);
  return out;
}

}  // namespace whine
