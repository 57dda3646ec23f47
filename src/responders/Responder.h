// A responder has a hand and a decision model. The hand gives the effector's pose over time; the
// decision model receives displayed frames and answers with actions. Neither gets a mass, a force
// or a condition, with two exceptions: the mass of a real object, which is lifted, and null models
// that declare that they do not look (TrialTruth). Responder.cpp has the table of all responders.
//
// Responders keep no memory between trials, and draw from streams keyed by trial number and
// attempt, so that a trial interrupted by a crash is repeated exactly.
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

struct ResponderParameters;

/// What no participant sees of a trial: masses, and in comparisons the level and the first level of
/// its procedure. Only for null models, which state how answers would look without perception.
struct TrialTruth {
  std::vector<double> masses_g;  ///< by slot, leftmost first, at the trial's start
  std::optional<double> level_g, start_g;
};

/// The participant's view of a trial at its start.
struct TrialView {
  int trial_number = 0;
  int attempt = 1;
  Task task;
  Stage stage;
  std::any offer = {};  ///< the task's
  /// Whether the last completed trial's answer was that the cubes differ; none: it has no such
  /// answer, was vetoed, or this is the first trial.
  std::optional<bool> last_differed = {};
  std::optional<TrialTruth> truth = {};  ///< none unless the responder knows_plan()
  std::optional<double> lifted_g = {};   ///< mass of a real object that the participant lifts
  int n_reshuffles = 0;                  ///< how often the cubes were shuffled or replaced
};

struct HandSample {
  Pose pose;            ///< of the effector's center
  bool in_view = true;  ///< false: put down, out of the camera's view
};

class Responder {
 public:
  virtual ~Responder() = default;

  virtual void begin_trial(const TrialView& trial) = 0;

  /// An answer has shuffled or replaced the cubes of the open trial.
  /// @param trial with what is offered now
  virtual void see_rearranged(const TrialView& trial [[maybe_unused]]) {}

  /// The effector at a time since the trial's start. Times do not decrease between calls.
  virtual HandSample hand(double t_s) = 0;

  /// Processes one displayed frame and the screen beside it, in order of time.
  /// @return actions after this frame and before the next, in order; times since the trial's start,
  ///   within [frame.t_s, frame.t_s + 1/display rate)
  virtual std::vector<TimedAction> see(const DisplayedFrame& frame, const ScreenState& screen) = 0;

  /// False if no action is left although the trial is open (a recording that has ended): the runner
  /// then stops the session instead of waiting forever.
  virtual bool has_more(double t_s) const = 0;

  /// The decision model's answer to a trial with these frames, whichever hand moved the effector.
  /// Does not affect the current trial.
  /// @param wrong_slots incorrect choices so far, oldest first, if the task asks again
  /// @return none: no answer to this trial
  virtual std::optional<Answer> judge(const TrialView& trial [[maybe_unused]],
                                      std::span<const DisplayedFrame> frames [[maybe_unused]],
                                      std::span<const int> wrong_slots
                                      [[maybe_unused]] = {}) const {
    return std::nullopt;
  }

  /// Whether its answers depend on the plan and not on what is displayed.
  virtual bool knows_plan() const { return false; }

  /// The parameters of its hand; null: the hand rests, or does not follow from parameters.
  virtual const ResponderParameters* hand_parameters() const { return nullptr; }

  /// The answer to a question of a questionnaire.
  /// @param key in the log; differs each time the question is asked
  /// @return none: left unanswered
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
  /// @throws InvalidFile naming each unknown or invalid parameter at its place, with the most
  ///   similar valid name; Error if a folder lacks a required file
  std::unique_ptr<Responder> (*make)(const ResponderOptions& options);
  std::span<const ParameterPart> parts;  ///< parts whose parameters its file may set
  bool touches_cubes = true;             ///< false: its hand rests
};

std::span<const ResponderEntry> responders();

/// Its parameters, one per line: name, default, unit, range, spread, reason. Empty: none.
std::string describe_parameters(const ResponderEntry& responder);

/// @throws Error (usage) suggesting the most similar responder if there is none of that name
const ResponderEntry& responder_named(std::string_view name);

/// The random stream of one attempt at a trial; the same if the attempt is repeated, a different
/// one after the cubes were rearranged.
inline RandomStream trial_stream(std::uint64_t seed, std::string_view purpose,
                                 const TrialView& trial) {
  std::string stream(purpose);
  if (trial.n_reshuffles > 0) stream.append("/").append(std::to_string(trial.n_reshuffles));
  return {seed, stream, static_cast<std::uint64_t>(trial.trial_number),
          static_cast<std::uint64_t>(trial.attempt)};
}

// Functions of the table.

/// Hand, eye and decision combined. Looks at every cube, returns, answers; looks again when asked
/// to try again or when an answer was refused.
std::unique_ptr<Responder> make_simulated(const ResponderOptions& options);

/// The same hand with an observer who uses the displayed poses exactly and decides without noise:
/// with an equal criterion, no other model answers better from the frames.
std::unique_ptr<Responder> make_ideal(const ResponderOptions& options);

/// Plays back a recording: a real hand's trajectories and timed actions.
/// @throws Error and InvalidFile as load_recording; at a trial's start, if the recording lacks that
///   trial or has an action that its task does not offer
std::unique_ptr<Responder> make_scripted(const ResponderOptions& options);

// Baselines: the hand rests, and answers do not depend on the cubes.
std::unique_ptr<Responder> make_always_yes(const ResponderOptions& options);
std::unique_ptr<Responder> make_always_no(const ResponderOptions& options);
std::unique_ptr<Responder> make_coin(const ResponderOptions& options);
std::unique_ptr<Responder> make_criterion_only(const ResponderOptions& options);

// Null models that know the plan: the hand rests, too.
std::unique_ptr<Responder> make_start_anchored(const ResponderOptions& options);
std::unique_ptr<Responder> make_weber(const ResponderOptions& options);

}  // namespace heft
