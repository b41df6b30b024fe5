#include "suspension_health_monitor/internal/search/weighted_projection.h"

#include <utility>

namespace suspension_health_monitor {
namespace {

constexpr double kIndependent = 1e-6;  // share of a column that the model's own columns must leave

}  // namespace

WeightedProjection::WeightedProjection(Eigen::MatrixXd common, Eigen::VectorXd weight, Eigen::VectorXd target)
    : common_(std::move(common)), weight_(std::move(weight)), target_(std::move(target)) {
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * common_;
  gram_.compute(common_.transpose() * weighted);
  own_ = weighted.transpose() * target_;
}

std::optional<WeightedProjection::Part> WeightedProjection::project(const Columns& columns) const {
  const Eigen::MatrixXd weighted = weight_.asDiagonal() * columns;
  const Eigen::MatrixXd cross = common_.transpose() * weighted;
  const Eigen::MatrixXd carried = gram_.solve(cross);
  const Eigen::MatrixXd square = columns.transpose() * weighted;
  const Eigen::MatrixXd independent = square - cross.transpose() * carried;
  for (Eigen::Index i = 0; i < columns.cols(); ++i)
    if (!(independent(i, i) > kIndependent * square(i, i))) return std::nullopt;  // 0 and NaN, too
  Part part;
  const Eigen::VectorXd moment = weighted.transpose() * target_ - carried.transpose() * own_;
  part.coefficients = independent.ldlt().solve(moment);
  part.gain = moment.dot(part.coefficients);
  part.common = gram_.solve(own_) - carried * part.coefficients;
  return part;
}

}  // namespace suspension_health_monitor
