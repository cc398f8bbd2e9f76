#pragma once
// A first guess of axis, speed and angles, good enough for least squares.

#include <optional>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <vector>

namespace turnscan::motion {

/// Axes to start from: the platter's or the given one; else some that a sensor which looks down on
/// a table sees, through the middle of what turns.
std::vector<MotionState> candidate_axes(const MotionData& data,
                                        const std::optional<TurntableInfo>& hint);

/// The constant speed at which pairs of key frames fit best, rad/s; 0 where times do not increase:
/// pairs next to each other first, over all speeds up to 60 degrees between them, then pairs twice
/// as far apart, near the best so far.
double guess_speed(const MotionData& data, const MotionState& axis);

/// How badly frames that are so many key frames apart (the position) fit each other as they are, 1
/// at most: no axis enters.
std::vector<double> recurrence_costs(const MotionData& data);

/// The speed at which a turn lasts as long as it takes until the same view comes back, by
/// recurrence_costs(); where several views do, as those of an object that looks alike from two
/// sides, the one next to `guess`. guess: not 0, at most three times too high or low. nullopt: no
/// view comes back, or frames next to each other fit clearly worse at that speed than at the guess.
std::optional<double> recurrence_speed(const MotionData& data, const std::vector<double>& cost,
                                       const MotionState& state, double guess);

/// Angles of all frames by following the key frames one after the other, from what `angle` predicts
/// for each step; frames between key frames are interpolated in time. step_sigma: relative standard
/// deviation of a step.
void track_angles(const MotionData& data, MotionState& state, double step_sigma);

/// Angles of key frames by trying all turns from each to the next. Needs neither times nor angles.
void search_turns(const MotionData& data, MotionState& state);

}  // namespace turnscan::motion
