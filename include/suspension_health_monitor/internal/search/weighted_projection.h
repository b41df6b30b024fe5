#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <optional>

namespace suspension_health_monitor {

/// Weighted least squares of a target by the columns that a model has, and what more columns would take of the rest.
class WeightedProjection {
 public:
  using Columns = Eigen::Ref<const Eigen::MatrixXd>;

  /// How columns explain the target beside the model's own ones.
  struct Part {
    double gain = 0.0;             ///< of the weighted sum of squares
    Eigen::VectorXd coefficients;  ///< of the columns
    Eigen::VectorXd common;        ///< of the model's own ones, which go along
  };

  WeightedProjection() = default;

  /// @param common  the model's own columns, (n, p).  @param weight  of a row, 0: it does not count, (n).
  /// @param target  (n).
  WeightedProjection(Eigen::MatrixXd common, Eigen::VectorXd weight, Eigen::VectorXd target);

  /// @return nothing if a column is one that the model's own make already, or is 0 where it counts.
  std::optional<Part> project(const Columns& columns) const;

  /// @return what the model's own columns leave of the weighted sum of squares.
  double left() const { return weight_.dot(target_.cwiseAbs2()) - own_.dot(gram_.solve(own_)); }

  const Eigen::MatrixXd& common() const { return common_; }
  const Eigen::VectorXd& weight() const { return weight_; }
  const Eigen::VectorXd& target() const { return target_; }

 private:
  Eigen::MatrixXd common_;
  Eigen::VectorXd weight_, target_;
  Eigen::LLT<Eigen::MatrixXd> gram_;
  Eigen::VectorXd own_;  // what the model's own columns have in common with the target
};

}  // namespace suspension_health_monitor
