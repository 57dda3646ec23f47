#include "session/Simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <exception>
#include <limits>
#include <map>
#include <mutex>
#include <thread>

#include "base/Error.h"
#include "record/reader/LogReader.h"
#include "record/writer/SessionLog.h"

namespace heft {

namespace {

// Distributes sessions, numbered from 1, to workers and returns their results in order. Workers
// that are far ahead wait, so that memory stays constant.
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

// Simulated sessions have no date, so that equal simulations give equal logs.
constexpr auto no_date = "1970-01-01T00:00:00.000Z";

// @param simulation its configuration
SessionRequest session_of(const ResolvedConfig& simulation, int number) {
  SessionRequest session{simulation.with_seed(session_seed(simulation->seed, number)),
                         simulated_participant(number)};
  session.started_utc = no_date;
  return session;
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

// Participants of one call, and how many of them the log already has.
struct Plan {
  ResolvedConfig simulation;
  ParticipantNumbers numbers;
  int n_there = 0;
};

Plan plan_of(const SimulationRequest& request) {
  if (!request.shard) {
    const int first = first_free_number(request);
    return {request.config.of_simulation(first - 1 + request.participants),
            {first, 1, request.participants},
            first - 1};
  }
  const ResolvedConfig simulation = request.config.of_simulation(request.participants);
  const ParticipantNumbers all = numbers_of(*request.shard, request.participants);
  const SimulationKey key = simulation_key(header_of(session_of(simulation, all.first)));
  const int n = n_stored(LogReader(request.db), request.db, key, all);
  return {simulation, all.after(n), n};
}

}  // namespace

int simulate(const SimulationRequest& request, const std::function<void(int)>& progress,
             const std::atomic<bool>& stop) {
  refuse_special_file(request.db);
  SessionArchive archive(request.db);  // reports a bad file before hours of work
  const Plan plan = plan_of(request);
  request.begins(plan.numbers, plan.n_there);
  InOrder sessions(plan.numbers.count, 2 * request.jobs);
  RunnerOptions runner;
  runner.keep_frames = request.keep_frames;
  runner.stop = &stop;
  const auto work = [&] {
    try {
      for (int n = sessions.take(); n != 0; n = sessions.take())
        sessions.put(n,
                     compute_session(session_of(plan.simulation, plan.numbers.at(n - 1)), runner));
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
  while (stored < plan.numbers.count && !stop) {
    const RecordedSession session = sessions.give(stored + 1);
    if (stop) break;  // may be incomplete
    archive.store(session);
    progress(++stored);
  }
  return stored;
}

}  // namespace heft
