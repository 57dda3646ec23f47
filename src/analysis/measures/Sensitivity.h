// How well masses are discriminated at each reference, whatever the criterion: see
// MixedIndecision.h.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/dataset/ComparisonTrials.h"
#include "analysis/dataset/Dataset.h"
#include "analysis/dataset/StudyEstimate.h"
#include "analysis/display/EstimateTable.h"
#include "inference/MixedIndecision.h"

namespace heft {

struct ReferenceSensitivity {
  Compared compared;
  MixedFit fit;
  bool as_published = false;  ///< compared at a reference and in the technique of the paper

  /// Whether it has a threshold of several people.
  bool is_of_people() const { return fit.identifiable() && fit.n >= least_people; }
};

/// By reference, lightest first, and condition; participants' sessions together.
std::vector<ReferenceSensitivity> sensitivities_of(const ComparisonTrials& trials);

/// Adds threshold, sensitivity, criterion and lapse rate of each row, and their comparisons.
void put_sensitivities(Estimates& all, std::span<const ReferenceSensitivity> rows);

// Comparisons of identifiable thresholds; in ThresholdContrasts.cpp.

void put_threshold_contrasts(Estimates& all, std::span<const ReferenceSensitivity> rows);
EstimateTable threshold_ratio_table();
EstimateTable threshold_exponent_table();

// Whether the model predicts the observed answers, by reference and condition; in ModelFit.cpp.

void put_model_fit(Estimates& all, std::span<const ReferenceSensitivity> rows,
                   const ComparisonTrials& trials, StaircaseRuns& runs);
EstimateTable model_fit_table();
EstimateTable predictive_checks_table();
/// What the predictive checks of all rows say together.
struct ModelVerdict {
  std::vector<const StudyEstimate*> missed;  ///< p of the rows whose figures the model misses
  double least_p = 1;
  int n_studies = 0;  ///< predicted, the fewest of a row
};
/// None: nothing was checked.
std::optional<ModelVerdict> model_verdict(const Estimates& all);
/// The figures that the model misses, or that it misses none. Empty: nothing was checked.
std::string model_fit_sentence(const Estimates& all);

// Weber fractions, thresholds by the mass of the reference, and the exponent of a power law between
// the two: 0 where thresholds are equal, 1 where Weber fractions are (Weber's law). Of thresholds
// of any task; in WeberFraction.cpp.

/// The threshold over its reference, with its interval; none at a reference of 0 g.
std::optional<StudyEstimate> weber_fraction_of(const StudyEstimate& threshold,
                                               const Measure& fraction);

/// Adds columns for a Weber fraction and, in files, its interval.
void add_weber_fraction(std::vector<EstimateColumn>& columns, const Measure& fraction);

/// Each participant's slope of log threshold on log reference, by condition: least squares over the
/// references at which they have a threshold. None where no participant was asked at two
/// references.
Estimates own_exponents(const Estimates& thresholds, const Measure& threshold,
                        const Measure& exponent);

/// The mean over participants of their exponents.
EstimateTable exponent_table(std::string name, std::string title, const Measure& exponent);
/// Each participant's exponent; in CSV files only.
EstimateTable own_exponent_table(std::string name, std::string title, const Measure& exponent);

}  // namespace heft
