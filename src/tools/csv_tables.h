#pragma once

#include <cstdio>
#include <deque>
#include <optional>
#include <vector>

#include "bag_options.h"
#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// A table for programs, full precision: a line begins with its time and, where several struts are asked for, the name
/// of the strut.
class CsvTable {
 public:
  /// @param out  nullptr: no table is wanted.  @param vehicle  outlives this object.  @param columns  names of the
  /// columns behind time and strut.
  CsvTable(std::FILE* out, const AskedVehicle& vehicle, const char* columns);

  /// @return true if the table has lines of this strut.
  bool isOf(std::size_t strut) const { return out_ != nullptr && vehicle_.only.value_or(strut) == strut; }

  /// @return where the rest of the line is to be written.
  std::FILE* beginLine(std::size_t strut, Stamp stamp);

 private:
  std::FILE* out_;
  const AskedVehicle& vehicle_;
};

/// `suspension_bag identify --csv`: one line per regression row. The comparison of a row's sample comes some samples
/// after the row: lines wait for it, and go without when their series ends before.
class RowTable : CsvTable {
 public:
  /// As CsvTable.
  RowTable(std::FILE* out, const AskedVehicle& vehicle);

  void add(std::size_t strut, const MonitorReport& report);

  /// No more comparisons will come.
  void finish();

 private:
  void write(std::size_t strut, const std::optional<double>& predicted);

  std::vector<std::deque<MonitorReport>> waiting_;  // by strut, with a row
};

}  // namespace suspension_health_monitor
