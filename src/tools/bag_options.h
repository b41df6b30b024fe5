#pragma once

#include <boost/program_options.hpp>
#include <optional>
#include <string>
#include <vector>

#include "../ros/shell_options.h"
#include "../ros/whole_file.h"
#include "healthy_strut.h"
#include "imu_bags.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

/// What every subcommand that reads bags understands.
struct BagOptions {
  ImuBags bags;
  PipelineOptions pipeline;
  bool period_measured = false;
  bool horizon_measured = false;
  std::optional<HealthyStrut> healthy = {};  ///< given beside the settings, to be judged by
};

/// Adds the common options to a subcommand's own.
void addBagOptions(boost::program_options::options_description& description);

/// @return how many processor cores may be used.
/// @throws std::invalid_argument  as command.h.
int threadsOf(const boost::program_options::variables_map& values);

/// @return the bags and the part of each that is to be read; no topics.
/// @throws std::invalid_argument  as command.h.
ImuBags readBags(const boost::program_options::variables_map& values);

/// @return the same with the static transforms, if a target_frame wants them.
/// @throws InputError  as readStaticTransforms().
ImuBags readBags(const boost::program_options::variables_map& values, const ShellOptions& options);

/// Collects the common options. What they leave open, sample_period and integration_horizon, stays open: a monitor
/// finds it out as it does live.
/// @throws std::invalid_argument, InputError, TooLittleError  as command.h.
BagOptions readLiveOptions(const boost::program_options::variables_map& values);

/// The same, with what they leave open measured from the bags.
/// @param clocks_may_differ  as measureOpenSettings().
/// @throws std::invalid_argument, InputError, TooLittleError  likewise.
BagOptions readBagOptions(const boost::program_options::variables_map& values, bool clocks_may_differ = false);

/// Takes the healthy strut of --baseline, if it is given, instead of that of the settings.
/// @throws std::invalid_argument  as readHealthy() and replaceBaseline().
void takeHealthy(const boost::program_options::variables_map& values, BagOptions& options);

/// Names of the options that addModelOptions() adds; their values are files that are read.
inline constexpr const char* kEffectsFile = "effects-file";
inline constexpr const char* kModel = "model";

/// What a model may be made of, and the model that the user brings.
struct ModelOptions {
  EffectLibrary library;
  std::optional<StrutModel> model;
};

void addModelOptions(boost::program_options::options_description& description);

/// @throws std::invalid_argument  naming the file and what is wrong in it.
ModelOptions readModelOptions(const boost::program_options::variables_map& values);

/// @return the catalogue and the laws of --effects-file.
EffectLibrary readEffects(const boost::program_options::variables_map& values);

/// Adds --effects-file alone.
void addEffectsFile(boost::program_options::options_description& description);

/// @return the file of an option, begun; nothing: it is not given. Where the file is called "-" it is standard output,
/// which has nothing else then: what is said to people goes to standard error from now on.
/// @throws std::runtime_error  naming the file, if it cannot be written.
std::optional<TextFile> outputFile(const boost::program_options::variables_map& values, const char* option);

/// Reads bags as drives, one each: both accelerations and what else the body's IMU measures.
/// @param gaps  is told of all that is read.
/// @throws InputError, TooLittleError  as readSamples().
std::vector<Drive> readDrives(const BagOptions& options, TopicGaps& gaps);

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
