#include "suspension_health_monitor/internal/identification/regressor_noise.h"

namespace suspension_health_monitor {

RegressorNoise::RegressorNoise(const IntegralFilterOptions& options) {
  LinearIntegralFilter filter(2, options);
  const int settled = 2 * options.horizon_samples + 1;  // the filter answers a little outside of its window, too
  for (int k = 0; k < settled; ++k) filter.push(0.0);
  Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 2 * settled; ++k) {
    filter.push(k == 0 ? 1.0 : 0.0);
    const Eigen::Vector3d response(filter.output(1), filter.output(0), filter.output(2));
    gram += response * response.transpose();
  }
  regressors_ = gram.topLeftCorner<2, 2>();
  cross_ = gram.block<2, 1>(0, 2);
  outputs_ = gram(2, 2);
}

}  // namespace suspension_health_monitor
