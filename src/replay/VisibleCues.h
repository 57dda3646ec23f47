// Visible cues to the cubes' masses: the clone's lag behind the effector in each push, the cubes'
// paths and final positions. Measured from displayed frames alone.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "experiment/Stage.h"

namespace heft {

/// Sums over the pushes and cubes of one mass.
struct VisibleCues {
  int n_pushes = 0;
  double lag_m = 0, largest_lag_m = 0;  ///< of the largest lag of each push: sum, maximum
  int n_cubes = 0;                      ///< pushed cubes, counted in each attempt
  double path_m = 0,
         end_m = 0;  ///< sums over these cubes: length of path, distance of end from start

  double mean_lag_m() const { return n_pushes == 0 ? 0 : lag_m / n_pushes; }
  double mean_path_m() const { return n_cubes == 0 ? 0 : path_m / n_cubes; }
  double mean_end_m() const { return n_cubes == 0 ? 0 : end_m / n_cubes; }
};

/// By mass of the cube, g.
using CuesByMass = std::map<double, VisibleCues>;

/// Measures the frames of one attempt.
class CueMeter {
 public:
  /// @param cues gets the results; must outlive this object
  explicit CueMeter(CuesByMass& cues) : cues_(cues) {}
  ~CueMeter() { finish(); }
  CueMeter(const CueMeter&) = delete;
  CueMeter& operator=(const CueMeter&) = delete;

  /// @param contact_slot the cube pressed hardest
  /// @param masses_g of the cubes, by slot
  void add(const DisplayedFrame& frame, std::optional<int> contact_slot,
           const std::vector<double>& masses_g);

 private:
  struct Push {
    std::size_t cube = 0;
    double last_s = 0;
    Eigen::Vector2d effector_at_start_m{0, 0};
    double lag_m = 0;
  };
  struct Cube {
    Eigen::Vector3d start_m, last_m;
    double path_m = 0;
    bool pushed = false;
  };

  void follow_cubes(const std::vector<Pose>& cubes, const std::vector<double>& masses_g);
  void follow_push(const DisplayedFrame& frame, std::size_t cube);
  void end_push();
  void finish();

  CuesByMass& cues_;
  std::vector<double> masses_g_;
  std::optional<Push> push_;
  std::vector<Cube> cubes_;
};

}  // namespace heft
