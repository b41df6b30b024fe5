#include "travel_output.h"

#include <boost/hana/adapt_struct.hpp>
#include <cstdio>

#include "json_of.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace shm = suspension_health_monitor;
BOOST_HANA_ADAPT_STRUCT(shm::TimeHistogram::Direction, share, mean, largest);
BOOST_HANA_ADAPT_STRUCT(shm::TimeHistogram, edges, shares, compression, rebound);
BOOST_HANA_ADAPT_STRUCT(shm::StopUse, effect, gap, near, hits);
BOOST_HANA_ADAPT_STRUCT(shm::TravelStatistics, travel, travel_rate, stops);

namespace suspension_health_monitor {

void printTravel(const TravelStatistics& travel) {
  if (travel.travel.edges.empty()) return;
  std::printf("travel up to %.3g mm in compression and %.3g mm in rebound, up to %.3g and %.3g m/s\n",
              1e3 * travel.travel.compression.largest, 1e3 * travel.travel.rebound.largest,
              travel.travel_rate.compression.largest, travel.travel_rate.rebound.largest);
  for (const StopUse& stop : travel.stops)
    std::printf("%s at %.3g mm: hit %d times, %s of the time in the last tenth before it or in it\n",
                stop.effect.c_str(), 1e3 * stop.gap, stop.hits, percent(stop.near).c_str());
}

nlohmann::json toJson(const TravelStatistics& travel) { return jsonOf(travel); }

}  // namespace suspension_health_monitor
