#pragma once

#include <Eigen/Core>

#include "../quarter_car.h"

namespace suspension_health_monitor {

/// x' = A x + B mu, equations (3)-(6), state x = (z, w, z', w') [m, m, m/s, m/s], input road height mu [m].
struct RoadDrivenForm {
  Eigen::Matrix4d a;
  Eigen::Vector4d b;
};

/// @throws std::invalid_argument  on a rigid wheel, which has no such form.
RoadDrivenForm roadDrivenForm(const QuarterCar& car);

/// Equation (27), z'' = b1 v + b0 d, driven by the wheel's acceleration. State x = (d, v) [m, m/s], travel and its
/// rate:
///   x' = A x + B w'',   z'' = C x
/// It holds for any tyre, since w'' is measured above it; with a rigid wheel w'' = mu''.
struct WheelDrivenForm {
  Eigen::Matrix2d a;
  Eigen::Vector2d b;
  Eigen::RowVector2d c;
};

WheelDrivenForm wheelDrivenForm(const QuarterCar& car);

}  // namespace suspension_health_monitor
