#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <boost/program_options.hpp>

#include "../tools/command.h"
#include "bags_long_work.h"
#include "opaque.h"

namespace suspension_health_monitor {

/// @param arguments  as on the command line, of any of the commands.
boost::program_options::variables_map parsed(const Arguments& arguments);

/// Runs what the command line runs; its errors are ValueError.
template <class Work>
auto asCommand(const Work& work) {
  try {
    return work();
  } catch (const pybind11::error_already_set&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw pybind11::value_error(error.what());
  }
}

/// Adds a function work(arguments, progress) of named arguments and of a callback.
/// @tparam Given  what it is given before the callback, by `names`.
template <class... Given, class Work, class... Names>
void defWork(pybind11::module& module, const char* name, const Work& work, const Names&... names) {
  module.def(
      name,
      [work](const Given&... given, const pybind11::object& progress) {
        LongWork long_work(progress);
        return asCommand([&] { return long_work.run([&] { return work(given..., long_work); }); });
      },
      pybind11::arg(names)..., pybind11::arg("progress"));
}

/// Likewise, of arguments as on the command line.
template <class Work>
void defCommand(pybind11::module& module, const char* name, const Work& work) {
  defWork<Arguments>(module, name, work, "arguments");
}

/// Adds what is of the struts of a vehicle.
void bindVehicles(pybind11::module& module);

}  // namespace suspension_health_monitor
