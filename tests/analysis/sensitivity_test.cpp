// Sensitivity without influence of the criterion: the simulated value is found, its interval
// contains it as often as stated, and people who perceive nothing get no threshold.
#include "analysis/measures/Sensitivity.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <iostream>

#include "MadeUpChoosers.h"
#include "analysis/Analysis.h"
#include "analysis/Figures.h"
#include "analysis/Folds.h"
#include "analysis/charts/Charts.h"
#include "analysis/dataset/Summary.h"
#include "analysis/report/Notes.h"
#include "analysis/report/Report.h"
#include "inference/Coverage.h"

namespace heft {
namespace {

using namespace made_up;
using testing::HasSubstr;
using testing::Not;

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
        sensitivities_of(study(200, {150, 0.3, indecision}, {paired_at(200)}, stream));
    ASSERT_TRUE(rows.at(0).fit.identifiable()) << rows.at(0).fit.why;
    // 4 SE, and 5 % of bias where the criterion is far out
    EXPECT_NEAR(rows[0].fit.threshold_75_g->value, 150, indecision > 2 ? 20 : 12);
    EXPECT_NEAR(rows[0].fit.indecision->value, indecision, 0.12 * indecision);
  }
}

TEST(Sensitivity, OfFewPeopleIsNotPrinted) {
  RandomStream stream(6, "few");
  const auto rows = sensitivities_of(study(3, {150}, {paired_at(200)}, stream));
  EXPECT_FALSE(rows.at(0).fit.identifiable());
  EXPECT_FALSE(rows[0].fit.threshold_75_g.has_value());
  EXPECT_THAT(rows[0].fit.why, HasSubstr("3 participants are too few"));
}

TEST(Sensitivity, OfOnePersonIsThatPersonsOwn) {
  RandomStream stream(7, "one");
  SessionData data = session(1, "a");
  for (int i = 0; i < 6; ++i) compare(data, {0.6745 / 100}, paired_at(200), stream);
  const auto rows = sensitivities_of({&data, 1});
  ASSERT_TRUE(rows.at(0).fit.identifiable()) << rows[0].fit.why;
  EXPECT_LT(*rows[0].fit.threshold_75_g->low, 100);
  EXPECT_GT(*rows[0].fit.threshold_75_g->high, 100);
}

// Of a Bayesian procedure at the same reference, beside the threshold that is fitted to all trials
// and the JND of reversals.
TEST(Sensitivity, OfAParticipantHasTheProceduresPosteriorBesideIt) {
  SessionData data = session(1, "a");
  add_staircase(data, "reversals", 200, 60);
  add_staircase(data, "informative", 200, 40);
  EstimateRow& row = data.estimates[1];
  row.method = "psi";
  row.low_g = 30;
  row.high_g = 55;
  const auto posterior = [&] {
    const Summary summary = summarized({data});
    EXPECT_EQ(figure(summary, "participant_jnd", {{"participant", "a"}}).value, 60);
    EXPECT_EQ(figure(summary, "posterior_threshold", {{"method", "quest"}}).measure, nullptr);
    return figure(summary, "posterior_threshold", {{"participant", "a"}, {"method", "psi"}});
  };
  EXPECT_EQ(posterior().value, 40);
  EXPECT_EQ(posterior().low, 30);
  EXPECT_EQ(posterior().high, 55);
  EXPECT_THAT(as_json(summarized({data})), HasSubstr(R"("psi_high_g": 55.0)"));

  row.jnd_g.reset();
  row.low_g.reset();
  row.high_g.reset();
  row.censored = Censored::indeterminate;
  EXPECT_FALSE(posterior().value);
  EXPECT_EQ(posterior().why, "not identifiable");

  row.jnd_g = 60;
  row.censored = Censored::none;
  add_staircase(data, "another", 200, 80);
  data.estimates[2].method = "psi";
  EXPECT_EQ(posterior().value, 70) << "the mean of both";
  EXPECT_FALSE(posterior().low);
}

// The model is drawn as what it predicts along the staircases, in the same bins.
TEST(ChoiceCurves, HaveTheModelsPredictionBehindThem) {
  RandomStream stream(7, "bands");
  std::vector<SessionData> people = study(8, {150}, {paired_at(200)}, stream);
  const auto curves = [](const std::vector<SessionData>& sessions) {
    const Summary summary = summarize({"x.db", sessions}, "");
    for (const char* choice : {"heavier", "lighter", "none"}) {
      const auto seen = estimates_of(summary.estimates, fmt::format("chosen_{}", choice));
      const auto predicted = estimates_of(summary.estimates, fmt::format("predicted_{}", choice));
      for (const StudyEstimate* one : predicted) {
        EXPECT_TRUE(std::ranges::any_of(seen, [&](const StudyEstimate* of) {
          return of->at("mean_level_g")->value == one->at("mean_level_g")->value;
        }));
        EXPECT_LE(*one->low, *one->value);
        EXPECT_GE(*one->high, *one->value);
      }
    }
    for (const Chart& chart : charts_of(summary))
      if (chart.name == "choice_curves") return chart.script;
    return std::string();
  };
  EXPECT_THAT(curves(people), HasSubstr("with filledcurves"));
  for (SessionData& data : people) data.staircases.clear();  // of a protocol that can't be read
  EXPECT_THAT(curves(people), Not(HasSubstr("with filledcurves")));
}

