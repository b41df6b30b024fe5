#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "bag_options.h"
#include "result_fields.h"
#include "suspension_health_monitor/compare.h"
#include "suspension_health_monitor/internal/monitor/tyre_tracker.h"
#include "suspension_health_monitor/internal/vehicle/body_fit.h"
#include "suspension_health_monitor/vehicle.h"

namespace suspension_health_monitor {

// What commands find, for people (print...) and for programs (toJson).

inline constexpr double kNinetyPercent = 1.645;  ///< standard deviations

/// @return a result as an object with its fields by name, where an empty optional field is left out; a matrix as a list
/// of rows, a stamp in seconds, a level or verdict by its name.
template <class Value>
json jsonOf(const Value& value);

template <class Item>
json jsonOf(const std::vector<Item>& items) {
  json list = json::array();
  for (const Item& item : items) list.push_back(jsonOf(item));
  return list;
}

/// @return null if there is none: the field is left out.
template <class Value>
json jsonOf(const std::optional<Value>& value) {
  return value ? jsonOf(*value) : json();
}

template <class Value>
json jsonOf(const Value& value) {
  if constexpr (Fields<Value>::value) {
    json into;
    Fields<Value>::forEach([&](const char* name, auto field) {
      if (json its = jsonOf(value.*field); !its.is_null()) into[name] = std::move(its);
    });
    return into;
  } else if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>) {
    json rows = json::array();
    for (Eigen::Index i = 0; i < value.rows(); ++i) {
      rows.push_back(json::array());
      for (Eigen::Index j = 0; j < value.cols(); ++j) rows.back().push_back(value(i, j));
    }
    return rows;
  } else if constexpr (std::is_same_v<Value, Stamp>) {
    return toSeconds(value);
  } else if constexpr (std::is_enum_v<Value>) {
    return nameOf(value);
  } else {
    return value;
  }
}

/// Estimates over time, a line per report; "-" for what is not known.
void printTable(const std::vector<MonitorReport>& reports);

/// @param name  of the estimator.  @param mass  of the body [kg], for damping and stiffness in SI.
void printResult(const char* name, const StrutEstimate& estimate, const std::optional<double>& mass);

/// Over the whole drive, which is what to trust; then LS and LA at its end.
void printEstimates(const IdentifyResult& found, const std::optional<double>& mass);

/// @param change  how the strut is against the healthy one, in a sentence; an empty one is not printed.
void printChange(const std::string& change);

json toJson(const StrutEstimate& estimate);
json toJson(const IdentifyResult& found, const std::string& change);

/// @param estimate, strut  by the same estimator.
void printTyre(const char* name, const WheelEstimate& estimate, const StrutEstimate& strut);
json toJson(const WheelEstimate& estimate, const StrutEstimate& strut);

/// Tells people the forces at even travel rates and travels, compression beside rebound, with nine tenths of certainty.
/// @param mass  of the body [kg], for forces in N; nothing: over the mass.
void printCurves(const StrutCurves& curves, const std::optional<double>& mass);

/// Adds "damper_curve" and "spring_curve", over the body's mass.
void addCurves(const StrutCurves& curves, json& into);

/// What a search found.
json toJson(const Diagnosis& found);

/// A comparison, with the numbers behind every view.
json toJson(const Comparison& comparison);

/// Adds "parameters", "coefficients" and "shapes" by name.
void addNumbers(const StrutModel& model, json& into);

/// How the struts move one another; nothing of a strut alone.
void printCoupling(const VehicleCoupling& coupling, const std::vector<std::string>& names);

/// @return what all commands tell programs: which topics were silent and, of a vehicle, how the struts move one
/// another, with `struts` to be filled.
json wholeJson(const AskedVehicle& vehicle, const VehicleCoupling& coupling, const TopicGaps& gaps);

/// How the body's mass is spread.
void printBody(const BodyInertia& body);
json toJson(const BodyInertia& body);

}  // namespace suspension_health_monitor
