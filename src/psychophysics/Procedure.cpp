#include "psychophysics/Procedure.h"

#include <type_traits>

namespace heft {

namespace {
ProcedureKinds::Value made_from(const KindConfig& kind) {
  return std::visit(
      [](const auto& config) {
        using Kind = typename std::decay_t<decltype(config)>::Procedure;
        return ProcedureKinds::Value(Kind(config));
      },
      kind);
}
}  // namespace

ProcedureConfig::ProcedureConfig() : ProcedureConfig({}, {}) {}

ProcedureConfig::ProcedureConfig(std::string its_name, const KindConfig& its_kind)
    : name(std::move(its_name)), kind(std::make_shared<KindConfig>(its_kind)) {}

Procedure::Procedure(const ProcedureConfig& config)
    : name_(config.name), value_(made_from(*config.kind)) {}

double Procedure::next_level(const RandomStream& stream) const {
  return std::visit([&](const auto& kind) { return kind.next_level(stream); }, value_);
}

Update Procedure::respond(const Response& response, double shown) {
  return std::visit([&](auto& kind) { return kind.respond(response, shown); }, value_);
}

std::optional<Finish> Procedure::finish() const {
  return std::visit([](const auto& kind) { return kind.finish(); }, value_);
}

std::vector<Estimate> Procedure::estimates() const {
  return std::visit([](const auto& kind) { return kind.estimates(); }, value_);
}

int Procedure::n_trials() const {
  return std::visit([](const auto& kind) { return kind.n_trials(); }, value_);
}

std::optional<int> Procedure::planned_trials() const {
  return std::visit([](const auto& kind) { return kind.planned_trials(); }, value_);
}

std::vector<double> Procedure::planned_levels() const {
  return std::visit([](const auto& kind) { return kind.planned_levels(); }, value_);
}

RandomStream level_stream(std::uint64_t seed, const std::string& staircase) {
  return {seed, "levels/" + staircase};
}

}  // namespace heft
