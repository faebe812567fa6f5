// Grids of heights from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace touchstone::files {

// At least two rows and two columns of finite heights, row by row, the first row being the one at the
// greatest y, as in an image or a map.
struct HeightGrid {
  std::size_t rows = 0, columns = 0;
  std::vector<double> heights;
  std::optional<double> cell_size = {};  // metres, where the file says it
};

// More than so many rows or columns are refused.
inline constexpr std::size_t most_heights_a_side = 4097;

// Reads
//     .png  a grey image of 8 or 16 bits: heights from 0 (black) to 1 (white), whatever gamma it names
//     .asc  an ESRI ASCII grid: ncols, nrows, cellsize and any of xllcorner, yllcorner, xllcenter, yllcenter
//           and NODATA_value, then the rows
//     .csv, .txt  rows of numbers, parted by commas or blanks
// Throws InputError with file and line for anything else: ragged rows, what is no finite number, a height
// that is missing (NODATA_value), fewer than two rows or columns, too many, colours or an alpha channel.
HeightGrid read_heights(const std::filesystem::path& file);

}  // namespace touchstone::files
