#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "command.h"
#include "html_page.h"
#include "recorded_drives.h"
#include "recorded_monitor.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/fit/free_decay.h"
#include "suspension_health_monitor/internal/health/inspection.h"

namespace suspension_health_monitor {
namespace {

constexpr const char *kWheelMass = "wheel-mass", *kTyreStiffness = "tyre-stiffness", *kBounce = "bounce";  // options

/// What `inspect` knows of a vehicle, and tells.
struct Inspected {
  std::vector<InspectedStrut> struts;
  double seconds;  ///< of data
  Inspection result;
};

/// @return the option's value, or LOW..HIGH.
/// @throws std::invalid_argument  naming the option and its value.
std::optional<ValueRange> rangeOf(const po::variables_map& values, const std::string& option) {
  if (values.count(option) == 0) return std::nullopt;
  const auto text = values[option].as<std::string>();
  const std::size_t dots = text.find("..");
  const auto number = [&](const std::string& part) {
    char* end = nullptr;
    const double value = std::strtod(part.c_str(), &end);
    return part.empty() || *end != '\0' || !std::isfinite(value) ? 0.0 : value;
  };
  const ValueRange range{number(text.substr(0, dots)),
                         number(dots == std::string::npos ? text : text.substr(dots + 2))};
  if (!(range.low > 0.0 && range.high >= range.low))
    throw std::invalid_argument("--" + option + ' ' + shortened(text) +
                                ", must be a number above 0 or LOW..HIGH with 0 < LOW <= HIGH");
  return range;
}

/// Wheel and tyre over the sprung mass of a strut, if they are asked for.
/// @throws std::invalid_argument  for one without the other, and for what no vehicle has: in SI without sprung_mass, or
/// the other way round.
std::optional<WheelRanges> wheelOf(const po::variables_map& values, const std::optional<double>& sprung_mass) {
  const std::optional<ValueRange> mass = rangeOf(values, kWheelMass), tyre = rangeOf(values, kTyreStiffness);
  if (mass.has_value() != tyre.has_value())
    throw std::invalid_argument("--wheel-mass and --tyre-stiffness, must be given both or none");
  if (!mass) return std::nullopt;
  const auto over = [&](const char* option, const ValueRange& range, const char* unit, double least, double most) {
    const double unit_mass = sprung_mass.value_or(1.0);
    for (const double value : {range.low, range.high})
      requireIn(std::string(sprung_mass ? "--" : "without sprung_mass, --") + option + " over the sprung mass",
                value / unit_mass, unit, least, most);
    return ValueRange{range.low / unit_mass, range.high / unit_mass};
  };
  return WheelRanges{over(kWheelMass, *mass, "-", 0.003, 3.0), over(kTyreStiffness, *tyre, "1/s^2", 30.0, 1e5)};
}

InspectionLimits limitsOf(const po::variables_map& values) {
  const auto share = [&](const char* option) {
    const auto value = values[option].as<double>();
    requireIn(std::string("--") + option, value, "%", 1.0, 99.0);
    return value / 100.0;
  };
  const auto ratio = values["least-damping-ratio"].as<double>();
  requireAboveZero("--least-damping-ratio", ratio, "-");
  return {ratio, share("most-imbalance"), share("least-adhesion")};
}

/// @return why a strut's estimate is not to be trusted, in words; nothing: it may.
std::string doubtOf(const IdentifyResult& found, const std::vector<std::string>& faults) {
  if (!faults.empty()) return "mend a sensor first: " + faults.front();
  if (!found.estimate.tellsChanges()) return describe(found.estimate.doubt);
  return found.isSteady() ? "" : "the strut changed during the drive: drive again";
}

/// By the live monitor's blocks, with what they know of the model's error beside.
std::vector<InspectedStrut> strutsOf(RecordedMonitor& recorded) {
  const VehicleIdentification vehicle = recorded.identified();
  const AskedVehicle& asked = recorded.vehicle();
  const StrutPlaces places = asked.isStrutAlone() ? StrutPlaces() : recorded.monitor().vehicle()->places();
  std::vector<InspectedStrut> struts;
  for (const std::size_t i : asked.asked)
    struts.push_back({asked.isStrutAlone() ? "strut" : asked.names[i], recorded.overTheDrive(i),
                      places.empty() ? std::nullopt : std::optional(places[i]), std::nullopt,
                      doubtOf(vehicle.struts[i], recorded.mountFaults(i))});
  return struts;
}

/// Of a body that was bounced by hand.
Inspected bounced(BagOptions& options) {
  TopicGaps gaps(options.settings.common.shell.input_timeout);
  std::vector<Drive> drives;
  double seconds = 0.0;
  const RecordedDrives recorded = readDrives(options, gaps);
  for (const VehicleDrive& drive : recorded.drives) {
    drives.push_back(drive.struts.front());
    seconds += static_cast<double>(drives.back().samples.size()) * options.period();
  }
  const StrutEstimate found = estimateFromFreeDecays(drives);
  const std::string doubt = found.valid() ? "" : "no free decays: push harder, let go, wait until it rests, ten times";
  printBags(options, recorded.bags, gaps);
  return {{{"strut", found, std::nullopt, std::nullopt, doubt}}, seconds, {}};
}

constexpr const char* kNoLegalTest = "This is no replacement of a legal test.";

const char* nameOf(InspectionVerdict verdict) {
  constexpr std::array kNames{"passes", "fails", "cannot tell"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const char* nameOf(InspectedQuantity quantity) {
  constexpr std::array kNames{"damping ratio", "damping imbalance", "stiffness imbalance", "adhesion"};
  return kNames[static_cast<std::size_t>(quantity)];
}

using Row = std::array<std::string, 6>;

/// @return a line per number, the headings first.
std::vector<Row> rowsOf(const Inspected& inspected) {
  std::vector<Row> rows{{"number", "strut", "value", "95 % interval", "limit", "verdict"}};
  for (std::size_t i = 0; i < inspected.struts.size(); ++i) {
    const InspectedStrut& strut = inspected.struts[i];
    const ValueRange& range = inspected.result.frequencies[i];
    const bool is_known = strut.doubt.empty();
    rows.push_back({"bounce frequency", strut.name,
                    is_known ? formatted("%.2f Hz", strut.estimate.naturalFrequency()) : "-",
                    is_known ? formatted("%.2f to %.2f", range.low, range.high) : "-", "-", "-"});
    if (!strut.wheel) rows.push_back({"adhesion", strut.name, "-", "-", "-", "not asked"});
  }
  for (const InspectedNumber& number : inspected.result.numbers) {
    const auto names = mapped(number.struts, [&](std::size_t i) { return inspected.struts[i].name; });
    const bool is_ratio = number.quantity == InspectedQuantity::kDampingRatio, is_known = !std::isnan(number.value);
    const double unit = is_ratio ? 1.0 : 100.0;
    const char* const sign = is_ratio ? "" : " %";
    const auto cell = [&](double value) { return formatted(is_ratio ? "%.3f" : "%.1f", unit * value); };
    rows.push_back({nameOf(number.quantity), join(names, " / "), is_known ? cell(number.value) + sign : "-",
                    is_known ? cell(number.interval.low) + " to " + cell(number.interval.high) + sign : "-",
                    formatted("%s %.3g%s", names.size() == 2 ? "at most" : "at least", unit * number.limit, sign),
                    describe(number, inspected.struts, inspected.seconds)});
  }
  return rows;
}

json toJson(const ValueRange& range) { return {range.low, range.high}; }

std::string escaped(std::string text) {
  for (const auto& [letter, name] : {std::pair("&", "&amp;"), {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}})
    boost::replace_all(text, letter, name);
  return text;
}

/// @return the verdict and what fails, or what is not known.
std::string summaryOf(const Inspected& inspected) {
  std::vector<std::string> reasons;
  for (const InspectedNumber& number : inspected.result.numbers)
    if (number.verdict == inspected.result.verdict && number.verdict != InspectionVerdict::kPasses)
      reasons.push_back(std::string(nameOf(number.quantity)) + " of " +
                        inspected.struts[number.weaker.value_or(number.struts.front())].name);
  const std::string verdict = nameOf(inspected.result.verdict);
  return reasons.empty() ? verdict : verdict + ": " + join(reasons);
}

/// Tells people every number and the verdict.
void printInspection(const Inspected& inspected) {
  const std::vector<Row> rows = rowsOf(inspected);
  std::array<int, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) widths[i] = std::max(widths[i], static_cast<int>(row[i].size()));
  std::printf("\n");
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) std::printf("%-*s  ", widths[i], row[i].c_str());
    std::printf("%s\n", row.back().c_str());
  }
  std::printf("\nverdict: %s\n%s\n", summaryOf(inspected).c_str(), kNoLegalTest);
}

json toJson(const Inspected& inspected) {
  json whole{{"verdict", nameOf(inspected.result.verdict)}, {"seconds", inspected.seconds}, {"numbers", json::array()}};
  for (std::size_t i = 0; i < inspected.struts.size(); ++i)
    whole["bounce_frequency"][inspected.struts[i].name] = {{"value", inspected.struts[i].estimate.naturalFrequency()},
                                                           {"interval", toJson(inspected.result.frequencies[i])}};
  for (const InspectedNumber& number : inspected.result.numbers) {
    json its{{"quantity", boost::replace_all_copy(std::string(nameOf(number.quantity)), " ", "_")},
             {"struts", json::array()},
             {"value", number.value},
             {"interval", toJson(number.interval)},
             {"limit", number.limit},
             {"verdict", nameOf(number.verdict)},
             {"sentence", describe(number, inspected.struts, inspected.seconds)}};
    for (const std::size_t i : number.struts) its["struts"].push_back(inspected.struts[i].name);
    if (number.weaker) its["weaker"] = inspected.struts[*number.weaker].name;
    whole["numbers"].push_back(std::move(its));
  }
  return whole;
}

/// @param values  of the command.  @param bags  their paths.
/// @return the page, one sheet of A4 without a script.
std::string pageOf(const Inspected& inspected, const po::variables_map& values, const std::vector<std::string>& bags) {
  std::string lines;
  const std::vector<Row> rows = rowsOf(inspected);
  for (const Row& row : rows) {
    const char* const tag = &row == &rows.front() ? "th" : "td";
    lines += "<tr>";
    for (const std::string& cell : row) lines += formatted("<%s>%s</%s>", tag, escaped(cell).c_str(), tag);
    lines += "</tr>\n";
  }
  std::string page(inspectionTemplate());
  const std::time_t now = std::time(nullptr);
  std::array<char, 32> date{};
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M UTC", std::gmtime(&now));
  for (const auto& [key, value] :
       {std::pair<const char*, std::string>("@@verdict@@", escaped(summaryOf(inspected))),
        {"@@source@@", escaped(join(fileNames(bags)) + formatted(": %.4g s", inspected.seconds))},
        {"@@rows@@", lines},
        {"@@warning@@", kNoLegalTest},
        {"@@command@@", escaped(values[kCommandLine].as<std::string>())},
        {"@@made@@", std::string(date.data()) + ", suspension_bag " PACKAGE_VERSION}})
    boost::replace_first(page, key, value);
  return page;
}

void inspectBags(const po::variables_map& values) {
  const InspectionLimits limits = limitsOf(values);
  const bool by_hand = values.count(kBounce) != 0;
  if (by_hand && values.count(kVehicle) != 0)
    throw std::invalid_argument("--bounce beside --vehicle, must be left out: give the topics of one strut");
  BagOptions options = readBagOptions(values);
  std::vector<std::optional<WheelRanges>> wheels;
  for (const std::size_t i : options.vehicle.asked)
    wheels.push_back(wheelOf(values, options.settings.struts[i].monitor.sprung_mass));
  std::optional<TextFile> findings = outputFile(values, "json");
  std::optional<HtmlPage> page = reportPage(values);
  Inspected inspected{};
  if (by_hand) {
    inspected = bounced(options);
  } else {
    RecordedMonitor recorded(options, HealthyStruts(options.vehicle.names.size()), true);
    recorded.read();
    inspected = {strutsOf(recorded), toSeconds(recorded.log(0).elapsed()), {}};
    recorded.printInput();
  }
  for (std::size_t i = 0; i < wheels.size(); ++i) inspected.struts[i].wheel = wheels[i];
  inspected.result = inspect(inspected.struts, limits);
  if (findings) findings->commit(toJson(inspected).dump(2) + '\n');
  if (page) page->write(pageOf(inspected, values, options.bags.paths));
  printInspection(inspected);
  printWritten(values, {"json", kReport});
  if (inspected.result.verdict == InspectionVerdict::kFails) throw FailedInspection(summaryOf(inspected));
  if (inspected.result.verdict == InspectionVerdict::kCannotTell) throw TooLittleError(summaryOf(inspected));
}

}  // namespace

