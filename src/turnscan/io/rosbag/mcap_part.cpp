#include <algorithm>
#include <map>
#include <turnscan/io/rosbag/bag_chunks.hpp>
#include <turnscan/io/rosbag/wire_fields.hpp>

namespace turnscan::rosbag {

namespace {

enum class McapOp : std::uint8_t {
  kHeader = 1,
  kFooter = 2,
  kSchema = 3,
  kChannel = 4,
  kMessage = 5,
  kChunk = 6,
  kMessageIndex = 7
};

constexpr std::string_view kMcapVersion = "\x89MCAP0\r\n";
constexpr std::size_t kOpBytes = 9;           // an operation and the length of its record
constexpr std::size_t kMessageHead = 22;      // channel, number, two times
constexpr std::size_t kRecordPiece = 64;      // most records' heads are shorter
constexpr std::uint64_t kMaxNames = 1 << 20;  // of a schema or channel, in bytes
constexpr std::size_t kMaxType = 256;         // each channel of a schema gets a copy of its name
constexpr std::uint64_t kMaxIndex = 6 + 16 * std::uint64_t(BagIndex::kMaxMessages);

/// A record, or in the file its beginning.
struct McapRecord {
  McapOp op{};
  std::uint64_t size = 0;  ///< of its content, which the file holds
  std::string_view begin;  ///< of its content
};

/// Fails with kFormat if `left` bytes do not hold it; a chunk is returned all the same.
Result<McapRecord> mcap_record(std::string_view bytes, std::uint64_t left) {
  if (bytes.size() < kOpBytes) return fail(ErrorCode::kFormat, "a record is not whole");
  McapRecord out;
  out.op = McapOp(std::uint8_t(bytes[0]));
  out.size = file::load<std::uint64_t, false>(bytes.data() + 1);
  if (out.size > left - kOpBytes && out.op != McapOp::kChunk)
    return fail(ErrorCode::kFormat, "a record is longer than what holds it");
  out.begin = bytes.substr(kOpBytes, std::min<std::uint64_t>(out.size, bytes.size()));
  return out;
}

class McapPart : public BagPart {
 public:
  McapPart(file::RandomAccessFile file, std::uint32_t number)
      : chunks_(std::move(file)), number_(number) {}

  Result<> walk(BagIndex& index);
  Result<Payload> read(const MessagePlace& place, std::size_t most,
                       const file::ReadBudget* charged) const override;

 private:
  Result<> take(const McapRecord& record, std::uint64_t at, BagIndex& index, std::uint64_t& next);
  Result<> take_schema(std::string_view content);
  Result<> take_channel(std::string_view content, BagIndex& index) const;
  Result<> take_chunk(const McapRecord& record, std::uint64_t at, std::uint64_t& next);
  Result<> take_index(std::string_view content, BagIndex& index);
  Result<> scan(std::uint32_t chunk, bool messages, BagIndex& index);
  Result<MessagePlace> place_of(std::string_view content) const;
  const file::RandomAccessFile& file() const { return chunks_.file(); }

