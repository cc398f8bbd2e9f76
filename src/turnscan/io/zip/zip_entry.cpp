#include <libdeflate.h>

#include <memory>
#include <turnscan/io/zip/zip_fields.hpp>
#include <turnscan/io/zip/zip_file.hpp>

namespace turnscan::zip {

namespace {

constexpr std::uint64_t kMaxRatio = 1032;  // of deflate: 258 bytes from 2 bits

struct FreeDecompressor {
  void operator()(libdeflate_decompressor* d) const { libdeflate_free_decompressor(d); }
};

Result<std::string> inflate(const file::RandomAccessFile& file, const Entry& entry,
                            const std::string& packed) {
  const std::unique_ptr<libdeflate_decompressor, FreeDecompressor> decompressor(
      libdeflate_alloc_decompressor());
  if (decompressor == nullptr)
    return fail_at(file.path().string(), ErrorCode::kResourceLimit,
                   "not enough memory to unpack it");
  std::string out(std::size_t(entry.size), '\0');
  std::size_t size = 0;
  const auto result = libdeflate_deflate_decompress(decompressor.get(), packed.data(),
                                                    packed.size(), out.data(), out.size(), &size);
  if (result != LIBDEFLATE_SUCCESS || size != out.size())
    return fail_at(file.path().string(), ErrorCode::kFormat,
                   "the entry of the archive at byte {} is damaged", entry.header_at);
  return out;
}

/// Beginning of the entry's data: its local header may differ in length from that in the central
/// directory.
Result<std::uint64_t> data_at(const file::RandomAccessFile& file, const Entry& entry) {
  TURNSCAN_ASSIGN(const std::string header,
                  file.read(entry.header_at, std::uint64_t(kLocalHeaderBytes)));
  if (word_at(header, 0) != kLocalHeader)
    return fail_at(file.path().string(), ErrorCode::kFormat,
                   "no entry of the archive begins at byte {}", entry.header_at);
  if ((half_at(header, 6) & kEncrypted) != 0)
    return fail_at(file.path().string(), ErrorCode::kUnsupported,
                   "the entry of the archive at byte {} is encrypted; save it without a password",
                   entry.header_at);
  return entry.header_at + kLocalHeaderBytes + half_at(header, 26) + half_at(header, 28);
}

}  // namespace

Result<std::string> read_entry(const file::RandomAccessFile& file, const Entry& entry,
                               std::uint64_t max_bytes) {
  const std::string path = file.path().string();
  if (entry.method != 0 && entry.method != 8)
    return fail_at(path, ErrorCode::kUnsupported,
                   "the entry of the archive at byte {} is packed by method {}; stored and "
                   "deflated ones are read",
                   entry.header_at, entry.method);
  if (entry.size > max_bytes)
    return fail_at(path, ErrorCode::kResourceLimit,
                   "the entry of the archive at byte {} has {} bytes; at most {} are expected",
                   entry.header_at, entry.size, max_bytes);
  if (entry.method == 0 ? entry.size != entry.packed_size
                        : entry.size / kMaxRatio > entry.packed_size)
    return fail_at(path, ErrorCode::kFormat,
                   "the entry of the archive at byte {} states a size that it cannot have",
                   entry.header_at);
  TURNSCAN_ASSIGN(const std::uint64_t at, data_at(file, entry));
  TURNSCAN_ASSIGN(std::string bytes, file.read(at, entry.packed_size));
  if (entry.method == 8) {
    TURNSCAN_ASSIGN(bytes, inflate(file, entry, bytes));
  }
  if (libdeflate_crc32(0, bytes.data(), bytes.size()) != entry.crc)
    return fail_at(path, ErrorCode::kFormat,
                   "the checksum of the archive's entry at byte {} is wrong; the file is damaged",
                   entry.header_at);
  return bytes;
}

}  // namespace turnscan::zip
