#include <turnscan/workflow/turning_picture.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/core/process/child_process.hpp>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/animated_png.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/io/text/text_fields.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

namespace {

constexpr double kLongestVideo_s = 3600.0;

Result<std::string> ffmpeg(const std::vector<std::string>& arguments, std::string_view input,
                           const RunContext& context) {
  std::vector<std::string> words{"ffmpeg", "-hide_banner", "-loglevel", "error"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  TURNSCAN_ASSIGN(process::ChildResult child,
                  process::run_child("/usr/bin/env", words, kLongestVideo_s, context, input));
  if (child.exit_code == 0) return std::move(child.output);
  if (child.exit_code == 127)
    return fail(ErrorCode::kMissingData,
                "ffmpeg, which makes .mp4 files, is not installed; install it, or write a .png, "
                "which moves, too");
  const std::string why(text::trimmed(child.errors));
  return fail(ErrorCode::kLibrary, "ffmpeg: {}", why.empty() ? "it failed" : why);
}

/// H.264 with the colours of sRGB's primaries, its index in front, sides even as it wants them. An
/// MP4 file is not written front to back, which the file in memory behind /dev/stdout allows.
Result<std::string> video_of(const std::vector<std::string>& pictures, const TurnOptions& turn,
                             const RunContext& context) {
  std::string input;
  for (const std::string& picture : pictures) input += picture;
  const auto milliseconds = std::max(1L, std::lround(1000.0 * turn.time_s));
  const std::string rate = fmt::format("{}/{}", 1000L * turn.frames, milliseconds);
  return ffmpeg({"-f",
                 "image2pipe",
                 "-framerate",
                 rate,
                 "-c:v",
                 "png",
                 "-i",
                 "pipe:0",
                 "-vf",
                 "pad=ceil(iw/2)*2:ceil(ih/2)*2,scale=out_color_matrix=bt709:out_range=tv",
                 "-c:v",
                 "libx264",
                 "-crf",
                 "18",
                 "-pix_fmt",
                 "yuv420p",
                 "-colorspace",
                 "bt709",
                 "-color_primaries",
                 "bt709",
                 "-color_trc",
                 "iec61966-2-1",
                 "-color_range",
                 "tv",
                 "-movflags",
                 "+faststart",
                 "-f",
                 "mp4",
                 "-y",
                 "/dev/stdout"},
                input, context);
}

}  // namespace

Result<> check_turning_picture(const std::string& path, const RunContext& context) {
  const std::string ending = ending_of(path);
  if (ending != ".mp4" && ending != ".png")
    return fail_at(path, ErrorCode::kInvalidOption, "the name must end in .mp4 or .png; rename it");
  TURNSCAN_TRY(check_output_file(path, ending));
  if (ending == ".mp4") TURNSCAN_TRY(ffmpeg({"-version"}, {}, context));
  return {};
}

Result<> write_turning_picture(const std::string& path, std::span<const TriangleMesh> meshes,
                               const PictureOptions& options, const TurnOptions& turn,
                               const RunContext& context) {
  std::vector<std::string> pictures;
  const auto take = [&](const ColorImage& picture) -> Result<> {
    TURNSCAN_ASSIGN(std::string packed, encode_color_png(picture));
    pictures.push_back(std::move(packed));
    return {};
  };
  TURNSCAN_TRY(render_turn(meshes, options, turn, take, context));
  const int each_ms =
      std::clamp(int(std::lround(1000.0 * turn.time_s / double(turn.frames))), 1, 65535);
  TURNSCAN_ASSIGN(const std::string bytes, ending_of(path) == ".mp4"
                                               ? video_of(pictures, turn, context)
                                               : animated_png(pictures, each_ms));
  return write_file_atomically(path, std::string_view(bytes));
}

}  // namespace turnscan
