// CSV: rows read by column name with exact numbers, and files that are whole or not there.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone {

// Reads a CSV file (RFC 4180) with a header line, through libcsv. Throws InputError with file and
// line.
class CsvReader {
 public:
  // One row, valid during the callback.
  class Row {
   public:
    std::string_view text(std::size_t column) const { return (*fields_)[column]; }
    // Exact (std::from_chars). InputError names file, line, column and what was found.
    double number(std::size_t column) const;
    std::int64_t integer(std::size_t column) const;
    std::int64_t line() const { return line_; }
    std::string_view name(std::size_t column) const { return reader_->columns_[column]; }
    // True for an optional column that the header lacks.
    bool is_absent(std::size_t column) const { return (*absent_)[column] != 0; }
    [[noreturn]] void fail(const std::string& message) const;

   private:
    friend class CsvReader;
    const std::vector<std::string>* fields_ = nullptr;
    const std::vector<char>* absent_ = nullptr;  // by column
    const CsvReader* reader_ = nullptr;
    std::int64_t line_ = 0;
  };

  // The columns must be in the header, in any order, except those that `optional` names: they are
  // empty where the header lacks them. The header may have others. A row's columns are numbered in
  // the order of `columns`, then of the optional ones that are not among them.
  CsvReader(std::filesystem::path file, std::vector<std::string> columns,
            const std::vector<std::string>& optional = {});
  // Calls row for each line behind the header, in order. A line with another number of fields than
  // the header is an InputError.
  void read(const std::function<void(const Row&)>& row) const;

 private:
  friend class Row;
  std::vector<std::string_view> required() const;

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<std::string> optional_;
};

// Appends one field, quoted where it has to be: what goes to a terminal or a pipe as CSV.
void append_csv_field(std::string& line, std::string_view text);

// Throws what CsvWriter's constructor would, and leaves nothing behind: asked before long work.
void check_output(const std::filesystem::path& file);

// Writes a CSV file under a temporary name beside it and renames it when `close` is called: readers
// see a whole file or none. Without close (an exception on the way) nothing is left behind. Every
// failure to write, such as a full disk, is an InputError with the file's name. A device or a pipe
// is written as it is.
class CsvWriter {
 public:
  // What is there when the work does not come to its end: nothing, or every row that was flushed.
  enum class Keep : std::uint8_t { whole_file, flushed_rows, appended_rows };

  // With Keep::flushed_rows the file itself is written, whatever it held before; after a failure it
  // is cut back to the last flush. Keep::appended_rows is the same behind what the file holds,
  // which is trusted to begin with this header; the header is written where it holds nothing.
  CsvWriter(std::filesystem::path file, const std::vector<std::string>& header,
            Keep keep = Keep::whole_file);
  ~CsvWriter();
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;

  // Fields of one row in order; numbers in shortest round-trip form, NaN as an empty field.
  CsvWriter& field(std::string_view text);  // quoted where it has to be
  CsvWriter& field(double value);
  CsvWriter& field(std::int64_t value);
  CsvWriter& field(int value) { return field(static_cast<std::int64_t>(value)); }
  CsvWriter& field(std::size_t value) { return field(static_cast<std::int64_t>(value)); }
  // Throws std::logic_error when the row has another number of fields than the header.
  void end_row();
  void flush();  // what was written survives this process
  // Bytes of a file of flushed or appended rows, as the last flush left it.
  std::int64_t size() const { return flushed_; }
  // What the renamed file survives: the end of this process, or of the machine too.
  enum class Durable : std::uint8_t { against_kills, against_power_cuts };
  void close(Durable durable = Durable::against_power_cuts);

 private:
  void discard();
  [[noreturn]] void fail();  // with errno

  std::filesystem::path file_, temporary_;  // no temporary: `file` itself is written
  std::FILE* stream_ = nullptr;
  std::string line_;
  std::size_t columns_ = 0, fields_ = 0;
  off_t flushed_ = -1;  // bytes that a failure leaves; -1: it leaves no file
};

}  // namespace touchstone
