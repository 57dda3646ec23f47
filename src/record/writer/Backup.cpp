#include "record/writer/Backup.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "base/Clock.h"
#include "base/Error.h"
#include "base/files/TextFile.h"
#include "record/file/Failures.h"
#include "record/file/LogFile.h"
#include "record/reader/LogReader.h"

namespace heft {

namespace fs = std::filesystem;

namespace {
[[noreturn]] void fail(const std::string& path, const std::string& why) {
  throw Error(fmt::format("cannot make the backup {}: {}", path, why));
}

std::string system_reason() {
  return std::strerror(errno);
}

// Creates the folder, accessible by its owner only.
void make_backup_folder(const fs::path& folder) {
  std::error_code error;
  if (!fs::create_directories(folder, error)) {
    if (error) fail(folder.string(), error.message());
    return;
  }
  fs::permissions(folder, fs::perms::owner_all, error);  // ignored on disks without permissions
}

// "P07_session7_": how the names of a session's copies begin. Special characters become "_".
std::string backup_stem(const std::string& participant, std::int64_t session_id) {
  constexpr std::size_t longest = 60;
  std::string who;
  for (const char c : participant.substr(0, longest))
    who += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' ? c : '_';
  return fmt::format("{}_session{}_", who, session_id);
}

// Removes copies of a session that were cut off.
void remove_cut_off(const fs::path& folder, const std::string& stem) {
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(stem) && (name.ends_with(".part") || name.ends_with(".part-journal")))
      fs::remove(entry.path());
  }
}

// Creates NAME.db.part for the first free name. @return the path of NAME.db
std::string make_part(const fs::path& folder, const std::string& name) {
  for (int i = 1;; ++i) {
    const std::string free = i == 1 ? name : fmt::format("{}-{}", name, i);
    const std::string path = (folder / (free + ".db")).string();
    if (!fs::exists(fs::symlink_status(path)) && create_file(path + ".part", 0600)) return path;
  }
}

void copy_into(const std::string& db, const std::string& part) {
  const auto source = open_for_reading(db);
  source->exec("PRAGMA query_only = OFF");  // it also forbids VACUUM INTO
  SQLite::Statement vacuum(*source, "VACUUM INTO ?");
  vacuum.bind(1, part);
  vacuum.exec();
}

void sync(const std::string& path) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) fail(path, system_reason());
  const bool is_saved = fsync(file) == 0;
  const int reason = errno;
  close(file);
  errno = reason;
  if (!is_saved && errno != EINVAL) fail(path, system_reason());  // EINVAL: not supported here
}

void check_copy(const std::string& part, std::int64_t session_id) {
  if (const auto faults = check_integrity(part); !faults.empty())
    fail(part, "the copy is damaged: " + faults.front());
  if (const auto broken = LogReader(part).first_broken_digest(session_id))
    fail(part, fmt::format("in the copy {} differs from what was written", broken->row));
}

// Renames without replacing a file. FAT disks cannot do this atomically.
void give_name(const std::string& part, const std::string& path) {
  if (renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, path.c_str(), RENAME_NOREPLACE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS) fail(path, system_reason());
  if (fs::exists(fs::symlink_status(path))) fail(path, "a file of that name exists");
  if (std::rename(part.c_str(), path.c_str()) != 0) fail(path, system_reason());
}

// Removes an incomplete copy.
class Part {
 public:
  explicit Part(std::string path) : path_(std::move(path)) {}
  ~Part() {
    if (path_.empty()) return;
    std::error_code ignored;
    fs::remove(path_, ignored);
    fs::remove(path_ + "-journal", ignored);
  }
  Part(const Part&) = delete;
  void keep() { path_.clear(); }

 private:
  std::string path_;
};
}  // namespace

std::string backup_name(const std::string& participant, std::int64_t session_id,
                        const std::string& utc, const std::string& head) {
  std::string when;
  for (const char c : utc.substr(0, utc.find('.')))
    if (c != '-' && c != ':' && c != 'Z') when += c;
  return fmt::format("{}{}Z{}{}", backup_stem(participant, session_id), when,
                     head.empty() ? "" : "_", short_head(head));
}

void require_backup_folder(const std::string& folder) try {
  make_backup_folder(folder);
  const std::string path = make_part(folder, "write-test") + ".part";
  const Part part(path);
  std::ofstream file(path);
  file << "heft\n" << std::flush;
  if (!file) fail(folder, "the folder is not writable: " + system_reason());
  sync(path);
} catch (const fs::filesystem_error& error) {
  fail(folder, error.code().message());
}

std::string back_up(const std::string& db, const std::string& folder, std::int64_t session_id) try {
  make_backup_folder(folder);
  const LogReader log(db);
  const std::string who = log.session(session_id).header.participant;
  const std::string name = backup_name(who, session_id, utc_now(), log.head());
  remove_cut_off(folder, backup_stem(who, session_id));
  const std::string path = make_part(folder, name);
  const std::string made = path + ".part";
  Part part(made);
  copy_into(db, made);
  sync(made);
  check_copy(made, session_id);
  give_name(made, path);
  part.keep();
  sync(folder);
  return path;
} catch (const SQLite::Exception& error) {
  const SqliteFailure failure = explained(error, nullptr);
  fail(folder, fmt::format("{}. {}", failure.reason, failure.advice));
} catch (const fs::filesystem_error& error) {
  fail(folder, error.code().message());
}

}  // namespace heft
