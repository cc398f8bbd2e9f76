#pragma once
// Scanners as files that people read and copy.

#include <filesystem>
#include <string>
#include <string_view>
#include <turnscan/sensors/scanner_model.hpp>
#include <utility>
#include <vector>

namespace turnscan {

/// Reads a scanner from TOML: the keys are the names of describe(ScannerParameters&), and in the
/// table [noise] those of describe(NoiseModel&). Fails with kNotFound or kInvalidOption, naming
/// file and, where there is one, line.
Result<ScannerModel> read_scanner(const std::filesystem::path& file);

/// The scanner of a preset's name, or of a file if the text ends in .toml or has a slash in it.
/// Fails with kNotFound, listing the presets, and as read_scanner.
Result<ScannerModel> find_scanner(std::string_view name_or_file);

/// The same, as what its file says.
Result<ScannerParameters> find_scanner_parameters(std::string_view name_or_file);

/// All keys of a scanner's file, those of its table [noise] too. The table refers to the
/// parameters.
OptionTable describe_all(ScannerParameters& parameters);

/// Text of the file of a scanner like another one, with other values for some of the keys of
/// describe_all(); all others stay as exact as they are written there. Fails as find_scanner, and
/// with kInvalidOption.
Result<std::string> scanner_toml(std::string_view name_or_file,
                                 const std::vector<std::pair<std::string, std::string>>& changed);

/// Names of the presets, sorted; empty where there are none.
std::vector<std::string> scanner_presets();

/// Folder with the files that turnscan comes with: TURNSCAN_DATA if that is set; else
/// share/turnscan beside the folder of the running program or one of the three above it; else where
/// it was to be installed. Fails with kNotFound.
Result<std::filesystem::path> data_folder();

}  // namespace turnscan
