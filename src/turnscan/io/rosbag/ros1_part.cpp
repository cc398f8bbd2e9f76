#include <algorithm>
#include <turnscan/io/file/load_value.hpp>
#include <turnscan/io/rosbag/bag_chunks.hpp>
#include <turnscan/io/rosbag/bag_record.hpp>

namespace turnscan::rosbag {

namespace {

constexpr std::string_view kVersion = "#ROSBAG V2.0\n";
constexpr std::size_t kFirstPiece = 512;  // most headers are shorter

std::uint32_t little_u32(const char* at) { return file::load<std::uint32_t, false>(at); }

/// A record in the file: its header's bytes, and the position of its data.
struct Head {
  std::string bytes;
  std::uint64_t data_at = 0;
  std::uint32_t data_bytes = 0;
  Result<RecordHeader> fields() const { return RecordHeader::parse(bytes); }
};

class Ros1Part : public BagPart {
 public:
  Ros1Part(file::RandomAccessFile file, std::uint32_t number)
      : chunks_(std::move(file)), number_(number) {}

  Result<> walk(BagIndex& index);
  Result<Payload> read(const MessagePlace& place, std::size_t most,
                       const file::ReadBudget* charged) const override;

 private:
  Result<Head> head_at(std::uint64_t offset) const;
  Result<> take(const Head& head, BagIndex& index, std::uint64_t& next);
  Result<> take_chunk(const Head& head, std::uint64_t& next);
  Result<> take_index(const Head& head, BagIndex& index);
  Result<> take_connection(std::string_view header, std::string_view data, BagIndex& index) const;
  Result<> scan(std::uint32_t chunk, bool messages, BagIndex& index) const;
  Result<Payload> read_plain(const MessagePlace& place, std::size_t most,
                             const file::ReadBudget* charged) const;
  const file::RandomAccessFile& file() const { return chunks_.file(); }

