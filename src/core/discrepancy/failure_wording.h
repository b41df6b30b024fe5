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
  /// @param coherence  of residual and w'' in the band.
  void frequency(double coherence, double coherence_threshold, FailureRegion& region) const;
  void offset(FailureRegion& region) const;

  /// A parameter that moves during drive `record`. @param name  "damping" or "stiffness".
  void drift(const char* name, double first_percent, double last_percent, std::size_t record,
             FailureRegion& region) const;

  void everywhere(double noise_floor, FailureRegion& region) const;
  void nothing(double noise_floor, FailureRegion& region) const;

 private:
  /// The range of a quantity, and where the tenth of the samples at either end begins.
  struct Ends {
    explicit Ends(const std::vector<ResidualBin>& bins);
    double lowest, from, to, highest;
  };

  static bool isZero(double value, const Ends& ends);
  void describe(const std::string& where, const std::string& name, const ReadableUnit& unit, const Ends& ends,
                FailureRegion& region) const;
  std::string inDrive(std::size_t record) const;
  std::string errors(const FailureRegion& region) const;
  std::string push(double mean) const;

  Ends travel_ends_, rate_ends_;
  ReadableUnit travel_, rate_, acceleration_, time_, frequency_;
  bool several_drives_;
};

}  // namespace suspension_health_monitor
