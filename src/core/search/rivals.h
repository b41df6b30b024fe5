#pragma once

#include <string>
#include <vector>

#include "model_evaluator.h"
#include "suspension_health_monitor/internal/fit/hold_out.h"
#include "suspension_health_monitor/internal/fit/linear_response.h"
#include "suspension_health_monitor/internal/record/drive_record.h"
#include "suspension_health_monitor/strut_model.h"

namespace suspension_health_monitor {

inline constexpr const char* kTilt = "mount_tilt";

/// A sensor that is tilted by an angle reads its cosine of all that happens along the strut, gravity above all. What
/// leaks in from across need not show it: of the wheel's IMU nothing else is known.
/// @return true if a fault of the model's reading is an offset or a gain that a tilt of up to 30 degrees makes as well,
/// in drives whose sensors read gravity.
bool mayBeTilt(const StrutModel& model, const std::string& fault, const Records& records);

/// @return true if the force depends on time at some motion, or on a memory that lasts.
bool changesSlowly(const ActiveEffect& active);

/// The rival of the last law of a fit, which changes slowly: the same with the time that the frequency of the wheel's
/// motion tells, or with what it remembered at that time.
/// Where that does as well, as on a sweep, nobody can tell a part that wears from one that answers to frequency.
/// Frequency: ln of rms velocity over rms position of the wheel (motionError() of w'') in windows of four natural
/// periods. It tells the mean time of the two windows that are next in frequency; in straight lines between the
/// middles.
ForceEffect frequencyRival(const ModelFit& fit, const Records& records, double stiffness_to_mass);

/// How far a residual wanders more slowly than the strut moves [m/s^2, rms]. Any strut passes what is slow as it is, so
/// that no law of one leaves this: it is a reading that wanders, as that of a body that leans does, or of a sensor that
/// drifts. It is what the means over neighbouring windows of a natural period have in common; noise has nothing.
/// @param natural_period  [samples].
double wandering(const Residuals& residuals, double natural_period);

/// @return true if a fault of the reading makes an offset above all, and that is not larger than what wanders beside
/// it: then it is no constant, and no fault of a sensor.
bool isWanderingOffset(const Residuals& before, const Residuals& after, double natural_period);

/// How much of the body's turning goes with the strut's motion: the share of the mean square of its angular
/// acceleration, about x or y, that travel, travel rate and z'' of a model's free run tell, fitted on the training
/// samples and judged by the rest. A strut that turns its body is not alone on it: something else holds the body, and
/// what that does to the strut's top has the gyro's shape, too, without being a fault of a sensor.
/// @return 0 if the strut's motion explains none of it, or if the body's IMU measures no turning.
double shareOfTurning(const Records& records, const HoldOut& held_out, const LinearResponse& motion);

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
Selection select(const std::vector<EvaluatedModel>& ranking, const HoldOut& held_out);

/// The kind of drive on which models differ that the present drives cannot tell apart: of several kinds (rougher,
/// smoother, slower, quicker, longer) the one in which the least different of them differs most from the first, their
/// forces taken along the present motion scaled to that kind. kNoneHelps if none makes it at least twice as much.
SeparatingDrive separatingDrive(const LinearResponse& present, const Selection& selection);

}  // namespace suspension_health_monitor
