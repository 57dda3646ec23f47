// What participants did, block by block, for the methods of a report.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "analysis/report/Methods.h"
#include "psychophysics/ProcedureKinds.h"
#include "tasks/Tasks.h"

namespace heft {

namespace {
std::string trials_by_technique(const std::vector<TechniqueTrials>& trials, std::string_view each) {
  std::vector<std::string> parts;
  for (const auto& [technique, n] : trials)
    parts.push_back(fmt::format("{}{} in {}", n, each, technique));
  return listed(parts);
}

std::string in_words(const Introduction::Block& block) {
  return fmt::format(
      "In an introduction, participants chose the heavier of two cubes ({} g, in {}) until the "
      "choice was correct{}.",
      listed_g(block.masses_g), block.condition,
      block.wrong_answer == WrongAnswer::reshuffle
          ? "; after an incorrect choice the cubes were placed again in random order"
          : "");
}

std::string in_words(const Sorting::Block& block) {
  std::string text = fmt::format(
      "They sorted {} cubes of {} g by mass, or answered \"I don't know\", in {} trials ({}, in "
      "random order{}).",
      block.masses_g.size(), listed_g(block.masses_g), block.n_trials(),
      trials_by_technique(block.trials, ""),
      block.max_run > 0 ? fmt::format(", at most {} of one condition in a row", block.max_run)
                        : "");
  if (block.orders == SortingOrders::balanced)
    text += " Each order of the cubes was shown once before any was repeated.";
  return text;
}

std::string in_words(const Estimation::Block& block) {
  std::string text = fmt::format(
      "They judged how heavy single cubes of {} g felt, {} ({} for each mass, in random order).",
      listed_g(block.masses_g),
      block.scale == "slider"   ? "on a slider from 0 to 100"
      : block.scale == "number" ? "as a number"
                                : "in the answer to a question (" + block.scale + ")",
      trials_by_technique(block.trials, ""));
  if (block.modulus)
    text += fmt::format(" A standard of {:g} g with the number {:g} was shown first.",
                        block.modulus->mass_g, block.modulus->value);
  return text;
}

std::string in_words_of_sets(const Judgment::Block& block) {
  const int n = block.most_cubes();
  return fmt::format(
      "They answered a question ({}) about {} of {} g in each trial ({} for each {}, in random "
      "order).",
      block.asks, n == 1 ? "one cube" : fmt::format("{} cubes", n), listed_g(block.masses_g),
      trials_by_technique(block.trials, ""), n == 1 ? "mass" : "set of cubes");
}

std::string in_words(const Adjustment::Block& block) {
  return fmt::format(
      "They adjusted the mass of one of two cubes until it seemed as heavy as the other, of {} g "
      "({} for each reference, in random order). It began at a random mass from {:g} to {:g} g and "
      "changed by {:g} or {:g} g at each step, between {:g} and {:g} g.",
      listed_g(block.reference_g.values), trials_by_technique(block.trials, ""), block.start_g[0],
      block.start_g[1], block.steps_g[0], block.steps_g[1], block.lowest_g(), block.highest_g());
}

// "each correct choice", "3 correct choices in a row"
std::string successive(int n, std::string what) {
  if (n == 1) return fmt::format("each {}", what);
  for (const std::string_view noun : {"choice", "answer"})
    if (const auto at = what.find(noun); at != std::string::npos)
      what.insert(at + noun.size(), 1, 's');
  return fmt::format("{} {} in a row", n, what);
}

// The rule that several up-down staircases share: all but reference, start and steps.
std::string rule_of(const UpDownConfig& rule, const Comparison::Block& block) {
  const bool correct = block.positive_answer == PositiveAnswer::correct_choice;
  const bool same = block.answers == ComparisonAnswers::same_different;
  const std::string down = same                ? "answer \"different\""
                           : block.is_forced() ? "choice of the comparison"
                           : correct           ? "correct choice"
                                               : "choice of either cube";
  const std::string up = same                ? "answer \"same\""
                         : block.is_forced() ? "choice of the reference"
                         : correct           ? "incorrect choice or \"no difference\""
                                             : "answer \"no difference\"";
  std::string text = fmt::format("The difference decreased after {} and increased after {}",
                                 successive(rule.down, down), successive(rule.up, up));
  if (rule.initial_1up1down) text += " (until the first reversal after each answer)";
  if (rule.floor && rule.ceiling)
    text += fmt::format(", between {:g} and {:g} g", *rule.floor, *rule.ceiling);
  else if (rule.floor || rule.ceiling)
    text += fmt::format(", {} {:g} g", rule.floor ? "from" : "up to",
                        rule.floor ? *rule.floor : *rule.ceiling);
  text += fmt::format(". A staircase ended after {}, or after {}",
                      counted(rule.stop_reversals, "reversal"), counted(rule.stop_trials, "trial"));
  if (!block.has_three_answers()) return text + ".";
  return text + "; its JND is the mean difference at all reversals" +
         (rule.discard_reversals == 0 ? "."
                                      : fmt::format(" but the first {}.", rule.discard_reversals));
}

// "Psi (Kontsevich & Tyler, 1999): function indecision, ..."
std::string bayesian(std::string settings, Source source, Citations& citations) {
  constexpr std::string_view no_width = ", interval width none";
  if (const auto place = settings.find(no_width); place != std::string::npos)
    settings.erase(place, no_width.size());
  const auto end = settings.find(',');
  const std::string rest = end == std::string::npos ? "" : settings.substr(end + 1);
  return fmt::format("{} ({}):{}", settings.substr(0, end), citations.cite(source), rest);
}

// A kind of procedure that is not up-down, with its settings.
std::string other_kind(const Procedure& procedure, Citations& citations) {
  const std::string settings = ProcedureKinds::described(procedure);
  if (procedure.get_if<Constant>()) return "the method of constant stimuli: " + settings;
  if (procedure.get_if<Quest>()) return bayesian(settings, Source::quest, citations);
  if (procedure.get_if<QuestPlus>()) return bayesian(settings, Source::quest_plus, citations);
  if (procedure.get_if<Psi>()) return bayesian(settings, Source::psi, citations);
  return settings;
}

// The procedure that set the mass in a judgment's trials.
std::string by_procedure(const ReferenceStaircase& one, Citations& citations) {
  std::string text = one.reference_g > 0 ? fmt::format("at {:g} g ", one.reference_g) : "";
  if (const UpDown* up_down = one.staircase.get_if<UpDown>())
    text +=
        fmt::format("by an up-down staircase ({}), {}: {}",
                    citations.cite(up_down->config().steps_up.empty() ? Source::up_down
                                                                      : Source::weighted_up_down),
                    up_down->config().course("g"), ProcedureKinds::described(one.staircase));
  else
    text += "by " + other_kind(one.staircase, citations);
  return one.condition.empty() ? text : text + " (in " + one.condition + ")";
}

std::string in_words(const Judgment::Block& block, Citations& citations) {
  if (block.staircases.empty()) return in_words_of_sets(block);
  std::vector<std::string> each;
  for (const ReferenceStaircase& one : block.staircases)
    each.push_back(by_procedure(one, citations));
  return fmt::format(
      "They answered a question ({}) about {} in {}. The {} was set {}.", block.asks,
      block.has_reference() ? "a reference and a comparison on random sides" : "one cube",
      block.condition, block.has_reference() ? "difference in mass" : "mass",
      fmt::join(each, "; "));
}

std::string course_of(const ReferenceStaircase& one, const UpDownConfig& config) {
  return fmt::format("{:g} g{} {}", one.reference_g,
                     one.condition.empty() ? "" : " in " + one.condition, config.course("g"));
}

std::string staircases_in_words(const Comparison::Block& block, Citations& citations) {
  std::map<std::string, std::vector<std::string>> courses;  // by rule
  std::vector<std::string> rules, others;                   // in their order
  bool is_weighted = false;
  for (const ReferenceStaircase& one : block.staircases) {
    const UpDown* up_down = one.staircase.get_if<UpDown>();
    if (!up_down) {
      others.push_back(
          fmt::format("at {:g} g by {}", one.reference_g, other_kind(one.staircase, citations)));
      continue;
    }
    const UpDownConfig& config = up_down->config();
    is_weighted = is_weighted || !config.steps_up.empty();
    const std::string rule = rule_of(config, block);
    if (!courses.contains(rule)) rules.push_back(rule);
    courses[rule].push_back(course_of(one, config));
  }
  std::string text;
  for (const std::string& rule : rules)
    text += fmt::format(" The difference in mass followed {} up-down staircase{} ({}): {}. {}",
                        courses[rule].size(), courses[rule].size() == 1 ? "" : "s",
                        citations.cite(is_weighted ? Source::weighted_up_down : Source::up_down),
                        fmt::join(courses[rule], "; "), rule);
  for (const std::string& other : others)
    text += fmt::format(" Differences in mass were chosen {}.", other);
  return text;
}

std::string_view order_in_words(Interleave interleave) {
  if (interleave == Interleave::random) return "in random order";
  return interleave == Interleave::round_robin ? "in turn" : "one after the other";
}

std::string in_words(const Comparison::Block& block, Citations& citations) {
  std::string text =
      block.reference
          ? fmt::format("They lifted a real object ({}, {:g} g), compared a cube in {} with it,",
                        block.reference->name, block.reference->mass_g, block.condition)
          : fmt::format("They compared two cubes in {}, a reference and a comparison on {} sides,",
                        block.condition, block.sides == Sides::random ? "random" : "balanced");
  text += fmt::format(" and {}.", block.is_forced() ? "chose the heavier one"
                                  : block.has_three_answers()
                                      ? "answered which one was heavier, or \"no difference\""
                                      : "answered whether they were equally heavy, \"same\" or "
                                        "\"different\"");
  text += staircases_in_words(block, citations);
  if (block.staircases.size() > 1)
    text +=
        fmt::format(" The staircases were run {}.", order_in_words(block.interleaving.interleave));
  std::vector<std::string> catches;
  for (const auto& [reference_g, trials] : block.catch_trials)
    catches.push_back(fmt::format("{} at {:g} g", trials, reference_g));
  if (!catches.empty())
    text += fmt::format(" Two equal cubes were shown in catch trials ({}).", listed(catches));
  else if (block.catch_fraction > 0)
    text += fmt::format(" Two equal cubes were shown in catch trials, {:g} % of all.",
                        100 * block.catch_fraction);
  return text;
}

struct InWords {
  Citations& citations;

