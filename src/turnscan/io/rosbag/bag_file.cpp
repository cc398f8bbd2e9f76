#include <algorithm>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/rosbag/bag_file.hpp>
#include <turnscan/io/rosbag/bag_record.hpp>
#include <utility>

namespace turnscan::rosbag {

namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::size_t kCached = 4;                 // chunks
constexpr std::uint32_t kCachedBytes = 32U << 20;  // a larger one is kept alone
// That a message takes: its place, and the time and number that are read of it.
constexpr std::uint64_t kBytesHeld = 64;
constexpr std::uint64_t kMaxByLz4 = 255;  // maximum expansion
constexpr std::size_t kFirstPiece = 512;  // most headers are shorter

std::uint32_t little_u32(const char* at) { return file::load<std::uint32_t, false>(at); }

}  // namespace

/// A record in the file: its header's bytes, and the position of its data.
struct Bag::Head {
  std::string bytes;
  std::uint64_t data_at = 0;
  std::uint32_t data_bytes = 0;
  Result<RecordHeader> fields() const { return RecordHeader::parse(bytes); }
};

/// The most recently unpacked chunks. Only one large one is unpacked, and kept, at a time.
struct Bag::Cache {
  std::mutex guard, one_large;
  std::vector<std::pair<std::uint32_t, std::shared_ptr<const std::string>>> chunks;

  std::shared_ptr<const std::string> find(std::uint32_t chunk) {
    const std::lock_guard lock(guard);
    for (auto& [number, bytes] : chunks)
      if (number == chunk) return bytes;
    return nullptr;
  }
  /// Drops the oldest, and before a large one all.
  void make_room(bool large) {
    const std::lock_guard lock(guard);
    while (!chunks.empty() &&
           (large || chunks.size() >= kCached || chunks.front().second->size() > kCachedBytes))
      chunks.erase(chunks.begin());
  }
};

Bag::Bag(file::RandomAccessFile file, const RunContext& context)
    : file_(std::move(file)),
      cache_(std::make_unique<Cache>()),
      budget_(std::make_unique<const file::ReadBudget>(file_.size(), context)) {}
Bag::Bag(Bag&&) noexcept = default;
Bag& Bag::operator=(Bag&&) noexcept = default;
Bag::~Bag() = default;

Result<Bag> Bag::open(const std::filesystem::path& path, const RunContext& context) {
  TURNSCAN_ASSIGN(file::RandomAccessFile file, file::RandomAccessFile::open(path));
  const std::size_t most = std::size_t(std::min<std::uint64_t>(file.size(), kVersion.size()));
  TURNSCAN_ASSIGN(const std::string magic, file.read(0, most));
  if (!magic.starts_with(kMagic))
    return fail_at(path.string(), ErrorCode::kFormat, "this is no ROS bag; give one");
  if (magic != kVersion)
    return fail_at(path.string(), ErrorCode::kUnsupported,
                   "the bag is of another version than 2.0; bring it there with rosbag fix");
  Bag bag(std::move(file), context);
  TURNSCAN_TRY(bag.walk());
  TURNSCAN_TRY(bag.look_into_chunks());
  bag.sort_by_topic();
  return bag;
}

void Bag::sort_by_topic() {
  std::stable_sort(
      places_.begin(), places_.end(),
      [](const MessagePlace& a, const MessagePlace& b) { return a.time_ns < b.time_ns; });
  std::unordered_map<std::uint32_t, Topic*> topic_of;
  std::vector<Topic*> topics;
  for (const Connection& connection : connections_) {
    const auto [topic, fresh] = topics_.try_emplace(connection.topic);
    topic_of.emplace(connection.id, &topic->second);
    if (!fresh) continue;
    topic->second.connection = std::size_t(&connection - connections_.data());
    topics.push_back(&topic->second);
  }
  for (const MessagePlace& place : places_) ++topic_of.at(place.connection)->end;
  std::size_t begin = 0;
  for (Topic* topic : topics) {
    topic->begin = begin;
    begin += std::exchange(topic->end, begin);
  }
  std::vector<MessagePlace> sorted(places_.size());
  for (const MessagePlace& place : places_) sorted[topic_of.at(place.connection)->end++] = place;
  places_ = std::move(sorted);
}

