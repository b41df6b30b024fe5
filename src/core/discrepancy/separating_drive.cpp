#include "separating_drive.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

/// How the motion of a kind of drive compares with that of the present one.
struct DriveKind {
  const char* words;
  double travel, travel_rate, time;
};

constexpr DriveKind kPresent{"the drives at hand", 1.0, 1.0, 1.0};
constexpr DriveKind kKinds[] = {
    {"a rougher road or more speed, with twice the travel", 2.0, 2.0, 1.0},
    {"a smooth road, with a third of the travel", 1.0 / 3.0, 1.0 / 3.0, 1.0},
    {"slow and long bumps, with the same travel at a third of the rate", 1.0, 1.0 / 3.0, 1.0},
    {"short and hard bumps, with the same travel at three times the rate", 1.0, 3.0, 1.0},
    {"a drive three times as long", 1.0, 1.0, 3.0},
};
constexpr double kHelps = 2.0;               // times as different as in the drives at hand
constexpr double kUndersampled = 0.25;       // power at half the sampling rate
constexpr double kLawOfTravelAndRate = 0.5;  // share of the structure from which on it is one

std::vector<StrutMotion> scaled(const std::vector<StrutMotion>& motion, const DriveKind& kind) {
  std::vector<StrutMotion> result = motion;
  for (StrutMotion& m : result) {
    m.travel *= kind.travel;
    m.travel_rate *= kind.travel_rate;
    m.time *= kind.time;
  }
  return result;
}

Eigen::VectorXd totalForce(const StrutModel& model, const std::vector<StrutMotion>& motion,
                           const std::vector<std::size_t>& ends) {
  Eigen::VectorXd force(static_cast<Eigen::Index>(motion.size()));
  for (std::size_t k = 0; k < motion.size(); ++k)
    force[static_cast<Eigen::Index>(k)] =
        model.damping_to_mass * motion[k].travel_rate + model.stiffness_to_mass * motion[k].travel;
  for (const ActiveEffect& active : model.effects)
    force += active.coefficient * forceAlong(active.effect, active.shapes, motion, ends);
  return force;
}

/// rms difference of the least different model from the first, as a share of the first one's force.
double difference(const LinearResponse& present, const std::vector<StrutModel>& models, const DriveKind& kind) {
  const std::vector<StrutMotion> motion = scaled(present.motion(), kind);
  const Eigen::VectorXd first = totalForce(models.front(), motion, present.ends());
  double least = 1e300;
  for (std::size_t i = 1; i < models.size(); ++i)
    least = std::min(least, (totalForce(models[i], motion, present.ends()) - first).norm() / first.norm());
  return least;
}

std::string percent(double share) {
  const double value = 100.0 * share;
  const std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + (value < 10.0 ? 2 : 0)) + " %";
}

}  // namespace

std::string suggestSeparatingDrive(const LinearResponse& present, const std::vector<std::string>& names,
                                   const std::vector<StrutModel>& models) {
  std::string group;
  for (std::size_t i = 0; i < names.size(); ++i)
    group += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  const double now = difference(present, models, kPresent);
  const DriveKind* best = nullptr;
  double most = kHelps * now;
  for (const DriveKind& kind : kKinds) {
    const double there = difference(present, models, kind);
    if (!(there > most)) continue;
    best = &kind;
    most = there;
  }
  if (best == nullptr) return "No other kind of drive would tell " + group + " apart much better: look at the strut.";
  return "To tell " + group + " apart, record " + best->words + ": there their forces differ by " + percent(most) +
         " of the strut's force, against " + percent(now) + " here.";
}

std::string suggestDriveForUnexplained(double surface_share, double power_at_limit) {
  if (power_at_limit > kUndersampled)
    return "The wheel still shakes at half the sampling rate, so that a part of its motion is lost to any model: "
           "record "
           "at twice the rate.";
  if (surface_share > kLawOfTravelAndRate)
    return "A force that depends on travel and travel rate alone would explain " + percent(surface_share) +
           " of what is missing: describe it as a law of your own and diagnose again.";
  return "A force of travel and travel rate would explain only " + percent(surface_share) +
         " of what is missing. Drive the same road again with engine and load at rest, and at another speed: a force "
         "that does not come through the strut keeps its own time and size.";
}

}  // namespace suspension_health_monitor
