// The limits of readers: the length of a line, the number of rows, the digits of an integer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "harness/base/input_file.h"
#include "harness/files/cases.h"
#include "harness/files/ccd_queries.h"
#include "harness/files/certificates.h"
#include "harness/files/csv.h"
#include "harness/files/packed_files.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::HasSubstr;

class Limits : public ::testing::Test {
 protected:
  // A packed file of so many repetitions of a text.
  std::filesystem::path packed(const std::string& text, std::size_t times) const {
    files::ZstdWriter writer(folder.path() / "in.zst");
    std::string block;
    for (std::size_t i = 0; i < 1000; ++i) block += text;
    for (std::size_t i = 0; i < times; i += 1000) writer.write(block);
    writer.close();
    return folder.path() / "in.zst";
  }
  static std::string fault_of_lines(const std::filesystem::path& file) {
    return input_fault([&] {
      files::LineReader lines(file);
      while (lines.next()) {
      }
    });
  }
  TemporaryFolder folder;
};

TEST_F(Limits, ALineWithoutEnd) {
  const auto file = packed(std::string(1024, '\0'), base::longest_text / 1024 + 1000);
  EXPECT_LT(std::filesystem::file_size(file), 1u << 17);
  EXPECT_THAT(fault_of_lines(file), HasSubstr("in.zst:1: a line of more than 268435456 bytes"));
  EXPECT_THAT(input_fault([&] { files::read_cases(file); }), HasSubstr("a line of more than"));
}

TEST_F(Limits, RowsWithoutEnd) {
  const auto file = packed("\n", static_cast<std::size_t>(base::most_rows) + 1000);
  EXPECT_THAT(fault_of_lines(file), HasSubstr("in.zst:50000001: more lines"));
}

TEST_F(Limits, DevicesAreRefusedByEveryReader) {
  for (const std::string device : {"/dev/zero", "/dev/null"}) {
    const std::string expected = device + ": is a device; expected a regular file or a pipe";
    EXPECT_EQ(fault_of_lines(device), expected);
    EXPECT_EQ(input_fault([&] { files::read_cases(device); }), expected);
    EXPECT_EQ(input_fault([&] { files::CsvReader(device, {"x"}).read([](const auto&) {}); }),
              expected);
    EXPECT_EQ(input_fault([&] { files::read_ccd_queries(device); }), expected);
  }
}

TEST_F(Limits, IntegersOfMoreDigitsThanAnyProofHas) {
  const std::string digits(base::most_digits + 1, '7');
  const std::string proof =
      R"({"id":"x","a":{"shape":{"type":"sphere","radius":1}},"b":{"shape":{"type":"sphere",)"
      R"("radius":1}},"answer":"hit","lower":["0","1"],"upper":[")" +
      digits + R"(","1"]})";
  const auto file = folder.write("in.jsonl", proof);
  EXPECT_THAT(input_fault([&] {
                files::read_cast_certificates(
                    file, [](const files::StoredCastCertificate&, std::int64_t) {});
              }),
              HasSubstr("in.jsonl:1: upper[0]: found an integer of 100001 digits"));
  const auto queries = folder.write("in.csv", digits + ",1,0,1,0,1\n");
  EXPECT_THAT(input_fault([&] { files::read_ccd_queries(queries); }),
              HasSubstr("in.csv:1: an integer of 100001 digits"));
}

}  // namespace
}  // namespace touchstone
