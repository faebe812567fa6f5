// Reads grey images with libpng. It leaves a function by a jump at a fault, so that those which call it
// have nothing to destroy.
#include "harness/files/heights/grey_png.h"

#include <fmt/format.h>
#include <png.h>

#include <csetjmp>
#include <cstdio>
#include <memory>
#include <string>

#include "harness/base/error.h"
#include "harness/base/input_file.h"

namespace touchstone::files {
namespace {

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

}  // namespace

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

}  // namespace touchstone::files
