#pragma once
// A coverage map as files and as text.

#include <filesystem>
#include <string>
#include <turnscan/simulator/coverage/coverage_map.hpp>
#include <turnscan/simulator/objects/object_placement.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan {

/// How well the frames of all passes together, but for the dropped ones, cover the object. options:
/// those that the scans were made with. placed: how the object lies in each pass; may be empty for
/// a single one. Fails as coverage_map().
Result<CoverageMap> coverage_of(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                                const VirtualScanOptions& options, CoverageMapOptions coverage,
                                const RunContext& context);

/// Binary PLY of coverage_mesh(), each face with samples, views, density_per_mm2,
/// best_incidence_deg, sigma_mm (NaN: none), state, reason (numbers of CoverageState and Miss),
/// object and face. Fails as write_file_atomically().
Result<> write_coverage_mesh(const std::filesystem::path& path, const CoverageMap& map,
                             const CoverageMapOptions& options);

/// A JSON object of areas, reasons and holes, SI units in the names; it ends with a line break.
std::string coverage_json(const CoverageMap& map, const CoverageMapOptions& options);

/// Areas, reasons and the largest holes, for people.
std::string coverage_text(const CoverageMap& map, const CoverageMapOptions& options);

}  // namespace turnscan
