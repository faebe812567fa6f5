// Tests of names of folders and files, of text for terminals and shells, and of the hash of bytes.
#include <gtest/gtest.h>

#include "harness/base/hash.h"
#include "harness/base/input_file.h"
#include "harness/base/names.h"
#include "harness/base/nearest_name.h"

namespace touchstone {
namespace {

TEST(Names, OneComponentOfAPath) {
  for (const std::string& good : {std::string("a"), std::string("two words"), std::string("..."),
                                  std::string("\xc3\xbc"), std::string(100, 'x')}) {
    EXPECT_EQ(base::name_fault(good), "") << good;
  }
  for (const std::string& bad :
       {std::string(), std::string("."), std::string(".."), std::string("../x"),
        std::string("/etc"), std::string("a/b"), std::string("a\nb"), std::string("\x1b]0;x\a"),
        std::string("\xc2\x9b"), std::string("a\0b", 3), std::string(101, 'x')}) {
    EXPECT_NE(base::name_fault(bad), "") << bad;
  }
}

TEST(Names, ASafeFileNameIsShortAndInItsFolder) {
  EXPECT_EQ(base::safe_file_name("gjk-double box/box"), "gjk-double_box_box");
  EXPECT_EQ(base::safe_file_name("../../x"), "_.._.._x");
  EXPECT_EQ(base::safe_file_name(""), "_");
  EXPECT_EQ(base::safe_file_name(std::string(256, 'x')), std::string(100, 'x'));
}

TEST(Names, ControlCharactersArePrintedAsEscapes) {
  EXPECT_EQ(base::printable("\x1b]0;title\a\x7f\xc2\x9b"), "\\x1b]0;title\\x07\\x7f\\xc2\\x9b");
  EXPECT_EQ(base::printable("a\n\tb \xc3\xbc"), "a\n\tb \xc3\xbc");
}

TEST(Names, AShellReadsTheSameWord) {
  EXPECT_EQ(base::shell_word("a/b.toml"), "a/b.toml");
  EXPECT_EQ(base::shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(base::shell_word("a'\\\x1b"), "$'a\\'\\\\\\x1b'");
}

TEST(ByteHash, DoesNotDependOnThePieces) {
  const std::string text = "0123456789abcdefghijklmnopq";
  const auto of = [](std::initializer_list<std::string_view> pieces) {
    base::ByteHash hash;
    for (const std::string_view piece : pieces) hash.add(piece);
    return hash.value();
  };
  for (std::size_t first = 0; first <= text.size(); ++first) {
    EXPECT_EQ(of({text}), of({text.substr(0, first), text.substr(first)})) << first;
  }
  EXPECT_NE(of({text}), of({text.substr(1)}));
  EXPECT_NE(of({std::string_view("\0", 1)}), of({std::string_view("\0\0", 2)}));
}

TEST(Names, ASlipOfThePenGetsTheNearestName) {
  const std::vector<std::string_view> known = {"all", "gjk", "gjk-lanes", "sweep-and-prune"};
  const auto text = [&](std::string_view name) {
    return base::unknown_name("algorithm", name, known);
  };
  EXPECT_EQ(text("gjk-lane"), "no algorithm is called 'gjk-lane'; did you mean gjk-lanes?");
  EXPECT_EQ(text("gkj"), "no algorithm is called 'gkj'; did you mean gjk?");
  EXPECT_EQ(text("what"),
            "no algorithm is called 'what'; expected some of all, gjk, gjk-lanes, sweep-and-prune");
  EXPECT_NE(text(std::string(1000, 'x')).find("expected some of"), std::string::npos);
  EXPECT_NE(text("").find("expected some of"), std::string::npos);
}

}  // namespace
}  // namespace touchstone
