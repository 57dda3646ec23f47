#include "tasks/blocks/BlockKeys.h"

#include <fmt/format.h>

namespace heft {

int total_of(const std::vector<TechniqueTrials>& trials) {
  int n = 0;
  for (const TechniqueTrials& some : trials) n += some.trials;
  return n;
}

void add_friction(Choices& choices, const std::string& block, const std::vector<double>& masses_g,
                  const std::vector<double>& table_friction) {
  std::string text;
  for (std::size_t i = 0; i < table_friction.size(); ++i)
    text += fmt::format("{}{:g} g: {:g}", i > 0 ? ", " : "", masses_g[i], table_friction[i]);
  if (!text.empty()) choices.emplace_back("friction on the table in " + block, text);
}

ConfigMistakes mistakes_in_number_of_cubes(const std::vector<double>& masses_g,
                                           const std::vector<double>& table_friction,
                                           std::size_t fewest, std::size_t most) {
  ConfigMistakes mistakes;
  const std::size_t n = masses_g.size();
  const std::string range =
      fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most);
  if (n < fewest || n > most)
    mistakes.push_back(
        {{"masses_g"}, fmt::format("masses_g has {} masses", n), range + ": one a cube"});
  if (!table_friction.empty() && table_friction.size() != n)
    mistakes.push_back(
        {{"table_friction", "masses_g"},
         fmt::format("table_friction has {} values for {} masses", table_friction.size(), n),
         "one for each mass"});
  return mistakes;
}

ConfigMistakes mistakes_in_cubes(const std::vector<double>& masses_g,
                                 const std::vector<double>& table_friction, std::size_t fewest,
                                 std::size_t most, std::string_view why, bool or_friction) {
  ConfigMistakes mistakes = mistakes_in_number_of_cubes(masses_g, table_friction, fewest, most);
  const std::size_t n = masses_g.size();
  or_friction = or_friction && table_friction.size() == n;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (masses_g[j] == masses_g[i] && !(or_friction && table_friction[j] != table_friction[i])) {
        mistakes.push_back(
            {{"masses_g"},
             fmt::format("masses_g has {} g twice", masses_g[i]),
             fmt::format("different masses{}: {}", or_friction ? " or table_friction" : "", why),
             i});
        break;
      }
  return mistakes;
}

}  // namespace heft
