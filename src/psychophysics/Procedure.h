// A procedure of any kind as one value: which level comes next, what an answer does, when it ends
// and what it estimates. Pure: chance comes in as a stream. Files, logs and traces call each
// procedure that runs a "staircase", whatever its kind. Files know the kinds of ProcedureKinds.h; a
// program can run any type that is a ProcedureKind beside them.
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

/// What a type must have to run as a procedure. Copies are independent of each other, and a value
/// depends on nothing but what it was made from and the answers that it got: an answer that is
/// taken back is undone by answering anew. It may also have
///   std::optional<int> planned_trials() const;       how many trials it takes, where that is known
///   std::vector<double> planned_levels() const;      levels that are known before any answer
template <typename Kind>
concept ProcedureKind = std::copyable<Kind> &&
    requires(Kind& kind, const Kind& fixed, const RandomStream& stream, const Response& response,
             double shown) {
  /// The level to present next; the same until an answer comes. Not asked for after the end.
  { fixed.next_level(stream) } -> std::convertible_to<double>;
  /// Takes the answer to a trial that presented `shown`.
  { kind.respond(response, shown) } -> std::same_as<Update>;
  { fixed.finish() } -> std::same_as<std::optional<StopReason>>;  ///< none: it continues
  /// One a method, at any time; the first is the one that is summarized.
  { fixed.estimates() } -> std::same_as<std::vector<Estimate>>;
};

class Procedure {
 public:
  template <ProcedureKind Kind>
  Procedure(std::string name, Kind kind)
      : name_(std::move(name)), kind_(std::make_unique<Of<Kind>>(std::move(kind))) {}
  /// Of a kind that has settings: UpDownConfig... @throws InvalidConfig
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

  /// The level to present next; the same until an answer comes. Undefined after the end.
  /// @param stream the procedure's own and always the same: level_stream()
  double next_level(const RandomStream& stream) const { return kind_->next_level(stream); }

  /// Takes the answer to a trial. Undefined after the end.
  /// @param shown the level really shown, within +-largest_level
  Update respond(const Response& response, double shown) {
    ++n_trials_;
    return kind_->respond(response, shown);
  }

  bool finished() const { return finish().has_value(); }
  std::optional<StopReason> finish() const { return kind_->finish(); }  ///< none: it continues
  /// One a method, whether finished or not.
  std::vector<Estimate> estimates() const { return kind_->estimates(); }

  int n_trials() const { return n_trials_; }
  /// How many trials it takes in all; none where that depends on the answers.
  std::optional<int> planned_trials() const { return kind_->planned_trials(); }
  /// The levels that are known before any answer: all of a fixed kind, the first of an adaptive
  /// one.
  std::vector<double> planned_levels() const { return kind_->planned_levels(); }

  /// As the kind that it is; null where it is another.
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
    virtual std::vector<double> planned_levels() const = 0;
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
    std::vector<double> planned_levels() const override {
      if constexpr (requires { kind.planned_levels(); }) return kind.planned_levels();
      return {};
    }

    Kind kind;
  };

  std::string name_;
  std::unique_ptr<AnyKind> kind_;
  int n_trials_ = 0;  ///< answered
};

/// What the staircase of that name draws its levels from.
inline RandomStream level_stream(std::uint64_t seed, const std::string& staircase) {
  return {seed, "levels/" + staircase};
}

}  // namespace heft
