#pragma once
// A coverage map as files and as text.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <turnscan/simulator/coverage_map.hpp>
#include <turnscan/simulator/object_placement.hpp>
#include <turnscan/simulator/virtual_passes.hpp>

namespace turnscan::cli {

/// "0 none, 1 nothing, ...": the numbers of Miss, for headers of files.
std::string reason_list();

/// Of the objects of virtual scans by those of their frames that are not dropped, all passes
/// together. options are those that the scans were made with; placed: how the object lies in each
/// (may be left out of a single pass). Fails as coverage_map does.
Result<CoverageMap> coverage_of(const VirtualPasses& scan, const std::vector<PlacedObject>& placed,
                                const VirtualScanOptions& options, CoverageMapOptions coverage,
                                const RunContext& context);

/// Binary PLY of coverage_mesh(), each face with samples, views, density_per_mm2,
/// best_incidence_deg, sigma_mm (NaN: none), state, reason (numbers of CoverageState and Miss),
/// object and face. Fails as write_file_atomically.
Result<> write_coverage_mesh(const std::filesystem::path& path, const CoverageMap& map,
                             const CoverageMapOptions& options);

/// SI units in the names.
nlohmann::json coverage_json(const CoverageMap& map, const CoverageMapOptions& options);

/// What people are told: areas, reasons, the largest holes.
std::string coverage_text(const CoverageMap& map, const CoverageMapOptions& options);

}  // namespace turnscan::cli
