#include "csv_tables.h"

#include <cinttypes>
#include <cmath>

namespace suspension_health_monitor {

CsvTable::CsvTable(std::FILE* out, const AskedVehicle& vehicle, const char* columns) : out_(out), vehicle_(vehicle) {
  if (out_ != nullptr) std::fprintf(out_, "time,%s%s\n", vehicle_.only ? "" : "strut,", columns);
}

std::FILE* CsvTable::beginLine(std::size_t strut, Stamp stamp) {
  constexpr std::int64_t second = 1000000000;
  std::fprintf(out_, "%" PRId64 ".%09" PRId64 ",", stamp.count() / second, stamp.count() % second);
  if (!vehicle_.only) std::fprintf(out_, "%s,", vehicle_.names[strut].c_str());
  return out_;
}

RowTable::RowTable(std::FILE* out, const AskedVehicle& vehicle)
    : CsvTable(out, vehicle,
               "ls_damping_to_mass,ls_stiffness_to_mass,la_damping_to_mass,la_stiffness_to_mass,"
               "measured,predicted,residual,estimate_damping_to_mass,estimate_stiffness_to_mass,"
               "estimate_damping_to_mass_stddev,estimate_stiffness_to_mass_stddev"),
      waiting_(vehicle.names.size()) {}

void RowTable::add(std::size_t strut, const MonitorReport& report) {
  if (!isOf(strut)) return;
  std::deque<MonitorReport>& waiting = waiting_[strut];
  const bool clock_went_back = !waiting.empty() && report.stamp < waiting.back().stamp;
  while (clock_went_back && !waiting.empty()) write(strut, std::nullopt);
  if (report.has_row) waiting.push_back(report);
  const ComparisonReport& comparison = report.comparison;
  while (comparison.has_sample && !waiting.empty() && waiting.front().stamp <= comparison.stamp)
    write(strut, waiting.front().stamp == comparison.stamp ? comparison.predicted : std::nullopt);
}

void RowTable::finish() {
  for (std::size_t strut = 0; strut < waiting_.size(); ++strut)
    while (!waiting_[strut].empty()) write(strut, std::nullopt);
}

void RowTable::write(std::size_t strut, const std::optional<double>& predicted) {
  const MonitorReport row = waiting_[strut].front();
  waiting_[strut].pop_front();
  const double prediction = predicted.value_or(std::nan(""));
  std::fprintf(beginLine(strut, row.stamp), "%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n",
               row.ls.damping_to_mass, row.ls.stiffness_to_mass, row.la.damping_to_mass, row.la.stiffness_to_mass,
               row.measured, prediction, row.measured - prediction, row.estimate.damping_to_mass,
               row.estimate.stiffness_to_mass, row.estimate.damping_to_mass_stddev,
               row.estimate.stiffness_to_mass_stddev);
}

}  // namespace suspension_health_monitor
