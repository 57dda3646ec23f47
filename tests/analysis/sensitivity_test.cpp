// Sensitivity, free of the criterion: what was put in is found, its interval holds it as often as
// it says, and people who see nothing get no threshold.
#include "analysis/dataset/Sensitivity.h"

#include <gmock/gmock.h>

#include <iostream>

#include "MadeUpChoosers.h"
#include "analysis/Folds.h"
#include "analysis/charts/Charts.h"
#include "analysis/dataset/Summary.h"
#include "analysis/report/Notes.h"
#include "inference/Coverage.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;
using testing::Not;

std::vector<SessionData> study(int n_people, const Population& population,
                               const std::vector<ComparisonDesign>& designs, RandomStream& stream,
                               std::vector<Chooser>* people = nullptr) {
  std::vector<SessionData> sessions;
  for (int i = 0; i < n_people; ++i) {
    sessions.push_back(session(i + 1, std::to_string(100 + i)));
    const Chooser chooser = population.draw(stream);
    if (people) people->push_back(chooser);
    for (const ComparisonDesign& design : designs)
      compare(sessions.back(), chooser, design, stream);
  }
  return sessions;
}

struct PooledCoverage {
  Coverage threshold, indecision, own;  ///< own: each person's sensitivity
};

PooledCoverage pooled_coverage(int n_people, const Population& population,
                               const ComparisonDesign& design, int studies) {
  RandomStream stream(17, "thresholds", static_cast<std::uint64_t>(n_people));
  PooledCoverage found;
  for (int i = 0; i < studies; ++i) {
    std::vector<Chooser> people;
    const auto rows = sensitivities_of(study(n_people, population, {design}, stream, &people));
    for (std::size_t k = 0; k < people.size(); ++k) {
      const OwnSensitivity& own = rows.at(0).pooled.people.at(std::to_string(100 + k));
      found.own.add(Interval{own.low.value_or(-1e9), own.high.value_or(1e9)},
                    people[k].sensitivity_per_g);
    }
    found.threshold.add(rows.at(0).pooled.threshold_interval_g, population.threshold_75_g);
    found.indecision.add(rows.at(0).pooled.indecision_interval, population.indecision);
  }
  return found;
}

void expect_95(const Coverage& found, int studies) {
  const double chance = by_chance_percent(studies);
  EXPECT_GE(found.percent(), 93 - chance);
  EXPECT_LE(found.percent(), 98 + chance);
}

TEST(AnswersBySide, SignTheLevelByWhereTheHeavierStood) {
  SessionData data = session(1, "a");
  Attempt& on_left = add_comparison(data, "s", 200, 50);  // reference left: comparison right
  choose(on_left, true);
  Attempt& on_right = add_comparison(data, "s", 200, 50);
  on_right.trial.plan.reference_slot = 2;
  on_right.trial.outcome = "difference";
  on_right.trial.chosen_slot = 1;
  add_comparison(data, "", 200, 0).trial.plan.is_catch = true;
  const auto trials = folded<ComparisonTrials>({&data, 1});
  const auto people = answers_by_side(trials, trials.by_compared().begin()->first);
  const AnswersByLevel& answers = people.at("a");
  EXPECT_EQ(answers.at(50), (std::array<double, 3>{0, 0, 1}));
  EXPECT_EQ(answers.at(-50), (std::array<double, 3>{1, 0, 0}));
  EXPECT_EQ(answers.at(0), (std::array<double, 3>{0, 1, 0}));
}

TEST(Sensitivity, IsFoundWhateverTheCriterion) {
  RandomStream stream(5, "criteria");
  for (const double indecision : {0.3, 1.0, 2.5}) {
    const auto rows =
        sensitivities_of(study(200, {150, 0.3, indecision}, {recommended_at(200)}, stream));
    ASSERT_TRUE(rows.at(0).pooled.identifiable()) << rows.at(0).pooled.why;
    // 4 SE, and 5 % of bias where the criterion is far out
    EXPECT_NEAR(*rows[0].pooled.threshold_75_g, 150, indecision > 2 ? 20 : 12);
    EXPECT_NEAR(*rows[0].pooled.indecision, indecision, 0.12 * indecision);
  }
}

