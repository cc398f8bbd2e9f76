#pragma once
// An arc tangent with the same bits on every machine.

#include <algorithm>
#include <cmath>

namespace turnscan {

/// std::atan2(y, x), in (-pi, pi], within 3e-7; 0 for (0, 0). The last bit of libm's depends on
/// whether the machine multiplies and adds in one step.
inline float arc_tangent(float y, float x) {
  const float across = std::abs(x), up = std::abs(y), longer = std::max(across, up);
  if (!(longer > 0.0f)) return 0.0f;
  float t = std::min(across, up) / longer, angle = 0.0f;
  if (t > 0.41421356f) {  // tan(pi / 8)
    t = (t - 1.0f) / (t + 1.0f);
    angle = 0.78539816f;
  }
  // Cephes (Moshier 1992), atanf.
  const float s = t * t;
  const float series =
      ((8.05374449538e-2f * s - 1.38776856032e-1f) * s + 1.99777106478e-1f) * s - 3.33329491539e-1f;
  angle += t + t * s * series;
  if (up > across) angle = 1.57079633f - angle;
  if (x < 0.0f) angle = 3.14159265f - angle;
  return y < 0.0f ? -angle : angle;
}

}  // namespace turnscan
