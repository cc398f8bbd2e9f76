#pragma once
// Initial guess of axis, speed and angles for least squares.

#include <optional>
#include <turnscan/core/calibration.hpp>
#include <turnscan/turntable/motion/motion_state.hpp>
#include <turnscan/turntable/motion_input/frame_data.hpp>
#include <vector>

namespace turnscan::motion {

/// Axes to start from: the platter's or the given one; else several that are typical of a sensor
/// looking down on a table, through the middle of what turns.
std::vector<MotionState> candidate_axes(const MotionData& data,
                                        const std::optional<TurntableInfo>& hint);

/// The constant speed at which pairs of key frames fit best, rad/s; 0 if times do not increase.
/// Compares neighbouring pairs first, over all speeds up to 60 degrees between them, then pairs
/// twice as far apart, near the best speed so far.
double guess_speed(const MotionData& data, const MotionState& axis);

/// Misfit of frames as they are, without any rotation, by their distance in key frames (the index);
/// at most 1.
std::vector<double> recurrence_costs(const MotionData& data);

/// The speed at which one turn lasts until the same view returns, by recurrence_costs(); if several
/// views return, as those of an object that looks alike from two sides, the speed closest to
/// `guess`. guess: not 0, wrong by at most a factor of three. nullopt if no view returns, or if
/// neighbouring frames fit clearly worse at that speed than at the guess.
std::optional<double> recurrence_speed(const MotionData& data, const std::vector<double>& cost,
                                       const MotionState& state, double guess);

/// Angles of all frames by tracking the key frames one after the other, starting each step at the
/// prediction from `angle`; frames between key frames are interpolated in time. step_sigma:
/// relative standard deviation of a step.
void track_angles(const MotionData& data, MotionState& state, double step_sigma);

/// Angles of key frames by trying all rotations from each to the next. Needs neither times nor
/// angles.
void search_turns(const MotionData& data, MotionState& state);

}  // namespace turnscan::motion
