// Posterior predictive checks of the mixed indecision model, with the estimate in place of a
// posterior (Gelman, Meng & Stern 1996): people drawn from the fitted population run the same
// procedures from the first trial, since a staircase's levels depend on its answers. Figures of
// these simulated studies are compared with the observed ones.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "inference/MixedIndecision.h"
#include "psychophysics/Procedure.h"

namespace heft {

/// A choice at a level in g, comparison minus reference.
struct MadeChoice {
  double level_g = 0;
  Choice choice = Choice::none;

  bool heavier() const {
    return level_g != 0 && choice == (level_g > 0 ? Choice::comparison : Choice::reference);
  }
  bool lighter() const {
    return level_g != 0 && choice == (level_g > 0 ? Choice::reference : Choice::comparison);
  }
};

/// A staircase as one person ran it.
struct StaircaseRun {
  std::shared_ptr<const Procedure> before;  ///< as it was before its first trial
  bool correct_choices = false;             ///< only these are positive; otherwise any choice is
  std::vector<MadeChoice> choices{};        ///< in order
};

/// One person's trials at one reference in one condition.
struct PersonRuns {
  std::vector<StaircaseRun> staircases;
  int n_catch = 0, n_catch_none = 0;  ///< catch trials, and those answered "no difference"
};

/// A figure of the study, and the same figure of the studies that the model predicts.
struct PredictedFigure {
  std::string name;
  double seen = 0;
  double mean = 0, sd = 0, low = 0, high = 0;  ///< of predicted studies; 95 % of them
  /// Distance from the predicted mean, in SDs.
  double deviation() const { return (seen - mean) / sd; }
};

/// Shares of choices between two levels; none if there was no trial.
struct PredictedShares {
  struct Band {
    double mean = 0, low = 0, high = 0;
  };
  std::optional<Band> heavier, lighter, none;
};

struct PredictiveCheck {
  std::vector<PredictedFigure> figures;
  std::vector<PredictedShares> by_level;  ///< between one edge and the next
  /// The largest deviation of a figure in each predicted study, in SDs.
  std::vector<double> farthest_of_studies;

  const PredictedFigure& farthest() const;  ///< of at least one figure
};

/// By check, the share of predicted studies in which some figure of any check deviates as many SDs
/// as the check's farthest observed one (maxT: Westfall & Young 1993). Below .05, its model does
/// not hold: of correct models this says at most 5 % of the time that one of them does not, however
/// many checks there are.
/// @param checks each with a figure, and simulated with another seed
std::vector<double> joint_p(std::span<const PredictiveCheck> checks);

/// @param fit identifiable, of several people
/// @param edges_g upper ends of ranges of levels, ascending; the last range is open
PredictiveCheck check_predictions(const MixedFit& fit, std::span<const PersonRuns> people,
                                  std::span<const double> edges_g, std::uint64_t seed = 1);

}  // namespace heft
