// The sRGB tone curve (IEC 61966-2-1): how cameras store light in 8 bits. Blur mixes light, not
// stored values, so edges are modeled on light and compared with what is stored.
#pragma once

namespace heft {

/// A stored value, 0...255, and its derivative by the light.
struct Stored {
  double value, by_light;
};

/// @param light 1 is where the sensor saturates; above, the derivative is 0
Stored stored_of_light(double light);

/// Light, 0...1, of a stored value, 0...255.
double light_of_stored(double value);

}  // namespace heft
