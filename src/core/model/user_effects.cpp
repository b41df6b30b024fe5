#include <muParser.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <regex>
#include <stdexcept>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"
#include "suspension_health_monitor/internal/base/option_table.h"
#include "suspension_health_monitor/internal/base/text.h"
#include "suspension_health_monitor/internal/model/model_settings.h"

namespace suspension_health_monitor {
namespace {

constexpr std::array kVariables{"d", "v", "t", "s"};
constexpr std::size_t kMemory = 3;  // place of s

std::string listNames(const mu::Parser& parser) {
  std::string text = "names: ";
  for (const auto& [name, address] : parser.GetVar()) text += name + ", ";
  for (const auto& [name, value] : parser.GetConst()) text += name + ", ";
  text += "functions:";
  for (const auto& [name, function] : parser.GetFunDef()) text += ' ' + name;
  return text;
}

/// The parser counts from 0, at times past the end, and says so in several wordings.
[[noreturn]] void refuse(const mu::Parser& parser, const std::string& text, const mu::ParserError& error) {
  std::string message = std::regex_replace(
      error.GetMsg(), std::regex("( found)? at (expression )?position -?[0-9]+[.]?|[.]$"), std::string());
  message = std::regex_replace(message, std::regex(" \"([^\"]*[^\" ]) *\""), " \"$1\"");
  message = shortened(message, 200);
  const int position = error.GetPos();
  const bool inside = position >= 0 && position < static_cast<int>(text.size());
  message += inside ? " at character " + std::to_string(position + 1) : " at the end";
  if (error.GetCode() == mu::ecUNASSIGNABLE_TOKEN) message += "; " + listNames(parser);
  throw std::invalid_argument(message);
}

/// What the parser would take, though it is no plain formula: `d = 3`, and several results `d, v`.
void refuseStatements(const mu::Parser& parser, const std::string& text) {
  for (std::size_t i = text.find('='); i != std::string::npos; i = text.find('=', i + 2)) {
    const bool compares = (i > 0 && std::string("<>!").find(text[i - 1]) != std::string::npos) ||
                          (i + 1 < text.size() && text[i + 1] == '=');
    if (!compares)
      throw std::invalid_argument("Unexpected \"=\" at character " + std::to_string(i + 1) + "; equality is \"==\"");
  }
  if (parser.GetNumResults() > 1) throw std::invalid_argument("has several results, must have one");
}

/// A law written as an expression; a ForceEffect::Law. A copy has a parser and variables of its own.
class LawExpression {
 public:
  /// @param shapes  names, in the order in which their values come.
  /// @param has_memory  whether the expression may use s.
  /// @throws std::invalid_argument  saying what is wrong in the expression, and where.
  LawExpression(std::string text, std::vector<std::string> shapes, bool has_memory)
      : text_(std::move(text)),
        shapes_(std::move(shapes)),
        has_memory_(has_memory),
        values_(kVariables.size() + shapes_.size(), 1.0) {
    try {
      for (std::size_t i = 0; i < kVariables.size(); ++i)
        if (i != kMemory || has_memory_) parser_.DefineVar(kVariables[i], &values_[i]);
      for (std::size_t i = 0; i < shapes_.size(); ++i) parser_.DefineVar(shapes_[i], &values_[kVariables.size() + i]);
      parser_.SetExpr(text_);
      parser_.Eval();  // compiles: from now on evaluating allocates nothing
    } catch (const mu::ParserError& error) {
      refuse(parser_, text_, error);
    }
    refuseStatements(parser_, text_);
  }

  LawExpression(const LawExpression& other) : LawExpression(other.text_, other.shapes_, other.has_memory_) {}
  LawExpression& operator=(const LawExpression&) = delete;  // the parser points to the values of its own object

  double operator()(const StrutMotion& motion, const double* shapes) const {
    values_[0] = motion.travel;
    values_[1] = motion.travel_rate;
    values_[2] = motion.time;
    values_[kMemory] = motion.memory.s;
    std::copy_n(shapes, shapes_.size(), values_.begin() + kVariables.size());
    return parser_.Eval();
  }

  /// @return true if expressions have that name already: a variable, a constant or a function.
  static bool isReserved(const std::string& name) {
    const mu::Parser parser;
    return std::find(kVariables.begin(), kVariables.end(), name) != kVariables.end() ||
           parser.GetFunDef().count(name) != 0 || parser.GetConst().count(name) != 0;
  }

