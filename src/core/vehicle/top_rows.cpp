#include "suspension_health_monitor/internal/vehicle/top_rows.h"

#include <cmath>

namespace suspension_health_monitor {

Measured BodyRows::ratio(Eigen::Index i, Eigen::Index j) const {
  if (i == j) return {1.0, 0.0};
  double weights = 0.0, sum = 0.0;
  const auto add = [&](const Eigen::MatrixXd& of, Eigen::Index at) {
    const double value = of(i, j) / of(j, j);
    const double variance = (covariance[i](at, at) + value * value * covariance[j](at, at)) / (of(j, j) * of(j, j));
    weights += 1.0 / variance;
    sum += value / variance;
  };
  add(rate, j);
  add(travel, size() + j);
  return {sum / weights, 1.0 / std::sqrt(weights)};
}

bool BodyRows::areKnown() const {
  if (!(rate.diagonal().minCoeff() > 0.0 && travel.diagonal().minCoeff() > 0.0)) return false;
  for (Eigen::Index i = 0; i < size(); ++i)
    for (Eigen::Index j = 0; j < size(); ++j)
      // Of a neighbour's force: such an error makes b1 and b0 wrong by a few percent, as wheels hardly ever move alike.
      if (!(ratio(i, j).stddev < kMostRelativeStddev)) return false;
  return true;
}

std::vector<StrutModel> BodyRows::models() const {
  std::vector<StrutModel> models;
  for (Eigen::Index i = 0; i < size(); ++i) models.push_back({rate(i, i), travel(i, i), {}, {}});
  return models;
}

}  // namespace suspension_health_monitor
