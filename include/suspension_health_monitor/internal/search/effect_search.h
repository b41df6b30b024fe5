#pragma once

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/record/motion.h"

namespace suspension_health_monitor {

/// Kinds of a drive that would tell models apart, see separatingDrive().
enum class DriveKind { kNoneHelps, kMoreTravel, kLessTravel, kSlower, kQuicker, kLonger, kAtRest };

/// The drive that would tell a group of effects apart best.
struct SeparatingDrive {
  std::vector<std::string> group;  ///< names of the effects
  DriveKind kind = DriveKind::kNoneHelps;
  double difference_there = 0.0;  ///< rms difference of the least different laws, as a share of the strut's force
  double difference_here = 0.0;
};

/// A diagnosis without the words for people.
struct SearchResult : Diagnosis {
  std::vector<SeparatingDrive> separating;  ///< one per group that the drives cannot tell apart
  double folded_share = 0.0;                ///< without a name: rms of foldedMotion() over that of the structure
  bool turns_body = false;                  ///< without a name: the strut turns its body, so that it is not alone on it
  double remainder_surface_share = 0.0;     ///< of what a suspect leaves, what a free-form force would take
  std::optional<MotionRange> one_frequency;  ///< if all motion is at one: no name is certain
};

/// diagnose() of drives that are prepared already.
/// @param start  a damped spring, e.g. of LS: effects that it has stay.
/// @param options  its period, horizon and model are not looked at.
/// @param lagged  where a fit with clock_offset may begin, see rough_strut.h. With it the search goes on even where no
/// stable strut fits the drives without it: the base is then b1 and b0 of `lagged` as they are.
SearchResult searchEffects(const Records& records, const StrutModel& start, const DiagnoseOptions& options = {},
                           const std::optional<StrutModel>& lagged = {});

}  // namespace suspension_health_monitor
