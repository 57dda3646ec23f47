#include "window/Painter.h"

#include <SDL_opengl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

namespace heft {

namespace {
namespace colors {

constexpr ImU32 button = IM_COL32(49, 56, 65, 255);
constexpr ImU32 button_pressed = IM_COL32(79, 90, 104, 255);
constexpr ImU32 button_disabled = IM_COL32(29, 33, 38, 255);
constexpr ImU32 accent = IM_COL32(94, 177, 255, 255);
constexpr ImU32 accent_pressed = IM_COL32(158, 209, 255, 255);
constexpr ImU32 on_accent = IM_COL32(10, 24, 38, 255);
constexpr ImU32 strong = IM_COL32(243, 245, 247, 255);
constexpr ImU32 soft = IM_COL32(196, 203, 211, 255);
constexpr ImU32 disabled = IM_COL32(96, 105, 115, 255);
constexpr ImU32 flag = IM_COL32(250, 250, 250, 255);
constexpr ImU32 notice = IM_COL32(background_rgb[0], background_rgb[1], background_rgb[2], 225);
}  // namespace colors

ImVec2 corner(const Rect& area) {
  return {area.x, area.y};
}

ImVec2 opposite_corner(const Rect& area) {
  return {area.right(), area.bottom()};
}

ImTextureID drawable(unsigned texture) {
  return reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(texture));
}

// On whole pixels, so that letters are not blurred.
void write(ImDrawList& list, const Paint& paint, const std::string& text, float x, float y,
           float size_px, ImU32 color) {
  const WrittenTexture& ink =
      paint.textures.of(paint.typeface.written(text, size_px), paint.typeface);
  if (ink.texture == 0) return;
  const ImVec2 from{std::round(x) + static_cast<float>(ink.left),
                    std::round(y) + static_cast<float>(ink.top)};
  const ImVec2 to{from.x + static_cast<float>(ink.width), from.y + static_cast<float>(ink.height)};
  list.AddImage(drawable(ink.texture), from, to, {0, 0}, {1, 1}, color);
}

// Lines centered in an area.
void write_centered(ImDrawList& list, const Paint& paint, const FittedText& text, const Rect& area,
                    ImU32 color) {
  const float line_px = Typeface::line_height_px(text.size_px);
  // Letters are at the top of their line.
  const float height_px = line_px * static_cast<float>(text.lines.size() - 1) + text.size_px;
  float y = area.y + (area.height - height_px) / 2;
  for (const std::string& line : text.lines) {
    const float x = area.x + (area.width - paint.typeface.width_px(line, text.size_px)) / 2;
    write(list, paint, line, x, y, text.size_px, color);
    y += line_px;
  }
}

ImU32 fill_of(const Control& control, bool pressed, bool live) {
  if (!live) return colors::button_disabled;
  const bool accented = control.look == Look::primary;
  if (pressed) return accented ? colors::accent_pressed : colors::button_pressed;
  return accented ? colors::accent : colors::button;
}

ImU32 ink_of(const Control& control, bool live) {
  if (!live) return colors::disabled;
  return control.look == Look::primary ? colors::on_accent : colors::strong;
}

void paint_words(ImDrawList& list, const ControlWords& words, const Paint& paint, ImU32 ink) {
  write_centered(list, paint, words.text, words.text_area, ink);
  if (!words.note.lines.empty())
    write_centered(list, paint, words.note, words.note_area, colors::accent);
}

// A line from end to end, and a bar at the value: hollow and in the middle until it is set, so that
// it favors no answer.
void paint_slider(ImDrawList& list, const Rect& area, const SliderValue& slid, float target) {
  const float thick = 0.06f * target, inset = 0.12f * target;
  const float left = area.x + inset, right = area.right() - inset, y = area.y + area.height / 2;
  list.AddRectFilled({left, y - thick / 2}, {right, y + thick / 2}, colors::soft, thick / 2);
  const float x = std::clamp(area.x + slid.fraction.value_or(0.5f) * area.width, left, right);
  const ImVec2 from{x - thick, area.y + inset}, to{x + thick, area.bottom() - inset};
  if (slid.fraction) return list.AddRectFilled(from, to, colors::accent, thick);
  list.AddRectFilled(from, to, colors::button, thick);
  list.AddRect(from, to, colors::soft, thick, 0, thick / 3);
}

void paint_control(ImDrawList& list, const Control& control, const ControlWords& words,
                   const Paint& paint) {
  const bool pressed = control.enabled && paint.is_pressed(control.name);
  const bool live = control.enabled && (pressed || paint.takes_touches(control.name));
  const float rounding = 0.14f * paint.measures.target;
  const ImVec2 from = corner(control.area), to = opposite_corner(control.area);
  list.AddRectFilled(from, to, fill_of(control, pressed, live), rounding);
  if (control.chosen)
    list.AddRect(from, to, colors::accent, rounding, 0, 0.045f * paint.measures.target);
  if (control.slide) return paint_slider(list, control.area, *control.slide, paint.measures.target);
  paint_words(list, words, paint, ink_of(control, live));
}

void paint_scene(ImDrawList& list, const PaintedScene& scene) {
  const auto alpha = static_cast<int>(std::lround(255 * std::clamp(scene.opacity, 0.f, 1.f)));
  list.AddImage(drawable(scene.texture), corner(scene.area), opposite_corner(scene.area),
                corner(scene.part), opposite_corner(scene.part), IM_COL32(255, 255, 255, alpha));
}

// The place of a flag above its tip, raised if another flag is in the way; below the tip where the
// scene ends above.
Rect place_of_flag(const PlacedMark& placed, float width, float height, float tip,
                   const Rect& scene, const std::vector<Rect>& flags) {
  Rect flag{std::clamp(placed.x - width / 2, scene.x, std::max(scene.x, scene.right() - width)),
            placed.y - tip - height + 1, width, height};
  const auto is_free = [&] {
    return std::ranges::none_of(flags, [&](const Rect& other) { return flag.overlaps(other); });
  };
  const float step = height / 4;
  while (!is_free() && flag.y >= scene.y) flag.y -= step;
  if (flag.y >= scene.y) return flag;
  flag.y = scene.y;
  while (!is_free() && flag.bottom() + step <= scene.bottom()) flag.y += step;
  return flag;
}

// A flag with a label, its tip at the cube; without a label a larger tip alone. The outline keeps
// it visible on white paper.
void paint_mark(ImDrawList& list, const PlacedMark& placed, const Paint& paint,
                std::vector<Rect>& flags) {
  const ImU32 fill = placed.mark.selected ? colors::accent : colors::flag;
  const float size = paint.measures.small, tip = (placed.mark.text.empty() ? 1 : 0.55f) * size;
  const ImVec2 left{placed.x - tip, placed.y - tip}, right{placed.x + tip, placed.y - tip};
  list.AddTriangleFilled(left, right, {placed.x, placed.y}, fill);
  list.AddTriangle(left, right, {placed.x, placed.y}, colors::on_accent, 0.12f * size);
  if (placed.mark.text.empty()) return;
  const float width = paint.typeface.width_px(placed.mark.text, size) + 1.2f * size;
  const float height = 1.7f * size;
  const Rect flag = place_of_flag(placed, width, height, tip, paint.scene->area, flags);
  flags.push_back(flag);
  list.AddLine({placed.x, flag.bottom() - 1}, {placed.x, placed.y}, fill, 0.15f * size);
  list.AddRectFilled(corner(flag), opposite_corner(flag), fill, height / 4);
  write_centered(list, paint, {size, {placed.mark.text}}, flag, colors::on_accent);
}

void paint_notice(ImDrawList& list, const std::string& notice, bool at_top, const Paint& paint) {
  if (notice.empty()) return;
  const auto [text, area] =
      words_of_notice(notice, paint.scene->area, paint.typeface, paint.measures, at_top);
  list.AddRectFilled(corner(area), opposite_corner(area), colors::notice,
                     0.1f * paint.measures.target);
  write_centered(list, paint, text, area, colors::strong);
}
}  // namespace

