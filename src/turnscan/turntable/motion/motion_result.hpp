#pragma once
// The result of calibration from motion as a Calibration, with what the data do not determine.

#include <turnscan/turntable/motion/refinement.hpp>
#include <turnscan/turntable/motion/sensor_motion.hpp>

namespace turnscan::motion {

/// sequence: the one that data was loaded from. Fails with kLibrary when the frames do not fit.
Result<Calibration> to_calibration(const MotionData& data, const RefinedMotion& motion,
                                   const FrameSequence& sequence, const FromMotionOptions& options);

/// The calibration with at most about max_samples of what was seen, turned back to angle 0. Fails
/// as table_from_sensor.
Result<SensorMotion> with_model(Calibration calibration, const MotionData& data,
                                const MotionState& state, std::size_t max_samples);

}  // namespace turnscan::motion
