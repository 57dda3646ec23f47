#include "base/math/Quantiles.h"

#include <algorithm>
#include <cmath>

namespace heft {

namespace {
double between(const std::vector<double>& sorted, double fraction) {
  const double position = fraction * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return std::lerp(sorted[below], sorted[above], position - static_cast<double>(below));
}
}  // namespace

std::optional<double> quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  return between(values, fraction);
}

std::optional<QuartilesOf> quartiles(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  std::ranges::sort(values);
  return QuartilesOf{between(values, 0.25), between(values, 0.5), between(values, 0.75)};
}

}  // namespace heft