  BagChunks chunks_;
  std::uint32_t number_;
};

Result<Head> Ros1Part::head_at(std::uint64_t offset) const {
  const std::uint64_t there = file().size() - offset;
  if (there < 8) return fail(ErrorCode::kFormat, "a record is not whole");
  Head head;
  const std::size_t piece = std::size_t(std::min<std::uint64_t>(there, kFirstPiece));
  TURNSCAN_ASSIGN(head.bytes, file().read(offset, piece));
  const std::uint32_t length = little_u32(head.bytes.data());
  if (length > kMaxHeaderBytes || length > there - 8)
    return fail(ErrorCode::kFormat, "a record's header is longer than what is there");
  const std::size_t whole = std::size_t(length) + 8;
  if (whole > piece) {
    TURNSCAN_ASSIGN(head.bytes, file().read(offset, whole));
  }
  head.data_bytes = little_u32(head.bytes.data() + 4 + length);
  head.bytes = head.bytes.substr(4, length);
  head.data_at = offset + whole;
  return head;
}

Result<> Ros1Part::walk(BagIndex& index) {
  std::uint64_t at = kVersion.size();
  while (at < file().size()) {
    TURNSCAN_TRY(index.budget().state());
    std::uint64_t next = at;
    auto head = head_at(at);
    Result<> taken;
    if (head)
      taken = take(*head, index, next);
    else
      taken = tl::unexpected<Error>(head.error());
    if (!taken && taken.error().code != ErrorCode::kFormat) return taken;
    if (!taken) {
      index.cut = fmt::format("at byte {} of {}: {}", at, file().size(), taken.error().message);
      break;
    }
    at = next;
  }
  return chunks_.look_into(number_, index, [&](std::uint32_t chunk, bool messages) {
    return scan(chunk, messages, index);
  });
}

Result<> Ros1Part::take(const Head& head, BagIndex& index, std::uint64_t& next) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto op = fields.u8("op");
  if (!op) return fail(ErrorCode::kFormat, "a record does not say what it is");
  const bool chunk = Op(*op) == Op::kChunk;
  const std::uint64_t there = file().size() - head.data_at;
  if (head.data_bytes > there && !chunk) return fail(ErrorCode::kFormat, "a record is not whole");
  next = head.data_at + head.data_bytes;
  if (chunk) return take_chunk(head, next);
  if (Op(*op) == Op::kIndex) return take_index(head, index);
  if (Op(*op) == Op::kBagHeader && !fields.text("encryptor").empty())
    return fail(ErrorCode::kUnsupported, "the bag is encrypted; decrypt it with rosbag decrypt");
  if (Op(*op) == Op::kConnection) {
    TURNSCAN_ASSIGN(const std::string data, file().read(head.data_at, head.data_bytes));
    return take_connection(head.bytes, data, index);
  }
  if (Op(*op) != Op::kMessage) return {};
  // A message outside of a chunk: the recorder never closed the current one.
  const auto connection = fields.u32("conn");
  const auto time_ns = fields.time_ns("time");
  if (!connection || !time_ns)
    return fail(ErrorCode::kFormat, "a message has no connection or time");
  const std::uint64_t begin = head.data_at - 8 - head.bytes.size();
  TURNSCAN_TRY(chunks_.add_message(begin, next - begin));
  return index.add_message({*time_ns, *connection, number_, chunks_.count() - 1, 0});
}

Result<> Ros1Part::take_chunk(const Head& head, std::uint64_t& next) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto size = fields.u32("size");
  if (!size) return fail(ErrorCode::kFormat, "a chunk does not say its size");
  auto packing = packing_of(fields.text("compression"));
  if (!packing) return tl::unexpected<Error>(chunks_.at_chunk(packing.error(), 0));
  // A recorder fills in the sizes when it closes the chunk. If the chunk is not compressed, its
  // content can still be read as records of the file.
  const bool open = head.data_bytes == 0 && *size == 0;
  if (open && *packing == Packing::kNone) return {};
  const std::uint64_t there = file().size() - head.data_at;
  if (open && there > 0)
    return fail(ErrorCode::kFormat,
                "the recorder had not closed this chunk, whose messages are "
                "packed");
  if (head.data_bytes > there) {
    if (*packing != Packing::kNone) return fail(ErrorCode::kFormat, "a chunk is not whole");
    next = head.data_at;  // its complete records can be read
    return {};
  }
  return chunks_.add({head.data_at, head.data_bytes, *size, *packing, false});
}

Result<> Ros1Part::take_index(const Head& head, BagIndex& index) {
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto connection = fields.u32("conn"), count = fields.u32("count");
  constexpr std::uint32_t kEntryBytes = 12;
  if (!connection || !count || head.data_bytes / kEntryBytes != *count ||
      head.data_bytes % kEntryBytes != 0)
    return fail(ErrorCode::kFormat, "an index does not have the length that it claims");
  if (chunks_.count() == 0) return fail(ErrorCode::kFormat, "an index comes before any chunk");
  chunks_.set_indexed();
  const std::uint32_t chunk = chunks_.count() - 1;
  TURNSCAN_ASSIGN(const std::string data, file().read(head.data_at, head.data_bytes));
  for (std::size_t at = 0; at < data.size(); at += kEntryBytes) {
    const char* entry = data.data() + at;
    const std::int64_t time_ns =
        std::int64_t(little_u32(entry)) * 1000000000 + little_u32(entry + 4);
    const std::uint32_t offset = little_u32(entry + 8);
    if (offset >= chunks_[chunk].size)
      return fail(ErrorCode::kFormat, "an index names a message behind the end of its chunk");
    TURNSCAN_TRY(index.add_message({time_ns, *connection, number_, chunk, offset}));
  }
  return {};
}

