#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/display/Table.h"
#include "analysis/report/Report.h"

namespace heft {

namespace {
using nlohmann::ordered_json;

Cell figure(const std::optional<double>& value) {
  return value ? Cell{fmt::format("{:.5g}", *value), value} : Cell{};
}

std::string title(const NamedFit& named) {
  const Fit& fit = named.fit;
  std::string text = named.group ? fmt::format("{}: ", *named.group) : "";
  text += fmt::format("{} at {}", counted(std::lround(fit.n_trials), "trial"),
                      counted(static_cast<std::int64_t>(fit.n_levels), "level"));
  if (fit.log_likelihood) text += fmt::format(", log likelihood {:.4f}", *fit.log_likelihood);
  return text;
}

std::string in_words(const GoodnessOfFit& goodness) {
  if (!goodness.deviance) return fmt::format("Goodness of fit can't be judged: {}.", goodness.why);
  return fmt::format(
      "Goodness of fit: deviance {:.2f} ({} df), p = {:.3f} by {} simulated data sets, if levels "
      "were chosen beforehand. {}",
      *goodness.deviance, goodness.degrees_of_freedom, *goodness.p, goodness.n_simulated,
      goodness.fits()
          ? "The model is not rejected."
          : "The model is rejected: thresholds and intervals are those of a wrong curve.");
}

Table table_of(const NamedFit& named) {
  Table table{"fit", title(named), {}, {}, ""};
  table.columns = {{"parameter", "parameter"}, {"value", "estimate"}, {"se", "SE"},
                   {"low", "95 % from"},       {"high", "to"},        {"note", " "}};
  for (const FittedParameter& parameter : named.fit.parameters)
    table.rows.push_back({word(parameter.name), figure(parameter.value), figure(parameter.se),
                          figure(parameter.low), figure(parameter.high),
                          parameter.fixed ? word("fixed") : word(" ")});
  table.note = named.fit.identifiable() ? in_words(named.goodness)
                                        : fmt::format("No threshold: {}.", named.fit.why);
  return table;
}

Table table_of_people(const NamedFit& named) {
  Table table{"people", "Each person's threshold", {}, {}, ""};
  table.columns = {{"person", "person"},
                   {"value", "threshold g"},
                   {"low", "95 % from"},
                   {"high", "to"},
                   {"why", "no threshold: why"}};
  for (const auto& [person, own] : named.people) {
    const auto end = [&interval_g = own.interval_g](double Interval::*of) {
      return interval_g ? figure(*interval_g.*of) : Cell{};
    };
    table.rows.push_back({word(person), figure(own.threshold_75_g), end(&Interval::low),
                          end(&Interval::high), word(own.why.empty() ? " " : own.why)});
  }
  return table;
}

ordered_json or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : nullptr;
}

ordered_json object_of(const FittedParameter& parameter) {
  return {{"value", or_null(parameter.value)},
          {"se", or_null(parameter.se)},
          {"low", or_null(parameter.low)},
          {"high", or_null(parameter.high)},
          {"fixed", parameter.fixed}};
}

ordered_json object_of(const OwnThreshold& own) {
  ordered_json object{{"value", or_null(own.threshold_75_g)}};
  object["low"] = own.interval_g ? ordered_json(own.interval_g->low) : nullptr;
  object["high"] = own.interval_g ? ordered_json(own.interval_g->high) : nullptr;
  object["identifiable"] = own.why.empty();
  object["why"] = own.why.empty() ? nullptr : ordered_json(own.why);
  return object;
}

ordered_json object_of(const GoodnessOfFit& goodness) {
  const bool is_judged = goodness.deviance.has_value();
  return {{"deviance", or_null(goodness.deviance)},
          {"degrees_of_freedom",
           is_judged ? ordered_json(goodness.degrees_of_freedom) : ordered_json(nullptr)},
          {"p", or_null(goodness.p)},
          {"n_simulated", goodness.n_simulated},
          {"why", is_judged ? ordered_json(nullptr) : ordered_json(goodness.why)}};
}

ordered_json object_of(const NamedFit& named) {
  const Fit& fit = named.fit;
  ordered_json object, parameters;
  for (const FittedParameter& parameter : fit.parameters)
    parameters[parameter.name] = object_of(parameter);
  object["group"] = named.group ? ordered_json(*named.group) : nullptr;
  object["parameters"] = parameters;
  if (parameters.contains("threshold_75_g"))
    object["threshold_75_g"] = parameters["threshold_75_g"]["value"];
  object["log_likelihood"] = or_null(fit.log_likelihood);
  object["n_trials"] = static_cast<std::int64_t>(fit.n_trials);
  object["identifiable"] = fit.identifiable();
  object["why"] = fit.identifiable() ? nullptr : ordered_json(fit.why);
  object["goodness_of_fit"] = object_of(named.goodness);
  for (const auto& [person, own] : named.people) object["people"][person] = object_of(own);
  return object;
}
}  // namespace

std::string fits_as_text(std::span<const NamedFit> fits) {
  std::string text;
  for (const NamedFit& fit : fits) {
    if (!text.empty()) text += '\n';
    text += as_text(table_of(fit));
    if (!fit.people.empty()) text += '\n' + as_text(table_of_people(fit));
  }
  return text;
}

std::string fits_as_json(std::span<const NamedFit> fits) {
  ordered_json all = ordered_json::array();
  for (const NamedFit& fit : fits) all.push_back(object_of(fit));
  return all.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace heft
