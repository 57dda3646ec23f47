// A person's whole session on pages under simulated fingers, with the rules of onset.
#pragma once

#include <array>
#include <ostream>
#include <string>
#include <vector>

#include "SourceFolder.h"
#include "base/Random.h"
#include "protocol/readers/Files.h"
#include "session/Protocols.h"
#include "session/Recorded.h"
#include "session/Runner.h"
#include "session/TappedScreen.h"

namespace heft::testing {

inline constexpr double gap_s = 0.6, min_answer_s = 0.5;

/// Windows of the tests that tap in several ones.
inline const std::array tapped_windows{Measures{1024, 600}, Measures{1280, 800, 1.3f},
                                       Measures{1920, 1080, 0.8f}, Measures{800, 480}};

/// Where a session is tapped.
struct TappedSetting {
  std::string language;
  Measures window;
  bool left_handed = false;

  bool is_shipped() const { return language == "en" || language == "fr"; }
  /// Shipped texts, or texts of the tests in other scripts.
  ScreenTexts texts() const {
    const char* folder = is_shipped() ? "/protocols/texts/" : "/tests/texts/";
    return load_texts(source_folder() + std::string(folder) + language + ".toml");
  }
};

/// Each language in each window, every other one left-handed.
inline std::vector<TappedSetting> tapped_settings(const std::vector<std::string>& languages = {
                                                      "en", "fr"}) {
  std::vector<TappedSetting> all;
  for (std::size_t i = 0; i < languages.size(); ++i)
    for (std::size_t k = 0; k < tapped_windows.size(); ++k)
      all.push_back({languages[i], tapped_windows[k], (i + k) % 2 == 1});
  return all;
}

inline void PrintTo(const TappedSetting& setting, std::ostream* out) {
  *out << setting.language << ' ' << setting.window.width << " x " << setting.window.height
       << (setting.left_handed ? " left-handed" : "");
}

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

  TappedSession(Protocol made, TappedScreen::NextTap next_tap, const TappedSetting& setting)
      : TappedSession(std::move(made), setting.texts(), std::move(next_tap), setting.window,
                      setting.left_handed) {}

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
