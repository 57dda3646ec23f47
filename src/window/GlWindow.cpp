#include "window/GlWindow.h"

#include <SDL_opengl.h>
#include <backends/imgui_impl_opengl3.h>
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <utility>

#include "base/Error.h"
#include "window/Painter.h"

namespace heft {

namespace {
Error no_display(const char* what) {
  return Error(fmt::format("cannot open the participant's window: {}: {}; start Heft on a desktop "
                           "with a display (DISPLAY or WAYLAND_DISPLAY set), or choose another "
                           "view with --view",
                           what, SDL_GetError()),
               ExitCode::device_missing);
}

// Xlib ends the program when the display's connection breaks, whatever this returns, so that only a
// message is possible. Every answer is logged before the screen changes.
int on_lost_display(void*) {
  std::fputs(
      "error: the display was closed or its connection broke; answers given so far are "
      "saved, continue with: heft resume\n",
      stderr);
  std::_Exit(static_cast<int>(ExitCode::device_missing));
}

// SDL loads Xlib at run time, so that the function is looked up instead of linked.
void explain_lost_display() {
  using Handler = int (*)(void*);
  using SetHandler = Handler (*)(Handler);
  const char* driver = SDL_GetCurrentVideoDriver();
  if (!driver || std::string_view(driver) != "x11") return;
  void* library = SDL_LoadObject("libX11.so.6");
  if (!library) return;
  if (void* function = SDL_LoadFunction(library, "XSetIOErrorHandler"))
    reinterpret_cast<SetHandler>(function)(on_lost_display);
}

bool is_set(const char* variable) {
  const char* value = SDL_getenv(variable);
  return value && *value != '\0';
}

// Tries only the desktops that the environment names, unless a driver is requested by name: probing
// others prints messages of their libraries, and without any SDL would draw into memory.
bool start_video() {
  std::string drivers = is_set("DISPLAY") ? "x11" : "";
  if (is_set("WAYLAND_DISPLAY")) drivers += drivers.empty() ? "wayland" : ",wayland";
  if (drivers.empty() && !is_set("SDL_VIDEODRIVER")) {
    SDL_SetError("neither X nor Wayland is running");
    return false;
  }
  SDL_SetHint(SDL_HINT_VIDEODRIVER, drivers.c_str());  // the variable has priority
  return SDL_InitSubSystem(SDL_INIT_VIDEO | SDL_INIT_EVENTS) == 0;
}

void set_hints() {
  SDL_LogSetAllPriority(SDL_LOG_PRIORITY_CRITICAL);  // Heft reports errors in its own words
  SDL_SetHint(SDL_HINT_TOUCH_MOUSE_EVENTS, "0");     // otherwise taps count twice
  SDL_SetHint(SDL_HINT_MOUSE_TOUCH_EVENTS, "0");
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");  // the session handles Ctrl-C
  SDL_SetHint(SDL_HINT_VIDEO_ALLOW_SCREENSAVER, "0");
  SDL_SetHint(SDL_HINT_VIDEO_MINIMIZE_ON_FOCUS_LOSS, "0");
  SDL_GL_SetAttribute(SDL_GL_DOUBLEBUFFER, 1);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MAJOR_VERSION, 3);
  SDL_GL_SetAttribute(SDL_GL_CONTEXT_MINOR_VERSION, 0);
}

DisplayFacts facts_of(int number) {
  DisplayFacts facts;
  facts.number = number;
  if (const char* name = SDL_GetDisplayName(number)) facts.name = name;
  SDL_DisplayMode mode{};
  if (SDL_GetDesktopDisplayMode(number, &mode) != 0) return facts;
  facts.w_px = mode.w;
  facts.h_px = mode.h;
  if (mode.refresh_rate > 0) facts.refresh_hz = mode.refresh_rate;
  return facts;
}

void require_display(int number) {
  const int n = SDL_GetNumVideoDisplays();
  if (n <= 0) throw no_display("no display");
  if (number < n) return;
  throw Error(fmt::format("there is no display {}: this machine has {}, numbered from 0 (heft "
                          "doctor prints them)",
                          number, n),
              ExitCode::device_missing);
}

// Place of a window in the middle of the display, with the desktop's bars and the window's frame
// visible.
SDL_Rect windowed_place(int display) {
  constexpr int wanted_w = 1024, wanted_h = 600, frame_w = 8, frame_h = 40;
  SDL_Rect usable{};
  if (SDL_GetDisplayUsableBounds(display, &usable) != 0) SDL_GetDisplayBounds(display, &usable);
  const int w = std::min(wanted_w, usable.w - 2 * frame_w);
  const int h = std::min(wanted_h, usable.h - 2 * frame_h);
  return {usable.x + (usable.w - w) / 2, usable.y + (usable.h - h) / 2, w, h};
}

// Of the display's size from the start: without a window manager, as on a bare touch display, a
// smaller window would not be enlarged to full screen.
SDL_Window* window_on(const WindowChoice& choice, const char* title) {
  require_display(choice.display);
  SDL_Rect place{};
  SDL_GetDisplayBounds(choice.display, &place);
  Uint32 flags = SDL_WINDOW_OPENGL | SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI;
  if (choice.windowed || choice.hidden) {
    place = windowed_place(choice.display);
    if (choice.hidden) flags |= SDL_WINDOW_HIDDEN;
  } else {
    flags |= SDL_WINDOW_FULLSCREEN_DESKTOP;
  }
  SDL_Window* window = SDL_CreateWindow(title, place.x, place.y, place.w, place.h, flags);
  if (!window) throw no_display("no window");
  return window;
}
}  // namespace

