// The values of a parameter on a grid, as files write them: a number, a list, or a table with the
// ends and the spacing.
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "protocol/toml/TableReader.h"

namespace heft {

namespace {
constexpr int most_values = 10'000;

enum class Spacing { linear, log };

// The ends are exact. The rest as numpy's linspace and geomspace, to the last digits.
double between(Spacing spacing, double from, double to, int i, int n) {
  if (i == n - 1) return to;
  const double fraction = static_cast<double>(i) / (n - 1);
  return spacing == Spacing::log ? from * std::pow(to / from, fraction)
                                 : from + (to - from) * fraction;
}

std::vector<double> stepped(double from, double to, double step) {
  std::vector<double> values;
  const double n_steps = std::floor((to - from) / step + 1e-9);
  for (int i = 0; i <= n_steps; ++i) values.push_back(from + i * step);
  return values;
}
}  // namespace

template <>
struct EnumNames<Spacing> {
  static constexpr std::array<std::string_view, 2> names{"linear", "log"};
};

void TableReader::read(std::string_view key, ValueGrid& field, const Range& range) {
  if (has_table(key)) return read_spaced(key, field, range);
  if (is_list(key)) return read(key, field.values, range);
  const TomlEntry* entry = take(key);
  if (!entry) return;
  if (!std::holds_alternative<double>(entry->node.value) &&
      !std::holds_alternative<std::int64_t>(entry->node.value))
    return refuse(entry->node, key,
                  "a number, numbers in brackets, {from, to, step} or {from, to, n, spacing}");
  if (const auto value = number(entry->node, key, range)) field.values = {*value};
}

void TableReader::read_spaced(std::string_view key, ValueGrid& field, const Range& range) {
  TableReader inner = *table(key);
  double from = 0, to = 0, step = 1;
  int n = 2;
  Spacing spacing = Spacing::linear;
  inner.require({"from", "to"});
  inner.read("from", from, range);
  inner.read("to", to, range);
  inner.read("step", step, above_zero);
  inner.read("n", n, {2, most_values});
  inner.read("spacing", spacing);
  inner.close();
  const auto is_good = [&] { return inner.good({"from", "to", "step", "n", "spacing"}); };
  if (is_good() && inner.has("step") == inner.has("n"))
    inner.mistake("step", fmt::format("{} needs \"step\" or \"n\", expected one of them", key));
  if (is_good() && inner.has("step") && inner.has("spacing"))
    inner.mistake("spacing", "spacing together with step, expected n instead of step");
  if (is_good() && to <= from)
    inner.mistake("to", fmt::format("to is {}, expected above from {}", to, from));
  if (is_good() && spacing == Spacing::log && from <= 0)
    inner.mistake("from", fmt::format("from is {}, expected above 0 for spacing \"log\"", from));
  if (is_good() && inner.has("step") && (to - from) / step >= most_values)
    inner.mistake(
        "step", fmt::format("step makes more than {} values, expected a larger step", most_values));
  if (!is_good()) {
    mistaken_.emplace(key);
    return;
  }
  if (inner.has("step")) {
    field.values = stepped(from, to, step);
    return;
  }
  field.values.clear();
  for (int i = 0; i < n; ++i) field.values.push_back(between(spacing, from, to, i, n));
}

}  // namespace heft
