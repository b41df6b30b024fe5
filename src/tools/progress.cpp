#include "progress.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr int kWidth = 40;

}  // namespace

Progress::Progress(std::string label, double total)
    : label_(std::move(label)), total_(total), visible_(isatty(STDERR_FILENO) != 0 && total > 0.0) {}

Progress::~Progress() {
  if (drawn_percent_ >= 0) std::fprintf(stderr, "\r\033[K");
}

void Progress::update(double done) {
  if (!visible_) return;
  const int percent = static_cast<int>(100.0 * std::clamp(done / total_, 0.0, 1.0));
  if (percent == drawn_percent_) return;
  drawn_percent_ = percent;
  const std::string bar(static_cast<std::size_t>(percent * kWidth / 100), '#');
  std::fprintf(stderr, "\r%s [%-*s] %3d %%", label_.c_str(), kWidth, bar.c_str(), percent);
}

}  // namespace suspension_health_monitor
