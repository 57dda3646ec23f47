// The kinds of files that are no protocol: what reads each and what it says in words. A file is
// read from its text; load_...() reads the text too.
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

/// What kind of file a TOML text is, by the keys at its top level.
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

/// The kind whose tables the text has, or else most of whose keys.
/// @throws InvalidFile when the text is no TOML, or has no key of any kind
FileKind recognized_kind(const std::string& text, const std::string& file);

// Below, text: a file's contents; file: its name, for messages.

/// Procedures alone, for `heft procedure`; inside protocols they have the same keys.
/// @throws InvalidFile with every mistake at its line and column
InterleavedProcedures parse_procedure(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_procedure
InterleavedProcedures load_procedure(const std::string& path);

/// Physics alone, for `heft scene`.
/// @throws InvalidFile with every mistake at its line and column
Scene parse_scene(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_scene
Scene load_scene(const std::string& path);

/// Which printed tags are on a board, and where. Lengths in its file are as they were sent to the
/// printer; `ruler_measured_m` says how long the sheet's 150 mm ruler came out, and everything is
/// scaled by it.
/// @throws InvalidFile with every mistake at its line and column
MarkerBody parse_board(const std::string& text, const std::string& file);
/// As parse_board; tags must face away from the effector's center.
MarkerBody parse_effector(const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_board
MarkerBody load_board(const std::string& path);
MarkerBody load_effector(const std::string& path);

/// The board and the effector are told apart by their tags alone.
/// @throws Error naming the tags that both have
void require_different_tags(const MarkerBody& board, const MarkerBody& effector);

/// An effector file with a [[tag]] for each tag, which parse_effector reads back to 1e-9 m.
/// @param comment put on top, may be empty
std::string effector_to_toml(const MarkerBody& effector, const std::string& comment);

/// What a body has, for people: "24 tags of tag36h11, 40 mm, ids 0-23, 280 x 184 mm".
std::string described(const MarkerBody& body);

/// How a synthetic camera, its light and its files fall short of perfect ones; size, focal length
/// and distortion are the calibration's. Absent keys are as
/// protocols/apparatus/synthetic_camera.toml explains them.
/// @throws InvalidFile with every mistake at its line and column
SyntheticSettings parse_synthetic_camera(const std::string& text, const std::string& file);

/// What the camera is like, for people: "exposure 4 ms, blur 0.6 px, noise 3 levels, sRGB", and
/// what it has of the rest.
std::string described(const SyntheticSettings& settings);

/// Every word that a participant reads, in one language: its code and one table a page; which pages
/// and keys there must be is listed once, in TextsFile.cpp and by the tasks (require_words). Line
/// ends are LF, and spaces at a text's beginning and end are dropped.
/// @throws InvalidFile with every missing, unknown or empty page and key at its line and column
ScreenTexts parse_texts(const std::string& text, const std::string& file);

/// Questionnaires alone, [questionnaire.NAME] each, as they may also stand in a text file: such a
/// file's text may be written below a text file's.
/// @throws InvalidFile with every mistake at its line and column
ScreenTexts parse_questionnaires(const std::string& text, const std::string& file);

/// A text file need not have the words of every task; a session needs those of its own.
/// @param file that the texts are from, for the message
/// @throws Error (invalid file) naming the words of the plan's tasks that are missing
void require_words(const ScreenTexts& texts, const SessionPlan& plan, const std::string& file);

/// Gives blocks the questions that their trials ask, in the words of a session's texts.
/// @param text of the session's text file, with its questionnaires; empty: it has none
/// @throws InvalidFile as parse_texts
void take_questions(SessionPlan& plan, const std::string& text, const std::string& file);

/// @throws Error when the file can't be read, InvalidFile as parse_texts
ScreenTexts load_texts(const std::string& path);

/// All that a page says, as the log keeps and hashes it: the language, then "key: text" for each
/// key in alphabetical order, an empty line between two. The same words give the same bytes,
/// wherever they stand in their file.
/// @throws std::out_of_range for an unknown page
std::string page_text(const ScreenTexts& texts, const std::string& page);

/// Flat `key = value` whose keys another room knows (a responder's parameters), in the file's
/// order. Tables and arrays are refused.
/// @throws InvalidFile with every mistake at its place
std::vector<Parameter> parse_parameters(const std::string& text, const std::string& file);

/// A measured display.
/// @throws InvalidFile with every mistake at its line and column
DisplayMeasures parse_display(const std::string& text, const std::string& file);

/// What parse_display reads.
std::string to_toml(const DisplayMeasures& display);

}  // namespace heft
