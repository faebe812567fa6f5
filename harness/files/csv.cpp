// Reads CSV through libcsv, and writes CSV files that are whole or absent.
#include "harness/files/csv.h"

#include <csv.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <new>
#include <optional>
#include <span>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/packed_files.h"

namespace touchstone::files {
namespace {

// Parses the whole of `text` as a number, or throws the reason why it is none.
template <class Number>
Number parse(const CsvReader::Row& row, std::string_view name, std::string_view text,
             std::string_view expected) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::result_out_of_range) {
    row.fail(fmt::format("column {}: {} is out of range; expected {}", name, base::shortened(text),
                         expected));
  }
  if (error != std::errc{} || stop != end) {
    row.fail(
        fmt::format("column {}: found '{}'; expected {}", name, base::shortened(text), expected));
  }
  return value;
}

// Fields of one row, as libcsv delivers them. The strings keep their memory between rows.
struct Fields {
  std::vector<std::string> text;
  std::size_t count = 0;
  int rows = 0;  // ends of rows in the last line that was parsed

  static void on_field(void* bytes, std::size_t size, void* self) noexcept {
    Fields& fields = *static_cast<Fields*>(self);
    if (fields.count == fields.text.size()) fields.text.emplace_back();
    fields.text[fields.count++].assign(static_cast<const char*>(bytes), size);
  }
  static void on_row(int, void* self) noexcept { ++static_cast<Fields*>(self)->rows; }
};

struct Parser {
  csv_parser state;
  Parser() {
    if (csv_init(&state, CSV_STRICT | CSV_STRICT_FINI) != 0) throw std::bad_alloc();
  }
  ~Parser() { csv_free(&state); }
  Parser(const Parser&) = delete;
  Parser& operator=(const Parser&) = delete;
};

// Calls `row` for the header and each row, with the line that it starts on and its fields. Lines
// are parsed one by one, so that the callbacks of libcsv, a C library, never throw.
void for_each_row(const std::string& file,
                  const std::function<void(std::int64_t, std::span<const std::string>)>& row) {
  LineReader lines(file);
  Parser parser;
  Fields fields;
  std::int64_t number = 0;
  std::int64_t start = 0;  // first line of the open row; 0: no row is open
  const auto end_of_row = [&] {
    if (fields.rows > 1) {
      throw base::InputError(file, number,
                             "a carriage return inside the line; expected LF or CRLF ends");
    }
    row(start, {fields.text.data(), fields.count});
    fields.count = 0;
    fields.rows = 0;
    start = 0;
  };
  while (const std::optional<std::string_view> line = lines.next()) {
    ++number;
    const std::string_view text = number == 1 ? base::without_byte_order_mark(*line) : *line;
    if (text.find('\0') != std::string_view::npos) {
      throw base::InputError(file, number, "a NUL byte; expected text");
    }
    if (start == 0) {
      if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) continue;
      start = number;
    }
    if (csv_parse(&parser.state, text.data(), text.size(), &Fields::on_field, &Fields::on_row,
                  &fields) != text.size()) {
      if (csv_error(&parser.state) == CSV_ENOMEM) throw std::bad_alloc();
      throw base::InputError(file, number,
                             "a quotation mark out of place; expected it around a whole field, and "
                             "doubled inside one");
    }
    if (fields.rows > 0) end_of_row();
  }
  if (start != 0) {
    if (csv_fini(&parser.state, &Fields::on_field, &Fields::on_row, &fields) != 0) {
      throw base::InputError(file, start, "a quoted field that does not end");
    }
    end_of_row();
  }
}

}  // namespace

double CsvReader::Row::number(std::size_t column) const {
  return parse<double>(*this, reader_->columns_[column], text(column), "a number");
}

std::int64_t CsvReader::Row::integer(std::size_t column) const {
  return parse<std::int64_t>(*this, reader_->columns_[column], text(column), "an integer");
}

void CsvReader::Row::fail(const std::string& message) const {
  throw base::InputError(reader_->file_.string(), line_, message);
}

CsvReader::CsvReader(std::filesystem::path file, std::vector<std::string> columns,
                     const std::vector<std::string>& optional, Others others)
    : file_(std::move(file)), columns_(std::move(columns)), optional_(optional), others_(others) {
  for (const std::string& name : optional_) {
    if (std::ranges::find(columns_, name) == columns_.end()) columns_.push_back(name);
  }
}

