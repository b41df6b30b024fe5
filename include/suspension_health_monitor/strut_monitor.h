#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/monitor_options.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// Watches one strut live: readings of two accelerometers in, estimates, comparison and health out. It is all that the
/// nodelet does, without messages.
///
///     StrutMonitor monitor({}, [](const MonitorReport& report) {
///       if (report.estimate.valid()) use(report.estimate.damping_to_mass, report.estimate.stiffness_to_mass);
///     });
///     monitor.push(Side::kSprung, stamp, body_acceleration);      // as readings come, in any interleaving
///     monitor.push(Side::kUnsprung, stamp, wheel_acceleration);
///
/// Readings are aligned onto one clock (doc/alignment.md), bad ones are counted and kept out, and gaps and clocks that
/// jump begin a new series. Cost per reading: O(1) amortised, independent of the horizon; no lock. Not for two threads
/// at a time.
class StrutMonitor {
 public:
  using Sink = std::function<void(const MonitorReport&)>;

  /// @param sink  called from within push() with the report after every sample.
  /// @throws std::invalid_argument  naming the option, its value and what is allowed.
  explicit StrutMonitor(const MonitorOptions& options = {}, Sink sink = {});
  ~StrutMonitor();
  StrutMonitor(StrutMonitor&& other) noexcept;
  StrutMonitor& operator=(StrutMonitor&& other) noexcept;

  /// Takes in one reading of one sensor; each stream comes in the order in which it was measured.
  /// @param stamp  time of the measurement.
  /// @param acceleration  along the strut, up positive [m/s^2]; gravity may be in it.
  /// @throws std::invalid_argument  once, if the options or the effects do not fit the sample period that was measured:
  /// no reading counts any more. What the sink throws comes out, too; no reading is lost by it.
  void push(Side side, Stamp stamp, double acceleration);

  /// Has these effects in the model from now on, none: the plain strut. Estimates carry over; coefficients are start
  /// values. Allocates.
  /// @param strut  b1 and b0 that belong to these coefficients, if they are known.
  /// @throws std::invalid_argument  naming what is wrong with the effects; the model then stays as it was.
  void setEffects(const std::vector<ActiveEffect>& effects, const std::optional<LinearStrut>& strut = {});

  /// Judges health by this from now on.
  /// @throws std::invalid_argument  if a value of it is not above 0 and finite.
  void setBaseline(const Baseline& baseline);

  /// @return what health is judged by; empty as long as nothing was given or learned.
  Baseline baseline() const;

  /// @return what is known after the newest sample.
  MonitorReport report() const;

  /// @return what is known of the tyre; nothing without MonitorOptions::tyre.
  std::optional<TyreReport> tyre() const;

  InputStatus input() const;

  /// @return readings that were kept out so far, by reason; only reasons that occurred.
  std::map<std::string, std::uint64_t> rejected() const;

  /// @return T [s]; nothing while it is being measured.
  std::optional<double> samplePeriod() const;

 private:
  std::unique_ptr<class VehiclePipeline> pipeline_;
};

}  // namespace suspension_health_monitor
