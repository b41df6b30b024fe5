#pragma once

#include <functional>
#include <string>
#include <vector>

#include "recorded_drives.h"
#include "strut_files.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// What `compare` and `diagnose` begin with, on the command line and in Python.
struct AskedDrives {
  /// Reads the files of laws and models, then the beginnings of the bags.
  /// @throws std::invalid_argument, InputError, TooLittleError  as readModels() and readBagOptions().
  explicit AskedDrives(const boost::program_options::variables_map& values);

  /// Reads the bags.
  void read();

  EffectLibrary library;
  KnownModels models;
  BagOptions options;
  TopicGaps gaps;
  std::vector<VehicleBag> bags;      ///< without their drives, which are:
  std::vector<VehicleDrive> drives;  ///< one each
};

/// @throws InputError, TooLittleError  in words for people, if a diagnosis or comparison has a shortcoming.
/// @param prefix  of the words.
void requireEnough(Shortcoming shortcoming, const std::string& reason, const std::string& prefix = "");

struct RecordedComparison {
  VehicleCoupling coupling;
  std::vector<Comparison> struts;  ///< by AskedVehicle::asked
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
