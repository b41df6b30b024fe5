// Prints the table of doc/measured_records.md: what the search says of a real damper on a sine rig.
//   measured_damper_table FOLDER     of runN.csv, or runN.csv.gz, as scripts/convert_measured_damper writes them
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "suspension_health_monitor/diagnose.h"
#include "suspension_health_monitor/internal/fit/initial_states.h"
#include "suspension_health_monitor/internal/fit/output_error_fit.h"
#include "suspension_health_monitor/internal/statistics.h"
#include "suspension_health_monitor/internal/wording/search_sentences.h"
#include "suspension_health_monitor/internal/wording/words.h"

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

void print(const std::string& label, const Diagnosis& found) {
  std::printf("%-14s ", label.c_str());
  if (!found) return void(std::printf("the drives %s\n", found.reason.c_str()));
  std::printf("%-15s %-44s b1 %6.2f b0 %6.1f, rmse %.4f", nameOf(found.verdict),
              join(found.selected, " + ").c_str(), found.model().damping_to_mass, found.model().stiffness_to_mass,
              found.base.held_out_rmse);
  if (found.extended) std::printf(" -> %.4f", found.extended->held_out_rmse);
  std::printf(", floor %.4f, surface %.2f", found.noise_floor, found.surface_share);
  for (const ModelNumber& number : numbersOf(found.model()))
    if (number.kind != ModelNumber::Kind::kStrut) std::printf("  %s %.4g %s", number.name.c_str(), number.value, number.unit.c_str());
  for (const auto& group : found.indistinguishable) std::printf("  {%s}", join(group, ", ").c_str());
  std::printf("\n");
  for (std::size_t i = 0; i < std::min<std::size_t>(std::getenv("RANK")?20:0, found.ranking.size()); ++i)
    std::printf("    %c%d %-28s %.4f %5.1f %%%s  b1 %.2f b0 %.1f\n", found.ranking[i].fitted ? ' ' : '~', int(found.ranking[i].failure),
                join(found.ranking[i].effects, " + ").c_str(), found.ranking[i].held_out_rmse,
                found.ranking[i].error_removed_percent, found.ranking[i].significant ? " *" : "",
                found.ranking[i].model.damping_to_mass, found.ranking[i].model.stiffness_to_mass);
}

}  // namespace
}  // namespace suspension_health_monitor

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  const std::vector<Run> runs = argc > 1 ? readRuns(argv[1]) : std::vector<Run>();
  if (runs.empty()) {
    std::printf("skipped: no runs of the measured damper in %s\n", argc > 1 ? argv[1] : "a folder, as none is given");
    return 0;
  }
  std::vector<Drive> all;
  for (const Run& run : runs) {
    all.push_back(run.drive);
    if (argc < 3 || run.name == argv[2]) print(run.name, diagnose({run.drive}));
  }
  if (argc < 3 || argv[2] == std::string("all")) print("all", diagnose(all));
  if (argc > 2) return 0;
  for (std::size_t left_out = 0; left_out < runs.size(); ++left_out) {
    std::vector<Drive> others = all;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    const Diagnosis found = diagnose(others);
    print("without " + runs[left_out].name, found);
    if (!found) continue;
    std::printf("    on %s: %.4f -> %.4f\n", runs[left_out].name.c_str(), leftBy(found.base.model, all[left_out]),
                leftBy(found.model(), all[left_out]));
  }
  return 0;
}
