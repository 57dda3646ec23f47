#include "record/export/ExportFolder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "base/Error.h"
#include "base/Program.h"
#include "base/files/Csv.h"
#include "base/files/TextFile.h"
#include "record/reader/LogReader.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

constexpr auto unfinished = "export_unfinished.txt";

[[noreturn]] void refuse_writing(const fs::path& path) {
  throw Error(fmt::format("cannot write {}: {}. Export to another folder.", path.string(),
                          std::strerror(errno)));
}

// BIDS has no quotes, so separators become spaces.
std::string tsv_cell(std::string text) {
  for (char& c : text)
    if (c == '\t' || c == '\n' || c == '\r') c = ' ';
  return text;
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  if (!folder.empty()) fs::create_directories(folder, error);
  if (error)
    throw Error(fmt::format("cannot create the folder {}: {}", folder.string(), error.message()));
}
}  // namespace

RowFile::RowFile(const fs::path& path, Kind kind, bool is_verified)
    : path_(path), kind_(kind), is_verified_(is_verified), file_(path, std::ios::binary) {}

void RowFile::header(const std::vector<ExportColumn>& columns) {
  std::vector<std::string> names;
  for (const ExportColumn& column : columns)
    names.push_back(shown({ExportCell::Kind::text, column.name}));
  if (!is_verified_) names.emplace_back("unverified");
  line(names);
}

void RowFile::row(std::span<const ExportCell> cells) {
  std::vector<std::string> texts;
  texts.reserve(cells.size());
  for (const ExportCell& cell : cells) texts.push_back(shown(cell));
  if (!is_verified_) texts.emplace_back("1");
  line(texts);
}

void RowFile::close() {
  file_.close();
  if (!file_) refuse_writing(path_);
}

void RowFile::line(const std::vector<std::string>& cells) {
  const char between = kind_ == Kind::csv ? ',' : '\t';
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) file_ << between;
    file_ << cells[i];
  }
  file_ << '\n';
}

std::string RowFile::shown(const ExportCell& cell) const {
  const bool is_text = cell.kind == ExportCell::Kind::text;
  if (kind_ == Kind::csv) return is_text ? csv_cell(without_formula(cell.text)) : cell.text;
  return cell.text.empty() ? "n/a" : tsv_cell(cell.text);
}

ExportFolder::ExportFolder(const std::string& folder, bool is_verified)
    : folder_(folder), is_verified_(is_verified) {
  refuse_filled_folder(folder);
  make_folder(folder_);
  write_text(
      unfinished,
      "heft export is writing to this folder or was interrupted; the files are incomplete. If "
      "no export is running, delete the folder and export again.\n");
}

fs::path ExportFolder::place(const std::string& name) {
  const fs::path path = folder_ / name;
  make_folder(path.parent_path());
  return path;
}

RowFile ExportFolder::rows(const std::string& name, RowFile::Kind kind) {
  return {place(name), kind, is_verified_};
}

std::string ExportFolder::warning() const {
  return is_verified_ ? "" : fmt::format(" {}", unverified_warning);
}

void ExportFolder::write_text(const std::string& name, const std::string& text) {
  const fs::path path = place(name);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) refuse_writing(path);
  files_.push_back({name, std::nullopt});
}

std::vector<ExportedFile> ExportFolder::finished() {
  fs::remove(folder_ / unfinished);
  std::erase_if(files_, [](const ExportedFile& file) { return file.name == unfinished; });
  return std::move(files_);
}

void ExportProgress::row() {
  constexpr std::int64_t rows_per_report = 1000;
  if (++n_done_ % rows_per_report == 0)
    report_(std::min(1.0, static_cast<double>(n_done_) / static_cast<double>(n_all_)));
}

std::string readme_of(const std::string& standard, const ExportFolder& folder) {
  return fmt::format(
      "# Perceived mass of virtual cubes\n\nExported by heft {} as {}. Participants pushed virtual "
      "cubes with a hand-held effector and judged their masses. Times are in seconds since the "
      "start of the session, masses in grams. Trials whose status is not `completed` were "
      "presented "
      "again. Trials with `is_practice` 1 are practice and excluded from results.{}\n",
      HEFT_VERSION, standard, folder.warning());
}

std::string analysis_script() {
  return read_text_file(installed_file("src/record/export/analysis.R"));
}

std::vector<ExportTable> write_tables(const ExportSource& source, ExportFolder& folder,
                                      const std::string& begin, const std::string& end,
                                      const std::function<void(double)>& progress) {
  std::vector<ExportTable> tables = source.tables();
  std::erase_if(tables, [&](const ExportTable& table) {
    return table.name == "frames" && source.count(table) == 0;
  });
  std::int64_t n_rows = 0;
  for (const ExportTable& table : tables) n_rows += source.count(table);
  ExportProgress count(n_rows, progress);
  for (const ExportTable& table : tables) {
    const std::string name = fmt::format("{}{}{}", begin, table.name, end);
    RowFile file = folder.rows(name, RowFile::Kind::csv);
    file.header(source.columns(table));
    std::int64_t n = 0;
    source.each_row(table, [&](const ExportCells& cells) {
      file.row(cells);
      count.row();
      ++n;
    });
    file.close();
    folder.wrote(name, n);
  }
  return tables;
}

void refuse_filled_folder(const std::string& folder) {
  std::error_code unknown;  // reported by the first write
  if (!fs::exists(folder, unknown)) return;
  if (!fs::is_directory(folder, unknown))
    throw Error(fmt::format("--out {}: it is a file, expected a folder", folder), ExitCode::usage);
  if (fs::exists(fs::path(folder) / unfinished, unknown))
    throw Error(fmt::format("--out {}: the folder holds an unfinished export, and exports never "
                            "overwrite files. Delete it or choose a new folder.",
                            folder),
                ExitCode::usage);
  if (!fs::is_empty(folder, unknown))
    throw Error(fmt::format("--out {}: the folder is not empty, and exports never overwrite files. "
                            "Choose a new or empty folder.",
                            folder),
                ExitCode::usage);
}

}  // namespace heft
