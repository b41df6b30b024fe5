#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <sstream>

#include "../ros/model_file.h"
#include "bag_options.h"
#include "command.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

/// "gap [m], width [m]"
std::string withUnits(const std::vector<EffectLibrary::Description::NameAndUnit>& numbers) {
  return join(mapped(numbers, [](const auto& number) { return number.first + " [" + number.second + "]"; }));
}

/// @return the unit of the one coefficient, or of each.
std::string unitOf(const EffectLibrary::Description& effect) {
  return effect.coefficients.size() == 1 ? effect.coefficients.front().second : withUnits(effect.coefficients);
}

void printMarkdown(const std::vector<EffectLibrary::Description>& effects) {
  std::printf(
      "| name | law | unit of c | shape | what a workshop would find | design or wear, and what to check |\n"
      "|---|---|---|---|---|---|\n");
  for (const EffectLibrary::Description& effect : effects)
    std::printf("| `%s` | %s | %s | %s | %s | %s |\n", effect.name.c_str(),
                boost::replace_all_copy(effect.law, "|", "\\|").c_str(), unitOf(effect).c_str(),
                withUnits(effect.shapes).c_str(), effect.finding.c_str(), effect.advice.c_str());
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

void printForTerminal(const std::vector<EffectLibrary::Description>& effects) {
  std::printf("name\n%slaw; [unit] of c; shape\n%swhat a workshop would find\n%sdesign or wear, and what to check\n",
              kIndent, kIndent, kIndent);
  for (const EffectLibrary::Description& effect : effects) {
    const std::string unit = effect.coefficients.size() == 1 ? '[' + unitOf(effect) + ']' : unitOf(effect);
    std::printf("\n%s\n%s%s\n", effect.name.c_str(), kIndent,
                join({effect.law, unit, withUnits(effect.shapes)}, "; ").c_str());
    printWrapped(effect.finding);
    printWrapped(effect.advice);
  }
}

}  // namespace

void effects(const Arguments& arguments) {
  po::options_description description("options");
  addEffectsFile(description);
  description.add_options()("markdown", "as the table of doc/effects.md");
  const auto values = parse(arguments, "effects [--effects-file FILE] [--markdown]", description);
  if (!values) return;
  const std::vector<EffectLibrary::Description> all =
      readEffectsFile((*values)[kEffectsFile].as<std::string>()).describe();
  values->count("markdown") != 0 ? printMarkdown(all) : printForTerminal(all);
}

}  // namespace suspension_health_monitor
