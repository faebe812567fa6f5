// Writes CSV files that are whole or absent.
#include <fcntl.h>
#include <fmt/format.h>
#include <stdio_ext.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "harness/base/error.h"
#include "harness/files/csv.h"

namespace touchstone::files {
namespace {

[[noreturn]] void write_failed(const std::filesystem::path& file, int error) {
  throw base::InputError(file.string(), 0,
                         fmt::format("cannot be written: {}", std::strerror(error)));
}

bool is_device(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

}  // namespace

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

void check_output(const std::filesystem::path& file) {
  if (!is_device(file)) CsvWriter(file, {});
}

CsvWriter::CsvWriter(std::filesystem::path file, const std::vector<std::string>& header, Keep keep)
    : file_(std::move(file)), columns_(header.size()) {
  if (file_.empty()) throw base::InputError("the output's name is empty; expected a file");
  std::error_code ignored;
  if (std::filesystem::is_directory(file_, ignored)) write_failed(file_, EISDIR);
  int descriptor = -1;
  if (is_device(file_)) {
    // A device or a pipe is written directly, since renaming a file over it would replace it.
    descriptor = open(file_.c_str(), O_WRONLY | O_CLOEXEC);
  } else if (keep != Keep::whole_file) {
    const int before = keep == Keep::flushed_rows ? O_TRUNC : 0;
    descriptor = open(file_.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | before, 0666);
    flushed_ = descriptor < 0 ? 0 : lseek(descriptor, 0, SEEK_END);
  } else {
    // The target of a symbolic link is replaced instead of the link.
    if (std::filesystem::is_symlink(file_, ignored)) {
      const std::filesystem::path target = std::filesystem::canonical(file_, ignored);
      if (!ignored) file_ = target;
    }
    for (int attempt = 0; descriptor < 0; ++attempt) {
      temporary_ = file_;
      temporary_ += fmt::format(".{}-{}.tmp", getpid(), attempt);
      descriptor = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (descriptor < 0 && errno != EEXIST) break;
    }
  }
  const int error = errno;
  if (descriptor < 0) {
    temporary_.clear();
    write_failed(file_, error);
  }
  stream_ = fdopen(descriptor, "wb");
  if (stream_ == nullptr) {
    const int reason = errno;
    ::close(descriptor);
    discard();
    write_failed(file_, reason);
  }
  // The buffer lets rows leave the process only when they are flushed, and not in the middle of a
  // row.
  if (flushed_ >= 0) std::setvbuf(stream_, nullptr, _IOFBF, std::size_t{1} << 20);
  if (flushed_ > 0) return;
  for (const std::string& name : header) field(name);
  if (!header.empty()) end_row();
}

CsvWriter::~CsvWriter() { discard(); }

void CsvWriter::discard() {
  if (stream_ != nullptr && flushed_ >= 0) {
    __fpurge(stream_);  // discards the buffer
    if (ftruncate(fileno(stream_), flushed_) != 0) std::perror(file_.c_str());
  }
  if (stream_ != nullptr) std::fclose(stream_);
  stream_ = nullptr;
  if (!temporary_.empty()) std::remove(temporary_.c_str());
  temporary_.clear();
}

void CsvWriter::fail() {
  const int error = errno;
  discard();
  write_failed(file_, error);
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
                                       file_.string(), columns_));
  }
  line_ += '\n';
  if (std::fwrite(line_.data(), 1, line_.size(), stream_) != line_.size()) fail();
  line_.clear();
  fields_ = 0;
}

void CsvWriter::flush() {
  if (std::fflush(stream_) != 0) fail();
  if (flushed_ >= 0) flushed_ = ftello(stream_);
}

void CsvWriter::close(Durable durable) {
  flush();
  const bool named = !temporary_.empty();
  if (named && durable == Durable::against_power_cuts && fsync(fileno(stream_)) != 0) fail();
  std::FILE* const stream = std::exchange(stream_, nullptr);
  if (std::fclose(stream) != 0) fail();
  if (named && std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
  temporary_.clear();
}

}  // namespace touchstone::files
