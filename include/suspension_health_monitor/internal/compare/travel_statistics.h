#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/record/drive_record.h"

namespace suspension_health_monitor {

/// How long a quantity had which value, as telemetry of suspensions shows it. Positive: compression; negative: rebound.
struct TimeHistogram {
  /// Of the values of one sign; magnitudes.
  struct Direction {
    double share = 0.0;  ///< of the time [-]
    double mean = 0.0, largest = 0.0;
  };

  std::vector<double> edges;   ///< ascending, evenly spaced, one of them 0
  std::vector<double> shares;  ///< of the time, by bin [-]
  Direction compression, rebound;
};

/// How a stop is used.
struct StopUse {
  std::string effect;  ///< bump_stop or rebound_stop
  double gap = 0.0;    ///< of the model [m]
  double near = 0.0;   ///< share of the time in the last tenth of the gap or beyond it [-]
  int hits = 0;        ///< times that the gap was passed, each after leaving that tenth
};

struct TravelStatistics {
  TimeHistogram travel, travel_rate;  ///< [m], [m/s]; empty: the drives are too short, or the model runs away
  std::vector<StopUse> stops;         ///< those of the model, whose gaps are known
};

/// Statistics of the model's free run: travel counts from where the strut rests.
/// @param drives, model, sample_period  as strutCurves().
TravelStatistics travelStatistics(const std::vector<Drive>& drives, const StrutModel& model,
                                  const std::optional<double>& sample_period);

/// The same of drives that are prepared already.
TravelStatistics travelStatistics(const Records& records, const StrutModel& model);

}  // namespace suspension_health_monitor
