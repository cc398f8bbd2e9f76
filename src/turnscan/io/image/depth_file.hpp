#pragma once
// Depth images as programs write them beside PNG: NPY arrays of numpy, TIFF, EXR, PGM of 16 bits,
// and bare numbers.

#include <filesystem>
#include <string_view>
#include <turnscan/core/image.hpp>
#include <turnscan/core/result.hpp>

namespace turnscan {

/// Steps of a depth image that was made from floating-point numbers.
inline constexpr double kFloatDepthStep_m = 1e-4;

struct DepthFileOptions {
  double float_unit_m = 1.0;  ///< of floating-point numbers
  bool eight_bits = false;    ///< take PNG of 8 bits, which are often pictures of depth
  /// Files are bare numbers of 16 bits, row by row, least significant byte first; 0: they are not.
  std::uint32_t bare_rows = 0, bare_columns = 0;
};

struct DepthFile {
  DepthImage image;  ///< raw values
  bool floats = false, eight_bits = false;
};

/// A depth image, recognised by its content: PNG (see read_depth_png()); TIFF and EXR (see
/// image/file_numbers.hpp); binary PGM with more than 255 grey values; an NPY array of rows and
/// columns (axes of length 1 are allowed) of integers of 8 to 32 bits, or of floats of 32 or 64
/// bits, which become steps of kFloatDepthStep_m. Values that are not finite, not positive or
/// beyond what 16 bits hold become kNoReturn. Fails as read_depth_png(), and with kUnsupported for
/// other content.
Result<DepthFile> read_depth_file(const std::filesystem::path& path,
                                  const DepthFileOptions& options = {});
Result<DepthFile> decode_depth_file(std::string_view bytes, const DepthFileOptions& options = {});

}  // namespace turnscan
