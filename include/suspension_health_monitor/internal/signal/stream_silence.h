#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"

namespace suspension_health_monitor {

/// Which of several streams are silent while others go on, and from when on.
///
/// Time passes with the newest stamp of any stream. One that does not come for longer than the time-out is silent from
/// its last reading on, or from the first one of any other. Where the newest stamp jumps by more than the time-out,
/// back or forth, all begin anew: between two recordings, or where nothing was recorded, all were silent or none was.
/// Cost per reading: O(1), where time jumps O(streams); no allocation.
class StreamSilence {
 public:
  struct Silence {
    std::size_t stream;
    Stamp from, to;  ///< stamps
  };
  using Sink = std::function<void(const Silence&)>;

  /// @param names  one for each stream.
  /// @param timeout  the longest pause between two readings that is none.
  /// @param sink  called with every silence that has ended.
  StreamSilence(const std::vector<std::string>& names, Stamp timeout, Sink sink = {});

  /// Takes in the stamp of a reading, whether or not it is accepted; one that is not above 0 is none.
  void add(std::size_t stream, Stamp stamp);

  /// The recording ends, and with it every silence.
  void finish();

  /// @return how long a stream has been silent by now; 0 if it is not.
  Stamp lasting(std::size_t stream) const;

  /// Silences that have ended count no more.
  void forget() { was_silent_.assign(names_.size(), false); }

  /// @return names of those that are silent now.
  std::vector<std::string> now() const { return namesOf(false); }

  /// @return also those whose silence has ended since forget() by a reading of theirs or by finish().
  std::vector<std::string> ofLate() const { return namesOf(true); }

 private:
  bool isSilent(std::size_t stream) const { return lasting(stream) > Stamp::zero(); }
  void end();
  std::vector<std::string> namesOf(bool with_past) const;

  std::vector<std::string> names_;
  Stamp timeout_;
  Sink sink_;
  std::vector<Stamp> last_;       // stamp of each stream's last reading since all began anew, or that of the first one
  std::optional<Stamp> newest_;   // of any
  std::vector<bool> was_silent_;  // by stream
};

}  // namespace suspension_health_monitor
