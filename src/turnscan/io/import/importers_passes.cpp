// Imports several data sets as passes of one object.

#include <algorithm>
#include <map>
#include <turnscan/core/sequence_views.hpp>
#include <turnscan/io/import/importers_common.hpp>

namespace turnscan::importers {

namespace fs = std::filesystem;

namespace {

bool same_poses(const std::optional<Pose>& a, const std::optional<Pose>& b) {
  return a.has_value() == b.has_value() && (!a || a->isApprox(*b, 1e-9));
}

bool same_camera(const CameraIntrinsics& a, const CameraIntrinsics& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy &&
         a.cx == b.cx && a.cy == b.cy && a.distortion == b.distortion;
}

bool same_sensor(const SensorInfo& a, const SensorInfo& b) {
  return a.kind == b.kind && a.model == b.model && same_camera(a.intrinsics, b.intrinsics) &&
         a.depth_unit_m == b.depth_unit_m && a.depth_bias_m == b.depth_bias_m &&
         same_poses(a.T_table_sensor, b.T_table_sensor) &&
         a.viewpoint.parallel == b.viewpoint.parallel && a.viewpoint.value == b.viewpoint.value &&
         a.color_intrinsics.has_value() == b.color_intrinsics.has_value() &&
         (!a.color_intrinsics || (same_camera(*a.color_intrinsics, *b.color_intrinsics) &&
                                  a.T_color_sensor.isApprox(b.T_color_sensor, 1e-9)));
}

bool same_rig(const SequenceHeader& a, const SequenceHeader& b) {
  if (a.turntable.has_value() != b.turntable.has_value()) return false;
  if (a.turntable &&
      !(a.turntable->axis == b.turntable->axis && a.turntable->center_m == b.turntable->center_m &&
        a.turntable->radius_m == b.turntable->radius_m &&
        a.turntable->speed_rad_s == b.turntable->speed_rad_s))
    return false;
  return std::equal(a.sensors.begin(), a.sensors.end(), b.sensors.begin(), b.sensors.end(),
                    same_sensor);
}

/// Concatenates the data sets, numbering their passes consecutively.
class PassSequence : public SequenceView {
 public:
  PassSequence() : SequenceView(SequenceHeader()) {}
  void add_set(const fs::path& path, std::unique_ptr<FrameSequence> set) {
    std::map<std::uint32_t, std::uint32_t> numbers;
    for (const FrameInfo& frame : set->frames()) numbers.emplace(frame.pass, 0);
    for (auto& [own, number] : numbers) number = passes_++;
    const std::string here =
        numbers.size() == 1 ? fmt::format("pass {} is", passes_ - 1)
                            : fmt::format("passes {} to {} are",
                                          passes_ - std::uint32_t(numbers.size()), passes_ - 1);
    // The first line of the source states its origin, the others are assumptions.
    const std::string& source = set->header().source;
    const std::size_t line = std::min(source.find('\n'), source.size());
    SequenceHeader header = sets_.empty() ? set->header() : this->header();
    if (sets_.empty())
      header.source = fmt::format("passes of several data sets{}", source.substr(line));
    add_note(header, fmt::format("{} {}", here, display_name(path)));
    for (std::size_t i = 0; i < set->frames().size(); ++i) {
      FrameInfo info = set->frames()[i];
      info.index = std::uint32_t(frames().size());
      info.pass = numbers[info.pass];
      header.poses_within_pass |= info.T_table_sensor.has_value();
      add(*set, i, std::move(info));
    }
    set_header(std::move(header));
    sets_.push_back(std::move(set));
  }

 private:
  std::vector<std::unique_ptr<FrameSequence>> sets_;
  std::uint32_t passes_ = 0;
};

}  // namespace

}  // namespace turnscan::importers

namespace turnscan {

Result<std::unique_ptr<FrameSequence>> open_foreign_passes(
    const std::vector<std::filesystem::path>& paths, const ImportOptions& options,
    const RunContext& context) {
  if (paths.size() == 1) return open_foreign(paths[0], options, context);
  auto out = std::make_unique<importers::PassSequence>();
  for (std::size_t k = 0; k < paths.size(); ++k) {
    TURNSCAN_ASSIGN(auto set, open_foreign(paths[k], options, context));
    if (k > 0 && !importers::same_rig(out->header(), set->header()))
      return fail_at(paths[k].string(), ErrorCode::kInvalidOption,
                     "its sensor or turntable is another than that of {}; import each to a "
                     "recording of its own, and give all of them to turnscan reconstruct",
                     paths[0].string());
    out->add_set(paths[k], std::move(set));
  }
  return out;
}

}  // namespace turnscan
