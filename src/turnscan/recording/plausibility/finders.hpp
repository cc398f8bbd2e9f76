#pragma once
// One finder for each kind of finding.

#include <turnscan/recording/plausibility/plausibility.hpp>

namespace turnscan::plausibility {

using Findings = std::vector<PlausibilityFinding>;

/// Times and angles of a pass, as one sensor recorded them, that go back.
void look_at_order(const FrameSequence& sequence, Findings& out);

/// Intrinsics that are not those of the image. `number`: of the sensor, as in all below.
void look_at_intrinsics(std::size_t number, const SensorInfo& sensor, Findings& out);

/// Depth beyond the sensor's range or that of all sensors, or scans from a direction that are
/// larger or smaller than what stands on a turntable, with the unit that would fit.
void look_at_range(std::size_t number, const SensorInfo& sensor, const std::vector<Frame>& frames,
                   Findings& out);

/// A turntable of sensor 0 that is nowhere near what the sensor sees.
void look_at_table(const SensorInfo& sensor, const TurntableInfo& table,
                   const std::vector<Frame>& frames, Findings& out);

/// Nearly all depth at less than half, or more than twice, of what is known of its distance.
void look_at_distance(const SensorInfo& sensor, double there_m, std::string_view what,
                      const std::vector<Frame>& frames, Findings& out);

/// Poses that turn on the spot or look away from what they go round, as inverted ones and those of
/// another convention do, and depth that is nowhere near what they look at.
void look_at_poses(std::size_t number, const SensorInfo& sensor, const std::vector<Frame>& frames,
                   Findings& out);

/// Images that fit their poses only when they are turned round from left to right.
void look_at_handedness(std::size_t number, const SensorInfo& sensor,
                        const std::vector<Frame>& frames, Findings& out);

/// 16-bit depth whose bytes are swapped. True if they are: other findings have no meaning then.
bool look_at_bytes(std::size_t number, const std::vector<Frame>& frames, Findings& out);

/// A scanner inside its own scan.
void look_at_viewpoint(std::size_t number, const SensorInfo& sensor,
                       const std::vector<Frame>& frames, Findings& out);

/// Depth images in which nothing turns, or everything moves. frames: two in succession, then
/// others.
void look_at_motion(std::size_t number, const std::vector<Frame>& frames, Findings& out);

/// Images whose numbers were sorted as text: those with successive numbers are alike, neighbours
/// are not. Reads up to 16 more for each of two kinds of numbering. frames: as above. Fails only
/// with kCancelled.
Result<> look_at_succession(const FrameSequence& sequence, std::uint32_t number,
                            const std::vector<Frame>& frames, const RunContext& context,
                            Findings& out);

}  // namespace turnscan::plausibility
