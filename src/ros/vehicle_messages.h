#pragma once

#include <optional>
#include <string>

#include "simulated_messages.h"
#include "vehicle_simulation_options.h"

namespace suspension_health_monitor {

/// @return all topics of such a drive, each with an empty message: of every strut NAME/sprung/imu, NAME/unsprung/imu
/// and ~NAME/truth, of the body imu/data and ~truth, of every known force NAME/wrench.
MessagesOnTopics topicsOf(const VehicleSimulationOptions& options);

/// The simulated drive of a vehicle as messages.
class VehicleMessageSource : public DriveSource {
 public:
  /// @param start  stamp at the start of the drive.
  VehicleMessageSource(const VehicleSimulationOptions& options, Stamp start);

  std::optional<SimulatedInstant> next() override;

 private:
  void addImus(const VehicleInstant& sample, MessagesOnTopics& messages) const;
  void addTruth(const VehicleInstant& sample, MessagesOnTopics& messages) const;
  std_msgs::Header headerOf(Stamp stamp, const std::string& frame) const;

  VehicleSimulationOptions options_;
  VehicleSimulator simulator_;
  Stamp start_;
};

}  // namespace suspension_health_monitor
