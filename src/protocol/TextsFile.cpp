#include <fmt/format.h>

#include <array>
#include <sstream>

#include "base/TextFile.h"
#include "experiment/ScreenTexts.h"
#include "protocol/Files.h"
#include "protocol/TableReader.h"

namespace heft {

namespace {
struct PageKeys {
  std::string_view page, keys;       ///< keys: parted by spaces
  std::string_view later_keys = {};  ///< may be missing: there are texts from before them
};

constexpr std::array required_pages{
    PageKeys{"buttons", "start next back skip more finish put_cubes_back"},
    PageKeys{"slots", "left middle right"},
    PageKeys{"consent", "title text agree decline"},
    PageKeys{"welcome", "title text"},
    PageKeys{"about_you",
             "title age age_under_18 age_18_24 age_25_34 age_35_44 age_45_54 age_55_or_more gender "
             "gender_woman gender_man gender_other gender_not_said handedness handedness_right "
             "handedness_left handedness_both eyesight eyesight_unaided eyesight_glasses "
             "eyesight_lenses ar_experience ar_experience_never ar_experience_once_or_twice "
             "ar_experience_several_times ar_experience_often"},
    PageKeys{"demonstration", "title text"},
    PageKeys{"instructions_introduction", "title text"},
    PageKeys{"instructions_sorting", "title text"},
    PageKeys{"instructions_comparison", "title text"},
    PageKeys{"trial", "wait_for_cubes touch_every_cube", "next_cubes drag_effector"},
    PageKeys{"trial_introduction", "question try_again"},
    PageKeys{"trial_sorting",
             "question tap_a_cube lightest intermediate heaviest validate dont_know"},
    PageKeys{"trial_comparison", "question no_difference"},
    PageKeys{"rest", "title text time_left"},
    PageKeys{"paused", "title text"},
    PageKeys{"how_decided",
             "title basis basis_seen basis_felt basis_both basis_guessed certainty certainty_very "
             "certainty_fairly certainty_little certainty_none movement movement_slow "
             "movement_fast movement_varied movement_unaware"},
    PageKeys{"thanks", "title text"}};
/// May be missing, too.
constexpr std::array later_pages{PageKeys{"declined", "title text take_back leave"},
                                 PageKeys{"setting_up", "title text"}};

std::string trimmed(const std::string& text) {
  std::string kept;
  for (const char c : text)
    if (c != '\r') kept += c;
  const auto first = kept.find_first_not_of(" \t\n");
  if (first == std::string::npos) return {};
  return kept.substr(first, kept.find_last_not_of(" \t\n") - first + 1);
}

std::string read_text(TableReader& table, std::string_view key) {
  std::string text;
  table.require({key});
  table.read(key, text);
  text = trimmed(text);
  if (text.empty() && table.has(key) && table.good({key}))
    table.mistake(key, fmt::format("{} is empty, expected what participants read there", key));
  return text;
}

std::map<std::string, std::string> read_page(TableReader& table, const PageKeys& keys) {
  std::map<std::string, std::string> texts;
  std::istringstream words{std::string(keys.keys)}, later{std::string(keys.later_keys)};
  for (std::string key; words >> key;) texts.emplace(key, read_text(table, key));
  for (std::string key; later >> key;)
    if (table.has(key)) texts.emplace(key, read_text(table, key));
  table.close();
  return texts;
}
}  // namespace

ScreenTexts parse_texts(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  ScreenTexts texts;
  texts.language = read_text(reader, "language");
  for (const PageKeys& keys : required_pages) {
    reader.require({keys.page});
    if (auto table = reader.table(keys.page))
      texts.pages.emplace(keys.page, read_page(*table, keys));
  }
  for (const PageKeys& keys : later_pages)
    if (auto table = reader.table(keys.page))
      texts.pages.emplace(keys.page, read_page(*table, keys));
  reader.close();
  mistakes.throw_if_any();
  return texts;
}

ScreenTexts load_texts(const std::string& path) {
  return parse_texts(read_text_file(path), path);
}

std::string page_text(const ScreenTexts& texts, const std::string& page) {
  std::string all = "language: " + texts.language;
  for (const auto& [key, text] : texts.pages.at(page)) all += fmt::format("\n\n{}: {}", key, text);
  return all + '\n';
}

}  // namespace heft
