#include "suspension_health_monitor/discrepancy/drives.h"

#include <algorithm>
#include <cmath>

#include "suspension_health_monitor/identification/recursive_least_squares.h"
#include "suspension_health_monitor/identification/suspension_regression.h"
#include "suspension_health_monitor/signal/continuity.h"

namespace suspension_health_monitor {
namespace {

constexpr double kLongestStep = 0.35;  // of the strut's fastest time

}  // namespace

StrutModel roughModel(const std::vector<Drive>& drives, const IntegralFilterOptions& filter) {
  RecursiveOptions recursive;
  recursive.forgetting_factor = 1.0;
  RecursiveLeastSquares least_squares(kNumStrutParameters, recursive);
  for (const Drive& drive : drives) {
    SuspensionRegression regression(filter);
    const CornerSample* last = nullptr;
    for (const CornerSample& sample : drive) {
      if (last != nullptr &&
          continuity(sample.stamp - last->stamp, fromSeconds(filter.period)) != Continuity::kContinues)
        regression.reset();
      if (const RegressionRow* row = regression.push(sample)) least_squares.update(*row);
      last = &sample;
    }
  }
  const Eigen::VectorXd& theta = least_squares.parameters();
  return {theta[kDampingToMass], theta[kStiffnessToMass], {}, {}};
}

std::deque<DriveRecord> makeRecords(const std::vector<Drive>& drives, double period, const StrutModel& model) {
  const double fastest = std::max(model.damping_to_mass, std::sqrt(model.stiffness_to_mass));
  const int steps = std::max(1, static_cast<int>(std::ceil(period * fastest / kLongestStep)));
  std::deque<DriveRecord> records;
  for (const Drive& drive : drives) {
    DriveRecord& record = records.emplace_back(period, steps);
    for (const CornerSample& sample : drive) record.push(sample);
    record.finish();
  }
  return records;
}

}  // namespace suspension_health_monitor
