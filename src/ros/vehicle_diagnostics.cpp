#include "vehicle_diagnostics.h"

#include <diagnostic_msgs/DiagnosticArray.h>
#include <suspension_health_monitor/CornerComparison.h>

#include <array>
#include <boost/make_shared.hpp>

#include "conversions.h"
#include "input_task.h"
#include "suspension_health_monitor/internal/drive_identification.h"
#include "suspension_health_monitor/internal/monitor/vehicle_pipeline.h"
#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

void setBody(const BodyInertia& body, CouplingInUse& msg) {
  const bool is_known = body.doubt == InertiaDoubt::kNone;
  const auto set = [&](const Measured& from, double& value, double& stddev) {
    value = is_known ? from.value : kUnknown;
    stddev = is_known ? from.stddev : kUnknown;
  };
  set(body.mass_to_pitch_inertia, msg.mass_to_pitch_inertia, msg.mass_to_pitch_inertia_stddev);
  set(body.mass_to_roll_inertia, msg.mass_to_roll_inertia, msg.mass_to_roll_inertia_stddev);
  set(body.x, msg.centre_of_gravity[0], msg.centre_of_gravity_stddev[0]);
  set(body.y, msg.centre_of_gravity[1], msg.centre_of_gravity_stddev[1]);
}

void describeBody(const BodyInertia& body, Status& status) {
  const auto add = [&](const char* name, const Measured& number) {
    status.addf(name, "%.4g +- %.2g", number.value, number.stddev);
  };
  if (body.doubt != InertiaDoubt::kNone) return status.add("body", suspension_health_monitor::describe(body.doubt));
  add("M/Iyy [1/m^2]", body.mass_to_pitch_inertia);
  add("M/Ixx [1/m^2]", body.mass_to_roll_inertia);
  add("centre of gravity x [m]", body.x);
  add("centre of gravity y [m]", body.y);
}

void setBars(const std::vector<BodyFitResult::Bar>& bars, const std::vector<std::string>& struts, CouplingInUse& msg) {
  for (const BodyFitResult::Bar& bar : bars) {
    msg.bar_struts.insert(msg.bar_struts.end(), {struts[bar.struts.first], struts[bar.struts.second]});
    for (const std::size_t end : {0, 1}) {
      msg.bar_stiffness.push_back(bar.stiffness[end].value);
      msg.bar_stiffness_stddev.push_back(bar.stiffness[end].stddev);
      msg.bar_damping.push_back(bar.damping[end].value);
      msg.bar_damping_stddev.push_back(bar.damping[end].stddev);
    }
  }
}

StrutPlaces placesOf(const VehicleMonitor& monitor) {
  return monitor.vehicle() != nullptr ? monitor.vehicle()->places() : StrutPlaces{};
}

CouplingInUse toMsg(const VehicleCoupling& coupling, const VehicleMonitor* monitor,
                    const std::vector<std::string>& struts, const std::vector<std::string>& forces) {
  CouplingInUse msg;
  msg.known = static_cast<bool>(coupling);
  msg.reason = coupling.reason;
  msg.names = struts;
  msg.forces = forces;
  msg.condition = kUnknown;
  msg.model_error = coupling.model_error;
  setBody(msg.known ? inertiaOf(monitor->body(), placesOf(*monitor)) : BodyInertia(), msg);
  if (!msg.known) {
    msg.ratios.assign(struts.size() * struts.size(), kUnknown);
    msg.stddevs = msg.ratios;
    msg.force_coefficients.assign(struts.size() * forces.size(), kUnknown);
    msg.force_stddevs = msg.force_coefficients;
    return msg;
  }
  for (std::size_t i = 0; i < struts.size(); ++i) {
    msg.ratios.insert(msg.ratios.end(), coupling.ratios[i].begin(), coupling.ratios[i].end());
    msg.stddevs.insert(msg.stddevs.end(), coupling.stddevs[i].begin(), coupling.stddevs[i].end());
    for (const KnownForceCoefficients& force : coupling.forces) {
      msg.force_coefficients.push_back(force.values[i]);
      msg.force_stddevs.push_back(force.stddevs[i]);
    }
  }
  if (monitor->body()) setBars(monitor->body()->found, struts, msg);
  return msg;
}

/// What is not known is NaN in both, and alike.
bool saysTheSame(const CouplingInUse& a, const CouplingInUse& b) {
  return a.known == b.known && a.reason == b.reason &&
         (!a.known || (a.ratios == b.ratios && a.stddevs == b.stddevs && a.force_stddevs == b.force_stddevs &&
                       a.bar_stiffness == b.bar_stiffness));
}

constexpr std::array kVerdictNames{"cannot tell", "alike", "load", "damper", "spring"};

CornerComparison toMsg(const CornerComparisonReport& report, Stamp stamp) {
  CornerComparison msg;
  msg.header.stamp = toRosTime(stamp);
  msg.level = static_cast<CornerComparison::_level_type>(report.level);
  msg.sentence = describe(report);
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    msg.corners[i] = kCornerNames[i];
    msg.verdicts[i] = static_cast<std::uint8_t>(report.verdicts[i]);
    msg.damping_deviation[i] = report.damping_deviation[i].value_or(kUnknown);
    msg.stiffness_deviation[i] = report.stiffness_deviation[i].value_or(kUnknown);
  }
  return msg;
}

}  // namespace

