#include "suspension_health_monitor/internal/signal/stream_silence.h"

#include <algorithm>
#include <utility>

namespace suspension_health_monitor {

StreamSilence::StreamSilence(const std::vector<std::string>& names, Stamp timeout, Sink sink)
    : names_(names), timeout_(timeout), sink_(std::move(sink)), last_(names.size()), was_silent_(names.size()) {}

void StreamSilence::add(std::size_t stream, Stamp stamp) {
  if (stamp <= Stamp::zero()) return;
  if (isSilent(stream)) was_silent_[stream] = true;
  if (!newest_ || stamp > *newest_ + timeout_ || stamp < *newest_ - timeout_) {
    end();
    std::fill(last_.begin(), last_.end(), stamp);
    newest_ = stamp;
  }
  if (sink_ && stamp - last_[stream] > timeout_) sink_({stream, last_[stream], stamp});
  last_[stream] = stamp;
  newest_ = std::max(*newest_, stamp);
}

void StreamSilence::finish() {
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (isSilent(i)) was_silent_[i] = true;
  end();
}

void StreamSilence::end() {
  if (sink_ && newest_)
    for (std::size_t i = 0; i < last_.size(); ++i)
      if (isSilent(i)) sink_({i, last_[i], *newest_});
  newest_.reset();
}

Stamp StreamSilence::lasting(std::size_t stream) const {
  if (!newest_ || *newest_ - last_[stream] <= timeout_) return Stamp::zero();
  return *newest_ - last_[stream];
}

std::vector<std::string> StreamSilence::namesOf(bool with_past) const {
  std::vector<std::string> silent;
  for (std::size_t i = 0; i < names_.size(); ++i)
    if (isSilent(i) || (with_past && was_silent_[i])) silent.push_back(names_[i]);
  return silent;
}

}  // namespace suspension_health_monitor
