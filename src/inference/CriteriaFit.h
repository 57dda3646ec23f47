// The criteria of people who have a sensitivity in common, as random effects: see
// PooledSensitivity.h.
#pragma once

#include <vector>

namespace heft {

/// How often each answer was given at one level, signed by side and scaled.
struct SidedAnswers {
  double level = 0, left = 0, none = 0, right = 0;
};

/// One person's half width between the criteria, in SDs of what is felt, and preference for a side.
struct Criteria {
  double log_indecision = 0, bias = 0;
};

/// How criteria are spread between people who have a sensitivity in common: the logarithm of the
/// indecision is normal, the side bias too, around 0.
struct Spread {
  double mean_log_indecision = 0, sd_log_indecision = 0.6, sd_bias = 0.5;
};

/// One person's answers, and the criteria that go with the sensitivity looked at.
struct PersonAnswers {
  std::vector<SidedAnswers> answers;
  Criteria criteria;
  /// Information in these answers: the share of the log indecision not shrunk to the mean.
  double information = 0;
};

/// People's criteria and their spread for a sensitivity, by the EM algorithm. @return each one's
/// log likelihood with the criteria integrated out (Laplace's method)
std::vector<double> fit_criteria(std::vector<PersonAnswers>& people, double sensitivity,
                                 Spread& spread);

/// What is likely of one person's criteria.
struct LikelyCriteria {
  double log_likelihood = 0;  ///< with the criteria integrated out (Laplace's method)
  double log_indecision = 0, variance = 0, bias_square = 0;
  double information = 0;  ///< see PersonAnswers
};

/// Where the spread is known. @param person their criteria are where to begin, then the likeliest
LikelyCriteria likely_criteria(PersonAnswers& person, double sensitivity, const Spread& spread);

/// What people's criteria say of their spread: a step of the EM algorithm.
class SpreadSums {
 public:
  void add(const LikelyCriteria& person, double weight = 1);
  Spread after(const Spread& last) const;

 private:
  double n_ = 0, sum_ = 0, square_ = 0, bias_square_ = 0, information_ = 0;
};

/// A start for a sensitivity that is so much larger.
void move_criteria(std::vector<PersonAnswers>& people, Spread& spread, double growth);

}  // namespace heft
