#pragma once
// What a verdict says of the scan as a whole: its turn, its calibration, how its frames agree.

#include <turnscan/core/angles.hpp>
#include <turnscan/reconstruction/result.hpp>
#include <turnscan/workflow/verdict/frame_residuals.hpp>
#include <turnscan/workflow/verdict/turn_seen.hpp>
#include <turnscan/workflow/verdict/verdict_rules.hpp>
#include <vector>

namespace turnscan::workflow {

using Findings = std::vector<VerdictSentence>;

/// Of a turn, as TurnSeen::share: with more, no side is missing.
inline constexpr double kWholeTurn = 0.90;
/// An upright side in the middle of a wider gap is seen at 60 degrees from its normal at best: what
/// was closed there may be as deep as the object, and its area says nothing of that.
inline constexpr double kSideGap_rad = 120.0 * kRadiansPerDegree;

/// Whether no gap between headings is wider.
bool looked_from_all_sides(const TurnSeen& turn);

/// good: at least `good`; fair: at least `fair`.
Level level_of(double value, double good, double fair);

void add_turn(const ScanKnowledge& known, Findings& out);

/// Where the table is, how old that knowledge is, whether the platter in this recording agrees, and
/// whether the object lies a turn later where it lay.
void add_calibration(const ScanKnowledge& known, Findings& out);

/// What was found to have disturbed the recording.
void add_disturbances(const ScanKnowledge& known, Findings& out);

/// How far frames lie off the mesh, next to each other, a turn apart, by sensor and pass; and which
/// lie elsewhere than the rest. Empty: it is not known.
void add_agreement(const std::vector<FrameResidual>& residuals, Findings& out);

void add_dropped(const Reconstruction& run, Findings& out);

}  // namespace turnscan::workflow
