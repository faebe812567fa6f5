// The file of a page, and numbers in it.
#include "harness/report/page_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

#include "harness/base/error.h"
#include "harness/report/packed_numbers.h"
#include "tests/harness/report/unpacked.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone::report {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(PageFile, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");  // RFC 4648, section 10
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\0\xff\xfe", 3)), "AP/+");
}

TEST(PageFile, FramesAreDifferencesOfBits) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  const std::vector<float> numbers = {1, -2, inf, 1, -2.5F, -inf, 1, -2.5F, 0};
  const std::string packed = packed_frames(numbers, 3);
  EXPECT_EQ(frames_of(packed, 3), numbers);
  EXPECT_EQ(numbers_of<std::uint32_t>(packed)[3], 0U);  // it did not change
  EXPECT_EQ(packed_frames({}, 0), "");
}

TEST(PageFile, HoldsTheBundleWhateverItsTextIs) {
  const TemporaryFolder folder;
  files::OrderedJson bundle;
  bundle["name"] = "</script><script>alert(1)</script><!--BUNDLE-->";
  bundle["bytes"] = "\xff\xfe and é";
  bundle["long"] = std::string(3'000'000, 'x');
  const std::size_t size =
      write_page(folder.path() / "page.html", "<b>before</b><!--BUNDLE--><i>after</i>", bundle);
  const std::string page = folder.read("page.html");
  EXPECT_EQ(page.size(), size);
  EXPECT_LT(page.size(), 20'000U);
  EXPECT_TRUE(page.starts_with("<b>before</b>"));
  EXPECT_TRUE(page.ends_with("<i>after</i>"));
  EXPECT_THAT(page, Not(HasSubstr("alert")));
  const nlohmann::json read = bundle_of(page.substr(13, page.size() - 13 - 12));
  EXPECT_EQ(read["name"], bundle["name"]);
  EXPECT_EQ(read["bytes"], "\xef\xbf\xbd\xef\xbf\xbd and é");  // what is not UTF-8 is replaced
  EXPECT_EQ(read["long"], bundle["long"]);
}

TEST(PageFile, RefusesAPageWithoutAPlaceAndAFileThatCannotBeWritten) {
  const TemporaryFolder folder;
  EXPECT_THROW(write_page(folder.path() / "page.html", "<html>", {}), base::InputError);
  EXPECT_THROW(write_page(folder.path() / "none/page.html", "<!--BUNDLE-->", {}), base::InputError);
  EXPECT_THROW(write_page("/dev/full", "<!--BUNDLE-->", {}), base::InputError);
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace
}  // namespace touchstone::report
