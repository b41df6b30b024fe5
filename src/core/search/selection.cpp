#include "selection.h"

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {
namespace {

constexpr double kStraight = 0.005;  // of a reading: the nonlinearity of accelerometers

}  // namespace

Selection select(const std::vector<EvaluatedModel>& ranking, const HoldOut& held_out) {
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

}  // namespace suspension_health_monitor
