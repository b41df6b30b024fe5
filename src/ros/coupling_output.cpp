#include "coupling_output.h"

#include "conversions.h"
#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

namespace suspension_health_monitor {
namespace {

using diagnostic_msgs::DiagnosticStatus;

void setBody(const std::optional<BodyInertia>& body, CouplingInUse& msg) {
  const Measured unknown{kUnknown, kUnknown};
  const auto set = [](const Measured& from, double& value, double& stddev) {
    value = from.value;
    stddev = from.stddev;
  };
  set(body ? body->mass_to_pitch_inertia : unknown, msg.mass_to_pitch_inertia, msg.mass_to_pitch_inertia_stddev);
  set(body ? body->mass_to_roll_inertia : unknown, msg.mass_to_roll_inertia, msg.mass_to_roll_inertia_stddev);
  set(body ? body->x : unknown, msg.centre_of_gravity[0], msg.centre_of_gravity_stddev[0]);
  set(body ? body->y : unknown, msg.centre_of_gravity[1], msg.centre_of_gravity_stddev[1]);
}

BodyInertiaResult bodyOf(const CouplingEstimate& coupling, const StrutPlaces& places) {
  return bodyInertia(coupling.coupling.ratios, coupling.stddevs, places);
}

void describeBody(const BodyInertiaResult& found, diagnostic_updater::DiagnosticStatusWrapper& status) {
  const auto add = [&](const char* name, const Measured& number) {
    status.addf(name, "%.4g +- %.2g", number.value, number.stddev);
  };
  if (!found.body) return status.add("body", suspension_health_monitor::describe(found.doubt));
  add("M/Iyy [1/m^2]", found.body->mass_to_pitch_inertia);
  add("M/Ixx [1/m^2]", found.body->mass_to_roll_inertia);
  add("centre of gravity x [m]", found.body->x);
  add("centre of gravity y [m]", found.body->y);
}

CouplingInUse toMsg(const CouplingEstimate* coupling, const std::string& why_none, const StrutPlaces& places,
                    const std::vector<std::string>& struts, const std::vector<std::string>& forces) {
  CouplingInUse msg;
  msg.known = coupling != nullptr;
  msg.names = struts;
  msg.forces = forces;
  msg.condition = kUnknown;
  const auto n = static_cast<Eigen::Index>(struts.size());
  if (coupling == nullptr) {
    msg.reason = why_none;
    msg.ratios.assign(struts.size() * struts.size(), kUnknown);
    msg.stddevs = msg.ratios;
    msg.force_coefficients.assign(struts.size() * forces.size(), kUnknown);
    msg.force_stddevs = msg.force_coefficients;
    setBody({}, msg);
    return msg;
  }
  msg.condition = coupling->condition;
  setBody(bodyOf(*coupling, places).body, msg);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) {
      msg.ratios.push_back(coupling->coupling.ratios(i, j));
      msg.stddevs.push_back(coupling->stddevs(i, j));
    }
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index k = 0; k < coupling->coupling.forces.cols(); ++k) {
      msg.force_coefficients.push_back(coupling->coupling.forces(i, k));
      msg.force_stddevs.push_back(coupling->force_stddevs(i, k));
    }
  return msg;
}

/// What is not known is NaN in both, and alike.
bool saysTheSame(const CouplingInUse& a, const CouplingInUse& b) {
  return a.known == b.known && a.reason == b.reason &&
         (!a.known || (a.ratios == b.ratios && a.stddevs == b.stddevs && a.force_stddevs == b.force_stddevs));
}

}  // namespace

void CouplingOutput::publish(const VehicleMonitor* monitor, const std::string& why_none, const StrutPlaces& places,
                             const ros::Time& stamp) {
  CouplingInUse msg = toMsg(monitor != nullptr ? monitor->coupling() : nullptr, why_none, places, struts_, forces_);
  if (last_ && saysTheSame(*last_, msg)) return;
  msg.header.stamp = stamp;
  publisher_.publish(msg);
  last_ = msg;
}

void CouplingOutput::describe(const VehicleMonitor* monitor, const std::string& why_none, const StrutPlaces& places,
                              diagnostic_updater::DiagnosticStatusWrapper& status) const {
  const CouplingEstimate* coupling = monitor != nullptr ? monitor->coupling() : nullptr;
  if (coupling == nullptr) {
    status.summary(DiagnosticStatus::STALE, why_none);
    return;
  }
  status.summary(DiagnosticStatus::OK, "it is known how the struts move one another");
  status.addf("condition", "%.3g", coupling->condition);
  if (const std::string late = reasonOf(monitor->estimate(), struts_); !late.empty() && struts_.size() > 1)
    status.add("not renewed", "the drives of late " + late);
  if (struts_.size() > 1) describeBody(bodyOf(*coupling, places), status);
  for (std::size_t i = 0; i < struts_.size(); ++i)
    for (std::size_t j = 0; j < struts_.size(); ++j) {
      if (i == j) continue;
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      status.addf(struts_[i] + " moved by " + struts_[j], "%.3f +- %.3f", coupling->coupling.ratios(row, column),
                  coupling->stddevs(row, column));
    }
  for (std::size_t i = 0; i < struts_.size(); ++i)
    for (std::size_t k = 0; k < forces_.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(k);
      status.addf(struts_[i] + " moved by " + forces_[k], "%.4g +- %.2g m/s^2 per unit",
                  coupling->coupling.forces(row, column), coupling->force_stddevs(row, column));
    }
}

std::string whyNotCoupled(const VehicleMonitor& monitor, const std::vector<std::string>& struts) {
  return "the drives so far " + reasonOf(monitor.estimate(), struts);
}

}  // namespace suspension_health_monitor
