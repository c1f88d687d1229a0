#include "io/sweep_words.h"

#include "base/error.h"
#include "base/format.h"
#include "signal/jump_words.h"

namespace whine {

static std::string in_words(const LevelChange& change) {
  return text(change.largest * 100, " % at most (", change.at, " Hz), ", change.rms * 100, " % RMS");
}

std::vector<std::string> change_words(const NextSweep& next, const SweepResult& here,
                                      const SweepResult& there) {
  const SweepChange change = sweep_change(here, there);
  const std::string level = text(next.key, " = \"", next.from, "\" against \"", next.to, "\"");
  return {text(level, " at ", change.compared, " speeds: RMS of the transmission error off by ",
               in_words(change.dte_rms), "; its mean by ", in_words(change.dte_mean), "; peak tooth load by ",
               in_words(change.tooth_load)),
          text(level, ": jumps ", jump_words(here.jump_frequency, here.jump_width), " against ",
               jump_words(there.jump_frequency, there.jump_width), "; on different branches at ",
               change.apart, " speeds, with other periods or none at ", change.uneven)};
}

std::string sweep_errors_words(const SweepErrorsResult& errors) {
  Eigen::Index speed = 0, mesh = 0;
  const double most = errors.dte_rms.error.maxCoeff(&speed, &mesh);
  return text(errors.direction, ", errors of the discretisation at ", errors.mesh_frequency.size(),
              " speeds: RMS ", shown(most * 100, 2), " % at most (", errors.mesh_frequency[speed],
              " Hz), peak tooth load ", shown(errors.tooth_load_max.error.maxCoeff() * 100, 2), " %, jumps ",
              errors.jump_error.size() > 0 ? shown(errors.jump_error.maxCoeff(), 2) + " Hz" : "none");
}

}  // namespace whine
