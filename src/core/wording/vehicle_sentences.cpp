#include "suspension_health_monitor/internal/wording/vehicle_sentences.h"

#include <algorithm>
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

// "friction (or digressive_damping)": what the drives cannot tell from it, too.
std::string namesOf(const Diagnosis& strut) {
  std::string text = join(strut.selected, " and ");
  for (const std::vector<std::string>& group : strut.indistinguishable) {
    std::vector<std::string> rivals;
    for (const std::string& name : group)
      if (std::find(strut.selected.begin(), strut.selected.end(), name) == strut.selected.end()) rivals.push_back(name);
    if (!rivals.empty()) text += " (or " + join(rivals, " or ") + ")";
  }
  return text;
}

}  // namespace

std::string whyNotCoupled(const VehicleMistake& mistake, const std::vector<std::string>& struts) {
  using Kind = VehicleMistake::Kind;
  if (mistake.kind == Kind::kTooLittle)
    return "are too short or too calm to tell how the struts move one another: drive on, or use a rougher road";
  if (mistake.kind == Kind::kAlike)
    return "cannot tell " + struts[mistake.struts.first] + " from " + struts[mistake.struts.second] +
           ": their wheels move alike. Drive over bumps on one side";
  if (mistake.kind == Kind::kNone)
    return "are too calm for these sensors to tell how the struts move one another, and show no mistake in the vehicle "
           "file: drive on, or use a rougher road";
  return "do not fit the vehicle file: " + describe(mistake, struts);
}

std::string describe(const VehicleMistake& mistake, const std::vector<std::string>& struts) {
  using Kind = VehicleMistake::Kind;
  const auto name = [&](std::size_t i) { return i < struts.size() ? struts[i] : std::string(); };
  const std::string first = name(mistake.struts.first), second = name(mistake.struts.second);
  const auto position = [&](const char* axis, const std::string& of) {
    const std::string where = std::string(axis) + " in " + of;
    if (mistake.size < 0.0) return "with the other sign of " + where + " they do";
    return formatted("with %s times %.2f (+- %.2f) they do", where.c_str(), mistake.size, mistake.stddev);
  };
  const auto shifted = [&](const char* axis) {
    return formatted("with %+.2f m (+- %.2f) in %s of all positions they do: the body's IMU stands elsewhere",
                     mistake.size, mistake.stddev, axis);
  };
  const std::string by = mistake.size > 0.0 ? "earlier" : "later", other = mistake.size > 0.0 ? "later" : "earlier";
  const auto late = [&](const std::string& sensor, const std::string& or_else = "") {
    return formatted("with the stamps of %s %.1f ms (+- %.1f) %s%s they do: its clock, its driver's delay",
                     sensor.c_str(), 1000.0 * std::abs(mistake.size), 1000.0 * mistake.stddev, by.c_str(),
                     or_else.c_str());
  };
  const std::string all = "all positions", of_first = "the position of " + first;
  switch (mistake.kind) {
    case Kind::kNone:
    case Kind::kTooLittle:
    case Kind::kAlike: return "";
    case Kind::kSameWheels: return "the wheel topics of " + first + " and " + second + " carry the same data";
    case Kind::kSameTops: return "the sprung IMUs of " + first + " and " + second + " carry the same data";
    case Kind::kSwapped:
      return "with the wheel topics of " + first + " and " + second +
             " swapped they do: swap these, or what the file says of the two strut tops";
    case Kind::kUpsideDown: return "with the wheel of " + first + " the other way up they do: turn its axis round";
    case Kind::kAhead:
      return position("x", all) + (mistake.size < 0.0 ? ": front and rear are swapped, or the body's IMU is" : "");
    case Kind::kSide:
      return position("y", all) + (mistake.size < 0.0 ? ": left and right are swapped, or the body's IMU is" : "");
    case Kind::kAheadOfOne: return position("x", of_first);
    case Kind::kSideOfOne: return position("y", of_first);
    case Kind::kShiftAhead: return shifted("x");
    case Kind::kShiftSide: return shifted("y");
    case Kind::kWheelDelay: return late("the wheel of " + first);
    case Kind::kTopDelay: return late("the sprung IMU of " + first);
    case Kind::kTopsDelay: return late("all sprung IMUs", ", or those of all wheels as much " + other + ",");
    case Kind::kBodyDelay: return late("the body's IMU");
    case Kind::kDeadGyro:
      return "the body's IMU tells of no pitch or no roll, though the wheels differ: dead gyro, wrong axis, or wrong "
             "positions of the struts";
    case Kind::kOthers:
      return formatted(
          "the wheels in it leave %.0f %% of the body's motion unexplained: a strut that is missing in the file, a "
          "wrong topic, or something else that moves the body",
          100.0 * mistake.unexplained);
  }
  return "";
}

