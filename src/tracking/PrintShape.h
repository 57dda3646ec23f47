// Whether a flat board was printed true to shape: paper that a printer stretched more in one
// direction than in the other, or fed askew, fits no camera from all sides. PrintFit.h measures it.
#pragma once

namespace heft {

/// How a print differs from what its file says, beside its overall size, with standard errors.
struct PrintShape {
  double stretch = 0, stretch_sd = 0;      ///< how much longer it is across than down, relatively
  double shear_rad = 0, shear_sd_rad = 0;  ///< by how much its right angles are too narrow

  bool is_stretched() const;
  bool is_sheared() const;
};

}  // namespace heft
