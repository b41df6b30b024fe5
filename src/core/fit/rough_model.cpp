#include "suspension_health_monitor/internal/fit/rough_model.h"

#include "suspension_health_monitor/internal/identification/recursive_least_squares.h"
#include "suspension_health_monitor/internal/identification/suspension_regression.h"
#include "suspension_health_monitor/internal/signal/continuity.h"

namespace suspension_health_monitor {

StrutModel roughModel(const std::vector<Drive>& drives, const IntegralFilterOptions& filter) {
  RecursiveOptions recursive;
  recursive.forgetting_factor = 1.0;
  RecursiveLeastSquares least_squares(kNumStrutParameters + 1, recursive);  // and the sensors' offset
  for (const Drive& drive : drives) {
    SuspensionRegression regression(filter, 0, SensorColumns::kOffset);
    const CornerSample* last = nullptr;
    for (const CornerSample& sample : drive.samples) {
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

}  // namespace suspension_health_monitor
