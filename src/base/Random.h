// Counter-based random streams (Philox4x64-10: Salmon et al., SC 2011; from Random123). Draw n of a
// stream is a pure function of its key (seed, purpose, trial number, attempt) and n. A new draw in
// one place therefore changes no draw elsewhere, and an interrupted trial repeats with equal draws.
// Distributions are written out here, because those of std:: differ between libraries.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace heft {

class RandomStream {
 public:
  /// @param purpose of the draws, e.g. "slots"; equal purposes give equal streams
  RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t trial_number = 0,
               std::uint64_t attempt = 0);

  std::uint64_t bits();
  /// Uniform in [0, 1), with 53 random bits.
  double uniform();
  /// Uniform in 0...bound-1, without modulo bias. bound > 0.
  std::uint64_t below(std::uint64_t bound);
  bool coin(double probability) { return uniform() < probability; }
  /// Standard normal (Box-Muller).
  double normal();

  /// Fisher-Yates shuffle: all orders are equally likely.
  template <typename T>
  void shuffle(std::span<T> items) {
    for (std::size_t i = items.size(); i > 1; --i) {
      using std::swap;
      swap(items[i - 1], items[below(i)]);
    }
  }

 private:
  std::array<std::uint64_t, 2> key_;
  std::array<std::uint64_t, 4> counter_;
  std::array<std::uint64_t, 4> block_{};
  std::size_t used_ = 4;
};

}  // namespace heft
