// How a session is run, apart from what it is run with.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <string>

namespace heft {

class Console;
class Engine;
class EventOutlet;

struct RunnerOptions {
  bool keep_frames = true;
  /// Called after every event, for a progress bar.
  std::function<void(const Engine&)> progress = [](const Engine&) {};
  /// Set from a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
  /// What is to be said where there is no console.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  Console* console = nullptr;  ///< the experimenter's; only on a wall clock
  /// Other recorders, informed of each event that is on disk; null: there are none.
  EventOutlet* events = nullptr;
  /// Where the session's number is put once it is in the log; null: nobody asks.
  std::int64_t* begun = nullptr;
  /// Go on although the check failed, where nobody can be asked.
  bool go_on_unchecked = false;
};

}  // namespace heft
