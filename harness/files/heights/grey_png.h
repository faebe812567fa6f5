// Grey images in the format PNG.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace touchstone::files {

struct GreyImage {
  std::size_t rows = 0, columns = 0;
  std::uint32_t white = 255;          // 65535 with 16 bits a pixel
  std::vector<std::uint16_t> pixels;  // row by row from the top, as the file has them
};

// Throws InputError for a file that is not such an image, and for one with more rows or columns than `most`.
GreyImage read_grey_png(const std::filesystem::path& file, std::size_t most);

}  // namespace touchstone::files
