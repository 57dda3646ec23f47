#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "apparatus/configuration/ResolvedConfig.h"
#include "base/Names.h"
#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "cli/SessionOptions.h"
#include "cli/reports/Reports.h"
#include "engine/RunningAttempt.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "tasks/Task.h"
#include "view/screens/TextFit.h"
#include "view/text/Typeface.h"

namespace heft::cli {

namespace {
// Texts that would be hard to read on the smallest screen, one sentence each.
std::vector<std::string> misfits(const ScreenTexts& texts, double text_size) {
  return texts_that_do_not_fit(texts, smallest_screen(text_size));
}

std::string on_smallest_screen(const std::string& sentence) {
  const Measures smallest = smallest_screen();
  return fmt::format("on a screen of {} x {}: {}", smallest.width, smallest.height, sentence);
}

bool has_letter(std::string_view line, char32_t code) {
  return std::ranges::any_of(
      letters_of(line), [&](std::string_view letter) { return first_letter(letter).code == code; });
}

// The line where the character first occurs; 0 if only as an escape.
int line_with(char32_t code, const std::string& file) {
  const std::string text = read_text_file(file);
  int number = 0;
  for (const std::string_view line : lines_of(text)) {
    ++number;
    if (!line.starts_with('#') && has_letter(line, code)) return number;
  }
  return 0;
}

void add_missing_characters(const std::vector<MissingCharacter>& lacking, const std::string& file,
                            WordFaults& faults) {
  if (!lacking.empty())
    faults.mistakes.push_back(
        {{file, line_with(lacking.front().code, file), 0}, missing_characters_message(lacking)});
}

// The texts of a session, and the file of each page.
struct SessionWords {
  ScreenTexts texts;
  std::string texts_file;
  std::map<std::string, std::string> file_of_page;  ///< only pages from another file

  const std::string& file_of(const std::string& page) const {
    const auto found = file_of_page.find(page);
    return found == file_of_page.end() ? texts_file : found->second;
  }
};

// Where a protocol first has a value that begins so, outside comments.
SourcePlace place_of_value(const std::string& beginning, const std::string& protocol_text,
                           const std::string& file) {
  int number = 0;
  for (const std::string_view line : lines_of(protocol_text)) {
    ++number;
    const auto at = line.find('"' + beginning);
    if (at < line.find('#')) return {file, number, static_cast<int>(at) + 1};
  }
  return {file};
}

// A language that does not exist is named with its place, if the protocol chooses it.
std::string texts_file_of(const Protocol& protocol, const std::string& protocol_file,
                          const std::string& language) try {
  return texts_file(language);
} catch (const Error& error) {
  if (language != protocol.screens.language) throw;
  throw InvalidFile({{place_of_value(language + '"', protocol.text, protocol_file), error.what()}});
}

SessionWords words_of(const Protocol& protocol, const std::string& protocol_file,
                      const std::string& language) {
  ConfigFile file{texts_file_of(protocol, protocol_file, language)};
  file.text = read_text_file(file.path);
  SessionWords words;
  for (const auto& [name, from] : add_questionnaires(file, protocol_file, protocol))
    words.file_of_page[questionnaire_page(name)] = from;
  words.texts = parse_texts(file.text, file.path);
  words.texts_file = file.path;
  return words;
}

// Whether a page is of a task that the protocol lacks.
bool is_of_other_task(const std::string& page, const Protocol& protocol) {
  const auto is_page_of = [&](const Task& task) {
    return page == text_page(Screen::trial, task) || page == text_page(Screen::instructions, task);
  };
  const auto is_in_block = [&](const Block& block) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    return trials && is_page_of(Task(trials->task().name));
  };
  return std::ranges::any_of(heft::words_of<Task>(), is_page_of) &&
         std::ranges::none_of(protocol.blocks, is_in_block);
}

void add_missing_characters(const SessionWords& words, WordFaults& faults) {
  std::map<std::string, std::vector<MissingCharacter>> by_file;
  for (const MissingCharacter& one : missing_characters(words.texts))
    by_file[words.file_of(one.text.substr(0, one.text.find('.')))].push_back(one);
  for (const auto& [file, lacking] : by_file) add_missing_characters(lacking, file, faults);
}

// @param name of the questionnaire
std::string questions_in(const SessionWords& words, const std::string& name) {
  std::vector<std::string_view> keys;
  if (const auto form = words.texts.questionnaires.find(name);
      form != words.texts.questionnaires.end())
    for (const FormQuestion& asked : form->second.questions)
      if (asked.kind != QuestionKind::text) keys.emplace_back(asked.key);
  return keys.empty() ? "one that is answered on the screen" : quoted_list(keys);
}

// Checks that the questions of trials exist and fit beside the cubes.
void check_questions(Protocol protocol, const std::string& protocol_file, const SessionWords& words,
                     WordFaults& faults) {
  const Measures screen = smallest_screen(protocol.screens.text_size);
  for (Block& block : protocol.blocks) {
    auto* trials = std::get_if<TaskBlock>(&block);
    if (!trials || !trials->questionnaire()) continue;
    const std::string name = *trials->questionnaire();
    trials->read_question(words.texts.questionnaires);
    const std::string& file = words.file_of(questionnaire_page(name));
    if (trials->lacks_question()) {
      faults.mistakes.push_back(
          {place_of_value(name + '.', protocol.text, protocol_file),
           fmt::format(
               "block {} asks a question of the questionnaire {} that {} lacks; expected {}",
               trials->name(), name, file, questions_in(words, name))});
      continue;
    }
    if (const auto mistake = trials->mistake_in_question()) {
      faults.mistakes.push_back({place_of_value(name + '.', protocol.text, protocol_file),
                                 fmt::format("block {}: {}", trials->name(), *mistake)});
      continue;
    }
    const auto trial = trials->trial(trials->run(0)->plan({}), 0);
    for (const std::string& sentence :
         texts_that_do_not_fit(words.texts, screen, {screen_of(*trial)}))
      faults.cautions.push_back(file + ": " + on_smallest_screen(sentence));
  }
}
}  // namespace

WordFaults faults_in_words(const ScreenTexts& texts, const std::string& file) {
  WordFaults faults;
  add_missing_characters(missing_characters(texts), file, faults);
  for (const std::string& sentence : misfits(texts, 1))
    faults.cautions.push_back(on_smallest_screen(sentence));
  // With the largest letters, only what does not fit either in small ones.
  for (const std::string& sentence : misfits(texts, most_text_size))
    if (sentence.find("only in small letters") == std::string::npos)
      faults.cautions.push_back(
          fmt::format("with --text-size {}, {}", most_text_size, on_smallest_screen(sentence)));
  return faults;
}

WordFaults faults_in_words(const Protocol& protocol, const std::string& protocol_file,
                           const std::string& language) {
  const SessionWords words = words_of(protocol, protocol_file, language);
  const double text_size = protocol.screens.text_size;
  const bool is_shipped = !language.ends_with(".toml");
  if (is_shipped && words.file_of_page.empty() && text_size == 1) return {};
  WordFaults faults;
  add_missing_characters(words, faults);
  for (const std::string& sentence : misfits(words.texts, text_size)) {
    const std::string page = sentence.substr(0, sentence.find(": "));
    if (is_of_other_task(page, protocol)) continue;
    faults.cautions.push_back(words.file_of(page) + ": " + on_smallest_screen(sentence));
  }
  check_questions(protocol, protocol_file, words, faults);
  return faults;
}

}  // namespace heft::cli