// A threshold with a known SD of its logarithm, from people with independent influences.
MixedFit known(double threshold_75_g, double sd_log, const std::string& of) {
  MixedFit fit;
  fit.n = 13;
  fit.threshold_75_g = MixedFigure{threshold_75_g, threshold_75_g / 2, threshold_75_g * 2};
  for (int i = 0; i < 13; ++i)
    fit.influence[of + std::to_string(i)] = sd_log / 13 * (i % 2 == 0 ? 1 : -1);
  return fit;
}

TEST(Hypotheses, FollowTheExponentOfThresholds) {
  const auto verdicts = [](const std::array<double, 3>& thresholds_g, double sd_log) {
    Summary summary = summarize({"x.db", {}}, "");
    std::vector<ReferenceSensitivity> rows;
    for (std::size_t i = 0; i < 3; ++i)
      rows.push_back({{std::array{15.0, 200.0, 800.0}[i], "C2"},
                      known(thresholds_g[i], sd_log, std::to_string(i) + "."),
                      true});
    put_sensitivities(summary.estimates, rows);
    const auto all = hypotheses_of(summary);
    return std::pair(all.at(3).verdict, all.at(4).verdict);
  };
  using enum HypothesisVerdict;
  EXPECT_EQ(verdicts({90, 140, 375}, 0.2), std::pair(supported, not_supported));
  EXPECT_EQ(verdicts({15, 200, 800}, 0.2), std::pair(supported, supported));
  EXPECT_EQ(verdicts({100, 100, 100}, 0.2), std::pair(inconclusive, not_supported));
  EXPECT_EQ(verdicts({800, 200, 15}, 0.2), std::pair(not_supported, not_supported));
  EXPECT_EQ(verdicts({90, 140, 375}, 20), std::pair(inconclusive, inconclusive));
}

TEST(ThresholdContrast, OfTwoIndependentThresholdsHasTheirVariancesSum) {
  const MixedFit light = known(100, 0.3, "a"), heavy = known(200, 0.3, "b");
  const Contrast ratio = threshold_contrast(std::array{&light, &heavy}, std::array{-1.0, 1.0});
  EXPECT_NEAR(ratio.value, std::log(2), 1e-12);
  EXPECT_EQ(ratio.n, 26);
  EXPECT_NEAR(ratio.standard_error, 0.3 / 13 * 26 / std::sqrt(25), 1e-12);
  EXPECT_NEAR(ratio.interval().high - ratio.value, 2.0595 * ratio.standard_error, 1e-4);
  EXPECT_NEAR(ratio.smallest_effect(), (2.0595 + 0.8562) * ratio.standard_error, 1e-4);
}

// The same people in both: what they have in common cancels.
TEST(ThresholdContrast, OfTheSamePeopleKeepsWhatDiffers) {
  const MixedFit light = known(100, 0.3, "a"), heavy = known(200, 0.3, "a");
  const Contrast ratio = threshold_contrast(std::array{&light, &heavy}, std::array{-1.0, 1.0});
  EXPECT_EQ(ratio.n, 13);
  EXPECT_NEAR(ratio.standard_error, 0, 1e-12);
}

TEST(ThresholdExponent, IsTheSlopeOfLogThresholdOnLogReference) {
  const MixedFit light = known(10, 0.3, "a"), middle = known(20, 0.3, "b"),
                 heavy = known(40, 0.3, "c");
  const Contrast slope =
      threshold_exponent(std::array{&light, &middle, &heavy}, std::array{100.0, 400.0, 1600.0});
  EXPECT_NEAR(slope.value, 0.5, 1e-12);
}

Interval ratio_interval(const MixedFit& first, const MixedFit& second) {
  const auto [low, high] =
      threshold_contrast(std::array{&first, &second}, std::array{-1.0, 1.0}).interval();
  return {std::exp(low), std::exp(high)};
}

