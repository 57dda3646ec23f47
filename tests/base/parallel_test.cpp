#include "base/Parallel.h"

#include <gmock/gmock.h>

#include <stdexcept>

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

}  // namespace
}  // namespace heft
