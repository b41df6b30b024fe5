#include "suspension_health_monitor/compare.h"

#include "prepared_drives.h"
#include "suspension_health_monitor/internal/compare/comparison.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

Comparison compare(const std::vector<Drive>& drives, const CompareOptions& options) {
  const PreparedDrives prepared = prepareDrives(drives, options.sample_period, options.horizon_samples, options.model);
  Comparison comparison;
  comparison.shortcoming = prepared.shortcoming;
  comparison.reason = prepared.reason;
  if (!comparison) return comparison;
  comparison = compareModel(pointersTo(prepared.records), prepared.start, options);
  comparison.reason = reasonOf(comparison.shortcoming, prepared.start);
  if (comparison) describeFailures(comparison.views, comparison.noise_floor, comparison.where);
  return comparison;
}

}  // namespace suspension_health_monitor
