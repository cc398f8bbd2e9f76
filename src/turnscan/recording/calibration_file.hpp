#pragma once
// Calibrations as human-readable files (docs/reference/calibration.md lists the fields).

#include <filesystem>
#include <turnscan/core/calibration.hpp>

namespace turnscan {

/// JSON text, values with their unit in the name. Reading it back gives the same calibration, which
/// is again written as the same bytes.
std::string calibration_json(const Calibration& calibration);

/// Fails with kFormat if a field is missing or wrong, with kUnsupported for a newer schema. Also
/// accepts the object "turntable" of a recording, alone or in a recording.json.
Result<Calibration> parse_calibration(std::string_view text);

/// Fails as parse_calibration and read_file do; the error contains the path.
Result<Calibration> read_calibration(const std::filesystem::path& path);
Result<> write_calibration(const std::filesystem::path& path, const Calibration& calibration);

}  // namespace turnscan
