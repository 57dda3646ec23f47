#include "analysis/dataset/Sorting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tasks/Sorting.h"

namespace heft {

double chance_percent(int n_cubes) {
  return 100 / std::tgamma(n_cubes + 1.0);
}

std::vector<std::optional<Label>> final_labels(std::span<const AnswerRow> answers, int n_slots) {
  std::vector<std::optional<Label>> labels(static_cast<std::size_t>(n_slots));
  for (const AnswerRow& answer : answers) {
    if (!answer.slot || *answer.slot < 1 || *answer.slot > n_slots) continue;
    auto& given = labels[static_cast<std::size_t>(*answer.slot - 1)];
    if (answer.action == "unlabel") given.reset();
    if (answer.action != "label" || !answer.label) continue;
    std::ranges::replace(labels, answer.label, std::optional<Label>());
    given = answer.label;
  }
  return labels;
}

std::optional<Swap> swap_of(std::span<const double> masses_g,
                            std::span<const std::optional<Label>> labels) {
  if (masses_g.size() != 3 || labels.size() != 3) return std::nullopt;
  std::array<std::size_t, 3> by_mass{};
  std::iota(by_mass.begin(), by_mass.end(), std::size_t{0});
  std::ranges::stable_sort(by_mass, {}, [&](std::size_t slot) { return masses_g[slot]; });
  std::array<std::optional<Label>, 3> given;  // from the lightest cube to the heaviest
  for (std::size_t rank = 0; rank < 3; ++rank) given.at(rank) = labels[by_mass.at(rank)];

  const auto [light, intermediate, heavy] = given;
  if (!light || !intermediate || !heavy || light == intermediate || light == heavy ||
      intermediate == heavy)
    return std::nullopt;
  const bool light_right = light == "lightest";
  const bool intermediate_right = intermediate == "intermediate";
  const bool heavy_right = heavy == "heaviest";
  if (light_right && intermediate_right) return std::nullopt;
  if (heavy_right) return Swap::light_intermediate;
  if (light_right) return Swap::intermediate_heavy;
  if (intermediate_right) return Swap::light_heavy;
  return Swap::all_three;
}

void count_labels(LabelMatrices& matrices, std::span<const double> masses_g,
                  std::span<const std::optional<Label>> given) {
  const auto names = Sorting::labels_for(static_cast<int>(masses_g.size()));
  auto& matrix = matrices[static_cast<int>(masses_g.size())];
  matrix.resize(masses_g.size(), std::vector<int>(masses_g.size()));
  for (std::size_t slot = 0; slot < masses_g.size(); ++slot) {
    const auto rank = static_cast<std::size_t>(
        std::ranges::count_if(masses_g, [&](double mass_g) { return mass_g < masses_g[slot]; }));
    const auto label = std::find(names.begin(), names.end(), given[slot]);
    if (label != names.end()) matrix[rank][static_cast<std::size_t>(label - names.begin())] += 1;
  }
}

}  // namespace heft
