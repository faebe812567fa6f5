#include "harness/files/csv.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>

#include "harness/base/error.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class Csv : public ::testing::Test {
 protected:
  // Lines and texts of column a and then b, or the message of the error.
  std::string read(const std::string& content) {
    const auto file = folder.write("in.csv", content);
    std::string seen;
    try {
      files::CsvReader(file, {"a", "b"}).read([&](const files::CsvReader::Row& row) {
        seen += std::to_string(row.line()) + "[" + std::string(row.text(0)) + "|" +
                std::string(row.text(1)) + "]";
      });
    } catch (const base::InputError& error) {
      return folder.without_path(error.what());
    }
    return seen;
  }
  std::string read_numbers(const std::string& content, bool integers = false) {
    const auto file = folder.write("in.csv", content);
    std::string seen;
    try {
      files::CsvReader(file, {"x"}).read([&](const files::CsvReader::Row& row) {
        std::ostringstream out;
        if (integers) {
          out << row.integer(0) << ' ';
        } else {
          out << row.number(0) << ' ';
        }
        seen += out.str();
      });
    } catch (const base::InputError& error) {
      return folder.without_path(error.what());
    }
    return seen;
  }
  std::string error_of_writing(const std::filesystem::path& file, int rows = 1) {
    try {
      files::CsvWriter writer(file, {"a", "b"});
      for (int i = 0; i < rows; ++i) writer.field(i).field("text").end_row();
      writer.close();
    } catch (const base::InputError& error) {
      return folder.without_path(error.what());
    }
    return "written";
  }
  TemporaryFolder folder;
};

TEST_F(Csv, ReadsColumnsByName) {
  EXPECT_EQ(read("a,b\n1,2\n3,4\n"), "2[1|2]3[3|4]");
  EXPECT_EQ(read("x,b,y,a\n1,2,3,4\n"), "2[4|2]");
  EXPECT_EQ(read("a,b\n"), "");
}

TEST_F(Csv, OptionalColumnsAreEmptyWhereThereAreNone) {
  const auto seen = [&](const std::string& content) {
    std::string text;
    files::CsvReader(folder.write("in.csv", content), {"b"}, {"c", "a"})
        .read([&](const files::CsvReader::Row& row) {
          text += fmt::format("[{}|{}|{}]", row.text(0), row.text(1), row.text(2));
        });
    return text;
  };
  EXPECT_EQ(seen("a,b\n1,2\n3,4\n"), "[2||1][4||3]");
  EXPECT_EQ(seen("b\n2\n"), "[2||]");
  EXPECT_EQ(seen("a,b,c\n1,2,3\n"), "[2|3|1]");
  EXPECT_THAT(input_fault([&] { seen("a,c\n1,2\n"); }),
              ::testing::EndsWith("no column 'b'; expected a header line with the columns b"));
  EXPECT_THAT(input_fault([&] { seen("b,c,c\n1,2,3\n"); }),
              ::testing::EndsWith("column 'c' comes twice"));
  const files::CsvReader all_optional(folder.write("none.csv", ""), {}, {"a", "b"});
  EXPECT_THAT(input_fault([&] { all_optional.read([](const files::CsvReader::Row&) {}); }),
              ::testing::EndsWith("expected a header line with some of a,b"));
}

TEST_F(Csv, ReadsWhatTheFormatAllows) {
  EXPECT_EQ(read("a,b\r\n1,2\r\n3,4"), "2[1|2]3[3|4]");
  EXPECT_EQ(read("\xef\xbb\xbf"
                 "a,b\n1,2\n"),
            "2[1|2]");
  EXPECT_EQ(read("a,b\n\"x,\"\"y\"\"\",\"two\nlines\"\n\n5,6\n"), "2[x,\"y\"|two\nlines]5[5|6]");
  EXPECT_EQ(read("\n\na,b\n  \n ,\n 1 , 2 \n"), "5[|]6[1|2]");
  EXPECT_EQ(read("\"a\",\"b\"\n\"\",\" keep \"\n"), "2[| keep ]");
}

