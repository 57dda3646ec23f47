#include "protocol/FileKind.h"

#include <algorithm>
#include <vector>

#include "protocol/Mistakes.h"
#include "protocol/TomlDocument.h"

namespace heft {

namespace {
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
      {FileKind::texts, "language", {"buttons", "slots", "consent", "welcome", "trial", "thanks"}}};
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
               "effector file ([box] or [[tag]]), a synthetic camera file (exposure_s) or a text "
               "file (language)");
  throw mistakes.as_error();
}

}  // namespace heft
