// The figures by name, and the artifacts that each is drawn from.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "report/figures.h"
#include "report/printed_jumps.h"

namespace whine {

struct Drawing {
  const char* shows;
  const char* inputs;
  size_t count;        // of inputs; 0: any number
  size_t frequencies;  // most mesh frequencies (Hz) that it may be given; 0: none, else one is needed
  Figure (*draw)(const std::vector<std::string>& inputs, const std::vector<double>& mesh_frequencies);
  // In its place, of figures beside which a publication's statements can stand.
  Figure (*draw_beside)(const std::vector<std::string>& inputs, const PrintedJumps& printed) = nullptr;
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
