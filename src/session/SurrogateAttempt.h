// The simplest simulation: an attempt at a trial without pictures. The responder's hand plans its
// strokes as always, but every stroke is straight and square, so that clone and cube move along one
// line (simulator "push") and only the displayed frames of that stroke are computed. The responder
// judges them as in a replay, and the engine folds the answer. Between strokes nothing is
// simulated. protocols/README.md compares the figures with those of full sessions.
#pragma once

#include <optional>
#include <vector>

#include "physics/Drive.h"
#include "responders/hand/Hand.h"
#include "session/Journal.h"
#include "session/Runner.h"

namespace heft {

class SurrogateAttempt {
 public:
  SurrogateAttempt(const SessionParts& parts, Journal& journal)
      : parts_(parts), journal_(journal) {}

  /// Runs the trial that is due to its end.
  /// @throws Error if the engine refuses an answer, or the responder gives none
  void run(const TrialPlan& plan);

 private:
  void arrange(const TrialPlan& plan);
  void explore(Hand& hand);
  void push(Hand& hand, DisplayedFrame& frame);
  void end_touch(int cube, double end_s, double now_s);
  void return_cubes(double t_s);
  void act(const Answer& answer);
  const Engine& engine() const { return journal_.engine(); }
  void log(double t_s, EventPayload what);

  /// Touches of the cube in reach.
  struct TouchFacts {
    double since_s = 0, last_s = 0, push_m = 0, lag_m = 0;
    double from_y_m = 0;
  };

  const SessionParts& parts_;
  Journal& journal_;
  double start_s_ = 0;  ///< of the attempt, session time
  double now_s_ = 0;    ///< since then
  double think_s_ = 1, tap_interval_s_ = 0.7;
  Stage stage_;
  Scene scene_;                         ///< of all cubes
  Scene line_;                          ///< of the pushed one
  std::vector<Pose> cubes_;             ///< between strokes
  std::vector<DisplayedFrame> frames_;  ///< in which a cube may be touched
  std::optional<TouchFacts> touch_;
};

}  // namespace heft
