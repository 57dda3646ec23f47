// Readers of all input files other than protocols, and their one-line descriptions. parse_...()
// reads a text, load_...() a file.
#pragma once

#include <string>
#include <vector>

#include "base/Names.h"

namespace heft {

struct DisplayMeasures;
struct InterleavedProcedures;
struct MarkerBody;
struct Parameter;
struct Scene;
struct SessionPlan;
struct ScreenTexts;
struct SyntheticSettings;

/// Kind of a TOML file, recognized by its top-level keys.
enum class FileKind {
  protocol,
  procedure,
  scene,
  board,
  effector,
  synthetic_camera,
  texts,
  questionnaires,
  display,
  study
};
template <>
struct EnumNames<FileKind> {
  static constexpr std::array<std::string_view, 10> names{"protocol",      "procedure file",
                                                          "scene file",    "board file",
                                                          "effector file", "synthetic camera file",
                                                          "text file",     "questionnaire file",
                                                          "display file",  "study plan"};
};

/// The kind whose tables the text has, else the kind with most of its keys.
/// @throws InvalidFile if the text is not TOML, or has no key of any kind
FileKind recognized_kind(const std::string& text, const std::string& file);

// Below, text: a file's contents; file: its name, for messages.

/// A procedure file, for `heft procedure`; protocols have the same keys.
/// @throws InvalidFile with every mistake at its line and column
InterleavedProcedures parse_procedure(const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read, InvalidFile as parse_procedure
InterleavedProcedures load_procedure(const std::string& path);

/// A scene file, for `heft scene`.
/// @throws InvalidFile with every mistake at its line and column
Scene parse_scene(const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read, InvalidFile as parse_scene
Scene load_scene(const std::string& path);

/// Positions of the tags on a printed board. Lengths in the file are as designed; everything is
/// scaled by `ruler_measured_m`, the measured length of the sheet's 150 mm ruler.
/// @throws InvalidFile with every mistake at its line and column
MarkerBody parse_board(const std::string& text, const std::string& file);
/// As parse_board; tags must face away from the effector's center.
MarkerBody parse_effector(const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read, InvalidFile as parse_board
MarkerBody load_board(const std::string& path);
MarkerBody load_effector(const std::string& path);

/// Board and effector are distinguished by their tags alone.
/// @throws Error naming the tags of both
void require_different_tags(const MarkerBody& board, const MarkerBody& effector);

/// An effector file with a [[tag]] for each tag, which parse_effector reads back to 1e-9 m.
/// @param comment first lines, may be empty
std::string effector_to_toml(const MarkerBody& effector, const std::string& comment);

/// Description of a body: "24 tags of tag36h11, 40 mm, ids 0-23, 280 x 184 mm".
std::string described(const MarkerBody& body);

/// Imperfections of a synthetic camera, its light and its files; size, focal length and distortion
/// are the calibration's. Defaults: see protocols/apparatus/synthetic_camera.toml.
/// @throws InvalidFile with every mistake at its line and column
SyntheticSettings parse_synthetic_camera(const std::string& text, const std::string& file);

/// Description of the camera: "exposure 4 ms, blur 0.6 px, noise 3 levels, sRGB", and other
/// imperfections.
std::string described(const SyntheticSettings& settings);

/// A participant's texts in one language: its code and one table per page. Required pages and keys
/// are listed in TextsFile.cpp and by the tasks (require_words). Line ends are converted to LF, and
/// spaces at both ends of a text are removed.
/// @throws InvalidFile with every missing, unknown or empty page and key at its line and column
ScreenTexts parse_texts(const std::string& text, const std::string& file);

/// Questionnaires only, one [questionnaire.NAME] each. They may also be part of a text file, so
/// that such a file's text may be appended to a text file's.
/// @throws InvalidFile with every mistake at its line and column
ScreenTexts parse_questionnaires(const std::string& text, const std::string& file);

/// A text file may lack the texts of some tasks; a session needs those of its tasks.
/// @param file with the texts, for the message
/// @throws Error (invalid file) naming the missing texts of the plan's tasks
void require_words(const ScreenTexts& texts, const SessionPlan& plan, const std::string& file);

/// Adds the trials' questions from a session's texts to its blocks.
/// @param text of the session's text file, with its questionnaires; empty: none
/// @throws InvalidFile as parse_texts
void take_questions(SessionPlan& plan, const std::string& text, const std::string& file);

/// @throws Error if the file cannot be read, InvalidFile as parse_texts
ScreenTexts load_texts(const std::string& path);

/// All texts of a page, as logged and hashed: the language, then "key: text" for each key in
/// alphabetical order, separated by empty lines. Independent of their order in the file.
/// @throws std::out_of_range for an unknown page
std::string page_text(const ScreenTexts& texts, const std::string& page);

/// Flat `key = value` pairs whose keys another folder defines (a responder's parameters), in the
/// file's order. Tables and arrays are refused.
/// @throws InvalidFile with every mistake at its place
std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file);

/// A measured display.
/// @throws InvalidFile with every mistake at its line and column
DisplayMeasures parse_display(const std::string& text, const std::string& file);

/// The contents of a file for parse_display.
std::string to_toml(const DisplayMeasures& display);

}  // namespace heft
