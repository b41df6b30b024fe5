#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <vector>

#include "opaque.h"

namespace suspension_health_monitor {

// Each adds its classes and functions to the compiled part of the Python module.
void bindReadings(pybind11::module& module);
void bindModel(pybind11::module& module);
void bindReports(pybind11::module& module);
void bindIdentification(pybind11::module& module);
void bindViews(pybind11::module& module);
void bindComparison(pybind11::module& module);
void bindDiagnosis(pybind11::module& module);
void bindHealth(pybind11::module& module);
void bindSimulation(pybind11::module& module);
void bindStrutMonitor(pybind11::module& module);
void bindVehicleMonitor(pybind11::module& module);

/// @return one number of each item, as an array.
template <class Items, class Get>
auto arrayOf(const Items& items, const Get& get) {
  using Number = std::decay_t<decltype(get(items[0]))>;
  pybind11::array_t<Number> array(static_cast<Py_ssize_t>(items.size()));
  Number* next = array.mutable_data();
  for (const auto& item : items) *next++ = get(item);
  return array;
}

/// Adds an attribute that is an array, of a member that is a vector of numbers.
template <class Class, class Owner, class Number>
void defArray(pybind11::class_<Class>& to, const char* name, std::vector<Number> Owner::*member, const char* text) {
  to.def_property_readonly(
      name,
      [member](const Class& self) {
        const std::vector<Number>& values = self.*member;
        return pybind11::array_t<Number>(static_cast<Py_ssize_t>(values.size()), values.data());
      },
      text);
}

}  // namespace suspension_health_monitor
