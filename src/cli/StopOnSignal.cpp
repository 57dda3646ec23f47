#include "cli/StopOnSignal.h"

#include <csignal>

namespace heft::cli {

namespace {
std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void request_stop(int) {
  stop_requested = true;
}
}  // namespace

StopOnSignal::StopOnSignal()
    : interrupt_(std::signal(SIGINT, request_stop)),
      terminate_(std::signal(SIGTERM, request_stop)) {}

StopOnSignal::~StopOnSignal() {
  std::signal(SIGINT, interrupt_);
  std::signal(SIGTERM, terminate_);
}

const std::atomic<bool>& StopOnSignal::requested() const {
  return stop_requested;
}

}  // namespace heft::cli
