#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <sstream>

#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/text.h"

namespace suspension_health_monitor {
namespace {

/// What is told of one effect.
struct Row {
  std::string name, law, unit, shapes, finding, advice;
};

std::vector<Row> rowsOf(const EffectLibrary& library) {
  std::vector<Row> rows;
  for (const ForceEffect& effect : library.forces) {
    std::vector<std::string> shapes;
    for (const ShapeParameter& shape : effect.shapes) shapes.push_back(shape.name + " [" + shape.unit + "]");
    rows.push_back({effect.name, effect.law, effect.unit, join(shapes), effect.finding, effect.advice});
  }
  for (const MeasurementEffect& effect : library.readings) {
    std::vector<std::string> units;
    for (const MeasurementEffect::Coefficient& c : effect.coefficients)
      units.push_back(effect.coefficients.size() == 1 ? c.unit : c.name + " [" + c.unit + "]");
    rows.push_back({effect.name, effect.law, join(units), "", effect.finding, effect.advice});
  }
  return rows;
}

void printMarkdown(const std::vector<Row>& rows) {
  std::printf(
      "| name | law | unit of c | shape | what a workshop would find | design or wear, and what to check |\n"
      "|---|---|---|---|---|---|\n");
  for (const Row& row : rows)
    std::printf("| `%s` | %s | %s | %s | %s | %s |\n", row.name.c_str(),
                boost::replace_all_copy(row.law, "|", "\\|").c_str(), row.unit.c_str(), row.shapes.c_str(),
                row.finding.c_str(), row.advice.c_str());
}

constexpr std::size_t kWidth = 76;  // of a terminal, less the indent
constexpr const char* kIndent = "    ";

/// Prints text in lines that a terminal has room for.
void printWrapped(const std::string& text) {
  std::istringstream words(text);
  std::string word, line;
  const auto finish = [&] {
    if (!line.empty()) std::printf("%s%s\n", kIndent, line.c_str());
    line.clear();
  };
  while (words >> word) {
    if (line.size() + word.size() + 1 > kWidth) finish();
    line += (line.empty() ? "" : " ") + word;
  }
  finish();
}

void printForTerminal(const std::vector<Row>& rows) {
  std::printf("name\n%slaw; [unit] of c; shape\n%swhat a workshop would find\n%sdesign or wear, and what to check\n",
              kIndent, kIndent, kIndent);
  for (const Row& row : rows) {
    const std::string unit = row.unit.find('[') == std::string::npos ? '[' + row.unit + ']' : row.unit;
    std::printf("\n%s\n%s%s\n", row.name.c_str(), kIndent, join({row.law, unit, row.shapes}, "; ").c_str());
    printWrapped(row.finding);
    printWrapped(row.advice);
  }
}

}  // namespace

void effects(const Arguments& arguments) {
  boost::program_options::options_description description("options");
  addEffectsFile(description);
  description.add_options()("markdown", "as the table of doc/effects.md");
  const auto values = parse(arguments, "effects [--effects-file FILE] [--markdown]", description);
  if (!values) return;
  const std::vector<Row> rows = rowsOf(readEffects(*values));
  if (values->count("markdown") != 0)
    printMarkdown(rows);
  else
    printForTerminal(rows);
}

}  // namespace suspension_health_monitor
