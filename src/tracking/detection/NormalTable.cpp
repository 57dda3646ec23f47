#include "tracking/detection/NormalTable.h"

#include <cmath>
#include <numbers>

namespace heft {

const NormalTable normal_table = [] {
  NormalTable made{};
  for (std::size_t i = 0; i < made.size(); ++i) {
    const double x = static_cast<double>(i) / normal_steps_per_unit - normal_end;
    made[i] = {0.5 * std::erfc(-x / std::numbers::sqrt2),
               std::exp(-x * x / 2) / std::sqrt(2 * std::numbers::pi)};
  }
  return made;
}();

}  // namespace heft
