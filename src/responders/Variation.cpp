// How the parameters of simulated participants differ from one to the next.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/Random.h"
#include "responders/ResponderParameters.h"

namespace heft {

namespace {
constexpr std::string_view correlation_start = "correlation.";
constexpr double most_spread = 3;

std::optional<std::size_t> row_of(std::string_view name, std::span<const ParameterPart> parts) {
  const ParameterRow* row = find_row(name, parts);
  if (!row) return std::nullopt;
  return static_cast<std::size_t>(row - parameter_rows().data());
}

std::string unknown(std::string_view name, std::span<const ParameterPart> parts) {
  std::vector<std::string_view> known;
  for (const ParameterRow& row : parameter_rows())
    if (row_of(row.name, parts)) known.push_back(row.name);
  if (const auto nearest = nearest_name(name, known))
    return fmt::format("unknown parameter \"{}\", did you mean \"{}\"?", name, *nearest);
  return fmt::format("unknown parameter \"{}\", expected {}", name, quoted_list(known));
}
}  // namespace

Variation::Variation() {
  const auto rows = parameter_rows();
  matrix_.assign(rows.size(), std::vector<double>(rows.size(), 0));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    spread_.push_back(rows[i].spread);
    matrix_[i][i] = 1;
  }
}

bool Variation::takes(std::string_view name) {
  return name.ends_with(spread_ending) || name.starts_with(correlation_start);
}

std::string Variation::set(const Parameter& parameter, std::span<const ParameterPart> parts) {
  std::string_view name = parameter.name;
  const auto* value = std::get_if<double>(&parameter.value);
  if (!value) return fmt::format("{} must be a number", name);
  if (!name.starts_with(correlation_start)) {
    name.remove_suffix(spread_ending.size());
    const auto row = row_of(name, parts);
    if (!row) return unknown(name, parts);
    if (!(*value >= 0 && *value <= most_spread))
      return fmt::format("{} is {}, expected 0 to {}", parameter.name, *value, most_spread);
    spread_[*row] = *value;
    return {};
  }
  name.remove_prefix(correlation_start.size());
  const std::size_t dot = name.find('.');
  if (dot == std::string_view::npos)
    return fmt::format("{} must name two parameters: [correlation.NAME] with NAME = NUMBER",
                       parameter.name);
  const std::string_view first = name.substr(0, dot), second = name.substr(dot + 1);
  const auto i = row_of(first, parts), j = row_of(second, parts);
  if (!i) return unknown(first, parts);
  if (!j) return unknown(second, parts);
  if (i == j) return fmt::format("{} is a correlation of a parameter with itself", parameter.name);
  if (matrix_[*i][*j] != 0) return fmt::format("{} is given twice", parameter.name);
  if (!(*value > -1 && *value < 1))
    return fmt::format("{} is {}, expected a number between -1 and 1", parameter.name, *value);
  matrix_[*i][*j] = matrix_[*j][*i] = *value;
  last_correlation_ = parameter.place;
  return {};
}

// Cholesky-Banachiewicz. A row without correlations stays a row of the identity matrix, so that its
// draws are those of a file without correlations, bit by bit.
std::optional<Mistake> Variation::factorize() {
  const std::size_t n = matrix_.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = matrix_[i][j];
      for (std::size_t k = 0; k < j; ++k) rest -= matrix_[i][k] * matrix_[j][k];
      if (i == j && rest < 1e-9)
        return Mistake{last_correlation_, "no distribution has all these correlations together"};
      matrix_[i][j] = i == j ? std::sqrt(rest) : rest / matrix_[j][j];
    }
    std::fill(matrix_[i].begin() + static_cast<std::ptrdiff_t>(i) + 1, matrix_[i].end(), 0.0);
  }
  return std::nullopt;
}

void Variation::vary(std::uint64_t seed, ResponderParameters& parameters) const {
  const auto rows = parameter_rows();
  std::vector<double> independent;
  for (const ParameterRow& row : rows)
    independent.push_back(RandomStream(seed, fmt::format("participant {}", row.name)).normal());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    double z = 0;
    for (std::size_t k = 0; k <= i; ++k) z += matrix_[i][k] * independent[k];
    const double spread = spread_[i] * parameters.participant_spread;
    double& value = parameters.*rows[i].member;
    value = std::clamp(value * std::exp(spread * z), rows[i].least, rows[i].most);
  }
}

}  // namespace heft
