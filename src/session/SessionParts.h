// What a session is run with.
#pragma once

#include <atomic>
#include <functional>

#include "apparatus/PictureSource.h"
#include "engine/Engine.h"
#include "record/EventSink.h"
#include "responders/Responder.h"
#include "session/Desk.h"
#include "view/ArView.h"

namespace heft {

struct SessionParts {
  const Protocol& protocol;
  Engine& engine;
  EventSink& sink;
  PictureSource& pictures;
  Responder& responder;  ///< its mind answers, unless a person does
  ArView& view;
  SessionClock& clock;
  bool has_screen = false;             ///< the view can be looked at and touched
  const ScreenTexts* texts = nullptr;  ///< of the person who answers; null: the responder answers
  Apparatus apparatus = {};  ///< what the demonstration shows; without a board a plain table
};

struct RunnerOptions {
  bool keep_frames = true;
  /// Called after every event, for a progress bar.
  std::function<void(const Engine&)> progress = [](const Engine&) {};
  /// Set from a signal handler to stop at the next picture; the session can be resumed.
  const std::atomic<bool>* stop = nullptr;
  /// What is to be said where there is no desk.
  std::function<void(const std::string&)> tell = [](const std::string&) {};
  Desk* desk = nullptr;  ///< the experimenter's; only on a wall clock
};

}  // namespace heft
