// One topic of a study's analysis in one file: the measures that it declares, how they are
// estimated from the log's sessions, and the tables and charts that show them. Sections.cpp lists
// all.
#pragma once

#include <memory>
#include <vector>

#include "analysis/ChartSpec.h"
#include "analysis/EstimateTable.h"
#include "analysis/Summary.h"

namespace heft {

/// What several sections are made of; sessions are read once for all.
struct SharedFolds {
  ComparisonTrials comparisons;
  StaircaseFold staircases;
};

class Section {
 public:
  Section() = default;
  Section(const Section&) = delete;
  Section& operator=(const Section&) = delete;
  virtual ~Section() = default;

  /// A session of a participant who counts. Sessions come in order, and one is in memory at a time.
  virtual void add(const SessionData& /*data*/) {}
  /// Adds the section's estimates to the summary.
  virtual void put(Summary& summary, const SharedFolds& shared) = 0;
  virtual std::vector<EstimateTable> tables() const { return {}; }
  virtual std::vector<ChartSpec> charts() const { return {}; }
};

/// New ones, in the order of the report.
std::vector<std::unique_ptr<Section>> all_sections();

}  // namespace heft
