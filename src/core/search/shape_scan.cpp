#include "shape_scan.h"

#include <algorithm>
#include <cmath>

namespace suspension_health_monitor {
namespace {

constexpr double kRatio = 1.45;  // between neighbours
constexpr double kMostCombinations = 64.0;

}  // namespace

std::vector<std::vector<double>> scanShapes(const ForceEffect& effect, const MotionScale& scales) {
  const auto dimensions = static_cast<double>(effect.shapes.size());
  const auto most = dimensions > 0.0 ? static_cast<int>(std::pow(kMostCombinations, 1.0 / dimensions) + 1e-9) : 1;
  std::vector<std::vector<double>> result{{}};
  for (const ShapeParameter& shape : effect.shapes) {
    const double ratio = shape.max / shape.min;
    const int count =
        std::clamp(static_cast<int>(std::lround(std::log(ratio) / std::log(kRatio))), std::min(2, most), most);
    std::vector<std::vector<double>> longer;
    for (const std::vector<double>& shapes : result)
      for (int i = 0; i < count; ++i) {
        longer.push_back(shapes);
        longer.back().push_back(scales.unit(shape.scale) * shape.min * std::pow(ratio, (i + 0.5) / count));
      }
    result = std::move(longer);
  }
  return result;
}

}  // namespace suspension_health_monitor
