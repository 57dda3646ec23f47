// Randomly damaged files are either accepted or refused with the places of the mistakes.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "EditedFile.h"
#include "SourceFolder.h"
#include "physics/scene/Scene.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "psychophysics/Interleaving.h"
#include "tracking/detection/MarkerBody.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {
namespace {

void damage(std::string& text) {
  const auto at = [&] { return *rc::gen::inRange<std::size_t>(0, text.size() + 1); };
  const auto line_start = [&] {
    const auto end = text.rfind('\n', at());
    return end == std::string::npos ? 0 : end + 1;
  };
  const auto line_length = [&](std::size_t begin) {
    return std::min(text.find('\n', begin), text.size() - 1) + 1 - begin;
  };
  const std::string value = *rc::gen::element<std::string>(
      "nan", "-inf", "-1", "0", "1e999", "99999999999999999999", "\"\"", "[]", "{}", "true",
      "1979-05-27", "[[", "\"\\u0000\"", "\xff", "'''", "=", "a.b.c = 1\n", "[a]\n", "[[block]]\n");
  if (text.empty()) return;
  switch (*rc::gen::inRange(0, 6)) {
    case 0:
      text[std::min(at(), text.size() - 1)] = *rc::gen::arbitrary<char>();
      break;
    case 1: {
      const auto begin = line_start();
      text.erase(begin, line_length(begin));
      break;
    }
    case 2: {
      const auto begin = line_start();
      text.insert(begin, text.substr(begin, line_length(begin)));
      break;
    }
    case 3: {  // another value
      const auto equals = text.find("= ", at());
      if (equals == std::string::npos) break;
      text.replace(equals + 2, line_length(equals + 2) - 1, value);
      break;
    }
    case 4:
      text.insert(at(), value);
      break;
    default:
      text.resize(at());
  }
}

void expect_taken_or_refused(const std::function<void()>& parse) {
  try {
    parse();
  } catch (const InvalidFile& error) {
    RC_ASSERT(!error.mistakes().empty());
    for (const Mistake& mistake : error.mistakes()) {
      RC_ASSERT(mistake.place.line > 0);
      RC_ASSERT(mistake.place.column > 0);
      RC_ASSERT(!mistake.message.empty());
      RC_ASSERT(mistake.message.find('\n') == std::string::npos);
    }
  }
}

TEST(HostileFile, OfDeepKeysIsRefused) {
  std::string text = "[[staircase]]\na";
  for (int i = 0; i < 200'000; ++i) text += ".a";
  EXPECT_EQ(mistakes_of([&] { parse_procedure(text + " = 1\n", "x.toml"); }).size(), 1u);
}

TEST(HostileFile, OfNestedArraysIsRefused) {
  const std::string text = "a = " + std::string(200'000, '[');
  EXPECT_EQ(mistakes_of([&] { parse_procedure(text, "x.toml"); }).size(), 1u);
}

TEST(HostileFile, OfManyHugeNumbersIsRefused) {
  std::string text;
  for (int i = 0; i < 500; ++i) text.append("a").append(std::to_string(i)).append(" = 1e999\n");
  EXPECT_FALSE(mistakes_of([&] { parse_procedure(text, "x.toml"); }).empty());
}

RC_GTEST_PROP(DamagedFile, IsAcceptedOrRefusedWithPlaces, ()) {
  std::string text = content_of(shipped_path(*rc::gen::elementOf(shipped_protocols())));
  const int n = *rc::gen::inRange(1, 6);
  for (int i = 0; i < n; ++i) damage(text);
  expect_taken_or_refused([&] { parse_protocol(text, "x.toml"); });
  expect_taken_or_refused([&] { parse_procedure(text, "x.toml"); });
  expect_taken_or_refused([&] { parse_scene(text, "x.toml"); });
}

RC_GTEST_PROP(DamagedFile, OfTagsIsAcceptedOrRefusedWithPlaces, ()) {
  const std::string folder = source_folder() + "/protocols/apparatus/";
  const std::string effector = content_of(folder + "effector.toml");
  std::string text = *rc::gen::element(
      content_of(folder + "board.toml"), content_of(folder + "synthetic_camera.toml"), effector,
      effector_to_toml(parse_effector(effector, "effector.toml"), "with a [[tag]] each"));
  const int n = *rc::gen::inRange(1, 6);
  for (int i = 0; i < n; ++i) damage(text);
  expect_taken_or_refused([&] { parse_board(text, "x.toml"); });
  expect_taken_or_refused([&] { parse_effector(text, "x.toml"); });
  expect_taken_or_refused([&] { parse_synthetic_camera(text, "x.toml"); });
}

// The expected length of an accepted protocol is finite, and its trials fit the area.
RC_GTEST_PROP(DamagedFile, IsUsableIfAccepted, ()) {
  std::string text = content_of(shipped_path(*rc::gen::elementOf(shipped_protocols())));
  damage(text);
  Protocol protocol;
  try {
    protocol = parse_protocol(text, "x.toml");
  } catch (const InvalidFile&) {
    return;
  }
  RC_ASSERT(!protocol.blocks.empty());
  RC_ASSERT(std::isfinite(expected_minutes(protocol, expected_trials(protocol))));
  for (const auto& slot : slot_positions(protocol.layout, 2))
    RC_ASSERT(std::abs(slot.x()) <= protocol.layout.area_m.x() / 2);
}

}  // namespace
}  // namespace heft
