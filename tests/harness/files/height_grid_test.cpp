// Grids of heights from images and texts.
#include "harness/files/height_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tests/harness/input_fault.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class HeightGrids : public ::testing::Test {
 protected:
  files::HeightGrid read(const char* name, const std::string& text) const {
    return files::read_heights(folder.write(name, text));
  }
  std::string fault(const char* name, const std::string& text) const {
    return input_fault([&] { read(name, text); });
  }
  // Writes an image of this format of libpng's.
  std::filesystem::path image(std::uint32_t width, std::uint32_t height, std::uint32_t format,
                              const void* pixels) const {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = width;
    image.height = height;
    image.format = format;
    const std::filesystem::path file = folder.path() / "image.png";
    EXPECT_NE(png_image_write_to_file(&image, file.c_str(), 0, pixels, 0, nullptr), 0);
    return file;
  }

  TemporaryFolder folder;
};

TEST_F(HeightGrids, AreRowsOfNumbers) {
  for (const auto& [name, text] :
       {std::pair("a.csv", "1,2,3\n-4, 5e-1 ,6\n"), std::pair("a.txt", "1 2\t3\r\n\n-4 0.5 6")}) {
    const files::HeightGrid grid = read(name, text);
    EXPECT_EQ(grid.rows, 2u);
    EXPECT_EQ(grid.columns, 3u);
    EXPECT_THAT(grid.heights, ElementsAre(1, 2, 3, -4, 0.5, 6));
    EXPECT_FALSE(grid.cell_size);
  }
}

