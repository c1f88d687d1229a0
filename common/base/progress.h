// A progress line on a terminal. Where standard error is a file or a pipe a line a minute (of a computation that is over before
// then none), at every WHINE_PROGRESS_SECONDS of the environment instead.
#pragma once
#include <memory>
#include <string>
#include <utility>

namespace whine {

class Progress {
 public:
  // label: what is being done; total: number of steps, > 0.
  Progress(std::string label, long total);
  ~Progress();  // wipes the line, so that only the summary stays
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  // done: steps finished so far; note: a short text shown after the bar. Redraws at most ten times a second. The remaining
  // time assumes that all steps take as long as those so far; off a terminal it is printed first after five seconds, if it is more
  // than a minute.
  void update(long done, const std::string& note = "");

 private:
  std::string label_;
  long total_;
  bool shown_ = false, predicted_ = false;
  double began_, last_draw_;  // s, monotonic clock
};

// A step of a long computation, by the function that computes it; nothing happens unless a StepsShown or a Progress lives, to
// which it is a step inside the one that it shows. what: the steps in words, such as "mesh positions"; total: the most that
// there may be.
void report_step(const std::string& what, long done, long total);

// Shows reported steps as a Progress, while it lives. One at a time.
class StepsShown {
 public:
  explicit StepsShown(std::string label);
  ~StepsShown();
  StepsShown(const StepsShown&) = delete;
  StepsShown& operator=(const StepsShown&) = delete;

 private:
  friend void report_step(const std::string& what, long done, long total);
  std::string label_, what_;
  std::unique_ptr<Progress> progress_;
};

// Shows a computation that calls it after each step, from the first call on.
class StepsDone {
 public:
  explicit StepsDone(std::string label) : label_(std::move(label)) {}
  void operator()(long done, long total, const std::string& note = "") {
    if (!progress_) progress_ = std::make_shared<Progress>(label_, total);
    progress_->update(done, note);
  }

 private:
  std::string label_;
  std::shared_ptr<Progress> progress_;
};

}  // namespace whine
