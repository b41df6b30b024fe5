#include "body_turning.h"

#include <Eigen/Dense>
#include <algorithm>
#include <optional>

namespace suspension_health_monitor {
namespace {

std::optional<Eigen::VectorXd> joined(const Records& records, BodyChannel channel, Eigen::Index count) {
  Eigen::VectorXd all(count);
  Eigen::Index k = 0;
  for (const DriveSegment* segment : segmentsOf(records)) {
    const std::vector<double>& values = segment->body[static_cast<std::size_t>(channel)];
    if (values.empty()) return std::nullopt;
    for (const double value : values) all[k++] = value;
  }
  return all;
}

Eigen::VectorXd joined(const std::vector<SampleMask>& masks, Eigen::Index count) {
  Eigen::VectorXd all(count);
  Eigen::Index k = 0;
  for (const SampleMask& mask : masks)
    for (const char is_set : mask) all[k++] = is_set != 0 ? 1.0 : 0.0;
  return all;
}

}  // namespace

double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion) {
  const Eigen::Index count = motion.numSamples();
  Eigen::MatrixXd strut(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const StrutMotion& m = motion.motion()[static_cast<std::size_t>(k)];
    strut.row(k) << m.travel / motion.travel(), m.travel_rate / motion.travelRate(), m.body_acceleration;
  }
  const Eigen::VectorXd trained = joined(held_out.training, count);
  const Eigen::VectorXd judged = Eigen::VectorXd::Ones(count) - trained;
  const Eigen::MatrixXd weighted = trained.asDiagonal() * strut;
  double most = 0.0;
  for (const BodyChannel channel : {BodyChannel::kAngularAccelerationX, BodyChannel::kAngularAccelerationY}) {
    const std::optional<Eigen::VectorXd> turning = joined(records, channel, count);
    if (!turning) continue;
    const Eigen::Vector3d told = (strut.transpose() * weighted).ldlt().solve(weighted.transpose() * *turning);
    const double whole = judged.dot(turning->cwiseAbs2());
    if (whole > 0.0) most = std::max(most, 1.0 - judged.dot((*turning - strut * told).cwiseAbs2()) / whole);
  }
  return most;
}

}  // namespace suspension_health_monitor