TEST_F(HeightGrids, AreMaps) {
  const files::HeightGrid grid = read("a.asc",
                                      "NCOLS 2\nnrows 3\nxllcorner 5000\nyllcorner -7.5\n"
                                      "cellsize 0.25\nNODATA_value -9999\n1 2\n3 4\n5 6\n");
  EXPECT_EQ(grid.rows, 3u);
  EXPECT_THAT(grid.heights, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(grid.cell_size, 0.25);
}

TEST_F(HeightGrids, AreGreyImages) {
  // The files have the pixels as they are given: sRGB in 8 bits, linear in 16.
  const std::vector<std::uint8_t> bytes = {0, 51, 255, 102, 204, 153};
  const files::HeightGrid eight = files::read_heights(image(3, 2, PNG_FORMAT_GRAY, bytes.data()));
  EXPECT_EQ(eight.rows, 2u);
  EXPECT_EQ(eight.columns, 3u);
  EXPECT_THAT(eight.heights, ElementsAre(0, 0.2, 1, 0.4, 0.8, 0.6));
  const std::vector<std::uint16_t> words = {0, 1, 65535, 256, 13107, 2};
  const files::HeightGrid sixteen =
      files::read_heights(image(2, 3, PNG_FORMAT_LINEAR_Y, words.data()));
  EXPECT_EQ(sixteen.rows, 3u);
  EXPECT_THAT(sixteen.heights, ElementsAre(0, 1 / 65535.0, 1, 256 / 65535.0, 0.2, 2 / 65535.0));
}

TEST_F(HeightGrids, FaultsAreNamedWithTheirPlace) {
  EXPECT_THAT(fault("a.csv", "1,2,3\n4,5\n"),
              AllOf(HasSubstr("a.csv:2: a row of 2 heights"), HasSubstr("expected 3")));
  EXPECT_THAT(fault("a.csv", "1,2\n4,nan\n"),
              HasSubstr("a.csv:2: found 'nan'; expected a finite number"));
  EXPECT_THAT(fault("a.csv", "1,2\n4,1e999\n"), HasSubstr("a.csv:2: found '1e999'"));
  EXPECT_THAT(fault("a.csv", "1,2\n,4\n"), HasSubstr("a.csv:2: found ''"));
  EXPECT_THAT(fault("a.csv", "1,2\n3,\n"), HasSubstr("a.csv:2: found ''"));
  EXPECT_THAT(fault("a.csv", "1,,2\n"), HasSubstr("a.csv:1: found ''"));
  EXPECT_THAT(fault("a.csv", "1,2,3\n"), HasSubstr("1 x 3 heights; expected at least 2 rows of 2"));
  EXPECT_THAT(fault("a.csv", "1\n2\n"), HasSubstr("2 x 1 heights"));
  EXPECT_THAT(fault("a.csv", ""), HasSubstr("0 x 0 heights"));
  std::string wide = "0";
  for (int i = 0; i < 4097; ++i) wide += ",0";
  EXPECT_THAT(fault("a.csv", wide + "\n" + wide), HasSubstr("a.csv:1: more than 4097"));
  std::string tall;
  for (int i = 0; i < 4098; ++i) tall += "0,0\n";
  EXPECT_THAT(fault("a.csv", tall), HasSubstr("a.csv:4098: more than 4097"));
  EXPECT_THAT(fault("a.dem", "1,2\n3,4\n"), HasSubstr("expected .png, .asc, .csv or .txt"));
  EXPECT_THAT(input_fault([&] { files::read_heights(folder.path() / "none.csv"); }),
              HasSubstr("none.csv"));
}

TEST_F(HeightGrids, FaultsOfMapsAreNamed) {
  const std::string head = "ncols 2\nnrows 2\ncellsize 1\n";
  EXPECT_THAT(fault("a.asc", head + "1 2\n"), HasSubstr("1 rows of heights; expected 2"));
  EXPECT_THAT(fault("a.asc", head + "1 2 3\n4 5 6\n"), HasSubstr("a.asc:4: a row of 3 heights"));
  EXPECT_THAT(fault("a.asc", head + "NODATA_value -1\n1 2\n3 -1\n"),
              HasSubstr("a.asc:6: found -1, which stands for no height"));
  EXPECT_THAT(fault("a.asc", "ncols 2\nnrows 2\n1 2\n3 4\n"),
              HasSubstr("a.asc:3: a row of heights; expected cellsize before it"));
  EXPECT_THAT(fault("a.asc", "ncols 2\nncols 2\n"), HasSubstr("a.asc:2: ncols is there twice"));
  EXPECT_THAT(fault("a.asc", "ncols 1\n"), HasSubstr("a.asc:1: found 1; expected a whole number"));
  EXPECT_THAT(fault("a.asc", "ncols 1e9\n"), HasSubstr("from 2 to 4097"));
  EXPECT_THAT(fault("a.asc", "cellsize 0\n"), HasSubstr("expected a size above 0"));
  EXPECT_THAT(fault("a.asc", "colour 7\n"), HasSubstr("a.asc:1: found colour; expected ncols"));
  EXPECT_THAT(fault("a.asc", "ncols\n"), HasSubstr("expected a name and a number"));
}

TEST_F(HeightGrids, FaultsOfImagesAreNamed) {
  EXPECT_THAT(fault("a.png", "no image"), HasSubstr("a.png: no PNG image"));
  const std::vector<std::uint8_t> bytes(3 * 3 * 4, 7);
  EXPECT_THAT(input_fault([&] { files::read_heights(image(3, 3, PNG_FORMAT_RGB, bytes.data())); }),
              HasSubstr("expected a grey one of 8 or 16 bits"));
  EXPECT_THAT(input_fault([&] { files::read_heights(image(3, 3, PNG_FORMAT_GA, bytes.data())); }),
              HasSubstr("expected a grey one"));
  EXPECT_THAT(input_fault([&] { files::read_heights(image(3, 1, PNG_FORMAT_GRAY, bytes.data())); }),
              HasSubstr("1 x 3 heights"));
  const std::vector<std::uint8_t> many(4098 * 2, 7);
  EXPECT_THAT(
      input_fault([&] { files::read_heights(image(4098, 2, PNG_FORMAT_GRAY, many.data())); }),
      HasSubstr("4098 x 2 pixels; expected at most 4097 a side"));
  // An image that ends early.
  image(3, 3, PNG_FORMAT_GRAY, bytes.data());
  const std::string whole = folder.read("image.png");
  EXPECT_THAT(fault("a.png", whole.substr(0, whole.size() - 20)), HasSubstr("the image is broken"));
}

}  // namespace
}  // namespace touchstone
