#include "interruption.h"

namespace suspension_health_monitor {
namespace {

volatile std::sig_atomic_t noted = 0;  // the signal; 0: none

extern "C" void noteSignal(int signal) { noted = signal; }

}  // namespace

int Interrupted::endProgram() const {
  constexpr int kShellOffset = 128;
  std::signal(signal, SIG_DFL);
  std::raise(signal);
  return kShellOffset + signal;
}

Interruption::Interruption() {
  struct sigaction action {};
  action.sa_handler = noteSignal;
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
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

}  // namespace suspension_health_monitor