 private:
  std::string text_;
  std::vector<std::string> shapes_;
  bool has_memory_;
  mutable std::vector<double> values_;  // d, v, t, s, shapes: the parser points to them
  mu::Parser parser_;
};

constexpr std::size_t kLongestText = 200, kLongestLaw = 1000;  // [characters]

struct ShapeSettings {
  std::string unit = "-", scale = "none";
  double min = 0.0, max = 0.0;
};

constexpr OptionField<ShapeSettings> kShapeFields[] = {
    {"unit", "-", "unit of the shape", &ShapeSettings::unit},
    {"scale", "-", "what min and max are multiples of", &ShapeSettings::scale, 0.0, 0.0,
     "none travel travel_rate time frequency"},
    {"min", "scale", "smallest value worth trying", &ShapeSettings::min, 1e-15, 1e15},
    {"max", "scale", "largest value worth trying, above min", &ShapeSettings::max, 1e-15, 1e15},
};

[[noreturn]] void refuse(const std::string& where, const std::string& why) {
  throw std::invalid_argument(where + ": " + why);
}

void checkText(const std::string& where, const std::string& text) {
  if (std::any_of(text.begin(), text.end(), [](unsigned char letter) { return letter < ' '; }))
    refuse(where, "must be one line");
  if (text.size() > kLongestText) refuse(where, "must be at most " + std::to_string(kLongestText) + " characters");
}

/// A law may go over several lines.
void checkLaw(const std::string& where, const std::string& law) {
  const auto is_control = [](unsigned char letter) { return letter < ' ' && letter != '\n' && letter != '\t'; };
  const auto control = std::find_if(law.begin(), law.end(), is_control);
  if (control != law.end())
    refuse(where, "has a character that is no text at " + std::to_string(control - law.begin() + 1) +
                      ", must be letters, digits and signs");
  if (law.size() > kLongestLaw)
    refuse(where, "has " + std::to_string(law.size()) + " characters, must be at most " + std::to_string(kLongestLaw));
}

ShapeParameter makeShape(const std::string& where, const std::string& name, const OptionMap& values) {
  requireName(where, name);
  if (LawExpression::isReserved(name) || name == "c" || name == "coefficient")
    refuse(where, "expressions have this name already (d, v, t, s, the coefficient c, a function), choose another");
  for (const char* wanted : {"min", "max"})
    if (values.count(wanted) == 0) refuse(where + '/' + wanted, "is missing; a shape has unit, scale, min, max");
  ShapeSettings settings;
  takeAll(where, values, kShapeFields, settings);
  if (settings.min >= settings.max) refuse(where, "min must be below max");
  checkText(where + "/unit", settings.unit);
  // In the order of ShapeScale.
  static constexpr std::array kScales{"none", "travel", "travel_rate", "time", "frequency"};
  const auto scale = std::find(kScales.begin(), kScales.end(), settings.scale) - kScales.begin();
  return {name, settings.unit, static_cast<ShapeScale>(scale), settings.min, settings.max};
}

LawExpression makeLaw(const std::string& where, const std::string& text, const std::vector<ShapeParameter>& shapes,
                      bool has_memory) {
  checkLaw(where, text);
  try {
    return {text, namesOf(shapes), has_memory};
  } catch (const std::invalid_argument& error) {
    refuse(where + " = \"" + shortened(text) + '"', error.what());
  }
}

/// Shapes at one end of their range, for a motion of that size.
std::vector<double> shapesAt(const std::vector<ShapeParameter>& shapes, double size, bool largest) {
  return mapped(shapes, [&](const ShapeParameter& shape) {
    const bool moves = shape.scale == ShapeScale::kTravel || shape.scale == ShapeScale::kTravelRate;
    return (largest ? shape.max : shape.min) * (moves ? size : 1.0);
  });
}

/// At rest and in gentle and rough motion, both ways.
template <class Law>
void checkFinite(const std::string& where, const Law& law, const std::vector<ShapeParameter>& shapes) {
  for (const double size : {1e-3, 0.1})
    for (const double travel : {0.0, size, -size})
      for (const double rate : {0.0, size, -size})
        for (const double memory : {0.0, size, -size})
          for (const double time : {0.0, 100.0})
            for (const bool largest : {false, true})
              if (!std::isfinite(law({travel, rate, time, memory}, shapesAt(shapes, size, largest).data())))
                refuse(where, "is not finite at d = " + numberText(travel) + ", v = " + numberText(rate) +
                                  ", t = " + numberText(time) + ", s = " + numberText(memory));
}

void checkNew(const std::string& where, const std::string& name) {
  for (const std::vector<std::string>& known : {namesOf(forceEffects()), namesOf(measurementEffects())})
    if (std::find(known.begin(), known.end(), name) != known.end())
      refuse(where, "a built-in effect has this name, choose another");
}

ForceEffect makeUserEffect(const std::string& name, OptionMap values) {
  const std::string where = "effects/" + shortened(name);
  requireName(where, name);
  checkNew(where, name);
  std::vector<ShapeParameter> shapes;
  for (const auto& [shape, settings] : takeGroups(values, "shapes"))
    shapes.push_back(makeShape(where + "/shapes/" + shortened(shape), shape, settings));
  if (shapes.size() > kMostUserShapes)
    refuse(where, std::to_string(shapes.size()) + " shapes, must be at most " + std::to_string(kMostUserShapes));
  for (const char* wanted : {"force", "unit"})
    if (values.count(wanted) == 0)
      refuse(where + '/' + wanted, "is missing; an effect has force, unit, and may have memory_rate, finding, shapes");
  const auto [force, memory_rate, unit, finding] =
      takeTexts(where, std::move(values), {"force", "memory_rate", "unit", "finding"});
  for (const std::string& text : {unit, finding}) checkText(where, text);

  const bool has_memory = !memory_rate.empty();
  ForceEffect effect{name,  "c (" + force + ")",
                     unit,  finding.empty() ? "a law of your own" : finding,
                     "",    makeLaw(where + "/force", force, shapes, has_memory),
                     shapes};
  checkFinite(where + "/force = \"" + shortened(force) + '"', effect.force, shapes);
  if (!has_memory) return effect;
  effect.law += ", s' = " + memory_rate;
  effect.memory_rate = makeLaw(where + "/memory_rate", memory_rate, shapes, has_memory);
  checkFinite(where + "/memory_rate = \"" + shortened(memory_rate) + '"', effect.memory_rate, shapes);
  return effect;
}

}  // namespace

std::vector<ForceEffect> takeUserEffects(OptionMap& values) {
  std::vector<ForceEffect> effects;
  for (auto& [name, settings] : takeGroups(values, "effects")) effects.push_back(makeUserEffect(name, settings));
  return effects;
}

}  // namespace suspension_health_monitor
