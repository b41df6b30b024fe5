#pragma once

#include <map>
#include <vector>

#include "parameterization.h"

namespace suspension_health_monitor {

/// Gives every segment the memories that last (ForceEffect::lasts) from the run over those before it, less what the
/// time between them takes. Nothing happens where none lasts.
/// @param states  that the segments begin with; the memories are replaced.
void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states);

/// The same for a fit, whose costs ask segment by segment for the same models again and again.
class CarriedMemories {
 public:
  /// @param states  travel and travel rate that the segments begin with, about.
  CarriedMemories(const Segments& segments, std::vector<StrutState> states);

  /// @return of one segment, by kMostEffects.
  const std::array<Memory, kMostEffects>& at(std::size_t segment, StrutModel& model);

 private:
  const Segments& segments_;
  std::vector<StrutState> states_;
  std::map<std::vector<double>, std::vector<StrutState>> known_;  // by the numbers of the model
};

}  // namespace suspension_health_monitor