CornerOutput::CornerOutput(ros::NodeHandle& node, const CornerPlaces& places)
    : places_(places), publisher_(node.advertise<CornerComparison>("corners/comparison", 1, true)) {}

// The estimates stay valid when the sensors fall silent, so a judgement without a new sample counts none of them.
CornerComparisonReport CornerOutput::judge(const MessagePipeline* pipeline) {
  std::array<CornerState, kNumCorners> corners;
  if (pipeline == nullptr || pipeline->newest() == newest_) return compareCorners(corners);
  newest_ = pipeline->newest();
  for (std::size_t i = 0; i < kNumCorners; ++i)
    if (const SuspensionMonitor* monitor = pipeline->strut(places_[i]))
      corners[i] = {monitor->report().estimate, monitor->baseline()};
  return compareCorners(corners);
}

void CornerOutput::publish(const MessagePipeline* pipeline) {
  const CornerComparisonReport now = judge(pipeline);
  if (now.level == last_.level && now.verdicts == last_.verdicts) confirmed_ = now;
  last_ = now;
  publisher_.publish(boost::make_shared<const CornerComparison>(toMsg(confirmed_, newest_)));
}

void CornerOutput::describe(Status& status) const {
  status.summary(static_cast<unsigned char>(confirmed_.level), suspension_health_monitor::describe(confirmed_));
  for (std::size_t i = 0; i < kNumCorners; ++i) {
    const std::string name(kCornerNames[i]);
    const auto add = [&](const char* part, const std::optional<double>& deviation) {
      if (deviation) status.addf(name + part + " from the others [%]", "%+.1f", 100.0 * *deviation);
    };
    status.add(name, kVerdictNames[static_cast<std::size_t>(confirmed_.verdicts[i])]);
    add(" damping", confirmed_.damping_deviation[i]);
    add(" stiffness", confirmed_.stiffness_deviation[i]);
  }
}

// Who advertises first decides how long the queue is: an Updater's own holds one message, and all of them publish at
// once, so that the status of a strut would be lost behind that of the next.
VehicleDiagnostics::VehicleDiagnostics(MonitorHost& host, ros::NodeHandle& node, ros::NodeHandle& private_node,
                                       const std::string& name, const VehicleOptions& options)
    : host_(host),
      struts_(options.strutNames()),
      forces_(options.forceNames()),
      diagnostics_(node.advertise<diagnostic_msgs::DiagnosticArray>("/diagnostics", 2 * (struts_.size() + 1))),
      coupling_(private_node.advertise<CouplingInUse>("coupling", 1, true)),
      coupling_log_(name + " coupling"),
      updater_(node, private_node, name) {
  updater_.setHardwareID(name.substr(name.find_first_not_of('/')));
  updater_.add("Coupling", [this](Status& status) {
    describeCoupling(status);
    coupling_log_.note(status);
  });
  updater_.add("Input", [this](Status& status) { host_.input().describe(status); });
  if (const std::optional<CornerPlaces> places = cornersAmong(struts_)) corners_.emplace(node, *places);
  if (corners_) updater_.add("Corners", [this](Status& status) { corners_->describe(status); });
}

void VehicleDiagnostics::publish() {
  publishCoupling();
  if (corners_) corners_->publish(host_.pipeline());
  updater_.force_update();
}

VehicleCoupling VehicleDiagnostics::coupling() const {
  if (monitor() != nullptr) return couplingOf(*monitor(), struts_, forces_);
  VehicleCoupling none;
  none.reason = host_.whyNoMonitor();
  return none;
}

void VehicleDiagnostics::publishCoupling() {
  CouplingInUse msg = toMsg(coupling(), monitor(), struts_, forces_);
  if (last_coupling_ && saysTheSame(*last_coupling_, msg)) return;
  if (host_.pipeline() != nullptr) msg.header.stamp = toRosTime(host_.pipeline()->newest());
  coupling_.publish(msg);
  last_coupling_ = msg;
}

void VehicleDiagnostics::describeCoupling(Status& status) const {
  const VehicleCoupling known = coupling();
  if (!known) return status.summary(Status::STALE, (monitor() != nullptr ? "the drives so far " : "") + known.reason);
  status.summary(Status::OK, "it is known how the struts move one another");
  if (const std::string mistake = describeMistake(*monitor(), struts_); !mistake.empty())
    status.mergeSummary(Status::WARN, mistake);
  status.addf("model error", "%.2g %%", 100.0 * known.model_error);
  if (struts_.size() > 1) describeBody(inertiaOf(monitor()->body(), placesOf(*monitor())), status);
  for (const AntiRollBarFound& bar : known.bars)
    status.addf("anti-roll bar " + struts_[bar.first] + " - " + struts_[bar.second], "%.4g and %.4g 1/s^2",
                bar.first_stiffness_to_mass, bar.second_stiffness_to_mass);
  for (std::size_t i = 0; i < struts_.size(); ++i)
    for (std::size_t j = 0; j < struts_.size(); ++j)
      if (i != j)
        status.addf(struts_[i] + " moved by " + struts_[j], "%.3f +- %.3f", known.ratios[i][j], known.stddevs[i][j]);
  for (std::size_t i = 0; i < struts_.size(); ++i)
    for (const KnownForceCoefficients& force : known.forces)
      status.addf(struts_[i] + " moved by " + force.name, "%.4g +- %.2g m/s^2 per unit", force.values[i],
                  force.stddevs[i]);
}

}  // namespace suspension_health_monitor
