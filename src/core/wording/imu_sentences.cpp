#include "suspension_health_monitor/internal/wording/imu_sentences.h"

#include <cmath>

#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kDegree = M_PI / 180.0;

std::string describeStamps(const ImuSurvey& imu, const RejectCounts& rejected) {
  const auto messages = static_cast<double>(imu.messages());
  const auto share = [&](RejectReason reason) { return static_cast<double>(rejected.count(reason)) / messages; };
  if (const double repeated = share(RejectReason::kRepeatedStamp); repeated > kWorthHaving)
    return percent(repeated) +
           " of the stamps equal the one before: the driver must stamp every reading when it is taken";
  if (const double back = share(RejectReason::kTimeWentBack); back > kWorthHaving)
    return percent(back) + " of the stamps go back in time: the driver must stamp and send readings in their order";
  if (imu.lost() > kLeastDifference)
    return percent(imu.lost()) + " of the readings are missing: look for a slow link, or a queue that is too short";
  if (imu.jitter() > kMajority)
    return formatted("the spacing of stamps varies by %.0f %%: stamp readings where they are taken",
                     100.0 * imu.jitter());
  return {};
}

std::string describeGravity(const MountClaim::Finding& gravity) {
  if (gravity.isWrongSize())
    return formatted("gravity reads %.2f m/s^2 instead of 9.81: the scale or the unit is wrong", gravity.size);
  // It reads so much too little along its axis.
  if (1.0 - std::cos(gravity.lean) > kLeastDifference)
    return formatted("it leans by %.0f degrees: mount it straight, or give a target_frame", gravity.lean / kDegree);
  return {};
}

}  // namespace

std::string describeFault(const ImuSurvey& imu, int axis, double moved) {
  if (imu.notMeasured() > imu.messages())
    return "its messages say that they carry no acceleration: choose another topic";
  if (!imu.isKnown()) return "too few messages to tell anything: record for longer";
  if (imu.isStill())
    return "it reads the same again and again: the sensor is stuck, or the vehicle stood still at the end";
  const RejectCounts& rejected = imu.rejected(axis);
  if (const std::string fault = describeStamps(imu, rejected); !fault.empty()) return fault;
  if (const std::uint64_t clipped = rejected.count(RejectReason::kClipped); clipped > 0)
    return formatted("%llu readings are cut off at %.1f m/s^2: set a larger range",
                     static_cast<unsigned long long>(clipped), imu.largest(axis));
  if (const std::uint64_t wild = rejected.count(RejectReason::kAbsurd) + rejected.count(RejectReason::kNotFinite);
      wild > 0)
    return formatted("%llu readings are no acceleration of a vehicle: look for a bad connection or driver",
                     static_cast<unsigned long long>(wild));
  if (const auto gravity = imu.gravity())
    if (const std::string fault = describeGravity(*gravity); !fault.empty()) return fault;
  if (moved < imu.noise(axis))
    return "its noise is as large as the motion: drive on a rougher road, or take a better sensor";
  return {};
}

}  // namespace suspension_health_monitor