void paint_page(ImDrawList& list, const Page& page, const Paint& paint) {
  if (paint.scene) {
    paint_scene(list, *paint.scene);
    paint_notice(list, page.hint, true, paint);
    list.PushClipRect(corner(paint.scene->area), opposite_corner(paint.scene->area), true);
    std::vector<Rect> flags;
    for (const PlacedMark& mark : paint.marks) paint_mark(list, mark, paint, flags);
    list.PopClipRect();
    paint_notice(list, page.notice, false, paint);
  }
  for (const TextLine& line : page.lines)
    write(list, paint, line.text, line.x, line.y, line.size_px,
          line.tone == Tone::strong ? colors::strong : colors::soft);
  const auto words = words_on(page.controls, paint.typeface, paint.measures);
  for (std::size_t i = 0; i < words.size(); ++i)
    paint_control(list, page.controls[i], words[i], paint);
  if (!paint.patch) return;
  const Rect place = place_of(*paint.patch, paint.measures);
  list.AddRectFilled(corner(place), opposite_corner(place),
                     paint.patch->white ? IM_COL32_WHITE : IM_COL32_BLACK);
}

namespace {
// The largest area inside `space`, centered, with the aspect ratio of width and height.
Rect fitted_scene(const Rect& space, float width, float height) {
  const float scale = std::min(space.width / width, space.height / height);
  return {space.x + (space.width - scale * width) / 2,
          space.y + (space.height - scale * height) / 2, scale * width, scale * height};
}

Rect rect_of(const Eigen::AlignedBox2d& box) {
  const Eigen::Vector2f from = box.min().cast<float>(), size = box.sizes().cast<float>();
  return {from.x(), from.y(), size.x(), size.y()};
}

// Extends an interval at both ends, within 0 and the limit.
void widen(float& begin, float& length, float wanted, float limit) {
  wanted = std::min(wanted, limit);
  if (wanted <= length) return;
  begin = std::clamp(begin - (wanted - length) / 2, 0.f, limit - wanted);
  length = wanted;
}
}  // namespace

