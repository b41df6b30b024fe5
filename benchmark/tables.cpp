// Prints a table that a document quotes: `tables NAME [ARGUMENT]...`; without a name it lists them.
#include "tables.h"

#include <cstdio>

int main(int argc, char** argv) {
  using namespace suspension_health_monitor;
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // rows as they come
  const auto found = argc > 1 ? tables().find(argv[1]) : tables().end();
  const int status = found == tables().end() ? 2 : found->second.print({{argv + 2, argv + argc}});
  for (const auto& [name, table] : tables())
    if (status == 2 && (found == tables().end() || found->first == name))
      std::fprintf(stderr, "usage: tables %s %s\n", name.c_str(), table.usage.c_str());
  return status;
}
