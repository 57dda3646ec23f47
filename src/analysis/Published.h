// The paper's figures, all of them, each with the place it comes from. They are printed beside what
// a log holds and are used for nothing else.
#pragma once

#include <array>
#include <optional>

namespace heft::published {

inline constexpr int n_participants = 13;  ///< both experiments, "Participants"

struct Percentage {
  double mean_percent = 0;
  std::optional<double> sd_percent;  ///< between participants; the paper gives it for "correct"
};

struct Sorting {
  Percentage correct, incorrect, none;
  /// Correct over the trials that were answered. The paper's 10.1 is the ratio of its mean
  /// percentages, 6.2 / (6.2 + 55.4), not a mean over participants.
  std::optional<double> answered_correct_percent;
};

// Experiment 1 (sorting), "Results and discussion".
inline constexpr std::array sorting_masses_g{15.0, 200.0, 800.0};
inline constexpr Sorting sorting_c1{{6.2, 9.6}, {55.4, {}}, {38.5, {}}, 10.1};
inline constexpr Sorting sorting_c2{{78.5, 20.8}, {21.5, {}}, {0.0, {}}, {}};

// Experiment 1, "Results and discussion", last paragraph: all 13 were right on the first try.
inline constexpr std::array introduction_masses_g{15.0, 800.0};
inline constexpr int introduction_first_try = 13;

struct Jnd {
  double reference_g = 0, mean_g = 0, sd_g = 0;
};

// Experiment 2 (JND), "Results and discussion".
inline constexpr std::array jnds{Jnd{15, 172.3, 72.4}, Jnd{200, 271.5, 155.3},
                                 Jnd{800, 696.2, 394.7}};

constexpr std::optional<Jnd> jnd_at(double reference_g) {
  for (const Jnd& jnd : jnds)
    if (jnd.reference_g == reference_g) return jnd;
  return std::nullopt;
}

}  // namespace heft::published