// At one reference 150 g, at the other 600 g, of people who keep their sensitivity or don't.
TEST(CoverageOf, ThresholdRatios) {
  const int studies = n_studies(12);
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
          compare(sessions.back(), light, paired_at(200), stream);
          compare(sessions.back(), heavy, paired_at(800), stream);
        }
        const auto rows = sensitivities_of(sessions);
        if (rows.at(0).fit.identifiable() && rows.at(1).fit.identifiable())
          found.add(ratio_interval(rows[0].fit, rows[1].fit), 4);
      }
      std::cout << "ratio of thresholds of " << (same ? "the same" : "independent")
                << " sensitivities, indecision " << indecision << ": " << found.percent()
                << " % of " << found.n_given() << "\n";
      expect_95(found, studies);
    }
}

// A participant missing at one reference is still drawn at the other; no one replaces another.
TEST(Sensitivity, ARatioIsOfTheSamePeopleIfSomeAreMissing) {
  RandomStream stream(41, "missing");
  std::vector<SessionData> all, missing, strangers;
  for (int i = 0; i < 12; ++i) {
    // People who differ much, and are the same at both references.
    const Chooser one{0.0045 * std::exp(i % 2 == 0 ? 0.8 : -0.8), 1, 0};
    SessionData at_first = session(i + 1, std::to_string(100 + i));
    SessionData at_second = session(i + 1, std::to_string(200 + i));
    for (int k = 0; k < 4; ++k) compare(at_first, one, paired_at(200), stream);
    SessionData at_both = at_first;
    for (int k = 0; k < 4; ++k) compare(at_both, one, paired_at(201), stream);
    for (int k = 0; k < 4; ++k) compare(at_second, one, paired_at(201), stream);
    all.push_back(at_both);
    missing.push_back(i == 0 ? at_first : at_both);
    strangers.insert(strangers.end(), {at_first, at_second});
  }
  const auto width = [](const std::vector<SessionData>& sessions) {
    const auto rows = sensitivities_of(sessions);
    const Interval ratio = ratio_interval(rows.at(0).fit, rows.at(1).fit);
    return std::log(ratio.high / ratio.low);
  };
  EXPECT_LT(width(missing), 2 * width(all));
  EXPECT_GT(width(strangers), 2 * width(missing));
}

// The difference (above minus below) that a very large study would find, among people whose
// staircases end well.
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
    const ComparisonDesign design = paired_at(reference_g);
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

// Counts of studies of people who perceive nothing: those that print a threshold, and those that
// support E2-H1.
struct Misled {
  double thresholds_percent = 0, supported_percent = 0;
};

Misled misled_by(const Population& population, bool papers, int n_people, int studies) {
  RandomStream stream(23, "nothing seen", static_cast<std::uint64_t>(n_people));
  int n_thresholds = 0, n_supported = 0;
  for (int i = 0; i < studies; ++i) {
    std::vector<ComparisonDesign> designs;
    for (double reference_g : {15.0, 200.0, 800.0})
      designs.push_back(papers ? papers_at(reference_g) : paired_at(reference_g));
    const Summary summary = summarize({"x.db", study(n_people, population, designs, stream)}, "");
    for (const StudyEstimate* one : estimates_of(summary.estimates, "threshold_75"))
      n_thresholds += one->value ? 1 : 0;
    n_supported += summary.hypotheses.at(3).verdict == HypothesisVerdict::supported ? 1 : 0;
  }
  return {100.0 * n_thresholds / (3 * studies), 100.0 * n_supported / studies};
}

TEST(CoverageOf, NothingSeenGivesNoThreshold) {
  const bool is_short = n_studies(0) == 0;
  for (int n_people : is_short ? std::vector{13} : std::vector{13, 40})
    for (bool papers : {false, true})
      for (bool is_coin : {false, true}) {
        const Misled found = misled_by({.is_coin = is_coin}, papers, n_people, n_studies(2));
        std::cout << n_people << (is_coin ? " coins" : " people with only a criterion")
                  << (papers ? ", paper.toml: " : ", paired_staircases.toml: ")
                  << found.thresholds_percent << " % thresholds, " << found.supported_percent
                  << " % of studies with E2-H1 supported\n";
        EXPECT_LE(found.thresholds_percent, 5);
        EXPECT_EQ(found.supported_percent, 0);
      }
}

TEST(Hypotheses, AGoodObserversRisingThresholdIsSupported) {
  RandomStream stream(9, "rising");
  std::vector<SessionData> sessions;
  for (int i = 0; i < 20; ++i) {
    sessions.push_back(session(i + 1, std::to_string(100 + i)));
    for (double reference_g : {15.0, 200.0, 800.0})
      compare(sessions.back(), Population{0.5 * reference_g + 20}.draw(stream),
              paired_at(reference_g), stream);
  }
  const Summary summary = summarize({"x.db", sessions}, "");
  EXPECT_EQ(summary.hypotheses[3].verdict, HypothesisVerdict::supported)
      << summary.hypotheses[3].why;
}

}  // namespace
}  // namespace heft
