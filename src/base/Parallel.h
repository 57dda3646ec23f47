// Work on many independent items, shared among the processors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <future>
#include <thread>
#include <vector>

namespace heft {

/// Calls work(first, last) for consecutive ranges that make up 0...n, each in its own thread, and
/// waits for all. As many ranges as there are processors, or fewer of at least `least` items; one
/// range runs in the caller's thread. What one throws is thrown again.
template <typename Work>
void in_parallel(std::size_t n, std::size_t least, const Work& work) {
  const std::size_t n_processors = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t n_ranges = std::clamp<std::size_t>(n / least, 1, n_processors);
  std::vector<std::future<void>> others;  // these wait where they are destroyed
  for (std::size_t i = 1; i < n_ranges; ++i)
    others.push_back(std::async(
        std::launch::async,
        [&work, first = n * i / n_ranges, last = n * (i + 1) / n_ranges] { work(first, last); }));
  work(std::size_t{0}, n / n_ranges);
  for (std::future<void>& other : others) other.get();
}

}  // namespace heft
