#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <type_traits>
#include <vector>

#include "result_fields.h"

namespace suspension_health_monitor {

/// @return a result as an object with its fields by name, where an empty optional field is left out; a matrix as a list
/// of rows, a stamp in seconds, a level or verdict by its name.
template <class Value>
nlohmann::json jsonOf(const Value& value);

template <class Item>
nlohmann::json jsonOf(const std::vector<Item>& items) {
  nlohmann::json list = nlohmann::json::array();
  for (const Item& item : items) list.push_back(jsonOf(item));
  return list;
}

template <class Value>
void addTo(nlohmann::json& into, const char* name, const Value& value) {
  into[name] = jsonOf(value);
}

template <class Value>
void addTo(nlohmann::json& into, const char* name, const std::optional<Value>& value) {
  if (value) addTo(into, name, *value);
}

template <class Value>
nlohmann::json jsonOf(const Value& value) {
  if constexpr (Fields<Value>::value) {
    nlohmann::json into;
    Fields<Value>::forEach([&](const char* name, auto field) { addTo(into, name, value.*field); });
    return into;
  } else if constexpr (std::is_base_of_v<Eigen::EigenBase<Value>, Value>) {
    nlohmann::json rows = nlohmann::json::array();
    for (Eigen::Index i = 0; i < value.rows(); ++i) {
      rows.push_back(nlohmann::json::array());
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

}  // namespace suspension_health_monitor
