#include <algorithm>
#include <turnscan/io/rosbag/bag_chunks.hpp>
#include <unordered_set>

namespace turnscan::rosbag {

namespace {

constexpr std::size_t kCached = 4;                 // chunks
constexpr std::uint32_t kCachedBytes = 32U << 20;  // a larger one is kept alone
constexpr std::uint64_t kMaxByLz4 = 255;           // maximum expansion

}  // namespace

Result<> BagChunks::add(const Chunk& chunk) {
  const bool lies = chunk.packing == Packing::kNone
                        ? chunk.size != chunk.stored
                        : chunk.packing == Packing::kLz4 &&
                              chunk.size > kMaxByLz4 * (std::uint64_t(chunk.stored) + 1);
  if (lies)
    return fail(ErrorCode::kFormat, "a chunk claims {} bytes out of {}", chunk.size, chunk.stored);
  if (chunk.packing != Packing::kNone && chunk.size > kMaxChunkBytes)
    return fail(ErrorCode::kResourceLimit,
                "a chunk of {} bytes is larger than can be read; record with smaller ones",
                chunk.size);
  if (chunks_.size() >= BagIndex::kMaxMessages)
    return fail(ErrorCode::kResourceLimit, "the bag has more than {} chunks",
                BagIndex::kMaxMessages);
  chunks_.push_back(chunk);
  return {};
}

Result<> BagChunks::add_message(std::uint64_t begin, std::uint64_t size) {
  if (size > Bag::kMaxMessageBytes)
    return fail(ErrorCode::kResourceLimit, "a message of {} bytes is longer than can be read",
                size);
  return add({begin, std::uint32_t(size), std::uint32_t(size), Packing::kNone, true});
}

std::vector<char> BagChunks::wanted_chunks(std::uint32_t number, const BagIndex& index) const {
  std::vector<char> wanted(chunks_.size(), 0);
  for (std::size_t i = 0; i < chunks_.size(); ++i)
    if (!chunks_[i].indexed) wanted[i] = 2;
  std::unordered_set<std::uint32_t> unknown;
  for (const MessagePlace& place : index.places())
    if (place.file == number && !index.knows(number, place.connection) &&
        unknown.insert(place.connection).second)
      wanted[place.chunk] = std::max<char>(wanted[place.chunk], 1);
  return wanted;
}

std::shared_ptr<const std::string> BagChunks::find(std::uint32_t chunk) const {
  const std::lock_guard lock(guard_);
  for (auto& [number, bytes] : cache_)
    if (number == chunk) return bytes;
  return nullptr;
}

void BagChunks::make_room(bool large) const {
  const std::lock_guard lock(guard_);
  while (!cache_.empty() &&
         (large || cache_.size() >= kCached || cache_.front().second->size() > kCachedBytes))
    cache_.erase(cache_.begin());
}

Error BagChunks::at_chunk(Error error, std::uint32_t chunk) const {
  if (error.path.empty()) error.path = file_.path().string();
  if (chunk < chunks_.size())
    error.message =
        fmt::format("in the chunk at byte {}: {}", chunks_[chunk].data_at, error.message);
  return error;
}

Error BagChunks::no_message_at(std::uint32_t chunk) const {
  return at_chunk(
      Error{
          ErrorCode::kFormat, "there is no message where the index says; the file is damaged", {}},
      chunk);
}

Result<std::shared_ptr<const std::string>> BagChunks::unpacked(
    std::uint32_t chunk, const file::ReadBudget* charged) const {
  if (auto known = find(chunk)) return known;
  const Chunk& place = chunks_[chunk];
  std::unique_lock<std::mutex> one(one_large_, std::defer_lock);
  const bool large = place.size > kCachedBytes || place.stored > kCachedBytes;
  if (large) {
    one.lock();
    if (auto known = find(chunk)) return known;  // another thread has just unpacked it
  }
  if (charged != nullptr) TURNSCAN_TRY(charged->unpack(place.size));
  make_room(large);
  TURNSCAN_ASSIGN(std::string stored, file_.read(place.data_at, place.stored));
  if (place.packing != Packing::kNone) {
    auto bytes = unpack(place.packing, stored, place.size);
    if (!bytes) return tl::unexpected<Error>(at_chunk(bytes.error(), chunk));
    stored = std::move(*bytes);
  }
  auto out = std::make_shared<const std::string>(std::move(stored));
  const std::lock_guard lock(guard_);
  cache_.emplace_back(chunk, out);
  return out;
}

Result<Payload> BagChunks::plain(std::uint64_t offset, std::size_t size,
                                 const file::ReadBudget* charged) const {
  if (charged != nullptr) TURNSCAN_TRY(charged->unpack(size));
  TURNSCAN_ASSIGN(std::string bytes, file_.read(offset, size));
  Payload out;
  out.owner = std::make_shared<const std::string>(std::move(bytes));
  out.bytes = *out.owner;
  return out;
}

}  // namespace turnscan::rosbag
