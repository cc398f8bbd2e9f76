#pragma once
// Constants of robust estimation and gates that several steps of calibration from motion share.

namespace turnscan::motion {

/// Residuals beyond this many robust standard deviations weigh less (Huber 1964).
inline constexpr double kHuber = 1.5;
/// The standard deviation of normally distributed errors over their median absolute value.
inline constexpr double kMedianToSigma = 1.4826;
/// Median of the square of a standard normal variable.
inline constexpr double kMedianOfSquare = 0.455;

}  // namespace turnscan::motion
