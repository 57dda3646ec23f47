// heft validate: checks protocols, study plans and all other input files, and reports every mistake
// in every file.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <future>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <set>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "cli/reports/Reports.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Stage.h"
#include "physics/auto/Choice.h"
#include "physics/scene/Scene.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "protocol/study/StudyPlan.h"
#include "psychophysics/Interleaving.h"
#include "session/Session.h"
#include "tasks/Task.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft::cli {

namespace {
// The trials of a simulated participant; none if they would be endless.
std::optional<TrialsByTask> simulated_trials(const Protocol& protocol, const std::string& path,
                                             std::uint64_t seed) {
  constexpr int enough_trials = 2000;
  SessionOptions given;
  given.responder = Plug{"simulated"};
  given.protocol_file = path;
  std::atomic<bool> stop = false;
  RunnerOptions options;
  options.keep_frames = false;
  options.stop = &stop;
  options.progress = [&](const Engine& engine) {
    if (engine.n_completed() >= enough_trials) stop = true;
  };
  const RecordedSession session =
      compute_session({resolve(given, protocol, seed), "validate", ""}, options);
  if (stop) return std::nullopt;
  TrialsByTask trials;
  for (const RecordedEntry& entry : session.entries())
    if (const auto* event = std::get_if<RecordedEvent>(&entry))
      if (const auto& trial = event->changes.trial;
          trial && event->event.as<Action>() && trial->status == TrialStatus::completed)
        ++trials[trial->plan.task];
  return trials;
}

struct TrialsOfSome {
  TrialsByTask mean;
  double least = std::numeric_limits<double>::infinity(), most = 0;
};

// Always the same few participants, so that a protocol gets the same numbers each time. None if a
// session is endless, or the protocol's simulator does not model hands (cautions()); with another
// caution if the participants cannot complete it.
std::optional<TrialsOfSome> trials_of_simulated(const Protocol& protocol, const std::string& path,
                                                int participants,
                                                std::vector<std::string>& cautions) try {
  if (!entry_named("simulator", protocol.simulator.name, simulators()).for_sessions)
    return std::nullopt;
  std::vector<std::future<std::optional<TrialsByTask>>> running;
  for (int i = 1; i <= participants; ++i)
    running.push_back(std::async(std::launch::async, simulated_trials, protocol, path,
                                 static_cast<std::uint64_t>(i)));
  TrialsOfSome of_all;
  for (auto& one : running) {
    const std::optional<TrialsByTask> trials = one.get();
    if (!trials) return std::nullopt;
    for (const auto& [task, n] : *trials) of_all.mean[task] += n / participants;
    of_all.least = std::min(of_all.least, total_of(*trials));
    of_all.most = std::max(of_all.most, total_of(*trials));
  }
  return of_all;
} catch (const Error& error) {
  cautions.push_back(fmt::format("a simulated participant cannot complete it: {}", error.what()));
  return std::nullopt;
}

// "comparison 10 s, sorting 25 s"
std::string assumed_text(const Protocol& protocol, const TrialsByTask& trials) {
  std::string text;
  for (const auto& [task, n] : trials)
    text +=
        fmt::format("{}{} {:g} s", text.empty() ? "" : ", ", task, assumed_trial_s(protocol, task));
  return text;
}

constexpr const char* power_hint = "\n  what a study can find: heft power";

std::string described(const Protocol& protocol, const std::string& path,
                      std::vector<std::string>& cautions) {
  constexpr int participants = 6;
  TrialsByTask trials = expected_trials(protocol);
  std::string simulated;
  if (depends_on_answers(protocol))
    if (const auto taken = trials_of_simulated(protocol, path, participants, cautions)) {
      trials = taken->mean;
      simulated = fmt::format(" ({:.0f} to {:.0f} in {} simulated participants)", taken->least,
                              taken->most, participants);
    }
  std::string text =
      fmt::format("about {}{} and {:.0f} min\n  assuming a trial of {}",
                  counted(std::lround(total_of(trials)), "trial"), simulated,
                  expected_minutes(protocol, trials), assumed_text(protocol, trials));
  if (protocol.simulator.name == "auto") text += "\n  " + described(resolve_auto(protocol));
  return text + power_hint;
}

// Summary and cautions of a valid file.
struct Checked {
  std::string summary;
  std::vector<std::string> cautions = {};
  std::vector<Mistake> mistakes = {};  ///< besides those that prevent reading it

