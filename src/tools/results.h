#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

// What commands find, for people (print...) and for programs (toJson).

/// Estimates over time, a line per report; "-" for what is not known.
void printTable(const std::vector<MonitorReport>& reports);

/// @param name  of the estimator.  @param mass  of the body [kg], for damping and stiffness in SI.
void printResult(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass);

/// Over the whole drive, which is what to trust; then LS and LA at its end.
void printEstimates(const IdentifyResult& found, const std::optional<double>& mass);

/// @param change  how the strut is against the healthy one, in a sentence; an empty one is not printed.
void printChange(const std::string& change);

nlohmann::json toJson(const StrutEstimate& estimate);
nlohmann::json toJson(const IdentifyResult& found, const std::string& change);

/// @param estimate, strut  by the same estimator.
void printTyre(const char* name, const WheelEstimate& estimate, const StrutEstimate& strut);
nlohmann::json toJson(const WheelEstimate& estimate, const StrutEstimate& strut);

/// What a search found: the verdict in a sentence, the ranked table, before and after.
void printSearch(const Diagnosis& found);
nlohmann::json toJson(const Diagnosis& found);

/// A comparison: the errors by name, where the model fails in sentences, the force that it lacks as a map; for programs
/// the numbers behind every view.
void printComparison(const Comparison& comparison);
nlohmann::json toJson(const Comparison& comparison);

/// Adds "parameters", "coefficients" and "shapes" by name.
void addNumbers(const StrutModel& model, nlohmann::json& into);

/// How the struts move one another; nothing of a strut alone.
void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names);

/// @return what all commands tell programs: which topics were silent and, of a vehicle, how the struts move one
/// another, with `struts` to be filled.
nlohmann::json wholeJson(const AskedVehicle& vehicle, const VehicleCoupling& coupling, const TopicGaps& gaps);

/// How the body's mass is spread.
void printBody(const BodyInertiaResult& found);
nlohmann::json toJson(const BodyInertiaResult& found);

}  // namespace suspension_health_monitor
