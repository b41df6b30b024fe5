#pragma once

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "suspension_health_monitor/drive.h"

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
};

using Recordings = std::vector<Recording>;

}  // namespace suspension_health_monitor
