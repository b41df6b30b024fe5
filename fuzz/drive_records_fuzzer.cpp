#include "entry_points.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  suspension_health_monitor::searchDriveRecords(bytes, size);
  return 0;
}
