// Tests checks of families: with planted algorithms, and of the exact answers themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "harness/check/check_run.h"
#include "harness/check/select_cases.h"
#include "harness/files/ccd_queries.h"
#include "harness/files/concave_cases.h"
#include "harness/geometry/mesh.h"
#include "harness/kinds/kind.h"
#include "harness/scene/scene.h"
#include "tests/algorithms/one_in.h"
#include "tests/harness/input_fault.h"
#include "tests/harness/kinds/planted_kinds.h"
#include "tests/harness/stopped_folder.h"
#include "tests/harness/temporary_folder.h"

namespace touchstone {
namespace {

using check::FamilyCount;
using kinds::CaseForm;
using ::testing::Each;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// A family of each kind, in which both outcomes are common.
std::vector<const kinds::Family*> some_families() {
  std::vector<const kinds::Family*> some;
  for (const char* name :
       {"triangles-generic", "rays-random", "points-off-1e-3", "casts-on-a-grid",
        "vertex-face-small-grid-1", "scene-rays-short", "configurations-balls"}) {
    for (const kinds::Family* family : kinds::case_families()) {
      if (family->name == name) some.push_back(family);
    }
  }
  return some;
}

class FamilyCheck : public ::testing::Test {
 protected:
  check::CheckRequest request_for(std::vector<kinds::Contestant> contestants,
                                  check::CheckMode mode = check::CheckMode::cases) {
    check::CheckRequest request(mode);
    request.contestants = std::move(contestants);
    request.families = some_families();
    request.scalars = {Precision::float64};
    request.cases = 30;
    request.time_limit = 2;
    request.out = folder.path() / "out";
    return request;
  }
  // The sums of each kind's contestant, as drawn.
  static std::vector<FamilyCount> sums(const check::FamilyCounts& counts) {
    std::vector<FamilyCount> all(kinds::kinds().size());
    for (const auto& [key, count] : counts) {
      if (key.form == kinds::CaseForm::as_drawn) all[key.contestant].add(count);
    }
    return all;
  }

