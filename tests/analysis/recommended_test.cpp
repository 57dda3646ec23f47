// What protocols/recommended.toml promises: few trials, thresholds that the criterion does not
// move, and the order of thresholds that differ. results/procedures/README.md has the figures of
//   HEFT_STUDIES=100 build/tests/test_analysis --gtest_filter='CoverageOf.Designs'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <map>

#include "Folds.h"
#include "MadeUpChoosers.h"
#include "SourceFolder.h"
#include "analysis/Analysis.h"
#include "analysis/dataset/Summary.h"
#include "analysis/report/Notes.h"
#include "inference/Coverage.h"
#include "protocol/Protocol.h"
#include "tasks/Comparison.h"

namespace heft {
namespace {

using namespace made_up;

/// The comparison of a shipped protocol.
Comparison::Block comparison_of(const std::string& name) {
  const Protocol protocol = load_protocol(source_folder() + "/protocols/" + name + ".toml");
  return *block_as<Comparison::Block>(protocol.blocks.back());
}

/// The median person's 75 % thresholds by reference, g: near the JNDs of the paper.
const std::map<double, double> thresholds_g{{15, 90}, {200, 140}, {800, 375}};

/// One person, whose sensitivity and criterion are drawn for each reference.
SessionData person(int number, const Comparison::Block& block, double criterion,
                   RandomStream& stream) {
  SessionData data = session(number, std::to_string(100 + number));
  std::map<double, Chooser> choosers;
  for (const auto& [reference_g, threshold_g] : thresholds_g)
    choosers[reference_g] = Population{threshold_g, 0.3, criterion}.draw(stream);
  const std::uint64_t seed = stream.below(1u << 31);
  Comparison::Run run(block, seed);
  while (!run.finished()) {
    Attempt& attempt = add_attempt(data, "comparison", {});
    TrialRow& trial = attempt.trial;
    trial.plan = run.plan({seed, trial.attempt_index});
    attempt.cubes = cubes(trial.plan.masses_g);
    const double right_minus_left_g =
        trial.plan.reference_slot == 1 ? *trial.plan.level_g : -*trial.plan.level_g;
    answer(attempt, choosers.at(*trial.plan.reference_g).answer(right_minus_left_g, stream));
    Changes changes;
    run.complete(trial, changes);
  }
  return data;
}

struct Found {
  std::vector<double> thresholds_g, widths;  ///< of each study; high over low end of the interval
  Coverage coverage;
};

double median(std::vector<double> values) {
  std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2));
  return values.at(values.size() / 2);
}

/// What studies of 13 people find with a comparison block.
struct DesignStudy {
  std::map<double, Found> at;  ///< by reference
  int n_ordered = 0;           ///< studies that support a rise of thresholds with mass (E2-H1)
  double trials = 0;           ///< of a person, mean

  DesignStudy(const Comparison::Block& block, double criterion, int studies) {
    RandomStream stream(71, "designs");
    for (int i = 0; i < studies; ++i) {
      std::vector<SessionData> people;
      for (int k = 1; k <= 13; ++k) {
        people.push_back(person(k, block, criterion, stream));
        trials += static_cast<double>(people.back().attempts.size()) / 13 / studies;
      }
      add(sensitivities_of(people));
    }
  }

  void add(const std::vector<ReferenceSensitivity>& rows) {
    for (const ReferenceSensitivity& row : rows) {
      const double reference_g = row.compared.reference_g;
      Found& found = at[reference_g];
      const auto& threshold = row.fit.threshold_75_g;
      if (!threshold || !threshold->low || !threshold->high) {
        found.coverage.add({}, thresholds_g.at(reference_g));
        continue;
      }
      found.thresholds_g.push_back(threshold->value);
      found.widths.push_back(*threshold->high / *threshold->low);
      found.coverage.add(Interval{*threshold->low, *threshold->high}, thresholds_g.at(reference_g));
    }
    Summary summary = summarize({"x.db", {}}, "");
    put_sensitivities(summary.estimates, rows);
    n_ordered += hypotheses_of(summary).at(3).verdict == HypothesisVerdict::supported ? 1 : 0;
  }

  void print(const std::string& design, double criterion, int studies) const {
    std::cout << fmt::format("{}, criterion {} SD: {:.0f} trials, order in {} of {} studies;",
                             design, criterion, trials, n_ordered, studies);
    for (const auto& [reference_g, found] : at)
      if (!found.thresholds_g.empty())
        std::cout << fmt::format(
            " {:g} g: {:.0f} g, interval a factor of {:.2f}, coverage {:.0f} % of {:.0f} % given;",
            reference_g, median(found.thresholds_g), median(found.widths), found.coverage.percent(),
            found.coverage.given_percent());
    std::cout << std::endl;
  }
};

TEST(CoverageOf, Designs) {
  const int studies = std::min(n_studies(3), 100);
  // Medians of studies and shares of them differ by this much by chance alone (three standard
  // errors).
  const double chance = 3 * 0.1 * 1.25 / std::sqrt(studies);
  int n_ordered = 0;
  const std::array criteria{1e-6, 0.3, 1.2, 2.4};
  for (const double criterion : criteria) {
    const DesignStudy found(comparison_of("recommended"), criterion, studies);
    found.print("recommended.toml", criterion, studies);
    EXPECT_LE(found.trials, 200);
    n_ordered += found.n_ordered;
    for (const auto& [reference_g, one] : found.at) {
      EXPECT_NEAR(std::log(median(one.thresholds_g) / thresholds_g.at(reference_g)), 0,
                  std::log(150 / 140.0) + chance);
      EXPECT_EQ(one.coverage.given_percent(), 100);
      EXPECT_GE(one.coverage.percent(), 93 - by_chance_percent(studies));
    }
    if (studies < 20) continue;  // the others are for comparison
    for (const std::string other : {"examples/paired_staircases", "paper"})
      DesignStudy(comparison_of(other), criterion, studies)
          .print(other + ".toml", criterion, studies);
  }
  EXPECT_GE(n_ordered, 0.8 * studies * static_cast<int>(criteria.size()));
}

}  // namespace
}  // namespace heft
