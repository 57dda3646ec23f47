// The folder of an export and its files. An incomplete export is marked. Private to record.
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

/// A CSV or TSV file.
class RowFile {
 public:
  enum class Kind { csv, tsv };
  /// @param is_verified false: a last column `unverified` with the value 1
  RowFile(const std::filesystem::path& path, Kind kind, bool is_verified);

  void header(const std::vector<ExportColumn>& columns);
  void row(std::span<const ExportCell> cells);
  /// @throws Error if writing failed
  void close();

 private:
  void line(const std::vector<std::string>& cells);
  std::string shown(const ExportCell& cell) const;

  std::filesystem::path path_;
  Kind kind_;
  bool is_verified_;
  std::ofstream file_;
};

class ExportFolder {
 public:
  /// Creates the folder, with a file that marks it as incomplete.
  ExportFolder(const std::string& folder, bool is_verified);

  /// Path of a new file; creates its parent folders.
  std::filesystem::path place(const std::string& name);
  RowFile rows(const std::string& name, RowFile::Kind kind);
  void write_text(const std::string& name, const std::string& text);
  void wrote(const std::string& name, std::int64_t n_rows) { files_.push_back({name, n_rows}); }

  /// A sentence for descriptions; empty if the logs were verified.
  std::string warning() const;

  /// Removes the mark.
  std::vector<ExportedFile> finished();

 private:
  std::filesystem::path folder_;
  bool is_verified_;
  std::vector<ExportedFile> files_;
};

/// Counts rows and reports progress.
class ExportProgress {
 public:
  ExportProgress(std::int64_t n_all, const std::function<void(double)>& report)
      : n_all_(n_all), report_(report) {}
  void row();

 private:
  std::int64_t n_all_, n_done_ = 0;
  const std::function<void(double)>& report_;
};

/// Writes every table as CSV; frames only if there are any.
/// @param begin,end parts of the files' names around the table's name
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

/// The README of a dataset.
std::string readme_of(const std::string& standard, const ExportFolder& folder);

/// The R script that reads an export and prints its figures and models; installed with the program.
/// @throws Error when it is missing
std::string analysis_script();

}  // namespace heft