  TemporaryFolder folder;
};

TEST_F(FamilyCheck, ContactsThatAreNotToldAreMissed) {
  const PlantedKinds<Habit::no> planted;
  const auto request = request_for(planted.contestants());
  const auto result = check::run_check(request);
  for (const FamilyCount& count : sums(result.of<check::FamilyChecker>().counts())) {
    EXPECT_EQ(count.cases, 30);
    EXPECT_GT(count.missed, 0);
    EXPECT_GT(count.right, 0);
    EXPECT_EQ(count.missed, count.contacts);
    EXPECT_EQ(count.false_hits + count.inexact + count.failed + count.gave_up, 0);
  }
  EXPECT_THAT(result.ours_wrong(), Each(HasSubstr("missed")));
  EXPECT_GE(result.ours_wrong().size(), 5u);
  EXPECT_THAT(check::page_text(result, "touchstone check"), HasSubstr("## Moving bodies"));
  EXPECT_THAT(check::summary_text(result, 120), HasSubstr("planted double contact"));
}

TEST_F(FamilyCheck, ContactsThatAreNoneAreFalse) {
  const PlantedKinds<Habit::yes> planted{.origin = Origin::peer};
  const auto request = request_for(planted.contestants());
  const auto result = check::run_check(request);
  const auto all = sums(result.of<check::FamilyChecker>().counts());
  for (const FamilyCount& count : all) {
    EXPECT_GT(count.false_hits, 0);
    EXPECT_EQ(count.false_hits + count.near, count.cases - count.contacts - count.unresolved);
    EXPECT_EQ(count.missed, 0);
  }
  // A hit that is told at time 0 is too early.
  EXPECT_GT(all[3].inexact, 0);
  EXPECT_THAT(result.ours_wrong(), IsEmpty());
}

TEST_F(FamilyCheck, GivingUpIsHonestAndCrashesAreLost) {
  const PlantedKinds<Habit::gives_up> shy;
  const auto shy_result = check::run_check(request_for(shy.contestants()));
  for (const FamilyCount& count : sums(shy_result.of<check::FamilyChecker>().counts())) {
    EXPECT_EQ(count.gave_up, count.cases);
  }
  EXPECT_THAT(shy_result.ours_wrong(), IsEmpty());
  const PlantedKinds<Habit::crashes> bad;
  auto request = request_for(bad.contestants());
  request.cases = 5;
  const auto result = check::run_check(request);
  for (const FamilyCount& count : sums(result.of<check::FamilyChecker>().counts())) {
    EXPECT_EQ(count.failed, count.cases);
  }
  EXPECT_THAT(result.ours_wrong(), Each(HasSubstr("failed")));
}

// The first wrong case of each kind is in a file that shows it again.
TEST_F(FamilyCheck, CaseFilesHaveTheCase) {
  const PlantedKinds<Habit::no> planted;
  const auto request = request_for(planted.contestants());
  const auto result = check::run_check(request);
  const std::filesystem::path failures = request.out / "failures";
  int concave = 0, casts = 0, ccd = 0, meshes = 0, scenes = 0;
  for (const auto& file : std::filesystem::directory_iterator(failures)) {
    const std::string name = file.path().filename().string();
    if (name.ends_with(".off")) {
      EXPECT_FALSE(geometry::read_mesh(file.path()).triangles.empty());
      ++meshes;
    } else if (name.ends_with(".toml")) {
      EXPECT_GT(scene::load_scene(file.path()).bodies.size(), 10u);
      ++scenes;
    } else if (name.starts_with("mesh")) {
      const auto cases = files::read_concave_cases(file.path());
      ASSERT_EQ(cases.size(), 1u);
      EXPECT_TRUE(cases[0].a.mesh && cases[0].b.mesh);
      EXPECT_THAT(cases[0].id, HasSubstr("triangles-generic/"));
      ++concave;
    } else if (name.starts_with("cast")) {
      const auto cases = files::read_cast_cases(file.path());
      ASSERT_EQ(cases.size(), 1u);
      EXPECT_FALSE(cases[0].motion_b.displacement.isZero(0));
      ++casts;
    } else if (name.starts_with("feature")) {
      const auto queries = files::read_ccd_queries(file.path());
      ASSERT_EQ(queries.queries.size(), 1u);
      EXPECT_EQ(queries.contacts[0], 1);
      EXPECT_EQ(queries.rounded, 0u);
      ++ccd;
    }
  }
  EXPECT_GE(std::min({concave, casts, ccd, meshes, scenes}), 1);
}

TEST_F(FamilyCheck, GoesOnWhereItWasStopped) {
  const PlantedKinds<Habit::no> planted;
  auto request = request_for(planted.contestants());
  request.families.resize(2);
  check::run_check(request);
  const std::string whole = folder.read("out/families.csv");
  // As if it had been stopped in its second job.
  const std::size_t second = whole.find("\n" + request.families[1]->name + ",") + 1;
  stop_folder(folder.path() / "out", 1,
              {{"grades.csv", folder.read("out/grades.csv").size()},
               {"variants.csv", folder.read("out/variants.csv").size()},
               {"jobs.csv", folder.read("out/jobs.csv").size()},
               {"families.csv", second}});
  folder.write("out/families.csv", whole.substr(0, second + 20));
  request.resume = true;
  const auto result = check::run_check(request);
  EXPECT_EQ(folder.read("out/families.csv"), whole);
  EXPECT_EQ(sums(result.of<check::FamilyChecker>().counts())[1].cases, 30);
}

TEST_F(FamilyCheck, CountsOfThousands) {
  const PlantedKinds<Habit::no> planted;
  auto request = request_for(planted.contestants(), check::CheckMode::count);
  request.count = 7000;
  const check::CheckReport result = check::run_check(request);
  EXPECT_EQ(result.jobs, 7);
  for (const FamilyCount& count : sums(result.of<check::FamilyChecker>().counts())) {
    EXPECT_EQ(count.cases, 1000);
    EXPECT_GT(count.missed, 0);
    EXPECT_GT(count.right, 0);
  }
  EXPECT_THAT(result.ours_wrong(), Not(IsEmpty()));
  EXPECT_THAT(check::summary_text(result, 120), Not(HasSubstr("Only ")));
}

TEST_F(FamilyCheck, CountsThatAreTooSmallSaySo) {
  const PlantedKinds<Habit::no> planted;
  auto request = request_for(planted.contestants(), check::CheckMode::count);
  request.count = 500;
  const std::string text = check::summary_text(check::run_check(request), 120);
  EXPECT_THAT(text, HasSubstr("Only 1 of 7 regimes and families were asked, each 1000 "
                              "cases; --count 7000 asks all."));
  EXPECT_THAT(text, HasSubstr("Bodies that need not be convex"));
  EXPECT_THAT(text, Not(HasSubstr("Points")));
}

TEST(CaseFamilies, TheExactAnswersAgreeInEveryForm) {
  std::map<const kinds::Kind*, std::int64_t> contacts, apart;
  std::map<kinds::CaseForm, std::int64_t> asked;
  const std::array scalars = {Precision::float64};
  for (const kinds::Family* family : kinds::case_families()) {
    if (family->one_in > 4) continue;                   // enclosures, which take long
    if (family->kind == &kinds::pair_kind()) continue;  // its regimes have a checker of their own
    const auto batch = family->kind->draw(*family, {3, 0, static_cast<std::size_t>(drawn(8, 6))});
    for (const kinds::Contestant& exact : family->kind->contestants({"exact"}, scalars)) {
      for (const kinds::CaseForm form : kinds::all_case_forms) {
        FamilyCount count;
        const auto grades = batch->ask(exact, form, 20);
        for (std::size_t i = 0; i < grades.size(); ++i) {
          count.add(grades[i], static_cast<std::int64_t>(i));
        }
        EXPECT_EQ(count.silent() + count.failed, 0) << family->name << " " << exact.name() << " "
                                                    << to_string(form) << " " << count.first_wrong;
        asked[form] += count.cases;
        const kinds::Kind* kind = family->kind;
        contacts[kind] += count.contacts;
        apart[kind] += count.cases - count.contacts;
      }
    }
  }
  for (const kinds::Kind* kind : kinds::kinds()) {
    EXPECT_GT(contacts[kind], 20);
    EXPECT_GT(apart[kind], 20);
  }
  for (const kinds::CaseForm form : kinds::all_case_forms)
    EXPECT_GT(asked[form], 20) << to_string(form);
}

TEST(CaseFamilies, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const kinds::Family* family : kinds::case_families()) {
    EXPECT_TRUE(names.insert(family->name).second) << family->name;
    EXPECT_EQ(family->name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789+-"),
              std::string::npos)
        << family->name;
  }
}

// Boxes have no cases to count and no axes, which is told where they are named.
TEST(SelectCases, BoxesAreNotLeftOutSilently) {
  for (const check::CheckMode mode : {check::CheckMode::axes, check::CheckMode::count}) {
    check::CheckRequest request(mode);
    check::CaseSelection selection;
    check::select_cases(selection, "", request);
    const auto is_box = [](const kinds::Contestant& one) { return one.kind == &kinds::box_kind(); };
    EXPECT_TRUE(std::ranges::none_of(request.contestants, is_box));
    selection.with = "naive,gjk";
    check::select_cases(selection, "", request);
    const check::CheckReport report(request);
    EXPECT_THAT(check::summary_text(report, 120), HasSubstr("Not asked: 1 of the kind box"));
  }
}

TEST(SelectCases, WhatIsNamedAloneIsTaken) {
  check::CheckRequest request;
  check::select_cases({}, "", request);
  std::set<const kinds::Kind*> asked;
  for (const kinds::Contestant& one : request.contestants) asked.insert(one.kind);
  EXPECT_EQ(asked.size(), kinds::checked_kinds().size());
  EXPECT_EQ(request.families.size(), kinds::case_families().size());
  check::CaseSelection casts;
  casts.of_one[&kinds::cast_kind()] = "gjk-ray-cast";
  check::select_cases(casts, "", request);
  EXPECT_FALSE(request.contestants.empty());
  for (const kinds::Contestant& one : request.contestants) {
    EXPECT_EQ(one.info->name, "gjk-ray-cast");
  }
  for (const kinds::Family* family : request.families) EXPECT_EQ(family->kind, &kinds::cast_kind());
  casts.groups = "turns";
  check::select_cases(casts, "", request);
  for (const kinds::Family* family : request.families) EXPECT_EQ(family->group, "turns");
  casts.groups = "rays";
  EXPECT_THAT(input_fault([&] { check::select_cases(casts, "", request); }),
              HasSubstr("no algorithm that is named takes cases of these regimes"));
  casts.groups = "what";
  EXPECT_THAT(input_fault([&] { check::select_cases(casts, "", request); }),
              HasSubstr("no group of regimes is called 'what'"));
}

}  // namespace
}  // namespace touchstone
