#include "entry_points.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  suspension_health_monitor::readSettingsText(std::string(reinterpret_cast<const char*>(bytes), size));
  return 0;
}
