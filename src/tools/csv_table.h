#pragma once

#include <cinttypes>
#include <cstdio>

#include "bag_options.h"

namespace suspension_health_monitor {

/// A table for programs, full precision: a line begins with its time and, where several struts are asked for, the name
/// of the strut.
class CsvTable {
 public:
  /// @param out  nullptr: no table is wanted.  @param vehicle  outlives this object.  @param columns  names of the
  /// columns behind time and strut.
  CsvTable(std::FILE* out, const AskedVehicle& vehicle, const char* columns) : out_(out), vehicle_(vehicle) {
    if (out_ != nullptr) std::fprintf(out_, "time,%s%s\n", vehicle_.only ? "" : "strut,", columns);
  }

  /// @return true if the table has lines of this strut.
  bool isOf(std::size_t strut) const { return out_ != nullptr && vehicle_.only.value_or(strut) == strut; }

  /// @return where the rest of the line is to be written.
  std::FILE* beginLine(std::size_t strut, Stamp stamp) {
    constexpr std::int64_t second = 1000000000;
    std::fprintf(out_, "%" PRId64 ".%09" PRId64 ",", stamp.count() / second, stamp.count() % second);
    if (!vehicle_.only) std::fprintf(out_, "%s,", vehicle_.names[strut].c_str());
    return out_;
  }

 private:
  std::FILE* out_;
  const AskedVehicle& vehicle_;
};

}  // namespace suspension_health_monitor
