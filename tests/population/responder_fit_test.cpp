// Populations fitted to figures: known ones are recovered, and parameters that the figures do not
// determine are reported as such.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "SourceFolder.h"
#include "base/Random.h"
#include "inference/Statistics.h"
#include "population/ResponderFit.h"

namespace heft {
namespace {
using ::testing::HasSubstr;

ResolvedConfig jnd_by_surrogate() {
  SessionOptions given;
  given.responder = Plug{"simulated"};
  given.tracker = Plug{"surrogate"};
  return resolve(given, load_protocol(source_folder() + "/protocols/jnd.toml", {}), 3);
}

const std::vector<FigurePlace> places{{FigureKind::jnd, 200.0, ""},
                                      {FigureKind::wrong_choices, {}, ""},
                                      {FigureKind::stroke_depth, {}, ""}};

Bank bank_of(std::vector<FreeParameter> free, int people, int jobs = 2) {
  const std::atomic<bool> stop = false;
  return *Bank::simulate(
      {jnd_by_surrogate(), std::move(free), places, people, jobs}, [](double) {}, stop);
}

const Bank& criterion_and_noise() {
  static const Bank bank = bank_of({{"criterion_mm", 5, 25}, {"judgment_noise_mm", 1.5, 10}}, 2000);
  return bank;
}

// Figures of a study of people with these parameters; other parameters vary as usual.
std::vector<ReportedFigure> study_of(const std::vector<Parameter>& parameters, int n) {
  const ResolvedConfig config = jnd_by_surrogate();
  std::vector<std::vector<double>> values(places.size());
  for (int i = 0; i < n; ++i) {
    const std::uint64_t seed = RandomStream(5, "person", static_cast<std::uint64_t>(i)).bits() >> 1;
    const auto person = config->model.entry->make({seed, parameters, ""});
    const auto figures = figures_of_one(config, *person, seed, places);
    for (std::size_t f = 0; f < places.size(); ++f)
      if (figures[f]) values[f].push_back(*figures[f]);
  }
  std::vector<ReportedFigure> study;
  for (std::size_t f = 0; f < places.size(); ++f)
    study.push_back({places[f], mean(values[f]), sample_sd(values[f]), n, true});
  return study;
}

// Weights over the bank against people drawn from the population.
TEST(Bank, WeightedGivesTheFiguresOfThePopulation) {
  constexpr int n = 300;
  const auto study = study_of({{"criterion_mm", 12.0, {}}, {"judgment_noise_mm", 4.0, {}}}, n);
  Parameters at(2);
  at << 12, 4;
  std::vector<Bank::Moments> found;
  criterion_and_noise().moments(at, found);
  for (std::size_t f = 0; f < places.size(); ++f) {
    const double per_person = 1.0 / n + 1 / found[f].effective;
    const double se = found[f].sd * std::sqrt(per_person);
    EXPECT_NEAR(*study[f].mean, found[f].mean, 4 * se) << text_of(places[f]);
    const double se_log_sd = std::sqrt((found[f].kurtosis - 1) / 4 * per_person);
    EXPECT_NEAR(std::log(*study[f].sd / found[f].sd), 0, 4 * se_log_sd) << text_of(places[f]);
  }
}

TEST(ResponderFit, FindsAKnownPopulation) {
  const auto study = study_of({{"criterion_mm", 12.0, {}}, {"judgment_noise_mm", 4.0, {}}}, 30);
  const ResponderFit fit = fit_responder(criterion_and_noise(), study);
  ASSERT_EQ(fit.parameters.size(), 2u);
  EXPECT_TRUE(fit.parameters[0].identified());
  EXPECT_NEAR(std::log(fit.parameters[0].value / 12), 0, 0.35);
  for (const auto& [i, truth] : {std::pair(0u, 12.0), std::pair(1u, 4.0)}) {
    const FreeEstimate& one = fit.parameters[i];
    EXPECT_LT(one.low.value_or(one.free.low), truth) << one.free.name << " " << one.value;
    EXPECT_GT(one.high.value_or(one.free.high), truth) << one.free.name << " " << one.value;
  }
  for (const ComparedFigure& figure : fit.figures) EXPECT_LT(std::abs(*figure.z_mean), 3);
  EXPECT_EQ(fit.n_fitted, 6);
}

TEST(ResponderFit, HeldOutFiguresDoNotMoveItAndWhatIsNotSaidStaysOpen) {
  const Bank bank = bank_of({{"criterion_mm", 1, 40}, {"think_s", 0.5, 3}}, 400);
  auto study = study_of({{"criterion_mm", 12.0, {}}}, 20);
  study[1].fitted = study[2].fitted = false;
  const double before = fit_responder(bank, study).parameters[0].value;
  *study[2].mean += 30;
  const ResponderFit fit = fit_responder(bank, study);
  EXPECT_EQ(fit.parameters[0].value, before);
  EXPECT_GT(std::abs(*fit.figures[2].z_mean), 3);
  EXPECT_EQ(fit.n_fitted, 2);
  EXPECT_EQ(fit.n_held_out, 4);
  EXPECT_FALSE(fit.parameters[1].identified()) << "no figure depends on the time for thinking";
}

TEST(ResponderFit, AFigureThatTheProtocolCannotGiveIsNamed) {
  const std::atomic<bool> stop = false;
  const std::vector<FigurePlace> other{{FigureKind::jnd, 33.0, ""}};
  const Bank bank = *Bank::simulate(
      {jnd_by_surrogate(), {{"criterion_mm", 2, 20}}, other, 4, 1}, [](double) {}, stop);
  try {
    fit_responder(bank, std::vector<ReportedFigure>{{other[0], 10.0, {}, 5, true}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("has the figure \"jnd at 33 g\""));
  }
}

TEST(ResponderFit, AHeldOutFigureThatNoOneHasSaysNothing) {
  const std::vector<FigurePlace> with_catches{places[0], {FigureKind::false_alarms, {}, ""}};
  SessionOptions given;
  given.responder = Plug{"simulated"};
  given.tracker = Plug{"surrogate"};
  const std::atomic<bool> stop = false;
  const Bank bank = *Bank::simulate(
      {resolve(given, load_protocol(source_folder() + "/protocols/paper.toml", {}), 3),
       {{"criterion_mm", 4, 30}},
       with_catches,
       60,
       2},
      [](double) {}, stop);
  const ResponderFit fit =
      fit_responder(bank, std::vector<ReportedFigure>{{with_catches[0], 271.0, {}, 13, true},
                                                      {with_catches[1], 10.0, 5.0, 13, false}});
  EXPECT_FALSE(fit.figures[1].found.exists()) << "the paper has no catch trials";
  EXPECT_FALSE(fit.figures[1].z_mean || fit.figures[1].z_sd);
  EXPECT_EQ(fit.held_out, 0);
  EXPECT_EQ(fit.n_held_out, 0);
  EXPECT_TRUE(fit.figures[0].z_mean);
}

TEST(Figures, FirstTryIsAHundredForThoseWhoFindTheHeavyCubeAtOnce) {
  SessionOptions given;
  given.responder = Plug{"coin"};  // touches the left cube first
  given.tracker = Plug{"surrogate"};
  const ResolvedConfig config =
      resolve(given, load_protocol(source_folder() + "/protocols/paper.toml", {}), 3);
  int n_first = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto person = config->model.responder(seed);
    const auto first = figures_of_one(config, *person, seed,
                                      std::vector<FigurePlace>{{FigureKind::first_try, {}, ""}});
    ASSERT_TRUE(first[0] == 0 || first[0] == 100);
    n_first += first[0] == 100 ? 1 : 0;
  }
  EXPECT_NEAR(n_first, 30, 4 * std::sqrt(60 * 0.25));
}

TEST(Bank, DoesNotDependOnThreads) {
  const Bank one = bank_of({{"criterion_mm", 2, 20}}, 40, 1),
             two = bank_of({{"criterion_mm", 2, 20}}, 40, 3);
  Parameters at(1);
  at[0] = 6;
  std::vector<Bank::Moments> first, second;
  one.moments(at, first);
  two.moments(at, second);
  for (std::size_t f = 0; f < places.size(); ++f) EXPECT_EQ(first[f].mean, second[f].mean);
}

std::string refusal_of(const std::vector<FreeParameter>& free) {
  try {
    bank_of(free, 10);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(PositiveRange, IsReadWithItsUnitOrWithout) {
  using Range = std::optional<std::pair<double, double>>;
  EXPECT_EQ(positive_range_in("10..1000"), Range(std::pair(10.0, 1000.0)));
  EXPECT_EQ(positive_range_in("10g..1e3g", "g"), Range(std::pair(10.0, 1000.0)));
  EXPECT_EQ(positive_range_in("10..1000", "g"), Range(std::pair(10.0, 1000.0)));
  for (const char* text : {"", "10", "10..", "..10", "0..10", "20..10", "10..10", "10...20",
                           "10g..20g", "1..inf", "-1..2"})
    EXPECT_FALSE(positive_range_in(text)) << text;
}

TEST(FreeParameters, MistakesSayWhatWasExpected) {
  for (const char* text : {"criterion_mm", "criterion_mm=5", "criterion_mm=5..2",
                           "criterion_mm=0..2", "criterion_mm=1..x", "=..", "criterion_mm..=1"})
    EXPECT_THROW(read_free_parameter(text), Error) << text;
  const FreeParameter free = read_free_parameter("criterion_mm.spread=0.1..1.5");
  EXPECT_EQ(free.name, "criterion_mm.spread");
  EXPECT_EQ(free.low, 0.1);
  EXPECT_EQ(free.high, 1.5);
  EXPECT_THAT(refusal_of({{"criterion", 1, 2}}), HasSubstr("no such parameter"));
  EXPECT_THAT(refusal_of({{"criterion_mm", 1, 2}, {"criterion_mm", 1, 2}}), HasSubstr("twice"));
  EXPECT_THAT(refusal_of({{"criterion_mm", 1, 200}}), HasSubstr("within 0 to 100"));
  EXPECT_THAT(refusal_of({{"stop_gap_m.spread", 0.1, 1}}), HasSubstr("median of stop_gap_m is 0"));
}

TEST(ReportedFigures, MistakesAreReportedAtTheirPlaces) {
  try {
    parse_figures(
        "[[figure]]\nfigure = \"jnd\"\nmean = 3\n[[figure]]\nfigure = \"corect\"\n"
        "[[figure]]\nfigure = \"correct\"\nsd = 2\n",
        "f.toml");
    FAIL();
  } catch (const InvalidFile& invalid) {
    EXPECT_THAT(invalid.what(), HasSubstr("f.toml:2"));
    EXPECT_THAT(invalid.what(), HasSubstr("needs its reference_g"));
    EXPECT_THAT(invalid.what(), HasSubstr("f.toml:5"));
    EXPECT_THAT(invalid.what(), HasSubstr("an sd needs its mean"));
  }
}

}  // namespace
}  // namespace heft
