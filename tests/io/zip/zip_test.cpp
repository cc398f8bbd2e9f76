// Archives in ../import/data were written by Python's zipfile: stored, deflated and one entry with
// zip64 fields.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <turnscan/io/zip/zip_file.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan::zip {
namespace {

using testing::TempFolder;

std::string archive() {
  return testing::content_of(std::filesystem::path(TURNSCAN_IO_TESTS) / "import/data/still.r3d");
}

file::RandomAccessFile opened(const std::filesystem::path& path) {
  auto file = file::RandomAccessFile::open(path);
  EXPECT_TRUE(file) << file.error().text();
  return file ? std::move(*file) : throw std::runtime_error("not opened");
}

Entry entry_of(const Directory& directory, std::string_view name) {
  const auto at = std::find_if(directory.entries.begin(), directory.entries.end(),
                               [&](const NamedEntry& e) { return e.name == name; });
  EXPECT_NE(at, directory.entries.end()) << name;
  return at == directory.entries.end() ? Entry{} : at->entry;
}

TEST(ZipFile, ReadsWhatPythonWrote) {
  const TempFolder folder;
  const auto file = opened(folder.put("a.zip", archive()));
  const auto directory = read_directory(file, file::ReadBudget(file.size()));
  ASSERT_TRUE(directory) << directory.error().text();
  EXPECT_FALSE(directory->cut_off);
  EXPECT_EQ(directory->entries.size(), 17u);
  EXPECT_EQ(entry_of(*directory, "rgbd/1.depth").method, 8);
  for (const NamedEntry& entry : directory->entries) {
    const auto bytes = read_entry(file, entry.entry, 1 << 20);
    ASSERT_TRUE(bytes) << entry.name << ": " << bytes.error().text();
    EXPECT_EQ(bytes->size(), entry.entry.size);
  }
  EXPECT_EQ(read_entry(file, entry_of(*directory, "metadata"), 1 << 20)->substr(0, 5), "{\"h\":");
  const auto limited = read_entry(file, entry_of(*directory, "metadata"), 10);
  ASSERT_FALSE(limited);
  EXPECT_EQ(limited.error().code, ErrorCode::kResourceLimit);
}

TEST(ZipFile, WithoutItsListGivesTheEntriesThatAreWhole) {
  const TempFolder folder;
  const std::string bytes = archive();
  const auto whole =
      read_directory(opened(folder.put("whole.zip", bytes)), file::ReadBudget(bytes.size()));
  const Entry third = entry_of(*whole, "rgbd/3.jpg");
  const auto file = opened(folder.put("cut.zip", bytes.substr(0, third.header_at + 50)));
  const auto directory = read_directory(file, file::ReadBudget(file.size()));
  ASSERT_TRUE(directory) << directory.error().text();
  EXPECT_TRUE(directory->cut_off);
  EXPECT_EQ(directory->entries.size(), 10u);
  for (const NamedEntry& entry : directory->entries)
    EXPECT_TRUE(read_entry(file, entry.entry, 1 << 20)) << entry.name;
}

TEST(ZipFile, ADamagedEntryIsToldByItsChecksum) {
  const TempFolder folder;
  std::string bytes = archive();
  const auto whole =
      read_directory(opened(folder.put("whole.zip", bytes)), file::ReadBudget(bytes.size()));
  const Entry entry = entry_of(*whole, "rgbd/0.depth");
  bytes[entry.header_at + 30 + 12 + entry.packed_size / 2] ^= 4;
  const auto content = read_entry(opened(folder.put("damaged.zip", bytes)), entry, 1 << 20);
  ASSERT_FALSE(content);
  EXPECT_EQ(content.error().code, ErrorCode::kFormat);
  EXPECT_NE(content.error().path.find("damaged.zip"), std::string::npos);
}

TEST(ZipFile, NoArchiveIsRefused) {
  const TempFolder folder;
  for (const std::string& bytes : {std::string(), std::string("PK\3\4"), std::string(100, 'x')})
    EXPECT_FALSE(
        read_directory(opened(folder.put("no.zip", bytes)), file::ReadBudget(bytes.size())));
}

}  // namespace
}  // namespace turnscan::zip
