#pragma once
// Converts the result of calibration from motion to a Calibration, listing what is undetermined.

#include <turnscan/turntable/motion/refinement.hpp>
#include <turnscan/turntable/motion/sensor_motion.hpp>

namespace turnscan::motion {

/// sequence: the one that data was loaded from. Fails with kLibrary if the frames do not fit.
Result<Calibration> to_calibration(const MotionData& data, const RefinedMotion& motion,
                                   const FrameSequence& sequence, const FromMotionOptions& options);

/// The calibration with about max_samples of the observed samples at most, rotated back to angle 0.
/// Fails as table_from_sensor.
Result<SensorMotion> with_model(Calibration calibration, const MotionData& data,
                                const MotionState& state, std::size_t max_samples);

}  // namespace turnscan::motion
