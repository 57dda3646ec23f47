#include "cli/StopOnSignal.h"

#include <csignal>

namespace heft::cli {

namespace {
constexpr std::array stopping_signals{SIGINT, SIGTERM, SIGHUP};

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_stop(int) {
  stop_requested = true;
}
}  // namespace

StopOnSignal::StopOnSignal() {
  for (std::size_t i = 0; i < stopping_signals.size(); ++i) {
    before_[i] = std::signal(stopping_signals[i], request_stop);
    if (stopping_signals[i] == SIGHUP && before_[i] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  }
}

StopOnSignal::~StopOnSignal() {
  for (std::size_t i = 0; i < stopping_signals.size(); ++i)
    std::signal(stopping_signals[i], before_[i]);
}

const std::atomic<bool>& StopOnSignal::requested() const {
  return stop_requested;
}

}  // namespace heft::cli
