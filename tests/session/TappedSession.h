// A person's whole session on pages under made-up fingers, with the rules of onset in force.
#pragma once

#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "session/TappedScreen.h"

namespace heft::testing {

inline constexpr double gap_s = 0.6, min_answer_s = 0.5;

struct TappedSession {
  TappedSession(Protocol made, ScreenTexts read, TappedScreen::NextTap next_tap,
                Measures window = {1024, 600}, bool left_handed = false)
      : texts(std::move(read)),
        protocol(shared(std::move(made))),
        screen(texts, std::move(next_tap), window, left_handed) {
    SessionConfig setup;
    setup.gap_s = gap_s;
    setup.min_answer_s = min_answer_s;
    engine.apply({0, setup});
  }

  RunEnd run() {
    return Runner(
               {*protocol, engine, sink, pictures, *hand, screen, clock, true, &texts, {}, before},
               {})
        .run();
  }

  ScreenTexts texts;
  std::shared_ptr<const Protocol> protocol;
  Engine engine{protocol, 7};
  RecordedSession sink{SessionHeader{}};
  SessionClock clock = SessionClock::wall_from(0, made_up_monotonic);
  std::unique_ptr<Responder> hand = responder_named("simulated").make({});
  HandPictures pictures{*hand, protocol->display_rate_hz};
  TappedScreen screen;
  ResumeState before;  ///< of a session that goes on
};

}  // namespace heft::testing
