#include <turnscan/workflow/simulation/true_samples.hpp>

#include <algorithm>
#include <turnscan/core/parallel.hpp>
#include <turnscan/io/file/atomic_file.hpp>

#include <turnscan/core/angles.hpp>
#include <turnscan/workflow/simulation/ply_row.hpp>
#include <turnscan/workflow/simulation/reason_list.hpp>

namespace turnscan {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSamplesHeader =
    "ply\nformat binary_little_endian 1.0\n"
    "comment samples of a virtual scan without noise, and what became of them\n"
    "comment x y z nx ny nz: table frame at angle 0 (body 0), or the room's (body 1)\n"
    "comment depth: along the optical axis; measured: the same with noise, 0 without a return\n"
    "comment object 4294967294: the platter\n"
    "{}"
    "comment reason: {}\n"
    "element vertex {}\n"
    "property float x\nproperty float y\nproperty float z\n"
    "property float nx\nproperty float ny\nproperty float nz\n"
    "property float depth\nproperty float measured\nproperty float incidence_deg\n"
    "property ushort column\nproperty ushort row\nproperty uchar scanner\nproperty uchar body\n"
    "property uint object\nproperty uint face\nproperty uchar reason\nend_header\n";

constexpr std::string_view kPlatterComment =
    "comment body 2: the platter by itself, table frame at angle 0; body 0 where it stood at "
    "first\n";

constexpr std::string_view kHandComment = "comment body 3: the hand, the room's frame\n";

/// Of bodies that exist only in some scans.
std::string more_bodies(const TrueSamples& samples) {
  const auto has = [&](BodyKind kind) {
    return std::find(samples.bodies.begin(), samples.bodies.end(), kind) != samples.bodies.end();
  };
  std::string text;
  if (has(BodyKind::kPlatterAlone)) text += kPlatterComment;
  if (has(BodyKind::kHand)) text += kHandComment;
  return text;
}

Result<> write_frame(const fs::path& path, const TrueSamples& samples) {
  const SampleGrid& grid = samples.exact;
  std::size_t count = 0;
  for (std::size_t i = 0; i < grid.size(); ++i) count += grid.hit(i) ? 1 : 0;
  return write_file_atomically(
      path,
      [&](FileSink& sink) -> Result<> {
        TURNSCAN_TRY(sink.write(std::string_view(
            fmt::format(kSamplesHeader, more_bodies(samples), workflow::reason_list(), count))));
        for (int row = grid.rect.top; row < grid.rect.bottom; ++row) {
          for (int column = grid.rect.left; column < grid.rect.right; ++column) {
            const std::size_t i = grid.index(column, row);
            if (!grid.hit(i)) continue;
            const SampleHit& hit = samples.hits[i];
            const Vec3f p = hit.p_body.cast<float>(), n = hit.normal_body.cast<float>();
            TURNSCAN_TRY(sink.write(
                workflow::PlyRow(
                    p.x(), p.y(), p.z(), n.x(), n.y(), n.z(), grid.z[i], samples.measured.z[i],
                    float(hit.incidence_rad / kRadiansPerDegree), std::uint16_t(column),
                    std::uint16_t(row), std::uint8_t(samples.scanner),
                    std::uint8_t(samples.bodies[grid.body(i)]), grid.object(i), grid.triangle[i],
                    std::uint8_t(samples.measured.miss[i]))
                    .bytes()));
          }
        }
        return {};
      },
      Durability::kNamed);
}

}  // namespace

Result<> write_true_samples(const fs::path& folder, const VirtualPasses& scan,
                            const RunContext& context) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    return fail_at(folder.string(), ErrorCode::kIo, "the folder cannot be made: {}",
                   error.message());
  context.begin_phase("true samples", scan.frames().size());
  return parallel_for(scan.frames().size(), 1, context, [&](std::size_t i) -> Result<> {
    if (scan.frames()[i].status == FrameStatus::kDropped) return {};
    const auto [pass, there] = scan.place_of(i);
    TURNSCAN_ASSIGN(const TrueSamples samples, scan.pass(pass).samples(there));
    TURNSCAN_TRY(write_frame(folder / fmt::format("{:06}.ply", scan.frames()[i].index), samples));
    context.advance();
    return {};
  });
}

}  // namespace turnscan
