#pragma once
// The chunks of a bag's file, and the most recently unpacked ones.

#include <memory>
#include <mutex>
#include <turnscan/io/rosbag/bag_part.hpp>
#include <turnscan/io/rosbag/chunk_codec.hpp>

namespace turnscan::rosbag {

struct Chunk {
  std::uint64_t data_at = 0;  ///< offset in the file
  std::uint32_t stored = 0;   ///< bytes in the file
  std::uint32_t size = 0;     ///< unpacked
  Packing packing = Packing::kNone;
  bool indexed = false;
};

class BagChunks {
 public:
  static constexpr std::uint64_t kMaxChunkBytes = std::uint64_t(128) << 20;  ///< unpacked

  explicit BagChunks(file::RandomAccessFile file) : file_(std::move(file)) {}

  const file::RandomAccessFile& file() const { return file_; }
  /// Fails with kFormat if the sizes cannot be true, kResourceLimit for a packed chunk of more than
  /// kMaxChunkBytes and for too many of them.
  Result<> add(const Chunk& chunk);
  /// A message outside of a chunk, as one of its own.
  Result<> add_message(std::uint64_t begin, std::uint64_t size);
  std::uint32_t count() const { return std::uint32_t(chunks_.size()); }
  const Chunk& operator[](std::uint32_t chunk) const { return chunks_[chunk]; }
  /// The last one has an index.
  void set_indexed() { chunks_.back().indexed = true; }

  /// Packed ones, and others that no index describes. From several threads. Fails as unpack() and
  /// reading do.
  Result<std::shared_ptr<const std::string>> unpacked(std::uint32_t chunk,
                                                      const file::ReadBudget* charged) const;
  /// Bytes of the file as a message.
  Result<Payload> plain(std::uint64_t offset, std::size_t size,
                        const file::ReadBudget* charged) const;
  Error at_chunk(Error error, std::uint32_t chunk) const;
  Error no_message_at(std::uint32_t chunk) const;

  /// Calls scan(chunk, messages) for chunks whose messages no index names, and with messages false
  /// for those with a message of an unknown connection, as in a file that was not closed.
  template <class Scan>
  Result<> look_into(std::uint32_t number, const BagIndex& index, Scan scan) const {
    const std::vector<char> wanted = wanted_chunks(number, index);
    for (std::uint32_t i = 0; i < count(); ++i) {
      if (wanted[i] == 0 || chunks_[i].size > kMaxChunkBytes) continue;
      TURNSCAN_TRY(scan(i, wanted[i] == 2));
      TURNSCAN_TRY(index.budget().state());
    }
    return {};
  }

 private:
  std::vector<char> wanted_chunks(std::uint32_t number, const BagIndex& index) const;
  std::shared_ptr<const std::string> find(std::uint32_t chunk) const;
  /// Drops the oldest, and before a large one all.
  void make_room(bool large) const;

  file::RandomAccessFile file_;
  std::vector<Chunk> chunks_;
  mutable std::mutex guard_;
  mutable std::mutex one_large_;  ///< only one large chunk is unpacked, and kept, at a time
  mutable std::vector<std::pair<std::uint32_t, std::shared_ptr<const std::string>>> cache_;
};

}  // namespace turnscan::rosbag