const Image& SceneOnScreen::draw(const ViewFrame& shown) {
  const Image& image = drawing_.draw(shown);
  width_px_ = image.width;
  height_px_ = image.height;
  find_part();
  return image;
}

// The camera's pose is measured in each picture with noise; the displayed part of the frame is
// kept.
void SceneOnScreen::find_part() {
  constexpr float still_px = 12;
  const Rect whole{0, 0, static_cast<float>(width_px_), static_cast<float>(height_px_)};
  const Rect found = shown_m_ ? rect_of(drawing_.pixels_around(*shown_m_)) : whole;
  const float moved = std::max({std::abs(found.x - wanted_px_.x), std::abs(found.y - wanted_px_.y),
                                std::abs(found.right() - wanted_px_.right()),
                                std::abs(found.bottom() - wanted_px_.bottom())});
  if (moved > still_px) wanted_px_ = found;
}

// Fills remaining space with more of the frame.
void SceneOnScreen::fill_space(const Rect& space) {
  part_px_ = wanted_px_;
  const float ratio = space.width / space.height;
  widen(part_px_.x, part_px_.width, part_px_.height * ratio, static_cast<float>(width_px_));
  widen(part_px_.y, part_px_.height, part_px_.width / ratio, static_cast<float>(height_px_));
}

void SceneOnScreen::place(const std::optional<Rect>& space) {
  area_.reset();
  if (!space || width_px_ == 0) return;
  fill_space(*space);
  area_ = fitted_scene(*space, part_px_.width, part_px_.height);
}

Rect SceneOnScreen::part() const {
  const auto width = static_cast<float>(width_px_), height = static_cast<float>(height_px_);
  return {part_px_.x / width, part_px_.y / height, part_px_.width / width,
          part_px_.height / height};
}

