// Tests of touchstone advise --front, and of run with a file of a trade.
#include <string>

#include "tests/harness/commands/program.h"

namespace touchstone {
namespace {

const std::string scene = "generator = \"uniform\"\ncount = 60\noverlaps = 6\nframes = 4\n";
const std::string grid = R"(
[trade]
scene = "scene.toml"
threads = 1
seconds = 1
[[trade.grid]]
narrow = ["gjk", "none"]
scalars = ["double", "float"]
)";

TEST(TradeCommand, RunTakesAFileOfATrade) {
  const TemporaryFolder folder;
  folder.write("scene.toml", scene);
  const std::string file = folder.write("mine.toml", grid).string();
  const std::string out = (folder.path() / "out").string();
  const Ran ran = run_program("run " + file + " --out " + out);
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("3 configurations"));
  EXPECT_EQ(read_rows(folder.path() / "out/points.csv", {"point"}).size(), 3u);
  EXPECT_GE(read_rows(folder.path() / "out/front.csv", {"point", "error_measure"}).size(), 1u);
  // The file that it writes is an equal request.
  const Ran again = run_program("run " + out + "/trade.toml --out " + out + "/again");
  EXPECT_EQ(again.status, 0) << again.text;
  EXPECT_EQ(read_rows(folder.path() / "out/again/points.csv", {"point"}),
            read_rows(folder.path() / "out/points.csv", {"point"}));
}

TEST(TradeCommand, OfMotionComparesSubstepsWithCasts) {
  const TemporaryFolder folder;
  const std::string file =
      folder.write("scene.toml", "generator = \"bullets\"\ncount = 60\nframes = 1\n").string();
  const std::string ask = "advise --front " + file + " --motion --no-figure --seconds 1 --out " +
                          (folder.path() / "out").string();
  const Ran ran = run_program(ask);
  ASSERT_EQ(ran.status, 0) << ran.text;
  EXPECT_THAT(ran.text, testing::HasSubstr("hits missed"));
  bool has_miss = false, has_cast = false;
  for (const auto& row : read_rows(folder.path() / "out/points.csv",
                                   {"point", "method", "substeps", "error", "seconds", "front"})) {
    if (row[1] == "discrete" && row[2] == "1") has_miss |= std::stod(row[3]) > 0;
    if (row[0] == "rigid-advancement") has_cast |= std::stod(row[3]) == 0 && std::stod(row[4]) > 0;
  }
  EXPECT_TRUE(has_miss);
  EXPECT_TRUE(has_cast);
  EXPECT_GE(read_rows(folder.path() / "out/front.csv", {"point"}).size(), 1U);
  expect_refusal(ask + "2 --error mean", "--motion", folder);
}

TEST(TradeCommand, BadRequestsAreRefused) {
  const TemporaryFolder folder;
  folder.write("scene.toml", scene);
  const std::string file = folder.write("mine.toml", grid).string();
  const std::string at = folder.path().string() + "/";
  expect_refusal("advise --front " + at + "none.toml --out " + at + "out",
                 "none.toml: no such file", folder);
  expect_refusal("advise --front " + at + "scene.toml --task touch", "--task", folder);
  expect_refusal("advise --front " + at + "scene.toml --task signed", "intersect", folder);
  expect_refusal("advise --front " + at + "scene.toml --error luck", "--error", folder);
  expect_refusal("advise --front " + at + "scene.toml --threads 0", "--threads", folder);
  expect_refusal("run " + file + " --resume --out " + at + "out",
                 "a trade begins anew; expected no --resume", folder);
  expect_refusal("run " + file + " --strict --out " + at + "out",
                 "expected no options but --out, --resume, --threads and --report", folder);
  folder.write("bad.toml", grid + "tolerances = 2\n");
  expect_refusal("run " + at + "bad.toml --out " + at + "out", "bad.toml:9: grid 1: tolerances",
                 folder);
}

}  // namespace
}  // namespace touchstone
