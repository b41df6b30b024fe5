#include "search_words.h"

namespace suspension_health_monitor {

std::string join(const std::vector<std::string>& names, const char* separator) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : separator) + name;
  return text;
}

const char* nameOf(Verdict verdict) {
  switch (verdict) {
    case Verdict::kEffectFound: return "effect_found";
    case Verdict::kNothingMissing: return "nothing_missing";
    case Verdict::kUnexplained: break;
  }
  return "unexplained";
}

std::string sentence(const SearchResult& result) {
  switch (result.verdict) {
    case Verdict::kEffectFound: return "Missing from the model: " + join(result.selected, " and ") + ".";
    case Verdict::kNothingMissing: return "Nothing is missing: what the model leaves is noise.";
    case Verdict::kUnexplained: break;
  }
  return "Something is missing, but no known effect explains most of it: no name is given.";
}

}  // namespace suspension_health_monitor
