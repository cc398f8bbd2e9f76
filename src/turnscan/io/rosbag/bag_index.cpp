#include <algorithm>
#include <turnscan/io/file/clean_name.hpp>
#include <turnscan/io/rosbag/bag_index.hpp>
#include <utility>

namespace turnscan::rosbag {

namespace {

// That a message takes: its place, and the time and number that are read of it.
constexpr std::uint64_t kBytesHeld = 64;
// Later times (after the year 2116) and those before 1970 are none; sums of two do not wrap around.
constexpr std::int64_t kMaxTime_ns = std::int64_t(1) << 62;

}  // namespace

Wire wire_of(std::string_view name) {
  if (name == "ros1") return Wire::kRos1;
  return name == "cdr" ? Wire::kCdr : Wire::kOther;
}

Result<> BagIndex::add_connection(Connection connection) {
  if (knows(connection.file, connection.id)) return {};
  if (connections_.size() >= kMaxConnections)
    return fail(ErrorCode::kResourceLimit, "the bag has more than {} connections", kMaxConnections);
  constexpr std::string_view kRos2 = "/msg/";
  if (const std::size_t at = connection.type.find(kRos2); at != std::string::npos)
    connection.type.erase(at, kRos2.size() - 1);
  // They stand in messages.
  for (std::string* text : {&connection.topic, &connection.type, &connection.serialisation})
    *text = file::clean_name(*text);
  by_id_.emplace(key(connection.file, connection.id), connections_.size());
  connections_.push_back(std::move(connection));
  return {};
}

Result<> BagIndex::add_message(const MessagePlace& place) {
  if (places_.size() >= kMaxMessages)
    return fail(ErrorCode::kResourceLimit,
                "the bag has more than {} messages; filter it to the topics of the camera",
                kMaxMessages);
  TURNSCAN_TRY(budget_->hold(kBytesHeld));
  places_.push_back(place);
  places_.back().time_ns = std::clamp<std::int64_t>(place.time_ns, 0, kMaxTime_ns);
  return {};
}

void BagIndex::finish() {
  std::erase_if(places_, [&](const MessagePlace& p) { return !knows(p.file, p.connection); });
  std::stable_sort(
      places_.begin(), places_.end(),
      [](const MessagePlace& a, const MessagePlace& b) { return a.time_ns < b.time_ns; });
  std::vector<Topic*> topic_of, topics;  // of each connection; each once
  for (const Connection& connection : connections_) {
    const auto [topic, fresh] = topics_.try_emplace(connection.topic);
    topic_of.push_back(&topic->second);
    if (!fresh) continue;
    topic->second.connection = topic_of.size() - 1;
    topics.push_back(&topic->second);
  }
  const auto topic_at = [&](const MessagePlace& place) {
    return topic_of[by_id_.at(key(place.file, place.connection))];
  };
  for (const MessagePlace& place : places_) ++topic_at(place)->end;
  std::size_t begin = 0;
  for (Topic* topic : topics) {
    topic->begin = begin;
    begin += std::exchange(topic->end, begin);
  }
  std::vector<MessagePlace> sorted(places_.size());
  for (const MessagePlace& place : places_) sorted[topic_at(place)->end++] = place;
  places_ = std::move(sorted);
}

std::span<const MessagePlace> BagIndex::messages(std::string_view topic) const {
  const auto found = topics_.find(std::string(topic));
  if (found == topics_.end()) return {};
  return std::span(places_).subspan(found->second.begin, found->second.end - found->second.begin);
}

const Connection* BagIndex::find(std::string_view topic) const {
  const auto found = topics_.find(std::string(topic));
  return found == topics_.end() ? nullptr : &connections_[found->second.connection];
}

}  // namespace turnscan::rosbag
