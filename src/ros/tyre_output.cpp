#include <suspension_health_monitor/TyreEstimate.h>

#include "conversions.h"
#include "report_topics.h"
#include "strut_diagnostics.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

boost::shared_ptr<const TyreEstimate> toMsg(const WheelEstimate& estimate, const char* estimator,
                                            const StrutEstimate& strut, const std_msgs::Header& header) {
  const auto msg = boost::make_shared<TyreEstimate>();
  msg->header = header;
  msg->estimator = estimator;
  msg->damping_to_wheel_mass = estimate.damping_to_wheel_mass;
  msg->stiffness_to_wheel_mass = estimate.stiffness_to_wheel_mass;
  msg->tyre_to_wheel_mass = estimate.tyre_to_wheel_mass;
  msg->damping_to_wheel_mass_stddev = estimate.damping_to_wheel_mass_stddev;
  msg->stiffness_to_wheel_mass_stddev = estimate.stiffness_to_wheel_mass_stddev;
  msg->tyre_to_wheel_mass_stddev = estimate.tyre_to_wheel_mass_stddev;
  msg->wheel_hop_frequency = estimate.wheelHopFrequency();
  msg->mass_ratio = massRatio(strut, estimate).value_or(kUnknown);
  msg->effective_rows = estimate.effective_rows;
  msg->valid = estimate.valid();
  return msg;
}

}  // namespace

TyreOutput::TyreOutput(ros::NodeHandle& private_node, std::uint32_t queue_size)
    : ls_(private_node.advertise<TyreEstimate>("tyre_ls", queue_size)),
      la_(private_node.advertise<TyreEstimate>("tyre_la", queue_size)) {}

void TyreOutput::publish(const TyreTracker& tracker, const StrutEstimate& strut, const std_msgs::Header& header) {
  if (ls_.getNumSubscribers() > 0) ls_.publish(toMsg(tracker.report().ls, "ls", strut, header));
  if (la_.getNumSubscribers() > 0) la_.publish(toMsg(tracker.report().la, "la", strut, header));
}

void describeTyre(const VehiclePipeline& pipeline, diagnostic_updater::DiagnosticStatusWrapper& status) {
  if (pipeline.tyre() == nullptr) {
    status.summary(DiagnosticStatus::STALE, kMeasuringPeriod);
    return;
  }
  const WheelEstimate& la = pipeline.tyre()->report().la;
  if (la.valid())
    status.summary(DiagnosticStatus::OK, "wheel and tyre are known");
  else if (std::isnan(pipeline.roadAcceleration()))
    status.summary(DiagnosticStatus::WARN, "the road's IMU is silent");
  else
    status.summary(DiagnosticStatus::STALE, "cannot tell: no valid estimate (starting, parked, or poor input)");
  status.addf("la damping_to_wheel_mass [1/s]", "%.4g", la.damping_to_wheel_mass);
  status.addf("la stiffness_to_wheel_mass [1/s^2]", "%.5g", la.stiffness_to_wheel_mass);
  status.addf("la tyre_to_wheel_mass [1/s^2]", "%.5g", la.tyre_to_wheel_mass);
  status.addf("wheel hop [Hz]", "%.4g", la.wheelHopFrequency());
  if (const auto ratio = massRatio(pipeline.strut()->report().estimate, la))
    status.addf("wheel mass / body mass", "%.4g", *ratio);
  status.addf("horizon_samples", "%d", pipeline.tyre()->horizonSamples());
}

}  // namespace suspension_health_monitor
