#pragma once
// Meshes that turn, as one file.

#include <span>
#include <string>
#include <turnscan/simulator/rendering/turning_picture.hpp>
#include <vector>

namespace turnscan {

/// Succeeds when such a file can be written there: .png, an animation that browsers show, or .mp4,
/// made by the program ffmpeg. Fails as check_output_file(), with kInvalidOption for another
/// ending, and with kMissingData when no ffmpeg is on the path.
Result<> check_turning_picture(const std::string& path, const RunContext& context);

/// Writes PNG images of one size as an MP4 file that is shown for so long (seconds, above 0), made
/// by the program ffmpeg. Fails with kMissingData when there is none, with kLibrary when it fails
/// (in its words), with kCancelled, and with kIo.
Result<> write_video(const std::string& path, const std::vector<std::string>& pictures,
                     double duration_s, const RunContext& context);

/// Renders one turn and writes it. Fails as render_turn(), as check_turning_picture(), with
/// kLibrary when ffmpeg fails (in its words), and with kIo. The packed pictures are kept in memory
/// meanwhile.
Result<> write_turning_picture(const std::string& path, std::span<const TriangleMesh> meshes,
                               const PictureOptions& options, const TurnOptions& turn,
                               const RunContext& context);

}  // namespace turnscan
