// Counter-based random streams: the n-th draw of a stream is a pure function of its key (seed,
// purpose, trial number, attempt) and n, so a draw added in one place moves nothing elsewhere and a
// crashed trial can be run again with the same draws. Philox4x64-10 (Salmon et al., SC 2011) from
// Random123. Bounded, shuffled and normal draws are our own: those of std:: differ between
// libraries.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

namespace heft {

class RandomStream {
 public:
  /// @param purpose what the draws are for, e.g. "slots"; equal names give equal streams
  RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t trial_number = 0,
               std::uint64_t attempt = 0);

  std::uint64_t bits();
  /// Uniform in [0, 1), 53 bits.
  double uniform();
  /// Uniform in 0...bound-1 without modulo bias. bound > 0.
  std::uint64_t below(std::uint64_t bound);
  bool coin(double probability) { return uniform() < probability; }
  /// Standard normal (Box-Muller).
  double normal();

  /// Fisher-Yates: every order equally likely.
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
