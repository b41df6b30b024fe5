#include "yaml_settings.h"

#include <yaml-cpp/yaml.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <vector>

#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

constexpr int kDeepest = 5;  // no name has more parts; an alias that contains itself has no end
constexpr std::size_t kMostValues = 10000;
constexpr std::size_t kLargestText = 1U << 20U;  // [bytes]

[[noreturn]] void refuseSize(const std::string& name) {
  throw std::invalid_argument(name + ": is too large for settings, must be at most " + std::to_string(kMostValues) +
                              " values in " + std::to_string(kLargestText >> 20U) + " MiB");
}

/// Walks through a document. Aliases let a short one be endless to walk through, so what it makes is counted.
class Flattening {
 public:
  Flattening(const std::string& text_name, const YAML::Node& document) : text_name_(text_name) {
    flatten("", 0, document);
  }

  const OptionMap& values() const { return values_; }

 private:
  void flatten(const std::string& name, int depth, const YAML::Node& node) {
    count(name.size());
    if (node.IsMap() && node.size() == 0 && !name.empty()) return add(node, name, UnusableList{"{}"});
    if (node.IsMap() && depth < kDeepest) {
      std::set<std::string> keys;
      for (const auto& entry : node) {
        const auto key = entry.first.as<std::string>();
        const std::string full = name.empty() ? key : name + '/' + key;
        if (!keys.insert(key).second) refuseTwice(entry.first, full);
        flatten(full, depth + 1, entry.second);
      }
      return;
    }
    if (node.IsNull() && name.empty()) return;  // a file of comments only sets nothing
    const bool plain = node.IsScalar() || node.IsSequence();
    if (!plain || name.empty())
      refuse(node, (name.empty() ? "the file" : shortened(name)) + " must be a name with a plain value");
    const OptionValue value = node.IsScalar() ? OptionValue(node.as<std::string>()) : toValue(node);
    if (node.IsScalar()) count(node.Scalar().size());
    add(node, name, value);
  }

  void add(const YAML::Node& node, const std::string& name, const OptionValue& value) {
    if (!values_.emplace(name, value).second) refuseTwice(node, name);
  }

  /// A list of texts, such as the names of effects, as one text with commas; of other lists their text, one level deep.
  OptionValue toValue(const YAML::Node& list) {
    std::string text;
    bool all_texts = true;
    for (const YAML::Node& item : list) {
      double number = 0.0;
      all_texts = all_texts && item.IsScalar() && !YAML::convert<double>::decode(item, number);
      const std::string word = item.IsScalar() ? item.Scalar() : item.IsMap() ? "{...}" : "[...]";
      count(word.size());
      text += (text.empty() ? "" : ", ") + word;
    }
    return all_texts ? OptionValue(text) : UnusableList{'[' + text + ']'};
  }

  void count(std::size_t characters) {
    characters_ += characters;
    if (++values_counted_ > kMostValues || characters_ > kLargestText) refuseSize(text_name_);
  }

  [[noreturn]] void refuseTwice(const YAML::Node& node, const std::string& name) const {
    refuse(node, shortened(name) + " is given twice, must be given once");
  }

  [[noreturn]] void refuse(const YAML::Node& node, const std::string& why) const {
    throw std::invalid_argument(text_name_ + ": line " + std::to_string(node.Mark().line + 1) + ": " + why);
  }

  const std::string& text_name_;
  std::size_t values_counted_ = 0, characters_ = 0;
  OptionMap values_;
};

}  // namespace

OptionMap parseYaml(const std::string& text, const std::string& name) {
  if (text.size() > kLargestText) refuseSize(name);
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() > 1)
      throw std::invalid_argument(name + ": line " + std::to_string(documents[1].Mark().line + 1) +
                                  ": a second document begins, must be one");
    return Flattening(name, documents.empty() ? YAML::Node() : documents.front()).values();
  } catch (const YAML::Exception& error) {
    throw std::invalid_argument(name + ": line " + std::to_string(error.mark.line + 1) + ": " +
                                shortened(error.msg, 1000));
  }
}

OptionMap readYaml(const std::string& path) {
  if (std::filesystem::is_directory(path)) throw std::invalid_argument(path + ": is a folder, must be a YAML file");
  std::error_code error;
  if (std::filesystem::is_fifo(path, error)) throw std::invalid_argument(path + ": is a pipe, must be a YAML file");
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::invalid_argument(path + ": cannot be read" + inWhichFolder(path) + ", must be a YAML file");
  std::string text(kLargestText + 1, '\0');  // and no more, of what may have no end
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (file.bad()) throw std::invalid_argument(path + ": cannot be read, must be a YAML file");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return parseYaml(text, path);
}

std::string inWhichFolder(const std::string& path) {
  std::error_code error;
  return std::filesystem::path(path).is_absolute() ? "" : " in " + std::filesystem::current_path(error).string();
}

}  // namespace suspension_health_monitor
