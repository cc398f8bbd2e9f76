#pragma once
// Prior knowledge of the angles as equations: the motor turns evenly, and the frames may have
// angles of their own.

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <utility>
#include <vector>

namespace turnscan::motion {

/// Views before and after the break have no surface in common.
struct Break {
  std::size_t frame = 0;  ///< first frame after it
  double turn_rad = 0.0;  ///< possible rotation of the views after it relative to those before
};

struct AnglePrior {
  bool timed = false;        ///< the speed is a random walk over the frames' times
  double speed_rad_s = 0.0;  ///< typical, for its scale
  double speed_walk = 0.02;  ///< standard deviation of its relative change in a second
  std::vector<std::uint8_t>
      transient;                    ///< per frame: the table starts or stops there; may be empty
  std::vector<std::uint8_t> still;  ///< per frame: the table stands still, at the start or the end
  std::vector<std::uint8_t> slips;  ///< per frame: it slips before the next one; may be empty
  std::optional<Break> unjoined;  ///< the angles continue there at the previous speed; no equation
  std::optional<double> stated_rad_s;  ///< mean speed that the user stated
  double nominal_sigma_rad = 0.0;      ///< of the frames' own angles; 0: none
  double nominal_sign = 1.0;
  std::vector<std::uint8_t> held;  ///< per frame: its angle is kept fixed; may be empty
};

/// A coefficient and the index of its angle.
using PriorTerm = std::pair<int, double>;
/// One equation: sum of coefficient * step = -error, with this inverse variance.
using AddPriorRow =
    std::function<void(std::span<const PriorTerm> terms, double error, double inverse_variance)>;

/// Adds the prior for the angles of `frames` (positions in data.frames, increasing). Returns -2
/// times the logarithm of its probability, up to a constant.
double add_angle_prior(const MotionData& data, const std::vector<std::size_t>& frames,
                       const std::vector<double>& angle, const AnglePrior& prior,
                       const AddPriorRow& add);

}  // namespace turnscan::motion
