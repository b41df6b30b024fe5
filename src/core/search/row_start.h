#pragma once

#include <optional>
#include <vector>

#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/search/screening.h"

namespace suspension_health_monitor {

/// Where a fit of a law may begin that the linear response cannot tell: one with a kink or a memory that carries so
/// much of the strut's force that b1 and b0 without it are far from those beside it.
///
/// The travel is told by the measurements themselves, d'' = w'' - z'', integrated twice and once by an integral that
/// forgets what is slower than a third of the natural frequency (motionError()). Along it the law is one more column of
///   z'' = b1 v + b0 d + sum_j c_j f_j + c f,
/// each behind the filter of the drive if it has one, by least squares over the training samples, shape by shape of the
/// scan. Of long drives stretches are looked at, evenly spread. Too coarse for an estimate: the noise of the sensors is
/// in d and v; it does for a start.
class RowStart {
 public:
  /// @param fit  the present model: its effects stay, with their shapes.
  RowStart(const Records& records, const HoldOut& held_out, const ModelFit& fit);

  struct Start {
    StrutModel model;    ///< the present one with the effect added
    double share = 0.0;  ///< of what the rows without the effect leave that it takes
  };

  /// @return nothing if no shape leaves a damped spring and a coefficient of the right sign.
  std::optional<Start> with(const ForceEffect& effect) const;

 private:
  void passLow(Eigen::Ref<Eigen::VectorXd> column) const;

  const ModelFit& fit_;
  std::vector<StrutMotion> motion_;        // per sample of all stretches
  std::vector<std::size_t> ends_;          // of the stretches
  std::vector<std::vector<double>> taps_;  // of the filter of each stretch
  MotionScale scale_;
  WeightedProjection rows_;  // of z'' by v, d and the forces of the present effects; weight 0 where held out
};

}  // namespace suspension_health_monitor
