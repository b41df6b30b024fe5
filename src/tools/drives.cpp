#include "drives.h"

#include <string>

#include "bag_samples.h"
#include "errors.h"

namespace suspension_health_monitor {

std::vector<Drive> readDrives(const BagOptions& options) {
  std::vector<Drive> drives;
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

StrutModel requireRoughModel(const std::vector<Drive>& drives, const MonitorOptions& options) {
  const StrutModel rough = roughModel(drives, options.filter(*options.sample_period));
  if (rough.damping_to_mass > 0.0 && rough.stiffness_to_mass > 0.0) return rough;
  throw TooLittleError("the drives show no damped spring (least squares: damping/mass " +
                       std::to_string(rough.damping_to_mass) + ", stiffness/mass " +
                       std::to_string(rough.stiffness_to_mass) + ")");
}

std::vector<const DriveRecord*> pointersTo(const std::deque<DriveRecord>& records) {
  std::vector<const DriveRecord*> pointers;
  for (const DriveRecord& record : records) pointers.push_back(&record);
  return pointers;
}

}  // namespace suspension_health_monitor
