#include "row_table.h"

#include <cinttypes>

namespace suspension_health_monitor {

RowTable::RowTable(std::FILE* out, const std::string& strut) : out_(out), strut_(strut.empty() ? "" : strut + ',') {}

void RowTable::writeHead(std::FILE* out, bool of_vehicle) {
  std::fprintf(out,
               "time,%sls_damping_to_mass,ls_stiffness_to_mass,la_damping_to_mass,la_stiffness_to_mass,"
               "measured,predicted,residual,estimate_damping_to_mass,estimate_stiffness_to_mass,"
               "estimate_damping_to_mass_stddev,estimate_stiffness_to_mass_stddev\n",
               of_vehicle ? "strut," : "");
}

void RowTable::add(const MonitorReport& report) {
  if (out_ == nullptr) return;
  if (!waiting_.empty() && report.stamp < waiting_.back().stamp) finish();  // the clock went back
  if (report.has_row)
    waiting_.push_back({report.stamp, report.ls.damping_to_mass, report.ls.stiffness_to_mass, report.la.damping_to_mass,
                        report.la.stiffness_to_mass, report.measured, report.estimate.damping_to_mass,
                        report.estimate.stiffness_to_mass, report.estimate.damping_to_mass_stddev,
                        report.estimate.stiffness_to_mass_stddev});
  const ComparisonReport& comparison = report.comparison;
  while (comparison.has_sample && !waiting_.empty() && waiting_.front().stamp <= comparison.stamp)
    write(waiting_.front().stamp == comparison.stamp ? comparison.predicted : std::nullopt);
}

void RowTable::finish() {
  while (!waiting_.empty()) write(std::nullopt);
}

void RowTable::write(const std::optional<double>& predicted) {
  const Row row = waiting_.front();
  waiting_.pop_front();
  std::fprintf(out_, "%" PRId64 ".%09" PRId64 ",%s%.17g,%.17g,%.17g,%.17g,%.17g,", row.stamp.count() / 1000000000,
               row.stamp.count() % 1000000000, strut_.c_str(), row.ls_damping, row.ls_stiffness, row.la_damping,
               row.la_stiffness, row.measured);
  if (predicted)
    std::fprintf(out_, "%.17g,%.17g,", *predicted, row.measured - *predicted);
  else
    std::fputs("nan,nan,", out_);
  std::fprintf(out_, "%.17g,%.17g,%.17g,%.17g\n", row.damping, row.stiffness, row.damping_stddev, row.stiffness_stddev);
}

}  // namespace suspension_health_monitor
