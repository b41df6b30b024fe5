#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "model_evaluator.h"
#include "suspension_health_monitor/internal/base/corner_sample.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/math/statistics.h"

namespace suspension_health_monitor {

inline constexpr const char* kTilt = "mount_tilt";

/// A sensor that is tilted by an angle reads its cosine of all that happens along the strut, gravity above all. What
/// leaks in from across need not show it: of the wheel's IMU nothing else is known.
/// @return true if a fault of the model's reading is an offset or a gain that a tilt of up to 30 degrees makes as well,
/// in drives whose sensors read gravity.
inline bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records) {
  const bool is_read = std::all_of(records.begin(), records.end(), [](const DriveRecord* record) {
    return record->gravity() > 0.5 * kStandardGravity;
  });
  const double lost_by_30_degrees = 1.0 - std::cos(M_PI / 6.0);
  const double unit = fault == "accelerometer_bias" ? kStandardGravity : fault == "scale_error" ? 1.0 : 0.0;
  return is_read && std::any_of(model.reading.begin(), model.reading.end(), [&](const ActiveMeasurementEffect& active) {
           return active.effect.name == fault && std::abs(active.coefficients.front()) < lost_by_30_degrees * unit;
         });
}

inline constexpr double kStraight = 0.005;  // of a reading: the nonlinearity of accelerometers

/// How many times as large the motion of a kind of drive is as that of the present one.
inline constexpr std::pair<DriveKind, MotionScale> kDriveChanges[] = {
    {DriveKind::kMoreTravel, {2.0, 2.0, 1.0}},   {DriveKind::kLessTravel, {1.0 / 3.0, 1.0 / 3.0, 1.0}},
    {DriveKind::kSlower, {1.0, 1.0 / 3.0, 1.0}}, {DriveKind::kQuicker, {1.0, 3.0, 1.0}},
    {DriveKind::kLonger, {1.0, 1.0, 3.0}},
};

inline Eigen::VectorXd totalForce(const StrutModel& model, const SegmentedMotion& motion) {
  const Eigen::MatrixXd forces = forcesAlong(model, motion);
  Eigen::VectorXd total = model.damping_to_mass * forces.col(0) + model.stiffness_to_mass * forces.col(1);
  for (std::size_t j = 0; j < model.effects.size(); ++j) total += model.effects[j].coefficient * forces.col(2 + j);
  return total;
}

/// rms difference of the least different model from the first, as a share of the first one's force.
/// @param motion  of the present drives.  @param change  its factors.
inline double leastDifference(SegmentedMotion motion, const std::vector<StrutModel>& models,
                              const MotionScale& change) {
  for (StrutMotion& m : motion.samples) {
    m.travel *= change.travel;
    m.travel_rate *= change.travel_rate;
    m.time *= change.time;
  }
  const Eigen::VectorXd first = totalForce(models.front(), motion);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < models.size(); ++i)
    least = std::min(least, (totalForce(models[i], motion) - first).norm() / first.norm());
  return least;
}

/// The best of a ranking, or the simplest that is as good, and all that cannot be told from the best.
struct Selection {
  EvaluatedModel chosen;
  std::vector<std::string> group;
  std::vector<StrutModel> models;  ///< of the group
};

/// A number more must pay as surely as another effect: a simpler rival is as good until it is clear that it is not.
/// A rival whose z'' is hardly another one cannot be told from the best, however sure a long drive would be: no sensor
/// is as straight, and what a filter before the sampling makes of a law may be what another law says (dry friction
/// turns round as a digressive damper does).
/// @pre the first of the ranking is fitted.
inline Selection select(const std::vector<EvaluatedModel>& ranking, const HoldOut& held_out) {
  const EvaluatedModel& best = ranking.front();
  Selection selection{best, {}, {}};
  for (const EvaluatedModel& rival : ranking) {
    if (!rival.ranked.fitted) continue;
    const bool simpler = complexity(rival.ranked.model) < complexity(best.ranked.model);
    const double chance = simpler ? kFalseAlarm / static_cast<double>(ranking.size()) : kSure;
    const PairedTest gain = rival.gainOf(best);
    const bool is_resolved = rival.loss - best.loss > square(kStraight) * held_out.measuredSquares();
    const bool is_worse = gain.removed_share > kWorthHaving || isSignificant(gain, chance);
    if (is_worse && is_resolved) continue;
    selection.group.push_back(rival.added);
    selection.models.push_back(rival.ranked.model);
    if (!is_worse && complexity(rival.ranked.model) < complexity(selection.chosen.ranked.model))
      selection.chosen = rival;
  }
  return selection;
}

/// The kind of drive on which models differ that the present drives cannot tell apart: of several kinds (rougher,
/// smoother, slower, quicker, longer) the one in which the least different of them differs most from the first, their
/// forces taken along the present motion scaled to that kind. kNoneHelps if none makes it at least twice as much.
inline SeparatingDrive separatingDrive(const SegmentedMotion& present, const Selection& selection) {
  const double here = leastDifference(present, selection.models, {1.0, 1.0, 1.0});
  SeparatingDrive best{selection.group, DriveKind::kNoneHelps, kClearlyMore * here, here};
  for (const auto& [kind, change] : kDriveChanges) {
    const double there = leastDifference(present, selection.models, change);
    if (!(there > best.difference_there)) continue;
    best.kind = kind;
    best.difference_there = there;
  }
  return best;
}

/// Adds to what is to be told apart, if a group has more than one member or a tilt may be all.
inline void noteGroup(const Selection& selection, const Records& records, std::vector<SeparatingDrive>& separating) {
  if (mayBeTilt(selection.chosen.ranked.model, selection.chosen.added, records)) {
    Names group = selection.group;
    if (!contains(group, kTilt)) group.emplace_back(kTilt);
    separating.push_back({group, DriveKind::kAtRest, 0.0, 0.0});
    return;
  }
  if (selection.group.size() > 1)
    separating.push_back(separatingDrive(LinearResponse(records, selection.chosen.fit).motion(), selection));
}

}  // namespace suspension_health_monitor
