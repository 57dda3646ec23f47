// Bayesian inference on a grid of parameters, and the level of least expected entropy (Kontsevich &
// Tyler 1999; Watson 2017; nuisance parameters: Prins 2013).
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include "psychophysics/Marginal.h"
#include "psychophysics/ResponseModel.h"

namespace heft {

/// A grid of the model's four parameters and of levels.
struct GridSpace {
  ResponseModel model;
  std::array<std::vector<double>, 4> parameters;  ///< values; one: fixed
  std::array<bool, 4> is_nuisance{};
  std::vector<double> levels;

  bool operator==(const GridSpace&) const = default;
  std::size_t n_points() const;
};

/// The probabilities of all outcomes at all points and levels. Immutable, and shared by all
/// procedures with an equal grid. Guesses and lapses only mix fixed shares with those of an
/// attentive trial, which are kept once for successive points that differ in nothing else.
class LikelihoodTable {
 public:
  /// The table of a space, made where no procedure has it yet. Thread-safe.
  static std::shared_ptr<const LikelihoodTable> shared(GridSpace space);

  explicit LikelihoodTable(GridSpace space);

  const GridSpace& space() const { return space_; }
  std::size_t n_points() const { return n_points_; }
  /// Points are ordered with the nuisance parameters fastest: as many successive points differ in
  /// these only.
  std::size_t n_nuisance() const { return n_nuisance_; }
  ParameterValues point(std::size_t i) const;
  /// Position of a point in the values of a parameter.
  std::size_t position(std::size_t i, std::size_t parameter) const {
    return i / stride_[parameter] % space_.parameters[parameter].size();
  }

  /// As many successive points differ in guesses and lapses only.
  Eigen::Index n_alike() const { return n_alike_; }
  /// Of points that are alike, a row each: the shares of the three outcomes of inattentive trials,
  /// and of attentive trials. @param group of points that are alike
  auto mixes(Eigen::Index group) const {
    return mixes_.middleRows(group * n_alike_ % mixes_.rows(), n_alike_);
  }
  /// Probabilities of the outcomes of attentive trials, but the first: a column for each group of
  /// points that are alike, in it the levels of one outcome after the other.
  const Eigen::MatrixXf& attentive() const { return attentive_; }
  /// Entropies of the outcome in nats of points with a few mixes of guesses and lapses: a row for
  /// each level, a column for each mix of the first group, then of the others. Without nuisance
  /// parameters only.
  const Eigen::MatrixXf& entropies() const { return entropies_; }
  /// Points that are alike have these combinations of the mixes' entropies: a row for each mix, a
  /// column for each point.
  const Eigen::MatrixXd& combinations() const { return combinations_; }

  /// Log probability of a response at any level, for every point; finite. Cached up to a memory
  /// limit, because simulated people repeat the same trials. Thread-safe.
  std::shared_ptr<const std::vector<double>> log_likelihood(double level,
                                                            const Response& response) const;

 private:
  template <typename Visit>
  void visit_attentive(const std::vector<double>& levels, const Visit& visit) const;

  void order_points();
  void put_mixes();
  std::vector<Eigen::Index> choose_mixes();

  GridSpace space_;
  std::size_t n_points_, n_nuisance_ = 1;
  Eigen::Index n_alike_ = 1;
  std::array<std::size_t, 4> stride_{};
  Eigen::Matrix<double, Eigen::Dynamic, 4> mixes_;  // of the first group, if all have the same
  Eigen::MatrixXf attentive_, entropies_;
  Eigen::MatrixXd combinations_;
  mutable std::mutex kept_mutex_;
  mutable std::map<std::pair<double, std::array<bool, 3>>,
                   std::shared_ptr<const std::vector<double>>>
      kept_;
};

/// A probability distribution over the points of a table; uniform before the first trial.
class PosteriorGrid {
 public:
  explicit PosteriorGrid(std::shared_ptr<const LikelihoodTable> table);

  /// @param level presented, on the grid of levels or not
  void update(double level, const Response& response);

  /// Expected entropy, in nats, of the posterior after one more trial at each level; with nuisance
  /// parameters, of the marginal of the others.
  Eigen::ArrayXd expected_entropies() const;
  /// The first level whose expected entropy is within 1e-7 nats of the least: levels that are
  /// equally good, as in symmetric grids, do not depend on rounding.
  double best_level() const;

  Marginal marginal(std::size_t parameter) const;
  ParameterValues mode() const;  ///< the first most probable point
  double log_evidence() const { return posterior_.log_evidence(); }
  const LikelihoodTable& table() const { return *table_; }

 private:
  const std::vector<double>& weights() const { return posterior_.weights(); }
  /// A column for each group of points that are alike.
  Eigen::Map<const Eigen::MatrixXd> groups() const {
    return {weights().data(), table_->n_alike(), table_->attentive().cols()};
  }
  struct Outcomes;
  Outcomes outcomes(Eigen::Index first, Eigen::Index n) const;
  Eigen::ArrayXd joint_entropies() const;
  Eigen::ArrayXd marginal_entropies() const;

  std::shared_ptr<const LikelihoodTable> table_;
  LogWeights posterior_;
};

}  // namespace heft