std::string describe(InertiaDoubt doubt) {
  const std::string begin = "cannot tell M/Iyy and M/Ixx: ";
  switch (doubt) {
    case InertiaDoubt::kNone: return "";
    case InertiaDoubt::kNoPositions: return begin + "a strut has no position";
    case InertiaDoubt::kOnOneLine: return begin + "it takes three struts that do not stand on one line";
    case InertiaDoubt::kUncertain: return begin + "the rows are too uncertain, or do not fit the positions";
  }
  return "";
}

std::string describe(const BodyLevel& level) {
  if (!level.isTurned()) return "";
  return "the body's IMU leans by " + std::to_string(std::lround(level.lean / kDegree)) +
         " degrees: gravity tells which way is up; positions are in its own axes";
}

std::string describe(const MountClaim::Finding& mount, const std::string& name, const char* setting) {
  if (mount.isOnAnotherAxis())
    return formatted("gravity of %s is on another axis: give %s: %s", name.c_str(), setting,
                     std::string(mount.name()).c_str());
  std::vector<std::string> faults;
  if (mount.isLeaning())
    faults.push_back(
        formatted("leans by %.0f degrees and reads %.2f of the motion along its strut: turn it, or give "
                  "target_frame",
                  mount.lean / kDegree, std::cos(mount.lean)));
  if (readsInG(mount.size))
    faults.push_back("reads about 1 where gravity is 9.81: it is in g, must be in m/s^2");
  else if (mount.isWrongSize())
    faults.push_back(formatted("reads gravity as %.2f m/s^2: gain %.2f", mount.size, mount.size / kStandardGravity));
  return faults.empty() ? "" : name + " " + join(faults, " and ");
}

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
  if (!imu.tellsGravity()) return "too short to tell which axis is up: record half a minute of driving";
  if (const auto gravity = imu.gravity())
    if (const std::string fault = describeGravity(*gravity); !fault.empty()) return fault;
  if (moved < imu.noise(axis))
    return "its noise is as large as the motion: drive on a rougher road, or take a better sensor";
  return {};
}

std::string summaryOf(const VehicleDiagnosis& diagnosis, const std::vector<std::string>& struts) {
  std::vector<std::string> missing, suspects, unexplained, silent;
  for (std::size_t i = 0; i < struts.size(); ++i) {
    const Diagnosis& strut = diagnosis.struts[i];
    if (!strut)
      silent.push_back(struts[i]);
    else if (strut.verdict == Verdict::kEffectFound)
      missing.push_back(namesOf(strut) + " in " + struts[i]);
    else if (strut.verdict == Verdict::kSuspect)
      suspects.push_back(namesOf(strut) + " in " + struts[i]);
    else if (strut.verdict == Verdict::kUnexplained)
      unexplained.push_back(struts[i]);
  }
  for (const AntiRollBarFound& bar : diagnosis.coupling.bars)
    missing.push_back(std::string(kAntiRollBar) + " between " + struts[bar.first] + " and " + struts[bar.second]);
  std::vector<std::string> sentences;
  if (!missing.empty()) sentences.push_back("Missing from the model: " + join(missing) + ".");
  if (!suspects.empty()) sentences.push_back("Main suspect: " + join(suspects) + ".");
  if (!unexplained.empty())
    sentences.push_back("Something that no known effect explains is " +
                        (sentences.empty() ? "missing in " + join(unexplained) + "."
                                           : "left in " + join(unexplained) +
                                                 ": missing there, or carried over from the strut that lacks more."));
  if (!silent.empty()) sentences.push_back("Nothing can be said of " + join(silent) + ".");
  if (sentences.empty()) return "Nothing is missing in any strut: what the models leave is noise.";
  return join(sentences, " ");
}

}  // namespace suspension_health_monitor