TEST(Sensitivity, OfFewPeopleIsNotPrinted) {
  RandomStream stream(6, "few");
  const auto rows = sensitivities_of(study(3, {150}, {recommended_at(200)}, stream));
  EXPECT_FALSE(rows.at(0).pooled.identifiable());
  EXPECT_FALSE(rows[0].pooled.threshold_75_g.has_value());
  EXPECT_THAT(rows[0].pooled.why, HasSubstr("3 participants are too few"));
}

TEST(Sensitivity, OfOnePersonIsThatPersonsOwn) {
  RandomStream stream(7, "one");
  SessionData data = session(1, "a");
  for (int i = 0; i < 6; ++i) compare(data, {0.6745 / 100}, recommended_at(200), stream);
  const auto rows = sensitivities_of({&data, 1});
  ASSERT_TRUE(rows.at(0).pooled.identifiable()) << rows[0].pooled.why;
  EXPECT_LT(rows[0].pooled.threshold_interval_g->low, 100);
  EXPECT_GT(rows[0].pooled.threshold_interval_g->high, 100);
}

// Below 0 the reference is the heavier cube: it is chosen as often as the comparison above 0.
TEST(ChoiceCurves, TheModelIsTheSameOnBothSidesOfZero) {
  RandomStream stream(7, "one");
  SessionData data = session(1, "a");
  for (int i = 0; i < 6; ++i) compare(data, {0.6745 / 100}, recommended_at(200), stream);
  const Summary summary = summarize({"x.db", {data}}, "");
  std::string script;
  for (const Chart& chart : charts_of(summary))
    if (chart.name == "choice_curves") script = chart.script;
  EXPECT_THAT(script, HasSubstr("*abs(x)-"));
  EXPECT_THAT(script, Not(HasSubstr("*x-")));
}

// Of two ratios one may be off by chance twice as often as the only one.
TEST(Hypotheses, ProportionIsDeniedAsOneStatementOfTwoRatios) {
  PooledSensitivity light, heavy, heaviest;
  light.n = heavy.n = heaviest.n = 13;
  light.sensitivity = std::exp(1);
  heavy.sensitivity = heaviest.sensitivity = 1;
  light.threshold_75_g = heavy.threshold_75_g = heaviest.threshold_75_g = z_75;
  for (int i = 0; i < 2000; ++i) {
    light.sensitivity_samples.push_back(std::exp(2.0 * i / 2000));
    heavy.sensitivity_samples.push_back(1);
    heaviest.sensitivity_samples.push_back(1);
  }
  const auto verdict = [&](double ratio) {
    Summary summary = summarize({"x.db", {}}, "");
    const auto row = [](double reference_g, const PooledSensitivity& pooled) {
      return ReferenceSensitivity{{reference_g, "C2"}, pooled, true};
    };
    put_sensitivities(summary.estimates, std::vector{row(100, light), row(100 * ratio, heavy),
                                                     row(100 * ratio, heaviest)});
    return hypotheses_of(summary).at(4).verdict;
  };
  const Interval one = threshold_ratio_interval(light, heavy);
  const Interval of_two = threshold_ratio_interval(light, heavy, 0.975);
  ASSERT_LT(one.high, of_two.high);
  EXPECT_EQ(verdict((one.high + of_two.high) / 2), HypothesisVerdict::inconclusive);
  EXPECT_EQ(verdict(1.1 * of_two.high), HypothesisVerdict::not_supported);
}

