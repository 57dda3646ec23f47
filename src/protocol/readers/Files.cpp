// Recognizes kinds of files, and reads the short ones.
#include "protocol/readers/Files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <vector>

#include "base/files/Printable.h"
#include "base/files/TextFile.h"
#include "experiment/Participant.h"
#include "experiment/Stage.h"
#include "protocol/readers/ProtocolTables.h"
#include "protocol/toml/TableReader.h"
#include "protocol/toml/TomlDocument.h"
#include "tracking/synthetic/SyntheticCamera.h"

namespace heft {

namespace {
constexpr Range exposures_s{0, 0.05};
constexpr Range readouts_s{0, 0.05};
constexpr Range blurs_px{0, 10};  // larger ones take too long to render
constexpr Range gammas{1, 3};
constexpr Range vignettings{0, 1, false, true};
constexpr Range lights{0, 10, true};
constexpr Range noises{0, 100};
constexpr Range shares{0, 1};
constexpr Range sharpenings{0, 5};
constexpr WholeRange jpeg_qualities{1, 100};
constexpr Range lost_shares{0, 0.9};
constexpr Range ink_spreads_m{0, 0.0005};
constexpr Range breathings{0, 0.05};
constexpr Range scales{0.9, 1.1};  // of prints and lenses

// None unless the value is a finite number, truth value or text.
std::optional<std::variant<double, bool, std::string>> value_of(const TomlNode& node) {
  if (const auto* boolean = std::get_if<bool>(&node.value)) return *boolean;
  if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
  if (const auto* whole = std::get_if<std::int64_t>(&node.value))
    return static_cast<double>(*whole);
  const auto* number = std::get_if<double>(&node.value);
  if (number && std::isfinite(*number)) return *number;
  return std::nullopt;
}

struct KindKeys {
  FileKind kind;
  std::string_view mark;  ///< a key that determines the kind
  std::vector<std::string_view> keys;
};

// Scenes come first, because all their keys may occur in protocols, too; boards before effectors.
const std::vector<KindKeys>& kinds_of_files() {
  static const std::vector<KindKeys> table{
      {FileKind::scene, "cube", {"clone", "friction", "gravity_m_s2", "coupling", "effector"}},
      {FileKind::protocol,
       "block",
       {"title", "display_rate_hz", "void_after_s", "require_contact", "physics", "layout",
        "screens", "coupling", "effector"}},
      {FileKind::procedure, "staircase", {"seed", "interleave", "max_lag"}},
      {FileKind::board, "grid", {"tag", "family", "ruler_measured_m"}},
      {FileKind::effector, "box", {"tag", "family", "ruler_measured_m", "size_m"}},
      {FileKind::synthetic_camera,
       "exposure_s",
       {"readout_s",
        "blur_px",
        "vignetting",
        "light",
        "gamma",
        "noise_levels",
        "shadow",
        "glare",
        "film_curve",
        "s_curve",
        "mosaic",
        "sharpening",
        "jpeg_quality",
        "auto_gain",
        "auto_white_balance",
        "flicker",
        "breathing",
        "last_picture",
        "repeated",
        "dropped",
        "board_tag_scale",
        "effector_tag_scale",
        "focal_length_scale",
        "ink_spread_m",
        "hand"}},
      {FileKind::texts, "language", {"buttons", "slots", "consent", "welcome", "trial", "thanks"}},
      {FileKind::questionnaires, "questionnaire", {}},
      {FileKind::display,
       "eye_distance_mm",
       {"width_px", "height_px", "width_mm", "height_mm", "latency"}},
      {FileKind::study,
       "study",
       {"participants", "group", "order", "protocol", "seed", "id_prefix", "db", "backup"}}};
  return table;
}

std::ptrdiff_t matches(const KindKeys& kind, const TomlTable& root) {
  constexpr std::ptrdiff_t decisive = 100;
  std::ptrdiff_t n = 0;
  for (const TomlEntry& entry : root)
    n += entry.key == kind.mark ? decisive : std::ranges::count(kind.keys, entry.key);
  return n;
}
}  // namespace

FileKind recognized_kind(const std::string& text, const std::string& file) {
  const TomlTable root = parse_toml(text, file);
  const auto n = [&](const KindKeys& kind) { return matches(kind, root); };
  const auto best = std::ranges::max_element(kinds_of_files(), {}, n);
  if (n(*best) > 0) return best->kind;
  Mistakes mistakes(file);
  mistakes.add({},
               "no key of this file belongs to a protocol (it has [[block]]), a procedure file "
               "([[staircase]]), a scene file ([[cube]]), a board file ([grid] or [[tag]]), an "
               "effector file ([box] or [[tag]]), a synthetic camera file (exposure_s), a text "
               "file (language), a questionnaire file ([questionnaire.NAME]), a display file "
               "(eye_distance_mm) or a study plan (study)");
  throw mistakes.as_error();
}

SyntheticSettings parse_synthetic_camera(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  SyntheticSettings settings;
  Optics& optics = settings.optics;
  reader.read("exposure_s", optics.exposure_s, exposures_s);
  reader.read("readout_s", optics.readout_s, readouts_s);
  reader.read("blur_px", optics.blur_px, blurs_px);
  reader.read("vignetting", optics.vignetting, vignettings);
  reader.read("light", optics.exposure, lights);
  reader.read("gamma", optics.gamma, gammas);
  reader.read("noise_levels", optics.noise, noises);
  reader.read("shadow", optics.shadow, shares);
  reader.read("glare", optics.glare, shares);
  reader.read("film_curve", optics.film_curve, shares);
  reader.read("s_curve", optics.s_curve, shares);
  reader.read("mosaic", optics.mosaic);
  reader.read("sharpening", optics.sharpening, sharpenings);
  reader.read("jpeg_quality", optics.jpeg_quality, jpeg_qualities);
  reader.read("auto_gain", optics.auto_gain, lost_shares);
  reader.read("auto_white_balance", optics.auto_white_balance, lost_shares);
  reader.read("flicker", optics.flicker, lost_shares);
  reader.read("breathing", optics.breathing, breathings);
  reader.read("last_picture", optics.last_picture, lost_shares);
  reader.read("repeated", optics.repeated, lost_shares);
  reader.read("dropped", optics.dropped, lost_shares);
  reader.read("board_tag_scale", settings.files.board_tag_scale, scales);
  reader.read("effector_tag_scale", settings.files.effector_tag_scale, scales);
  reader.read("focal_length_scale", settings.files.focal_length_scale, scales);
  reader.read("ink_spread_m", settings.files.ink_m, ink_spreads_m);
  reader.read("hand", settings.hand);
  reader.close();
  mistakes.throw_if_any();
  return settings;
}

std::string described(const SyntheticSettings& settings) {
  const Optics& optics = settings.optics;
  const FileErrors& files = settings.files;
  std::string text = fmt::format("exposure {:g} ms, ", 1e3 * optics.exposure_s);
  if (optics.readout_s > 0) text += fmt::format("read-out {:g} ms, ", 1e3 * optics.readout_s);
  text +=
      fmt::format("blur {:g} px, noise {:g} levels, {}", optics.blur_px, optics.noise,
                  optics.gamma ? fmt::format("gamma {:g}", *optics.gamma) : std::string("sRGB"));
  const auto add = [&](const char* what, double value, double usual) {
    if (value != usual) text += fmt::format(", {} {:g}", what, value);
  };
  add("light", optics.exposure, 1);
  add("shadow", optics.shadow, 0);
  add("glare", optics.glare, 0);
  add("film curve", optics.film_curve, 0);
  add("S-curve", optics.s_curve, 0);
  if (optics.mosaic) text += ", mosaic";
  add("sharpening", optics.sharpening, 0);
  add("JPEG", optics.jpeg_quality, 0);
  add("automatic gain", optics.auto_gain, 0);
  add("automatic white balance", optics.auto_white_balance, 0);
  add("flicker", optics.flicker, 0);
  add("focus breathing", optics.breathing, 0);
  add("of the last picture", optics.last_picture, 0);
  add("repeated", optics.repeated, 0);
  add("dropped", optics.dropped, 0);
  add("board's tags by", files.board_tag_scale, 1);
  add("effector's tags by", files.effector_tag_scale, 1);
  add("focal length by", files.focal_length_scale, 1);
  add("ink spread in mm", 1e3 * files.ink_m, 0);
  return text;
}

namespace {
// Appends a table's values; those of a table inside it as "table.key".
void flatten(const TomlTable& table, const std::string& prefix, const std::string& file,
             std::vector<Parameter>& parameters, Mistakes& mistakes) {
  for (const TomlEntry& entry : table) {
    const std::string name = prefix + entry.key;
    if (const auto* inner = std::get_if<TomlTable>(&entry.node.value); inner && !inner->empty())
      flatten(*inner, name + ".", file, parameters, mistakes);
    else if (auto value = value_of(entry.node))
      parameters.push_back(
          {name, std::move(*value), {file, entry.node.place.line, entry.node.place.column}});
    else
      mistakes.add(entry.node.place,
                   fmt::format("{} is {}, expected a finite number, a text, true or false",
                               printable(name), shown(entry.node)));
  }
}
}  // namespace

std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  std::vector<Parameter> parameters;
  flatten(parse_toml(text, file), "", file, parameters, mistakes);
  mistakes.throw_if_any();
  std::ranges::sort(parameters, {}, [](const Parameter& parameter) {
    return std::tuple(parameter.place.line, parameter.place.column);
  });
  return parameters;
}

