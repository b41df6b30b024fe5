#pragma once

#include <optional>
#include <string>

#include "shell_options.h"
#include "suspension_health_monitor/internal/monitor/suspension_monitor.h"

namespace suspension_health_monitor {

/// The healthy strut of a live monitor and the file that keeps it (baseline_file, YAML).
class LiveBaseline {
 public:
  /// Reads baseline_file if it is there.
  /// @throws std::invalid_argument  naming the file, what is wrong in it and what is allowed, or nominal values given
  ///         beside the file: which of the two holds must not be left to guessing.
  explicit LiveBaseline(const PipelineOptions& options);

  /// @return the baseline to judge by; empty: nominal values, or none is known yet.
  const std::optional<Baseline>& known() const { return known_; }

  /// @return what health is judged by, in words.
  std::string reference(const MonitorOptions& options) const;

  /// Keeps what the monitor has learned, if it is new, and writes it to the file if there is one.
  /// @return what to tell a person; empty: nothing is new.
  /// @throws std::runtime_error  naming the file that cannot be written; it is not tried again.
  std::string keepLearned(const SuspensionMonitor& monitor);

  /// Takes LA's valid estimate as the baseline and writes it to the file.
  /// @param monitor  nullptr: none yet.
  /// @throws std::runtime_error  if there is no valid estimate or a too uncertain one to prove damage by, if no file is
  ///         given, or it cannot be written.
  void save(const SuspensionMonitor* monitor);

 private:
  void write(const Baseline& baseline, const SuspensionMonitor& monitor) const;

  std::string path_;
  std::optional<Baseline> known_;
};

/// Why a monitor has no model and no baseline to write.
inline constexpr const char* kNothingToSave = "nothing to save yet: the monitor has no valid estimate, drive on";

/// The file's text.
std::string toYaml(const Baseline& baseline, double horizon, double sample_period);

/// Takes a baseline out of the settings of a file.
/// @throws std::invalid_argument  naming what is missing, unknown or wrong.
Baseline takeBaseline(OptionMap& values);

/// @return true for settings with nominal values, in any group: a baseline file has none.
bool areSettings(const OptionMap& values);

/// @param file  of the baseline; empty: it has none.
/// @throws std::invalid_argument  if nominal values are given beside a baseline.
void requireOneReference(const std::string& file, const MonitorOptions& options);

}  // namespace suspension_health_monitor
