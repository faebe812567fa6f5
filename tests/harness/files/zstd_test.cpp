// Tests of files that zstd packs: their writer, and CSV that is read from them.
#include "harness/files/packed_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <random>
#include <span>
#include <string>

#include "harness/base/error.h"
#include "harness/files/csv.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class Zstd : public ::testing::Test {
 protected:
  // Writes the content in pieces of this size, and returns the bytes of the file.
  std::string packed(const std::string& content, std::size_t piece = 1 << 16) const {
    files::ZstdWriter writer(folder.path() / "packed.zst");
    for (std::size_t at = 0; at < content.size(); at += piece) {
      writer.write(std::string_view(content).substr(at, piece));
    }
    writer.close();
    return folder.read("packed.zst");
  }
  std::string unpacked(const std::string& bytes, std::size_t piece) const {
    files::ByteReader reader(folder.write("bytes.zst", bytes));
    std::string content;
    std::string buffer(piece, '\0');
    while (const std::size_t got = reader.read(std::span(buffer))) content.append(buffer, 0, got);
    return content;
  }
  // Lines and texts of column a, or the message of the error; of raw.csv.zst with these bytes.
  std::string read(const std::string& bytes) const {
    const auto file = folder.write("raw.csv.zst", bytes);
    std::string seen;
    const std::string fault = input_fault([&] {
      files::CsvReader(file, {"a"}).read([&](const files::CsvReader::Row& row) {
        seen += fmt::format("{}[{}]", row.line(), row.text(0));
      });
    });
    return fault.empty() ? seen : folder.without_path(fault);
  }
  // A header and as many rows, of numbers that hardly become shorter.
  static std::string table(int rows) {
    std::string text = "a,b\n";
    std::mt19937_64 random(3);
    for (int i = 0; i < rows; ++i) text += fmt::format("{},{}\n", i, random());
    return text;
  }
  TemporaryFolder folder;
};