namespace {
constexpr WholeRange sides_px{100, 20000};
constexpr Range sides_mm{20, 5000}, distances_mm{50, 10000}, latencies_ms{0, 1000};
}  // namespace

DisplayMeasures parse_display(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  DisplayMeasures display;
  reader.require({"width_px", "height_px", "width_mm", "height_mm", "eye_distance_mm"});
  reader.read("width_px", display.w_px, sides_px);
  reader.read("height_px", display.h_px, sides_px);
  reader.read("width_mm", display.w_mm, sides_mm);
  reader.read("height_mm", display.h_mm, sides_mm);
  reader.read("eye_distance_mm", display.eye_distance_mm, distances_mm);
  if (auto latency = reader.table("latency")) {
    latency->require({"light_ms", "picture_ms", "picture_p5_ms", "picture_p95_ms"});
    for (const char* name : latency_names)
      latency->read(name, display.latency_ms[name], latencies_ms);
    latency->close();
  }
  reader.close();
  mistakes.throw_if_any();
  return display;
}

std::string to_toml(const DisplayMeasures& display) {
  std::string text = fmt::format(
      "# A display, made by heft calibrate display: sessions use it with --display-file.\n"
      "width_px = {}\nheight_px = {}\nwidth_mm = {:.4g}\nheight_mm = {:.4g}\n"
      "eye_distance_mm = {:.4g}  # from the participant's eyes to the display\n",
      display.w_px, display.h_px, display.w_mm, display.h_mm, display.eye_distance_mm);
  if (display.latency_ms.empty()) return text;
  text += "\n[latency]  # of a frame, found by heft doctor --latency\n";
  for (const char* name : latency_names)
    text += fmt::format("{} = {:.1f}\n", name, display.latency_ms.at(name));
  return text;
}

}  // namespace heft
