// Packs files for tests of their readers.
#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "harness/files/packed_files.h"

namespace touchstone {

// Puts NAME.zst in place of the file.
inline void pack(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  files::ZstdWriter writer(files::packed_name(file));
  writer.write(std::string{std::istreambuf_iterator<char>(in), {}});
  writer.close();
  std::filesystem::remove(file);
}

}  // namespace touchstone
