#pragma once

#include <string>
#include <vector>

#include "model_evaluator.h"

namespace suspension_health_monitor {

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
