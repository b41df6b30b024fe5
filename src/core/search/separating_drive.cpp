#include "separating_drive.h"

#include <algorithm>
#include <limits>

namespace suspension_health_monitor {
namespace {

/// How the motion of a kind of drive compares with that of the present one.
struct MotionChange {
  DriveKind kind;
  double travel, travel_rate, time;
};

constexpr MotionChange kPresent{DriveKind::kNoneHelps, 1.0, 1.0, 1.0};
constexpr MotionChange kChanges[] = {
    {DriveKind::kMoreTravel, 2.0, 2.0, 1.0},   {DriveKind::kLessTravel, 1.0 / 3.0, 1.0 / 3.0, 1.0},
    {DriveKind::kSlower, 1.0, 1.0 / 3.0, 1.0}, {DriveKind::kQuicker, 1.0, 3.0, 1.0},
    {DriveKind::kLonger, 1.0, 1.0, 3.0},
};
constexpr double kHelps = 2.0;  // times as different as in the drives at hand

std::vector<StrutMotion> scaled(const std::vector<StrutMotion>& motion, const MotionChange& change) {
  std::vector<StrutMotion> result = motion;
  for (StrutMotion& m : result) {
    m.travel *= change.travel;
    m.travel_rate *= change.travel_rate;
    m.time *= change.time;
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
double difference(const LinearResponse& present, const std::vector<StrutModel>& models, const MotionChange& change) {
  const std::vector<StrutMotion> motion = scaled(present.motion(), change);
  const Eigen::VectorXd first = totalForce(models.front(), motion, present.ends());
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < models.size(); ++i)
    least = std::min(least, (totalForce(models[i], motion, present.ends()) - first).norm() / first.norm());
  return least;
}

}  // namespace

SeparatingDrive separatingDrive(const LinearResponse& present, const std::vector<std::string>& names,
                                const std::vector<StrutModel>& models) {
  SeparatingDrive best{names, DriveKind::kNoneHelps, 0.0, difference(present, models, kPresent)};
  best.difference_there = kHelps * best.difference_here;
  for (const MotionChange& change : kChanges) {
    const double there = difference(present, models, change);
    if (!(there > best.difference_there)) continue;
    best.kind = change.kind;
    best.difference_there = there;
  }
  return best;
}

}  // namespace suspension_health_monitor
