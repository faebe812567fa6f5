// Reads grids of heights, from text and from grey images with libpng.
#include "harness/files/height_grid.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "harness/base/error.h"
#include "harness/base/input_file.h"
#include "harness/files/packed_files.h"

namespace touchstone::files {
namespace {

// Reads grey images with libpng. It leaves a function by a jump at a fault, so that those which call it
// have nothing to destroy.

struct GreyImage {
  std::size_t rows = 0, columns = 0;
  std::uint32_t white = 255;          // 65535 with 16 bits a pixel
  std::vector<std::uint16_t> pixels;  // row by row from the top, as the file has them
};

struct Closed {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

void keep_message(png_structp png, png_const_charp message) {
  *static_cast<std::string*>(png_get_error_ptr(png)) = message;
  png_longjmp(png, 1);
}

void ignore_warning(png_structp /*png*/, png_const_charp /*message*/) {}

class Reading {
 public:
  Reading()
      : png_(
            png_create_read_struct(PNG_LIBPNG_VER_STRING, &message_, keep_message, ignore_warning)),
        info_(png_ != nullptr ? png_create_info_struct(png_) : nullptr) {}
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;
  ~Reading() { png_destroy_read_struct(&png_, &info_, nullptr); }

  // Both return false at a fault.
  bool read_header(std::FILE* file) {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;
    png_init_io(png_, file);
    png_read_info(png_, info_);
    return true;
  }
  bool read_rows(png_bytep* rows) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    png_read_image(png_, rows);
    png_read_end(png_, nullptr);
    return true;
  }

  const std::string& message() const { return message_; }
  std::size_t rows() const { return png_get_image_height(png_, info_); }
  std::size_t columns() const { return png_get_image_width(png_, info_); }
  int colour() const { return png_get_color_type(png_, info_); }
  int bits() const { return png_get_bit_depth(png_, info_); }

 private:
  std::string message_;
  png_structp png_;
  png_infop info_;
};

// Throws InputError for a file that is not such an image, and for one with more rows or columns than `most`.
GreyImage read_grey_png(const std::filesystem::path& file, std::size_t most) {
  const auto fail = [&](const std::string& message) {
    throw base::InputError(file.string(), 0, message);
  };
  base::check_kind(file, "a PNG image");
  const std::unique_ptr<std::FILE, Closed> input(std::fopen(file.c_str(), "rb"));
  if (!input) fail("cannot be read; expected a PNG image");
  Reading reading;
  if (!reading.read_header(input.get())) {
    fail(fmt::format("no PNG image ({}); expected a grey one", reading.message()));
  }
  GreyImage image;
  image.rows = reading.rows();
  image.columns = reading.columns();
  const int bits = reading.bits();
  if (reading.colour() != PNG_COLOR_TYPE_GRAY || (bits != 8 && bits != 16)) {
    fail(
        fmt::format("an image of {} bits with colours or alpha, or of few bits; expected a grey "
                    "one of 8 or 16 bits",
                    bits));
  }
  if (image.rows > most || image.columns > most) {
    fail(fmt::format("an image of {} x {} pixels; expected at most {} a side", image.columns,
                     image.rows, most));
  }
  const std::size_t bytes = bits == 16 ? 2 : 1, width = image.columns * bytes;
  std::vector<png_byte> content(image.rows * width);
  std::vector<png_bytep> rows;
  for (std::size_t row = 0; row < image.rows; ++row) rows.push_back(content.data() + row * width);
  if (!reading.read_rows(rows.data())) {
    fail(fmt::format("the image is broken ({})", reading.message()));
  }
  image.white = bits == 16 ? 65535 : 255;
  image.pixels.reserve(image.rows * image.columns);
  for (std::size_t i = 0; i < content.size(); i += bytes) {
    const unsigned high = content[i], low = bytes == 2 ? content[i + 1] : 0;
    image.pixels.push_back(static_cast<std::uint16_t>(bytes == 2 ? high << 8 | low : high));
  }
  return image;
}

// The words of a line, parted by commas or blanks. A comma parts two words, of which either may be empty.
std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  const auto is_blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  std::size_t at = 0;
  bool after_comma = false;
  while (true) {
    while (at < line.size() && is_blank(line[at])) ++at;
    if (at == line.size()) break;
    if (line[at] == ',') {
      if (after_comma || words.empty()) words.push_back(line.substr(at, 0));
      after_comma = true;
      ++at;
      continue;
    }
    const std::size_t begin = at;
    while (at < line.size() && !is_blank(line[at]) && line[at] != ',') ++at;
    words.push_back(line.substr(begin, at - begin));
    after_comma = false;
  }
  if (after_comma) words.push_back(line.substr(line.size()));
  return words;
}

class TextGrid {
 public:
  explicit TextGrid(const std::filesystem::path& file) : file_(file.string()), lines_(file) {}