TEST_F(Zstd, WhatIsWrittenComesBack) {
  const std::string content = table(40'000);
  for (const std::size_t piece : {std::size_t{7}, std::size_t{1} << 24}) {
    const std::string bytes = packed(content, piece);
    EXPECT_LT(bytes.size(), content.size() / 2 + 200'000);
    EXPECT_TRUE(unpacked(bytes, 1 << 20) == content) << piece;
    EXPECT_TRUE(unpacked(bytes, 13) == content) << piece;
  }
  EXPECT_EQ(unpacked(packed(""), 10), "");
  // Frames are many times as long as the buffers of the reader where they are packed well.
  const std::string zeros(50'000'000, '0');
  EXPECT_TRUE(unpacked(packed(zeros), 100'001) == zeros);
}

TEST_F(Zstd, RowsAreReadAsFromThePlainFile) {
  const std::string content = table(40'000);
  std::string numbers;
  files::CsvReader(folder.write("plain.csv", content), {"a"})
      .read([&](const files::CsvReader::Row& row) {
        numbers += fmt::format("{}[{}]", row.line(), row.text(0));
      });
  EXPECT_TRUE(read(packed(content)) == numbers);
  EXPECT_THAT(numbers, testing::EndsWith("40001[39999]"));
}

TEST_F(Zstd, FramesOneBehindTheOtherAreOneFile) {
  // The line in the middle begins in one frame and ends in the next.
  EXPECT_EQ(read(packed("a,b\n1,2\n34") + packed("") + packed("5,6\n7,8")), "2[1]3[345]4[7]");
  // A frame that zstd's own tools skip: its magic number, its length, its content.
  const std::string skipped("\x50\x2a\x4d\x18\x03\x00\x00\x00xyz", 11);
  EXPECT_EQ(read(skipped + packed("a\n1\n") + skipped + packed("2\n")), "2[1]3[2]");
}

TEST_F(Zstd, ErrorsHaveTheLine) {
  std::string content = table(30'000);
  content += "30000,1,2\n";
  content += table(30'000);
  EXPECT_EQ(read(packed(content)), "raw.csv.zst:30002: 3 fields; expected 2, as in the header");
  EXPECT_EQ(read(packed("b\n1\n")),
            "raw.csv.zst:1: no column 'a'; expected a header line with the columns a");
  EXPECT_THAT(read(packed("")), StartsWith("raw.csv.zst:1: an empty file; expected a header"));
  EXPECT_EQ(input_fault([&] {
              files::CsvReader(folder.path() / "none.zst", {"a"}).read([](const auto&) {});
            }),
            (folder.path() / "none.zst").string() + ": No such file or directory");
}

TEST_F(Zstd, AFileThatWasCutIsTold) {
  const std::string two = packed("a,b\n1,2\n") + packed(table(30'000).substr(4));
  const std::size_t first = packed("a,b\n1,2\n").size();
  // In the header of a frame, in its blocks, and in its checksum.
  for (const std::size_t size : {first + 2, first + 5, two.size() / 2, two.size() - 1}) {
    EXPECT_EQ(read(two.substr(0, size)),
              "raw.csv.zst: ends in the middle of a zstd frame, so it was cut; expected the whole "
              "file")
        << size;
  }
  EXPECT_EQ(read(two.substr(0, first)), "2[1]");
}

TEST_F(Zstd, WhatIsNoZstdIsTold) {
  EXPECT_EQ(read("a,b\n1,2\n"),
            "raw.csv.zst: is no zstd, or goes on with something else; expected zstd frames alone");
  EXPECT_THAT(read(packed("a\n1\n") + "2,3 and more\n"), StartsWith("raw.csv.zst: is no zstd, or"));
  EXPECT_EQ(read(""), "raw.csv.zst: an empty file; expected one that zstd packed");
}

TEST_F(Zstd, DamageIsFoundByTheChecksum) {
  std::string bytes = packed(table(30'000));
  bytes.back() = static_cast<char>(bytes.back() ^ 1);
  EXPECT_THAT(read(bytes), StartsWith("raw.csv.zst: cannot be unpacked: "));
}

TEST_F(Zstd, AWriterLeavesAWholeFileOrNone) {
  folder.write("out.zst", "old");
  {
    files::ZstdWriter writer(folder.path() / "out.zst");
    writer.write(table(100'000));
  }
  EXPECT_EQ(folder.read("out.zst"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("out.zst"));
  files::ZstdWriter writer(folder.path() / "out.zst", 19);
  writer.write("new");
  writer.close();
  EXPECT_EQ(unpacked(folder.read("out.zst"), 100), "new");
}

TEST_F(Zstd, FailuresToWrite) {
  EXPECT_THAT(input_fault([&] { files::ZstdWriter(folder.path() / "none" / "out.zst"); }),
              HasSubstr("out.zst: cannot be written: No such file or directory"));
  for (const int rows : {1, 100'000}) {  // the end fails, or a block on the way
    EXPECT_EQ(input_fault([&] {
                files::ZstdWriter writer("/dev/full");
                writer.write(table(rows));
                writer.close();
              }),
              "/dev/full: cannot be written: No space left on device");
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_F(Zstd, ThePlainFileComesFirst) {
  const std::filesystem::path csv = folder.path() / "raw.csv";
  const std::filesystem::path zst = folder.path() / "raw.csv.zst";
  EXPECT_EQ(files::row_file(csv), csv);
  folder.write("raw.csv.zst", "");
  EXPECT_EQ(files::row_file(csv), zst);
  EXPECT_EQ(files::row_file(zst), zst);
  folder.write("raw.csv", "");
  EXPECT_EQ(files::row_file(csv), csv);
}

TEST_F(Zstd, LongLinesAreRead) {
  const std::string field(300'000, 'x');
  EXPECT_TRUE(read(packed("a\n" + field + "\n2")) == "2[" + field + "]3[2]");
}

}  // namespace
}  // namespace touchstone
