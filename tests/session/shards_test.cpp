// Simulations in shards, stopped and continued at random, and merged: the log has every row of that
// of one run. HEFT_SEED repeats a failure.
#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>

#include "SourceFolder.h"
#include "base/Random.h"
#include "base/files/TextFile.h"
#include "protocol/readers/Files.h"
#include "record/temporary_folder.h"
#include "replay/Replay.h"
#include "session/Simulation.h"

namespace heft {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ShardNumbers, AreEveryParticipantOnce) {
  for (const int participants : {1, 2, 7, 12})
    for (int of = 1; of <= participants + 2; ++of) {
      std::map<int, int> times;
      for (int number = 1; number <= of; ++number) {
        const ParticipantNumbers numbers = numbers_of({number, of}, participants);
        for (int place = 0; place < numbers.count; ++place) ++times[numbers.at(place)];
      }
      EXPECT_EQ(static_cast<int>(times.size()), participants);
      EXPECT_EQ(times.begin()->first, 1);
      EXPECT_EQ(times.rbegin()->first, participants);
      for (const auto& [n, count] : times) EXPECT_EQ(count, 1) << n;
    }
}

// All rows of all tables. The files may differ in how pages are laid out.
std::string rows_of(const std::string& db) {
  SQLite::Database database(db);
  std::string text;
  SQLite::Statement tables(database,
                           "SELECT name FROM sqlite_master WHERE type = 'table' "
                           "AND name NOT LIKE 'sqlite_%' ORDER BY name");
  while (tables.executeStep()) {
    const std::string name = tables.getColumn(0).getString();
    text += "table " + name + "\n";
    SQLite::Statement rows(database, "SELECT * FROM \"" + name + "\"");
    while (rows.executeStep()) {
      for (int i = 0; i < rows.getColumnCount(); ++i)
        text += rows.getColumn(i).isNull() ? "NULL|" : rows.getColumn(i).getString() + "|";
      text += "\n";
    }
  }
  return text;
}

class ShardedSimulation : public ::testing::Test {
 protected:
  std::string file(const std::string& name) const { return folder_.file(name); }

  SimulationRequest request(const std::string& db, int participants) const {
    SessionOptions given;
    given.responder = Plug{responder_};
    const Protocol protocol = load_protocol(source_folder() + "/protocols/quick.toml");
    SimulationRequest made{resolve(given, protocol, seed_), file(db), participants};
    made.keep_frames = keep_frames_;
    return made;
  }

  // @param at_most participants, then it is stopped  @return stored participants
  static int run(const SimulationRequest& request, int at_most = 1000) {
    std::atomic<bool> stop = false;
    return simulate(
        request, [&](int n) { stop = n >= at_most; }, stop);
  }
  int run_shard(const std::string& db, Shard shard, int participants, int at_most = 1000,
                int jobs = 1) const {
    SimulationRequest part = request(db, participants);
    part.shard = shard;
    part.jobs = jobs;
    return run(part, at_most);
  }

  MergeResult merge(const std::vector<std::string>& shards, int at_most = 1000) const {
    MergeRequest request{file("merged.db"), {}};
    for (const std::string& shard : shards) request.shards.push_back(file(shard));
    std::atomic<bool> stop = false;
    int n = 0;
    return merge_shards(
        request, [&](std::string_view what, double) { stop = what == "merging" && ++n >= at_most; },
        stop);
  }
  std::string refusal(const std::vector<std::string>& shards) const {
    std::string why = test::failure([&] { merge(shards); });
    EXPECT_FALSE(std::filesystem::exists(file("merged.db")));
    return why;
  }

  void expect_the_log_of_one_run(int participants) const {
    run(request("one.db", participants));
    EXPECT_EQ(LogReader(file("merged.db")).head(), LogReader(file("one.db")).head());
    // EXPECT_EQ would print the tables.
    EXPECT_TRUE(rows_of(file("merged.db")) == rows_of(file("one.db")));
    require_verified(file("merged.db"), {}, [](double) {});
  }

  test::TemporaryFolder folder_;
  std::string responder_ = "simulated";
  std::uint64_t seed_ = 9;
  bool keep_frames_ = false;
};

std::uint64_t fresh_or_given_seed() {
  const char* given = std::getenv("HEFT_SEED");
  return given ? std::strtoull(given, nullptr, 10) : std::random_device{}();
}

class RandomShards : public ShardedSimulation, public ::testing::WithParamInterface<int> {};

TEST_P(RandomShards, StoppedAndRequeuedGiveTheLogOfOneRun) {
  const std::uint64_t seed = fresh_or_given_seed();
  SCOPED_TRACE(fmt::format("HEFT_SEED={}", seed));
  RandomStream random(seed, "shards", static_cast<std::uint64_t>(GetParam()));
  const auto drawn = [&](int least, int most) {
    return least + static_cast<int>(random.below(static_cast<std::uint64_t>(most - least + 1)));
  };
  seed_ = random.bits() >> 1;
  responder_ = drawn(0, 1) == 0 ? "simulated" : "coin";
  keep_frames_ = drawn(0, 3) == 0;
  const int participants = drawn(1, 6), n = drawn(1, participants + 2);
  std::vector<std::string> shards;
  for (int number = 1; number <= n; ++number) {
    const Shard shard{number, n};
    shards.push_back(fmt::format("{}.db", number));
    int stored = 0;
    for (int runs = 0; runs < drawn(0, 3); ++runs)
      stored += run_shard(shards.back(), shard, participants, drawn(1, 2), drawn(1, 3));
    stored += run_shard(shards.back(), shard, participants, 1000, drawn(1, 3));
    EXPECT_EQ(stored, numbers_of(shard, participants).count);
    EXPECT_EQ(run_shard(shards.back(), shard, participants), 0);
  }
  for (std::size_t i = shards.size(); i > 1; --i) std::swap(shards[i - 1], shards[random.below(i)]);
  const int first = drawn(1, participants);
  EXPECT_EQ(merge(shards, first).n_participants, first);
  const MergeResult rest = merge(shards);
  EXPECT_EQ(rest.n_participants, participants);
  EXPECT_EQ(rest.n_new, participants - first);
  expect_the_log_of_one_run(participants);
  EXPECT_EQ(merge(shards).n_new, 0);
}
INSTANTIATE_TEST_SUITE_P(Shards, RandomShards, ::testing::Range(0, 4));

