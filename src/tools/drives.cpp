#include "drives.h"

#include <string>
#include <vector>

#include "bag_samples.h"
#include "errors.h"
#include "suspension_health_monitor/discrepancy/body_motion.h"

namespace suspension_health_monitor {
namespace {

/// What the bags hold, one entry each.
struct BagContents {
  std::vector<DriveSamples> samples;
  std::vector<std::vector<BodyMotion>> bodies;
};

BagContents readBags(const BagOptions& options) {
  BagContents contents;
  for (const std::string& path : options.bags.paths) {
    ImuBags bag = options.bags;
    bag.paths = {path};
    DriveSamples& samples = contents.samples.emplace_back();
    std::vector<BodyMotion>& body = contents.bodies.emplace_back();
    const auto take = [&](const CornerSample& sample) {
      samples.push_back(sample);
      return true;
    };
    readSamples(bag, options.pipeline, take, [&](const BodyMotion& motion) { body.push_back(motion); });
  }
  return contents;
}

StrutModel roughStrut(const std::vector<DriveSamples>& drives, const MonitorOptions& options) {
  StrutModel rough = roughModel(drives, options);
  if (!isDampedSpring(rough))
    throw TooLittleError("the drives show no damped spring (least squares: damping/mass " +
                         std::to_string(rough.damping_to_mass) + ", stiffness/mass " +
                         std::to_string(rough.stiffness_to_mass) + ")");
  return rough;
}

/// The start may hold only such faults of the reading as these drives can tell.
void requireTestable(const StrutModel& model, const std::deque<DriveRecord>& records) {
  EffectLibrary in_use;
  for (const ActiveMeasurementEffect& reading : model.reading) in_use.readings.push_back(reading.effect);
  for (const UntestableEffect& effect : takeUntestable(in_use, pointersTo(records)))
    throw InputError("the model has " + effect.name + ", but " + effect.reason + " in one of the bags");
}

}  // namespace

BagDrives readDrives(const BagOptions& options, const std::optional<StrutModel>& model) {
  const BagContents contents = readBags(options);
  const MonitorOptions& monitor = options.pipeline.monitor;
  StrutModel start = model ? *model : roughStrut(contents.samples, monitor);
  std::deque<DriveRecord> records = makeRecords(contents.samples, *monitor.sample_period, start);
  for (std::size_t i = 0; i < records.size(); ++i) records[i].addBodyMotion(contents.bodies[i]);
  requireTestable(start, records);
  return {std::move(start), std::move(records)};
}

}  // namespace suspension_health_monitor
