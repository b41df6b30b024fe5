#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../ros/vehicle_options.h"
#include "command.h"
#include "imu_bags.h"
#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {

inline constexpr const char* kVehicle = "vehicle";  ///< names of options
inline constexpr const char* kStrut = "strut";

/// The struts that a command is asked about: those of --vehicle, or the one of the topics, which is alone and has no
/// name.
struct AskedVehicle {
  VehicleLayout layout;
  std::string file;                 ///< of --vehicle; empty: a strut alone
  std::vector<std::string> names;   ///< of the struts
  std::vector<std::size_t> asked;   ///< their places
  std::optional<std::size_t> only;  ///< place of the strut of --strut, or of the one that is alone

  bool isStrutAlone() const { return file.empty(); }

  /// @return what is written before a strut; nothing where it is alone.
  std::string prefix(std::size_t strut, const char* after) const { return isStrutAlone() ? "" : names[strut] + after; }

  /// @return where a strut's results are among those of the command.
  json& resultsOf(std::size_t strut, json& whole) const {
    return isStrutAlone() ? whole : whole["struts"][names[strut]];
  }
};

/// @throws std::invalid_argument  as readVehicleFile(), for topics beside a vehicle or twice the same, and for a strut
/// that is none of it.
AskedVehicle readVehicle(const po::variables_map& values);

/// Finds the sensors of a vehicle in bags.
/// @param bags  whose topics become those of VehicleStreams::sensors.
/// @param layout  whose struts with a frame get their position, by the static transforms of the bags.
/// @throws InputError, TooLittleError  as readTopics().
/// @throws std::invalid_argument  if a frame has no static transform.
void findSensors(ImuBags& bags, const ShellOptions& options, VehicleLayout& layout);

/// What every subcommand that reads bags understands.
struct BagOptions {
  AskedVehicle vehicle;
  VehicleOptions settings;
  ImuBags bags;  ///< as findSensors()
  bool period_measured = false, horizon_measured = false;
  std::optional<double> clock_offset;        ///< by which the body's clock seems to be late [s], of readBagOptions()
  std::optional<MotionRange> one_frequency;  ///< likewise, if all motion is at one

  double period() const { return *settings.common.monitor.sample_period; }  ///< [s], of readBagOptions()
};

/// Adds the bags, the part of each that is to be read, and --json to a subcommand's options.
void addBags(po::options_description& description);

/// @return what addBags() has asked for, without topics.
/// @throws std::invalid_argument  for a part that ends before it begins.
ImuBags bagsOf(const po::variables_map& values);

/// @return these and the other common options, for a subcommand to add its own to.
po::options_description bagOptions();

/// Runs a subcommand that reads bags: parses its arguments, refuses to write into a file that is read, and begins work,
/// which a signal interrupts. With -h among the arguments it shows the help only.
/// @throws  as Command::run().
/// @param usage, options  as parse().  @param outputs  as requireSeparateFiles().
void runOnBags(const Arguments& arguments, const std::string& usage, const po::options_description& options,
               const std::vector<std::string>& outputs, void (*work)(const po::variables_map& values));

/// @return how many processor cores may be used.
/// @throws std::invalid_argument  as command.h.
int threadsOf(const po::variables_map& values);

/// @return the mean spacing of the stamps at the beginning of the bags, of the slowest topic that is needed [s].
/// @throws InputError  as readTopics(), or it is no sample_period.  @throws TooLittleError  if there are too few
/// messages.
double measurePeriod(const ImuBags& bags);

/// @throws std::invalid_argument  if sample_period is so far below the spacing of the stamps at the beginning of the
/// bags that nearly all samples would be made up. Bags whose stamps tell no spacing are left to what reads them.
void requireFittingPeriod(const ImuBags& bags, double sample_period);

/// @return the settings that --config and --set give. The models that diagnose -o writes are a config, too: their
/// effects by model_file, their b1 and b0 as nominal values.
/// @throws std::invalid_argument  as command.h.
OptionMap givenSettings(const po::variables_map& values);

/// Collects the common options. What they leave open, sample_period and integration_horizon, stays open: a monitor
/// finds it out as it does live.
/// @throws std::invalid_argument, InputError, TooLittleError  as command.h, readVehicle(), findSensors() and
/// requireFittingPeriod().
BagOptions readLiveOptions(const po::variables_map& values);

/// The same, with what they leave open measured from the bags: sample_period by measurePeriod(), the horizon of a strut
/// alone by what blocks tell of it, if they do.
/// @throws std::invalid_argument, InputError, TooLittleError  likewise, also if there are too few messages to tell.
BagOptions readBagOptions(const po::variables_map& values);

/// Names of the options that addModelOptions() adds; their values are files, as readEffectsFile() and readModels() read
/// them.
inline constexpr const char* kEffectsFile = "effects-file";
inline constexpr const char* kModel = "model";

inline constexpr const char* kAgainst = "against";  ///< name of an option

void addModelOptions(po::options_description& description);

/// Adds --effects-file alone.
void addEffectsFile(po::options_description& description);

}  // namespace suspension_health_monitor
