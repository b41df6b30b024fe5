#include "conversions.h"

#include "suspension_health_monitor/internal/wording/monitor_sentences.h"

namespace suspension_health_monitor {

Stamp toStamp(const ros::Time& time) { return std::chrono::seconds(time.sec) + Stamp(time.nsec); }

ros::Time toRosTime(Stamp stamp) { return ros::Time().fromNSec(static_cast<std::uint64_t>(stamp.count())); }

ParameterEstimate toMsg(const StrutEstimate& estimate, const char* estimator, const std_msgs::Header& header,
                        const std::vector<ActiveEffect>& effects, const std::optional<double>& sprung_mass) {
  ParameterEstimate msg;
  msg.header = header;
  msg.estimator = estimator;
  msg.damping_to_mass = estimate.damping_to_mass;
  msg.stiffness_to_mass = estimate.stiffness_to_mass;
  msg.damping_to_mass_stddev = estimate.dampingAbsoluteStddev();
  msg.stiffness_to_mass_stddev = estimate.stiffnessAbsoluteStddev();
  msg.damping = estimate.damping_to_mass * sprung_mass.value_or(kUnknown);
  msg.stiffness = estimate.stiffness_to_mass * sprung_mass.value_or(kUnknown);
  msg.natural_frequency = estimate.naturalFrequency();
  msg.damping_ratio = estimate.dampingRatio();
  for (std::size_t j = 0; j < estimate.num_effects; ++j) {
    msg.effect_names.push_back(effects[j].effect.name);
    msg.effect_coefficients.push_back(estimate.coefficients[j]);
    msg.effect_stddevs.push_back(estimate.coefficient_stddevs[j]);
  }
  msg.offset = estimate.offset;
  msg.clock_skew = estimate.delay;
  msg.effective_rows = estimate.effective_rows;
  msg.valid = estimate.valid();
  msg.explained = estimate.explained;
  msg.age = estimate.age;
  if (!msg.valid) msg.reason = describe(estimate.doubt);
  return msg;
}

ModelComparison toMsg(const ComparisonReport& comparison, const std::string& frame_id) {
  ModelComparison msg;
  msg.header.stamp = toRosTime(comparison.stamp);
  msg.header.frame_id = frame_id;
  msg.measured = comparison.measured;
  msg.predicted = comparison.predicted.value_or(kUnknown);
  msg.residual = msg.measured - msg.predicted;
  msg.rmse = comparison.rmse;
  msg.fit_percent = comparison.fit_percent;
  msg.base_rmse = comparison.base_rmse;
  msg.base_fit_percent = comparison.base_fit_percent;
  return msg;
}

SuspensionHealth toMsg(const MonitorReport& report, const Baseline& baseline, const std_msgs::Header& header) {
  SuspensionHealth msg;
  msg.header = header;
  msg.level = static_cast<SuspensionHealth::_level_type>(report.health.level);
  msg.reason = describe(report.health);
  msg.damping_to_mass = report.estimate.damping_to_mass;
  msg.stiffness_to_mass = report.estimate.stiffness_to_mass;
  msg.nominal_damping_to_mass = baseline.damping_to_mass.value_or(kUnknown);
  msg.nominal_stiffness_to_mass = baseline.stiffness_to_mass.value_or(kUnknown);
  msg.damping_change = report.health.damping_change.value_or(kUnknown);
  msg.stiffness_change = report.health.stiffness_change.value_or(kUnknown);
  msg.payload_change = report.health.payload_change.value_or(kUnknown);
  msg.damping_significance = report.health.damping_significance;
  msg.stiffness_significance = report.health.stiffness_significance;
  msg.damping_level = static_cast<SuspensionHealth::_level_type>(report.health.damping_level);
  msg.stiffness_level = static_cast<SuspensionHealth::_level_type>(report.health.stiffness_level);
  msg.early_warning = report.health.early_warning;
  msg.outliers_present = report.health.outliers;
  msg.sensor_fault = describe(report.health.sensor);
  msg.learning_progress = report.health.learning.value_or(kUnknown);
  return msg;
}

SimulationTruth toMsg(const DriveTruth& truth, const std::vector<ActiveEffect>& effects,
                      const std::vector<ActiveMeasurementEffect>& faults, const std_msgs::Header& header) {
  SimulationTruth msg;
  msg.header = header;
  msg.damping_to_mass = truth.damping_to_mass;
  msg.stiffness_to_mass = truth.stiffness_to_mass;
  msg.travel = truth.travel;
  msg.travel_rate = truth.travel_rate;
  msg.road = truth.road_height;
  msg.sprung_acceleration = truth.sprung_acceleration;
  msg.unsprung_acceleration = truth.unsprung_acceleration;
  const auto add = [&](const std::string& name, double coefficient) {
    msg.effect_names.push_back(name);
    msg.effect_coefficients.push_back(coefficient);
  };
  for (const ActiveEffect& active : effects) add(active.effect.name, active.coefficient);
  for (const ActiveMeasurementEffect& fault : faults)
    for (std::size_t i = 0; i < fault.coefficients.size(); ++i)
      add(nameOfCoefficient(fault.effect, i), fault.coefficients[i]);
  return msg;
}

}  // namespace suspension_health_monitor
