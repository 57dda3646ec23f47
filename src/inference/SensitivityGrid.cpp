#include "inference/SensitivityGrid.h"

#include <algorithm>

namespace heft {

namespace {
void add(OnGrid& sum, const OnGrid& more, double times) {
  for (std::size_t i = 0; i < n_grid; ++i) sum[i] += times * more[i];
}
}  // namespace

double top_of(const OnGrid& sum) {
  const auto best = static_cast<std::size_t>(std::ranges::max_element(sum) - sum.begin());
  if (best == 0 || best + 1 == n_grid) return static_cast<double>(best);
  const double before = sum[best - 1], here = sum[best], after = sum[best + 1];
  const double bend = before - 2 * here + after;
  return static_cast<double>(best) + (bend < 0 ? (before - after) / (2 * bend) : 0);
}

OnGrid sum_of(std::span<const OnGrid> people, std::span<const double> times) {
  OnGrid sum{};
  for (std::size_t i = 0; i < people.size(); ++i)
    if (times[i] > 0) add(sum, people[i], times[i]);
  return sum;
}

double between_places(const OnGrid& values, double place) {
  const auto before = std::min(static_cast<std::size_t>(place), n_grid - 2);
  return std::lerp(values[before], values[before + 1], place - static_cast<double>(before));
}

}  // namespace heft
