#include "psychophysics/LeastEntropy.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

namespace heft {

namespace {
constexpr std::size_t most_cells = 20'000'000;  // points times levels: 240 MB at most

double largest(const ValueGrid& grid) {
  return grid.values.empty() ? 0 : grid.values.back();
}

bool is_free(const ValueGrid& grid) {
  return grid.values.size() > 1;
}
}  // namespace

std::array<const ValueGrid*, 4> LeastEntropyConfig::grids() const {
  if (is_indecision()) return {&sensitivity, &indecision, &bias, &lapse};
  return {&threshold, &slope, &guess, &lapse};
}

GridSpace LeastEntropyConfig::space() const {
  GridSpace space{.model = model(), .parameters = {}, .levels = {}};
  for (std::size_t i = 0; i < space.parameters.size(); ++i) {
    space.parameters[i] = grids()[i]->values;
    space.is_nuisance[i] =
        std::ranges::count(nuisance, std::string(space.model.parameter_names()[i])) > 0;
  }
  for (const double level : levels.values)
    if ((!floor || level >= *floor) && (!ceiling || level <= *ceiling))
      space.levels.push_back(level);
  return space;
}

ConfigMistakes LeastEntropyConfig::mistakes() const {
  ConfigMistakes mistakes;
  const auto names = model().parameter_names();
  const std::array<std::pair<std::string_view, const ValueGrid*>, 7> all{
      {{"threshold", &threshold},
       {"slope", &slope},
       {"guess", &guess},
       {"sensitivity", &sensitivity},
       {"indecision", &indecision},
       {"bias", &bias},
       {"lapse", &lapse}}};
  for (const auto& [name, grid] : all) {
    const bool is_of_function = std::ranges::count(names, name) > 0;
    if (is_of_function && grid->values.empty())
      mistakes.push_back({{name, "function"},
                          fmt::format("lacks \"{}\"", name),
                          fmt::format("every parameter of function \"{}\": {}", name_of(function),
                                      quoted_list(names))});
    if (!is_of_function && !grid->values.empty())
      mistakes.push_back({{name, "function"},
                          fmt::format("{} together with function \"{}\"", name, name_of(function)),
                          "only its parameters " + quoted_list(names)});
  }
  if (!is_indecision() && largest(guess) + largest(lapse) >= 1)
    mistakes.push_back(
        {{"lapse", "guess"},
         fmt::format("guess and lapse reach {} and {}", largest(guess), largest(lapse)),
         "a sum below 1"});
  const GridSpace space = this->space();
  if (space.levels.empty() && !levels.values.empty())
    mistakes.push_back(
        {{"floor", "ceiling"}, "no level is between floor and ceiling", "at least one"});
  if (start && ((floor && *start < *floor) || (ceiling && *start > *ceiling)))
    mistakes.push_back({{"start"}, fmt::format("start is {}", *start), "within floor and ceiling"});
  std::size_t n_cells = space.levels.size();
  for (const auto& values : space.parameters)
    n_cells = std::min(n_cells * values.size(), 2 * most_cells);
  if (n_cells > most_cells)
    mistakes.push_back({{"levels"},
                        "levels and parameters make too large a grid",
                        fmt::format("at most {} points times levels", most_cells)});
  return mistakes;
}

// A positive answer to a lighter comparison has the opposite meaning, unless the choice counts.
ConfigMistakes LeastEntropyConfig::check_beside(double reference, bool either_sign) const {
  ConfigMistakes mistakes;
  if (!is_indecision() && scale != LevelScale::linear)
    mistakes.push_back(
        {{"scale"}, fmt::format("scale is \"{}\"", name_of(scale)), "\"linear\": levels are in g"});
  const auto check_level = [&](std::string_view key, double level,
                               std::optional<std::size_t> index) {
    const bool may_be_lighter = is_indecision() || either_sign;
    if (may_be_lighter ? level > -reference : level >= 0) return;
    mistakes.push_back(
        {{key},
         fmt::format("{} has {}", key, level),
         may_be_lighter ? fmt::format("above {}, where the comparison would weigh 0 g", -reference)
                        : "0 or more: a lighter comparison needs function = \"indecision\"",
         index});
  };
  for (std::size_t i = 0; i < levels.values.size(); ++i)
    if (!floor || levels.values[i] >= *floor) check_level("levels", levels.values[i], i);
  if (start) check_level("start", *start, std::nullopt);
  return mistakes;
}

ConfigMistakes QuestPlusConfig::check() const {
  ConfigMistakes found = out_of_range(*this);
  std::ranges::move(mistakes(), std::back_inserter(found));
  if (stop_ci_width && grids()[0]->values.size() == 1)
    found.push_back({{"stop_ci_width"},
                     fmt::format("stop_ci_width with a fixed {}", model().parameter_names()[0]),
                     "several values of it, which the interval is made from"});
  return found;
}

ConfigMistakes PsiConfig::check() const {
  ConfigMistakes found = out_of_range(*this);
  std::ranges::move(mistakes(), std::back_inserter(found));
  const auto names = model().parameter_names();
  for (std::size_t i = 0; i < nuisance.size(); ++i)
    if (std::ranges::count(names, nuisance[i]) == 0)
      found.push_back(
          {{"nuisance"}, fmt::format("nuisance has \"{}\"", nuisance[i]), quoted_list(names), i});
  bool any_interest = false;
  for (std::size_t i = 0; i < names.size(); ++i)
    any_interest |=
        is_free(*grids()[i]) && std::ranges::count(nuisance, std::string(names[i])) == 0;
  // Without a third answer there is no criterion: forced choices have an indecision of 0.
  for (std::size_t i = 0; i < (is_indecision() ? 1 : 2); ++i)
    if (grids()[i]->values.size() == 1)
      found.push_back({{names[i]},
                       fmt::format("{} has one value", names[i]),
                       "several: psi estimates it; kind = \"quest_plus\" can fix it"});
  if (!any_interest && found.empty())
    found.push_back({{"nuisance"}, "nuisance has every parameter", "at least one to estimate"});
  return found;
}

LeastEntropy::LeastEntropy(const LeastEntropyConfig& config, std::string_view method)
    : method_(method),
      stop_{config.stop_trials, config.stop_ci_width},
      posterior_(LikelihoodTable::shared(config.space())),
      evidence_(config.model().n_outcomes()),
      first_level_(config.start ? *config.start : posterior_.best_level()),
      next_level_(first_level_) {}

QuestPlus::QuestPlus(QuestPlusConfig config)
    : LeastEntropy(valid_config(config), config.kind), config_(std::move(config)) {}

Psi::Psi(PsiConfig config)
    : LeastEntropy(valid_config(config), config.kind), config_(std::move(config)) {}

Update LeastEntropy::respond(const Response& response, double shown) {
  assert(!finish_);
  ++n_trials_;
  posterior_.update(shown, response);
  evidence_.add(posterior_.table().space().model.outcomes_of(response));
  finish_ = stop_.after(n_trials_, [this] { return estimate(); });
  if (!finish_) next_level_ = posterior_.best_level();
  return {std::nullopt, finish_};
}

Marginal LeastEntropy::threshold() const {
  const Marginal first = posterior_.marginal(0);
  return posterior_.table().space().model.is_indecision()
             ? first.inverse(threshold_75_times_sensitivity)
             : first;
}

Estimate LeastEntropy::estimate() const {
  Estimate estimate =
      threshold_estimate(threshold(), evidence_.for_model(posterior_.log_evidence()));
  estimate.method = method_;
  estimate.n_trials = n_trials_;
  return estimate;
}

std::vector<Estimate> LeastEntropy::estimates() const {
  return {estimate()};
}

std::vector<ParameterPosterior> LeastEntropy::posterior() const {
  const auto names = posterior_.table().space().model.parameter_names();
  const ParameterValues mode = posterior_.mode();
  std::vector<ParameterPosterior> parameters;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Marginal marginal = posterior_.marginal(i);
    parameters.push_back({std::string(names[i]), marginal.mean(), marginal.sd(), mode[i],
                          marginal.low(), marginal.high()});
  }
  return parameters;
}

std::optional<int> LeastEntropy::planned_trials() const {
  return stop_.planned_trials();
}

std::vector<double> LeastEntropy::planned_levels() const {
  return {first_level_};
}

}  // namespace heft