  std::string operator()(const DemonstrationBlock& block) const {
    return fmt::format("A demonstration of {:g} s was shown.", block.duration_s);
  }
  std::string operator()(const BreakBlock& block) const {
    return fmt::format("A break of at least {:g} s followed.", block.least_duration_s);
  }
  std::string operator()(const TaskBlock& block) const {
    std::string text = trials_of(block);
    if (block.practice)
      text += fmt::format(" Practice came first: {}.", block.practice->in_words());
    return text;
  }
  std::string trials_of(const TaskBlock& block) const {
    if (const auto* introduction = block.as<Introduction::Block>()) return in_words(*introduction);
    if (const auto* sorting = block.as<Sorting::Block>()) return in_words(*sorting);
    if (const auto* estimation = block.as<Estimation::Block>()) return in_words(*estimation);
    if (const auto* judgment = block.as<Judgment::Block>()) return in_words(*judgment, citations);
    if (const auto* adjustment = block.as<Adjustment::Block>()) return in_words(*adjustment);
    if (const auto* comparison = block.as<Comparison::Block>())
      return in_words(*comparison, citations);
    return fmt::format("Task \"{}\": {}.", block.name(), block.task().about);
  }
};
}  // namespace

std::string tasks_in_words(const Protocol& protocol, Citations& citations) {
  std::vector<std::string> sentences;
  for (const Block& block : protocol.blocks)
    sentences.push_back(std::visit(InWords{citations}, block));
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace heft
