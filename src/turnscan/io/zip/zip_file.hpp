#pragma once
// Zip archives, read part by part: stored and deflated entries, zip64, one volume, not encrypted.
// After PKWARE's APPNOTE.TXT 6.3.10. A reader of our own, because libzip and minizip keep one
// position for all threads, give up where the list at the end is missing (a download or a copy that
// was cut off), and unpack through zlib, three times as slow as libdeflate.

#include <cstdint>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/random_access_file.hpp>
#include <vector>

namespace turnscan::zip {

/// Where an entry lies.
struct Entry {
  std::uint64_t header_at = 0;  ///< of its local header
  std::uint64_t packed_size = 0;
  std::uint64_t size = 0;
  std::uint32_t crc = 0;
  std::uint16_t method = 0;  ///< 0 stored, 8 deflated
};

struct NamedEntry {
  std::string name;
  Entry entry;
};

struct Directory {
  std::vector<NamedEntry> entries;  ///< in the order of the list
  /// The list at the end of the file is missing or damaged: the entries are those whose headers and
  /// data were found one after another from the beginning.
  bool cut_off = false;
};

/// Fails with kFormat where no entry is found, and with kResourceLimit for a list beyond 256 MB.
Result<Directory> read_directory(const file::RandomAccessFile& file);

/// The entry's content. Fails with kResourceLimit when it is larger than max_bytes, kUnsupported
/// for another method than 0 and 8 or an encrypted entry, and with kFormat where it is damaged: its
/// checksum is compared.
Result<std::string> read_entry(const file::RandomAccessFile& file, const Entry& entry,
                               std::uint64_t max_bytes);

}  // namespace turnscan::zip
