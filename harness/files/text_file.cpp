// Reads and writes text files.
#include "harness/files/text_file.h"

#include <fstream>
#include <iterator>

#include "harness/base/error.h"
#include "harness/files/output_file.h"

namespace touchstone::files {

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream) throw base::InputError(file.string(), 0, "cannot be read");
  return text;
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  OutputFile output(file);
  output.write(content);
  output.close(OutputFile::Durable::against_kills);
}

}  // namespace touchstone::files
