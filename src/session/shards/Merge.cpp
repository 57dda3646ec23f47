// Joins shards: merge_shards() of Shards.h.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "apparatus/LoggedSession.h"
#include "base/Error.h"
#include "base/Names.h"
#include "engine/Engine.h"
#include "record/writer/SessionLog.h"
#include "replay/Replay.h"
#include "session/Session.h"
#include "session/shards/Shards.h"

namespace heft {

namespace {

[[noreturn]] void refuse(const std::string& why, const std::string& advice) {
  throw Error(fmt::format("nothing was merged: {}. {}.", why, advice), ExitCode::usage);
}

// Where a participant's session is.
struct Place {
  std::size_t shard = 0;
  std::int64_t session_id = 0;
};

// A thousand shards are three thousand open files.
void allow_many_open_files() {
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  setrlimit(RLIMIT_NOFILE, &limit);
}

// The logs of one simulation's shards, with every participant once.
class ShardLogs {
 public:
  explicit ShardLogs(const std::vector<std::string>& files) : files_(files) {
    for (std::size_t i = 0; i < files.size(); ++i) add(i);
    if (places_.empty())
      refuse("the shards have no participants", "Run heft simulate --shard I/N first");
    refuse_missing();
  }

  int n_participants() const { return *key_->config.simulation_participants; }
  const SimulationKey& key() const { return *key_; }

  // @throws Error (diverged) if rows differ from what was written
  void verify(const std::function<void(double)>& progress) const {
    for (std::size_t i = 0; i < files_.size(); ++i) {
      const auto fault = fault_of_log(readers_[i], files_[i], {}, [&](double done) {
        progress((static_cast<double>(i) + done) / static_cast<double>(files_.size()));
      });
      if (fault)
        throw Error(fmt::format("nothing was merged: {} was changed or damaged: {}. Remove it and "
                                "simulate that shard again.",
                                files_[i], *fault),
                    ExitCode::diverged);
    }
  }

  RecordedSession session(int number);

 private:
  void add(std::size_t shard);
  void add_session(Place place, const SessionHeader& header);
  void refuse_missing() const;
  std::set<int> strides() const;

