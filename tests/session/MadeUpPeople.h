// A simulated participant at a simulated screen, and a simulated experimenter.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <thread>
#include <vector>

#include "base/Clock.h"
#include "session/Console.h"
#include "view/ArView.h"

namespace heft::testing {

// Answers each presented screen by a function; keeps the presented screens.
class MadeUpScreen final : public ArView {
 public:
  using Person = std::function<std::vector<Touch>(const ViewFrame&, const ScreenState&)>;
  explicit MadeUpScreen(Person person) : person_(std::move(person)) {}

  std::optional<double> present(const ViewFrame& picture, const ScreenState& screen) override {
    picture_ = picture;
    screen_ = screen;
    screens.push_back(screen);
    return monotonic_s();
  }
  std::vector<Touch> wait(double seconds) override {
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(seconds, 0.002)));
    std::vector<Touch> touches = person_(picture_, screen_);
    for (Touch& touch : touches) {
      touch.monotonic_s = monotonic_s();
      if (touch.page == PageId{}) touch.page = screen_.page();
    }
    return touches;
  }

  std::vector<ScreenState> screens;

 private:
  Person person_;
  ViewFrame picture_;
  ScreenState screen_;
};

inline Touch touch(TouchKind kind) {
  Touch made;
  made.kind = kind;
  return made;
}

inline Touch touch(ActionKind kind, std::optional<int> slot = {}, std::optional<Label> label = {}) {
  Touch made;
  made.action = {std::move(kind), slot, std::move(label)};
  return made;
}

// Turns pages, labels the cubes from left to right, answers "no difference".
inline std::vector<Touch> patient(const ViewFrame& picture, const ScreenState& screen) {
  if (screen.screen != Screen::trial)
    return screen.wait_s > 0 ? std::vector<Touch>{} : std::vector{touch(TouchKind::next)};
  if (picture.frame.cubes.empty() || !screen.can_answer) return {};
  if (screen.task == "introduction") return {touch("select", 1 + screen.n_choices % 2)};
  if (screen.task == "comparison") return {touch("no_difference")};
  if (screen.can_validate) return {touch("validate")};
  return {touch("label", 1, "lightest"), touch("label", 2, "intermediate"),
          touch("label", 3, "heaviest")};
}

class MadeUpConsole : public Console {
 public:
  std::optional<ConsoleCommand> command() override {
    if (commands.empty()) return std::nullopt;
    ConsoleCommand next = commands.front();
    commands.pop_front();
    return next;
  }
  void show(const ConsoleStatus& status) override {
    shown.push_back(status);
    if (on_show) on_show(status);
  }
  bool ask_to_continue(const std::string& question) override {
    asked.push_back(question);
    if (answer) commands.push_back({*answer, {}});
    return answer.has_value();
  }
  void say(const std::string& text) override { said.push_back(text); }

  std::deque<ConsoleCommand> commands;
  std::vector<ConsoleStatus> shown;
  std::vector<std::string> said, asked;
  std::optional<ConsoleCommandKind> answer;  // to whether to go on; none: nobody answers
  std::function<void(const ConsoleStatus&)> on_show;
};

}  // namespace heft::testing
