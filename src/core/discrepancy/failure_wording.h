#pragma once

#include <string>

#include "suspension_health_monitor/discrepancy/readable_unit.h"
#include "suspension_health_monitor/discrepancy/where_it_fails.h"

namespace suspension_health_monitor {

/// Puts regions into words. Each function fills `region` and `sentence` from the numbers of the region.
class FailureWording {
 public:
  explicit FailureWording(const ResidualViews& views);

  void travel(FailureRegion& region) const;
  void travelRate(FailureRegion& region) const;
  void time(std::size_t record, FailureRegion& region) const;

  /// @param rate_from, rate_to  [m/s].
  void surface(double rate_from, double rate_to, FailureRegion& region) const;

  void direction(FailureRegion& region) const;
  void frequency(double structure_share, double coherence, double coherence_threshold, FailureRegion& region) const;
  void offset(FailureRegion& region) const;

  /// A parameter that moves during drive `record`. @param name  "damping" or "stiffness".
  void drift(const char* name, double first_percent, double last_percent, std::size_t record,
             FailureRegion& region) const;

  void everywhere(double noise_floor, FailureRegion& region) const;
  void nothing(double noise_floor, FailureRegion& region) const;

 private:
  std::string inDrive(std::size_t record) const;
  std::string errors(const FailureRegion& region) const;
  std::string push(double mean) const;

  ReadableUnit travel_, rate_, acceleration_, time_, frequency_;
  double travel_from_, travel_to_, rate_from_, rate_to_;  // tenths at either end
  double travel_end_, rate_end_;                          // lowest value
  double travel_top_, rate_top_;                          // highest value
  bool several_drives_;
};

}  // namespace suspension_health_monitor
