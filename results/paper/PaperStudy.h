// The study of rival models: which models of participants give the figures that the paper reports,
// when they are fitted to one of its experiments and predict the other. README.md has the results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "population/ResponderFit.h"
#include "results/Study.h"

namespace heft {

void run_paper_study(const StudyOptions& options);

enum class RivalGroup { mechanism, null, bound };
template <>
struct EnumNames<RivalGroup> {
  static constexpr std::array<std::string_view, 3> names{"mechanism", "null", "bound"};
};

/// The paper's experiments.
enum class PaperExperiment { sorting = 1, jnd = 2 };

/// A free parameter, and which experiments depend on it. In a fit to the other experiment it keeps
/// its default.
struct RivalParameter {
  FreeParameter parameter;
  bool sorting = true, jnd = true;
};

struct Rival {
  std::string name;
  RivalGroup group = RivalGroup::mechanism;
  std::string responder;               ///< of heft's table
  std::string file;                    ///< in results/paper/models; empty: all defaults
  std::vector<RivalParameter> free{};  ///< empty: nothing is fitted
};

/// From mechanisms to the bound.
std::vector<Rival> rivals();

/// A number that the paper prints: a mean or standard deviation over its 13 participants.
struct PaperFigure {
  std::size_t place = 0;  ///< index of its FigurePlace
  std::string name;
  bool is_sd = false;
  double value = 0;
  PaperExperiment experiment = PaperExperiment::sorting;
  double range = 0;         ///< of possible values, from 0
  bool independent = true;  ///< false: follows from others of its condition
};

/// All figures of protocols/examples/paper_figures.toml that have a value.
std::vector<PaperFigure> paper_figures(const std::vector<ReportedFigure>& reported);

/// A figure in many simulated studies, beside the paper's.
struct FigureScore {
  double mean = 0, low = 0, high = 0;  ///< over studies; 2.5 and 97.5 % quantiles
  double place = 0;                    ///< share of the studies below the paper's figure
  bool hit = false;                    ///< the paper's figure is within the quantiles
  double log_score = 0;                ///< 0: as an even density over the range; at worst ln 0.01
};

/// The score is ln(range * density at the paper's figure). The density is a normal kernel estimate
/// over studies (bandwidth: Silverman 1986, at least 1 % of the range), mixed with 1 % of an even
/// density, so that what never happens has a finite cost.
/// @param studies the figure in each study that has it; none has it: the worst score, no quantiles
FigureScore score_of(const PaperFigure& figure, const std::vector<double>& studies);

/// Only mean, low and high; NaN without studies.
FigureScore summary_of(const std::vector<double>& studies);

/// What a model that was fitted to one experiment gives.
struct RivalResult {
  Rival rival;
  PaperExperiment fitted_to = PaperExperiment::jnd;
  std::vector<FreeEstimate> parameters;
  double effective = 0;                 ///< simulated participants behind the fit, see ResponderFit
  std::vector<FigureScore> figures;     ///< by paper figure
  std::vector<FigureScore> unreported;  ///< by figure without a value: mean, low and high only

  /// Hits and independent scores of one experiment's figures.
  struct Total {
    int n_hits = 0, n = 0;
    double log_score = 0;  ///< of independent figures
  };
  Total total(const std::vector<PaperFigure>& figures_of_paper, PaperExperiment experiment) const;
};

/// The chart: a row for each model, a tile for each figure. @param n_studies of each model
std::string rivals_chart(const std::vector<RivalResult>& results,
                         const std::vector<PaperFigure>& figures, int n_studies,
                         const StudyOptions& options);

}  // namespace heft
