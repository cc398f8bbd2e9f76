#pragma once
// Sentences of a verdict on the scan as a whole: its turn, its calibration, the agreement of its
// frames.

#include <turnscan/core/angles.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>
#include <vector>

namespace turnscan::workflow {

using Findings = std::vector<VerdictSentence>;

/// Minimum TurnSeen::share of a complete turn, in which no side is missing.
inline constexpr double kWholeTurn = 0.90;
/// An upright surface in the middle of a wider gap is seen at 60 degrees from its normal at best:
/// what was filled there may be as deep as the object, which its area does not show.
inline constexpr double kSideGap_rad = 120.0 * kRadiansPerDegree;

/// Whether no gap between viewing directions is wider than kSideGap_rad.
bool looked_from_all_sides(const TurnSeen& turn);

/// good: from `good` on; fair: from `fair` on.
Level level_of(double value, double good, double fair);

/// Adds sentences on what cannot be in the recordings, and on images that may be mirrored.
void add_plausibility(const ScanKnowledge& known, Findings& out);

void add_turn(const ScanKnowledge& known, Findings& out);

/// Adds sentences on the table's pose, the age of its calibration, whether the platter in this
/// recording agrees with it, and on closure after one turn.
void add_calibration(const ScanKnowledge& known, Findings& out);

/// Adds sentences on the disturbances found in the recording.
void add_disturbances(const ScanKnowledge& known, Findings& out);

/// Adds sentences on the offsets of frames from the mesh, between neighbours, one turn apart, by
/// sensor and pass; and on displaced frames. Empty: not known.
void add_agreement(const std::vector<FrameResidual>& residuals, Findings& out);

void add_dropped(const Reconstruction& run, Findings& out);

}  // namespace turnscan::workflow
