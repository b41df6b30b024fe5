#pragma once

#include <array>

#include "suspension_health_monitor/internal/health/corner_comparison.h"
#include "suspension_health_monitor/internal/option_table.h"

namespace suspension_health_monitor {

/// Settings of CornersNodelet.
struct CornersOptions {
  double threshold = CornerComparisonOptions{}.threshold;
  double confirm_time = 1.0;
  double timeout = 2.0;

  /// @throws std::invalid_argument  naming an unknown name, or a value that is wrong and what is allowed.
  static CornersOptions fromValues(OptionMap values);
};

using CornersField = OptionField<CornersOptions>;
inline constexpr std::array kCornersFields{
    CornersField{"corners", "threshold", "-", "deviation of a corner from the others that counts",
                 &CornersOptions::threshold, 0.001, 0.9},
    CornersField{"corners", "confirm_time", "s", "new verdicts must last this long before they are reported",
                 &CornersOptions::confirm_time, 0.0, 3600.0},
    CornersField{"corners", "timeout", "s", "wall time after which a corner that has gone silent no longer counts",
                 &CornersOptions::timeout, 0.1, 3600.0},
};

inline CornersOptions CornersOptions::fromValues(OptionMap values) {
  CornersOptions options;
  takeOptions(values, kCornersFields, options);
  refuseUnknown(values, describeOptions(kCornersFields));
  return options;
}

}  // namespace suspension_health_monitor
