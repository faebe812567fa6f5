// Tests of the lines that a long job prints where there is no terminal.
#include "harness/base/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone::base {
namespace {

std::chrono::steady_clock::time_point fake_now;

TEST(ProgressOf, EachStepIsALineWithTheTimeThatIsLeft) {
  Stopwatch::use([] { return fake_now; });
  testing::internal::CaptureStderr();
  {
    Progress progress({10, 10, 20});
    progress.start("first");
    fake_now += std::chrono::seconds(30);
    progress.part(1);
    progress.start("second");
    fake_now += std::chrono::seconds(30);
    progress.start("third");
  }
  const std::string text = testing::internal::GetCapturedStderr();
  Stopwatch::use([] { return std::chrono::steady_clock::now(); });
  EXPECT_EQ(text,
            "[1/3] 0 s  first\n[2/3] 30 s, about 1 min 30 s left  second\n"
            "[3/3] 60 s, about 1 min 0 s left  third\n");
}

}  // namespace
}  // namespace touchstone::base
