#include "physics/techniques/MassCurve.h"

#include <fmt/format.h>

namespace heft {

std::string displacement_text(std::string_view name, const MassCurve& curve, std::string_view unit,
                              double return_s) {
  std::string values;
  for (const MassCurve::Point& point : curve.points())
    values += fmt::format("{:g}{} at {:g} g, ", point.value, unit, 1e3 * point.mass_kg);
  return fmt::format("{} {}back in {:g} s", name, values, return_s);
}

}  // namespace heft
