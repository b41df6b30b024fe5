#include "drives.h"

#include <string>
#include <vector>

#include "bag_samples.h"
#include "errors.h"

namespace suspension_health_monitor {
namespace {

/// All samples of each bag.
std::vector<DriveSamples> readBags(const BagOptions& options) {
  std::vector<DriveSamples> drives;
  for (const std::string& path : options.bags.paths) {
    ImuBags bag = options.bags;
    bag.paths = {path};
    drives.emplace_back();
    readSamples(bag, options.pipeline, [&](const CornerSample& sample) {
      drives.back().push_back(sample);
      return true;
    });
  }
  return drives;
}

StrutModel roughStrut(const std::vector<DriveSamples>& drives, const MonitorOptions& options) {
  StrutModel rough = roughModel(drives, options);
  if (!isDampedSpring(rough))
    throw TooLittleError("the drives show no damped spring (least squares: damping/mass " +
                         std::to_string(rough.damping_to_mass) + ", stiffness/mass " +
                         std::to_string(rough.stiffness_to_mass) + ")");
  return rough;
}

}  // namespace

BagDrives readDrives(const BagOptions& options, const std::optional<StrutModel>& model) {
  const std::vector<DriveSamples> samples = readBags(options);
  const MonitorOptions& monitor = options.pipeline.monitor;
  StrutModel start = model ? *model : roughStrut(samples, monitor);
  std::deque<DriveRecord> records = makeRecords(samples, *monitor.sample_period, start);
  return {std::move(start), std::move(records)};
}

}  // namespace suspension_health_monitor
