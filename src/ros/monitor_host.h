#pragma once

#include <string>
#include <vector>

#include "message_pipeline.h"
#include "monitor_thread.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

class InputTask;

/// What a live search works on.
struct SearchTask {
  VehicleDrive drive;
  std::vector<std::string> struts;  ///< names; that of a strut alone is empty
  DiagnoseOptions options;
};

/// The nodelet as its parts see it, once it has started. All is called in the thread that serves it; parts with a
/// thread of their own ask for thread() when they are made.
class MonitorHost {
 public:
  virtual ~MonitorHost() = default;
  virtual MonitorThread& thread() = 0;                              ///< that serves it
  virtual MessagePipeline* pipeline() = 0;                          ///< nullptr: none yet
  virtual std::string whyNoMonitor() = 0;                           ///< why the struts have no monitors
  virtual InputTask& input() = 0;                                   ///< what comes in
  virtual const std::string& frameOf(std::size_t strut) const = 0;  ///< frame_id of its body's IMU

  /// @param window  [s] as asked for, 0: all that is kept.
  /// @return the newest samples, to be searched.
  /// @throws std::exception  whose words are the answer: a wrong window, or there is nothing yet.
  virtual SearchTask samplesFor(double window) = 0;

  virtual void takeDiagnosis(const VehicleDiagnosis& found) = 0;
  virtual std::string reset() = 0;  ///< @return what it has done, in words

  /// @return the monitor of a strut; nullptr: there is none yet.
  const SuspensionMonitor* monitor(std::size_t strut) {
    return pipeline() != nullptr ? pipeline()->strut(strut) : nullptr;
  }
};

}  // namespace suspension_health_monitor
