// The figures by name, and the artifacts that each is drawn from.
#pragma once
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "report/figures.h"
#include "report/printed_jumps.h"

namespace whine {

struct DrawnFrom {
  const std::vector<std::string>& inputs;       // paths
  const std::vector<double>& mesh_frequencies;  // Hz
  const PrintedJumps& printed;                  // what a publication states beside maps of jumps
};

struct Drawing {
  const char *shows, *inputs;
  std::function<Figure(const DrawnFrom&)> draw;
  size_t count = 0;        // of inputs; 0: any number
  size_t frequencies = 0;  // most mesh frequencies that it may be given; 0: none, else one is needed
};

const std::map<std::string, Drawing>& drawings();

// "crack, error-budget, ... , waterfall, "
std::string figure_names();

// Reads the artifacts and makes the figure, with the scenes that all of it shows. Throws Error(usage) for a name that is not
// known (`others`: what else the caller knows), and for too many or too few inputs or mesh frequencies.
Figure figure_of(const std::string& name, const std::vector<std::string>& inputs,
                 const std::vector<double>& mesh_frequencies, const std::string& others,
                 const PrintedJumps& printed = {});

}  // namespace whine
