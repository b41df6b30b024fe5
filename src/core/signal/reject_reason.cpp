#include "suspension_health_monitor/internal/signal/reject_reason.h"

#include <numeric>

namespace suspension_health_monitor {

std::uint64_t RejectCounts::total() const { return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0}); }

std::map<std::string, std::uint64_t> RejectCounts::byName() const {
  std::map<std::string, std::uint64_t> counts;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if (counts_[i] > 0) counts[std::string(kRejectReasonNames[i])] = counts_[i];
  return counts;
}

RejectCounts& RejectCounts::operator+=(const RejectCounts& other) {
  for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += other.counts_[i];
  return *this;
}

}  // namespace suspension_health_monitor
