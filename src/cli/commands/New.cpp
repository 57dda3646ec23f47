// heft new: a commented experiment to fill in, or a new entry of one of the source's lists with a
// test that fails until the entry is written. The texts are in protocols/examples/template.toml and
// in src/cli/templates.
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <regex>
#include <vector>

#include "base/Error.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/console/Terminal.h"

namespace heft::cli {

namespace {
namespace fs = std::filesystem;

/// A file that a template is written to.
struct NewFile {
  std::string_view template_name, path;
};

/// Text that enters an existing file before the first `before` that follows `after`. Both are plain
/// text; an empty `before` is the file's end.
struct ListEntry {
  std::string_view path, after, before, text;
  std::string_view include = {};  ///< header to add to the file's includes
};

/// A kind of entry: what it consists of. Every text may hold @name@, @Name@ and @words@.
struct Kind {
  std::string_view name, summary, example;
  std::vector<NewFile> files;
  std::vector<ListEntry> entries;
  std::string_view test;  ///< its failing test
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{
      {"task",
       "a task: what trials of a block show and ask",
       "odd_one_out",
       {{"task.h.in", "src/tasks/@Name@.h"},
        {"task.cpp.in", "src/tasks/@Name@.cpp"},
        {"task_screen.cpp.in", "src/view/screens/@Name@Screen.cpp"},
        {"task_test.cpp.in", "tests/tasks/@name@_test.cpp"},
        {"task_protocol.toml.in", "protocols/examples/@name@.toml"}},
       {{"src/tasks/Tasks.h", "using Tasks = KindsOfTask<", ">;", ", @Name@", "tasks/@Name@.h"},
        {"protocols/texts/en.toml", "", "", "task_texts.en.in"},
        {"protocols/texts/fr.toml", "", "", "task_texts.fr.in"}},
       "@Name@.SimulatedParticipantsAnswerByWhatTheyPerceived"},
      {"procedure",
       "a procedure: which level comes next, and what it estimates",
       "accelerated",
       {{"procedure.h.in", "src/psychophysics/@Name@.h"},
        {"procedure_test.cpp.in", "tests/psychophysics/@name@_test.cpp"}},
       {{"src/psychophysics/ProcedureKinds.h", "using ProcedureKinds =", ">;", ", @Name@Config",
         "psychophysics/@Name@.h"}},
       "@Name@.FindsTheThresholdOfAnObserverWithoutNoise"},
      {"technique",
       "a technique: how far the clone is displaced from the hand",
       "stick",
       {{"technique.h.in", "src/physics/techniques/@Name@.h"},
        {"technique_test.cpp.in", "tests/physics/@name@_test.cpp"}},
       {{"src/physics/techniques/Displacement.h", "using Displacements = NamedKinds<", ">;",
         ", @Name@", "physics/techniques/@Name@.h"}},
       "@Name@.DisplacesTheCloneThatPushesACube"},
      {"responder",
       "a responder: a simulated participant",
       "hasty",
       {{"responder.cpp.in", "src/responders/@Name@.cpp"},
        {"responder_test.cpp.in", "tests/responders/@name@_test.cpp"}},
       {{"src/responders/Responder.cpp", "constexpr std::array table{", "\n};",
         "\n    ResponderEntry{\"@name@\", \"TODO how it answers\", ResponderFile::none, "
         "make_@name@, {}, false},"},
        {"src/responders/Responder.h", "std::unique_ptr<Responder> make_scripted",
         "\n}  // namespace heft",
         "std::unique_ptr<Responder> make_@name@(const ResponderOptions& options);\n"}},
       "@Name@.AnswersByWhichCubeIsHeavier"},
      {"simulator",
       "a simulator of the clone and the cubes",
       "springs",
       {{"simulator.cpp.in", "src/physics/@name@/@Name@Simulator.cpp"},
        {"simulator_test.cpp.in", "tests/physics/@name@_test.cpp"}},
       {{"src/physics/DecouplingSimulator.cpp", "std::to_array<SimulatorEntry>({", "\n});",
         "\n    {\"@name@\", \"TODO its method\", make_@name@, {.straight = true}},"},
        {"src/physics/DecouplingSimulator.cpp", "make_quasi_static();", "\n",
         "\nstd::unique_ptr<DecouplingSimulator> make_@name@();"}},
       "@Name@Simulator.PushesACubeAlong"}};
  return all;
}

/// The names that templates are filled with: odd_one_out, OddOneOut, "odd one out".
struct Names {
  std::string name, type, words;

