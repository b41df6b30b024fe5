#pragma once

#include <muParser.h>

#include <memory>
#include <string>
#include <vector>

#include "suspension_health_monitor/effects.h"

namespace suspension_health_monitor {

/// A law written as an expression; a ForceEffect::Law. A copy has a parser and variables of its own.
class LawExpression {
 public:
  /// @param shapes  names, in the order in which their values come.
  /// @param has_memory  whether the expression may use s.
  /// @throws std::invalid_argument  saying what is wrong in the expression, and where.
  LawExpression(std::string text, std::vector<std::string> shapes, bool has_memory);

  LawExpression(const LawExpression& other) : LawExpression(other.text_, other.shapes_, other.has_memory_) {}
  LawExpression(LawExpression&&) = default;

  double operator()(const StrutMotion& motion, const double* shapes) const;

  /// @return true if expressions have that name already: a variable, a constant or a function.
  static bool isReserved(const std::string& name);

 private:
  struct Compiled {
    mu::Parser parser;
    std::vector<double> values;  // d, v, t, s, shapes: the parser points to them
  };

  std::string text_;
  std::vector<std::string> shapes_;
  bool has_memory_;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace suspension_health_monitor
