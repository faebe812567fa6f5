// Writes files that are whole or absent.
#include "harness/files/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio_ext.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "harness/base/error.h"

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

constexpr const char* temporary_ending = ".tmp";

std::filesystem::path temporary_name(std::filesystem::path file, int attempt) {
  file += fmt::format(".{}-{}{}", getpid(), attempt, temporary_ending);
  return file;
}

// The target of a symbolic link is written instead of the link.
std::filesystem::path written_file(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::is_symlink(file, error)) return file;
  const std::filesystem::path target = std::filesystem::canonical(file, error);
  return error ? file : target;
}

// True if a file without a name could be made beside this one, which may have a temporary name. File systems need not have
// such files.
bool has_room_beside(const std::filesystem::path& file) {
  struct stat status;
  if (lstat(temporary_name(file, 0).c_str(), &status) == 0 || errno != ENOENT) return false;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const int descriptor = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor < 0) return false;
  ::close(descriptor);
  return true;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
  if (a.empty() || b.empty() || is_device(a)) return false;
  if (a.lexically_normal().string().starts_with("/dev/")) return false;
  std::error_code ignored;
  if (std::filesystem::equivalent(a, b, ignored)) return true;
  return std::filesystem::weakly_canonical(a, ignored) ==
         std::filesystem::weakly_canonical(b, ignored);
}

}  // namespace

void check_output(const std::filesystem::path& file) {
  if (is_device(file)) return;
  std::error_code ignored;
  // A kill leaves nothing of a file without a name.
  if (!file.empty() && !std::filesystem::is_directory(file, ignored) &&
      has_room_beside(written_file(file))) {
    return;
  }
  OutputFile{file};
}

void expect_other_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const NamedFile& output = outputs[i];
    for (const NamedFile& input : inputs) {
      if (!is_same_file(output.file, input.file)) continue;
      throw base::InputError(fmt::format("{} would overwrite {} ({}); expected another file",
                                         output.name, input.name, input.file.string()));
    }
    for (const NamedFile& other : outputs.first(i)) {
      if (!is_same_file(output.file, other.file)) continue;
      throw base::InputError(
          fmt::format("{} and {} name the same file; expected two", other.name, output.name));
    }
  }
}

void check_outputs(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs) {
  expect_other_files(inputs, outputs);
  for (const NamedFile& output : outputs) {
    if (!output.file.empty()) check_output(output.file);
  }
}

std::filesystem::path target_of_temporary(const std::filesystem::path& file) {
  if (file.extension() != temporary_ending) return {};
  const std::filesystem::path numbered = file.parent_path() / file.stem();
  const std::string numbers = numbered.extension().string();
  int process = 0, attempt = 0, end = 0;
  if (std::sscanf(numbers.c_str(), ".%d-%d%n", &process, &attempt, &end) != 2) return {};
  if (static_cast<std::size_t>(end) != numbers.size()) return {};
  return numbered.parent_path() / numbered.stem();
}

OutputFile::OutputFile(std::filesystem::path file, Keep keep) : file_(std::move(file)) {
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
    file_ = written_file(file_);
    for (int attempt = 0; descriptor < 0; ++attempt) {
      temporary_ = temporary_name(file_, attempt);
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
}

OutputFile::~OutputFile() { discard(); }

void OutputFile::discard() {
  if (stream_ != nullptr && flushed_ >= 0) {
    __fpurge(stream_);  // discards the buffer
    if (ftruncate(fileno(stream_), flushed_) != 0) std::perror(file_.c_str());
  }
  if (stream_ != nullptr) std::fclose(stream_);
  stream_ = nullptr;
  if (!temporary_.empty()) std::remove(temporary_.c_str());
  temporary_.clear();
}

void OutputFile::fail() {
  const int error = errno;
  discard();
  write_failed(file_, error);
}

void OutputFile::write(std::string_view bytes) {
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_) != bytes.size()) fail();
}

void OutputFile::flush() {
  if (std::fflush(stream_) != 0) fail();
  if (flushed_ >= 0) flushed_ = ftello(stream_);
}

void OutputFile::close(Durable durable) {
  flush();
  const bool named = !temporary_.empty();
  if (named && durable == Durable::against_power_cuts && fsync(fileno(stream_)) != 0) fail();
  std::FILE* const stream = std::exchange(stream_, nullptr);
  if (std::fclose(stream) != 0) fail();
  if (named && std::rename(temporary_.c_str(), file_.c_str()) != 0) fail();
  temporary_.clear();
}

}  // namespace touchstone::files
