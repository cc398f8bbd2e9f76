#pragma once
// Index of the messages in a ROS 1 bag. Follows "Bag file format 2.0",
// https://wiki.ros.org/Bags/Format/2.0. The file is walked from record to record, so that a bag
// that was never closed can be opened as well, up to its last complete record. Nothing is
// recursive, and sizes claimed by a record are checked against the file first.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <turnscan/io/rosbag/chunk_codec.hpp>
#include <unordered_map>
#include <vector>

namespace turnscan::rosbag {

inline constexpr std::string_view kMagic = "#ROSBAG V";

struct Connection {
  std::uint32_t id = 0;
  std::string topic;
  std::string type;  ///< "sensor_msgs/Image"
};

/// Position of a message.
struct MessagePlace {
  std::int64_t time_ns = 0;  ///< time of recording
  std::uint32_t connection = 0;
  std::uint32_t chunk = 0;
  std::uint32_t offset = 0;  ///< of its record in the chunk
};

/// A message, or its beginning.
struct Payload {
  std::string_view bytes;
  std::shared_ptr<const std::string> owner;
};

class Bag {
 public:
  static constexpr std::size_t kMaxMessages = 8000000;
  static constexpr std::uint64_t kMaxChunkBytes = std::uint64_t(128) << 20;  ///< unpacked
  static constexpr std::uint32_t kMaxMessageBytes = 128U << 20;
  static constexpr std::size_t kMaxConnections = 100000;

  /// Reads headers, connections and indices; unpacks only chunks without an index. Fails with
  /// kFormat if this is not a bag or damaged before its first message, kUnsupported (another
  /// version, encrypted, an unknown compression), kResourceLimit beyond the limits above or those
  /// of a ReadBudget, kCancelled, and kIo.
  static Result<Bag> open(const std::filesystem::path& path,
                          const RunContext& context = RunContext());
  /// What read() costs is charged, too, ...
  const file::ReadBudget& budget() const { return *budget_; }
  /// ... until all is known of the recording: then frames are read one by one, as asked for.
  void end_of_opening() { opening_ = false; }

  const std::filesystem::path& path() const { return file_.path(); }
  const std::vector<Connection>& connections() const { return connections_; }
  /// Why the file was not read to its end, with the byte offset; empty: it was.
  const std::string& cut() const { return cut_; }

  /// The messages of a topic, sorted by the time of recording.
  std::span<const MessagePlace> messages(std::string_view topic) const;
  /// The first of them.
  std::optional<MessagePlace> first(std::string_view topic) const;
  /// The connection of the topic, or nullptr.
  const Connection* find(std::string_view topic) const;

  /// The message, or its first `most` bytes. May be called from several threads. Fails with kFormat
  /// (damaged, with the byte offset of the chunk in the file) and kIo.
  Result<Payload> read(const MessagePlace& place, std::size_t most = kMaxMessageBytes) const;

 private:
  struct Chunk {
    std::uint64_t data_at = 0;  ///< offset in the file
    std::uint32_t stored = 0;   ///< bytes in the file
    std::uint32_t size = 0;     ///< unpacked
    Packing packing = Packing::kNone;
    bool indexed = false;
  };
  struct Cache;
  struct Head;

  Bag(file::RandomAccessFile file, const RunContext& context);
  Result<> walk();
  Result<Head> head_at(std::uint64_t offset) const;
  Result<> take(const Head& head, std::uint64_t& next);
  Result<> take_chunk(const Head& head, std::uint64_t& next);
  Result<> take_index(const Head& head);
  Result<> take_connection(std::string_view header, std::string_view data);
  Result<> add_message(MessagePlace place);
  Result<> look_into_chunks();
  void sort_by_topic();
  void scan(std::uint32_t chunk, bool messages);
  Result<std::shared_ptr<const std::string>> unpacked(std::uint32_t chunk) const;
  Result<Payload> read_plain(const MessagePlace& place, std::size_t most) const;
  Error at_chunk(Error error, std::uint32_t chunk) const;

  file::RandomAccessFile file_;
  std::vector<Connection> connections_;
  std::unordered_map<std::uint32_t, std::size_t> by_id_;
  std::vector<Chunk> chunks_;
  std::vector<MessagePlace> places_;  ///< sorted by topic, then by time
  struct Topic {
    std::size_t connection = 0;  ///< the first one of the topic
    std::size_t begin = 0, end = 0;
  };
  std::unordered_map<std::string, Topic> topics_;
  std::string cut_;
  std::unique_ptr<Cache> cache_;
  std::unique_ptr<const file::ReadBudget> budget_;
  bool opening_ = true;

 public:
  Bag(Bag&&) noexcept;
  Bag& operator=(Bag&&) noexcept;
  ~Bag();
};

}  // namespace turnscan::rosbag
