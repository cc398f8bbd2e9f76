// The input is a bag of ROS 1 or 2. A byte 0 before it states a topic and a camera.

#include "tests/fuzz/scratch_folder.hpp"

TURNSCAN_FUZZ_TARGET(importer_rosbag) {
  using namespace turnscan;
  static const fuzz::ScratchFolder folder;
  std::string_view bytes = fuzz::text_of(data, size);
  ImportOptions options;
  options.format = ImportFormat::kRosbag;
  if (bytes.starts_with('\0')) {
    bytes.remove_prefix(1);
    options.intrinsics = "40,40,2,1";
    options.topic = "/d/image_raw";
  }
  folder.put("in.bag", bytes);
  fuzz::check_import(folder / "in.bag", options);
  return 0;
}
