#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/corner_sample.h"

namespace suspension_health_monitor {

/// The sampling time of several streams, measured from their stamps, of the slowest one: the mean of all spacings
/// within half and one and a half times their median. The median passes over gaps and clocks that jump, as long as they
/// are the minority; the mean takes the jitter of n stamps down to 1/n of it. Streams that are not required have no
/// say.
class PeriodMeasurement {
 public:
  /// Of a strut's streams, numbered by Side.
  static inline const std::vector<bool> kOfOneStrut{true, true, false};

  static constexpr std::size_t kFewestOfRecording = 10;  ///< spacings that tell the period of something recorded

  /// @param spacings_wanted  of each required stream before a period is given, >= 1.
  /// @param is_required  by stream; one at least.
  explicit PeriodMeasurement(std::size_t spacings_wanted, const std::vector<bool>& is_required = kOfOneStrut)
      : spacings_wanted_(spacings_wanted), is_required_(is_required), streams_(is_required.size()) {}

  /// @return false if the stamp is the same as the one before: it tells nothing.
  bool add(std::size_t stream, Stamp stamp);
  bool add(Side side, Stamp stamp) { return add(indexOf(side), stamp); }

  /// @return true if the stamp is older than the one before of its stream.
  bool goesBack(std::size_t stream, Stamp stamp) const {
    const std::optional<Stamp>& last = streams_[stream].last;
    return last && stamp < *last;
  }
  bool goesBack(Side side, Stamp stamp) const { return goesBack(indexOf(side), stamp); }

  /// @return the sampling time [s], nothing until all required streams have shown enough spacings.
  std::optional<double> period() const;

 private:
  struct Stream {
    std::optional<Stamp> last;
    std::vector<Stamp> spacings;
  };

  std::size_t spacings_wanted_;
  std::vector<bool> is_required_;
  std::vector<Stream> streams_;
};

}  // namespace suspension_health_monitor
