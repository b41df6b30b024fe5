#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/signal/readings.h"
#include "suspension_health_monitor/internal/vehicle/vehicle_grid.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What is called as bags are read as samples.
struct SampleSinks {
  std::function<bool(const VehicleSample&)> sample;  ///< returns false to stop
  /// Of a vehicle with one strut: what its body's IMU measures across the strut, in the order of the stamps.
  std::function<void(const BodyMotion&)> body = {};
  /// The grid begins to resample: the newest kSignalTuning.outcomes samples were badly paired.
  std::function<void()> take_back = {};
};

/// What came of reading samples.
struct ReadSamples {
  VehicleGrid grid;  ///< after the last reading: takes no more
  std::vector<RejectCounts>
      rejected;  ///< by VehicleStreams::sensors, without that of the road, wherever it was noticed
  std::vector<std::string> mount_faults;  ///< VehicleSensors::mountFaults()
};

/// Reads bags as samples of a vehicle: all sensors but that of the road on one grid, the strut tops known by their own
/// IMUs or by that of the body.
/// @param bags, layout  as findSensors().  @param options  with a sample_period.
/// @throws InputError, TooLittleError  as readTopics().
ReadSamples readSamples(const ImuBags& bags, const PipelineOptions& options, VehicleLayout layout,
                        const SampleSinks& take);

/// Bags, read as drives of a vehicle, one each.
struct RecordedDrives {
  /// By VehicleLayout::struts z'' at the strut's top and w'', by VehicleLayout::known_forces the forces.
  std::vector<VehicleDrive> drives;
  std::vector<ReadSamples> bags;  ///< what else is known of each
};

/// Reads bags as readSamples().
/// @param options  of readBagOptions(); positions become those in upright axes, if the body's IMU leans in the first
/// drive.
/// @param gaps  collects the gaps in all that is read.
RecordedDrives readDrives(BagOptions& options, TopicGaps& gaps);

/// Tells people what bags hold and which topics were silent.
void printBags(const BagOptions& options, const std::vector<ReadSamples>& bags, const TopicGaps& gaps);

/// Tells people the sample period.
void printPeriod(const BagOptions& options, double period);

/// Tells people what the readings became, and of which topics messages were kept out.
/// @param rejected  by topic, from the first on.
void printReadings(const VehicleGrid& grid, const ImuBags& bags, const std::vector<RejectCounts>& rejected);

/// What `compare` and `diagnose` begin with, on the command line and in Python.
struct AskedDrives {
  /// Reads the files of laws and models, then the beginnings of the bags.
  /// @throws std::invalid_argument, InputError, TooLittleError  as readModels() and readBagOptions().
  explicit AskedDrives(const po::variables_map& values);

  void read();

  EffectLibrary library;
  KnownModels models;
  BagOptions options;
  TopicGaps gaps;
  RecordedDrives recorded;  ///< empty before read()
};

/// @throws InputError, TooLittleError  in words for people, if a diagnosis or comparison has a shortcoming.
/// @param prefix  of the words.
void requireEnough(Shortcoming shortcoming, const std::string& reason, const std::string& prefix = "");

struct RecordedComparison {
  VehicleCoupling coupling;
  std::vector<Comparison> struts;  ///< by strut; empty where it is not asked for
};

/// Compares models as they are; of a strut without one the linear one, fitted.
/// @throws InputError, TooLittleError  if a strut that is asked for cannot be compared.
RecordedComparison compareBags(const AskedDrives& asked, const std::function<void(double)>& progress);

/// @param searching  what is the same for all struts; gets sample_period and candidates.
/// @return also if nothing can be said of some of them.
/// @throws InputError, TooLittleError  if nothing can be said of any strut that is asked for.
VehicleDiagnosis diagnoseBags(const AskedDrives& asked, DiagnoseOptions& searching);

/// @return by strut how it is against the healthy one, as identify says it; empty where none is known.
std::vector<std::string> changesOf(const AskedDrives& asked);

}  // namespace suspension_health_monitor