Result<Bag::Head> Bag::head_at(std::uint64_t offset) const {
  const std::uint64_t there = file_.size() - offset;
  if (there < 8) return fail(ErrorCode::kFormat, "a record is not whole");
  Head head;
  const std::size_t piece = std::size_t(std::min<std::uint64_t>(there, kFirstPiece));
  TURNSCAN_ASSIGN(head.bytes, file_.read(offset, piece));
  const std::uint32_t length = little_u32(head.bytes.data());
  if (length > kMaxHeaderBytes || length > there - 8)
    return fail(ErrorCode::kFormat, "a record's header is longer than what is there");
  const std::size_t whole = std::size_t(length) + 8;
  if (whole > piece) {
    TURNSCAN_ASSIGN(head.bytes, file_.read(offset, whole));
  }
  head.data_bytes = little_u32(head.bytes.data() + 4 + length);
  head.bytes = head.bytes.substr(4, length);
  head.data_at = offset + whole;
  return head;
}

Result<> Bag::walk() {
  std::uint64_t at = kVersion.size();
  while (at < file_.size()) {
    TURNSCAN_TRY(budget_->state());
    std::uint64_t next = at;
    auto head = head_at(at);
    Result<> taken;
    if (head)
      taken = take(*head, next);
    else
      taken = tl::unexpected<Error>(head.error());
    if (!taken && taken.error().code != ErrorCode::kFormat) return taken;
    if (!taken) {
      cut_ = fmt::format("at byte {} of {}: {}", at, file_.size(), taken.error().message);
      return {};
    }
    at = next;
  }
  return {};
}

Result<> Bag::take(const Head& head, std::uint64_t& next) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto op = fields.u8("op");
  if (!op) return fail(ErrorCode::kFormat, "a record does not say what it is");
  const bool chunk = Op(*op) == Op::kChunk;
  const std::uint64_t there = file_.size() - head.data_at;
  if (head.data_bytes > there && !chunk) return fail(ErrorCode::kFormat, "a record is not whole");
  next = head.data_at + head.data_bytes;
  if (chunk) return take_chunk(head, next);
  if (Op(*op) == Op::kIndex) return take_index(head);
  if (Op(*op) == Op::kBagHeader && !fields.text("encryptor").empty())
    return fail_at(path().string(), ErrorCode::kUnsupported,
                   "the bag is encrypted; decrypt it with rosbag decrypt");
  if (Op(*op) == Op::kConnection) {
    TURNSCAN_ASSIGN(const std::string data, file_.read(head.data_at, head.data_bytes));
    return take_connection(head.bytes, data);
  }
  if (Op(*op) != Op::kMessage) return {};
  // A message outside of a chunk: the recorder never closed the current one.
  const auto connection = fields.u32("conn");
  const auto time_ns = fields.time_ns("time");
  if (!connection || !time_ns)
    return fail(ErrorCode::kFormat, "a message has no connection or time");
  const std::uint64_t begin = head.data_at - 8 - head.bytes.size();
  const std::uint64_t size = next - begin;
  if (head.data_bytes > kMaxMessageBytes || chunks_.size() >= kMaxMessages)
    return fail_at(path().string(), ErrorCode::kResourceLimit,
                   "a message of {} bytes is longer than can be read", size);
  chunks_.push_back({begin, std::uint32_t(size), std::uint32_t(size), Packing::kNone, true});
  return add_message({*time_ns, *connection, std::uint32_t(chunks_.size() - 1), 0});
}

Result<> Bag::take_chunk(const Head& head, std::uint64_t& next) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto size = fields.u32("size");
  if (!size) return fail(ErrorCode::kFormat, "a chunk does not say its size");
  auto packing = packing_of(fields.text("compression"));
  if (!packing) return tl::unexpected<Error>(at_chunk(packing.error(), 0));
  // A recorder fills in the sizes when it closes the chunk. If the chunk is not compressed, its
  // content can still be read as records of the file.
  const bool open = head.data_bytes == 0 && *size == 0;
  if (open && *packing == Packing::kNone) return {};
  const std::uint64_t there = file_.size() - head.data_at;
  if (open && there > 0)
    return fail(ErrorCode::kFormat,
                "the recorder had not closed this chunk, whose messages are "
                "packed");
  if (head.data_bytes > there && *packing != Packing::kNone)
    return fail(ErrorCode::kFormat, "a chunk is not whole");
  Chunk chunk{head.data_at, head.data_bytes, *size, *packing, false};
  const bool lies = *packing == Packing::kNone ? *size != head.data_bytes
                    : *packing == Packing::kLz4
                        ? *size > kMaxByLz4 * (std::uint64_t(head.data_bytes) + 1)
                        : false;
  if (lies)
    return fail(ErrorCode::kFormat, "a chunk claims {} bytes out of {}", *size, head.data_bytes);
  if (*packing != Packing::kNone && *size > kMaxChunkBytes)
    return fail_at(path().string(), ErrorCode::kResourceLimit,
                   "a chunk of {} bytes is larger than can be read; record with smaller ones",
                   *size);
  if (chunks_.size() >= kMaxMessages)
    return fail_at(path().string(), ErrorCode::kResourceLimit, "the bag has more than {} chunks",
                   kMaxMessages);
  if (head.data_bytes > there) {  // its complete records can be read
    next = head.data_at;
    return {};
  }
  chunks_.push_back(chunk);
  return {};
}

