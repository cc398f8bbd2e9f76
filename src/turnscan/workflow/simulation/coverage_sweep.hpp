#pragma once
// Coverage over a range of one option of the scene: how a scanner is best turned or placed.

#include <string>
#include <turnscan/core/units.hpp>
#include <turnscan/workflow/simulation/simulate.hpp>
#include <vector>

namespace turnscan {

struct SweepRange {
  std::string option;  ///< of describe(SceneDescription&)
  Quantity quantity = Quantity::kNone;
  std::vector<double> values;  ///< SI, ascending
};

/// "roll=-45deg..45deg/10deg": from, to, step. Fails with kInvalidOption for an option that the
/// scene does not have or that is no number, a step that is not positive, and more than 1000
/// values; the error names the option of the scene.
Result<SweepRange> parse_sweep_range(const std::string& text, SceneDescription scene);

struct SweptCoverage {
  double value = 0.0;                      ///< of the option, SI
  double covered = 0.0, thin = 0.0;        ///< shares of the surface, 0 to 1;
  double missed = 0.0, unreachable = 0.0;  ///< covered includes thin
};

/// coverage_of() the scene with each of the values. Fails as prepare_simulation(), naming the
/// value, and as coverage_of() do.
Result<std::vector<SweptCoverage>> sweep_coverage(const SceneDescription& scene,
                                                  const SweepRange& range,
                                                  const CoverageMapOptions& options,
                                                  const RunContext& context);

/// The one that covers most, of equals the first. There must be one.
const SweptCoverage& best_of(const std::vector<SweptCoverage>& swept);

/// A table of the shares in percent, and the best value.
std::string sweep_text(const SweepRange& range, const std::vector<SweptCoverage>& swept);

/// The covered share over the values with the best marked, as an SVG file.
std::string sweep_svg(const SweepRange& range, const std::vector<SweptCoverage>& swept);

}  // namespace turnscan
