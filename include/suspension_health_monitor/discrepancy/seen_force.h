#pragma once

#include <cstddef>
#include <vector>

#include "suspension_health_monitor/discrepancy/drive_record.h"
#include "suspension_health_monitor/model/strut_model.h"

namespace suspension_health_monitor {

/// What a force may be a function of.
enum class ForceVariable { kTravel, kTravelRate, kTime };

/// Force per unit mass where its variable lies in a narrow range.
struct SeenForceBin {
  double at = 0.0;         ///< middle of the range [m], [m/s] or [s]
  double mean = 0.0;       ///< seen [m/s^2]
  double deviation = 0.0;  ///< standard deviation of what was seen [m/s^2]
  double law = 0.0;        ///< mean by the law, c f, at the same samples [m/s^2]
  std::size_t count = 0;   ///< samples
};

/// The same over a plane: cell (i, j) between first_edges[i, i + 1] and second_edges[j, j + 1]; without samples count
/// 0.
struct SeenForceGrid {
  std::vector<double> first_edges, second_edges;
  std::vector<std::vector<SeenForceBin>> cells;
};

/// One effect's force as the measurement shows it, beside what the law says.
///
/// Seen is what the model lacks (ComparedSegment::missing_force) plus the effect's own part c f: the force that is
/// there beside everything else in the model. It does not hang on c being right. A law that is right lies in the middle
/// of what is seen, over the whole range; one that only helps does not. After W. A. Larsen, S. J. McCleary,
/// Technometrics 14 (1972), 781-790 (partial residual plots).
struct SeenForce {
  ActiveEffect effect;
  std::vector<ForceVariable> variables;  ///< that decide the force: one or two; of a law with memory the travel
  std::vector<SeenForceBin> curve;       ///< over the only variable; of a law with memory while compressing
  std::vector<SeenForceBin> back;        ///< of a law with memory while extending, else empty
  SeenForceGrid grid;                    ///< over two variables, else empty

  bool hasMemory() const { return static_cast<bool>(effect.effect.memory_rate); }

  /// c f at a value of the only variable [m/s^2].  @pre variables.size() == 1 and no memory.
  double lawAt(double value) const;
};

/// @param initial  per segment of all records.
/// @return one per effect of the model, in its order; what the reading does is no force. None if the model runs away.
std::vector<SeenForce> seeForces(const std::vector<const DriveRecord*>& records, const StrutModel& model,
                                 const std::vector<StrutState>& initial);

}  // namespace suspension_health_monitor