  Checked& operator+=(WordFaults words) {
    for (std::string& caution : words.cautions) cautions.push_back(std::move(caution));
    for (Mistake& mistake : words.mistakes) mistakes.push_back(std::move(mistake));
    return *this;
  }
};

std::string described(const ScreenTexts& texts) {
  return fmt::format("{} in the language \"{}\"", counted(std::ssize(texts.pages), "page"),
                     texts.language);
}

std::string described(const DisplayMeasures& display) {
  const double pitch_mm = display.w_mm / display.w_px;
  return fmt::format("{} x {} px on {:g} x {:g} mm, seen from {:g} mm: {:.3g} px/degree",
                     display.w_px, display.h_px, display.w_mm, display.h_mm,
                     display.eye_distance_mm,
                     display.eye_distance_mm * std::numbers::pi / 180 / pitch_mm);
}

// Each group and order, and its number of planned participants.
std::string described(const StudyPlan& plan) {
  std::map<std::pair<int, int>, int> people;
  for (int number = 1; number <= plan.participants; ++number) {
    const StudyPlace place = place_in(plan, number);
    ++people[{place.group, place.order}];
  }
  std::string text = fmt::format("\"{}\", {} participants {} to {}", escaped_line(plan.name),
                                 plan.participants, escaped_line(planned_id(plan, 1)),
                                 escaped_line(planned_id(plan, plan.participants)));
  for (int group = 0; group < static_cast<int>(plan.groups.size()); ++group)
    for (int order = 0; order < static_cast<int>(plan.orders.size()); ++order) {
      const StudyGroup& one = plan.groups[static_cast<std::size_t>(group)];
      const BlockOrder& blocks = plan.orders[static_cast<std::size_t>(order)];
      text += fmt::format("\n  {:>4} with {}{}{}", people[{group, order}],
                          one.name.empty() ? "" : "group " + escaped_line(one.name) + ", ",
                          escaped_line(one.protocol),
                          blocks.empty() ? "" : ": " + escaped_line(heft::described(blocks)));
    }
  return text + power_hint;
}

std::vector<std::string> cautions_of(const StudyPlan& plan) {
  const int n_cells = static_cast<int>(plan.groups.size() * plan.orders.size());
  if (plan.participants % n_cells == 0) return {};
  const int below = plan.participants / n_cells * n_cells;
  return {
      fmt::format("{} participants cannot be divided equally among {} with {} each, expected {}{}",
                  plan.participants, counted(std::ssize(plan.groups), "group"),
                  counted(std::ssize(plan.orders), "order"),
                  below > 0 ? fmt::format("{} or ", below) : "", below + n_cells)};
}

// Checks that the participant's texts exist in the session's language, and can be displayed.
WordFaults check_words(const Protocol& protocol, const std::string& protocol_file,
                       const std::string& language, const std::string& path) {
  try {
    return faults_in_words(protocol, protocol_file, language);
  } catch (const InvalidFile&) {
    throw;
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", path, error.what()), ExitCode::invalid_file);
  }
}

Checked checked(const StudyPlan& plan, const std::string& path) {
  Checked file{described(plan), cautions_of(plan)};
  std::set<std::pair<std::string, std::string>> checked_texts;
  for (const StudyGroup& group : plan.groups) {
    const Protocol protocol = load_protocol(group.protocol);
    const std::string language = group.language.value_or(protocol.screens.language);
    if (checked_texts.insert({group.protocol, language}).second)
      file += check_words(protocol, group.protocol, language, path);
  }
  return file;
}

Checked checked(const Protocol& protocol, const std::string& path) {
  Checked file;
  file += check_words(protocol, path, protocol.screens.language, path);
  for (std::string& caution : cautions(protocol)) file.cautions.push_back(std::move(caution));
  if (file.mistakes.empty()) file.summary = described(protocol, path, file.cautions);
  return file;
}

Checked checked(const ScreenTexts& texts, std::string summary, const std::string& path) {
  Checked file{std::move(summary)};
  return file += faults_in_words(texts, path);
}

// Together with the English texts, with which every questionnaire is shown.
Checked checked_questionnaires(const ScreenTexts& read, const std::string& path) {
  ScreenTexts texts = load_texts(texts_file("en"));
  texts.questionnaires = read.questionnaires;
  for (const auto& [page, words] : read.pages) texts.pages[page] = words;
  return checked(texts, counted(std::ssize(read.questionnaires), "questionnaire"), path);
}

Checked checked(FileKind kind, const std::string& text, const std::string& path) {
  switch (kind) {
    case FileKind::protocol:
      return checked(parse_protocol(text, path), path);
    case FileKind::procedure:
      return {counted(std::ssize(parse_procedure(text, path).staircases), "staircase")};
    case FileKind::scene:
      return {counted(std::ssize(parse_scene(text, path).cubes), "cube")};
    case FileKind::board:
      return {described(parse_board(text, path))};
    case FileKind::effector:
      return {described(parse_effector(text, path))};
    case FileKind::synthetic_camera:
      return {described(parse_synthetic_camera(text, path))};
    case FileKind::questionnaires:
      return checked_questionnaires(parse_questionnaires(text, path), path);
    case FileKind::texts: {
      const ScreenTexts texts = parse_texts(text, path);
      return checked(texts, described(texts), path);
    }
    case FileKind::display:
      return {described(parse_display(text, path))};
    case FileKind::study:
      return checked(parse_study(text, path), path);
  }
  return {};
}

std::string with_article(FileKind kind) {
  return fmt::format("{} {}", kind == FileKind::effector ? "an" : "a", name_of(kind));
}

// Checks one file and prints the result.
ExitCode validate(const std::string& path) {
  try {
    const std::string text = read_text_file(path);
    const FileKind kind = recognized_kind(text, path);
    try {
      const Checked file = checked(kind, text, path);
      if (file.mistakes.empty()) print("{}: ok, {}: {}\n", path, with_article(kind), file.summary);
      for (const std::string& caution : file.cautions) say("{}: {}\n", path, caution);
      if (!file.mistakes.empty()) throw InvalidFile(file.mistakes);
    } catch (const InvalidFile& error) {
      say("{}\n{}: not valid as {}: {}\n", error.what(), path, with_article(kind),
          counted(std::ssize(error.mistakes()), "mistake"));
      return error.exit_code();
    }
  } catch (const Error& error) {
    say("{}\n", error.what());
    return error.exit_code();
  }
  return ExitCode::ok;
}

void validate_all(const std::vector<std::string>& paths) {
  std::size_t n_bad = 0;
  ExitCode worst = ExitCode::ok;
  for (const std::string& path : paths) {
    const ExitCode code = validate(path);
    if (code != ExitCode::ok) ++n_bad;
    worst = std::max(worst, code);
  }
  if (worst != ExitCode::ok)
    throw Error(fmt::format("{} of {} not usable", n_bad, counted(std::ssize(paths), "file")),
                worst);
}
}  // namespace

void add_validate(Command& app) {
  Command command =
      app.add_command("validate", "check protocols, study plans and all other input files",
                      {"heft validate protocols/paper.toml", "heft validate my_study/*.toml"});
  auto paths = std::make_shared<std::vector<std::string>>();
  command.add_option("FILE", paths.get(), "files to check; their kind is recognized").required();
  command.does([paths] { validate_all(*paths); });
}

}  // namespace heft::cli