  std::string in(std::string_view text) const {
    std::string filled(text);
    for (const auto& [key, value] :
         {std::pair("@name@", &name), {"@Name@", &type}, {"@words@", &words}, {"@NAME@", &name}})
      for (auto at = filled.find(key); at != std::string::npos; at = filled.find(key, at))
        filled.replace(at, std::string_view(key).size(), *value);
    return filled;
  }
};

Names names_for(const std::string& name) {
  static const std::regex form("[a-z][a-z0-9]*(_[a-z0-9]+)*");
  constexpr std::size_t longest = 40;
  if (!std::regex_match(name, form) || name.size() > longest)
    throw Error(fmt::format("\"{}\" is not a name for source code; expected at most {} lowercase "
                            "letters, digits and single underscores, such as odd_one_out",
                            name, longest),
                ExitCode::usage);
  Names names{name, "", name};
  bool capital = true;
  for (char& letter : names.words) {
    if (letter != '_')
      names.type += capital && letter >= 'a' ? static_cast<char>(letter - 32) : letter;
    capital = letter == '_';
    if (capital) letter = ' ';
  }
  return names;
}

bool is_checkout(const fs::path& folder) {
  std::error_code none;
  return fs::exists(folder / "CMakeLists.txt", none) &&
         fs::exists(folder / "src/cli/templates/task.h.in", none);
}

/// The source checkout: HEFT_CHECKOUT, or the working directory or a folder above it.
fs::path checkout() {
  const char* given = std::getenv("HEFT_CHECKOUT");
  if (given && *given) {
    if (is_checkout(given)) return fs::absolute(given);
    throw Error(
        fmt::format("HEFT_CHECKOUT is {}, which is not a checkout of Heft's source", given));
  }
  for (fs::path folder = fs::current_path();; folder = folder.parent_path()) {
    if (is_checkout(folder)) return folder;
    if (folder == folder.parent_path())
      throw Error(
          "this needs Heft's source: start it inside a checkout, or set HEFT_CHECKOUT to one");
  }
}

/// Refuses a name that the source uses already, as a list's entry or as a type.
void require_unused(const fs::path& source, const Kind& kind, const Names& names) {
  const std::regex type(
      fmt::format(R"(\b(struct|class|enum class) {}(Config)?\b[^;]*\{{)", names.type));
  for (const auto& entry : fs::recursive_directory_iterator(source / "src")) {
    if (entry.path().extension() != ".h") continue;
    const std::string text = read_text_file(entry.path().string());
    if (text.find(names.type) != std::string::npos && std::regex_search(text, type))
      throw Error(fmt::format("{} already declares the type {}; choose another name",
                              entry.path().string(), names.type));
  }
  for (const ListEntry& list : kind.entries) {
    const std::string path = (source / list.path).string(), text = read_text_file(path);
    for (const std::string& taken :
         {fmt::format("\"{}\"", names.name), fmt::format("[trial_{}]", names.name)})
      if (text.find(taken) != std::string::npos)
        throw Error(fmt::format("{} already has {}; choose another name", path, taken));
  }
}

/// Adds an include in the alphabetical order of the last block of quoted includes.
void add_include(std::string& text, const std::string& header) {
  const std::string line = fmt::format("#include \"{}\"\n", header);
  std::size_t block = text.rfind("\n#include \"") + 1, end = text.find('\n', block) + 1;
  while (block >= 2) {  // up to the block's first line
    const std::size_t start = text.rfind('\n', block - 2) + 1;
    if (text.compare(start, 10, "#include \"") != 0) break;
    block = start;
  }
  std::size_t at = block;
  while (at < end && text.compare(at, line.size(), line) < 0) at = text.find('\n', at) + 1;
  text.insert(at, line);
}

std::string with_entry(std::string text, const ListEntry& entry, const std::string& added,
                       const std::string& path, const Names& names) {
  std::size_t at = text.size();
  if (!entry.before.empty()) {
    at = text.find(entry.after);
    if (at != std::string::npos) at = text.find(entry.before, at + entry.after.size());
    if (at == std::string::npos)
      throw Error(fmt::format("{} has no \"{}\" followed by \"{}\", where the new entry belongs",
                              path, entry.after, names.in(entry.before)));
  }
  text.insert(at, added);
  if (!entry.include.empty()) add_include(text, names.in(entry.include));
  return text;
}

using Texts = std::map<std::string, std::string>;  // path to contents

/// Writes all files or none: first beside their places, then each into its place.
void write_all(const Texts& texts) {
  std::vector<fs::path> made;  // to be removed again where one can't be written
  try {
    for (const auto& [path, text] : texts) {
      const fs::path folder = fs::absolute(path).parent_path();
      if (fs::create_directories(folder)) made.push_back(folder);
      const std::string beside = path + ".heft-new";
      if (!create_file(beside, 0666)) throw Error(fmt::format("{} exists already", beside));
      made.emplace_back(beside);
      std::ofstream file(beside, std::ios::binary);
      if (!(file << text).flush()) throw Error(fmt::format("can't write {}", beside));
    }
    for (const auto& [path, text] : texts) fs::rename(path + ".heft-new", path);
  } catch (...) {
    std::error_code none;
    while (!made.empty()) {
      fs::remove(made.back(), none);
      made.pop_back();
    }
    throw;
  }
}

void require_new(const std::string& path) {
  std::error_code none;
  if (fs::exists(fs::symlink_status(path, none)))
    throw Error(fmt::format("{} exists already; choose another name", path));
}

void add_to_source(const Kind& kind, const std::string& name) {
  const Names names = names_for(name);
  const fs::path source = checkout();
  const auto filled = [&](std::string_view file) {
    return names.in(read_text_file((source / "src/cli/templates" / file).string()));
  };
  Texts texts;
  for (const NewFile& file : kind.files) {
    const std::string path = (source / names.in(file.path)).string();
    require_new(path);
    texts[path] = filled(file.template_name);
  }
  require_unused(source, kind, names);
  for (const ListEntry& entry : kind.entries) {
    const std::string path = (source / entry.path).string();
    const std::string added =
        entry.text.ends_with(".in") ? filled(entry.text) : names.in(entry.text);
    const std::string before = texts.contains(path) ? texts[path] : read_text_file(path);
    texts[path] = with_entry(before, entry, added, path, names);
  }
  write_all(texts);
  for (const NewFile& file : kind.files) print("wrote    {}\n", names.in(file.path));
  for (const ListEntry& entry : kind.entries) print("changed  {}\n", entry.path);
  print(
      "\nNext: write what is marked TODO in these files. In {},\n"
      "  ./heft test -R {}\n"
      "fails until then, and names the function to write. ./heft test runs all tests;\n"
      "clang-format -i FILE formats a file.\n",
      source.string(), names.in(kind.test));
}

void add_experiment(const std::string& name) {
  static const std::regex form("[A-Za-z0-9][A-Za-z0-9_-]*");
  if (!std::regex_match(name, form))
    throw Error(
        fmt::format("\"{}\" is not a name for an experiment; expected letters, digits, - and "
                    "_, without .toml",
                    name),
        ExitCode::usage);
  const std::string path = name + ".toml";
  require_new(path);
  const std::string text = read_text_file(installed_file("protocols/examples/template.toml"));
  write_all({{path, Names{name, "", name}.in(text)}});
  print(
      "wrote    {0}\n\nNext: change its blocks, then\n"
      "  heft validate {0}\n"
      "  heft run {0} --participant me --tracker mouse\n",
      path);
}
}  // namespace

void add_new(Command& app) {
  Command command =
      app.add_command("new", "start an experiment, or a task, procedure, technique... of Heft",
                      {"heft new experiment soft_cubes", "heft new task odd_one_out"});
  command.needs_command();
  const auto add = [&](std::string_view name, std::string_view summary, std::string_view example,
                       const std::function<void(const std::string&)>& write) {
    Command one = command.add_command(std::string(name), std::string(summary),
                                      {fmt::format("heft new {} {}", name, example)});
    const auto given = std::make_shared<std::string>();
    one.add_option("NAME", given.get(), "its name").required();
    one.does([=] { write(*given); });
  };
  add("experiment", "a protocol, NAME.toml in the working directory", "soft_cubes", add_experiment);
  for (const Kind& kind : kinds())
    add(kind.name, kind.summary, kind.example,
        [&kind](const std::string& name) { add_to_source(kind, name); });
}

}  // namespace heft::cli