TEST_F(Csv, BadFilesAreToldWithTheirLine) {
  EXPECT_THAT(read(""), StartsWith("in.csv:1: an empty file; expected a header"));
  EXPECT_THAT(read("\n \n"), StartsWith("in.csv:1: an empty file"));
  EXPECT_THAT(read("1,2\n3,4\n"), StartsWith("in.csv:1: no column 'a'; expected a header"));
  EXPECT_THAT(read("a,c\n"), StartsWith("in.csv:1: no column 'b'"));
  EXPECT_THAT(read("a,b,a\n"), StartsWith("in.csv:1: column 'a' comes twice"));
  EXPECT_EQ(read("a,b\n1,2\n3\n"), "in.csv:3: 1 fields; expected 2, as in the header");
  EXPECT_EQ(read("a,b\n1,2,3\n"), "in.csv:2: 3 fields; expected 2, as in the header");
  EXPECT_EQ(read("a,b\n1,2,\n"), "in.csv:2: 3 fields; expected 2, as in the header");
  EXPECT_EQ(read("a,b\n\"1\n\n2\",3,4\n"), "in.csv:2: 3 fields; expected 2, as in the header");
  EXPECT_THAT(read("a,b\n1,x\"y\n"), StartsWith("in.csv:2: a quotation mark out of place"));
  EXPECT_THAT(read("a,b\n1,\"x\"y\n"), StartsWith("in.csv:2: a quotation mark out of place"));
  EXPECT_THAT(read("a,b\n1,2\n3,\"4\n5,6\n"),
              StartsWith("in.csv:3: a quoted field that does not end"));
  EXPECT_EQ(read(std::string("a,b\n1,\0\n", 8)), "in.csv:2: a NUL byte; expected text");
  EXPECT_THAT(read("a,b\r1,2\r"), StartsWith("in.csv:1: a carriage return inside the line"));
}

TEST_F(Csv, FilesThatCannotBeRead) {
  const auto error = [&](const std::filesystem::path& file) -> std::string {
    try {
      files::CsvReader(file, {"a"}).read([](const files::CsvReader::Row&) {});
    } catch (const base::InputError& e) {
      return folder.without_path(e.what());
    }
    return "read";
  };
  EXPECT_EQ(error(folder.path() / "none.csv"), "none.csv: No such file or directory");
  EXPECT_THAT(error(folder.path()), HasSubstr("Is a directory"));
}

TEST_F(Csv, Numbers) {
  EXPECT_EQ(read_numbers("x\n1\n-2.5\n1e3\n 7 \n\"8\"\n"), "1 -2.5 1000 7 8 ");
  EXPECT_EQ(read_numbers("x\n-9223372036854775808\n", true), "-9223372036854775808 ");
  EXPECT_EQ(read_numbers("x\nten\n"), "in.csv:2: column x: found 'ten'; expected a number");
  EXPECT_EQ(read_numbers("x\n1\n2m\n"), "in.csv:3: column x: found '2m'; expected a number");
  EXPECT_EQ(read_numbers("x\n" + std::string(1000, '\xff') + "\n"),
            "in.csv:2: column x: found '" + std::string(80, '?') + "...'; expected a number");
  EXPECT_EQ(read_numbers("x\n\"\"\n"), "in.csv:2: column x: found ''; expected a number");
  EXPECT_THAT(read_numbers("x\n1e999\n"), StartsWith("in.csv:2: column x: 1e999 is out of range"));
  EXPECT_EQ(read_numbers("x\n1.5\n", true), "in.csv:2: column x: found '1.5'; expected an integer");
  EXPECT_THAT(read_numbers("x\n9223372036854775808\n", true), HasSubstr("out of range"));
}

TEST_F(Csv, EveryDoubleComesBack) {
  std::vector<double> values = {0.0,
                                -0.0,
                                0.1,
                                1e300,
                                5e-324,
                                2.2250738585072014e-308,
                                std::numeric_limits<double>::max(),
                                std::numeric_limits<double>::infinity(),
                                1e15,
                                1e16,
                                123456789};
  std::mt19937_64 random(7);
  while (values.size() < 20000) {
    const double value = std::bit_cast<double>(random());
    if (!std::isnan(value)) values.push_back(value);
  }
  const auto file = folder.path() / "doubles.csv";
  files::CsvWriter writer(file, {"n", "x"});
  for (std::size_t i = 0; i < values.size(); ++i) writer.field(i).field(values[i]).end_row();
  writer.close();
  std::size_t next = 0;
  files::CsvReader(file, {"x", "n"}).read([&](const files::CsvReader::Row& row) {
    ASSERT_EQ(row.integer(1), static_cast<std::int64_t>(next));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(row.number(0)),
              std::bit_cast<std::uint64_t>(values[next]));
    ++next;
  });
  EXPECT_EQ(next, values.size());
}

TEST_F(Csv, WritesShortestNumbersAndQuotesWhatNeedsIt) {
  const auto file = folder.path() / "out.csv";
  files::CsvWriter writer(file, {"a", "b, c"});
  writer.field(0.1).field(std::nan("")).end_row();
  writer.field(-3).field("say \"x\"\ny").end_row();
  writer.field(" edge").field("").end_row();
  writer.close();
  EXPECT_EQ(folder.read("out.csv"), "a,\"b, c\"\n0.1,\n-3,\"say \"\"x\"\"\ny\"\n\" edge\",\n");
}

