// The readers of strangers' files. A fuzzer calls them, and a test on the inputs that are kept for them.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace touchstone::fuzz {

struct Reader {
  std::string_view name;  // on the command line, and of its folder in inputs/
  std::string_view file;  // the name that the input gets
  // Reads the file, and checks what it claims. Throws base::InputError for bad input.
  void (*read)(const std::filesystem::path& file);
  // Files that stand beside it, by name.
  struct Beside {
    std::string_view file, text;
  };
  std::vector<Beside> beside = {};
};

std::span<const Reader> readers();

// Throws std::invalid_argument, which lists all, if none has that name.
const Reader& reader_named(std::string_view name);

// Reads inputs in a folder, into which it writes what stands beside them.
class Trial {
 public:
  Trial(const Reader& reader, std::filesystem::path folder);
  // Returns what the reader says of the bytes; empty if it reads them. Lets everything but a base::InputError out, and
  // throws std::logic_error if that does not name a file of the folder.
  std::string fault(std::string_view bytes) const;

 private:
  const Reader& reader_;
  std::filesystem::path folder_;
};

}  // namespace touchstone::fuzz
