#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <sstream>

#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "experiment/ScreenTexts.h"
#include "protocol/readers/Files.h"
#include "protocol/toml/TableReader.h"
#include "tasks/blocks/SessionPlan.h"

namespace heft {

namespace {
struct PageKeys {
  std::string_view page, keys;       ///< keys separated by spaces
  std::string_view later_keys = {};  ///< may be missing in older files
};

constexpr std::array required_pages{
    PageKeys{"buttons", "start next back skip more finish put_cubes_back"},
    PageKeys{"slots", "left middle right"},
    PageKeys{"consent", "title text agree decline", "reading"},
    PageKeys{"welcome", "title text"},
    PageKeys{"about_you",
             "title age age_under_18 age_18_24 age_25_34 age_35_44 age_45_54 age_55_or_more gender "
             "gender_woman gender_man gender_other gender_not_said handedness handedness_right "
             "handedness_left handedness_both eyesight eyesight_unaided eyesight_glasses "
             "eyesight_lenses ar_experience ar_experience_never ar_experience_once_or_twice "
             "ar_experience_several_times ar_experience_often"},
    PageKeys{"demonstration", "title text"},
    PageKeys{"trial", "wait_for_cubes touch_every_cube",
             "next_cubes drag_effector correct not_correct"},
    PageKeys{"rest", "title text time_left"},
    PageKeys{"paused", "title text"},
    PageKeys{"how_decided",
             "title basis basis_seen basis_felt basis_both basis_guessed certainty certainty_very "
             "certainty_fairly certainty_little certainty_none movement movement_slow "
             "movement_fast movement_varied movement_unaware"},
    PageKeys{"thanks", "title text"}};
/// Pages that may be missing in older files.
constexpr std::array later_pages{PageKeys{"declined", "title text take_back leave"},
                                 PageKeys{"setting_up", "title text"},
                                 PageKeys{"instructions_after_practice", "title text"}};

struct TaskPage {
  std::string page, keys;                            // of all its blocks
  std::string usual = {};                            // of blocks without a wording
  std::map<std::string, std::string> wordings = {};  // of those with one

