// How a session is run: callbacks, console and event outlet.
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
  /// Set by a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
  /// Prints messages where there is no console.
  std::function<void(const std::string&)> print = [](const std::string&) {};
  Console* console = nullptr;  ///< the experimenter's; only on a wall clock
  /// Other recorders, informed of each event once it is on disk; null: none.
  EventOutlet* events = nullptr;
  /// Set to the session's number once it is logged; null: not needed.
  std::int64_t* begun = nullptr;
  /// Continue after a failed check if there is no experimenter to ask.
  bool go_on_unchecked = false;
};

}  // namespace heft
