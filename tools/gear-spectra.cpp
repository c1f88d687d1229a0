// gear-spectra: what a speed sweep says, as numbers of a frequency response.
//
// Reads      sweep.h5 of a pair or a train: transmission error and loads over the last mesh period(s) of each speed
// Writes     response.h5    per speed, of each mesh and body: mean and RMS of the oscillating DTE, harmonics of the mesh
//                           frequency, largest loads, root stress and flank pressure, separations; the sweep's jumps
// Equations  x: transmission error of a mesh; mean = <x>, rms^2 = <(x - mean)^2>,
//            amplitude_k = 2 |<x exp(-2 pi i k f t)>|, over a whole number of periods
#include <cstdio>

#include "base/tool.h"
#include "io/artifacts.h"
#include "io/provenance.h"
#include "results/response.h"
#include "results/sweep.h"
#include "studies/sweep_response.h"

namespace {

void body(int argc, char** argv) {
  whine::Options options{"Mean, RMS, harmonics, loads and separations of a speed sweep", "gear-spectra"};
  std::string input, output;
  options.add("--input", input, "sweep.h5").required();
  options.add("--output", output, "response.h5 to write").required();
  options.footer(
      "Example:\n"
      "  gear-spectra --input out/parker2000/T150/up/sweep.h5 --output response.h5");
  options.parse(argc, argv);

  const whine::Provenance provenance = whine::made_by(argc, argv, {"sweep=" + input});
  const whine::ResponseResult result = whine::sweep_response(whine::read<whine::SweepResult>(input));
  whine::write(output, result, provenance);

  Eigen::Index peak = 0, mesh = 0;
  const double rms = result.dte_rms.maxCoeff(&peak, &mesh);
  char peak_words[64];
  std::snprintf(peak_words, sizeof peak_words, "%.3f µm at %.0f Hz", rms * 1e6, result.mesh_frequency[peak]);
  whine::log_line("gear-spectra: ", result.of_train() ? "" : whine::text(result.torque, " N m "),
                  result.direction, ", ", result.mesh_frequency.size(), " speeds, largest RMS ", peak_words,
                  result.of_mesh(mesh), ", ", result.jump_frequency.size(),
                  result.jump_frequency.size() == 1 ? " jump -> " : " jumps -> ", output);
}

}  // namespace

int main(int argc, char** argv) {
  return whine::run_tool(argc, argv, body);
}
