// The paper's techniques, figures and hypotheses, each with its place in the paper. They are
// printed beside results only if law and parameters, masses and task are the paper's, and are used
// for nothing else.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/Protocol.h"

namespace heft::published {

inline constexpr int n_participants = 13;  ///< both experiments, "Participants"

/// Below the table of published figures.
inline constexpr std::string_view about_figures =
    "published: the paper's figures, of 13 participants, for its own techniques, masses and tasks "
    "only; intervals by Student's t from its SDs (the introduction's is exact), none where it "
    "gives "
    "none. Its 10.1 % of answered C1 trials is a ratio of means. The CSV says where in the paper "
    "each is from.";

/// The paper's conditions (4.1): C1, the control, and C2, the technique.
enum class Condition { coupled, decoupled };

/// The paper's condition with the law and parameters of a technique, whatever its name; none: the
/// paper did not measure it.
std::optional<Condition> condition_of(const Technique& technique);

constexpr std::string_view in_words(Condition condition) {
  return condition == Condition::coupled ? "without decoupling" : "with decoupling";
}

/// The names in a protocol that are one of the paper's conditions.
std::map<std::string, Condition> conditions_in(const Protocol& protocol);

/// The paper's condition that all trials so far were in, and whether with its masses.
class Comparable {
 public:
  void add(std::optional<Condition> condition, bool masses_equal);
  /// None: another technique, other masses, or no trial.
  std::optional<Condition> condition() const { return same_ ? condition_ : std::nullopt; }

 private:
  std::optional<Condition> condition_;
  bool any_ = false, same_ = true;
};

/// A mean that the paper reports.
struct Figure {
  std::string_view what;  ///< "C2 correct", "JND at 200 g"
  std::string_view source;
  double value = 0;
  std::optional<double> sd;   ///< between participants, where the paper gives it
  std::optional<int> n_hits;  ///< of n_participants, for a count of people
};

inline constexpr std::string_view of_c1 = "Experiment 1, Results and discussion, paragraph 1";
inline constexpr std::string_view of_c2 = "Experiment 1, Results and discussion, paragraph 2";

struct Sorting {
  Figure correct, incorrect, none;
  /// Correct over the trials that were answered. The paper's 10.1 is the ratio of its mean
  /// percentages, 6.2 / (6.2 + 55.4), not a mean over participants.
  std::optional<Figure> answered_correct;
};

inline constexpr std::array sorting_masses_g{15.0, 200.0, 800.0};
inline constexpr Sorting sorting_coupled{{"C1 correct", of_c1, 6.2, 9.6, {}},
                                         {"C1 incorrect", of_c1, 55.4, {}, {}},
                                         {"C1 I don't know", of_c1, 38.5, {}, {}},
                                         Figure{"C1 correct of answered", of_c1, 10.1, {}, {}}};
inline constexpr Sorting sorting_decoupled{{"C2 correct", of_c2, 78.5, 20.8, {}},
                                           {"C2 incorrect", of_c2, 21.5, {}, {}},
                                           {"C2 I don't know", of_c2, 0.0, {}, {}},
                                           {}};
constexpr const Sorting& sorting_in(Condition condition) {
  return condition == Condition::coupled ? sorting_coupled : sorting_decoupled;
}

// All 13 were right on the first try.
inline constexpr std::array introduction_masses_g{15.0, 800.0};
inline constexpr Figure introduction_first_try{
    "introduction, first try", "Experiment 1, Results and discussion, paragraph 3", 100, {}, 13};

struct Jnd {
  double reference_g = 0;
  Figure figure;
};
inline constexpr std::string_view of_jnds = "Experiment 2, Results and discussion, list of means";
inline constexpr std::array jnds{Jnd{15, {"JND at 15 g", of_jnds, 172.3, 72.4, {}}},
                                 Jnd{200, {"JND at 200 g", of_jnds, 271.5, 155.3, {}}},
                                 Jnd{800, {"JND at 800 g", of_jnds, 696.2, 394.7, {}}}};

/// Null: the paper has no such reference.
constexpr const Figure* jnd_at(double reference_g) {
  for (const Jnd& jnd : jnds)
    if (jnd.reference_g == reference_g) return &jnd.figure;
  return nullptr;
}

/// The paper's two sets share the names H1...H3, so each carries its experiment.
struct HypothesisText {
  std::string_view name, statement;
};
inline constexpr std::array hypotheses{
    HypothesisText{"E1-H1",
                   "C1 does not allow to perceive a mass difference among virtual objects"},
    HypothesisText{"E1-H2", "C2 allows to recognize which objects are lighter and heavier"},
    HypothesisText{"E1-H3", "C2 is effective with no training"},
    HypothesisText{"E2-H1", "the JND increases with the reference mass"},
    HypothesisText{"E2-H2", "the JND is proportional to the reference mass"}};

struct UntestableHypothesis {
  std::string_view name;   ///< "E1-H1"
  std::string_view needs;  ///< trials that the protocol lacks
};
/// The declared hypotheses that no session of this protocol can test, because it lacks their task
/// with the paper's technique and masses.
std::vector<UntestableHypothesis> untestable_in(const Protocol& protocol);

}  // namespace heft::published
