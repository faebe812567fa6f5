// A file for writing that is whole or absent, or that keeps what was flushed.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <initializer_list>
#include <span>
#include <string_view>

namespace touchstone::files {

// Throws if OutputFile's constructor would, and leaves nothing behind, even if the process is killed meanwhile where the
// file system has files without names. Call it before long work.
void check_output(const std::filesystem::path& file);

// A file, and the option or argument that names it.
struct NamedFile {
  std::string_view name;
  std::filesystem::path file;  // none if empty
};

// Throws if two of the outputs are one file, or if one is read as an input. What is in /dev and other
// devices may be named more than once.
void expect_other_files(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);
// The same, and check_output for each.
void check_outputs(std::span<const NamedFile> inputs, std::span<const NamedFile> outputs);
inline void check_outputs(std::initializer_list<NamedFile> inputs,
                          std::initializer_list<NamedFile> outputs) {
  check_outputs(std::span(inputs.begin(), inputs.size()),
                std::span(outputs.begin(), outputs.size()));
}

// Returns the file of which this is the temporary name while OutputFile writes it, FILE.PROCESS-N.tmp,
// and which a kill leaves behind; an empty path if it is no such name.
std::filesystem::path target_of_temporary(const std::filesystem::path& file);

// Writes a file under a temporary name beside it and renames it in `close`, so that readers see a
// whole file or none. Without `close` (after an exception) nothing is left. Every failure to write,
// such as a full disk, is an InputError with the file's name. A device or a pipe is written
// directly.
class OutputFile {
 public:
  // The content that remains if the work does not finish: nothing, or all that was flushed.
  enum class Keep : std::uint8_t { whole_file, flushed_rows, appended_rows };

  // Keep::flushed_rows writes the file itself, whose old content is lost; a failure truncates it to
  // the last flush. Keep::appended_rows does this after the file's content.
  explicit OutputFile(std::filesystem::path file, Keep keep = Keep::whole_file);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view bytes);
  void flush();  // what was written so far survives this process
  // Size in bytes of a file of flushed or appended rows at the last flush; -1 for other files.
  std::int64_t size() const { return flushed_; }
  const std::filesystem::path& path() const { return file_; }
  // The event that the renamed file survives: the end of this process, or of the machine too.
  enum class Durable : std::uint8_t { against_kills, against_power_cuts };
  void close(Durable durable = Durable::against_power_cuts);

 private:
  void discard();
  [[noreturn]] void fail();  // throws for errno

  std::filesystem::path file_, temporary_;  // without a temporary name `file_` itself is written
  std::FILE* stream_ = nullptr;
  off_t flushed_ = -1;  // bytes that a failure leaves; -1: no file
};

}  // namespace touchstone::files
