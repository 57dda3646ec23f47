#include "tasks/BlockKeys.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

namespace heft {

int total_of(const std::vector<TechniqueTrials>& trials) {
  int n = 0;
  for (const TechniqueTrials& some : trials) n += some.trials;
  return n;
}

ConfigMistakes mistakes_in_masses(const std::vector<double>& masses_g, std::size_t fewest,
                                  std::size_t most, std::string_view why) {
  ConfigMistakes mistakes;
  const std::size_t n = masses_g.size();
  const std::string range =
      fewest == most ? fmt::format("{}", most) : fmt::format("{} to {}", fewest, most);
  if (n < fewest || n > most)
    mistakes.push_back(
        {{"masses_g"}, fmt::format("masses_g has {} masses", n), range + ": one a cube"});
  for (std::size_t i = 0; i < n; ++i)
    if (std::ranges::count(std::span(masses_g).first(i), masses_g[i]) > 0)
      mistakes.push_back({{"masses_g"},
                          fmt::format("masses_g has {} g twice", masses_g[i]),
                          fmt::format("different masses: {}", why),
                          i});
  return mistakes;
}

}  // namespace heft
