#include "session/Simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <thread>

#include "base/Error.h"
#include "base/Random.h"
#include "record/reader/LogReader.h"
#include "record/writer/SessionLog.h"

namespace heft {

namespace {

// Distributes session numbers to workers and returns their results in order. Workers that are far
// ahead wait, so that memory stays constant.
class InOrder {
 public:
  InOrder(int n, int ahead) : n_(n), ahead_(ahead) {}

  // Next number to compute; 0: none left.
  int take() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || taken_ < given_ + ahead_; });
    return closed_ || taken_ == n_ ? 0 : ++taken_;
  }

  void put(int number, RecordedSession session) {
    const std::lock_guard lock(mutex_);
    done_.emplace(number, std::move(session));
    changed_.notify_all();
  }

  void fail(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = error;
    changed_.notify_all();
  }

  RecordedSession give(int number) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return done_.contains(number) || error_; });
    if (!done_.contains(number)) std::rethrow_exception(error_);
    auto session = std::move(done_.extract(number).mapped());
    given_ = number;
    changed_.notify_all();
    return session;
  }

  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::map<int, RecordedSession> done_;
  std::exception_ptr error_;
  int n_, ahead_, taken_ = 0, given_ = 0;
  bool closed_ = false;
};

SessionRequest session_of(const SimulationRequest& request, int number) {
  RandomStream stream(request.config->seed, "participant", static_cast<std::uint64_t>(number));
  return {request.config.with_seed(stream.bits() >> 1), simulated_participant(number), request.db};
}

// The number in a simulated participant's id; 0 for other ids.
int number_in_id(const std::string& participant) {
  const auto digits = participant.find_first_of("0123456789");
  int n = 0;
  if (digits != std::string::npos)
    std::from_chars(participant.data() + digits, participant.data() + participant.size(), n);
  return n > 0 && participant == simulated_participant(n) ? n : 0;
}

// Requires the file's lock, so that no other program takes the number.
int first_free_number(const SimulationRequest& request) {
  int highest = 0;
  for (const SessionRow& session : LogReader(request.db).sessions())
    if (session.header.protocol_name == request.config->protocol->name)
      highest = std::max(highest, number_in_id(session.header.participant));
  if (highest > std::numeric_limits<int>::max() - request.participants)
    throw Error(fmt::format("{} already holds participant {}; choose another file with --db FILE",
                            request.db, simulated_participant(highest)));
  return highest + 1;
}

}  // namespace

std::string simulated_participant(int n) {
  return fmt::format("sim-{:04}", n);
}

int simulate(const SimulationRequest& request, const std::function<void(int)>& progress,
             const std::atomic<bool>& stop) {
  refuse_special_file(request.db);
  SessionArchive archive(request.db);  // reports a bad file before hours of work
  const int first = first_free_number(request);
  request.numbered(first);
  InOrder sessions(request.participants, 2 * request.jobs);
  RunnerOptions runner;
  runner.keep_frames = request.keep_frames;
  runner.stop = &stop;
  const auto work = [&] {
    try {
      for (int number = sessions.take(); number != 0; number = sessions.take())
        sessions.put(number, compute_session(session_of(request, first - 1 + number), runner));
    } catch (...) {
      sessions.fail(std::current_exception());
    }
  };
  std::vector<std::jthread> workers;
  // Workers must not wait if this thread leaves early.
  struct CloseAtEnd {
    InOrder& sessions;
    ~CloseAtEnd() { sessions.close(); }
  };
  const CloseAtEnd close_at_end{sessions};
  for (int i = 0; i < request.jobs; ++i) workers.emplace_back(work);
  int stored = 0;
  while (stored < request.participants && !stop) {
    const RecordedSession session = sessions.give(stored + 1);
    if (stop) break;  // may be incomplete
    archive.store(session);
    progress(++stored);
  }
  return stored;
}

}  // namespace heft
