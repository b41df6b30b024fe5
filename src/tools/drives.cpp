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
    Drive& drive = drives.emplace_back();
    const auto take = [&](const CornerSample& sample) {
      drive.samples.push_back(sample);
      return true;
    };
    readSamples(bag, options.pipeline, take, [&](const BodyMotion& motion) { drive.body.push_back(motion); });
  }
  return drives;
}

void requireEnough(Shortcoming shortcoming, const std::string& reason) {
  if (shortcoming == Shortcoming::kModelUntestable) throw InputError("the drives " + reason);
  if (shortcoming != Shortcoming::kNone) throw TooLittleError("the drives " + reason);
}

}  // namespace suspension_health_monitor