Result<> Bag::take_index(const Head& head) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto connection = fields.u32("conn"), count = fields.u32("count");
  constexpr std::uint32_t kEntryBytes = 12;
  if (!connection || !count || head.data_bytes / kEntryBytes != *count ||
      head.data_bytes % kEntryBytes != 0)
    return fail(ErrorCode::kFormat, "an index does not have the length that it claims");
  if (chunks_.empty()) return fail(ErrorCode::kFormat, "an index comes before any chunk");
  Chunk& chunk = chunks_.back();
  chunk.indexed = true;
  TURNSCAN_ASSIGN(const std::string data, file_.read(head.data_at, head.data_bytes));
  for (std::size_t at = 0; at < data.size(); at += kEntryBytes) {
    const char* entry = data.data() + at;
    const std::int64_t time_ns =
        std::int64_t(little_u32(entry)) * 1000000000 + little_u32(entry + 4);
    const std::uint32_t offset = little_u32(entry + 8);
    if (offset >= chunk.size)
      return fail(ErrorCode::kFormat, "an index names a message behind the end of its chunk");
    TURNSCAN_TRY(add_message({time_ns, *connection, std::uint32_t(chunks_.size() - 1), offset}));
  }
  return {};
}

Result<> Bag::take_connection(std::string_view header, std::string_view data) {
  TURNSCAN_ASSIGN(const RecordHeader fields, RecordHeader::parse(header));
  TURNSCAN_ASSIGN(const RecordHeader described, RecordHeader::parse(data));
  const auto id = fields.u32("conn");
  if (!id) return fail(ErrorCode::kFormat, "a connection has no number");
  if (by_id_.count(*id) > 0) return {};
  if (connections_.size() >= kMaxConnections)
    return fail_at(path().string(), ErrorCode::kResourceLimit,
                   "the bag has more than {} connections", kMaxConnections);
  by_id_.emplace(*id, connections_.size());
  connections_.push_back(
      {*id, std::string(fields.text("topic")), std::string(described.text("type"))});
  return {};
}

Result<> Bag::add_message(MessagePlace place) {
  if (places_.size() >= kMaxMessages)
    return fail_at(path().string(), ErrorCode::kResourceLimit,
                   "the bag has more than {} messages; filter it with rosbag filter", kMaxMessages);
  TURNSCAN_TRY(budget_->hold(kBytesHeld));
  places_.push_back(place);
  return {};
}

/// Scans chunks without an index for messages, and others for connections that are not defined
/// elsewhere, as in a bag that was not closed.
Result<> Bag::look_into_chunks() {
  std::vector<char> wanted(chunks_.size(), 0);
  for (std::size_t i = 0; i < chunks_.size(); ++i)
    if (!chunks_[i].indexed) wanted[i] = 2;
  std::unordered_map<std::uint32_t, bool> unknown;
  for (const MessagePlace& place : places_)
    if (by_id_.count(place.connection) == 0 && unknown.emplace(place.connection, true).second)
      wanted[place.chunk] = std::max<char>(wanted[place.chunk], 1);
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (wanted[i] == 0 || chunks_[i].size > kMaxChunkBytes) continue;
    scan(std::uint32_t(i), wanted[i] == 2);
    TURNSCAN_TRY(budget_->state());
    if (places_.size() >= kMaxMessages)
      return fail_at(path().string(), ErrorCode::kResourceLimit,
                     "the bag has more than {} messages", kMaxMessages);
  }
  std::erase_if(places_,
                [&](const MessagePlace& place) { return by_id_.count(place.connection) == 0; });
  return {};
}

