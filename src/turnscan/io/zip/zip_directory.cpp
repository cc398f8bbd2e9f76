#include <algorithm>
#include <array>
#include <optional>
#include <turnscan/io/zip/zip_fields.hpp>
#include <turnscan/io/zip/zip_file.hpp>

namespace turnscan::zip {

namespace {

constexpr std::uint64_t kMaxListBytes = std::uint64_t(256) << 20;
constexpr std::size_t kEndBytes = 22, kListHeaderBytes = 46, kMaxComment = 65535;

struct ListPlace {
  std::uint64_t at = 0, size = 0;
};

/// Replaces those 64-bit fields that are all ones by the values in the extra field of a header.
/// fields: in the order of the format. False if one is missing.
bool take_zip64(std::string_view extra, std::initializer_list<std::uint64_t*> fields) {
  std::size_t wanted = 0;
  for (const std::uint64_t* field : fields) wanted += *field == 0xffffffff ? 1 : 0;
  if (wanted == 0) return true;
  while (extra.size() >= 4) {
    const std::size_t size = half_at(extra, 2);
    if (extra.size() - 4 < size) return false;
    if (half_at(extra, 0) != 1) {
      extra.remove_prefix(4 + size);
      continue;
    }
    if (size < 8 * wanted) return false;
    std::size_t at = 4;
    for (std::uint64_t* field : fields) {
      if (*field != 0xffffffff) continue;
      *field = number_at(extra, at, 8);
      at += 8;
    }
    return true;
  }
  return false;
}

/// From the end record, or from its 64-bit counterpart before it.
std::optional<ListPlace> find_list(const file::RandomAccessFile& file) {
  const std::uint64_t tail_size = std::min<std::uint64_t>(file.size(), kEndBytes + kMaxComment);
  const std::uint64_t tail_at = file.size() - tail_size;
  const auto tail = file.read(tail_at, tail_size);
  if (!tail || tail->size() < kEndBytes) return std::nullopt;
  for (std::size_t at = tail->size() - kEndBytes + 1; at-- > 0;) {
    if (word_at(*tail, at) != kEnd) continue;
    ListPlace place{word_at(*tail, at + 16), word_at(*tail, at + 12)};
    if (place.at != 0xffffffff && place.size != 0xffffffff && half_at(*tail, at + 10) != 0xffff)
      return place;
    if (tail_at + at < 20) return std::nullopt;
    const auto locator = file.read(tail_at + at - 20, std::uint64_t(20));
    // All ones may also be the literal value.
    if (!locator || word_at(*locator, 0) != kEnd64Locator) return place;
    const auto end = file.read(number_at(*locator, 8, 8), std::uint64_t(56));
    if (!end || word_at(*end, 0) != kEnd64) return std::nullopt;
    return ListPlace{number_at(*end, 48, 8), number_at(*end, 40, 8)};
  }
  return std::nullopt;
}

/// Of an entry beside its name.
constexpr std::uint64_t kEntryHeld = 2 * sizeof(NamedEntry);

/// nullopt if the central directory is damaged, or the budget exceeded.
std::optional<std::vector<NamedEntry>> parse_list(std::string_view list, std::uint64_t file_size,
                                                  const file::ReadBudget& budget) {
  std::vector<NamedEntry> entries;
  while (!list.empty()) {
    if (list.size() < kListHeaderBytes || word_at(list, 0) != kListHeader) return std::nullopt;
    const std::size_t name = half_at(list, 28), extra = half_at(list, 30),
                      comment = half_at(list, 32);
    if (list.size() - kListHeaderBytes < name + extra + comment || !budget.hold(kEntryHeld + name))
      return std::nullopt;
    NamedEntry out{std::string(list.substr(kListHeaderBytes, name)), {}};
    Entry& entry = out.entry;
    entry.method = half_at(list, 10);
    entry.crc = word_at(list, 16);
    entry.packed_size = word_at(list, 20);
    entry.size = word_at(list, 24);
    entry.header_at = word_at(list, 42);
    if (!take_zip64(list.substr(kListHeaderBytes + name, extra),
                    {&entry.size, &entry.packed_size, &entry.header_at}) ||
        entry.header_at > file_size || entry.packed_size > file_size - entry.header_at)
      return std::nullopt;
    entries.push_back(std::move(out));
    list.remove_prefix(kListHeaderBytes + name + extra + comment);
  }
  return entries;
}

/// The complete entries whose local headers follow each other from the beginning. An entry whose
/// sizes are stored after its data cannot be skipped and ends the search.
Result<std::vector<NamedEntry>> walk(const file::RandomAccessFile& file,
                                     const file::ReadBudget& budget) {
  std::vector<NamedEntry> entries;
  std::uint64_t at = 0;
  while (file.size() - at >= kLocalHeaderBytes) {
    TURNSCAN_ASSIGN(const std::string header, file.read(at, std::uint64_t(kLocalHeaderBytes)));
    if (word_at(header, 0) != kLocalHeader) break;
    const std::uint64_t names = std::uint64_t(half_at(header, 26)) + half_at(header, 28);
    if (file.size() - at - kLocalHeaderBytes < names) break;
    TURNSCAN_TRY(budget.hold(kEntryHeld + names));
    TURNSCAN_ASSIGN(const std::string text, file.read(at + kLocalHeaderBytes, names));
    NamedEntry out{text.substr(0, half_at(header, 26)), {}};
    Entry& entry = out.entry;
    entry.header_at = at;
    entry.method = half_at(header, 8);
    entry.crc = word_at(header, 14);
    entry.packed_size = word_at(header, 18);
    entry.size = word_at(header, 22);
    if (!take_zip64(std::string_view(text).substr(half_at(header, 26)),
                    {&entry.size, &entry.packed_size}))
      break;
    const bool sizes_follow = (half_at(header, 6) & kSizesFollow) != 0;
    if (sizes_follow && entry.packed_size == 0) break;
    at += kLocalHeaderBytes + names;
    if (file.size() - at < entry.packed_size) break;
    at += entry.packed_size;
    entries.push_back(std::move(out));
  }
  return entries;
}

}  // namespace

Result<Directory> read_directory(const file::RandomAccessFile& file,
                                 const file::ReadBudget& budget) {
  Directory directory;
  const std::optional<ListPlace> place = find_list(file);
  if (place && place->size > kMaxListBytes && place->size <= file.size())
    return fail_at(file.path().string(), ErrorCode::kResourceLimit,
                   "the list of the archive's entries has {} bytes; at most {} are read",
                   place->size, kMaxListBytes);
  if (place) {
    const auto list = file.read(place->at, place->size);
    auto entries = list ? parse_list(*list, file.size(), budget) : std::nullopt;
    TURNSCAN_TRY(budget.state());
    if (entries && !entries->empty()) {
      directory.entries = std::move(*entries);
      return directory;
    }
  }
  directory.cut_off = true;
  TURNSCAN_ASSIGN(directory.entries, walk(file, budget));
  if (directory.entries.empty())
    return fail_at(file.path().string(), ErrorCode::kFormat,
                   "this is no zip archive, or one that is cut off within its first entry (the "
                   "file has {} bytes)",
                   file.size());
  return directory;
}

}  // namespace turnscan::zip