  std::string needed(std::string_view wording) const {
    const auto its = wordings.find(std::string(wording));
    return keys + ' ' + (its == wordings.end() ? usual : its->second);
  }
};

// A task's two pages. They may be missing or incomplete; a session with the task refuses that.
std::vector<TaskPage> pages_of(std::string_view task) {
  const TaskDeclaration& declaration = task_named(task);
  const Task name(task);
  TaskPage instructions{text_page(Screen::instructions, name), "title", "text"};
  TaskPage trial{text_page(Screen::trial, name), std::string(declaration.texts)};
  for (const Wording& wording : declaration.wordings) {
    instructions.wordings[std::string(wording.name)] = instructions_key(wording.name);
    trial.wordings[std::string(wording.name)] = wording.texts;
  }
  return {instructions, trial};
}

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
  table.read_lines(key, text);
  text = trimmed(text);
  if (text.empty() && table.has(key) && table.good({key}))
    table.mistake(key, fmt::format("{} is empty, expected a text for the participant", key));
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
constexpr WholeRange points_of_scales{0, 10};
constexpr std::size_t most_choices = 12;

// A key enters the log's table; a name the protocol.
void check_key(TableReader& table, std::string_view key, const std::string& value) {
  const bool plain = std::ranges::all_of(
      value, [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; });
  if (value == "done_s" || value == "answered_by")  // time of completion, and a model's mark
    table.mistake(key, fmt::format("{} is \"{}\", which is reserved for the log", key, value));
  if (!plain && table.good({key}))
    table.mistake(key, fmt::format("{} is \"{}\", expected lowercase letters, digits and _ only",
                                   key, printable(value)));
}

void read_choices(TableReader& table, FormQuestion& question) {
  std::set<std::string> values;
  for (TableReader& choice : table.tables("choice")) {
    AnswerChoice read{read_text(choice, "value"), read_text(choice, "text")};
    choice.close();
    if (!read.value.empty() && !values.insert(read.value).second)
      choice.mistake("value", fmt::format("two choices are \"{}\", expected different ones",
                                          printable(read.value)));
    question.choices.push_back(std::move(read));
  }
  const std::size_t n = question.choices.size();
  if (table.good({"choice"}) && (n < 2 || n > most_choices))
    table.mistake("choice", fmt::format("a choice of {}, expected 2 to {}", n, most_choices));
}

void read_number_range(TableReader& table, FormQuestion& question) {
  table.require({"least", "most"});
  table.read("least", question.least);
  table.read("most", question.most);
  if (table.good({"least", "most"}) && table.has("most") && question.most <= question.least)
    table.mistake("most", fmt::format("most is {:g}, expected more than least {:g}", question.most,
                                      question.least));
}

FormQuestion read_question(TableReader& table) {
  FormQuestion question;
  question.key = read_text(table, "key");
  check_key(table, "key", question.key);
  question.text = read_text(table, "text");
  const auto kind = table.read_nearest_name("kind", EnumNames<QuestionKind>::names);
  if (!kind) return question;
  question.kind = *named<QuestionKind>(*kind);
  switch (question.kind) {
    case QuestionKind::choice:
      read_choices(table, question);
      break;
    case QuestionKind::likert:
      table.read("from", question.from, points_of_scales);
      table.read("to", question.to, points_of_scales);
      if (table.good({"from", "to"}) && question.to < question.from + 2)
        table.mistake(table.has("to") ? "to" : "from",
                      fmt::format("from {} to {}, expected three points or more", question.from,
                                  question.to));
      [[fallthrough]];
    case QuestionKind::slider:
      question.low = read_text(table, "low");
      question.high = read_text(table, "high");
      break;
    case QuestionKind::number:
      read_number_range(table, question);
      break;
    case QuestionKind::text:
      break;
  }
  table.close();
  return question;
}

Questionnaire read_questionnaire(TableReader& table) {
  Questionnaire questionnaire;
  questionnaire.title = read_text(table, "title");
  table.read("source", questionnaire.source);
  table.require({"question"});
  std::set<std::string> keys;
  for (TableReader& question : table.tables("question")) {
    questionnaire.questions.push_back(read_question(question));
    const std::string& key = questionnaire.questions.back().key;
    if (!key.empty() && !keys.insert(key).second)
      question.mistake(
          "key", fmt::format("two questions are \"{}\", expected different keys", printable(key)));
  }
  table.close();
  return questionnaire;
}

// All of its texts for participants.
std::map<std::string, std::string> words_of(const Questionnaire& questionnaire) {
  std::map<std::string, std::string> words{{"title", questionnaire.title}};
  for (const FormQuestion& question : questionnaire.questions) {
    words[question.key] = question.text;
    if (!question.low.empty()) words[question.key + "_low"] = question.low;
    if (!question.high.empty()) words[question.key + "_high"] = question.high;
    for (const AnswerChoice& choice : question.choices)
      words[question.key + '_' + choice.value] = choice.text;
  }
  return words;
}

void read_questionnaires(TableReader& reader, ScreenTexts& texts) {
  reader.in_table("questionnaire", [&](TableReader& all) {
    for (const std::string& name : all.keys()) {
      auto table = all.table(name);
      if (!table) continue;
      Questionnaire read = read_questionnaire(*table);
      texts.pages[questionnaire_page(name)] = words_of(read);
      texts.questionnaires.emplace(name, std::move(read));
    }
  });
}
}  // namespace

ScreenTexts parse_questionnaires(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  ScreenTexts texts;
  reader.require({"questionnaire"});
  read_questionnaires(reader, texts);
  reader.close();
  mistakes.throw_if_any();
  return texts;
}

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
  for (const std::string_view task : words_of<Task>())
    for (const TaskPage& page : pages_of(task))
      if (auto table = reader.table(page.page)) {
        std::string keys = page.keys + ' ' + page.usual;
        for (const auto& [wording, more] : page.wordings) keys += ' ' + more;
        texts.pages.emplace(page.page, read_page(*table, {page.page, "", keys}));
      }
  read_questionnaires(reader, texts);
  reader.close();
  mistakes.throw_if_any();
  return texts;
}

void require_words(const ScreenTexts& texts, const SessionPlan& plan, const std::string& file) {
  std::vector<std::string> missing;
  for (const Block& block : plan.blocks) {
    const auto* trials = std::get_if<TaskBlock>(&block);
    if (!trials) continue;
    const auto need = [&](const std::string& page, const std::string& keys) {
      std::istringstream words{keys};
      for (std::string key; words >> key;)
        if (std::string text = fmt::format("[{}] {}", page, key);
            texts.if_any(page, key).empty() && std::ranges::count(missing, text) == 0)
          missing.push_back(std::move(text));
    };
    for (const TaskPage& page : pages_of(trials->task().name))
      need(page.page, page.needed(trials->wording()));
    if (trials->practice && trials->practice->feedback) need("trial", "correct not_correct");
  }
  if (!missing.empty())
    throw Error(fmt::format("{} lacks texts of the protocol's tasks: {}; add them, or use another "
                            "text file",
                            file, fmt::join(missing, ", ")),
                ExitCode::invalid_file);
}

void take_questions(SessionPlan& plan, const std::string& text, const std::string& file) {
  std::optional<ScreenTexts> texts;
  for (Block& block : plan.blocks) {
    auto* trials = std::get_if<TaskBlock>(&block);
    if (text.empty() || !trials || !trials->questionnaire()) continue;
    if (!texts) texts = parse_texts(text, file);
    trials->read_question(texts->questionnaires);
  }
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
