// The panels of one set of choices in response_figure(): curves of both directions, jumps, orbits beside them, contact loss, key.
#pragma once
#include <string>
#include <vector>

#include "model/scene.h"
#include "report/figures.h"

namespace whine {

struct ResponsePanels {
  Panel rms, mean;                       // over the same speeds
  std::vector<std::string> names;        // of its curves: how their blocks begin
  std::vector<std::string> errors = {};  // blocks of discretisation errors
  int stride = 1;                        // between marks: of neighbours they would run into each other
  double peak = 0;                       // µm, of the RMS
  bool alone = true, lost = false, beyond = false, jumps = false, branches = false;
};

// Axes and headings; curves: how many; speeds: of a sweep; tall: a picture of its own.
ResponsePanels empty_panels(size_t curves, Eigen::Index speeds, bool tall);

// The last of p.names, in both panels. with_branch: its blocks of orbits and folds are there, too.
void draw_response(bool with_branch, ResponsePanels& p);

// When all curves are drawn: speeds at which the teeth part, in a strip below 0; what marks and lines mean; f_n and its fractions, where
// superharmonic resonances stand. labels, natural_frequency (Hz): of each curve.
void finish(const std::vector<std::string>& labels, const std::vector<double>& natural_frequency,
            ResponsePanels& p);

}  // namespace whine
