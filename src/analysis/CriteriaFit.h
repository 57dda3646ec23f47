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
  /// How much of the log indecision these answers tell, where the rest comes from the spread.
  double told = 0;
};

/// People's criteria and their spread for a sensitivity, by the EM algorithm. @return each one's
/// log likelihood with the criteria integrated out (Laplace's method)
std::vector<double> fit_criteria(std::vector<PersonAnswers>& people, double sensitivity,
                                 Spread& spread);

/// A start for a sensitivity that is so much larger.
void move_criteria(std::vector<PersonAnswers>& people, Spread& spread, double growth);

}  // namespace heft
