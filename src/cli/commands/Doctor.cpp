// heft doctor: checks this machine for a session, with a verdict each.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/statvfs.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <sstream>

#include "apparatus/checks/ApparatusCheck.h"
#include "apparatus/configuration/ResolvedConfig.h"
#include "apparatus/sources/PictureSource.h"
#include "base/Clock.h"
#include "base/Error.h"
#include "base/Program.h"
#include "base/files/TextFile.h"
#include "cli/Commands.h"
#include "cli/Help.h"
#include "cli/SessionOptions.h"
#include "cli/console/Terminal.h"
#include "physics/DecouplingSimulator.h"
#include "protocol/readers/Files.h"
#include "record/reader/LogReader.h"
#include "replay/Replay.h"
#include "responders/Responder.h"
#include "session/Equipment.h"
#include "session/Session.h"
#include "tracking/calibration/ShutterCalibration.h"
#include "tracking/camera/Camera.h"
#include "tracking/camera/VideoDevices.h"
#include "view/ArView.h"
#include "view/Window.h"

namespace heft::cli {

namespace {

// Prints one line per check and remembers the worst verdict.
class Report {
 public:
  void line(CheckVerdict verdict, const std::string& what, const std::string& found) {
    constexpr std::array<const char*, 3> marks{"ok     ", "warning", "FAILED "};
    const std::string begin =
        fmt::format("{}  {:<14}", marks[static_cast<std::size_t>(verdict)], what);
    const auto width = terminal_width(STDOUT_FILENO);
    if (width)
      print("{}{}", begin, wrapped(found, 24, static_cast<std::size_t>(*width), begin.size()));
    else
      print("{} {}\n", begin, found);
    worst_ = std::max(worst_, verdict);
  }
  bool failed() const { return worst_ == CheckVerdict::failed; }

 private:
  CheckVerdict worst_ = CheckVerdict::ok;
};

// A command's output; empty if it cannot be run.
std::string output_of(const std::string& command) {
  std::string output;
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::array<char, 256> part{};
  while (pipe && fgets(part.data(), part.size(), pipe.get())) output += part.data();
  return output;
}

void check_packages(Report& report) {
  const std::string file = installed_file_or_none(".packages");
  if (file.empty()) return report.line(CheckVerdict::ok, "packages", "installed with heft");
  std::istringstream list(read_text_file(file));
  std::string line, missing;
  int n = 0;
  while (std::getline(list, line)) {
    std::istringstream words(line);
    std::string package, purpose;
    if (!(words >> package >> purpose) || package.starts_with('#') || purpose == "test") continue;
    ++n;
    if (output_of("dpkg-query -W -f '${db:Status-Status}' " + package + " 2>/dev/null") !=
        "installed")
      missing += " " + package;
  }
  if (missing.empty())
    report.line(CheckVerdict::ok, "packages", fmt::format("all {} are installed", n));
  else
    report.line(CheckVerdict::failed, "packages",
                fmt::format("missing; install them: sudo apt-get install{}", missing));
}

void check_space(Report& report, const std::string& folder) {
  struct statvfs space {};
  if (statvfs(folder.c_str(), &space) != 0)
    return report.line(CheckVerdict::failed, "disk",
                       fmt::format("{} cannot be examined; does the folder exist?", folder));
  const double free_gb =
      static_cast<double>(space.f_bavail) * static_cast<double>(space.f_frsize) / 1e9;
  const std::string found = fmt::format("{:.1f} GB free in {}", free_gb, folder);
  if (free_gb < 0.1)
    report.line(CheckVerdict::failed, "disk",
                found + ": too little for a session (about 20 MB each)");
  else
    report.line(free_gb < 1 ? CheckVerdict::warning : CheckVerdict::ok, "disk", found);
}

// SQLite's write-ahead log needs shared memory, which network file systems lack.
void check_file_system(Report& report, const std::string& folder) {
  constexpr long nfs = 0x6969, smb = 0x517B, smb2 = 0xFE534D42L, cifs = 0xFF534D42L;
  struct statfs system {};
  if (statfs(folder.c_str(), &system) != 0) return;
  const bool remote = system.f_type == nfs || system.f_type == smb || system.f_type == smb2 ||
                      system.f_type == cifs;
  report.line(remote ? CheckVerdict::failed : CheckVerdict::ok, "file system",
              remote ? "a network file system: keep the log on a local disk and copy it afterwards"
                     : "local");
}

// Writes as the log does, one synchronized page at a time.
class WrittenForTrial {
 public:
  explicit WrittenForTrial(const std::string& folder) : path_(folder + "/heft-doctor-XXXXXX") {
    file_ = mkstemp(path_.data());
  }
  ~WrittenForTrial() {
    if (file_ < 0) return;
    close(file_);
    unlink(path_.c_str());
  }
  WrittenForTrial(const WrittenForTrial&) = delete;

