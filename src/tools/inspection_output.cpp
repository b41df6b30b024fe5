#include "inspection_output.h"

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cmath>
#include <cstdio>
#include <ctime>

#include "html_page.h"
#include "suspension_health_monitor/internal/base/text.h"

namespace suspension_health_monitor {

namespace {

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

}  // namespace

std::string summaryOf(const Inspected& inspected) {
  std::vector<std::string> reasons;
  for (const InspectedNumber& number : inspected.result.numbers)
    if (number.verdict == inspected.result.verdict && number.verdict != InspectionVerdict::kPasses)
      reasons.push_back(std::string(nameOf(number.quantity)) + " of " +
                        inspected.struts[number.weaker.value_or(number.struts.front())].name);
  const std::string verdict = nameOf(inspected.result.verdict);
  return reasons.empty() ? verdict : verdict + ": " + join(reasons);
}

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

}  // namespace suspension_health_monitor
