#pragma once

#include <string>
#include <vector>

#include "input_task.h"
#include "message_pipeline.h"

namespace suspension_health_monitor {

/// The task Input of a vehicle: which sensor is silent, late, or has messages that were kept out, by its topic.
class VehicleInput : public InputTask {
 public:
  /// @param topics  by VehicleStreams::sensors.
  VehicleInput(const ShellOptions& options, const VehicleStreams& streams, const std::vector<std::string>& topics);

  void restart() override;

  /// @param pipeline  nullptr: the positions of the struts are not known yet, and `missing` says why.
  void describe(const MessagePipeline* pipeline, const std::string& missing, Status& status);

  /// The same of a strut's own sensors alone, for its task Input.
  void describeStrut(std::size_t strut, const MessagePipeline* pipeline, const std::string& missing, Status& status);

 private:
  using Told = std::vector<RejectHistory>;  // of messages that were kept out, by sensor

  void summarizeVehicle(const Sensors& sensors, const MessagePipeline* pipeline, const std::string& missing,
                        Status& status) const;
  void describeSensors(const Sensors& sensors, const MessagePipeline* pipeline, Told& told, Status& status);

  std::vector<Sensors> own_sensors_;  // by strut
  Told told_of_vehicle_, told_of_strut_;
};

}  // namespace suspension_health_monitor
