#include "base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <utility>

namespace whine {
namespace {

double monotonic_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Between lines where there is no terminal; tests do not wait for a minute.
double line_seconds() {
  static const char* const set = std::getenv("WHINE_PROGRESS_SECONDS");
  static const double seconds = set ? std::atof(set) : 60;
  return seconds;
}

constexpr double kPredictAfter = 5;  // s

StepsShown* shown = nullptr;

// The Progress that lives, and what it was told last: steps that are reported go on from there.
struct Running {
  Progress* progress = nullptr;
  long done = 0;
  std::string note;
} running;

}  // namespace

Progress::Progress(std::string label, long total)
    : label_(std::move(label)), total_(std::max(total, 1L)), began_(monotonic_seconds()), last_draw_(began_) {
  running = {this, 0, ""};
}

Progress::~Progress() {
  if (running.progress == this) running = {};
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::update(long done, const std::string& note) {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  const double now = monotonic_seconds();
  done = std::clamp(done, 0L, total_);
  if (running.progress == this) running.done = done, running.note = note;
  if (!terminal) {
    const double spent = now - began_,
                 left = done > 0 ? spent * static_cast<double>(total_ - done) / static_cast<double>(done) : 0;
    const bool predicts = !predicted_ && spent > kPredictAfter && left > line_seconds();
    if (!predicts && now - last_draw_ < line_seconds()) return;
    predicted_ = true;
    last_draw_ = now;
    char times[96];
    if (done > 0)
      std::snprintf(times, sizeof times, "%.1f min, about %.*f min left", spent / 60, left < 600 ? 1 : 0,
                    left / 60);
    else
      std::snprintf(times, sizeof times, "%.1f min", spent / 60);
    std::fprintf(stderr, "%s: %ld of %ld after %s%s%s\n", label_.c_str(), done, total_, times,
                 note.empty() ? "" : "; ", note.c_str());
    std::fflush(stderr);
    return;
  }
  if (shown_ && now - last_draw_ < 0.1) return;
  last_draw_ = now;
  shown_ = true;
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(kWidth * done / total_);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %ld/%ld %s", label_.c_str(), bar.c_str(), done, total_, note.c_str());
  std::fflush(stderr);
}

StepsShown::StepsShown(std::string label) : label_(std::move(label)) {
  shown = this;
}

StepsShown::~StepsShown() {
  shown = nullptr;
}

namespace {

// A step inside the one that `running` shows: as its note, ten times a second at most, because millions are reported.
void report_inner_step(const std::string& what, long done, long total) {
  constexpr double kInterval = 0.1;  // s
  static double last = 0;            // s, monotonic clock
  const double now = monotonic_seconds();
  if (now - last < kInterval) return;
  last = now;
  const Running outer = running;
  running.progress->update(outer.done, outer.note + (outer.note.empty() ? "" : "; ") + what + " " +
                                           std::to_string(done) + " of at most " + std::to_string(total));
  running = outer;
}

}  // namespace

void report_step(const std::string& what, long done, long total) {
  if (!shown && running.progress) report_inner_step(what, done, total);
  if (!shown) return;
  if (!shown->progress_ || shown->what_ != what || done == 0) {
    shown->what_ = what;
    shown->progress_ = std::make_unique<Progress>(shown->label_ + ": " + what, total);
  }
  shown->progress_->update(done);
}

}  // namespace whine
