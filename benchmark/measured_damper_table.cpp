// Prints the table of doc/measured_records.md: what the search says of a real damper on a sine rig.
//   tables measured_damper FOLDER     of runN.csv, or runN.csv.gz, as scripts/convert_measured_damper writes them
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/math/statistics.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "tables.h"

namespace suspension_health_monitor {
namespace {

struct Run {
  std::string name;
  Drive drive;
};

Drive readRun(const std::filesystem::path& path) {
  const std::string command = (path.extension() == ".gz" ? "gzip -dc '" : "cat '") + path.string() + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(popen(command.c_str(), "r"), pclose);
  Drive drive;
  char line[256];
  while (file && std::fgets(line, sizeof line, file.get()) != nullptr) {
    double time = 0.0;
    CornerSample sample;
    if (std::sscanf(line, "%lf,%lf,%lf", &time, &sample.sprung_acceleration, &sample.unsprung_acceleration) != 3)
      continue;  // the head
    sample.stamp = fromSeconds(time);
    drive.samples.push_back(sample);
  }
  return drive;
}

std::vector<Run> readRuns(const std::string& folder) {
  std::vector<std::filesystem::path> paths;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing))
    if (entry.path().filename().string().find(".csv") != std::string::npos) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Run> runs;
  for (const std::filesystem::path& path : paths) {
    const std::string name = path.filename().string();
    runs.push_back({name.substr(0, name.find('.')), readRun(path)});
  }
  return runs;
}

/// rms that a model leaves of a run that it was not fitted to, from the initial state that suits it best [m/s^2].
double leftBy(const StrutModel& model, const Drive& drive) {
  const std::deque<DriveRecord> records = makeRecords({drive}, medianPeriod({drive}), model);
  const auto initial = estimateInitialStates(pointersTo(records), model);
  if (!initial) return std::nan("");
  double sum = 0.0, count = 0.0;
  std::vector<double> predicted;
  for (std::size_t s = 0; s < records.front().segments().size(); ++s) {
    const DriveSegment& segment = records.front().segments()[s];
    if (!runFree(model, segment, (*initial)[s], predicted)) return std::nan("");
    for (std::size_t k = 0; k < segment.size(); ++k, ++count) sum += square(segment.sprung[k] - predicted[k]);
  }
  return std::sqrt(sum / count);
}

std::string namesIn(const Diagnosis& found) {
  std::string text = join(found.selected, " + ");
  for (const std::vector<std::string>& group : found.indistinguishable) text += " {" + join(group, ", ") + "}";
  return text;
}

/// One row: the verdict, b1 and b0 before and after, every other number of the model, rmse on what no fit has seen.
void print(const std::string& label, const Diagnosis& found) {
  if (!found) return void(std::printf("| %s | the drives %s |\n", label.c_str(), found.reason.c_str()));
  const StrutModel &before = found.base.model, &after = found.model();
  std::printf("| %s | %s | %s | %.0f %% | %.0f, %.0f | %.1f, %.0f |", label.c_str(), nameOf(found.verdict),
              namesIn(found).c_str(), 100.0 * found.explained_share, before.damping_to_mass, before.stiffness_to_mass,
              after.damping_to_mass, after.stiffness_to_mass);
  for (const ModelNumber& number : numbersOf(after))
    if (number.kind != ModelNumber::Kind::kStrut)
      std::printf(" %s %.3g %s", number.symbol.c_str(), number.value, number.unit.c_str());
  std::printf(" | %.3f | %.3f |", found.base.held_out_rmse,
              found.extended ? found.extended->held_out_rmse : found.base.held_out_rmse);
}

int command(const Arguments& arguments) {
  const std::vector<Run> runs = arguments.size() > 0 ? readRuns(arguments.word(0)) : std::vector<Run>();
  if (runs.empty()) {
    std::printf("skipped: no runs of the measured damper in %s\n",
                arguments.word(0, "a folder: none is given").c_str());
    return 0;
  }
  std::printf(
      "| runs | verdict | named | of the structure | b1, b0 before | b1, b0, c and shapes after | rmse before | "
      "after | on the run left out: before, after |\n|---|---|---|---|---|---|---|---|---|\n");
  std::vector<Drive> all;
  for (const Run& run : runs) {
    all.push_back(run.drive);
    print(run.name, diagnose({run.drive}));
    std::printf(" |\n");
  }
  print("all", diagnose(all));
  std::printf(" |\n");
  for (std::size_t left_out = 0; left_out < runs.size(); ++left_out) {
    std::vector<Drive> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Diagnosis found = diagnose(others);
    print("all but " + runs[left_out].name, found);
    if (found)
      std::printf(" %.3f, %.3f", leftBy(found.base.model, all[left_out]), leftBy(found.model(), all[left_out]));
    std::printf(" |\n");
    std::fflush(stdout);
  }
  return 0;
}

const AddTable kAdded("measured_damper", {"FOLDER", command});

}  // namespace
}  // namespace suspension_health_monitor