std::optional<double> SceneOnScreen::distance_px(const Eigen::Vector3d& a_m,
                                                 const Eigen::Vector3d& b_m) const {
  if (!area_) return std::nullopt;
  const auto a = drawing_.pixel_of(a_m), b = drawing_.pixel_of(b_m);
  if (!a || !b) return std::nullopt;
  return (*a - *b).norm() * static_cast<double>(scale());
}

std::optional<int> SceneOnScreen::slot_at(float x, float y) const {
  if (!area_ || !area_->contains(x, y)) return std::nullopt;
  const Eigen::Vector2d pixel = frame_pixel(x, y);
  return drawing_.slot_at(pixel.x(), pixel.y());
}

// Pixel centers are integers in the frame, halves on the screen.
Eigen::Vector2d SceneOnScreen::frame_pixel(float x, float y) const {
  return {part_px_.x + (x - area_->x) / scale() - 0.5f,
          part_px_.y + (y - area_->y) / scale() - 0.5f};
}

std::optional<Eigen::Vector3d> SceneOnScreen::point_at_height(float x, float y,
                                                              double height_m) const {
  if (!area_) return std::nullopt;
  const float inside_x = std::clamp(x, area_->x, area_->right());
  const float inside_y = std::clamp(y, area_->y, area_->bottom());
  return drawing_.point_at_height(frame_pixel(inside_x, inside_y), height_m);
}

std::optional<int> SceneOnScreen::slot_near(float x, float y, float reach_px) const {
  if (const auto slot = slot_at(x, y)) return slot;
  constexpr int n_directions = 16;
  std::optional<int> near;
  for (int i = 0; i < n_directions; ++i)
    for (const float fraction : {0.5f, 1.f}) {
      const float angle = 2 * std::numbers::pi_v<float> * static_cast<float>(i) / n_directions;
      const float radius = fraction * reach_px;
      const auto slot = slot_at(x + radius * std::cos(angle), y + radius * std::sin(angle));
      if (slot && near && slot != near) return std::nullopt;
      if (slot) near = slot;
    }
  return near;
}

std::vector<PlacedMark> SceneOnScreen::placed(const std::vector<CubeMark>& marks) const {
  std::vector<PlacedMark> all;
  if (!area_) return all;
  for (const CubeMark& mark : marks)
    if (const auto place = drawing_.label_place(mark.slot))
      all.push_back({mark, area_->x + (static_cast<float>(place->x() + 0.5) - part_px_.x) * scale(),
                     area_->y + (static_cast<float>(place->y() + 0.5) - part_px_.y) * scale()});
  return all;
}

namespace {
unsigned texture_of(const Ink& ink) {
  constexpr std::uint8_t white = 255;
  std::vector<std::uint8_t> pixels;
  pixels.reserve(4 * ink.coverage.size());
  for (const std::uint8_t covered : ink.coverage)
    pixels.insert(pixels.end(), {white, white, white, covered});
  GLuint texture = 0;
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, ink.width, ink.height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               pixels.data());
  return texture;
}
}  // namespace

WrittenTextures::~WrittenTextures() {
  for (const auto& [line, made] : textures_) glDeleteTextures(1, &made.texture);
}

const WrittenTexture& WrittenTextures::of(const WrittenLine& line, const Typeface& typeface) {
  const auto [place, is_new] = textures_.try_emplace(line);
  WrittenTexture& made = place->second;
  made.used = true;
  if (!is_new) return made;
  const Ink ink = typeface.ink(line);
  made.left = ink.left;
  made.top = ink.top;
  if (ink.coverage.empty()) return made;
  made.width = ink.width;
  made.height = ink.height;
  made.texture = texture_of(ink);
  return made;
}

void WrittenTextures::end_frame() {
  for (auto at = textures_.begin(); at != textures_.end();) {
    if (std::exchange(at->second.used, false)) {
      ++at;
    } else {
      glDeleteTextures(1, &at->second.texture);
      at = textures_.erase(at);
    }
  }
}

}  // namespace heft
