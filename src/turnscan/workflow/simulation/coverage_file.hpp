#pragma once
// Writes a coverage map to files and as text.

#include <filesystem>
#include <string>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan {

/// Coverage of the object by the frames of all passes together, except dropped ones. options: those
/// of the scans. placed: the object's pose in each pass; may be empty for a single one. Fails as
/// coverage_map().
Result<CoverageMap> coverage_of(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                                const VirtualScanOptions& options, CoverageMapOptions coverage,
                                const RunContext& context);

/// Binary PLY of coverage_mesh(), with the face properties samples, views, density_per_mm2,
/// best_incidence_deg, sigma_mm (NaN: none), state, reason (numbers of CoverageState and Miss),
/// object and face. Fails as write_file_atomically().
Result<> write_coverage_mesh(const std::filesystem::path& path, const CoverageMap& map,
                             const CoverageMapOptions& options);

/// A JSON object with areas, reasons and holes, in SI units as named by the keys; it ends with a
/// line break.
std::string coverage_json(const CoverageMap& map, const CoverageMapOptions& options);

/// Areas, reasons and the largest holes, human-readable.
std::string coverage_text(const CoverageMap& map, const CoverageMapOptions& options);

}  // namespace turnscan