Result<> Ros1Part::take_connection(std::string_view header, std::string_view data,
                                   BagIndex& index) const {
  TURNSCAN_ASSIGN(const RecordHeader fields, RecordHeader::parse(header));
  TURNSCAN_ASSIGN(const RecordHeader described, RecordHeader::parse(data));
  const auto id = fields.u32("conn");
  if (!id) return fail(ErrorCode::kFormat, "a connection has no number");
  return index.add_connection(
      {number_, *id, std::string(fields.text("topic")), std::string(described.text("type"))});
}

Result<> Ros1Part::scan(std::uint32_t chunk, bool messages, BagIndex& index) const {
  const auto bytes = chunks_.unpacked(chunk, &index.budget());
  if (!bytes) {
    index.cut = bytes.error().message;
    return {};
  }
  for (std::size_t at = 0; at < (*bytes)->size();) {
    const auto record = record_at(**bytes, at);
    const auto op = record ? record->header.u8("op") : std::nullopt;
    if (!op) {
      index.cut =
          fmt::format("in the chunk at byte {}: a record is damaged", chunks_[chunk].data_at);
      return {};
    }
    if (Op(*op) == Op::kConnection) {
      const std::string_view header =
          std::string_view(**bytes).substr(at + 4, little_u32((*bytes)->data() + at));
      const auto taken = take_connection(header, record->data, index);
      if (!taken && taken.error().code == ErrorCode::kFormat) return {};
      TURNSCAN_TRY(taken);
    }
    const auto connection = record->header.u32("conn");
    const auto time_ns = record->header.time_ns("time");
    if (messages && Op(*op) == Op::kMessage && connection && time_ns)
      TURNSCAN_TRY(index.add_message({*time_ns, *connection, number_, chunk, std::uint32_t(at)}));
    at = record->end;
  }
  return {};
}

/// Directly from the file.
Result<Payload> Ros1Part::read_plain(const MessagePlace& place, std::size_t most,
                                     const file::ReadBudget* charged) const {
  TURNSCAN_ASSIGN(const Head head, head_at(chunks_[place.chunk].data_at + place.offset));
  TURNSCAN_ASSIGN(const RecordHeader fields, head.fields());
  const auto op = fields.u8("op");
  if (!op || Op(*op) != Op::kMessage || fields.u32("conn") != place.connection)
    return fail(ErrorCode::kFormat,
                "there is no message where the index says; the file is damaged");
  if (head.data_bytes > Bag::kMaxMessageBytes)
    return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                head.data_bytes);
  return chunks_.plain(head.data_at, std::min<std::size_t>(most, head.data_bytes), charged);
}

Result<Payload> Ros1Part::read(const MessagePlace& place, std::size_t most,
                               const file::ReadBudget* charged) const {
  if (chunks_[place.chunk].packing == Packing::kNone) {
    auto plain = read_plain(place, most, charged);
    if (!plain) return tl::unexpected<Error>(chunks_.at_chunk(plain.error(), place.chunk));
    return plain;
  }
  Payload out;
  TURNSCAN_ASSIGN(out.owner, chunks_.unpacked(place.chunk, charged));
  const auto record = record_at(*out.owner, place.offset);
  const auto op = record ? record->header.u8("op") : std::nullopt;
  if (!op || Op(*op) != Op::kMessage || record->header.u32("conn") != place.connection)
    return tl::unexpected<Error>(chunks_.no_message_at(place.chunk));
  out.bytes = record->data.substr(0, most);
  return out;
}

}  // namespace

PartResult open_ros1_part(file::RandomAccessFile file, std::uint32_t number, BagIndex& index) {
  const std::size_t most = std::size_t(std::min<std::uint64_t>(file.size(), kVersion.size()));
  TURNSCAN_ASSIGN(const std::string magic, file.read(0, most));
  if (magic != kVersion)
    return fail(ErrorCode::kUnsupported,
                "the bag is of another version than 2.0; bring it there with rosbag fix");
  auto part = std::make_unique<Ros1Part>(std::move(file), number);
  TURNSCAN_TRY(part->walk(index));
  return part;
}

}  // namespace turnscan::rosbag
