#include "base/progress.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>

namespace whine {
namespace {

double monotonic_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

Progress::Progress(std::string label, long total) : label_(std::move(label)), total_(std::max(total, 1L)) {}

Progress::~Progress() {
  if (shown_) std::fputs("\r\033[K", stderr);
}

void Progress::update(long done, const std::string& note) {
  static const bool terminal = isatty(STDERR_FILENO) != 0;
  if (!terminal) return;
  const double now = monotonic_seconds();
  if (shown_ && now - last_draw_ < 0.1) return;
  last_draw_ = now;
  shown_ = true;
  constexpr int kWidth = 30;
  done = std::clamp(done, 0L, total_);
  const int filled = static_cast<int>(kWidth * done / total_);
  const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
  std::fprintf(stderr, "\r\033[K%s [%s] %ld/%ld %s", label_.c_str(), bar.c_str(), done, total_, note.c_str());
  std::fflush(stderr);
}

}  // namespace whine
