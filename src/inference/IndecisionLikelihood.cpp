#include "inference/IndecisionLikelihood.h"

#include "inference/Fit.h"

namespace heft {

namespace {
// Only of answers that were given: most levels of a staircase have one answer alone, and the others'
// probabilities would cost as much.
IndecisionShares shares_of_given(const IndecisionParameters& parameters,
                                 const LevelAnswers& answers) {
  if (answers.n[none_answer] > 0) return indecision_shares(parameters, answers.level);
  const double felt = parameters.sensitivity * answers.level + parameters.bias;
  const auto share = [&](double z) {
    return parameters.lapse / 3 + (1 - parameters.lapse) * normal_cdf(z);
  };
  return {answers.n[reference_answer] > 0 ? share(-felt - parameters.indecision) : 0, 0,
          answers.n[comparison_answer] > 0 ? share(felt - parameters.indecision) : 0};
}

std::array<LogShare, 3> log_shares(const LevelAnswers& answers, const IndecisionShares& p) {
  return {log_share(answers.n[reference_answer], p.reference),
          log_share(answers.n[none_answer], p.none),
          log_share(answers.n[comparison_answer], p.comparison)};
}
}  // namespace

double level_log_likelihood(const IndecisionParameters& parameters, const LevelAnswers& answers) {
  double sum = 0;
  for (const LogShare& share : log_shares(answers, shares_of_given(parameters, answers)))
    sum += share.value;
  return sum;
}

LevelLikelihood level_likelihood(const IndecisionParameters& parameters,
                                 const LevelAnswers& answers) {
  const IndecisionShares p = shares_of_given(parameters, answers);
  const std::array<LogShare, 3> shares = log_shares(answers, p);
  const double felt = parameters.sensitivity * answers.level + parameters.bias;
  const double up = felt - parameters.indecision, down = felt + parameters.indecision;
  const double attentive = 1 - parameters.lapse;
  const double up_density = normal_density(up), down_density = normal_density(down);
  // How the probabilities of the answers change with up, down and the lapse rate.
  const double to_up = attentive * up_density, to_down = attentive * down_density;
  const auto by_lapse = [&](double share) { return (1.0 / 3 - share) / attentive; };
  const std::array<Eigen::Vector3d, 3> slopes{Eigen::Vector3d(0, -to_down, by_lapse(p.reference)),
                                              Eigen::Vector3d(-to_up, to_down, by_lapse(p.none)),
                                              Eigen::Vector3d(to_up, 0, by_lapse(p.comparison))};
  LevelLikelihood found;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    found.value += shares[k].value;
    if (shares[k].slope == 0) continue;  // not given
    found.first += shares[k].slope * slopes[k];
    found.second += shares[k].bend * slopes[k] * slopes[k].transpose();
  }
  const double at_up = shares[comparison_answer].slope - shares[none_answer].slope;
  const double at_down = shares[none_answer].slope - shares[reference_answer].slope;
  found.second(0, 0) -= at_up * up * to_up;
  found.second(1, 1) -= at_down * down * to_down;
  found.second(0, 2) = found.second(2, 0) -= at_up * up_density;
  found.second(1, 2) = found.second(2, 1) -= at_down * down_density;
  return found;
}

}  // namespace heft
