#include "suspension_health_monitor/internal/identification/regressor_noise.h"

#include <vector>

namespace suspension_health_monitor {

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options) {
  LinearIntegralFilter filter(2, options);
  const int settled = 2 * options.horizon_samples + 1;  // the filter answers a little outside of its window, too
  for (int k = 0; k < settled; ++k) filter.push(0.0);
  std::vector<HorizonIntegral> means(3, meanOf(options));
  std::vector<DelayLine> lines(3, DelayLine(means.front().requiredHistory()));
  Eigen::Vector3d before = Eigen::Vector3d::Zero();
  for (int k = 0; k < 2 * settled; ++k) {
    filter.push(k == 0 ? 1.0 : 0.0);
    const Eigen::Vector3d response(filter.output(1), filter.output(0), filter.output(2));
    Eigen::Vector3d mean;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto place = static_cast<Eigen::Index>(i);
      lines[i].push(response[place]);
      mean[place] = means[i].update(lines[i]);
    }
    rows_.add(response);
    changes_.add(response - before);
    means_.add(mean);
    before = response;
  }
}

void RegressorNoise::Moments::add(const Eigen::Vector3d& responses) {
  const Eigen::Vector2d regressor = responses.head<2>();
  regressors += regressor * regressor.transpose();
  cross += regressor * responses[2];
  outputs += responses[2] * responses[2];
}

}  // namespace suspension_health_monitor
