// CSV: rows read by column name with exact numbers, and files that are either whole or absent.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "harness/files/output_file.h"

namespace touchstone::files {

// Reads a CSV file (RFC 4180) with a header line, through libcsv; a file whose name ends in ".zst"
// is unpacked on the way, in constant memory. Throws InputError with file and line, and without a
// line where the file cannot be read or unpacked to its end.
class CsvReader {
 public:
  // One row, valid during the callback.
  class Row {
   public:
    std::string_view text(std::size_t column) const { return (*fields_)[column]; }
    // Exact (std::from_chars). InputError has file, line, column and the text found.
    double number(std::size_t column) const;
    std::int64_t integer(std::size_t column) const;
    std::int64_t line() const { return line_; }
    std::string_view name(std::size_t column) const { return reader_->columns_[column]; }
    // True for an optional column that is not in the header.
    bool is_absent(std::size_t column) const { return (*absent_)[column] != 0; }
    [[noreturn]] void fail(const std::string& message) const;

   private:
    friend class CsvReader;
    const std::vector<std::string>* fields_ = nullptr;
    const std::vector<char>* absent_ = nullptr;  // by column
    const CsvReader* reader_ = nullptr;
    std::int64_t line_ = 0;
  };

  enum class Others : std::uint8_t { ignored, refused };

  // The columns must be in the header, in any order, except those in `optional`, which are empty if
  // the header lacks them. `others` says what becomes of further columns of the header. A row's columns are numbered in the
  // order of `columns`, followed by the optional ones that are not among them.
  CsvReader(std::filesystem::path file, std::vector<std::string> columns,
            const std::vector<std::string>& optional = {}, Others others = Others::ignored);
  // Calls `row` for each line after the header, in order. Throws InputError for a line whose number
  // of fields differs from the header's.
  void read(const std::function<void(const Row&)>& row) const;

 private:
  friend class Row;
  std::vector<std::string_view> required() const;

  std::filesystem::path file_;
  std::vector<std::string> columns_;
  std::vector<std::string> optional_;
  Others others_;
};

// Appends one field, quoted if necessary; for CSV that goes to a terminal or a pipe.
void append_csv_field(std::string& line, std::string_view text);

// Writes a CSV file as an OutputFile is written, with the same errors: it is whole or absent.
class CsvWriter {
 public:
  using Keep = OutputFile::Keep;
  using Durable = OutputFile::Durable;

  // The content to which Keep::appended_rows appends must begin with this header; an empty file
  // gets the header.
  CsvWriter(std::filesystem::path file, const std::vector<std::string>& header,
            Keep keep = Keep::whole_file);

  // Appends one field of a row. Numbers are in shortest round-trip form, NaN as an empty field.
  CsvWriter& field(std::string_view text);  // quoted if necessary
  CsvWriter& field(double value);
  CsvWriter& field(std::int64_t value);
  CsvWriter& field(int value) { return field(static_cast<std::int64_t>(value)); }
  CsvWriter& field(std::size_t value) { return field(static_cast<std::int64_t>(value)); }
  // Throws std::logic_error if the number of fields differs from the header's.
  void end_row();
  // Appends whole rows, as another CsvWriter wrote them, or the next piece of them.
  void lines(std::string_view text) { file_.write(text); }
  void flush() { file_.flush(); }  // the rows written so far survive this process
  // Size in bytes of a file of flushed or appended rows at the last flush.
  std::int64_t size() const { return file_.size(); }
  void close(Durable durable = Durable::against_power_cuts) { file_.close(durable); }

 private:
  OutputFile file_;
  std::string line_;
  std::size_t columns_ = 0, fields_ = 0;
};

}  // namespace touchstone::files
