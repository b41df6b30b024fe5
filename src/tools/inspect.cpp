#include "suspension_health_monitor/inspect.h"

#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cstdio>
#include <ctime>

#include "command.h"
#include "html_page.h"
#include "json_of.h"
#include "long_work.h"
#include "recorded_monitor.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {
namespace {

namespace po = boost::program_options;
using nlohmann::json;

constexpr const char *kMassRatio = "mass-ratio", *kTyreToMass = "tyre-to-mass", *kWheelMass = "wheel-mass",
                     *kTyreStiffness = "tyre-stiffness";  // names of options

const char* nameOf(InspectionVerdict verdict) {
  constexpr std::array kNames{"passes", "fails", "cannot tell"};
  return kNames[static_cast<std::size_t>(verdict)];
}

const char* nameOf(InspectedQuantity quantity) {
  constexpr std::array kNames{"damping ratio", "damping imbalance", "stiffness imbalance", "adhesion"};
  return kNames[static_cast<std::size_t>(quantity)];
}

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

/// Wheel and tyre as the options give them: over the sprung mass, or in SI.
struct AskedWheel {
  explicit AskedWheel(const po::variables_map& values)
      : mass_ratio(rangeOf(values, kMassRatio)),
        tyre_to_mass(rangeOf(values, kTyreToMass)),
        mass(rangeOf(values, kWheelMass)),
        tyre(rangeOf(values, kTyreStiffness)) {
    const auto refuse = [](const std::string& what) {
      throw std::invalid_argument(what + ", must be one option for the mass of the wheel and one for the tyre");
    };
    if (mass_ratio && mass) refuse("--mass-ratio beside --wheel-mass");
    if (tyre_to_mass && tyre) refuse("--tyre-to-mass beside --tyre-stiffness");
    if ((mass_ratio || mass) != (tyre_to_mass || tyre))
      refuse(mass_ratio || mass ? "the mass of the wheel without its tyre" : "a tyre without the mass of the wheel");
  }

  /// @throws std::invalid_argument  if a value in SI needs the sprung mass and it is not known.
  std::optional<WheelRanges> over(const std::optional<double>& sprung_mass) const {
    if (!mass_ratio && !mass) return std::nullopt;
    if ((mass || tyre) && !sprung_mass)
      throw std::invalid_argument(
          "--wheel-mass or --tyre-stiffness without sprung_mass: set it, or give --mass-ratio "
          "and --tyre-to-mass");
    const auto divided = [&](const ValueRange& range) {
      return ValueRange{range.low / *sprung_mass, range.high / *sprung_mass};
    };
    return WheelRanges{mass_ratio ? *mass_ratio : divided(*mass), tyre_to_mass ? *tyre_to_mass : divided(*tyre)};
  }

  std::optional<ValueRange> mass_ratio, tyre_to_mass, mass, tyre;
};

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

/// What a command knows of a vehicle, and tells.
struct Inspected {
  Inspected(RecordedMonitor& recorded, const AskedWheel& wheel, const InspectionLimits& limits) {
    const VehicleIdentification vehicle = recorded.identified();
    const StrutPlaces places =
        recorded.vehicle().isStrutAlone() ? StrutPlaces() : recorded.monitor().vehicle()->places();
    for (const std::size_t i : recorded.vehicle().asked) {
      const IdentifyResult& found = vehicle.struts[i];
      struts.push_back({recorded.vehicle().isStrutAlone() ? "strut" : recorded.vehicle().names[i], found.estimate,
                        places.empty() ? std::nullopt : std::optional(places[i]),
                        wheel.over(recorded.strut(i).options().sprung_mass), doubtOf(found, recorded.mountFaults(i))});
      seconds = static_cast<double>(found.samples) * found.sample_period;
    }
    result = inspect(struts, limits);
  }

  std::vector<InspectedStrut> struts;
  double seconds = 0.0;  ///< of data
  Inspection result;
};

using Row = std::array<std::string, 6>;

/// @return a line per number, the headings first.
std::vector<Row> rowsOf(const Inspected& inspected) {
  std::vector<Row> rows{{"number", "of", "value", "95 % interval", "limit", "verdict"}};
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
    std::vector<std::string> names;
    for (const std::size_t i : number.struts) names.push_back(inspected.struts[i].name);
    const bool is_ratio = number.quantity == InspectedQuantity::kDampingRatio, is_known = !std::isnan(number.value);
    const double unit = is_ratio ? 1.0 : 100.0;
    const char* const sign = is_ratio ? "" : " %";
    const auto cell = [&](double value) { return formatted(is_ratio ? "%.3f" : "%.0f", unit * value); };
    rows.push_back({nameOf(number.quantity), join(names, " / "), is_known ? cell(number.value) + sign : "-",
                    is_known ? cell(number.interval.low) + " to " + cell(number.interval.high) + sign : "-",
                    formatted("%s %.3g%s", names.size() == 2 ? "at most" : "at least", unit * number.limit, sign),
                    describe(number, inspected.struts, inspected.seconds)});
  }
  return rows;
}

