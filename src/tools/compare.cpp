#include <cstdio>

#include "command.h"
#include "long_work.h"
#include "recorded_search.h"
#include "results.h"

namespace suspension_health_monitor {

void compare(const Arguments& arguments) {
  namespace po = boost::program_options;
  po::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  const auto values = parse(arguments, "compare BAG... [--model MODEL.yaml] [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "vehicle", "config", kEffectsFile, kModel}, {"json"});
  const Interruption interruption;
  std::optional<TextFile> file = outputFile(*values, "json");
  AskedDrives asked(*values);
  asked.read();
  const AskedVehicle& vehicle = asked.options.vehicle;
  Progress progress("comparing", 1.0);
  const RecordedComparison found = compareBags(asked, [&](double share) { progress.update(share); });
  progress.clear();
  printBags(asked.options, asked.bags, asked.gaps);
  printCoupling(found.coupling, vehicle.names);
  nlohmann::json whole = wholeJson(vehicle, found.coupling, asked.gaps);
  for (std::size_t k = 0; k < found.struts.size(); ++k) {
    const std::size_t i = vehicle.asked[k];
    std::printf("\n%s", vehicle.prefix(i, "\n").c_str());
    printComparison(found.struts[k]);
    vehicle.resultsOf(i, whole).update(toJson(found.struts[k]));
  }
  if (file) file->commit(whole.dump(2) + '\n');
  printWritten(*values, {"json"});
}

}  // namespace suspension_health_monitor
