#include "bench/physics/PhysicsStudy.h"

#include "bench/physics/HandsStudy.h"
#include "bench/physics/InputStudy.h"
#include "bench/physics/LagVsMass.h"
#include "bench/physics/Measurements.h"
#include "bench/physics/Stability.h"

namespace heft {

void run_physics_study(const StudyOptions& options) {
  const Measurements measurements = measure(options);
  write_tables(options, measurements);
  draw_work_precision(options, measurements.all);
  study_hands(options);
  study_growth(options);
  study_lag(options);
  study_input(options);
  study_stability(options);
}

}  // namespace heft
