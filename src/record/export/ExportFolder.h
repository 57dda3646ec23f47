// The folder that an export is written into: files that are whole or told as broken. Private to
// this room.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "record/export/Export.h"
#include "record/export/ExportSource.h"

namespace heft {

/// A file of rows; cells are quoted as its kind has it.
class RowFile {
 public:
  enum class Kind { csv, tsv };
  RowFile(const std::filesystem::path& path, Kind kind);

  void header(const std::vector<ExportColumn>& columns);
  void row(std::span<const ExportCell> cells);
  /// @throws Error when something could not be written
  void close();

 private:
  void line(const std::vector<std::string>& cells);
  std::string shown(const ExportCell& cell) const;

  std::filesystem::path path_;
  Kind kind_;
  std::ofstream file_;
};

class ExportFolder {
 public:
  /// Makes it, with a file that says that it isn't whole yet.
  explicit ExportFolder(const std::string& folder);

  /// Where a file is to be written; its folders are made.
  std::filesystem::path place(const std::string& name);
  void write_text(const std::string& name, const std::string& text);
  void wrote(const std::string& name, std::int64_t n_rows) { files_.push_back({name, n_rows}); }

  /// It is whole now.
  std::vector<ExportedFile> finished();

 private:
  std::filesystem::path folder_;
  std::vector<ExportedFile> files_;
};

/// Counts rows and tells how far it is.
class ExportProgress {
 public:
  ExportProgress(std::int64_t n_all, const std::function<void(double)>& tell)
      : n_all_(n_all), tell_(tell) {}
  void row();

 private:
  std::int64_t n_all_, n_done_ = 0;
  const std::function<void(double)>& tell_;
};

/// Writes every table as CSV, without frames where none were kept.
/// @param begin,end of the files' names, around the table's
/// @return the tables that were written
std::vector<ExportTable> write_tables(const ExportSource& source, ExportFolder& folder,
                                      const std::string& begin, const std::string& end,
                                      const std::function<void(double)>& progress);

void export_csv(const ExportSource& source, ExportFolder& folder,
                const std::function<void(double)>& progress);
void export_psych_ds(const ExportSource& source, ExportFolder& folder,
                     const std::function<void(double)>& progress);
void export_bids(const ExportSource& source, ExportFolder& folder,
                 const std::function<void(double)>& progress);

/// What a person who opens the folder reads first.
std::string readme_of(const std::string& standard);

/// The R script that reads an export and prints its figures and models; installed with the program.
/// @throws Error when it is missing
std::string analysis_script();

}  // namespace heft
