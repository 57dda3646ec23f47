// Which kind of file a text is, and the kinds that take few lines to read.
#include "protocol/Files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <vector>

#include "base/Printable.h"
#include "base/TextFile.h"
#include "experiment/Parameter.h"
#include "protocol/ProcedureReader.h"
#include "protocol/TableReader.h"
#include "protocol/TomlDocument.h"
#include "psychophysics/Interleaving.h"
#include "tracking/SyntheticCamera.h"

namespace heft {

namespace {
constexpr Range exposures_s{0, 0.05};
constexpr Range readouts_s{0, 0.05};
constexpr Range blurs_px{0, 10};  // much more, and nothing is rendered in useful time
constexpr Range gammas{1, 3};
constexpr Range vignettings{0, 1, false, true};
constexpr Range lights{0, 10, true};
constexpr Range noises{0, 100};

// None where the value is no finite number, truth value or text.
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
  std::string_view mark;  ///< a key that tells the kind by itself
  std::vector<std::string_view> keys;
};

// A scene may have nothing but keys that a protocol has too, so it comes first; a board likewise
// before the effector.
const std::vector<KindKeys>& kinds() {
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
       {"blur_px", "vignetting", "light", "gamma", "noise_levels", "hand"}},
      {FileKind::texts, "language", {"buttons", "slots", "consent", "welcome", "trial", "thanks"}},
      {FileKind::questionnaires, "questionnaire", {}},
      {FileKind::display, "eye_distance_mm", {"width_px", "height_px", "width_mm", "height_mm"}},
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
  const auto best = std::ranges::max_element(kinds(), {}, n);
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

InterleavedProcedures parse_procedure(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  const TomlTable root = parse_toml(text, file);
  TableReader reader(root, mistakes);
  InterleavedProcedures config;
  reader.require({"staircase"});
  reader.read("seed", config.seed, {0, std::numeric_limits<std::int64_t>::max()});
  config.interleaving = read_interleaving(reader);
  UniqueNames names("staircase");
  for (TableReader& table : reader.tables("staircase")) {
    auto procedure = read_procedure(table);
    if (!procedure) continue;
    names.check(table, procedure->name);
    config.staircases.push_back(std::move(*procedure));
  }
  reader.close();
  mistakes.throw_if_any();
  return config;
}

InterleavedProcedures load_procedure(const std::string& path) {
  return parse_procedure(read_text_file(path), path);
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
  reader.read("hand", settings.hand);
  reader.close();
  mistakes.throw_if_any();
  return settings;
}

std::string described(const Optics& optics) {
  const std::string readout =
      optics.readout_s > 0 ? fmt::format("read-out {:g} ms, ", 1e3 * optics.readout_s) : "";
  return fmt::format("exposure {:g} ms, {}blur {:g} px, noise {:g} levels, {}",
                     1e3 * optics.exposure_s, readout, optics.blur_px, optics.noise,
                     optics.gamma ? fmt::format("gamma {:g}", *optics.gamma) : "sRGB");
}

std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file) {
  Mistakes mistakes(file);
  std::vector<Parameter> parameters;
  for (const TomlEntry& entry : parse_toml(text, file)) {
    if (auto value = value_of(entry.node))
      parameters.push_back(
          {entry.key, std::move(*value), {file, entry.node.place.line, entry.node.place.column}});
    else
      mistakes.add(entry.node.place,
                   fmt::format("{} is {}, expected a finite number, a text, true or false",
                               printable(entry.key), shown(entry.node)));
  }
  mistakes.throw_if_any();
  std::ranges::sort(parameters, {}, [](const Parameter& parameter) {
    return std::tuple(parameter.place.line, parameter.place.column);
  });
  return parameters;
}

}  // namespace heft
