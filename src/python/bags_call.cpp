#include "bags_call.h"

#include "../tools/bag_options.h"
#include "../tools/command.h"

namespace suspension_health_monitor {

boost::program_options::variables_map parsed(const Arguments& arguments) {
  boost::program_options::options_description description("options");
  addBagOptions(description);
  addModelOptions(description);
  description.add_options()(kBaseline, boost::program_options::value<std::string>());
  const boost::program_options::variables_map values = *parse(arguments, "", description, "bag");
  isOfVehicle(values);  // refuses a strut of none
  return values;
}

}  // namespace suspension_health_monitor