  HeightGrid read(bool is_map) {
    if (is_map) read_header();
    while (const auto line = lines_.next()) {
      ++line_;
      const auto words = words_of(*line);
      if (!words.empty()) add_row(words);
    }
    if (rows_ && grid_.rows != *rows_) {
      throw base::InputError(
          file_, 0, fmt::format("{} rows of heights; expected {}, its nrows", grid_.rows, *rows_));
    }
    return std::move(grid_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw base::InputError(file_, line_, message);
  }

  double number(std::string_view word) const {
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
      fail(fmt::format("found '{}'; expected a finite number", word));
    }
    return value;
  }

  std::size_t count(std::string_view word) const {
    const double value = number(word);
    if (value != std::floor(value) || value < 2 || value > most_heights_a_side) {
      fail(
          fmt::format("found {}; expected a whole number from 2 to {}", word, most_heights_a_side));
    }
    return static_cast<std::size_t>(value);
  }

  void add_row(const std::vector<std::string_view>& words) {
    if (grid_.rows == 0 && grid_.columns == 0) grid_.columns = words.size();
    if (words.size() != grid_.columns) {
      fail(fmt::format("a row of {} heights; expected {}", words.size(), grid_.columns));
    }
    if (grid_.columns > most_heights_a_side || grid_.rows == most_heights_a_side) {
      fail(fmt::format("more than {} rows or columns of heights", most_heights_a_side));
    }
    for (const std::string_view word : words) {
      grid_.heights.push_back(number(word));
      if (grid_.heights.back() == nothing_) {
        fail(fmt::format("found {}, which stands for no height; expected a height everywhere",
                         word));
      }
    }
    ++grid_.rows;
  }

  // Lines of a name and a number, up to the first that begins with a number: that is a row.
  void read_header() {
    std::set<std::string> seen;
    while (const auto line = lines_.next()) {
      ++line_;
      const auto words = words_of(*line);
      if (words.empty()) continue;
      const auto first = words[0].empty() ? ' ' : words[0][0];
      if (std::isalpha(static_cast<unsigned char>(first)) == 0) {
        for (const char* name : {"ncols", "nrows", "cellsize"}) {
          if (seen.contains(name)) continue;
          fail(fmt::format("a row of heights; expected {} before it", name));
        }
        add_row(words);
        return;
      }
      if (words.size() != 2)
        fail(fmt::format("{} words; expected a name and a number", words.size()));
      std::string name(words[0]);
      std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::tolower(c); });
      if (!seen.insert(name).second) fail(fmt::format("{} is there twice", words[0]));
      take(name, words[1]);
    }
  }

  void take(const std::string& name, std::string_view word) {
    if (name == "ncols") {
      grid_.columns = count(word);
    } else if (name == "nrows") {
      rows_ = count(word);
    } else if (name == "cellsize") {
      grid_.cell_size = number(word);
      if (!(*grid_.cell_size > 0)) fail(fmt::format("found {}; expected a size above 0", word));
    } else if (name == "nodata_value") {
      nothing_ = number(word);
    } else if (name == "xllcorner" || name == "yllcorner" || name == "xllcenter" ||
               name == "yllcenter") {
      number(word);  // where the map lies on the earth; a body has its own place
    } else {
      fail(
          fmt::format("found {}; expected ncols, nrows, cellsize, xllcorner, yllcorner, "
                      "xllcenter, yllcenter or NODATA_value",
                      name));
    }
  }

  std::string file_;
  LineReader lines_;
  std::int64_t line_ = 0;
  HeightGrid grid_;
  std::optional<std::size_t> rows_;  // that the header tells
  double nothing_ = NAN;
};

HeightGrid heights_of(const std::filesystem::path& file) {
  std::string type = file.extension().string();
  std::ranges::transform(type, type.begin(), [](unsigned char c) { return std::tolower(c); });
  if (type == ".asc") return TextGrid(file).read(true);
  if (type == ".csv" || type == ".txt") return TextGrid(file).read(false);
  if (type != ".png") {
    throw base::InputError(file.string(), 0,
                           "no grid of heights by its name; expected .png, .asc, .csv or .txt");
  }
  const GreyImage image = read_grey_png(file, most_heights_a_side);
  HeightGrid grid{image.rows, image.columns, {}};
  grid.heights.reserve(image.pixels.size());
  for (const std::uint16_t pixel : image.pixels) {
    grid.heights.push_back(static_cast<double>(pixel) / image.white);
  }
  return grid;
}

}  // namespace

HeightGrid read_heights(const std::filesystem::path& file) {
  HeightGrid grid = heights_of(file);
  if (grid.rows < 2 || grid.columns < 2) {
    throw base::InputError(
        file.string(), 0,
        fmt::format("{} x {} heights; expected at least 2 rows of 2", grid.rows, grid.columns));
  }
  return grid;
}

}  // namespace touchstone::files
