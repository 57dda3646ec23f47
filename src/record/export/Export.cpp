#include "record/export/Export.h"

#include <filesystem>
#include <map>

#include "base/files/Csv.h"
#include "record/export/ExportFolder.h"

namespace heft {

namespace {
ExportCell text_cell(const std::string& text) {
  return {text.empty() ? ExportCell::Kind::none : ExportCell::Kind::text, text};
}

void write_dictionary(const ExportSource& source, const std::vector<ExportTable>& tables,
                      ExportFolder& folder) {
  RowFile file = folder.rows("dictionary.csv", RowFile::Kind::csv);
  std::int64_t n = 0;
  std::vector<ExportColumn> header;
  for (const char* name : {"file", "column", "unit", "meaning", "levels"})
    header.push_back({name, "", "", "", ""});
  file.header(header);
  for (const ExportTable& table : tables)
    for (const ExportColumn& column : source.columns(table)) {
      const std::vector<ExportCell> cells{text_cell(table.name + ".csv"), text_cell(column.name),
                                          text_cell(column.unit), text_cell(column.meaning),
                                          text_cell(column.levels)};
      file.row(cells);
      ++n;
    }
  file.close();
  folder.wrote("dictionary.csv", n);
}
}  // namespace

std::vector<std::string> lab_names(const std::vector<std::string>& logs) {
  std::vector<std::string> names;
  for (const std::string& log : logs) names.push_back(std::filesystem::path(log).stem().string());
  std::map<std::string, int> n;
  for (const std::string& name : names) n[name] += 1;
  for (std::size_t i = 0; i < logs.size(); ++i)
    if (n[names[i]] > 1) names[i] = logs[i];
  return names;
}

void export_csv(const ExportSource& source, ExportFolder& folder,
                const std::function<void(double)>& progress) {
  const std::string script = analysis_script();
  write_dictionary(source, write_tables(source, folder, "", ".csv", progress), folder);
  folder.write_text("analysis.R", script);
}

std::vector<ExportedFile> export_logs(const ExportRequest& request,
                                      const std::function<void(double)>& progress) {
  refuse_filled_folder(request.folder);
  const ExportSource source(request.logs, request.key);
  ExportFolder folder(request.folder, request.is_verified);
  switch (request.format) {
    case ExportFormat::csv:
      export_csv(source, folder, progress);
      break;
    case ExportFormat::psych_ds:
      export_psych_ds(source, folder, progress);
      break;
    case ExportFormat::bids:
      export_bids(source, folder, progress);
      break;
  }
  return folder.finished();
}

}  // namespace heft
