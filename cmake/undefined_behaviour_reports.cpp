// Part of builds with UBSan only. The runtimes of AddressSanitizer and UBSan of gcc are two libraries with a report
// file each, and a function of the same name to set it. UBSan calls that of AddressSanitizer, which comes first, and
// its own reports go to stderr, which nobody reads of a node. So its own function is called here, by its library.
#include <dlfcn.h>

#include <cstdlib>
#include <string>

namespace {

constexpr char kOption[] = "log_path=";

std::string logPath() {
  const char* const options = std::getenv("UBSAN_OPTIONS");
  const std::string text = options == nullptr ? "" : options;
  const std::size_t name = text.find(kOption);
  if (name == std::string::npos) return "";
  const std::size_t begin = name + sizeof kOption - 1;
  return text.substr(begin, text.find(':', begin) - begin);
}

[[maybe_unused]] const bool is_set = [] {
  const std::string path = logPath();
  void* const runtime = dlopen("libubsan.so.1", RTLD_NOLOAD | RTLD_NOW);
  if (path.empty() || runtime == nullptr) return false;
  void* const function = dlsym(runtime, "__sanitizer_set_report_path");
  if (function != nullptr) reinterpret_cast<void (*)(const char*)>(function)(path.c_str());
  return function != nullptr;
}();

}  // namespace
