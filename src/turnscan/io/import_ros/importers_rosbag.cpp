// Imports bags of ROS: RealSense recordings made by librealsense, and others with depth images.

#include <algorithm>
#include <turnscan/io/import/importers_common.hpp>
#include <turnscan/io/import_ros/bag_sequence.hpp>

namespace turnscan::importers {

OpenResult open_rosbag(const std::filesystem::path& path, const ImportOptions& options,
                       const RunContext& context) {
  auto opened = rosbag::Bag::open(path, context);
  if (!opened) return at_path(path, opened.error());
  rosbag::Bag& bag = *opened;
  if (bag.connections().empty())
    return fail_at(path.string(), ErrorCode::kFormat,
                   "there is no message in the bag{}{}; record again",
                   bag.cut().empty() ? "" : ", which could not be read to its end: ", bag.cut());
  const auto& all = bag.connections();
  if (std::all_of(all.begin(), all.end(), [](const rosbag::Connection& connection) {
        return connection.wire() == rosbag::Wire::kOther;
      }))
    return fail_at(path.string(), ErrorCode::kUnsupported,
                   "its messages are serialised as {}; record them as ROS does (ros1, cdr)",
                   all.front().serialisation.empty() ? "nothing known"
                                                     : all.front().serialisation.substr(0, 40));
  auto streams = is_realsense(bag) ? realsense_streams(bag, options) : ros_streams(bag, options);
  if (!streams) return at_path(path, streams.error());
  SequenceHeader header;
  header.source = streams->origin;
  header.sensors.push_back(streams->sensor);
  for (const std::string& note : streams->notes) add_note(header, note);
  TURNSCAN_TRY(apply_turntable_options(options, true, header));
  auto sequence = make_bag_sequence(std::move(bag), std::move(*streams), std::move(header));
  if (!sequence) return at_path(path, sequence.error());
  return sequence;
}

}  // namespace turnscan::importers
