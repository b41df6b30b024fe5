#include "suspension_health_monitor/internal/wording/monitor_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {

// What is the matter with the readings, and with estimates that are not valid.

std::string describe(AlignmentJudge::Verdict verdict) {
  switch (verdict) {
    case AlignmentJudge::Verdict::kApart: return "the sensors read at different instants";
    case AlignmentJudge::Verdict::kLoneReadings: return "many readings find no partner: the sensors' rates differ";
    case AlignmentJudge::Verdict::kInterrupted:
      return "readings are lost so often that the integral filter would hardly ever be full";
    case AlignmentJudge::Verdict::kDoesWell: break;
  }
  return "";
}

std::string describe(EstimateDoubt doubt) {
  switch (doubt) {
    case EstimateDoubt::kNone: return "valid";
    case EstimateDoubt::kNoRows: return "the first blocks fill after a start or a gap";
    case EstimateDoubt::kWrongPeriod: return "stamps do not fit sample_period";
    case EstimateDoubt::kWrongUnit: return "one of the IMUs reads in g, must be in m/s^2";
    case EstimateDoubt::kFewRows: return "too few samples yet";
    case EstimateDoubt::kNotExcited:
      return "too little motion to know damping and stiffness: drive, or on a rougher road";
    case EstimateDoubt::kDampingNotExcited: return "too little motion to know damping: drive on, or on a rougher road";
    case EstimateDoubt::kStiffnessNotExcited:
      return "too little motion to know stiffness: drive on, or on a rougher road";
    case EstimateDoubt::kNotExplained:
      return "the strut explains less than half of the body's motion: other struts, other forces, or a sensor";
    case EstimateDoubt::kNotAStrut: return "the estimates are not those of a spring and a damper";
    case EstimateDoubt::kVehicleFile: return "the drives contradict the vehicle file: see what is said of the coupling";
    case EstimateDoubt::kOldData: return "parked: the newest data on the strut are older than health/oldest_data";
    case EstimateDoubt::kDisagrees: return "not what the block estimate says";
    case EstimateDoubt::kFreeRunFails:
      return "the model, driven by the wheel, fits the body's motion worse than a constant";
    case EstimateDoubt::kModelError:
      return "the body does not move as a rigid one on linear struts: absolute values are not known to 15 %, changes "
             "are";
  }
  return "unknown";
}

std::string describeShaking(const InputStatus& input) {
  constexpr double kMostBeyond = 0.5, kLeastLevel = 0.3;  // of the power; [m/s^2]: more than a sensor's noise
  if (!(input.beyond_strut > kMostBeyond && input.beyond_strut_level > kLeastLevel)) return "";
  return formatted("the sprung IMU shakes above the strut's band (%.0f %% of its power, %.2g m/s^2): engine?",
                   100.0 * input.beyond_strut, input.beyond_strut_level);
}

std::string describe(const SensorReport& report) {
  const auto& [sprung, unsprung] = report.mean;
  const auto stuck = [](const char* one, const char* other) {
    return formatted("the %s IMU reads one value while the %s one moves: stuck", one, other);
  };
  switch (report.fault) {
    case SensorFault::kNone: return {};
    case SensorFault::kSprungStuck: return stuck("sprung", "unsprung");
    case SensorFault::kUnsprungStuck: return stuck("unsprung", "sprung");
    case SensorFault::kInG:
      return formatted("the %s IMU reads about 1 where the other reads gravity: it is in g, must be in m/s^2",
                       std::abs(sprung) < std::abs(unsprung) ? "sprung" : "unsprung");
    case SensorFault::kNegativeDamping:
      return "damping is negative: are the IMUs swapped, is one upside down, or has its axis the wrong sign?";
    case SensorFault::kUnrelated:
      return "both IMUs move, but no strut makes the one of the other: "
             "sensor fault, wrong axis, wrong topic, or the two swapped";
    case SensorFault::kGainsDiffer:
      return formatted(
          "the sprung IMU reads %.2f times what the unsprung one reads of the same slow motion: gain or tilt of one of "
          "them; damping and stiffness take it into account",
          1.0 + report.gain);
  }
  return {};
}

}  // namespace suspension_health_monitor
