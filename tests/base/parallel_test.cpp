#include "base/Parallel.h"

#include <gmock/gmock.h>

#include <atomic>
#include <stdexcept>
#include <vector>

namespace heft {
namespace {

TEST(InParallel, DoesEachItemOnce) {
  for (const std::size_t n : {0u, 1u, 7u, 100u, 1001u})
    for (const std::size_t least : {1u, 8u, 5000u}) {
      std::vector<int> done(n);
      in_parallel(n, least, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) done[i] += 1;
      });
      EXPECT_THAT(done, testing::Each(1)) << n << " " << least;
    }
}

TEST(InParallel, ThrowsWhatOneThrew) {
  for (const std::size_t bad : {0u, 99u})
    EXPECT_THROW(in_parallel(100, 1,
                             [&](std::size_t first, std::size_t last) {
                               if (first <= bad && bad < last) throw std::out_of_range("one");
                             }),
                 std::out_of_range);
}

TEST(Jobs, AreEachDoneOnceOnAnyNumberOfThreads) {
  for (const int n_threads : {1, 2, 7}) {
    std::vector<std::atomic<int>> times(100);
    double last = -1;
    EXPECT_TRUE(run_jobs(
        100, n_threads,
        [&](int i) {
          ++times[static_cast<std::size_t>(i)];
          return true;
        },
        [&](double done) {
          EXPECT_GT(done, last);
          last = done;
        }));
    for (const auto& one : times) EXPECT_EQ(one, 1);
  }
}

TEST(Jobs, StopAndPassOnWhatIsThrown) {
  std::atomic<int> n = 0;
  EXPECT_FALSE(run_jobs(
      1000, 2, [&](int) { return ++n < 10; }, [](double) {}));
  EXPECT_LT(n, 13);
  const auto fails = [](int i) -> bool {
    if (i == 5) throw std::runtime_error("the sixth");
    return true;
  };
  EXPECT_THROW(run_jobs(1000, 3, fails, [](double) {}), std::runtime_error);
  EXPECT_TRUE(run_jobs(0, 2, fails, [](double) {}));
}

}  // namespace
}  // namespace heft
