#pragma once

#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <deque>

#include "bag_options.h"
#include "suspension_health_monitor/monitor_report.h"

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

/// `suspension_bag identify --csv`: one line per regression row. The comparison of a row's sample comes some samples
/// after the row: lines wait for it, and go without when their series ends before.
class RowTable : CsvTable {
 public:
  /// As CsvTable.
  RowTable(std::FILE* out, const AskedVehicle& vehicle)
      : CsvTable(out, vehicle,
                 "ls_damping_to_mass,ls_stiffness_to_mass,la_damping_to_mass,la_stiffness_to_mass,"
                 "measured,predicted,residual,estimate_damping_to_mass,estimate_stiffness_to_mass,"
                 "estimate_damping_to_mass_stddev,estimate_stiffness_to_mass_stddev"),
        waiting_(vehicle.names.size()) {}

  void add(std::size_t strut, const MonitorReport& report) {
    if (!isOf(strut)) return;
    std::deque<MonitorReport>& waiting = waiting_[strut];
    const bool clock_went_back = !waiting.empty() && report.stamp < waiting.back().stamp;
    while (clock_went_back && !waiting.empty()) write(strut, std::nullopt);
    if (report.has_row) waiting.push_back(report);
    const ComparisonReport& comparison = report.comparison;
    while (comparison.has_sample && !waiting.empty() && waiting.front().stamp <= comparison.stamp)
      write(strut, waiting.front().stamp == comparison.stamp ? comparison.predicted : std::nullopt);
  }

  /// No more comparisons will come.
  void finish() {
    for (std::size_t strut = 0; strut < waiting_.size(); ++strut)
      while (!waiting_[strut].empty()) write(strut, std::nullopt);
  }

 private:
  void write(std::size_t strut, const std::optional<double>& predicted) {
    const MonitorReport row = waiting_[strut].front();
    waiting_[strut].pop_front();
    const double prediction = predicted.value_or(std::nan(""));
    std::fprintf(beginLine(strut, row.stamp), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
                 row.ls.damping_to_mass, row.ls.stiffness_to_mass, row.la.damping_to_mass, row.la.stiffness_to_mass,
                 row.measured, prediction, row.measured - prediction, row.estimate.damping_to_mass,
                 row.estimate.stiffness_to_mass, row.estimate.damping_to_mass_stddev,
                 row.estimate.stiffness_to_mass_stddev);
  }

  std::vector<std::deque<MonitorReport>> waiting_;  // by strut, with a row
};

}  // namespace suspension_health_monitor
