// A session that a model ran in memory, stored in a log and read back.
#pragma once

#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "SourceFolder.h"
#include "record/writer/SessionLog.h"
#include "session/Session.h"

namespace heft::testing {

class StoredSession {
 public:
  /// @param stop_after completed trials, after which the next one becomes void; none: to the end
  StoredSession(const Protocol& protocol, const std::string& responder, std::uint64_t seed,
                bool keep_frames = true, std::optional<int> stop_after = {})
      : path_(std::filesystem::temp_directory_path() /
              ("heft-stored-" + std::to_string(::getpid()) + ".db")) {
    remove();
    SessionOptions model;
    model.responder = Plug{responder};
    const SessionRequest request{resolve(model, protocol, seed), "1"};
    RunnerOptions runner;
    runner.keep_frames = keep_frames;
    std::atomic<bool> stop = false;
    runner.stop = &stop;
    runner.progress = [&](const Engine& engine) {
      if (stop_after && engine.n_completed() >= *stop_after && engine.trial_is_open()) stop = true;
    };
    const std::int64_t id = SessionArchive(path_.string()).store(compute_session(request, runner));
    reader_.emplace(path_.string());
    session_ = load_session(*reader_, path_.string(), id);
  }
  ~StoredSession() { remove(); }

  const LogReader& reader() const { return *reader_; }
  const LoggedSession& session() const { return session_; }
  std::int64_t id() const { return session_.row.session_id; }
  int n_completed() const {
    int n = 0;
    for (const TrialRow& row : reader().trials(id())) n += row.status == TrialStatus::completed;
    return n;
  }

 private:
  void remove() {
    for (const char* end : {"", "-wal", "-shm", "-lock"})
      std::filesystem::remove(path_.string() + end);
  }

  std::filesystem::path path_;
  std::optional<LogReader> reader_;
  LoggedSession session_;
};

inline Protocol shipped_protocol(const std::string& name) {
  return load_protocol(source_folder() + "/protocols/" + name + ".toml");
}

}  // namespace heft::testing
