#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../tools/result_fields.h"  // of its folder a file without ROS
#include "long_work.h"
#include "suspension_health_monitor/drive.h"
#include "suspension_health_monitor/residual_views.h"

// Classes of their own in Python, not lists. A file that casts one includes this header.
PYBIND11_MAKE_OPAQUE(std::vector<suspension_health_monitor::ResidualBin>)
PYBIND11_MAKE_OPAQUE(std::vector<suspension_health_monitor::TimeBin>)

namespace suspension_health_monitor {

/// One sensor of a recording, arrays of equal length, which the wrapper in Python has checked: rising stamps [ns] and
/// what it reads along the strut [m/s^2].
using ReadingStream = std::pair<py::array_t<std::int64_t>, py::array_t<double>>;

/// Arrays of one drive. To be made and destroyed with the interpreter's lock; read without.
struct Recording {
  std::vector<ReadingStream> streams;  ///< by Side: of body, wheel carrier and, if there is one, the road

  /// a_x, a_y [m/s^2], w_x, w_y [rad/s] of the body's IMU, in the strut's frame, at the body's stamps.
  std::optional<py::array_t<double>> across;

  /// Calls take(side, stamp, value) with all readings in the order of their stamps; at the same time the body's first.
  template <class Take>
  void forEach(const Take& take) const {
    struct Cursor {
      const std::int64_t* stamp;
      const double* value;
      const std::int64_t* end;

      bool isAtEnd() const { return stamp == end; }
    };
    std::vector<Cursor> cursors;
    for (const auto& [stamps, values] : streams)
      cursors.push_back({stamps.data(), values.data(), stamps.data() + stamps.size()});
    while (true) {
      const auto next = std::min_element(cursors.begin(), cursors.end(), [](const Cursor& a, const Cursor& b) {
        return !a.isAtEnd() && (b.isAtEnd() || *a.stamp < *b.stamp);
      });
      if (next == cursors.end() || next->isAtEnd()) return;
      take(static_cast<Side>(next - cursors.begin()), Stamp(*next->stamp++), *next->value++);
    }
  }
};

using Recordings = std::vector<Recording>;

// Each adds its classes and functions to the compiled part of the Python module.
void bindModel(py::module& module);
void bindReports(py::module& module);
void bindResults(py::module& module);
void bindWork(py::module& module);
void bindSimulation(py::module& module);
void bindMonitors(py::module& module);

/// @param what  a member, a const member function, or any function of the owner.
/// @return its value: of a stamp the seconds, of a level or verdict the name.
template <class What, class Owner>
decltype(auto) valueOf(const What& what, const Owner& owner) {
  using Value = std::decay_t<std::invoke_result_t<const What&, const Owner&>>;
  if constexpr (std::is_same_v<Value, Stamp>)
    return toSeconds(std::invoke(what, owner));
  else if constexpr (std::is_enum_v<Value>)
    return nameOf(std::invoke(what, owner));
  else
    return std::invoke(what, owner);
}

/// @return one number of each item, as an array.
template <class Items, class What>
auto arrayOf(const Items& items, const What& what) {
  using Number = std::decay_t<decltype(valueOf(what, items[0]))>;
  py::array_t<Number> array(static_cast<Py_ssize_t>(items.size()));
  Number* next = array.mutable_data();
  for (const auto& item : items) *next++ = valueOf(what, item);
  return array;
}

/// A class of results in Python, with the fields of result_fields.h and the attributes that are added, given as
/// valueOf() takes them. Attributes cannot be changed. Their texts are in _core.pyi.
template <class Result>
class ResultClass : public py::class_<Result> {
 public:
  ResultClass(py::module& module, const char* name, const char* text) : py::class_<Result>(module, name, text) {
    if constexpr (Fields<Result>::value)
      Fields<Result>::forEach([this](const char* field, auto member) { this->addField(field, member); });
  }

  template <class What>
  ResultClass& add(const char* name, const What& what) {
    this->def_property_readonly(name, [what](const Result& self) -> decltype(auto) { return valueOf(what, self); });
    return *this;
  }

  /// Adds an array: of each item in a vector one number.
  template <class Items, class What>
  ResultClass& addColumn(const char* name, const Items& items, const What& what) {
    return add(name, [=](const Result& self) { return arrayOf(valueOf(items, self), what); });
  }

  /// Adds an array, of a vector of numbers.
  template <class Numbers>
  ResultClass& addArray(const char* name, const Numbers& numbers) {
    return addColumn(name, numbers, [](const auto& number) { return number; });
  }

 private:
  // Numbers of many samples are an array; standard deviations of a few numbers are a list.
  template <class Field>
  void addField(const char* name, const Field& field) {
    if constexpr (std::is_same_v<std::decay_t<std::invoke_result_t<Field, const Result&>>, std::vector<double>>)
      std::string_view(name) == "stddev" ? add(name, field) : addArray(name, field);
    else
      add(name, field);
  }
};

}  // namespace suspension_health_monitor
