// One topic of a study's analysis in one file: the measures that it declares, how they are
// estimated from the log's sessions, and the tables and charts that show them. Sections.cpp lists
// all.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/dataset/Summary.h"
#include "analysis/display/ChartSpec.h"
#include "analysis/display/EstimateTable.h"

namespace heft {

class Section {
 public:
  Section() = default;
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  virtual ~Section() = default;

  /// Whether it includes participants who are excluded from the figures.
  virtual bool of_everyone() const { return false; }
  /// A session of a participant who counts. Sessions come in order, and one is in memory at a time.
  virtual void add(const SessionData& /*data*/) {}
  /// Adds the estimates over participants to the summary. May release data that only these need.
  virtual void put(Summary& summary) = 0;
  /// Estimates of each participant, computed when they are printed, because they would take most of
  /// the memory of a large study. @param summary that they belong to
  virtual Estimates of_participants(const Summary& /*summary*/) const { return {}; }
  /// The results in short sentences, for the first screen and the top of the report.
  virtual std::vector<std::string> findings(const Summary& /*summary*/) const { return {}; }
  virtual std::vector<EstimateTable> tables() const { return {}; }
  virtual std::vector<ChartSpec> charts() const { return {}; }
};

/// A new section of each kind.
std::vector<std::shared_ptr<Section>> all_sections();

}  // namespace heft
