#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <vector>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Error.h"
#include "base/Names.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "experiment/ScreenTexts.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"

namespace heft {

namespace {
namespace fs = std::filesystem;

// Possible places of a questionnaire's file: beside the protocol, or installed with the program.
std::array<std::string, 2> places_of(const std::string& file, const std::string& protocol_file) {
  const fs::path texts = installed_file("protocols/texts/en.toml");
  return {(fs::path(protocol_file).parent_path() / file).string(),
          (texts.parent_path().parent_path() / "questionnaires" / file).string()};
}

// A session's texts with its questionnaires and their files.
class Gathered {
 public:
  Gathered(ConfigFile& texts, const std::string& protocol_file)
      : texts_(texts), protocol_file_(protocol_file) {
    const ScreenTexts read = parse_texts(texts.text, texts.path);
    language_ = read.language;
    for (const auto& [name, questionnaire] : read.questionnaires) file_of_[name] = texts.path;
  }

  void add(const std::string& name) {
    const auto held = file_of_.find(name);
    if (held != file_of_.end() && held->second == texts_.path) return;
    const auto places = places_of(fmt::format("{}.{}.toml", name, language_), protocol_file_);
    std::error_code unknown;
    const auto file = std::ranges::find_if(
        places, [&](const std::string& place) { return fs::exists(place, unknown); });
    if (held != file_of_.end() && (file == places.end() || *file == held->second)) return;
    if (file == places.end())
      throw Error(
          fmt::format("the protocol uses a questionnaire, but neither {} nor {} exists; write "
                      "one, or put its [questionnaire] into the text file",
                      places.front(), places.back()),
          ExitCode::usage);
    add(name, *file);
  }

  const std::map<std::string, std::string>& file_of() const { return file_of_; }

 private:
  void add(const std::string& name, const std::string& file) {
    const std::string text = read_text_file(file);
    const ScreenTexts read = parse_questionnaires(text, file);
    if (!read.questionnaires.contains(name))
      throw Error(fmt::format("{} has no [questionnaire.{}]", file, name), ExitCode::invalid_file);
    for (const auto& [held, questionnaire] : read.questionnaires)
      if (const auto [other, is_new] = file_of_.emplace(held, file); !is_new)
        throw Error(fmt::format("{} and {} both have a [questionnaire.{}]; give one "
                                "of them another name",
                                other->second, file, held),
                    ExitCode::invalid_file);
    texts_.text += '\n';
    texts_.text += without_byte_order_mark(text);
    texts_.sha256 = sha256(texts_.text);
  }

  ConfigFile& texts_;
  const std::string& protocol_file_;
  std::string language_;
  std::map<std::string, std::string> file_of_;
};
}  // namespace

std::string texts_file(const std::string& language) {
  if (language.ends_with(".toml")) return language;
  const fs::path folder = fs::path(installed_file("protocols/texts/en.toml")).parent_path();
  std::vector<std::string> shipped;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") shipped.push_back(entry.path().stem().string());
  std::ranges::sort(shipped);
  if (std::ranges::find(shipped, language) == shipped.end())
    throw unknown_name("language", language,
                       std::vector<std::string_view>(shipped.begin(), shipped.end()));
  return (folder / (language + ".toml")).string();
}

std::map<std::string, std::string> add_questionnaires(ConfigFile& texts,
                                                      const std::string& protocol_file,
                                                      const Protocol& protocol) {
  const std::set<std::string> asked = questionnaires_of(protocol);
  if (asked.empty()) return {};
  Gathered gathered(texts, protocol_file);
  for (const std::string& name : asked) gathered.add(name);
  return gathered.file_of();
}

}  // namespace heft