std::vector<std::string_view> CsvReader::required() const {
  std::vector<std::string_view> names;
  for (const std::string& name : columns_) {
    if (std::ranges::find(optional_, name) == optional_.end()) names.push_back(name);
  }
  return names;
}

void CsvReader::read(const std::function<void(const Row&)>& row) const {
  const std::string file = file_.string();
  constexpr std::size_t nowhere = static_cast<std::size_t>(-1);
  std::vector<std::size_t> place;  // index of each of our columns in the file
  std::size_t width = 0;
  std::vector<std::string> wanted(columns_.size());
  Row current;
  std::vector<char> absent(columns_.size(), 0);
  current.fields_ = &wanted;
  current.absent_ = &absent;
  current.reader_ = this;
  const auto read_header = [&](std::int64_t line, std::span<const std::string> header) {
    width = header.size();
    for (const std::string& column : header) {
      if (others_ == Others::ignored || std::ranges::find(columns_, column) != columns_.end()) {
        continue;
      }
      throw base::InputError(file, line,
                             fmt::format("column '{}'; expected none but {}",
                                         base::shortened(column), fmt::join(columns_, ",")));
    }
    for (const std::string& column : columns_) {
      const auto at = std::ranges::find(header, column);
      if (at == header.end()) {
        if (std::ranges::find(optional_, column) != optional_.end()) {
          absent[place.size()] = 1;
          place.push_back(nowhere);
          continue;
        }
        throw base::InputError(
            file, line,
            fmt::format("no column '{}'; expected a header line with the columns {}", column,
                        fmt::join(required(), ",")));
      }
      if (std::find(at + 1, header.end(), column) != header.end()) {
        throw base::InputError(file, line, fmt::format("column '{}' comes twice", column));
      }
      place.push_back(static_cast<std::size_t>(at - header.begin()));
    }
  };
  for_each_row(file, [&](std::int64_t line, std::span<const std::string> fields) {
    if (width == 0) return read_header(line, fields);
    if (fields.size() != width) {
      throw base::InputError(
          file, line,
          fmt::format("{} fields; expected {}, as in the header", fields.size(), width));
    }
    for (std::size_t i = 0; i < place.size(); ++i) {
      if (place[i] != nowhere) wanted[i] = fields[place[i]];
    }
    current.line_ = line;
    row(current);
  });
  if (width == 0) {
    throw base::InputError(
        file, 1,
        required().empty()
            ? fmt::format("an empty file; expected a header line with some of {}",
                          fmt::join(columns_, ","))
            : fmt::format("an empty file; expected a header line with the columns {}",
                          fmt::join(required(), ",")));
  }
}

void append_csv_field(std::string& line, std::string_view text) {
  const bool plain = text.find_first_of(",\"\r\n") == std::string_view::npos &&
                     (text.empty() || (text.front() != ' ' && text.front() != '\t' &&
                                       text.back() != ' ' && text.back() != '\t'));
  if (plain) {
    line += text;
    return;
  }
  line += '"';
  for (const char c : text) {
    if (c == '"') line += '"';
    line += c;
  }
  line += '"';
}

CsvWriter::CsvWriter(std::filesystem::path file, const std::vector<std::string>& header, Keep keep)
    : file_(std::move(file), keep), columns_(header.size()) {
  if (file_.size() > 0) return;
  for (const std::string& name : header) field(name);
  if (!header.empty()) end_row();
}

CsvWriter& CsvWriter::field(std::string_view text) {
  if (fields_++ > 0) line_ += ',';
  append_csv_field(line_, text);
  return *this;
}

CsvWriter& CsvWriter::field(double value) {
  std::array<char, 32> text;
  if (std::isnan(value)) return field(std::string_view());
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return field(std::string_view(text.data(), end));
}

CsvWriter& CsvWriter::field(std::int64_t value) {
  std::array<char, 32> text;
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  return field(std::string_view(text.data(), end));
}

void CsvWriter::end_row() {
  if (fields_ != columns_) {
    throw std::logic_error(fmt::format("a row of {} fields in {}, which has {} columns", fields_,
                                       file_.path().string(), columns_));
  }
  line_ += '\n';
  file_.write(line_);
  line_.clear();
  fields_ = 0;
}

}  // namespace touchstone::files
