// A folder with everything an analysis found: tables as CSV, summary.json, charts as SVG with the
// scripts that draw them, and report.html, which needs no other file.
#pragma once

#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"

namespace heft {

struct ReportResult {
  std::vector<std::string> files;  ///< written, by name
  bool charts_drawn = true;        ///< false: gnuplot is not installed
};

/// Writes into `folder`, which is made if need be. A folder that an earlier analysis made is
/// replaced.
/// @throws Error when the folder holds anything else, or can't be written
ReportResult write_report(const Summary& summary, const std::string& folder);

/// Whether write_report would refuse the folder; for asking before a long analysis.
/// @throws Error as write_report
void refuse_foreign_folder(const std::string& folder);

}  // namespace heft
