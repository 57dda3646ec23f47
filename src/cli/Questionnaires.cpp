#include "cli/Questionnaires.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "base/Error.h"
#include "base/TextFile.h"
#include "cli/Installation.h"
#include "experiment/ScreenTexts.h"
#include "experiment/SessionConfig.h"
#include "protocol/Files.h"
#include "protocol/Protocol.h"

namespace heft::cli {

namespace {
namespace fs = std::filesystem;

struct Places {
  fs::path beside, shipped;
};

Places places_of(const std::string& file, const std::string& protocol_file) {
  const fs::path texts = installed_file("protocols/texts/en.toml");
  return {fs::path(protocol_file).parent_path() / file,
          texts.parent_path().parent_path() / "questionnaires" / file};
}

std::optional<std::string> found_at(const Places& places) {
  std::error_code unknown;
  for (const fs::path& path : {places.beside, places.shipped})
    if (fs::exists(path, unknown)) return path.string();
  return std::nullopt;
}

// The texts of a session with the questionnaires below them, and which file each came from.
class Gathered {
 public:
  explicit Gathered(SessionConfig& setup) : setup_(setup) {
    const ScreenTexts texts = parse_texts(setup.texts_text, setup.texts_file);
    language_ = texts.language;
    for (const auto& [name, questionnaire] : texts.questionnaires)
      file_of_[name] = setup.texts_file;
  }

  void add(const std::string& name) {
    const auto held = file_of_.find(name);
    if (held != file_of_.end() && held->second == setup_.texts_file) return;
    const Places places =
        places_of(fmt::format("{}.{}.toml", name, language_), setup_.protocol_file);
    const auto file = found_at(places);
    if (held != file_of_.end() && (!file || *file == held->second)) return;
    if (!file) refuse_missing(places);
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
        throw Error(fmt::format("{} and {} both have a [questionnaire.{}], expected one: give one "
                                "of them another name",
                                other->second, file, held),
                    ExitCode::invalid_file);
    setup_.texts_text += '\n';
    setup_.texts_text += without_byte_order_mark(text);
  }

  [[noreturn]] static void refuse_missing(const Places& places) {
    throw Error(
        fmt::format("the protocol asks a questionnaire, and there is neither {} nor {}; write "
                    "it, or put its [questionnaire] into the text file",
                    places.beside.string(), places.shipped.string()),
        ExitCode::usage);
  }

  SessionConfig& setup_;
  std::string language_;
  std::map<std::string, std::string> file_of_;
};
}  // namespace

std::map<std::string, std::string> add_questionnaires(SessionConfig& setup,
                                                      const Protocol& protocol,
                                                      const std::string& texts_file) {
  const std::set<std::string> asked = questionnaires_of(protocol);
  if (asked.empty()) return {};
  if (setup.texts_text.empty()) {
    setup.texts_file = fs::absolute(texts_file).lexically_normal().string();
    setup.texts_text = read_text_file(setup.texts_file);
  }
  Gathered gathered(setup);
  for (const std::string& name : asked) gathered.add(name);
  return gathered.file_of();
}

}  // namespace heft::cli
