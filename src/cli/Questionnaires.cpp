#include "cli/Questionnaires.h"

#include <fmt/format.h>

#include <filesystem>

#include "base/Error.h"
#include "base/TextFile.h"
#include "cli/Installation.h"
#include "experiment/ScreenTexts.h"
#include "experiment/Setup.h"
#include "protocol/Files.h"
#include "protocol/Protocol.h"

namespace heft::cli {

namespace {
std::string questionnaire_file(const std::string& file, const std::string& protocol_file) {
  namespace fs = std::filesystem;
  const fs::path beside = fs::path(protocol_file).parent_path() / file;
  const fs::path shipped =
      fs::path(installed_file("protocols/texts/en.toml")).parent_path().parent_path() /
      "questionnaires" / file;
  std::error_code unknown;
  for (const fs::path& path : {beside, shipped})
    if (fs::exists(path, unknown)) return path.string();
  throw Error(
      fmt::format("the protocol asks a questionnaire, and there is neither {} nor {}; write "
                  "it, or put its [questionnaire] into the text file",
                  beside.string(), shipped.string()),
      ExitCode::usage);
}
}  // namespace

void add_questionnaires(Setup& setup, const Protocol& protocol) {
  if (setup.texts_text.empty()) return;
  for (const auto& [after, names] : protocol.screens.questionnaires)
    for (const std::string& name : names) {
      const ScreenTexts texts = parse_texts(setup.texts_text, setup.texts_file);
      if (texts.questionnaires.contains(name)) continue;
      const std::string file =
          questionnaire_file(fmt::format("{}.{}.toml", name, texts.language), setup.protocol_file);
      const std::string text = read_text_file(file);
      if (!parse_questionnaires(text, file).questionnaires.contains(name))
        throw Error(fmt::format("{} has no [questionnaire.{}]", file, name),
                    ExitCode::invalid_file);
      setup.texts_text += '\n';
      setup.texts_text += without_byte_order_mark(text);
    }
}

}  // namespace heft::cli
