// Tests of the command line.
#include "harness/commands/arguments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/base/data_folder.h"
#include "harness/commands/commands.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

enum class Colour { red, green };
const commands::Arguments::Choices<Colour> colours = {{"red", Colour::red},
                                                      {"green", Colour::green}};

// A command with an option of each kind.
class TheCommandLine : public testing::Test {
 protected:
  TheCommandLine() {
    commands::Arguments command = line_.add_command("paint", "Paints");
    command.text("file", file_, "A file");
    command.texts("--names", names_, "Names").separated_by_commas();
    command.flag("--wet", wet_, "Wet paint");
    command.number("--count", count_, "How many").within(1, 9).show_default();
    command.number("--size", size_, "How large").positive();
    command.number("--limit", limit_, "At most").not_negative();
    command.numbers("--layers", layers_, "Layers").within(1, 5);
    command.one_of("--colour", colour_, colours, "The colour");
    command.some_of("--colours", some_, colours, "Colours").excludes(command.option("--colour"));
    command.text("--read", read_, "A file that is read").is_read();
    command.text("--alone", alone_, "Stands alone");
    command.exclude_others("--alone");
    command.job([this, command] {
      shell_line_ = command.shell_line("--limit");
      return 7;
    });
  }

  int run(std::vector<std::string> words) {
    words.insert(words.begin(), "paint");
    testing::internal::CaptureStderr();
    const int status = line_.run(words);
    error_ = testing::internal::GetCapturedStderr();
    return status;
  }

  commands::CommandLine line_{"A program"};
  std::string file_, read_, alone_, shell_line_, error_;
  std::vector<std::string> names_;
  bool wet_ = false;
  int count_ = 2;
  double size_ = 1;
  std::optional<double> limit_;
  std::vector<int> layers_ = {1};
  Colour colour_ = Colour::red;
  std::vector<Colour> some_ = {Colour::red};
};

TEST_F(TheCommandLine, TakesWhatIsNotHereFromTheDataFolder) {
  const TemporaryFolder here;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(here.path());
  EXPECT_EQ(run({"wall", "--read", "datasets/city.toml"}), 7);
  EXPECT_EQ(read_, (base::data_folder().path / "datasets/city.toml").string());
  EXPECT_EQ(run({"wall", "--read", "datasets/none.toml"}), 7);
  EXPECT_EQ(read_, "datasets/none.toml");
  std::filesystem::current_path(before);
}

TEST_F(TheCommandLine, ReadsEveryKindOfOption) {
  EXPECT_EQ(run({"wall", "--names", "a,b", "--wet", "--count", "3", "--size", "0.5", "--limit", "0",
                 "--layers", "1,2", "--colours", "green,red"}),
            7);
  EXPECT_EQ(file_, "wall");
  EXPECT_THAT(names_, testing::ElementsAre("a", "b"));
  EXPECT_TRUE(wet_);
  EXPECT_EQ(count_, 3);
  EXPECT_EQ(size_, 0.5);
  EXPECT_EQ(limit_, 0);
  EXPECT_THAT(layers_, testing::ElementsAre(1, 2));
  EXPECT_THAT(some_, testing::ElementsAre(Colour::green, Colour::red));
  EXPECT_EQ(colour_, Colour::red);
}

TEST_F(TheCommandLine, KeepsWhatIsNotGiven) {
  EXPECT_EQ(run({}), 7);
  EXPECT_EQ(count_, 2);
  EXPECT_EQ(limit_, std::nullopt);
  EXPECT_THAT(layers_, testing::ElementsAre(1));
  EXPECT_THAT(some_, testing::ElementsAre(Colour::red));
}

TEST_F(TheCommandLine, SaysWhatWasExpected) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> faults = {
      {{"--count", "0"}, "--count: Value 0 not in range 1 to 9"},
      {{"--count", "x"}, "--count: Value x not in range 1 to 9"},
      {{"--size", "0"}, "--size: found '0'; expected a finite number > 0"},
      {{"--size", "nan"}, "--size: found 'nan'; expected a finite number > 0"},
      {{"--size", "inf"}, "expected a finite number > 0"},
      {{"--limit", "-1"}, "--limit: found '-1'; expected a finite number >= 0"},
      {{"--layers", "1,6"}, "--layers: Value 6 not in range 1 to 5"},
      {{"--colour", "blue"}, "--colour: blue not in {red,green}"},
      {{"--colours", "red,0"}, "--colours: 0 not in {red,green}"},
      {{"--colour", "red", "--colours", "red"}, "--colour excludes --colours"},
      {{"--alone", "a", "--wet"}, "excludes --alone"},
      {{"--other"}, "The following argument was not expected: --other"},
  };
  for (const auto& [words, text] : faults) {
    EXPECT_EQ(run(words), commands::exit_bad_request) << text;
    EXPECT_THAT(error_, testing::HasSubstr(text));
  }
}

TEST_F(TheCommandLine, IsRebuiltAsAShellReadsIt) {
  run({"a wall", "--wet", "--limit", "3", "--names", "it's,b", "--colour", "green"});
  EXPECT_EQ(shell_line_, "touchstone paint 'a wall' --names 'it'\\''s,b' --wet --colour green");
}

TEST_F(TheCommandLine, HoldsCommandsWithinACommand) {
  commands::Arguments outer = line_.add_command("fence", "Fences");
  commands::Arguments inner = outer.nested("build", "Builds");
  std::string posts = "none", shell_line;
  inner.text("--posts", posts, "Posts").value_optional();
  inner.job([&] {
    shell_line = inner.shell_line("");
    return 5;
  });
  EXPECT_EQ(line_.run({"fence", "build", "--posts", "3"}), 5);
  EXPECT_EQ(shell_line, "touchstone fence build --posts 3");
  EXPECT_EQ(line_.run({"fence", "build", "--posts"}), 5);
  EXPECT_EQ(shell_line, "touchstone fence build --posts");
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"fence"}, {"fence", "paint"}, {"fence", "--posts", "3"}}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(line_.run(words), commands::exit_bad_request);
    EXPECT_THAT(testing::internal::GetCapturedStderr(),
                testing::HasSubstr("Expected a command, one of: build."));
  }
}

TEST_F(TheCommandLine, NamesTheCommandsWhereItKnowsNone) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(line_.run({"draw"}), commands::exit_bad_request);
  EXPECT_THAT(testing::internal::GetCapturedStderr(),
              testing::HasSubstr("Expected a command, one of: paint."));
}

}  // namespace
}  // namespace touchstone