void inspect(const Arguments& arguments) {
  po::options_description description = bagOptions();
  auto add = description.add_options();
  add("least-damping-ratio", po::value<double>()->default_value(0.1, "0.1"),
      "[-] a strut with less fails. Lehr's damping ratio: at 0.1 a bounce keeps half its size each period");
  add("most-imbalance", po::value<double>()->default_value(30.0, "30"),
      "[%] an axle with more fails: 1 - weaker/stronger of damping, of stiffness. Limits of adhesion in use: 15 to 30");
  add("least-adhesion", po::value<double>()->default_value(20.0, "20"),
      "[%] a wheel with less fails. Usual classes of EUSAMA testers: below 20 bad, below 40 weak");
  add(kWheelMass, po::value<std::string>(),
      "VALUE or LOW..HIGH: unsprung mass over sprung mass [-], with sprung_mass in kg, for the adhesion");
  add(kTyreStiffness, po::value<std::string>(),
      "VALUE or LOW..HIGH: tyre stiffness over sprung mass [1/s^2], with sprung_mass in N/m, for the adhesion");
  add(kBounce, "the vehicle stands, and its body was pushed by hand and let go: judge the free decays");
  add(kReport, po::value<std::string>(), "write DIR/report.html: one sheet of A4 to print");
  runOnBags(arguments, "inspect BAG... [OPTION]...", description, {"json", kReport}, &inspectBags);
}

}  // namespace suspension_health_monitor
