#include "suspension_health_monitor/internal/signal/stream_silence.h"

#include <algorithm>
#include <utility>

namespace suspension_health_monitor {

StreamSilence::StreamSilence(std::size_t num_streams, Stamp timeout, Sink sink)
    : timeout_(timeout), sink_(std::move(sink)), last_(num_streams) {}

void StreamSilence::add(std::size_t stream, Stamp stamp) {
  if (stamp <= Stamp::zero()) return;
  if (!newest_ || stamp > *newest_ + timeout_ || stamp < *newest_ - timeout_) begin(stamp);
  if (sink_ && stamp - last_[stream] > timeout_) sink_({stream, last_[stream], stamp});
  last_[stream] = stamp;
  newest_ = std::max(*newest_, stamp);
}

void StreamSilence::finish() {
  if (sink_ && newest_)
    for (std::size_t i = 0; i < last_.size(); ++i)
      if (lasting(i) > Stamp::zero()) sink_({i, last_[i], *newest_});
  newest_.reset();
}

void StreamSilence::begin(Stamp stamp) {
  finish();
  std::fill(last_.begin(), last_.end(), stamp);
  newest_ = stamp;
}

Stamp StreamSilence::lasting(std::size_t stream) const {
  if (!newest_ || *newest_ - last_[stream] <= timeout_) return Stamp::zero();
  return *newest_ - last_[stream];
}

}  // namespace suspension_health_monitor
