#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

std::string_view describe(EstimateDoubt doubt) {
  switch (doubt) {
    case EstimateDoubt::kNone: return "valid";
    case EstimateDoubt::kNoRows: return "the filter is filling after a start or a gap";
    case EstimateDoubt::kSensorStuck: return "the body's acceleration does not change: sensor stuck, or nothing moves";
    case EstimateDoubt::kWrongPeriod: return "stamps do not fit sample_period";
    case EstimateDoubt::kFewRows: return "too few samples yet";
    case EstimateDoubt::kNotExcited: return "parked: no excitation of damping and stiffness, estimates held";
    case EstimateDoubt::kDampingNotExcited: return "no excitation of damping, its estimate is held";
    case EstimateDoubt::kStiffnessNotExcited: return "no excitation of stiffness, its estimate is held";
    case EstimateDoubt::kOutsideForce:
      return "something else than the wheel moves the body, or did so just now: wind, loading, a sensor that is not on "
             "the wheel";
    case EstimateDoubt::kNotExplained: return "the model does not explain the measured acceleration";
    case EstimateDoubt::kNotAStrut: return "the estimates are not those of a spring and a damper";
    case EstimateDoubt::kNoSpread: return "the estimates' standard deviation cannot be told";
    case EstimateDoubt::kFreeRunFails:
      return "the model, driven by the wheel, fits the body's motion worse than a constant";
  }
  return "unknown";
}

}  // namespace suspension_health_monitor
