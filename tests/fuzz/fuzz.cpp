// Inputs of every kind that heft reads: whatever they contain, only an Error may be thrown.
// With clang's libFuzzer, a program for each kind:
//   cmake --preset fuzz && cmake --build build-fuzz
//   build-fuzz/tests/fuzz/fuzz_scene -max_total_time=600 found/scene tests/fuzz/corpus/scene
// Without it, the test `corpora` gives every file of the corpora to its kind.
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <string>

#include "base/Error.h"
#include "cli/commands/ProcedureDialog.h"
#include "experiment/Trajectory.h"
#include "inference/AnswerData.h"
#include "protocol/Protocol.h"
#include "protocol/readers/Files.h"
#include "protocol/study/StudyPlan.h"
#include "record/reader/LogReader.h"
#include "replay/Replay.h"
#include "responders/Recording.h"
#include "tracking/camera/ImageFile.h"
#include "tracking/camera/Intrinsics.h"

namespace heft {
namespace {

const std::string file = "input";

// For readers that open files. @param suffix by which the reader knows the kind
std::string stored(const std::string& bytes, const std::string& suffix) {
  static const std::string folder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "heft-fuzz-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    return name;
  }();
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    std::filesystem::remove(entry);
  const std::string path = folder + "/input" + suffix;
  std::ofstream(path, std::ios::binary) << bytes;
  return path;
}

void read_pictures(const std::string& bytes) {
  for (const char* suffix : {".png", ".jpg", ".bmp", ".pgm", ".tif"}) try {
      read_image(stored(bytes, suffix));
    } catch (const Error&) {
    }
}

void read_log(const std::string& bytes) {
  const std::string path = stored(bytes, ".db");
  const LogReader reader(path);
  faults_of_file(reader, path);
  for (const std::int64_t id : reader.session_ids()) verify_rows(reader, id);
}

void talk(const std::string& lines) {
  std::istringstream in(lines);
  std::ostringstream out;
  const InterleavedProcedures procedures = parse_procedure(
      "[[staircase]]\nname = \"a\"\nkind = \"up_down\"\nstart = 600\nstep = 150\nstop_trials = "
      "40\n",
      file);
  cli::ProcedureDialog(procedures, out).run(in);
}

using Reads = std::function<void(const std::string&)>;

const std::map<std::string, Reads>& kinds() {
  static const std::map<std::string, Reads> all{
      {"protocol", [](const std::string& text) { parse_protocol(text, file, {}); }},
      {"study", [](const std::string& text) { parse_study(text, file); }},
      {"scene", [](const std::string& text) { parse_scene(text, file); }},
      {"board",
       [](const std::string& text) {
         parse_board(text, file);
         parse_effector(text, file);
       }},
      {"procedure", [](const std::string& text) { parse_procedure(text, file); }},
      {"trajectory", [](const std::string& text) { parse_trajectory(text, file); }},
      {"actions", [](const std::string& text) { parse_actions(text, file); }},
      {"json_lines", talk},
      {"camera", [](const std::string& text) { parse_intrinsics(text, file); }},
      {"texts", [](const std::string& text) { parse_texts(text, file); }},
      {"questionnaires", [](const std::string& text) { parse_questionnaires(text, file); }},
      {"picture", read_pictures},
      {"log", read_log}};
  return all;
}

void give(const Reads& reads, const std::string& bytes) {
  try {
    reads(bytes);
  } catch (const Error&) {
  }
}

}  // namespace
}  // namespace heft

#ifdef HEFT_FUZZED
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t n) {
  static const heft::Reads& reads = heft::kinds().at(HEFT_FUZZED);
  heft::give(reads, std::string(reinterpret_cast<const char*>(bytes), n));
  return 0;
}
#else
int main(int argc, char** argv) {
  int n = 0;
  for (const auto& [kind, reads] : heft::kinds())
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(argc > 1 ? argv[1] : ".") + "/" + kind)) {
      std::cout << kind << ' ' << entry.path().filename().string() << std::endl;
      std::ifstream input(entry.path(), std::ios::binary);
      heft::give(reads, {std::istreambuf_iterator<char>(input), {}});
      ++n;
    }
  std::cout << n << " inputs\n";
  return n > 0 ? 0 : 1;
}
#endif
