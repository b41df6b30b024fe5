#include "suspension_health_monitor/internal/record/sampling_limit.h"

#include "suspension_health_monitor/internal/statistics.h"

namespace suspension_health_monitor {

double powerAtSamplingLimit(const Records& records) {
  constexpr std::size_t length = 16;  // of the filter with the weights +1, -1, +1, ..
  double at_limit = 0.0, all = 0.0;
  for (const DriveSegment* segment : segmentsOf(records))
    for (std::size_t k = length - 1; k < segment->size(); ++k) {
      double sum = 0.0;
      for (std::size_t i = 0; i < length; ++i) sum += (i % 2 == 0 ? 1.0 : -1.0) * segment->unsprung[k - i];
      at_limit += square(sum) / static_cast<double>(length);
      all += square(segment->unsprung[k]);
    }
  return all > 0.0 ? at_limit / all : 0.0;
}

}  // namespace suspension_health_monitor