  bool is_there() const { return file_ >= 0; }
  bool write_page() const {
    return write(file_, page_.data(), page_.size()) > 0 && fsync(file_) == 0;
  }

 private:
  const std::string page_ = std::string(4096, 'x');
  std::string path_;
  int file_ = -1;
};

// Time until an answer is safe on disk.
void check_commit(Report& report, const std::string& folder) {
  const WrittenForTrial file(folder);
  if (!file.is_there())
    return report.line(
        CheckVerdict::failed, "writing",
        fmt::format("no file can be created in {}; choose another folder with --db", folder));
  std::vector<double> times_ms;
  for (int i = 0; i < 20; ++i) {
    const auto started = std::chrono::steady_clock::now();
    const bool written = file.write_page();
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - started;
    if (written) times_ms.push_back(took.count());
  }
  if (times_ms.empty())
    return report.line(CheckVerdict::failed, "writing", "cannot write; is the disk full?");
  std::ranges::sort(times_ms);
  const double median_ms = times_ms[times_ms.size() / 2], worst_ms = times_ms.back();
  report.line(worst_ms > 100 ? CheckVerdict::warning : CheckVerdict::ok, "writing",
              fmt::format("an answer is safe on disk in {:.1f} ms (worst of 20: {:.1f} ms)",
                          median_ms, worst_ms));
}

void check_displays(Report& report, const ScreenTexts& texts) try {
  for (const CheckResult& result : window_module().check_displays(texts))
    report.line(result.verdict, result.name, result.finding);
} catch (const Error& error) {
  report.line(CheckVerdict::failed, "display", error.what());
}

// check_displays reports why there is none.
std::vector<DisplayFacts> displays_if_any() try {
  return window_module().displays();
} catch (const Error&) {
  return {};
}

// Measures the delay from a touch to disk and display. One of fifty may be late.
void check_touch_delay(Report& report, const std::string& folder, const ScreenTexts& texts,
                       const std::vector<DisplayFacts>& found) try {
  constexpr int n_taps = 50;
  constexpr double usual_refresh_hz = 60, beside_a_frame_s = 0.020;
  if (found.empty())
    return report.line(CheckVerdict::ok, "touch delay", "not measured: there is no display");
  const WrittenForTrial file(folder);
  std::vector<double> times_s = window_module().touch_delays_s(
      texts, [&] { file.is_there() && file.write_page(); }, n_taps);
  if (times_s.size() < n_taps / 2)
    return report.line(
        CheckVerdict::warning, "touch delay",
        fmt::format("not measured: the window took {} of {} taps", times_s.size(), n_taps));
  std::ranges::sort(times_s);
  const double frame_s = 1 / found.front().refresh_hz.value_or(usual_refresh_hz);
  const bool is_late = times_s[times_s.size() - 2] > frame_s + beside_a_frame_s;
  report.line(is_late ? CheckVerdict::warning : CheckVerdict::ok, "touch delay",
              fmt::format("{:.1f} ms from the touch's event until it is on disk and its answer "
                          "presented (worst two of {}: {:.1f} and {:.1f} ms; a frame and 20 ms are "
                          "{:.1f} ms); excludes the touch screen's and panel's own delay",
                          1e3 * times_s[times_s.size() / 2], times_s.size(),
                          1e3 * times_s[times_s.size() - 2], 1e3 * times_s.back(),
                          1e3 * (frame_s + beside_a_frame_s)));
} catch (const Error& error) {
  report.line(CheckVerdict::warning, "touch delay", fmt::format("not measured: {}", error.what()));
}

void check_log(Report& report, const std::string& db) {
  if (!std::filesystem::exists(db))
    return report.line(CheckVerdict::ok, "log", fmt::format("{} does not exist yet", db));
  const std::vector<std::string> faults = faults_of_file(LogReader(db), db);
  if (faults.empty()) return report.line(CheckVerdict::ok, "log", fmt::format("{} is sound", db));
  for (const std::string& fault : faults) report.line(CheckVerdict::failed, "log", fault);
}

void check_shutter(Report& report, const Intrinsics& camera) {
  if (!(camera.readout_s > 0))
    return report.line(CheckVerdict::ok, "shutter",
                       "the camera file has no readout_s: a global shutter, or not measured yet "
                       "(heft calibrate camera --shutter)");
  report.line(
      CheckVerdict::ok, "shutter",
      fmt::format(
          "read-out {:.1f} ms, corrected by the tracker; uncorrected, the error would be half "
          "a millimeter off at {:.2f} m/s",
          1e3 * camera.readout_s, half_millimeter_m_s(camera.readout_s)));
}

// The check before a session: the camera, if one is given, and the display, if there is one.
// Without a camera the window shows the rendered pictures of tracker mouse.
void check_as_before_a_session(Report& report, SessionOptions given, double rate_hz,
                               bool has_display) {
  const bool has_camera = given.tracker.has_value();
  if (!has_camera && !has_display) return;
  if (has_camera && tracker_named(given.tracker->name).what != TrackerWhat::source)
    throw Error("--tracker: expected camera:N, video:FILE or frames:FOLDER", ExitCode::usage);
  if (!has_camera) given.tracker = Plug{"mouse"};
  if (!has_display) given.responder = Plug{"simulated"};  // a person needs a window
  Protocol protocol = load_protocol(installed_file("protocols/paper.toml"));
  protocol.display_rate_hz = rate_hz;
  const ResolvedConfig config = resolve(given, protocol, 0);
  if (has_camera) print_camera_file(given, config->config);
  for (const CheckResult& result : Equipment(config).check())
    report.line(result.verdict, result.name, result.finding);
  if (has_camera) check_shutter(report, config->apparatus.camera);
}

// Sessions with that display record it in their setup.
void keep_latency(const std::string& file, DisplayMeasures measured, const DisplayDelay& delay) {
  measured.latency_ms = delay.figures_ms();
  replace_file(file, to_toml(measured));
  print("{} has it as [latency]: sessions with this display record it in their setup\n", file);
}

// Requires that the camera films the participant's display.
void measure_latency(const SessionOptions& given, double rate_hz, int display) {
  constexpr int n_changes = 60;
  if (!given.tracker || given.tracker->name != "camera")
    throw Error("--latency needs the camera that looks at the display: --tracker camera:0",
                ExitCode::usage);
  const std::string file = given.display_file.value_or(default_display_file);
  std::optional<DisplayMeasures> measured;
  if (given.display_file || std::filesystem::exists(file))
    measured = parse_display(read_text_file(file), file);
  CameraRequest request;
  request.rate_hz = std::max(request.rate_hz, rate_hz);
  const auto camera = open_camera(given.tracker->name, given.tracker->what, request);
  ViewSetup setup;
  setup.texts = load_texts(texts_file("en"));
  setup.patch = true;
  setup.display = display;
  const auto window = window_module().make(setup);
  const auto present = [&] {
    window->wait(0);
    return window->present({}, {.screen = Screen::setting_up}).value_or(monotonic_s());
  };
  const DisplayDelay delay = measure_display_delay(*camera, present, n_changes);
  const CheckResult result = delay_verdict(delay);
  Report report;
  report.line(result.verdict, result.name, result.finding);
  if (report.failed()) throw Error("the display's delay was not measured");
  if (measured) return keep_latency(file, *measured, delay);
  say("not recorded for sessions: there is no {}, which heft calibrate display makes\n", file);
}

void list_cameras(const std::vector<VideoDevice>& devices) {
  print("\ncameras:\n");
  for (const VideoDevice& device : devices) {
    print("  camera:{:<9} /dev/video{} {}\n", device.number, device.number, device.name);
    for (const std::string& mode : device_modes(device)) print("  {:<16}   {}\n", "", mode);
  }
  if (devices.empty()) print("  none is connected\n");
}

// Everything that options name.
void list_plugs() {
  list_cameras(video_devices());
  print("simulators:\n");
  for (const SimulatorEntry& entry : simulators()) {
    print("  {:<22} {}\n", entry.name, entry.summary);
    if (!entry.warning.empty()) print("  {:<22} warning: {}\n", "", entry.warning);
  }
  print("trackers:\n");
  for (const TrackerEntry& entry : trackers()) print("  {:<16} {}\n", entry.name, entry.summary);
  print("views:\n");
  for (const ViewEntry& entry : views()) print("  {:<16} {}\n", entry.name, entry.summary);
  print("responders:\n");
  for (const ResponderEntry& entry : responders())
    print("  {:<16} {}\n", entry.name, entry.summary);
}

void print_next_steps() {
  print(
      "\ncameras: {}\n"
      "check one: heft doctor --tracker camera:0 --camera-file camera.yaml\n"
      "trackers, views, simulators, responders: heft doctor --list\n"
      "a responder's parameters: heft doctor --responder NAME\n",
      list_of(video_devices()));
}

void diagnose(const std::string& db, const SessionOptions& given, double rate_hz) {
  refuse_special_file(db);
  Report report;
  report.line(CheckVerdict::ok, "program", fmt::format("heft {}, {}", HEFT_VERSION, build_name()));
  check_packages(report);
  const auto parent = std::filesystem::path(db).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  check_space(report, folder);
  check_file_system(report, folder);
  check_commit(report, folder);
  check_log(report, db);
  const ScreenTexts texts = load_texts(texts_file("en"));
  check_displays(report, texts);
  const std::vector<DisplayFacts> displays = displays_if_any();
  check_touch_delay(report, folder, texts, displays);
  for (const CheckResult& result : outlet_verdicts())
    report.line(result.verdict, result.name, result.finding);
  check_as_before_a_session(report, given, rate_hz, !displays.empty());
  print_next_steps();
  if (report.failed()) throw Error("this machine is not ready; see the lines marked FAILED");
}

}  // namespace

void add_doctor(Command& app) {
  struct DoctorOptions {
    std::string db, responder;
    SessionOptions given;
    double rate_hz = 15;
    bool list = false, latency = false;
    int display = 0;
  };
  const auto options = std::make_shared<DoctorOptions>();
  Command command = app.add_command(
      "doctor", "check this machine and a camera; list trackers, views, responders",
      {"heft doctor", "heft doctor --list", "heft doctor --tracker camera:0",
       "heft doctor --tracker camera:0 --camera-file camera.yaml --board board.toml",
       "heft doctor --tracker camera:0 --latency", "heft doctor --responder simulated"});
  command.add_log(options->db, "the log to check, with its folder and disk");
  add_plug(command, "--tracker", options->given.tracker,
           "examine this camera: camera:N, video:FILE, frames:FOLDER");
  add_apparatus_options(command, options->given);
  command.group("Options");
  command.add_option("--display-rate", &options->rate_hz, "required pictures per second")
      .shows_default();
  command.add_flag("--list", options->list,
                   "only list cameras, trackers, views, simulators and responders");
  command.add_flag("--latency", options->latency,
                   "only measure how late the display shows a frame, with --tracker camera:N "
                   "looking at the patch in its lower corner, and add it to the display's file");
  command.add_option("--display-file", &options->given.display_file,
                     "for --latency: the measured display (default: display.toml, if it exists)");
  command.add_option("--display", &options->display, "number of that display").shows_default();
  command.add_option("--responder", &options->responder, "only describe its parameters");
  command.does([options] {
    if (options->list) return list_plugs();
    if (options->latency)
      return measure_latency(options->given, options->rate_hz, options->display);
    if (options->responder.empty()) return diagnose(options->db, options->given, options->rate_hz);
    const std::string text = describe_parameters(responder_named(options->responder));
    print("{}", text.empty() ? "it has no parameters\n" : text);
  });
}

}  // namespace heft::cli
