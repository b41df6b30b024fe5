#include "law_expression.h"

#include <algorithm>
#include <array>
#include <regex>
#include <stdexcept>

#include "suspension_health_monitor/internal/plain_text.h"

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

}  // namespace

LawExpression::LawExpression(std::string text, std::vector<std::string> shapes, bool has_memory)
    : text_(std::move(text)),
      shapes_(std::move(shapes)),
      has_memory_(has_memory),
      compiled_(std::make_unique<Compiled>()) {
  mu::Parser& parser = compiled_->parser;
  std::vector<double>& values = compiled_->values;
  values.resize(kVariables.size() + shapes_.size(), 1.0);
  try {
    for (std::size_t i = 0; i < kVariables.size(); ++i)
      if (i != kMemory || has_memory_) parser.DefineVar(kVariables[i], &values[i]);
    for (std::size_t i = 0; i < shapes_.size(); ++i) parser.DefineVar(shapes_[i], &values[kVariables.size() + i]);
    parser.SetExpr(text_);
    parser.Eval();  // compiles: from now on evaluating allocates nothing
  } catch (const mu::ParserError& error) {
    refuse(parser, text_, error);
  }
  refuseStatements(parser, text_);
}

double LawExpression::operator()(const StrutMotion& motion, const double* shapes) const {
  std::vector<double>& values = compiled_->values;
  values[0] = motion.travel;
  values[1] = motion.travel_rate;
  values[2] = motion.time;
  values[kMemory] = motion.memory.s;
  std::copy_n(shapes, shapes_.size(), values.begin() + kVariables.size());
  return compiled_->parser.Eval();
}

bool LawExpression::isReserved(const std::string& name) {
  const mu::Parser parser;
  return std::find(kVariables.begin(), kVariables.end(), name) != kVariables.end() ||
         parser.GetFunDef().count(name) != 0 || parser.GetConst().count(name) != 0;
}

}  // namespace suspension_health_monitor
