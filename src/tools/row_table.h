#pragma once

#include <cstdio>
#include <deque>
#include <optional>
#include <string>

#include "suspension_health_monitor/monitor_report.h"

namespace suspension_health_monitor {

/// `suspension_bag identify --csv`: one line per regression row, full precision. The comparison of a row's sample comes
/// some samples after the row: lines wait for it, and go without when their series ends before.
class RowTable {
 public:
  /// @param out  nullptr: no table is wanted.  @param strut  of a vehicle, for its column; empty: there is none.
  RowTable(std::FILE* out, const std::string& strut);

  /// The line with the names of the columns.
  /// @param of_vehicle  there is a column for struts.
  static void writeHead(std::FILE* out, bool of_vehicle);

  void add(const MonitorReport& report);

  /// No more comparisons will come.
  void finish();

 private:
  struct Row {
    Stamp stamp;
    double ls_damping, ls_stiffness, la_damping, la_stiffness, measured;
    double damping, stiffness, damping_stddev, stiffness_stddev;  // of the block estimate
  };

  void write(const std::optional<double>& predicted);

  std::FILE* out_;
  std::string strut_;  // with the comma behind it
  std::deque<Row> waiting_;
};

}  // namespace suspension_health_monitor