TEST_F(Csv, WholeOrNotThere) {
  folder.write("out.csv", "old");
  {
    files::CsvWriter writer(folder.path() / "out.csv", {"a"});
    writer.field(1).end_row();
    writer.flush();
    EXPECT_EQ(folder.read("out.csv"), "old");
  }
  EXPECT_EQ(folder.read("out.csv"), "old");
  EXPECT_THAT(folder.names(), ElementsAre("out.csv"));
  {
    files::CsvWriter first(folder.path() / "out.csv", {"a"});
    files::CsvWriter second(folder.path() / "out.csv", {"b"});
    first.close();
    second.close();
  }
  EXPECT_EQ(folder.read("out.csv"), "b\n");
  EXPECT_THAT(folder.names(), ElementsAre("out.csv"));
}

TEST_F(Csv, RowsOfAnotherWidthAreAFaultOfTheProgram) {
  files::CsvWriter writer(folder.path() / "out.csv", {"a", "b"});
  writer.field(1);
  EXPECT_THROW(writer.end_row(), std::logic_error);
}

TEST_F(Csv, FailuresToWrite) {
  EXPECT_EQ(error_of_writing(folder.path() / "none" / "out.csv"),
            "none/out.csv: cannot be written: No such file or directory");
  std::filesystem::create_directory(folder.path() / "taken");
  EXPECT_EQ(error_of_writing(folder.path() / "taken"), "taken: cannot be written: Is a directory");
  EXPECT_EQ(error_of_writing(""), "the output's name is empty; expected a file");
  folder.write("file", "");
  EXPECT_EQ(error_of_writing(folder.path() / "file" / "out.csv"),
            "file/out.csv: cannot be written: Not a directory");
  std::filesystem::remove(folder.path() / "file");
  std::filesystem::remove(folder.path() / "taken");
  for (const int rows : {1, 100000}) {  // the last flush fails, or a row on the way
    EXPECT_EQ(error_of_writing("/dev/full", rows),
              "/dev/full: cannot be written: No space left on device");
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_F(Csv, DevicesStayDevices) {
  EXPECT_EQ(error_of_writing("/dev/null"), "written");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST_F(Csv, ALinkIsFollowed) {
  folder.write("target.csv", "old");
  std::filesystem::create_symlink("target.csv", folder.path() / "link.csv");
  EXPECT_EQ(error_of_writing(folder.path() / "link.csv"), "written");
  EXPECT_EQ(folder.read("target.csv"), "a,b\n0,text\n");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() / "link.csv"));
}

TEST_F(Csv, CheckOutputLeavesNothing) {
  files::check_output(folder.path() / "out.csv");
  EXPECT_THAT(folder.names(), IsEmpty());
  EXPECT_THROW(files::check_output(folder.path() / "none" / "out.csv"), base::InputError);
  EXPECT_THROW(files::check_output(folder.path()), base::InputError);
}

// A kill at any moment leaves nothing where no name is made.
TEST_F(Csv, CheckOutputMakesNoNameWhereThatIsPossible) {
  const int nameless = open(folder.path().c_str(), O_TMPFILE | O_WRONLY, 0600);
  if (nameless < 0) GTEST_SKIP() << "the file system has no files without names";
  close(nameless);
  const auto before = std::filesystem::file_time_type{} + std::chrono::seconds(1);
  std::filesystem::last_write_time(folder.path(), before);
  files::check_output(folder.path() / "out.csv");
  EXPECT_EQ(std::filesystem::last_write_time(folder.path()), before);
}

TEST_F(Csv, AWriterThatKeepsRowsLeavesThoseThatWereFlushed) {
  const auto file = folder.path() / "raw.csv";
  {
    files::CsvWriter writer(file, {"a"}, files::CsvWriter::Keep::flushed_rows);
    writer.field(1).end_row();
    writer.flush();
    EXPECT_EQ(folder.read("raw.csv"), "a\n1\n");
    for (int i = 0; i < 1'000'000; ++i) writer.field(2).end_row();
    writer.field("half a row");
  }
  EXPECT_EQ(folder.read("raw.csv"), "a\n1\n");
  files::CsvWriter again(file, {"b"}, files::CsvWriter::Keep::flushed_rows);
  again.close();
  EXPECT_EQ(folder.read("raw.csv"), "b\n");
}

}  // namespace
}  // namespace touchstone
