// A psychophysical procedure of any kind as one value: next level, response, stop rule, estimates.
// Procedures are pure; random draws come from a stream. Files and logs call every running procedure
// a "staircase", of whatever kind. Files can name the kinds of ProcedureKinds.h; a program can also
// run its own types that satisfy ProcedureKind.
#pragma once

#include <concepts>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/Random.h"
#include "psychophysics/ProcedureTypes.h"

namespace heft {

/// Requirements of a procedure. Copies are independent, and the state is a function of the
/// configuration and the responses only, so that a response is withdrawn by replaying the others.
/// Optional members:
///   std::optional<int> planned_trials() const;       number of trials, if known in advance
///   int most_trials() const;                         of a Bayesian kind, which is slow to simulate
///   std::vector<double> planned_levels() const;      levels known before the first response
///   std::vector<ParameterPosterior> posterior() const;   of a Bayesian kind's parameters
template <typename Kind>
concept ProcedureKind = std::copyable<Kind> &&
    requires(Kind& kind, const Kind& fixed, const RandomStream& stream, const Response& response,
             double shown) {
  /// The level to present next, constant until the next response. Not called after the end.
  { fixed.next_level(stream) } -> std::convertible_to<double>;
  /// Records the response to a trial that presented the level `shown`.
  { kind.respond(response, shown) } -> std::same_as<Update>;
  { fixed.finish() } -> std::same_as<std::optional<StopReason>>;  ///< none: not finished
  /// One for each method, at any time; summaries use the first.
  { fixed.estimates() } -> std::same_as<std::vector<Estimate>>;
};

class Procedure {
 public:
  template <ProcedureKind Kind>
  Procedure(std::string name, Kind kind)
      : name_(std::move(name)), kind_(std::make_unique<Of<Kind>>(std::move(kind))) {}
  /// From the configuration of a kind, such as UpDownConfig. @throws InvalidConfig
  template <typename Config>
  requires ProcedureKind<typename Config::Procedure> Procedure(std::string name,
                                                               const Config& config)
      : Procedure(std::move(name), typename Config::Procedure(config)) {}
  Procedure(const Procedure& other)
      : name_(other.name_), kind_(other.kind_->copy()), n_trials_(other.n_trials_) {}
  Procedure(Procedure&&) noexcept = default;
  Procedure& operator=(Procedure other) noexcept {
    std::swap(name_, other.name_);
    std::swap(kind_, other.kind_);
    n_trials_ = other.n_trials_;
    return *this;
  }
  ~Procedure() = default;

  const std::string& name() const { return name_; }

  /// The level to present next, constant until the next response. Undefined after the end.
  /// @param stream level_stream() of this staircase, the same in every call
  double next_level(const RandomStream& stream) const { return kind_->next_level(stream); }

  /// Records the response to a trial. Undefined after the end.
  /// @param shown the level that was presented, within +-largest_level
  Update respond(const Response& response, double shown) {
    ++n_trials_;
    return kind_->respond(response, shown);
  }

  bool finished() const { return finish().has_value(); }
  std::optional<StopReason> finish() const { return kind_->finish(); }  ///< none: not finished
  /// One for each method, before the end too.
  std::vector<Estimate> estimates() const { return kind_->estimates(); }

  int n_trials() const { return n_trials_; }
  /// Total number of trials; none if it depends on the responses.
  std::optional<int> planned_trials() const { return kind_->planned_trials(); }
  /// Number of trials that ends a Bayesian kind in any case; none for other kinds.
  std::optional<int> most_trials() const { return kind_->most_trials(); }
  /// Levels known before the first response: all of a fixed kind, the first of an adaptive one.
  std::vector<double> planned_levels() const { return kind_->planned_levels(); }

  bool is_bayesian() const { return kind_->is_bayesian(); }
  /// Posterior of the parameters of a Bayesian kind, at any time; empty for the others.
  std::vector<ParameterPosterior> posterior() const { return kind_->posterior(); }

  /// The procedure as a `Kind`; null if it is of another kind.
  template <ProcedureKind Kind>
  const Kind* get_if() const {
    const auto* of_kind = dynamic_cast<const Of<Kind>*>(kind_.get());
    return of_kind ? &of_kind->kind : nullptr;
  }

 private:
  struct AnyKind {
    virtual ~AnyKind() = default;
    virtual std::unique_ptr<AnyKind> copy() const = 0;
    virtual double next_level(const RandomStream& stream) const = 0;
    virtual Update respond(const Response& response, double shown) = 0;
    virtual std::optional<StopReason> finish() const = 0;
    virtual std::vector<Estimate> estimates() const = 0;
    virtual std::optional<int> planned_trials() const = 0;
    virtual std::optional<int> most_trials() const = 0;
    virtual std::vector<double> planned_levels() const = 0;
    virtual bool is_bayesian() const = 0;
    virtual std::vector<ParameterPosterior> posterior() const = 0;
  };

  template <typename Kind>
  struct Of final : AnyKind {
    explicit Of(Kind its_kind) : kind(std::move(its_kind)) {}
    std::unique_ptr<AnyKind> copy() const override { return std::make_unique<Of>(kind); }
    double next_level(const RandomStream& stream) const override { return kind.next_level(stream); }
    Update respond(const Response& response, double shown) override {
      return kind.respond(response, shown);
    }
    std::optional<StopReason> finish() const override { return kind.finish(); }
    std::vector<Estimate> estimates() const override { return kind.estimates(); }
    std::optional<int> planned_trials() const override {
      if constexpr (requires { kind.planned_trials(); }) return kind.planned_trials();
      return std::nullopt;
    }
    std::optional<int> most_trials() const override {
      if constexpr (requires { kind.most_trials(); }) return kind.most_trials();
      return std::nullopt;
    }
    std::vector<double> planned_levels() const override {
      if constexpr (requires { kind.planned_levels(); }) return kind.planned_levels();
      return {};
    }
    bool is_bayesian() const override {
      return requires {
        kind.posterior();
      };
    }
    std::vector<ParameterPosterior> posterior() const override {
      if constexpr (requires { kind.posterior(); }) return kind.posterior();
      return {};
    }

    Kind kind;
  };

  std::string name_;
  std::unique_ptr<AnyKind> kind_;
  int n_trials_ = 0;
};

/// The random stream of a staircase's levels.
inline RandomStream level_stream(std::uint64_t seed, const std::string& staircase) {
  return {seed, "levels/" + staircase};
}

}  // namespace heft
