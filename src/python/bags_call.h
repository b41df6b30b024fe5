#pragma once

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>

#include "../tools/command.h"
#include "long_work.h"
#include "opaque.h"

namespace suspension_health_monitor {

/// While it lives, what the tools do on this thread (src/tools/long_work.h) is part of a long work of Python.
class ToolsWork {
 public:
  /// @param bags  number of bags whose reading the callback reports; 0: it reports something else.
  ToolsWork(LongWork& work, std::size_t bags);
  ~ToolsWork();
  ToolsWork(const ToolsWork&) = delete;
  ToolsWork& operator=(const ToolsWork&) = delete;

  /// From now on the callback reports the reading of so many bags.
  void tellReading(std::size_t bags);

  void beginBar();
  void update(double share);
  void step() { work_.step(); }

 private:
  LongWork& work_;
  std::size_t bags_, begun_ = 0;
  ToolsWork* before_;
};

/// Adds what the command line does, as defWork(); its errors are ValueError.
template <class... Given, class Work, class... Names>
void defCommand(pybind11::module& module, const char* name, const Work& work, const Names&... names) {
  const auto command = [work](auto&... given) {
    try {
      return work(given...);
    } catch (const pybind11::error_already_set&) {
      throw;
    } catch (const std::bad_alloc&) {
      throw;
    } catch (const std::exception& error) {
      throw pybind11::value_error(error.what());
    }
  };
  defWork<Given...>(module, name, command, names...);
}

/// Adds the commands that read bags.
void bindBags(pybind11::module& module);

}  // namespace suspension_health_monitor
