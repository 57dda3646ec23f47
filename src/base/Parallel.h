// Work on many independent items, shared among threads.
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <thread>
#include <vector>

namespace heft {

inline int n_processors() {
  static const int n = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return n;
}

/// Whether this thread works for run_jobs(): the processors are busy with other jobs.
inline thread_local bool is_job = false;

/// Calls work(first, last) for consecutive ranges that make up 0...n, each in its own thread, and
/// waits for all. As many ranges as there are processors, or fewer of at least `at_least` items;
/// one range runs in the caller's thread, and all of them in a job's. What one throws is thrown
/// again.
template <typename Work>
void in_parallel(std::size_t n, std::size_t at_least, const Work& work) {
  const std::size_t n_threads = is_job ? 1 : static_cast<std::size_t>(n_processors());
  const std::size_t n_ranges = std::clamp<std::size_t>(n / at_least, 1, n_threads);
  std::vector<std::future<void>> others;  // these wait where they are destroyed
  for (std::size_t i = 1; i < n_ranges; ++i)
    others.push_back(std::async(
        std::launch::async,
        [&work, first = n * i / n_ranges, last = n * (i + 1) / n_ranges] { work(first, last); }));
  work(std::size_t{0}, n / n_ranges);
  for (std::future<void>& other : others) other.get();
}

/// Calls work(i) for i = 0...n-1 on that many threads, as they become free, until one returns
/// false: stopped. What one throws is thrown again when the others have ended.
/// @param progress called with the fraction done, from the calling thread
/// @return whether all were done
inline bool run_jobs(int n, int n_threads, const std::function<bool(int)>& work,
                     const std::function<void(double)>& progress) {
  std::mutex mutex;
  std::condition_variable changed;
  std::exception_ptr error;
  int next = 0, n_done = 0;
  bool stopped = false;
  const auto run = [&] {
    is_job = true;
    for (std::unique_lock lock(mutex); !error && !stopped && next < n;) {
      const int i = next++;
      lock.unlock();
      bool done = false;
      std::exception_ptr thrown;
      try {
        done = work(i);
      } catch (...) {
        thrown = std::current_exception();
      }
      lock.lock();
      if (thrown && !error) error = thrown;
      stopped = stopped || !done;
      n_done += done ? 1 : 0;
      changed.notify_all();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < n_threads; ++i) threads.emplace_back(run);
    std::unique_lock lock(mutex);  // released before the threads are waited for
    while (n_done < n && !stopped) {
      progress(static_cast<double>(n_done) / n);
      changed.wait(lock, [&, seen = n_done] { return n_done != seen || stopped; });
    }
  }
  if (error) std::rethrow_exception(error);
  return !stopped;
}

}  // namespace heft
