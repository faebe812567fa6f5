// Checks of rays at scenes: of planted errors, and by more than one process.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "harness/check/check_run.h"
#include "tests/harness/kinds/planted_kinds.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using ::testing::IsEmpty;
using ::testing::Not;

// All families of rays at scenes.
check::CheckRequest request_of(std::vector<kinds::Contestant> contestants) {
  check::CheckRequest request;
  request.scalars = {Precision::float64};
  request.contestants = std::move(contestants);
  for (const kinds::Family* family : kinds::case_families()) {
    if (family->kind == &kinds::scene_ray_kind()) request.families.push_back(family);
  }
  return request;
}

TEST(SceneRayCheck, AnotherBodyOrLengthThanTheFirstIsWrong) {
  const SceneRayCastEntry astray{.info = {.name = "astray", .citation = "none"},
                                 .tasks = {RayTask::closest},
                                 .make = [] { return std::make_unique<AstraySceneRays>(); }};
  const TemporaryFolder folder;
  check::CheckRequest request = request_of({contestant_of(kinds::scene_ray_kind(), astray, true)});
  request.families.resize(1);
  request.cases = 100;
  request.out = folder.path() / "out";
  const auto result = check::run_check(request);
  check::FamilyCount count;
  for (const auto& [key, one] : result.of<check::FamilyChecker>().counts()) {
    if (key.form == kinds::CaseForm::as_drawn) count.add(one);
  }
  EXPECT_EQ(count.cases, 100);
  EXPECT_GT(count.inexact, 20);
  EXPECT_LE(count.right, count.cases - count.contacts);
  EXPECT_EQ(count.missed + count.false_hits + count.near, 0);
  EXPECT_THAT(result.ours_wrong(), Not(IsEmpty()));
}

// What is counted of rays at scenes does not depend on how many processes count.
TEST(SceneRayCheck, TwoWorkersCountAsOne) {
  const TemporaryFolder folder;
  constexpr std::array scalars = {Precision::float64};
  check::CheckRequest request = request_of(kinds::scene_ray_kind().contestants({"ours"}, scalars));
  request.cases = 50;
  std::array<std::string, 2> counted;
  for (const int workers : {1, 2}) {
    request.workers = workers;
    request.out = folder.path() / std::to_string(workers);
    const auto result = check::run_check(request);
    EXPECT_THAT(result.ours_wrong(), IsEmpty());
    std::int64_t hits = 0, misses = 0;
    for (const auto& [key, count] : result.of<check::FamilyChecker>().counts()) {
      hits += count.contacts;
      misses += count.cases - count.contacts;
    }
    EXPECT_GT(hits, 20);
    EXPECT_GT(misses, 20);
    counted[static_cast<std::size_t>(workers - 1)] =
        folder.read(std::to_string(workers) + "/families.csv");
  }
  EXPECT_EQ(counted[0], counted[1]);
}

}  // namespace
}  // namespace touchstone