constexpr const char* kNoLegalTest = "This is no replacement of a legal test.";

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

void print(const Inspected& inspected) {
  const std::vector<Row> rows = rowsOf(inspected);
  std::array<int, std::tuple_size_v<Row>> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i + 1 < row.size(); ++i) widths[i] = std::max(widths[i], static_cast<int>(row[i].size()));
  std::printf("\n");
  for (const Row& row : rows) {
    for (std::size_t i = 0; i + 1 < row.size(); ++i) std::printf("%-*s  ", widths[i], row[i].c_str());
    std::printf("%s\n", row.back().c_str());
  }
  std::printf("\nthe vehicle %s\n%s\n", summaryOf(inspected).c_str(), kNoLegalTest);
}

json toJson(const ValueRange& range) { return {range.low, range.high}; }

json toJson(const Inspected& inspected, const RecordedMonitor& recorded) {
  json whole{{"silent", recorded.gaps().toJson()},
             {"verdict", nameOf(inspected.result.verdict)},
             {"seconds", inspected.seconds},
             {"numbers", json::array()}};
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

std::string escaped(std::string text) {
  for (const auto& [letter, name] : {std::pair("&", "&amp;"), {"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}})
    boost::replace_all(text, letter, name);
  return text;
}

/// @return the page, one sheet of A4 without a script.
std::string pageOf(const Inspected& inspected, const po::variables_map& values, const BagOptions& options) {
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
        {"@@source@@", escaped(join(fileNames(options.bags.paths)) + formatted(": %.4g s", inspected.seconds))},
        {"@@rows@@", lines},
        {"@@warning@@", kNoLegalTest},
        {"@@command@@", escaped(values[kCommandLine].as<std::string>())},
        {"@@made@@", std::string(date.data()) + ", suspension_bag " PACKAGE_VERSION}})
    boost::replace_first(page, key, value);
  return page;
}

void inspectBags(const po::variables_map& values) {
  const InspectionLimits limits = limitsOf(values);
  const AskedWheel wheel(values);
  const BagOptions options = readBagOptions(values);
  for (const std::size_t i : options.vehicle.asked) (void)wheel.over(options.settings.struts[i].monitor.sprung_mass);
  std::optional<TextFile> findings = outputFile(values, "json");
  std::optional<HtmlPage> page;
  if (values.count(kReport) != 0) page.emplace(values[kReport].as<std::string>());
  RecordedMonitor recorded(options, HealthyStruts(options.vehicle.names.size()), {});
  recorded.read();
  const Inspected inspected(recorded, wheel, limits);
  if (findings) findings->commit(toJson(inspected, recorded).dump(2) + '\n');
  if (page) page->write(pageOf(inspected, values, options));
  recorded.printInput();
  print(inspected);
  printWritten(values, {"json", kReport});
  if (inspected.result.verdict == InspectionVerdict::kFails) throw FailedInspection(summaryOf(inspected));
  if (inspected.result.verdict == InspectionVerdict::kCannotTell) throw TooLittleError(summaryOf(inspected));
}

}  // namespace

void inspect(const Arguments& arguments) {
  po::options_description description("options");
  addBagOptions(description);
  auto add = description.add_options();
  add("least-damping-ratio", po::value<double>()->default_value(0.1, "0.1"),
      "[-] a strut with less fails: Lehr's damping ratio, as theta testers tell it");
  add("most-imbalance", po::value<double>()->default_value(30.0, "30"),
      "[%] an axle with more fails, 1 - weaker/stronger of damping, of stiffness. Workshops: 15 to 30");
  add("least-adhesion", po::value<double>()->default_value(20.0, "20"),
      "[%] a wheel with less fails. EUSAMA: below 20 bad, below 40 weak");
  add(kMassRatio, po::value<std::string>(), "VALUE or LOW..HIGH: unsprung over sprung mass [-], for the adhesion");
  add(kTyreToMass, po::value<std::string>(), "VALUE or LOW..HIGH: tyre stiffness over sprung mass [1/s^2]");
  add(kWheelMass, po::value<std::string>(), "the same as --mass-ratio in kg, with sprung_mass");
  add(kTyreStiffness, po::value<std::string>(), "the same as --tyre-to-mass in N/m, with sprung_mass");
  add(kReport, po::value<std::string>(), "write DIR/report.html: one sheet of A4 to print");
  const auto values = parse(arguments, "inspect BAG... [OPTION]...", description, "bag");
  if (!values) return;
  requireSeparateFiles(*values, {"bag", "vehicle", "config"}, {"json", kReport});
  const Interruption interruption;
  inspectBags(*values);
}

}  // namespace suspension_health_monitor