  const std::vector<std::string>& files_;
  std::vector<LogReader> readers_;
  std::optional<SimulationKey> key_;
  std::string first_;  ///< the file that the key is of
  std::optional<bool> has_frames_;
  std::map<int, Place> places_;
  std::shared_ptr<const SessionPlan> plan_;
};

void ShardLogs::add(std::size_t shard) {
  const std::string& file = files_[shard];
  refuse_special_file(file);
  const LogReader& log = readers_.emplace_back(file);
  for (const std::int64_t session_id : log.session_ids())
    add_session({shard, session_id}, log.session(session_id).header);
  for (const Seal& seal : log.seals()) {
    const bool has_frames = seal.n_frames > 0;
    if (has_frames_.value_or(has_frames) != has_frames)
      refuse(fmt::format("session {} of {} {} frames, others {}", seal.session_id, file,
                         has_frames ? "has" : "has no", has_frames ? "have none" : "have some"),
             "Simulate all shards with --frames, or none");
    has_frames_ = has_frames;
  }
}

void ShardLogs::add_session(Place place, const SessionHeader& header) {
  const std::string& file = files_[place.shard];
  const std::string what =
      fmt::format("session {} of {} ({})", place.session_id, file, header.participant);
  const int number = number_in_id(header.participant);
  SimulationKey key;
  try {
    key = simulation_key(header);
  } catch (const Error& error) {
    refuse(fmt::format("{}: {}", what, error.what()), "Merge logs of heft simulate --shard I/N");
  }
  if (!key_) {
    key_ = key;
    first_ = file;
  }
  if (const std::string other = difference(key, *key_); !other.empty())
    refuse(fmt::format("{} has {} as in {}", what, other, first_),
           "Simulate all shards with the same options");
  if (number < 1 || number > n_participants() ||
      header.seed != session_seed(*key_->config.simulation_seed, number))
    refuse(fmt::format("{} is no participant of {}", what, n_participants()),
           "Simulate that shard again, into a new file");
  const auto [earlier, is_new] = places_.emplace(number, place);
  if (!is_new)
    refuse(fmt::format("{} is also in {}", what, files_[earlier->second.shard]),
           "Give each shard once, and simulate all of them with the same N in --shard I/N");
}

// Distances between a log's participants: N of a shard I/N.
std::set<int> ShardLogs::strides() const {
  std::map<std::size_t, int> last;
  std::set<int> strides;
  for (const auto& [number, place] : places_) {
    if (const auto before = last.find(place.shard); before != last.end())
      strides.insert(number - before->second);
    last[place.shard] = number;
  }
  return strides;
}

void ShardLogs::refuse_missing() const {
  const int n_missing = n_participants() - static_cast<int>(places_.size());
  if (n_missing == 0) return;
  int first = 1;
  while (places_.contains(first)) ++first;
  std::string why = fmt::format("{} of {} is missing", simulated_participant(first),
                                counted(n_participants(), "participant"));
  if (n_missing > 1) why += fmt::format(", and {} more", n_missing - 1);
  const auto found = strides();
  if (found.size() > 1)
    refuse(why + fmt::format("; the shards have different N ({})", fmt::join(found, ", ")),
           "Simulate all shards with the same N in --shard I/N");
  const std::string shard =
      found.empty() ? "the shard with that participant"
                    : fmt::format("shard {}/{}", (first - 1) % *found.begin() + 1, *found.begin());
  refuse(why, fmt::format("Run {} again with its own command, which continues it, and name all "
                          "shards",
                          shard));
}

// In the order in which they were displayed.
std::vector<FrameRow> frames_of(const LogReader& log, std::int64_t session_id, int n_attempts) {
  std::vector<FrameRow> frames;
  for (int attempt = 0; attempt <= n_attempts; ++attempt)
    std::ranges::move(log.frames(session_id, attempt), std::back_inserter(frames));
  std::ranges::stable_sort(frames, {}, &FrameRow::after_event);
  return frames;
}

// The session as its shard recorded it.
RecordedSession ShardLogs::session(int number) {
  const auto [shard, session_id] = places_.at(number);
  const LogReader& log = readers_[shard];
  const SessionHeader header = log.session(session_id).header;
  if (!plan_) plan_ = load_session(log, files_[shard], session_id).protocol;
  RecordedSession recorded(header);
  Engine engine(plan_, header.seed);
  const auto events = log.events(session_id);
  const auto last = std::ranges::max_element(events, {}, &LoggedEvent::attempt_index);
  const auto frames = frames_of(log, session_id, last->attempt_index);
  auto frame = frames.begin();
  const auto add_frames = [&](int n_events) {
    for (; frame != frames.end() && frame->after_event <= n_events; ++frame)
      recorded.add_frame(*frame);
  };
  for (int n = 0; const LoggedEvent& logged : events) {
    add_frames(n++);
    recorded.append(logged.event, engine.apply(logged.event), Durability::buffered);
  }
  add_frames(static_cast<int>(events.size()));
  return recorded;
}

}  // namespace

MergeResult merge_shards(const MergeRequest& request,
                         const std::function<void(const char*, double)>& progress,
                         const std::atomic<bool>& stop) {
  allow_many_open_files();
  refuse_special_file(request.db);
  for (const std::string& shard : request.shards)
    if (std::error_code missing; std::filesystem::equivalent(request.db, shard, missing))
      refuse(request.db + " is the merged log and a shard", "Name the merged log first");
  ShardLogs shards(request.shards);
  shards.verify([&](double done) {
    if (stop) throw Error("stopped; nothing was merged", ExitCode::interrupted);
    progress("verifying", done);
  });
  SessionArchive archive(request.db);
  const int n = shards.n_participants();
  MergeResult result;
  result.n_expected = n;
  result.n_participants = n_stored(LogReader(request.db), request.db, shards.key(), {1, 1, n});
  while (result.n_participants < n && !stop) {
    archive.store(shards.session(++result.n_participants));
    ++result.n_new;
    progress("merging", static_cast<double>(result.n_participants) / n);
  }
  result.head = LogReader(request.db).head();
  return result;
}

}  // namespace heft
