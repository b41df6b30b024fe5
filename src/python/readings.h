#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "long_work.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/internal/monitor/monitor_settings.h"

namespace suspension_health_monitor {

/// One sensor of a recording, arrays of equal length, which the wrapper in Python has checked: rising stamps [ns] and
/// what it reads along the strut [m/s^2].
using ReadingStream = std::pair<py::array_t<std::int64_t>, py::array_t<double>>;

/// Arrays of one drive. To be made and destroyed with the interpreter's lock; read without.
struct Recording {
  std::vector<ReadingStream> streams;  ///< by Side: of body, wheel carrier and, if there is one, the road

  /// a_x, a_y [m/s^2], w_x, w_y [rad/s] of the body's IMU, in the strut's frame, at the body's stamps.
  std::optional<py::array_t<double>> across;

  /// Calls take(side, stamp, value) with all readings in the order of their stamps; at the same time the body's first.
  template <class Take>
  void forEach(const Take& take) const {
    struct Cursor {
      const std::int64_t* stamp;
      const double* value;
      const std::int64_t* end;

      bool isAtEnd() const { return stamp == end; }
    };
    std::vector<Cursor> cursors;
    for (const auto& [stamps, values] : streams)
      cursors.push_back({stamps.data(), values.data(), stamps.data() + stamps.size()});
    while (true) {
      const auto next = std::min_element(cursors.begin(), cursors.end(), [](const Cursor& a, const Cursor& b) {
        return !a.isAtEnd() && (b.isAtEnd() || *a.stamp < *b.stamp);
      });
      if (next == cursors.end() || next->isAtEnd()) return;
      take(static_cast<Side>(next - cursors.begin()), Stamp(*next->stamp++), *next->value++);
    }
  }

  /// @return what the body's IMU measures across the strut; empty: nothing.
  std::vector<BodyMotion> bodyMotion(Stamp shift) const;
};

using Recordings = std::vector<Recording>;

/// @return readings of all.
std::size_t sizeOf(const Recordings& recordings);

/// @return what is to be added to all stamps so that none is 0 or less: stamp 0 means that a driver has set none.
Stamp shiftOf(const Recordings& recordings);

/// @throws std::invalid_argument  if a sample_period is given that is far below the spacing of the stamps.
void requireFittingPeriod(const Recordings& recordings, const MonitorOptions& options);

/// @return T [s]: as it was given, or the mean spacing of the stamps.
/// @throws std::invalid_argument  as requireFittingPeriod(), or if there are too few stamps to tell.
double periodOf(const Recordings& recordings, const MonitorOptions& options);

/// Calls take(side, stamp + shift, value) with every reading and finish() after every recording, and tells how much is
/// done.
template <class Take, class Finish>
void forEachReading(const Recordings& recordings, Stamp shift, LongWork& work, const Take& take, const Finish& finish) {
  const auto all = static_cast<double>(sizeOf(recordings));
  double done = 0.0;
  for (const Recording& recording : recordings) {
    recording.forEach([&](Side side, Stamp stamp, double value) {
      take(side, stamp + shift, value);
      work.step(++done / all);
    });
    finish();
  }
}

/// @return the samples of a strut, one drive for each recording, aligned as the live monitor aligns them.
std::vector<Drive> toDrives(const Recordings& recordings, const MonitorOptions& options, double period, Stamp shift,
                            LongWork& work);

/// @param judge  makes a result of drives and options: compare() or diagnose().
/// @param judging  its options, all but those that are given here.
/// @return the result.
/// @throws std::invalid_argument  as periodOf(), or saying why there is none.
template <class Judge, class Options>
auto judgeArrays(const Judge& judge, const Recordings& recordings, const MonitorOptions& options, Options judging,
                 LongWork& work) {
  const double period = periodOf(recordings, options);
  judging.sample_period = period;
  if (options.integration_horizon) judging.horizon_samples = MonitorSettings(options).horizonSamples(period);
  judging.progress = work.callback();
  auto result = judge(toDrives(recordings, options, period, shiftOf(recordings), work), judging);
  if (!result) throw std::invalid_argument("the drives " + result.reason);
  return result;
}

}  // namespace suspension_health_monitor
