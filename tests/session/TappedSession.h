// A person's whole session on pages under simulated fingers, with the rules of onset.
#pragma once

#include <array>

#include "base/Random.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "session/TappedScreen.h"

namespace heft::testing {

inline constexpr double gap_s = 0.6, min_answer_s = 0.5;

/// Windows of the tests that tap in several ones.
inline const std::array tapped_windows{Measures{1024, 600}, Measures{1280, 800, 1.3f},
                                       Measures{1920, 1080, 0.8f}, Measures{800, 480}};

/// A tap soon, in the middle of a control or at a fraction of its width.
inline Tap tap_on(const Control& control, RandomStream& random, double along = 0.5) {
  const double down_s = made_up_s + 0.2 + 0.4 * random.uniform();
  const Rect& area = control.area;
  return {down_s, down_s + 0.05, area.x + static_cast<float>(along) * area.width,
          area.y + area.height / 2};
}

/// None if there is no control or it takes no tap.
inline std::optional<Tap> tap_on(const Control* control, RandomStream& random, double along = 0.5) {
  return control && control->enabled ? std::optional(tap_on(*control, random, along))
                                     : std::nullopt;
}

/// The control that continues from a page without a trial.
inline const Control* onwards(const TappedScreen& screen) {
  return screen.control(screen.control("more") ? "more" : "next");
}

/// One block of trials, without consent and other pages.
inline Protocol protocol_alone(Block block) {
  Protocol protocol = small_protocol();
  protocol.display_rate_hz = 15;
  protocol.screens = {"en", false, false, false};
  protocol.blocks = {std::move(block)};
  return protocol;
}

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

  RunEnd run() { return run_into(sink); }
  RunEnd run_into(EventSink& log) {
    return Runner(
               {*protocol, engine, log, pictures, *hand, screen, clock, true, &texts, {}, before},
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
  ResumeState before;  ///< of a session that continues
};

}  // namespace heft::testing
