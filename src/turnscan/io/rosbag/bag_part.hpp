#pragma once
// A file of a bag. Sizes that it claims are checked against its length, nothing is recursive.

#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/rosbag/bag_file.hpp>

namespace turnscan::rosbag {

/// As Bag::read(), without the wire: where `charged` is given, it pays.
class BagPart {
 public:
  virtual ~BagPart() = default;
  virtual Result<Payload> read(const MessagePlace& place, std::size_t most,
                               const file::ReadBudget* charged) const = 0;
};
using PartResult = Result<std::unique_ptr<BagPart>>;

inline constexpr std::string_view kRos1Magic = "#ROSBAG V";
inline constexpr std::string_view kMcapMagic = "\x89MCAP";
inline constexpr std::string_view kSqliteMagic = "SQLite format 3";

/// These put what the file holds into the index, as its file `number`; fail as Bag::open() does.

/// "Bag file format 2.0", https://wiki.ros.org/Bags/Format/2.0. Walked from record to record.
PartResult open_ros1_part(file::RandomAccessFile file, std::uint32_t number, BagIndex& index);
/// https://mcap.dev/spec. Walked from record to record.
PartResult open_mcap_part(file::RandomAccessFile file, std::uint32_t number, BagIndex& index);
/// The SQLite database of rosbag2_storage_sqlite3: tables topics and messages.
PartResult open_sqlite_part(const std::filesystem::path& path, std::uint32_t number,
                            BagIndex& index);

}  // namespace turnscan::rosbag
