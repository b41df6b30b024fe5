#include "long_work.h"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "../ros/whole_file.h"

namespace suspension_health_monitor {
namespace {

volatile std::sig_atomic_t noted = 0;  // the signal; 0: none

extern "C" void noteSignal(int signal) {
  if (noted == 0) {
    noted = signal;
    return;
  }
  removeUnfinishedFiles();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

constexpr int kWidth = 40;

}  // namespace

Interruption::Interruption() {
  struct sigaction action {};
  action.sa_handler = noteSignal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    sigaction(kSignals[i], nullptr, &before_[i]);
    if (before_[i].sa_handler != SIG_IGN) sigaction(kSignals[i], &action, nullptr);
  }
}

Interruption::~Interruption() {
  for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &before_[i], nullptr);
}

void Interruption::check() {
  if (noted != 0) throw Interrupted{noted};
}

Progress::Progress(std::string label, double total)
    : label_(std::move(label)), total_(total), visible_(isatty(STDERR_FILENO) != 0 && total > 0.0) {}

Progress::~Progress() { clear(); }

void Progress::clear() {
  if (drawn_percent_ >= 0) std::fprintf(stderr, "\r\033[K");
  drawn_percent_ = -1;
}

void Progress::update(double done) {
  Interruption::check();
  if (!visible_) return;
  const int percent = static_cast<int>(100.0 * std::clamp(done / total_, 0.0, 1.0));
  if (percent == drawn_percent_) return;
  drawn_percent_ = percent;
  const std::string bar(static_cast<std::size_t>(percent * kWidth / 100), '#');
  std::fprintf(stderr, "\r%s [%-*s] %3d %%", label_.c_str(), kWidth, bar.c_str(), percent);
}

}  // namespace suspension_health_monitor
