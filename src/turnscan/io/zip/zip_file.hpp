#pragma once
// Random-access reader for zip archives: stored and deflated entries, zip64, one volume, not
// encrypted. Follows PKWARE's APPNOTE.TXT 6.3.10. It replaces libzip and minizip because they share
// one position between all threads, give up if the central directory is missing (a truncated
// download or copy), and unpack through zlib, three times as slow as libdeflate.

#include <cstdint>
#include <string>
#include <turnscan/core/result.hpp>
#include <turnscan/io/file/random_access_file.hpp>
#include <turnscan/io/file/read_budget.hpp>
#include <vector>

namespace turnscan::zip {

/// Position and size of an entry.
struct Entry {
  std::uint64_t header_at = 0;  ///< offset of its local header
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
  std::vector<NamedEntry> entries;  ///< in the order of the central directory
  /// The central directory is missing or damaged: the entries are those whose headers and data were
  /// found sequentially from the beginning.
  bool cut_off = false;
};

/// Fails with kFormat if no entry is found, with kResourceLimit for a central directory beyond
/// 256 MB or entries beyond the budget, and with kCancelled.
Result<Directory> read_directory(const file::RandomAccessFile& file,
                                 const file::ReadBudget& budget);

/// The entry's content. Fails with kResourceLimit if it is larger than max_bytes, kUnsupported for
/// methods other than 0 and 8 or an encrypted entry, and with kFormat if it is damaged: its
/// checksum is verified.
Result<std::string> read_entry(const file::RandomAccessFile& file, const Entry& entry,
                               std::uint64_t max_bytes);

}  // namespace turnscan::zip
