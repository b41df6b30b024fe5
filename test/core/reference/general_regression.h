#pragma once

#include "suspension_health_monitor/internal/identification/linear_integral_filter.h"
#include "suspension_health_monitor/internal/identification/regression.h"

namespace suspension_health_monitor {

/// Rows of the regression for a linear model of any order n, Eq. (7) and (10)-(12):
///   y^(n) = -a_{n-1} y^(n-1) - ... - a_0 y + b_{n-1} u^(n-1) + ... + b_0 u,
///   phi   = [-I_{n-1}^n y ... -I_0^n y   I_{n-1}^n u ... I_0^n u],   psi = I_n^n y,
///   theta = [a_{n-1} ... a_0   b_{n-1} ... b_0]   (2 n parameters, a_i in s^(i-n), b_i in unit(y)/unit(u) s^(i-n)).
/// Cost per sample: O(n^2), independent of L, no allocation.
class GeneralRegression {
 public:
  /// @param order  n >= 1.
  GeneralRegression(int order, const IntegralFilterOptions& options);

  /// @return the row, owned by this object and valid until the next call; nullptr during the first n L samples.
  const RegressionRow* push(double input, double output);

  void reset();

 private:
  int order_;
  LinearIntegralFilter input_;
  LinearIntegralFilter output_;
  RegressionRow row_;
};

}  // namespace suspension_health_monitor
