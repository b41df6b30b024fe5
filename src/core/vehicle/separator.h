#pragma once

#include <optional>
#include <string>
#include <vector>

#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

/// Struts with what is known of them, to be separated again as more is known.
class Separator {
 public:
  /// @param drives  must outlive this object.
  Separator(const std::vector<VehicleDrive>& drives, const std::vector<std::string>& names,
            const std::optional<double>& sample_period, const KnownModels& known = {});

  const VehicleCoupling& coupling() const { return coupling_; }
  const std::vector<StrutModel>& models() const { return models_; }
  double period() const { return period_; }

  void setModel(std::size_t strut, const StrutModel& model) { models_[strut] = model; }

  /// @return true if one IMU tells of the tops of several struts.
  bool sharesNoise() const;

  /// Fits the models of these struts to the drives as an estimator sees them, and takes them from then on.
  /// @return what was fitted; nothing where that failed.
  std::vector<std::optional<ModelFit>> fitModels(const std::vector<std::size_t>& struts);

  /// By strut and drive, as an estimator sees them.
  std::vector<std::vector<Drive>> separate() const;

  /// The same without what the models as they are now tell of the noise of shared sensors, for a search. Their errors
  /// are in there instead, of which an estimator's standard deviations would know nothing.
  std::vector<std::vector<Drive>> separateForSearch() const;

 private:
  void learnRows(const std::vector<std::string>& names);
  bool isUndersampled() const;
  std::vector<StrutDrives> separateAll() const;

  const std::vector<VehicleDrive>& drives_;
  double period_;
  BodyRows rows_;
  VehicleCoupling coupling_;
  std::vector<StrutModel> models_;
  StrutDrives noise_;  // empty without a coupling
};

}  // namespace suspension_health_monitor
