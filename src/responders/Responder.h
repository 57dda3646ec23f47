// A responder is a hand and a mind. The hand gives the effector's pose over time; the mind receives
// what is displayed and answers with actions. Neither ever gets a mass, a force or a condition. One
// table, in Responder.cpp, names them all.
//
// Responders remember nothing from trial to trial, and draw from streams keyed by trial number and
// attempt, so a trial that a crash cut short runs again exactly as it would have.
#pragma once

#include <any>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/Random.h"
#include "experiment/EventPayloads.h"
#include "experiment/Participant.h"
#include "experiment/ScreenState.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Stage.h"
#include "experiment/TrialPlan.h"
#include "tasks/Task.h"

namespace heft {

/// What a participant sees when a trial begins.
struct TrialView {
  int trial_number = 0;
  int attempt = 1;
  Task task;
  Stage stage;
  std::any offer = {};  ///< of the task, before any answer
};

struct HandSample {
  Pose pose;            ///< of the effector's center
  bool in_view = true;  ///< false: put down, out of the camera's view
};

class Responder {
 public:
  virtual ~Responder() = default;

  virtual void begin_trial(const TrialView& trial) = 0;

  /// The effector at a time since the trial's start. Asked for with non-decreasing times.
  virtual HandSample hand(double t_s) = 0;

  /// Takes in one displayed frame and the screen beside it, in order of time.
  /// @return what it does after this frame and before the next, in order; times since the trial's
  ///   start, within [frame.t_s, frame.t_s + 1/display rate)
  virtual std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) = 0;

  /// False when it has nothing left to do in this trial though the trial is still open (a recording
  /// that ended): the runner then stops the session instead of waiting forever.
  virtual bool has_more(double t_s) const = 0;

  /// Its one answer to a whole trial, whoever's hand moved in it: what its mind says to all of
  /// these frames, the first one where the task asks again. Changes nothing of the trial that it is
  /// in.
  /// @return none: it has no answer to this trial
  virtual std::optional<Answer> judge(const TrialView& trial [[maybe_unused]],
                                      std::span<const DisplayedFrame> frames
                                      [[maybe_unused]]) const {
    return std::nullopt;
  }

  /// What it says to a question of a questionnaire.
  /// @param key of the log, another for each time that the question is asked
  /// @return none: it leaves it out
  virtual std::optional<std::string> answer(const FormQuestion& question [[maybe_unused]],
                                            const std::string& key [[maybe_unused]]) const {
    return std::nullopt;
  }
};

/// What follows the colon in NAME:FILE.
enum class ResponderFile { none, parameters, folder };

struct ResponderOptions {
  std::uint64_t seed = 0;             ///< the session's
  std::vector<Parameter> parameters;  ///< for ResponderFile::parameters; empty: the defaults
  std::string folder;                 ///< for ResponderFile::folder
};

enum class ParameterPart;  // in ResponderParameters.h

/// A row of the table of responders.
struct ResponderEntry {
  std::string_view name;
  std::string_view summary;
  ResponderFile file = ResponderFile::none;
  /// @throws InvalidFile naming each unknown or impossible parameter at its place, with the nearest
  ///   valid name; Error where a folder lacks what it must hold
  std::unique_ptr<Responder> (*make)(const ResponderOptions& options);
  std::span<const ParameterPart> parts;  ///< whose parameters its file may set
  bool touches_cubes = true;             ///< its hand does; false: it rests
};

std::span<const ResponderEntry> responders();

/// Its parameters, a line each: name, default, unit, range, spread, reason. Empty: it has none.
std::string describe_parameters(const ResponderEntry& responder);

/// @throws Error (usage) naming the nearest responder when there is none of that name
const ResponderEntry& responder_named(std::string_view name);

/// The random stream of one attempt at a trial: a trial run again draws the same.
inline RandomStream trial_stream(std::uint64_t seed, std::string_view purpose,
                                 const TrialView& trial) {
  return {seed, purpose, static_cast<std::uint64_t>(trial.trial_number),
          static_cast<std::uint64_t>(trial.attempt)};
}

// What the table makes them with.

/// A hand, an eye and a judgment, put together. Looks at every cube, comes back, answers; looks
/// again when told to try again or when an answer was not taken.
std::unique_ptr<Responder> make_simulated(const ResponderOptions& options);

/// Plays a recording back: a real hand's trajectories and timed actions.
/// @throws Error and InvalidFile as load_recording; at a trial's start, where the recording lacks
///   that trial or has an action that its task does not offer
std::unique_ptr<Responder> make_scripted(const ResponderOptions& options);

// Whose hand stays at rest and whose answers owe nothing to what the cubes do: baselines.
std::unique_ptr<Responder> make_always_yes(const ResponderOptions& options);
std::unique_ptr<Responder> make_always_no(const ResponderOptions& options);
std::unique_ptr<Responder> make_coin(const ResponderOptions& options);
std::unique_ptr<Responder> make_criterion_only(const ResponderOptions& options);

}  // namespace heft
