// heft fit: the estimators for any data.
#include <fmt/format.h>

#include <memory>
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
  std::string data;
  FitRequest request;
  bool json = false;
};

template <typename Enum>
std::vector<std::string> names_of() {
  return {EnumNames<Enum>::names.begin(), EnumNames<Enum>::names.end()};
}

void fit(const FitCommandOptions& options) {
  const FittedAnswers fitted =
      fit_answers(read_text_file(options.data), options.data, options.request);
  if (!fitted.warning.empty()) say("heft: warning: {}\n", fitted.warning);
  if (options.json)
    fmt::print("{}", fits_as_json(fitted.fits));
  else
    print("{}", fits_as_text(fitted.fits));
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
       "If the threshold is not identifiable, the reason is printed instead.",
       "Goodness of fit: deviance from the saturated model; p from 1000 data sets of the same",
       "design, simulated from the fit and refitted. Not judged if a level has fewer than 5",
       "trials, or the numbers are very unequal: an adaptive procedure may have chosen them."});
  command.add_option("DATA.csv", &options->data, "the answers").required();
  command.add_option("--model", &options->request.model, "the model to fit")
      .required()
      .one_of(names_of<FitModel>());
  command.add_option("--function", &options->request.function, "default: cumulative_normal")
      .one_of(names_of<PsychometricShape>());
  command
      .add_option("--scale", &options->request.scale,
                  "what x is, for Weibull's formula; the others take x as it is. Default: linear")
      .one_of(names_of<LevelScale>());
  command.add_option("--guess", &options->request.guess,
                     "guess rate: fixed, or \"free\" up to 0.5. Default: 0");
  command.add_option("--lapse", &options->request.lapse,
                     "lapse rate: fixed, or \"free\" up to 0.5. Default: 0");
  command.add_option("--by", &options->request.group_by, "one fit for each value of this column");
  command.add_option("--person", &options->request.person,
                     "indecision: the column of who answered; one fit of all people, who differ");
  command.add_flag("--json", options->json, "JSON on stdout instead of tables");
  command.does([options] { fit(*options); });
}

}  // namespace heft::cli
