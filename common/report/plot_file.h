// The data of a figure as a file for gnuplot that is on no disk.
#pragma once
#include <string>

#include "report/figures.h"

namespace whine {

// A file in memory with plot_data() of a figure. Programs that are started while it lives can read it at path(), any number of
// times. Throws Error(io) if the system gives none.
class PlotFile {
 public:
  explicit PlotFile(const Figure& figure);
  ~PlotFile();
  PlotFile(const PlotFile&) = delete;
  PlotFile& operator=(const PlotFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  int file_;
  std::string path_;
};

}  // namespace whine
