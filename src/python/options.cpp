#include "options.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <string_view>

#include "suspension_health_monitor/internal/model/model_settings.h"
#include "suspension_health_monitor/internal/wording/words.h"

namespace suspension_health_monitor {
namespace {

namespace py = pybind11;

std::string asPythonName(std::string name) {
  std::replace(name.begin(), name.end(), '/', '_');
  return name;
}

/// Of a number of NumPy the Python number.
py::object plain(const py::handle& value) {
  const bool is_array = py::hasattr(value, "item") && py::hasattr(value, "ndim");
  return is_array && value.attr("ndim").cast<int>() == 0 ? py::object(value.attr("item")())
                                                         : py::reinterpret_borrow<py::object>(value);
}

OptionValue toNumber(const py::object& number) {
  const double value = number.cast<double>();
  const bool is_int = py::isinstance<py::int_>(number) && std::abs(value) <= std::numeric_limits<int>::max();
  return is_int ? OptionValue(static_cast<int>(value)) : OptionValue(value);
}

OptionValue toList(const std::string& name, const py::sequence& list) {
  std::string text;
  for (const py::handle& item : list) {
    if (!py::isinstance<py::str>(item)) return UnusableList{py::repr(list).cast<std::string>()};
    text += (text.empty() ? "" : ", ") + item.cast<std::string>();
  }
  if (list.empty()) throw std::invalid_argument(name + " = [], must be a value or left out");
  return text;
}

OptionValue toValue(const std::string& name, const py::handle& given) {
  const py::object value = plain(given);
  if (py::isinstance<py::bool_>(value)) return value.cast<bool>();
  if (py::isinstance<py::int_>(value) || py::isinstance<py::float_>(value)) return toNumber(value);
  if (py::isinstance<py::str>(value)) return value.cast<std::string>();
  if (py::hasattr(value, "__fspath__")) return value.attr("__fspath__")().cast<std::string>();
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) return toList(name, value);
  throw std::invalid_argument(name + " = " + py::repr(value).cast<std::string>() +
                              ", must be true or false, a number or a text");
}

/// What arrays get by an argument of the call.
const std::map<std::string_view, std::string> kArguments{
    {"effects", "model"}, {"model_file", "model"}, {"effects_file", "effects_file"}, {"baseline_file", "baseline"}};

bool isOfArrays(const OptionField<ShellOptions>& field) { return field.name == "input_timeout"; }

}  // namespace

Keywords Keywords::withoutMessages() const {
  Keywords rest = *this;
  for (const auto& field : kShellFields)
    if (!isOfArrays(field) && kArguments.count(field.name) == 0) rest.values.erase(std::string(field.name));
  return rest;
}

OptionMap toSettings(const py::dict& settings, const std::string& group) {
  OptionMap values;
  for (const auto& [key, value] : settings) {
    if (value.is_none()) continue;
    const std::string name = group + py::str(key).cast<std::string>();
    OptionMap more = py::isinstance<py::dict>(value) ? toSettings(py::reinterpret_borrow<py::dict>(value), name + '/')
                                                     : OptionMap{{name, toValue(name, value)}};
    values.merge(more);
    if (!more.empty()) throw std::invalid_argument(more.begin()->first + " is given twice, must be given once");
  }
  return values;
}

Keywords takeKeywords(const py::dict& keywords, const std::vector<OptionDescription>& known,
                      const std::vector<std::string>& arguments) {
  OptionMap taken, unknown;
  for (const auto& [name, value] : toSettings(keywords)) {
    const auto option = std::find_if(known.begin(), known.end(), [&, &its = name](const OptionDescription& one) {
      return one.name == its || asPythonName(one.name) == its;
    });
    if (option == known.end())
      unknown.emplace(name, value);
    else if (!taken.emplace(option->name, value).second)
      throw std::invalid_argument(option->name + " is given twice, must be given once");
  }
  std::vector<OptionDescription> named = known;
  for (const std::string& argument : arguments) named.push_back({"", argument, "", "", "", ""});
  refuseUnknown(unknown, named);
  return {taken};
}

std::vector<std::string> Keywords::assignments() const {
  struct Writer {
    std::string operator()(bool b) const { return b ? "true" : "false"; }
    std::string operator()(int i) const { return std::to_string(i); }
    std::string operator()(double d) const { return formatted("%.17g", d); }
    std::string operator()(const std::string& s) const { return s; }
    std::string operator()(const UnusableList& list) const { return list.text; }
  };
  std::vector<std::string> all;
  for (const auto& [name, value] : values) all.push_back(name + '=' + std::visit(Writer{}, value));
  return all;
}

PipelineOptions Keywords::forArrays() const {
  for (const auto& field : kShellFields) {
    if (isOfArrays(field) || values.count(std::string(field.name)) == 0) continue;
    const auto argument = kArguments.find(field.name);
    throw std::invalid_argument(std::string(field.name) +
                                " is an option of messages and files, must not come with arrays: " +
                                (argument != kArguments.end() ? "for these there is " + argument->second + '='
                                                              : "these have the accelerations along the strut"));
  }
  return PipelineOptions::fromValues(values);
}

std::optional<StrutModel> toModel(const py::object& model, const EffectLibrary& library) {
  if (model.is_none()) return std::nullopt;
  if (py::isinstance<StrutModel>(model)) return model.cast<StrutModel>();
  if (!py::isinstance<py::dict>(model))
    throw std::invalid_argument("model = " + py::repr(model).cast<std::string>() +
                                ", must be a StrutModel, a dict of settings or the path of a model file");
  OptionMap values = toSettings(model);
  StrutModel made = takeModel(values, library);
  refuseUnknown(values, {});
  return made;
}

}  // namespace suspension_health_monitor
