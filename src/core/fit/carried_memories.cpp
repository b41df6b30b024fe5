#include "carried_memories.h"

#include <algorithm>
#include <utility>

namespace suspension_health_monitor {
namespace {

bool hasLasting(const StrutModel& model) {
  return std::any_of(model.effects.begin(), model.effects.end(),
                     [](const ActiveEffect& active) { return active.effect.lasts; });
}

}  // namespace

void carryMemories(const StrutModel& model, const Segments& segments, std::vector<StrutState>& states) {
  if (!hasLasting(model)) return;
  std::vector<double> predicted;
  std::vector<StrutState> motion;
  for (std::size_t s = 0; s + 1 < segments.size(); ++s) {
    if (!runFree(model, *segments[s], states[s], predicted, &motion)) return;
    states[s + 1].memory = motion.back().memory;
    keepLasting(model, restBetween(*segments[s], *segments[s + 1]), states[s + 1].memory);
  }
}

CarriedMemories::CarriedMemories(const Segments& segments, std::vector<StrutState> states)
    : segments_(segments), states_(std::move(states)) {}

const std::array<Memory, kMostEffects>& CarriedMemories::at(std::size_t segment, StrutModel& model) {
  if (segment == 0 || !hasLasting(model)) return states_[segment].memory;
  std::vector<double> numbers;
  for (const double* number : valuesOf(model)) numbers.push_back(*number);
  if (known_.size() > 2 * numbers.size()) known_.clear();  // a point and its derivatives, and the point before
  const auto [known, is_new] = known_.try_emplace(std::move(numbers), states_);
  if (is_new) carryMemories(model, segments_, known->second);
  return known->second[segment].memory;
}

}  // namespace suspension_health_monitor