TEST(CoverageOf, Sensitivities) {
  const int studies = n_studies(20);
  for (const auto& [n_people, population, reference_g] :
       {std::tuple{13, Population{150, 0}, 200.0}, std::tuple{13, Population{150}, 200.0},
        std::tuple{13, Population{150, 0.3, 0.4}, 200.0}, std::tuple{13, Population{50}, 15.0},
        std::tuple{13, Population{600}, 800.0}, std::tuple{40, Population{150}, 200.0},
        std::tuple{13, Population{150, 0.3, 2}, 200.0},
        std::tuple{40, Population{150, 0.3, 2}, 200.0}}) {
    const auto [threshold, indecision, own] =
        pooled_coverage(n_people, population, recommended_at(reference_g), studies);
    std::cout << n_people << " people, threshold " << population.threshold_75_g << " g, spread "
              << population.spread << ": " << threshold.percent() << " % of "
              << threshold.given_percent() << " % given; indecision " << population.indecision
              << ": " << indecision.percent() << " %; of each person " << own.percent() << " %\n";
    expect_95(threshold, studies);
    expect_95(indecision, studies);
    EXPECT_GE(threshold.given_percent(), 95);
    EXPECT_EQ(indecision.given_percent(), 100);
    EXPECT_GE(own.percent(), 93 - by_chance_percent(own.n_given()));
    EXPECT_LE(own.percent(), 98 + by_chance_percent(own.n_given()));
  }
}

// At one reference 150 g, at the other 600 g, of people who keep their sensitivity or don't.
TEST(CoverageOf, ThresholdRatios) {
  const int studies = n_studies(20);
  for (const bool same : {false, true})
    for (const double indecision : {1.0, 2.0}) {
      RandomStream stream(19, "ratios", same ? 1 : 0);
      Coverage found;
      for (int i = 0; i < studies; ++i) {
        std::vector<SessionData> sessions;
        for (int k = 0; k < 13; ++k) {
          sessions.push_back(session(k + 1, std::to_string(100 + k)));
          const Chooser light = Population{150, 0.3, indecision}.draw(stream);
          Chooser heavy = Population{600, 0.3, indecision}.draw(stream);
          if (same) heavy = {light.sensitivity_per_g / 4, light.indecision, light.side_bias};
          compare(sessions.back(), light, recommended_at(200), stream);
          compare(sessions.back(), heavy, recommended_at(800), stream);
        }
        const auto rows = sensitivities_of(sessions);
        if (rows.at(0).pooled.identifiable() && rows.at(1).pooled.identifiable())
          found.add(threshold_ratio_interval(rows[0].pooled, rows[1].pooled), 4);
      }
      std::cout << "ratio of thresholds of " << (same ? "the same" : "independent")
                << " sensitivities, indecision " << indecision << ": " << found.percent()
                << " % of " << found.n_given() << "\n";
      expect_95(found, studies);
    }
}

// A participant missing at one reference is still drawn at the other; no one replaces another.
TEST(Sensitivity, ARatioIsOfTheSamePeopleWhoeverIsMissing) {
  RandomStream stream(41, "missing");
  std::vector<SessionData> all, missing, strangers;
  for (int i = 0; i < 12; ++i) {
    // People who differ much, and are the same at both references.
    const Chooser one{0.0045 * std::exp(i % 2 == 0 ? 0.8 : -0.8), 1, 0};
    SessionData at_first = session(i + 1, std::to_string(100 + i));
    SessionData at_second = session(i + 1, std::to_string(200 + i));
    for (int k = 0; k < 4; ++k) compare(at_first, one, recommended_at(200), stream);
    SessionData at_both = at_first;
    for (int k = 0; k < 4; ++k) compare(at_both, one, recommended_at(201), stream);
    for (int k = 0; k < 4; ++k) compare(at_second, one, recommended_at(201), stream);
    all.push_back(at_both);
    missing.push_back(i == 0 ? at_first : at_both);
    strangers.insert(strangers.end(), {at_first, at_second});
  }
  const auto width = [](const std::vector<SessionData>& sessions) {
    const auto rows = sensitivities_of(sessions);
    const Interval ratio = threshold_ratio_interval(rows.at(0).pooled, rows.at(1).pooled);
    return std::log(ratio.high / ratio.low);
  };
  EXPECT_LT(width(missing), 2 * width(all));
  EXPECT_GT(width(strangers), 2 * width(missing));
}

