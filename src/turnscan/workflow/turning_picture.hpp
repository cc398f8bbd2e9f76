#pragma once
// Turntable animations of meshes, as one file.

#include <span>
#include <string>
#include <turnscan/simulator/rendering/turning_picture.hpp>
#include <vector>

namespace turnscan {

/// Succeeds if the file can be written: .png, an animation that browsers show, or .mp4, encoded by
/// the program ffmpeg. Fails as check_output_file(), with kInvalidOption for another extension, and
/// with kMissingData if ffmpeg is not on the path.
Result<> check_turning_picture(const std::string& path, const RunContext& context);

/// Encodes PNG images of equal size as an MP4 file of this duration (seconds, above 0) with the
/// program ffmpeg. Fails with kMissingData if there is none, with kLibrary and ffmpeg's message if
/// it fails, with kCancelled, and with kIo.
Result<> write_video(const std::string& path, const std::vector<std::string>& pictures,
                     double duration_s, const RunContext& context);

/// Renders one turn and writes it. Fails as render_turn(), as check_turning_picture(), with
/// kLibrary and ffmpeg's message if it fails, and with kIo. The compressed pictures are kept in
/// memory meanwhile.
Result<> write_turning_picture(const std::string& path, std::span<const TriangleMesh> meshes,
                               const PictureOptions& options, const TurnOptions& turn,
                               const RunContext& context);

}  // namespace turnscan
