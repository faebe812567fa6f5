// Reads and writes text files.
#include "harness/files/text_file.h"

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/output_file.h"

namespace touchstone::files {

std::string read_text(const std::filesystem::path& file) {
  return base::read_whole(file, base::longest_text);
}

void write_text(const std::filesystem::path& file, const std::string& content) {
  OutputFile output(file);
  output.write(content);
  output.close(OutputFile::Durable::against_kills);
}

}  // namespace touchstone::files
