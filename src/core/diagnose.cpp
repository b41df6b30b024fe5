#include "suspension_health_monitor/diagnose.h"

#include <algorithm>

#include "prepared_drives.h"
#include "suspension_health_monitor/internal/text.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"

namespace suspension_health_monitor {

Diagnosis diagnose(const std::vector<Drive>& drives, const DiagnoseOptions& options) {
  if (options.threads < 1) refuse("threads", options.threads, "", "1 or more");
  const PreparedDrives prepared = prepareDrives(drives, options.sample_period, options.horizon_samples, options.model);
  SearchResult result;
  result.shortcoming = prepared.shortcoming;
  result.reason = prepared.reason;
  if (!result) return result;

  const Records records = pointersTo(prepared.records);
  DiagnoseOptions searched = options;
  const auto untestable = takeUntestable(searched.candidates, records);
  std::vector<std::string> of_frequency;
  if (prepared.one_frequency) of_frequency = takeFrequencyResponses(searched.candidates);
  result = searchEffects(records, prepared.start, searched, prepared.lagged);
  result.reason = reasonOf(result.shortcoming, prepared.start);
  if (!result) return result;
  result.one_frequency = prepared.one_frequency;
  if (result.one_frequency && result.verdict == Verdict::kEffectFound) result.verdict = Verdict::kSuspect;
  result.summary = summaryOf(result);
  result.remainder = remainderOf(result);
  result.suggested_drive = suggestionOf(result);
  for (const auto& [name, missing] : untestable) result.not_tried.emplace_back(name, reasonOf(missing));
  for (const std::string& name : of_frequency) result.not_tried.emplace_back(name, kOneFrequency);
  const auto has_samples = [](const Drive& drive) { return !drive.samples.empty(); };
  result.from = std::find_if(drives.begin(), drives.end(), has_samples)->samples.front().stamp;
  result.to = std::find_if(drives.rbegin(), drives.rend(), has_samples)->samples.back().stamp;
  return result;
}

}  // namespace suspension_health_monitor
