#pragma once
// Whether the angles of a recording count in the sense in which its turntable turned.

#include <optional>
#include <turnscan/core/frame.hpp>
#include <turnscan/core/run_context.hpp>
#include <turnscan/core/sequence_views.hpp>

namespace turnscan {

/// How badly neighbouring frames fit each other (mean_pair_cost) about the recorded axis.
struct TurningSense {
  double recorded_cost = 0.0;  ///< at the recorded angles
  double reversed_cost = 0.0;  ///< at the same angles with the opposite sign
  /// The recorded sense takes precedence unless the other one fits clearly better.
  bool reversed() const;
};

/// Compares up to 24 frames within one turn of the first sensor. nullopt if fewer than 3 frames
/// have a known angle, or too little of an object is visible. Fails with kMissingData if the
/// recording has no turntable, with kCancelled, and with the errors of reading.
Result<std::optional<TurningSense>> measure_turning_sense(const FrameSequence& sequence,
                                                          const RunContext& context);

/// The sequence with angles and speed of the opposite sign; it must outlive the result.
SequenceView with_reversed_angles(const FrameSequence& sequence);

}  // namespace turnscan