void Bag::scan(std::uint32_t chunk, bool messages) {
  const auto bytes = unpacked(chunk);
  if (!bytes) {
    cut_ = bytes.error().message;
    return;
  }
  for (std::size_t at = 0; at < (*bytes)->size();) {
    const auto record = record_at(**bytes, at);
    const auto op = record ? record->header.u8("op") : std::nullopt;
    if (!op) {
      cut_ = fmt::format("in the chunk at byte {}: a record is damaged", chunks_[chunk].data_at);
      return;
    }
    if (Op(*op) == Op::kConnection) {
      const std::string_view header =
          std::string_view(**bytes).substr(at + 4, little_u32((*bytes)->data() + at));
      if (!take_connection(header, record->data)) return;
    }
    const auto connection = record->header.u32("conn");
    const auto time_ns = record->header.time_ns("time");
    if (messages && Op(*op) == Op::kMessage && connection && time_ns &&
        !add_message({*time_ns, *connection, chunk, std::uint32_t(at)}))
      return;
    at = record->end;
  }
}

std::span<const MessagePlace> Bag::messages(std::string_view topic) const {
  const auto found = topics_.find(std::string(topic));
  if (found == topics_.end()) return {};
  return std::span(places_).subspan(found->second.begin, found->second.end - found->second.begin);
}

std::optional<MessagePlace> Bag::first(std::string_view topic) const {
  const auto all = messages(topic);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

const Connection* Bag::find(std::string_view topic) const {
  const auto found = topics_.find(std::string(topic));
  return found == topics_.end() ? nullptr : &connections_[found->second.connection];
}

Error Bag::at_chunk(Error error, std::uint32_t chunk) const {
  if (error.path.empty()) error.path = path().string();
  if (chunk < chunks_.size())
    error.message =
        fmt::format("in the chunk at byte {}: {}", chunks_[chunk].data_at, error.message);
  return error;
}

Result<std::shared_ptr<const std::string>> Bag::unpacked(std::uint32_t chunk) const {
  if (auto known = cache_->find(chunk)) return known;
  const Chunk& place = chunks_[chunk];
  std::unique_lock<std::mutex> one(cache_->one_large, std::defer_lock);
  const bool large = place.size > kCachedBytes || place.stored > kCachedBytes;
  if (large) {
    one.lock();
    if (auto known = cache_->find(chunk)) return known;  // another thread has just unpacked it
  }
  if (opening_) TURNSCAN_TRY(budget_->unpack(place.size));
  cache_->make_room(large);
  TURNSCAN_ASSIGN(std::string stored, file_.read(place.data_at, place.stored));
  if (place.packing != Packing::kNone) {
    auto bytes = unpack(place.packing, stored, place.size);
    if (!bytes) return tl::unexpected<Error>(at_chunk(bytes.error(), chunk));
    stored = std::move(*bytes);
  }
  auto out = std::make_shared<const std::string>(std::move(stored));
  const std::lock_guard lock(cache_->guard);
  cache_->chunks.emplace_back(chunk, out);
  return out;
}

/// Directly from the file.
Result<Payload> Bag::read_plain(const MessagePlace& place, std::size_t most) const {
  const Chunk& chunk = chunks_[place.chunk];
  TURNSCAN_ASSIGN(const Head head, head_at(chunk.data_at + place.offset));
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto op = fields.u8("op");
  if (!op || Op(*op) != Op::kMessage || fields.u32("conn") != place.connection)
    return fail(ErrorCode::kFormat,
                "there is no message where the index says; the file is damaged");
  if (head.data_bytes > kMaxMessageBytes)
    return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                head.data_bytes);
  const std::size_t wanted = std::min<std::size_t>(most, head.data_bytes);
  if (opening_) TURNSCAN_TRY(budget_->unpack(wanted));
  TURNSCAN_ASSIGN(std::string bytes, file_.read(head.data_at, wanted));
  Payload out;
  out.owner = std::make_shared<const std::string>(std::move(bytes));
  out.bytes = *out.owner;
  return out;
}

Result<Payload> Bag::read(const MessagePlace& place, std::size_t most) const {
  if (chunks_[place.chunk].packing == Packing::kNone) {
    auto plain = read_plain(place, most);
    if (!plain) return tl::unexpected<Error>(at_chunk(plain.error(), place.chunk));
    return plain;
  }
  Payload out;
  TURNSCAN_ASSIGN(out.owner, unpacked(place.chunk));
  const auto record = record_at(*out.owner, place.offset);
  const auto op = record ? record->header.u8("op") : std::nullopt;
  if (!op || Op(*op) != Op::kMessage || record->header.u32("conn") != place.connection)
    return tl::unexpected<Error>(
        at_chunk(Error{ErrorCode::kFormat,
                       "there is no message where the index says; the file is damaged",
                       {}},
                 place.chunk));
  out.bytes = record->data.substr(0, most);
  return out;
}

}  // namespace turnscan::rosbag
