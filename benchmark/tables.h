// The tables of benchmark/ are commands of one program: `tables NAME [ARGUMENT]...`.
#pragma once

#include <cstdlib>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace suspension_health_monitor {

/// The words behind a table's name.
struct Arguments {
  std::vector<std::string> words;

  std::size_t size() const { return words.size(); }
  /// @return the i-th word, from 0; `otherwise` if there are fewer.
  std::string word(std::size_t i, const std::string& otherwise = "") const { return i < size() ? words[i] : otherwise; }
  double number(std::size_t i, double otherwise) const { return i < size() ? std::atof(words[i].c_str()) : otherwise; }
  std::optional<double> given(std::size_t i) const { return i < size() ? std::optional(number(i, 0.0)) : std::nullopt; }
  int count(std::size_t i, int otherwise) const { return static_cast<int>(number(i, otherwise)); }
  unsigned seed(std::size_t i, unsigned otherwise = 1) const { return static_cast<unsigned>(number(i, otherwise)); }
};

struct TableCommand {
  std::string usage;                           ///< its arguments, and their defaults
  std::function<int(const Arguments&)> print;  ///< @return the exit status; 2: the arguments are wrong
};

/// The tables by name. Each file of a table adds its own, as a file-wide constant `const AddTable add(...)`.
inline std::map<std::string, TableCommand>& tables() {
  static std::map<std::string, TableCommand> all;
  return all;
}

struct AddTable {
  AddTable(const std::string& name, TableCommand command) { tables().emplace(name, std::move(command)); }
};

}  // namespace suspension_health_monitor