struct GlWindow::Video {
  Video() {
    set_hints();
    if (!start_video()) throw no_display("no display");
    SDL_DisableScreenSaver();
    explain_lost_display();
  }
  ~Video() { SDL_QuitSubSystem(SDL_INIT_VIDEO | SDL_INIT_EVENTS); }
};

struct GlWindow::Graphics {
  explicit Graphics(SDL_Window* window) : context(SDL_GL_CreateContext(window)) {
    if (!context) throw no_display("no OpenGL 3");
    SDL_GL_SetSwapInterval(1);  // may be refused: the session paces its frames
    glGenTextures(1, &texture);
    painter = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    if (!ImGui_ImplOpenGL3_Init()) throw no_display("no OpenGL 3");
  }
  ~Graphics() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(painter);
    written.reset();
    glDeleteTextures(1, &texture);
    SDL_GL_DeleteContext(context);
  }

  SDL_GLContext context;
  GLuint texture = 0;
  std::optional<WrittenTextures> written{std::in_place};
  ImGuiContext* painter = nullptr;
};

GlWindow::GlWindow(const char* title, const WindowChoice& choice)
    : video_(std::make_unique<Video>()),
      window_(window_on(choice, title), SDL_DestroyWindow),
      graphics_(std::make_unique<Graphics>(window_.get())) {}

GlWindow::~GlWindow() = default;

Measures GlWindow::measures() const {
  int width = 0, height = 0;
  SDL_GL_GetDrawableSize(window_.get(), &width, &height);
  return {static_cast<float>(std::max(width, 1)), static_cast<float>(std::max(height, 1))};
}

float GlWindow::scale() const {
  int width = 0, height = 0;
  SDL_GetWindowSize(window_.get(), &width, &height);
  return measures().width / static_cast<float>(std::max(width, 1));
}

bool GlWindow::is_full_screen() const {
  return (SDL_GetWindowFlags(window_.get()) & SDL_WINDOW_FULLSCREEN_DESKTOP) != 0;
}

// The display's mode is in the window system's units.
DisplayFacts GlWindow::display() const {
  DisplayFacts facts = facts_of(std::max(0, SDL_GetWindowDisplayIndex(window_.get())));
  facts.scale = static_cast<double>(scale());
  facts.w_px = static_cast<int>(std::lround(facts.w_px * facts.scale));
  facts.h_px = static_cast<int>(std::lround(facts.h_px * facts.scale));
  return facts;
}

std::string GlWindow::renderer() const {
  const auto* name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  return name ? name : "unknown";
}

std::vector<DisplayFacts> displays() {
  std::vector<DisplayFacts> all;
  if (!start_video()) return all;
  for (int i = 0; i < SDL_GetNumVideoDisplays(); ++i) all.push_back(facts_of(i));
  SDL_QuitSubSystem(SDL_INIT_VIDEO | SDL_INIT_EVENTS);
  return all;
}

void GlWindow::toggle_full_screen() {
  const bool full = is_full_screen();
  SDL_SetWindowFullscreen(window_.get(), full ? 0 : SDL_WINDOW_FULLSCREEN_DESKTOP);
  if (!full) return;
  const SDL_Rect place = windowed_place(std::max(0, SDL_GetWindowDisplayIndex(window_.get())));
  SDL_SetWindowSize(window_.get(), place.w, place.h);
  SDL_SetWindowPosition(window_.get(), place.x, place.y);
}

void GlWindow::upload(const Image& frame) {
  glBindTexture(GL_TEXTURE_2D, graphics_->texture);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, frame.width, frame.height, 0, GL_BGR, GL_UNSIGNED_BYTE,
               frame.pixels.data());
  last_frame_ = frame;
}

unsigned GlWindow::texture() const {
  return graphics_->texture;
}

void GlWindow::renew_graphics() {
  graphics_.reset();
  graphics_ = std::make_unique<Graphics>(window_.get());
  if (!last_frame_.empty()) upload(last_frame_);
}

WrittenTextures& GlWindow::written() {
  return *graphics_->written;
}

ImDrawList& GlWindow::begin_frame() {
  if (SDL_GL_MakeCurrent(window_.get(), graphics_->context) != 0) renew_graphics();
  const Measures m = measures();
  ImGui::GetIO().DisplaySize = {m.width, m.height};
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  return *ImGui::GetBackgroundDrawList();
}

void GlWindow::end_frame() {
  ImGui::Render();
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  glViewport(0, 0, static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y));
  const auto fraction = [](int of_255) { return static_cast<float>(of_255) / 255; };
  glClearColor(fraction(background_rgb[0]), fraction(background_rgb[1]),
               fraction(background_rgb[2]), 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  SDL_GL_SwapWindow(window_.get());
  glFinish();
  graphics_->written->end_frame();
}

}  // namespace heft
