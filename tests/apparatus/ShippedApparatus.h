// The camera, board and effector that are shipped.
#pragma once

#include <string>

#include "SourceFolder.h"
#include "protocol/readers/Files.h"
#include "tracking/camera/Intrinsics.h"
#include "tracking/detection/MarkerBody.h"

namespace heft {

inline const Apparatus& shipped_apparatus() {
  static const std::string folder = source_folder() + "/protocols/apparatus/";
  static const Apparatus all{load_intrinsics(folder + "synthetic_camera.yaml"),
                             load_board(folder + "board.toml"),
                             load_effector(folder + "effector.toml")};
  return all;
}

}  // namespace heft
