#include <turnscan/workflow/turning_picture.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <turnscan/io/file/atomic_file.hpp>
#include <turnscan/io/image/animated_png.hpp>
#include <turnscan/io/image/image_io.hpp>
#include <turnscan/workflow/installed_program.hpp>
#include <turnscan/workflow/output_file.hpp>

namespace turnscan {

namespace {

constexpr double kLongestVideo_s = 3600.0;

Result<std::string> ffmpeg(const std::vector<std::string>& arguments, std::string_view input,
                           const RunContext& context) {
  std::vector<std::string> words{"-hide_banner", "-loglevel", "error"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return run_installed("ffmpeg", words,
                       "ffmpeg, which makes .mp4 files, is not installed; install it, or write a "
                       ".png, which moves, too",
                       kLongestVideo_s, context, input);
}

/// Encodes H.264 with sRGB's primaries, the index in front, and even dimensions as required by the
/// format. An MP4 file is not written sequentially, which the memory file behind /dev/stdout
/// allows.
Result<std::string> video_of(const std::vector<std::string>& pictures, double duration_s,
                             const RunContext& context) {
  std::string input;
  for (const std::string& picture : pictures) input += picture;
  const auto milliseconds = std::max(1L, std::lround(1000.0 * duration_s));
  const std::string rate = fmt::format("{}/{}", 1000 * pictures.size(), milliseconds);
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

Result<> write_video(const std::string& path, const std::vector<std::string>& pictures,
                     double duration_s, const RunContext& context) {
  TURNSCAN_ASSIGN(const std::string bytes, video_of(pictures, duration_s, context));
  return write_file_atomically(path, std::string_view(bytes));
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
  if (ending_of(path) == ".mp4") return write_video(path, pictures, turn.time_s, context);
  const int each_ms =
      std::clamp(int(std::lround(1000.0 * turn.time_s / double(turn.frames))), 1, 65535);
  TURNSCAN_ASSIGN(const std::string bytes, animated_png(pictures, each_ms));
  return write_file_atomically(path, std::string_view(bytes));
}

}  // namespace turnscan