// What a study of ever more people would find: above minus below, of those whose staircases end
// well.
double true_start_effect(const Population& population, const ComparisonDesign& design) {
  RandomStream stream(29, "very many people");
  const auto jnds = jnd_of(study(4000, population, {design}, stream));
  return jnds.at(0).starts.value().difference_g.mean.value();
}

TEST(CoverageOf, AboveMinusBelow) {
  const int studies = n_studies(60);
  for (const auto& [n_people, population, reference_g] :
       {std::tuple{13, Population{150}, 200.0}, std::tuple{40, Population{150}, 200.0},
        std::tuple{13, Population{50}, 15.0}}) {
    const ComparisonDesign design = recommended_at(reference_g);
    const double truth = true_start_effect(population, design);
    RandomStream stream(31, "above and below", static_cast<std::uint64_t>(n_people));
    Coverage found;
    for (int i = 0; i < studies; ++i) {
      const auto jnds = jnd_of(study(n_people, population, {design}, stream));
      found.add(jnds.at(0).starts.value().difference_g.interval, truth);
    }
    std::cout << n_people << " people, threshold " << population.threshold_75_g
              << " g, above - below " << truth << " g: " << found.percent() << " % of "
              << found.given_percent() << " % given\n";
    expect_95(found, studies);
  }
}

// People who see nothing: how many studies print a threshold or take E2-H1 for supported.
struct Misled {
  double thresholds_percent = 0, supported_percent = 0;
};

Misled misled_by(const Population& population, bool papers, int n_people, int studies) {
  RandomStream stream(23, "nothing seen", static_cast<std::uint64_t>(n_people));
  int n_thresholds = 0, n_supported = 0;
  for (int i = 0; i < studies; ++i) {
    std::vector<ComparisonDesign> designs;
    for (double reference_g : {15.0, 200.0, 800.0})
      designs.push_back(papers ? papers_at(reference_g) : recommended_at(reference_g));
    const Summary summary = summarize({"x.db", study(n_people, population, designs, stream)}, "");
    for (const StudyEstimate* one : estimates_of(summary.estimates, "threshold_75"))
      n_thresholds += one->value ? 1 : 0;
    n_supported += summary.hypotheses.at(3).verdict == HypothesisVerdict::supported ? 1 : 0;
  }
  return {100.0 * n_thresholds / (3 * studies), 100.0 * n_supported / studies};
}

TEST(CoverageOf, NothingSeenGivesNoThreshold) {
  for (int n_people : {13, 40})
    for (bool papers : {false, true})
      for (bool is_coin : {false, true}) {
        const Misled found = misled_by({.is_coin = is_coin}, papers, n_people, n_studies(8));
        std::cout << n_people << (is_coin ? " coins" : " people with only a criterion")
                  << (papers ? ", paper.toml: " : ", recommended.toml: ")
                  << found.thresholds_percent << " % thresholds, " << found.supported_percent
                  << " % of studies with E2-H1 supported\n";
        EXPECT_LE(found.thresholds_percent, 5);
        EXPECT_EQ(found.supported_percent, 0);
      }
}

TEST(Hypotheses, AGoodObserverWhoseThresholdRisesIsToldSo) {
  RandomStream stream(9, "rising");
  std::vector<SessionData> sessions;
  for (int i = 0; i < 20; ++i) {
    sessions.push_back(session(i + 1, std::to_string(100 + i)));
    for (double reference_g : {15.0, 200.0, 800.0})
      compare(sessions.back(), Population{0.5 * reference_g + 20}.draw(stream),
              recommended_at(reference_g), stream);
  }
  const Summary summary = summarize({"x.db", sessions}, "");
  EXPECT_EQ(summary.hypotheses[3].verdict, HypothesisVerdict::supported)
      << summary.hypotheses[3].why;
}

}  // namespace
}  // namespace heft