  BagChunks chunks_;
  std::uint32_t number_;
  std::map<std::uint16_t, std::string> schemas_;
  bool closed_ = false;
};

Result<> McapPart::walk(BagIndex& index) {
  std::uint64_t at = kMcapVersion.size();
  while (at < file().size() && !closed_) {
    TURNSCAN_TRY(index.budget().state());
    const std::uint64_t left = file().size() - at;
    TURNSCAN_ASSIGN(const std::string piece,
                    file().read(at, std::min<std::uint64_t>(left, kRecordPiece)));
    std::uint64_t next = at;
    const auto record = mcap_record(piece, left);
    Result<> taken;
    if (record)
      taken = take(*record, at + kOpBytes, index, next);
    else
      taken = tl::unexpected<Error>(record.error());
    if (!taken && taken.error().code != ErrorCode::kFormat) return taken;
    if (!taken) {
      index.cut = fmt::format("at byte {} of {}: {}", at, file().size(), taken.error().message);
      break;
    }
    at = next;
  }
  if (!closed_ && index.cut.empty())
    index.cut = fmt::format("at byte {}: the end is missing", file().size());
  return chunks_.look_into(number_, index, [&](std::uint32_t chunk, bool messages) {
    return scan(chunk, messages, index);
  });
}

/// `at`: of its content.
Result<> McapPart::take(const McapRecord& record, std::uint64_t at, BagIndex& index,
                        std::uint64_t& next) {
  next = at + record.size;
  const auto content = [&]() -> Result<std::string> {
    // Of a schema, a long definition follows its name.
    if (record.op == McapOp::kMessageIndex) {
      if (record.size > kMaxIndex)
        return fail(ErrorCode::kResourceLimit, "an index of {} bytes is longer than can be read",
                    record.size);
      return file().read(at, record.size);
    }
    return file().read(at, std::min(record.size, kMaxNames));
  };
  switch (record.op) {
    case McapOp::kSchema: {
      TURNSCAN_ASSIGN(const std::string bytes, content());
      return take_schema(bytes);
    }
    case McapOp::kChannel: {
      TURNSCAN_ASSIGN(const std::string bytes, content());
      return take_channel(bytes, index);
    }
    case McapOp::kMessageIndex: {
      TURNSCAN_ASSIGN(const std::string bytes, content());
      return take_index(bytes, index);
    }
    case McapOp::kMessage: {
      TURNSCAN_ASSIGN(MessagePlace place, place_of(record.begin));
      TURNSCAN_TRY(chunks_.add_message(at - kOpBytes, record.size + kOpBytes));
      place.chunk = chunks_.count() - 1;
      return index.add_message(place);
    }
    case McapOp::kChunk:
      return take_chunk(record, at, next);
    case McapOp::kFooter:
      closed_ = true;
      return {};
    default:
      return {};
  }
}

Result<> McapPart::take_schema(std::string_view content) {
  WireFields fields(content);
  const auto id = fields.number<std::uint16_t>();
  const std::string_view name = fields.text();
  TURNSCAN_TRY(fields.check("of a schema"));
  schemas_.emplace(id, name.substr(0, kMaxType));
  return {};
}

Result<> McapPart::take_channel(std::string_view content, BagIndex& index) const {
  WireFields fields(content);
  const auto id = fields.number<std::uint16_t>();
  const auto schema = schemas_.find(fields.number<std::uint16_t>());
  const std::string_view topic = fields.text();
  const std::string_view wire = fields.text();
  TURNSCAN_TRY(fields.check("of a channel"));
  return index.add_connection({number_, id, std::string(topic),
                               schema == schemas_.end() ? std::string() : schema->second,
                               std::string(wire)});
}

Result<> McapPart::take_chunk(const McapRecord& record, std::uint64_t at, std::uint64_t& next) {
  WireFields fields(record.begin);
  for (int i = 0; i < 2; ++i) (void)fields.number<std::uint64_t>();  // times
  const auto size = fields.number<std::uint64_t>();
  (void)fields.number<std::uint32_t>();  // CRC
  const std::string_view name = fields.text();
  const auto stored = fields.number<std::uint64_t>();
  TURNSCAN_TRY(fields.check("of a chunk"));
  TURNSCAN_ASSIGN(const Packing packing, packing_of(name.empty() ? "none" : name));
  const std::uint64_t data_at = at + (record.begin.size() - fields.left());
  if (stored > file().size() - data_at || record.size > file().size() - at) {
    if (packing != Packing::kNone) return fail(ErrorCode::kFormat, "a chunk is not whole");
    next = data_at;  // its complete records can be read
    return {};
  }
  if (data_at + stored > at + record.size)
    return fail(ErrorCode::kFormat, "a chunk is longer than its record");
  if (std::max(size, stored) > 0xffffffffU)
    return fail(ErrorCode::kResourceLimit,
                "a chunk of {} bytes is larger than can be read; record with smaller ones", size);
  return chunks_.add({data_at, std::uint32_t(stored), std::uint32_t(size), packing, false});
}

Result<> McapPart::take_index(std::string_view content, BagIndex& index) {
  WireFields fields(content);
  const auto channel = fields.number<std::uint16_t>();
  WireFields entries(fields.data());
  TURNSCAN_TRY(fields.check("of an index"));
  if (chunks_.count() == 0) return fail(ErrorCode::kFormat, "an index comes before any chunk");
  chunks_.set_indexed();
  const std::uint32_t chunk = chunks_.count() - 1;
  while (entries.left() > 0) {
    const auto time_ns = entries.number<std::uint64_t>();
    const auto offset = entries.number<std::uint64_t>();
    TURNSCAN_TRY(entries.check("of an index"));
    if (offset >= chunks_[chunk].size)
      return fail(ErrorCode::kFormat, "an index names a message behind the end of its chunk");
    TURNSCAN_TRY(
        index.add_message({std::int64_t(time_ns), channel, number_, chunk, std::uint32_t(offset)}));
  }
  return {};
}

Result<MessagePlace> McapPart::place_of(std::string_view content) const {
  WireFields fields(content);
  MessagePlace out;
  out.file = number_;
  out.connection = fields.number<std::uint16_t>();
  (void)fields.number<std::uint32_t>();  // number
  out.time_ns = std::int64_t(fields.number<std::uint64_t>());
  (void)fields.number<std::uint64_t>();  // time of publishing
  TURNSCAN_TRY(fields.check("in the file"));
  return out;
}

Result<> McapPart::scan(std::uint32_t chunk, bool messages, BagIndex& index) {
  const auto bytes = chunks_.unpacked(chunk, &index.budget());
  if (!bytes) {
    index.cut = bytes.error().message;
    return {};
  }
  for (std::string_view rest = **bytes; !rest.empty();) {
    const auto record = mcap_record(rest, rest.size());
    Result<> taken;
    if (!record || record->begin.size() < record->size) {
      taken = fail(ErrorCode::kFormat, "a record is not whole");
    } else if (record->op == McapOp::kSchema) {
      taken = take_schema(record->begin);
    } else if (record->op == McapOp::kChannel) {
      taken = take_channel(record->begin, index);
    } else if (record->op == McapOp::kMessage && messages) {
      TURNSCAN_ASSIGN(MessagePlace place, place_of(record->begin));
      place.chunk = chunk;
      place.offset = std::uint32_t((*bytes)->size() - rest.size());
      taken = index.add_message(place);
    }
    if (!taken && taken.error().code != ErrorCode::kFormat) return taken;
    if (!taken) {
      index.cut = chunks_.at_chunk(taken.error(), chunk).message;
      return {};
    }
    rest.remove_prefix(kOpBytes + record->size);
  }
  return {};
}

Result<Payload> McapPart::read(const MessagePlace& place, std::size_t most,
                               const file::ReadBudget* charged) const {
  const Chunk& chunk = chunks_[place.chunk];
  const bool plain = chunk.packing == Packing::kNone;
  const std::uint64_t at = chunk.data_at + place.offset;
  Payload out;
  std::string head;
  std::string_view bytes;
  if (plain) {
    constexpr std::size_t kHead = kOpBytes + kMessageHead;
    TURNSCAN_ASSIGN(head,
                    file().read(at, std::min<std::uint64_t>(kHead, chunk.size - place.offset)));
    bytes = head;
  } else {
    TURNSCAN_ASSIGN(out.owner, chunks_.unpacked(place.chunk, charged));
    bytes =
        std::string_view(*out.owner).substr(std::min<std::size_t>(place.offset, out.owner->size()));
  }
  const auto record = mcap_record(bytes, chunk.size - place.offset);
  const auto found = record && record->op == McapOp::kMessage
                         ? place_of(record->begin)
                         : Result<MessagePlace>(fail(ErrorCode::kFormat, "no message"));
  if (!found || found->connection != place.connection)
    return tl::unexpected<Error>(chunks_.no_message_at(place.chunk));
  const std::size_t size = std::size_t(record->size) - kMessageHead;
  if (size > Bag::kMaxMessageBytes)
    return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                size);
  if (plain) return chunks_.plain(at + kOpBytes + kMessageHead, std::min(most, size), charged);
  out.bytes = bytes.substr(kOpBytes + kMessageHead, std::min(most, size));
  return out;
}

}  // namespace

PartResult open_mcap_part(file::RandomAccessFile file, std::uint32_t number, BagIndex& index) {
  const std::size_t most = std::size_t(std::min<std::uint64_t>(file.size(), kMcapVersion.size()));
  TURNSCAN_ASSIGN(const std::string magic, file.read(0, most));
  if (magic != kMcapVersion)
    return fail(ErrorCode::kUnsupported,
                "the MCAP file is of another version than 0; bring it there with mcap recover");
  auto part = std::make_unique<McapPart>(std::move(file), number);
  TURNSCAN_TRY(part->walk(index));
  return part;
}

}  // namespace turnscan::rosbag
