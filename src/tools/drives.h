#pragma once

#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/drive.h"

namespace suspension_health_monitor {

/// Reads bags as drives, one each: both accelerations and what else the body's IMU measures.
/// @throws InputError, TooLittleError  as readSamples().
std::vector<Drive> readDrives(const BagOptions& options);

/// Takes the settings of the command line over that the options of diagnose() and compare() share.
template <class Options>
void takeSettings(const BagOptions& bags, const ModelOptions& models, Options& options) {
  options.sample_period = bags.pipeline.monitor.sample_period;
  options.horizon_samples = MonitorSettings(bags.pipeline.monitor).horizonSamples(*options.sample_period);
  options.model = models.model;
}

/// @throws InputError, TooLittleError  in words for people, if a diagnosis or comparison has a shortcoming.
void requireEnough(Shortcoming shortcoming, const std::string& reason);

}  // namespace suspension_health_monitor
