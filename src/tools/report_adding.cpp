#include "report_adding.h"

#include <cstdio>
#include <cstdlib>
#include <memory>

#include "search_report.h"

namespace suspension_health_monitor {
namespace {

using nlohmann::json;

std::string modelFile(const SearchResult& search) {
  char* text = nullptr;
  std::size_t size = 0;
  std::FILE* stream = open_memstream(&text, &size);
  writeModel(search, stream);
  std::fclose(stream);
  const std::unique_ptr<char, decltype(&std::free)> owner(text, &std::free);
  return {text, size};
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const char* plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./+:=,@%";
  if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
  std::string result = "'";
  for (const char character : word)
    if (character == '\'')
      result += "'\\''";
    else
      result += character;
  return result + "'";
}

}  // namespace

json addingJson(const ReportContent& content) {
  std::string bags, names;
  for (const std::string& name : content.drive_names) bags += " " + quoted(name);
  for (const std::string& name : content.search.selected) names += (names.empty() ? "" : ", ") + name;
  const std::string tool = "rosrun suspension_health_monitor suspension_bag ";
  json commands = json::array();
  const auto add = [&](const char* title, const std::string& text) {
    commands.push_back({{"title", title}, {"text", text}});
  };
  add("Write the file", tool + "diagnose" + bags + " -o model.yaml");
  add("Judge the model on another drive", tool + "compare another_drive.bag --model model.yaml");
  if (!names.empty())
    add("Live: add it to a running monitor and watch the error fall",
        "rosservice call /monitor/set_effects \"{names: [" + names +
            "]}\"\nrqt_plot /monitor/comparison/base_rmse /monitor/comparison/rmse");
  add("Live from the start: name the file in your copy of monitor.yaml",
      "model_file: /path/to/model.yaml\n\nroslaunch suspension_health_monitor monitor.launch config:=$PWD/my_strut.yaml");
  return {{"model_file", modelFile(content.search)}, {"commands", commands}};
}

}  // namespace suspension_health_monitor
