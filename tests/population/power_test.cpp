// Studies of simulated people, against the same studies run one by one.
#include "population/Power.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>

#include "SourceFolder.h"
#include "analysis/Analysis.h"
#include "base/Random.h"
#include "session/Simulation.h"

namespace heft {
namespace {
namespace fs = std::filesystem;

class PowerTest : public ::testing::Test {
 protected:
  PowerTest() { fs::create_directories(folder_); }
  ~PowerTest() override { fs::remove_all(folder_); }

  PowerRequest request(int studies) const {
    SessionOptions given;
    given.responder = Plug{"simulated"};
    const Protocol protocol = load_protocol(source_folder() + "/protocols/quick.toml");
    return {resolve(given, protocol, 20261127), {4, 2, 4}, studies, 1, folder_};
  }
  static Power run(const PowerRequest& request) {
    const std::atomic<bool> never = false;
    return *power_of(
        request, [](double) {}, never);
  }

  std::string folder_ =
      (fs::temp_directory_path() / ("heft-power-test-" + std::to_string(::getpid()))).string();
};

// The results of each study, as text.
std::string text_of(const Power& power) {
  std::string text;
  for (const PowerAtSize& size : power.sizes) {
    text += "\n" + std::to_string(size.participants);
    for (const HypothesisPower& one : size.hypotheses)
      text += " " + one.name + " " + std::to_string(one.supported.n_hits) + " " +
              std::to_string(one.inconclusive.n_hits) + " " +
              std::to_string(one.supported.n_trials);
    for (const EstimatePrecision& one : size.estimates)
      text += " " + std::string(one.place.measure->name) + " " +
              std::to_string(one.printed.n_hits) + " " + std::to_string(one.median_low);
  }
  return text;
}

TEST_F(PowerTest, DoesNotDependOnThreads) {
  PowerRequest one = request(3);
  const std::string alone = text_of(run(one));
  one.jobs = 3;
  EXPECT_EQ(text_of(run(one)), alone);
  EXPECT_TRUE(fs::is_empty(folder_)) << "the studies' logs are removed";
}

// The smaller study is the first people of the larger one; both are analyzed as a log is.
TEST_F(PowerTest, SaysWhatTheReportsSay) {
  const PowerRequest made = request(2);
  const Power power = run(made);
  ASSERT_EQ(power.sizes.size(), 2u);
  EXPECT_EQ(power.sizes[0].participants, 2);
  EXPECT_EQ(power.sizes[1].participants, 4);
  const std::atomic<bool> never = false;
  std::map<std::string, int> n_supported;
  std::vector<double> answered_s;
  for (std::uint64_t study = 0; study < 2; ++study) {
    const std::string db = folder_ + "/own.db";
    const std::uint64_t seed = RandomStream(20261127, "study", study).bits() >> 1;
    simulate(
        {made.config.with_seed(seed), db, 2}, [](int) {}, never);
    AnalysisOptions options;
    options.databases = {db};
    const Summary summary = analyze(options);
    for (const Hypothesis& one : summary.hypotheses)
      if (one.applies()) n_supported[one.name] += one.verdict == HypothesisVerdict::supported;
    answered_s.push_back(
        *find_estimate(summary.estimates, "response_time", {{"task", "introduction"}})->value);
    fs::remove(db);
  }
  for (const HypothesisPower& one : power.sizes[0].hypotheses) {
    EXPECT_EQ(one.supported.n_hits, n_supported.at(one.name)) << one.name;
    EXPECT_EQ(one.supported.n_trials, 2);
    EXPECT_EQ(one.supported.n_hits + one.not_supported.n_hits + one.inconclusive.n_hits, 2);
  }
  EXPECT_EQ(power.sizes[0].hypotheses.size(), n_supported.size());
  const auto time = std::ranges::find_if(power.sizes[0].estimates, [](const auto& one) {
    return one.place.measure->name == "response_time" && one.place.task == "introduction";
  });
  ASSERT_NE(time, power.sizes[0].estimates.end());
  EXPECT_EQ(time->printed.n_trials, 2);
  EXPECT_DOUBLE_EQ(time->median_value, (answered_s[0] + answered_s[1]) / 2);
  EXPECT_DOUBLE_EQ(*time->sd, std::abs(answered_s[0] - answered_s[1]) / std::sqrt(2.0));
}

TEST_F(PowerTest, StopsBetweenSessions) {
  const std::atomic<bool> at_once = true;
  EXPECT_FALSE(power_of(
      request(2), [](double) {}, at_once));
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(PowerTest, AFolderThatIsMissingIsAnError) {
  PowerRequest lost = request(2);
  lost.folder = folder_ + "/missing";
  const std::atomic<bool> never = false;
  EXPECT_THROW(power_of(
                   lost, [](double) {}, never),
               Error);
}

}  // namespace
}  // namespace heft
