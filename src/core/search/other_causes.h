#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/math/linear_solve.h"

namespace suspension_health_monitor {

inline constexpr const char* kTilt = "mount_tilt";

/// A sensor that is tilted by an angle reads its cosine of all that happens along the strut, gravity above all. What
/// leaks in from across need not show it: of the wheel's IMU nothing else is known.
/// @return true if a fault of the model's reading is an offset or a gain that a tilt of up to 30 degrees makes as well,
/// in drives whose sensors read gravity.
inline bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records) {
  const bool is_read = std::all_of(records.begin(), records.end(), [](const DriveRecord* record) {
    return record->gravity() > 0.5 * kStandardGravity;
  });
  const double lost_by_30_degrees = 1.0 - std::cos(M_PI / 6.0);
  const double unit = fault == "accelerometer_bias" ? kStandardGravity : fault == "scale_error" ? 1.0 : 0.0;
  return is_read && std::any_of(model.reading.begin(), model.reading.end(), [&](const ActiveMeasurementEffect& active) {
           return active.effect.name == fault && std::abs(active.coefficients.front()) < lost_by_30_degrees * unit;
         });
}

/// How much of the body's turning goes with the strut's motion: the share of the mean square of its angular
/// acceleration, about x or y, that travel, travel rate and z'' of a model's free run tell, fitted on the training
/// samples and judged by the rest. A strut that turns its body is not alone on it: something else holds the body, and
/// what that does to the strut's top has the gyro's shape, too, without being a fault of a sensor.
/// @return 0 if the strut's motion explains none of it, or if the body's IMU measures no turning.
inline double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion) {
  const Eigen::Index count = motion.numSamples();
  Eigen::MatrixXd strut(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const StrutMotion& m = motion.motion().samples[k];
    strut.row(k) << m.travel / motion.scale().travel, m.travel_rate / motion.scale().travel_rate, m.body_acceleration;
  }
  const Eigen::VectorXd trained = joined(held_out.training);
  const Eigen::VectorXd judged = Eigen::VectorXd::Ones(count) - trained;
  const Eigen::MatrixXd weighted = trained.asDiagonal() * strut;
  double most = 0.0;
  for (const BodyChannel channel : {BodyChannel::kAngularAccelerationX, BodyChannel::kAngularAccelerationY}) {
    std::vector<std::vector<double>> measured;
    for (const DriveSegment* segment : segmentsOf(records))
      measured.push_back(segment->body[static_cast<std::size_t>(channel)]);
    const Eigen::VectorXd turning = joined(measured);
    if (turning.size() < count) continue;  // not measured in one of the drives
    const Eigen::Vector3d explained = solveSymmetric(strut.transpose() * weighted, weighted.transpose() * turning);
    const double whole = judged.dot(turning.cwiseAbs2());
    if (whole > 0.0) most = std::max(most, 1.0 - judged.dot((turning - strut * explained).cwiseAbs2()) / whole);
  }
  return most;
}

/// A force that goes with the body's own motion, not with the strut's.
inline bool actsOnBody(const ActiveEffect& active) {
  const auto rate = [&](double acceleration) { return active.memoryRate({1.0, 1.0, 1.0, 0.5, acceleration}); };
  return rate(0.0).s != rate(1.0).s || rate(0.0).second != rate(1.0).second;
}

}  // namespace suspension_health_monitor
