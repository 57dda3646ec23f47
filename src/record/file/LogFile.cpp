#include "record/file/LogFile.h"

#include <SQLiteCpp/Backup.h>
#include <SQLiteCpp/SQLiteCpp.h>
#include <fmt/format.h>
#include <sqlite3.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/Error.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "record/file/Failures.h"
#include "record/schema/Schema.h"

namespace heft {

namespace {
[[noreturn]] void refuse_newer_log(const std::string& path) {
  throw Error(fmt::format(
      "{} was written by a newer heft than this one ({}). Update heft, or choose another file with "
      "--db FILE.",
      path, HEFT_VERSION));
}

[[noreturn]] void refuse_outdated_log(const std::string& path, int version) {
  throw Error(
      fmt::format("{} is a log of version {}; heft {} reads versions {} to {}. Use the version of "
                  "heft that wrote it, or choose another file with --db FILE.",
                  path, version, HEFT_VERSION, oldest_log_version, current_log_version));
}

std::unique_ptr<SQLite::Database> opened(const std::string& path, const std::string& file) {
  try {
    auto database =
        std::make_unique<SQLite::Database>(file, SQLite::OPEN_READWRITE, lock_timeout_ms);
    distrust(*database);
    return database;
  } catch (const SQLite::Exception& error) {
    throw sqlite_error(fmt::format("cannot open {} for writing", path), error, nullptr);
  }
}

bool are_alike(const std::string& file, const std::string& other) {
  using Bytes = std::istreambuf_iterator<char>;
  std::ifstream one(file, std::ios::binary), two(other, std::ios::binary);
  return std::equal(Bytes(one), Bytes(), Bytes(two), Bytes());
}

std::uint64_t inode_of(const std::string& file) {
  struct stat there {};
  return ::stat(file.c_str(), &there) == 0 ? there.st_ino : 0;
}
}  // namespace

LogFile::LogFile(const std::string& path)
    : path_(path),
      lock_(path, resolved_path(path)),
      file_(resolved_path(path)),
      database_(opened(path, file_)) {
  try {
    refuse_if_displaced();
    holds_log(*database_, path_);
    prepare();
    if (schema::kind_of(*database_) == schema::FileKind::older_log) upgrade();
  } catch (const SQLite::Exception& error) {
    refuse_if_displaced();
    if (error.getErrorCode() == SQLITE_NOTADB) refuse_foreign_file(path_);
    throw sqlite_error(fmt::format("cannot write to {}", path_), error, database_.get());
  }
}

LogFile::LogFile(LogFile&&) noexcept = default;
LogFile::~LogFile() = default;

void LogFile::refuse_if_displaced() const {
  const std::string why = displacement();
  if (why.empty()) return;
  throw Error(
      fmt::format("cannot write to {}: it {}. Restore its name, or choose another file with --db "
                  "FILE.",
                  path_, why));
}

void LogFile::prepare() {
  const std::string mode = database_->execAndGet("PRAGMA journal_mode = WAL").getString();
  if (mode != "wal")
    throw Error(fmt::format(
        "cannot write to {}: this disk does not support a write-ahead log (SQLite uses \"{}\"). "
        "Keep the log on a local disk (--db FILE) and copy it afterwards.",
        path_, mode));
  database_->exec("PRAGMA synchronous = FULL");
  database_->exec("PRAGMA foreign_keys = ON");
  database_->execAndGet("SELECT count(*) FROM sqlite_master");  // creates the -wal file
  wal_inode_ = inode_of(file_ + "-wal");
}

// Keeps a copy of the older file. The copy gets its name when it is complete, and only one is kept
// if the upgrade is interrupted and repeated.
void LogFile::upgrade() {
  const int version = database_->execAndGet("PRAGMA user_version").getInt();
  const std::string stem = fmt::format("{}.v{}", file_, version), part = stem + ".part";
  std::filesystem::remove(part);
  create_file(part, 0600);
  {
    SQLite::Database copy(part, SQLite::OPEN_READWRITE);
    SQLite::Backup(copy, *database_).executeStep();
  }
  std::string name = stem;
  for (int i = 2; std::filesystem::exists(name) && !are_alike(part, name); ++i)
    name = fmt::format("{}-{}", stem, i);
  std::filesystem::rename(part, name);
  schema::upgrade(*database_);
  database_->exec("PRAGMA foreign_keys = ON");
}

std::string LogFile::displacement() const {
  if (const std::string happened = lock_.displacement(); !happened.empty()) return happened;
  int has_moved = 0;
  sqlite3_file_control(database_->getHandle(), "main", SQLITE_FCNTL_HAS_MOVED, &has_moved);
  if (has_moved != 0) return "was replaced by another file";
  if (wal_inode_ != 0 && inode_of(file_ + "-wal") != wal_inode_)
    return "lost the file with its newest rows (-wal), which was deleted or replaced";
  return "";
}

void LogFile::check_in_place() {
  if (displaced_) throw DisplacedLog(*displaced_);
  const std::string happened = displacement();
  if (happened.empty()) return;
  const bool is_linked = happened.starts_with("was given");
  std::string saved = "All saved data are in that file";
  std::string remedy = is_linked                      ? "Remove the other name"
                       : happened.starts_with("lost") ? "Do not touch the files beside it"
                                                      : "Move it back";
  if (!checkpoint()) {
    const std::string copy = rescue();
    saved = copy.empty() ? "The saved data could not be rescued"
                         : fmt::format("All saved data are in the copy {}", copy);
    remedy = "Put that copy in its place";
  }
  displaced_.emplace(fmt::format("during writing, the file {}. {}", happened, saved), remedy);
  throw DisplacedLog(*displaced_);
}

// Moves all committed rows from the -wal file into the database. @return whether it succeeded and
// the file has a name
bool LogFile::checkpoint() {
  try {
    SQLite::Statement run(*database_, "PRAGMA wal_checkpoint(TRUNCATE)");
    return run.executeStep() && run.getColumn(0).getInt() == 0 && lock_.has_name();
  } catch (const SQLite::Exception&) {
    return false;
  }
}

// Copies a file without a name to the first free name. @return empty if it failed
std::string LogFile::rescue() const {
  try {
    std::string name = file_ + ".rescued";
    for (int i = 2; !create_file(name, 0600); ++i) name = fmt::format("{}.rescued{}", file_, i);
    SQLite::Database copy(name, SQLite::OPEN_READWRITE);
    SQLite::Backup(copy, *database_).executeStep();
    return name;
  } catch (const std::exception&) {
    return "";
  }
}

std::string resolved_path(const std::string& path) {
  if (path.empty()) throw Error("the log's file name is empty. Specify one with --db FILE.");
  std::error_code error;
  const auto resolved = std::filesystem::weakly_canonical(path, error);
  if (error) throw Error(fmt::format("cannot open {}: {}", path, error.message()));
  if (std::filesystem::is_directory(resolved, error))
    throw Error(fmt::format("{} is a folder, expected a log file. Specify a file in it: --db {}",
                            path,
                            shell_quoted((std::filesystem::path(path) / "heft.db").string())));
  return std::filesystem::absolute(resolved).string();
}

void refuse_foreign_file(const std::string& path) {
  throw Error(fmt::format(
      "{} is no heft log: it belongs to another program or is damaged, and was not changed. "
      "Choose another file with --db FILE.",
      path));
}

bool holds_log(SQLite::Database& database, const std::string& path) {
  switch (schema::kind_of(database)) {
    case schema::FileKind::foreign:
      refuse_foreign_file(path);
    case schema::FileKind::newer_log:
      refuse_newer_log(path);
    case schema::FileKind::outdated_log:
      refuse_outdated_log(path, database.execAndGet("PRAGMA user_version").getInt());
    case schema::FileKind::empty:
      return false;
    case schema::FileKind::older_log:
    case schema::FileKind::log:
      return true;
  }
  return false;
}

}  // namespace heft
