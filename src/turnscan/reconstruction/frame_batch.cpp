#include <turnscan/reconstruction/frame_batch.hpp>

namespace turnscan {

std::vector<RayTable> ray_tables(const SequenceHeader& header) {
  std::vector<RayTable> tables;
  for (const SensorInfo& sensor : header.sensors) {
    tables.push_back(sensor.kind == SensorKind::kDepthCamera ? RayTable(sensor.intrinsics)
                                                             : RayTable());
  }
  return tables;
}

}  // namespace turnscan
