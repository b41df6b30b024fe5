#include "general_regression.h"

namespace suspension_health_monitor {

GeneralRegression::GeneralRegression(int order, const IntegralFilterOptions& options)
    : order_(order), input_(order, options), output_(order, options), row_{Eigen::VectorXd::Zero(2 * order), 0.0} {}

const RegressionRow* GeneralRegression::push(double input, double output) {
  input_.push(input);
  output_.push(output);
  if (!output_.full()) return nullptr;
  row_.output = output_.output(order_);
  for (int column = 0; column < order_; ++column) {
    const int derivative = order_ - 1 - column;
    row_.regressor[column] = -output_.output(derivative);
    row_.regressor[order_ + column] = input_.output(derivative);
  }
  return &row_;
}

void GeneralRegression::reset() {
  input_.reset();
  output_.reset();
}

}  // namespace suspension_health_monitor
