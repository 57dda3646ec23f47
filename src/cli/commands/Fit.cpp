// heft fit: the estimators for any data.
#include "inference/Fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "analysis/report/Report.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"
#include "inference/AnswerData.h"

namespace heft::cli {

namespace {
struct FitCommandOptions {
  std::string data, model;
  std::optional<std::string> function, scale, guess, lapse, group_by, person;
  bool json = false;
};

template <typename Enum>
std::vector<std::string> names_of() {
  return {EnumNames<Enum>::names.begin(), EnumNames<Enum>::names.end()};
}

// None: free.
std::optional<double> share(const std::string& option, const std::optional<std::string>& given) {
  if (!given) return 0;
  if (*given == "free") return std::nullopt;
  const std::optional<double> value = number_in(*given);
  if (!value || *value < 0 || *value >= 1)
    throw Error(fmt::format("{} is \"{}\", expected \"free\" or a number from 0 to below 1", option,
                            *given),
                ExitCode::usage);
  return value;
}

FitOptions fit_options(const FitCommandOptions& options, FitModel model) {
  FitOptions fit;
  fit.guess = share("--guess", options.guess);
  fit.lapse = share("--lapse", options.lapse);
  if (model == FitModel::indecision && (options.function || options.scale || options.guess))
    throw Error("--function, --scale and --guess belong to --model psychometric", ExitCode::usage);
  if (options.person && (model != FitModel::indecision || options.lapse))
    throw Error("--person belongs to --model indecision, with a lapse rate that is fitted",
                ExitCode::usage);
  if (fit.guess.value_or(0) + fit.lapse.value_or(0) >= 1)
    throw Error("--guess and --lapse add up to 1 or more, expected less than 1", ExitCode::usage);
  if (options.function) fit.function.shape = *named<PsychometricShape>(*options.function);
  if (options.scale) fit.function.scale = *named<LevelScale>(*options.scale);
  return fit;
}

// As heft analyse does: differences between people are in the model.
NamedFit fit_people(const AnswerGroup& group) {
  const MixedFit mixed = fit_mixed_indecision(group.people);
  NamedFit named{group.name, mixed.summary(), {}};
  named.fit.n_levels = group.answers.size();
  for (const auto& [person, answers] : group.people)
    named.people[person] = own_threshold(answers, mixed.own(person));
  return named;
}

// Staircases show larger levels to less sensitive people, so pooling overestimates the threshold.
void warn_of_pooled(std::span<const AnswerGroup> groups, FitModel model) {
  const auto most = std::ranges::max_element(
      groups, {}, [](const AnswerGroup& group) { return group.people.size(); });
  if (most == groups.end() || most->people.size() < 2) return;
  say("heft: warning: {}trials of {} people are pooled into one fit. If staircases chose the "
      "levels, the threshold is overestimated (1.4 to 2.4 times in simulations), because "
      "insensitive people see larger levels. {}\n",
      most->name ? *most->name + ": " : "", most->people.size(),
      model == FitModel::indecision ? "Name the column of people: --person COLUMN."
                                    : "Fit one person at a time: --by COLUMN.");
}

void fit(const FitCommandOptions& options) {
  const FitModel model = *named<FitModel>(options.model);
  const FitOptions how = fit_options(options, model);
  std::vector<NamedFit> fits;
  const std::vector<AnswerGroup> groups = load_answers(
      options.data, {model, options.group_by, how.function.takes_logarithm(), options.person});
  if (!options.person) warn_of_pooled(groups, model);
  for (const AnswerGroup& group : groups)
    if (options.person)
      fits.push_back(fit_people(group));
    else
      fits.push_back({group.name, model == FitModel::indecision
                                      ? fit_indecision(group.answers, how)
                                      : fit_psychometric(group.answers, how)});
  if (options.json)
    fmt::print("{}", fits_as_json(fits));
  else
    print("{}", fits_as_text(fits));
}
}  // namespace

void add_fit(Command& app) {
  const auto options = std::make_shared<FitCommandOptions>();
  Command command = app.add_command(
      "fit", "fit psychometric functions or the indecision model to any data",
      {"heft fit answers.csv --model psychometric --function logistic",
       "heft fit forced_choice.csv --model psychometric --function weibull --guess 0.5 --lapse "
       "free",
       "heft fit choices.csv --model indecision --lapse 0.02 --by participant --json",
       "heft fit choices.csv --model indecision --person participant",
       "",
       "DATA.csv begins with a header. Psychometric: x,n_positive,n or, a row a trial,",
       "x,response (0 or 1). Indecision: level_g,answer (comparison, reference or none).",
       "",
       "Psychometric: p(x) = guess + (1 - guess - lapse) F(x). With threshold t and slope s",
       "F is Phi((x - t) / s), 1 / (1 + exp(-(x - t) / s)) or, gumbel, 1 - exp(-exp((x - t) / s));",
       "Weibull's is 1 - exp(-(x / t)^s); where x is a logarithm, 1 - exp(-10^(s (x - t))) (log10)",
       "or 1 - exp(-10^(s (x - t) / 20)) (db).",
       "Indecision: D = sensitivity * level_g + bias + N(0, 1); comparison where D > indecision,",
       "reference where D < -indecision, otherwise none; a lapse is any of them.",
       "threshold_75_g = 0.6745 / sensitivity makes 75 % correct in a forced choice.",
       "With --person these differ between people: the mixed model of heft analyse, with a lapse",
       "rate that all share, gives figures of the median person and each one's threshold.",
       "",
       "Maximum-likelihood estimates; SE from the observed information; 95 % profile intervals.",
       "If the threshold is not identifiable, the reason is printed instead."});
  command.add_option("DATA.csv", &options->data, "the answers").required();
  command.add_option("--model", &options->model, "the model to fit")
      .required()
      .one_of(names_of<FitModel>());
  command.add_option("--function", &options->function, "default: cumulative_normal")
      .one_of(names_of<PsychometricShape>());
  command
      .add_option("--scale", &options->scale,
                  "what x is, for Weibull's formula; the others take x as it is. Default: linear")
      .one_of(names_of<LevelScale>());
  command.add_option("--guess", &options->guess,
                     "guess rate: fixed, or \"free\" up to 0.5. Default: 0");
  command.add_option("--lapse", &options->lapse,
                     "lapse rate: fixed, or \"free\" up to 0.5. Default: 0");
  command.add_option("--by", &options->group_by, "one fit for each value of this column");
  command.add_option("--person", &options->person,
                     "indecision: the column of who answered; one fit of all people, who differ");
  command.add_flag("--json", options->json, "JSON on stdout instead of tables");
  command.does([options] { fit(*options); });
}

}  // namespace heft::cli
