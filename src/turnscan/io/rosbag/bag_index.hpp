#pragma once
// What is in a bag, of whatever kind: its topics, and where each message lies.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <turnscan/io/file/read_budget.hpp>
#include <unordered_map>
#include <vector>

namespace turnscan::rosbag {

/// How messages are serialised: as ROS 1 does, as ROS 2 does (CDR of DDS), or in another way.
enum class Wire : std::uint8_t { kRos1, kCdr, kOther };

/// The wire that a bag calls "ros1" or "cdr".
Wire wire_of(std::string_view name);

struct Connection {
  std::uint32_t file = 0;  ///< of the bag's files
  std::uint32_t id = 0;    ///< in that file
  std::string topic;
  std::string type;                    ///< as ROS 1 calls it: "sensor_msgs/Image"
  std::string serialisation = "ros1";  ///< as the bag calls it
  Wire wire() const { return wire_of(serialisation); }
};

/// Position of a message.
struct MessagePlace {
  std::int64_t time_ns = 0;  ///< time of recording
  std::uint32_t connection = 0;
  std::uint32_t file = 0;
  /// Its chunk and the offset of its record there; for a database the halves of its row.
  std::uint32_t chunk = 0, offset = 0;
};

class BagIndex {
 public:
  static constexpr std::size_t kMaxMessages = 8000000;
  static constexpr std::size_t kMaxConnections = 100000;

  BagIndex(std::uint64_t file_bytes, const RunContext& context)
      : budget_(std::make_unique<const file::ReadBudget>(file_bytes, context)) {}

  const file::ReadBudget& budget() const { return *budget_; }
  /// Keeps the first of those with the same number. ROS 2's name of the type is shortened. Fails
  /// with kResourceLimit.
  Result<> add_connection(Connection connection);
  bool knows(std::uint32_t file, std::uint32_t connection) const {
    return by_id_.count(key(file, connection)) > 0;
  }
  /// Fails with kResourceLimit, beyond the budget and beyond kMaxMessages.
  Result<> add_message(const MessagePlace& place);
  const std::vector<MessagePlace>& places() const { return places_; }
  /// Drops messages of unknown connections and sorts the others by topic, then by time.
  void finish();

  const std::vector<Connection>& connections() const { return connections_; }
  const Connection& connection(const MessagePlace& place) const {
    return connections_[by_id_.at(key(place.file, place.connection))];
  }
  std::span<const MessagePlace> messages(std::string_view topic) const;
  /// The first connection of the topic, or nullptr.
  const Connection* find(std::string_view topic) const;

  /// Why the files were not read to their end, with the byte offset; empty: they were.
  std::string cut;

 private:
  static std::uint64_t key(std::uint32_t file, std::uint32_t id) {
    return std::uint64_t(file) << 32 | id;
  }

  struct Topic {
    std::size_t connection = 0;  ///< the first one of the topic
    std::size_t begin = 0, end = 0;
  };
  std::vector<Connection> connections_;
  std::unordered_map<std::uint64_t, std::size_t> by_id_;
  std::vector<MessagePlace> places_;
  std::unordered_map<std::string, Topic> topics_;
  std::unique_ptr<const file::ReadBudget> budget_;
};

}  // namespace turnscan::rosbag
