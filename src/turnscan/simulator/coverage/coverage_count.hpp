#pragma once
// The two passes of a coverage map over the frames.

#include <turnscan/simulator/coverage/coverage_patches.hpp>

namespace turnscan::coverage {

struct CoverageJob {
  std::vector<CoveragePass> passes;  ///< including the first one
  std::span<const ScannerModel> scanners;
  std::span<const CoveragePose> poses;
  const CoverageMapOptions& options;
  const Scene* room = nullptr;
};

/// Sets samples, views, best incidence and sigma of patches and cells from the frames' samples.
Result<std::uint64_t> count_samples(const CoverageJob& job, CoveragePatches& surface,
                                    const RunContext& context);

/// Sets state and reason of the cells.
Result<> explain_cells(const CoverageJob& job, CoveragePatches& surface, const RunContext& context);

}  // namespace turnscan::coverage
