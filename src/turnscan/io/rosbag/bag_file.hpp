#pragma once
// The messages of a bag of ROS: a ROS 1 .bag, a ROS 2 .mcap or .db3, or the folder of rosbag2.
// A file that was never closed opens as well, up to its last complete record.

#include <filesystem>
#include <optional>
#include <turnscan/io/rosbag/bag_index.hpp>

namespace turnscan::rosbag {

/// Whether a file begins as a bag of any kind.
bool looks_like_bag(std::string_view begin);
/// The file names of a bag among those of rosbag2's folder.
bool is_part_name(std::string_view name);

/// A message, or its beginning.
struct Payload {
  std::string_view bytes;
  std::shared_ptr<const std::string> owner;
  Wire wire = Wire::kRos1;
};

class BagPart;

class Bag {
 public:
  static constexpr std::uint32_t kMaxMessageBytes = 128U << 20;

  /// Reads headers, connections and indices; unpacks only chunks without an index. Fails with
  /// kFormat if this is not a bag or damaged before its first message, kUnsupported (another
  /// version, encrypted, an unknown compression), kMissingData (a folder without its files),
  /// kResourceLimit beyond the limits of a part, BagIndex or ReadBudget, kCancelled, and kIo.
  static Result<Bag> open(const std::filesystem::path& path,
                          const RunContext& context = RunContext());
  /// What read() costs is charged, too, ...
  const file::ReadBudget& budget() const { return index_->budget(); }
  /// ... until all is known of the recording: then frames are read one by one, as asked for.
  void end_of_opening() { opening_ = false; }

  const std::filesystem::path& path() const { return path_; }
  const std::vector<Connection>& connections() const { return index_->connections(); }
  /// Why the file was not read to its end, with the byte offset; empty: it was.
  const std::string& cut() const { return index_->cut; }

  /// The messages of a topic, sorted by the time of recording.
  std::span<const MessagePlace> messages(std::string_view topic) const {
    return index_->messages(topic);
  }
  /// The first of them.
  std::optional<MessagePlace> first(std::string_view topic) const;
  /// The connection of the topic, or nullptr.
  const Connection* find(std::string_view topic) const { return index_->find(topic); }

  /// The message, or its first `most` bytes. May be called from several threads. Fails with kFormat
  /// (damaged, with the byte offset of the chunk in the file) and kIo.
  Result<Payload> read(const MessagePlace& place, std::size_t most = kMaxMessageBytes) const;

  Bag(Bag&&) noexcept;
  Bag& operator=(Bag&&) noexcept;
  ~Bag();

 private:
  Bag(std::filesystem::path path, std::uint64_t bytes, const RunContext& context);

  std::filesystem::path path_;
  std::unique_ptr<BagIndex> index_;
  std::vector<std::unique_ptr<BagPart>> parts_;
  bool opening_ = true;
};

}  // namespace turnscan::rosbag
