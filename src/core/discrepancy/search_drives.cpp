#include "suspension_health_monitor/discrepancy/search_drives.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLongestStep = 0.35;  // of the strut's fastest time, for the free run's integration

}  // namespace

StrutModel roughModel(const std::vector<DriveSamples>& drives, const MonitorOptions& options) {
  const double period = *options.sample_period;
  RecursiveOptions recursive;
  recursive.forgetting_factor = 1.0;
  RecursiveLeastSquares least_squares(kNumStrutParameters, recursive);
  for (const DriveSamples& drive : drives) {
    SuspensionRegression regression(options.filter(period));
    const CornerSample* last = nullptr;
    for (const CornerSample& sample : drive) {
      if (last != nullptr && continuity(sample.stamp - last->stamp, fromSeconds(period)) != Continuity::kContinues)
        regression.reset();
      if (const RegressionRow* row = regression.push(sample)) least_squares.update(*row);
      last = &sample;
    }
  }
  const Eigen::VectorXd& theta = least_squares.parameters();
  return {theta[kDampingToMass], theta[kStiffnessToMass], {}, {}};
}

std::deque<DriveRecord> makeRecords(const std::vector<DriveSamples>& drives, double period, const StrutModel& rough) {
  const double fastest = std::max(rough.damping_to_mass, std::sqrt(rough.stiffness_to_mass));
  const int steps = std::max(1, static_cast<int>(std::ceil(period * fastest / kLongestStep)));
  std::deque<DriveRecord> records;
  for (const DriveSamples& drive : drives) {
    DriveRecord& record = records.emplace_back(period, steps);
    for (const CornerSample& sample : drive) record.push(sample);
    record.finish();
  }
  return records;
}

std::vector<const DriveRecord*> pointersTo(const std::deque<DriveRecord>& records) {
  std::vector<const DriveRecord*> pointers;
  for (const DriveRecord& record : records) pointers.push_back(&record);
  return pointers;
}

}  // namespace suspension_health_monitor