TEST_F(ShardedSimulation, WithFramesGivesTheRowsOfOneRun) {
  keep_frames_ = true;
  for (const int number : {1, 2}) run_shard(fmt::format("{}.db", number), {number, 2}, 3);
  merge({"2.db", "1.db"});
  expect_the_log_of_one_run(3);
}

TEST_F(ShardedSimulation, WithoutAParticipantIsRefused) {
  for (const int number : {1, 2, 3}) run_shard(fmt::format("{}.db", number), {number, 3}, 5, 2);
  EXPECT_THAT(refusal({"1.db", "3.db"}),
              AllOf(HasSubstr("sim-0002 of 5 participants is missing, and 1 more"),
                    HasSubstr("Run shard 2/3 again")));
  run_shard("cut.db", {2, 3}, 5, 1);
  EXPECT_THAT(
      refusal({"1.db", "cut.db", "3.db"}),
      AllOf(HasSubstr("sim-0005 of 5 participants is missing."), HasSubstr("Run shard 2/3 again")));
  // Only the number of participants shows that the last shards are missing.
  run_shard("first.db", {1, 2}, 2);
  EXPECT_THAT(refusal({"first.db"}), HasSubstr("sim-0002 of 2 participants is missing"));
}

TEST_F(ShardedSimulation, OfAnotherSimulationIsRefused) {
  run_shard("1.db", {1, 2}, 4);
  run_shard("2.db", {2, 2}, 4);
  run_shard("larger.db", {2, 2}, 5);
  EXPECT_THAT(refusal({"1.db", "larger.db"}), HasSubstr("--participants 5, not 4"));
  EXPECT_THAT(refusal({"1.db", "2.db", "1.db"}), HasSubstr("Give each shard once"));
  run_shard("half.db", {1, 2}, 6);
  run_shard("quarter.db", {2, 4}, 6);
  EXPECT_THAT(refusal({"half.db", "quarter.db"}),
              AllOf(HasSubstr("sim-0004"), HasSubstr("different N (2, 4)")));
  seed_ = 10;
  run_shard("seed.db", {2, 2}, 4);
  EXPECT_THAT(refusal({"1.db", "seed.db"}), HasSubstr("--seed 10, not 9"));
  seed_ = 9;
  responder_ = "coin";
  run_shard("coin.db", {2, 2}, 4);
  EXPECT_THAT(refusal({"1.db", "coin.db"}), HasSubstr("responder \"coin\", not \"simulated\""));
  responder_ = "simulated";
  keep_frames_ = true;
  run_shard("frames.db", {2, 2}, 4);
  EXPECT_THAT(refusal({"1.db", "frames.db"}), HasSubstr("has frames"));
}

TEST_F(ShardedSimulation, ThatWasChangedIsRefused) {
  run_shard("1.db", {1, 2}, 2);
  run_shard("2.db", {2, 2}, 2);
  {
    SQLite::Database database(file("2.db"), SQLite::OPEN_READWRITE);
    database.exec("UPDATE trial SET level_g = level_g + 1 WHERE level_g IS NOT NULL");
    database.exec("UPDATE answer SET t_s = t_s + 1");
  }
  EXPECT_THAT(refusal({"1.db", "2.db"}), AllOf(HasSubstr("2.db was changed or damaged"),
                                               HasSubstr("simulate that shard again")));
}

TEST_F(ShardedSimulation, ContinuesNoOtherLog) {
  run_shard("1.db", {1, 2}, 4);
  const auto why_not = [&](Shard shard, int participants) {
    return test::failure([&] { run_shard("1.db", shard, participants); });
  };
  EXPECT_THAT(why_not({2, 2}, 4), HasSubstr("session 1 is of sim-0001, expected sim-0002"));
  EXPECT_THAT(why_not({1, 3}, 4), HasSubstr("session 2 is of sim-0003, expected sim-0004"));
  EXPECT_THAT(why_not({1, 2}, 3), HasSubstr("--participants 4, not 3"));
  run(request("1.db", 2));  // as one run continues any log
  EXPECT_THAT(why_not({1, 2}, 4), HasSubstr("session 3 is of sim-0004"));
  EXPECT_EQ(LogReader(file("1.db")).session_ids().size(), 4u);
}

TEST_F(ShardedSimulation, IsNotMergedIntoOtherSessionsNorIntoAShard) {
  run_shard("1.db", {1, 1}, 1);
  seed_ = 10;
  run(request("merged.db", 1));
  EXPECT_THAT(test::failure([&] { merge({"1.db"}); }), HasSubstr("Choose another file"));
  EXPECT_THAT(test::failure([&] { merge({"merged.db"}); }), HasSubstr("Name the merged log first"));
}

}  // namespace
}  // namespace heft
