#pragma once

#include <string>
#include <vector>

#include "model_evaluator.h"

namespace suspension_health_monitor {

/// The best of a ranking, or the simplest that is as good, and all that are as good.
struct Selection {
  EvaluatedModel chosen;
  std::vector<std::string> group;
  std::vector<StrutModel> models;  ///< of the group
};

/// A number more must pay as surely as another effect: a simpler rival is as good until it is clear that it is not.
/// @pre the first of the ranking is fitted.
Selection select(const std::vector<EvaluatedModel>& ranking);

}  // namespace suspension_health_monitor
