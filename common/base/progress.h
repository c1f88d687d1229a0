// A progress line on a terminal; silent when standard error is a file or a pipe.
#pragma once
#include <string>

namespace whine {

class Progress {
 public:
  // label: what is being done; total: number of steps, > 0.
  Progress(std::string label, long total);
  ~Progress();  // wipes the line, so that the summary stands alone
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // done: steps finished so far; note: a short text shown after the bar. Redraws at most ten times a second.
  void update(long done, const std::string& note = "");

 private:
  std::string label_;
  long total_;
  bool shown_ = false;
  double last_draw_ = -1.0;  // s, monotonic clock
};

}  // namespace whine
