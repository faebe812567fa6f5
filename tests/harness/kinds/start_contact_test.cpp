// Tests how casts are graded from a touch at the start, and turning bodies in the forms that round them.
#include <gtest/gtest.h>

#include "harness/kinds/kind.h"
#include "tests/algorithms/one_in.h"
#include "tests/harness/kinds/planted_kinds.h"

namespace touchstone {
namespace {

using FamilyCount = kinds::GradeCount;
using kinds::CaseForm;
using kinds::Contestant;

FamilyCount count_of(const char* name, const kinds::Contestant& contestant, kinds::CaseForm form,
                     int cases) {
  FamilyCount count;
  for (const kinds::Family* family : kinds::case_families()) {
    if (family->name != name) continue;
    const auto batch = family->kind->draw(*family, {7, 0, static_cast<std::size_t>(cases)});
    const auto grades = batch->ask(contestant, form, 20);
    for (std::size_t i = 0; i < grades.size(); ++i) {
      count.add(grades[i], static_cast<std::int64_t>(i));
    }
  }
  return count;
}

kinds::Contestant cast_of(const CastEntry& entry, StartContact start) {
  return kinds::contestant_of(kinds::cast_kind(), entry, true, Precision::float64,
                              static_cast<std::uint8_t>(start));
}

// No tolerance hides a hit of bodies that rest, slide or part.
TEST(StartContact, AWrongVerdictFromATouchIsSeen) {
  const int cases = drawn(160, 40);
  PlantedKinds<Habit::yes> yes;
  yes.cast.approach = true;
  const FamilyCount all_hits =
      count_of("casts-from-touch", cast_of(yes.cast, StartContact::approach),
               kinds::CaseForm::as_drawn, cases);
  EXPECT_EQ(all_hits.near, 0);
  EXPECT_GT(all_hits.false_hits, cases / 3);
  EXPECT_GT(all_hits.right, cases / 20);
  PlantedKinds<Habit::no> no;
  no.cast.approach = true;
  const FamilyCount all_misses =
      count_of("casts-from-touch", cast_of(no.cast, StartContact::approach),
               kinds::CaseForm::as_drawn, cases);
  // Some touch later alone, where a hit at the start is wrong too.
  EXPECT_EQ(all_misses.missed, all_hits.right + all_hits.inexact);
  EXPECT_EQ(all_misses.right, all_hits.false_hits);
  EXPECT_EQ(all_misses.unresolved, 0);
}

TEST(StartContact, OursTellWhatBodiesDoAfterATouch) {
  for (const char* name : {"gjk-ray-cast", "gjk-ray-cast-lanes", "mpr-ray-cast", "exact"}) {
    for (const kinds::CaseForm form :
         {kinds::CaseForm::as_drawn, kinds::CaseForm::swapped, kinds::CaseForm::scaled}) {
      const FamilyCount count = count_of(
          "casts-from-touch", cast_of(*registry::find<CastEntry>(name), StartContact::approach),
          form, drawn(160, 40));
      EXPECT_GT(count.cases, drawn(16, 4)) << name;
      EXPECT_EQ(count.right, count.cases) << name << " " << to_string(form);
    }
  }
}

TEST(TurningForms, AreAskedBackwardAndInHalves) {
  for (const kinds::CaseForm form : {kinds::CaseForm::reversed, kinds::CaseForm::split}) {
    for (const char* name : {"turns-half-a-radian", "turns-tangential", "turns-from-touch"}) {
      const int cases = drawn(40, 20);
      const auto rigid =
          cast_of(*registry::find<CastEntry>("rigid-advancement"), StartContact::counts);
      const FamilyCount count = count_of(name, rigid, form, cases);
      EXPECT_EQ(count.cases, cases / 5) << name;
      EXPECT_EQ(count.silent(), 0) << name << " " << to_string(form) << " " << count.first_wrong;
    }
    // A planted one that always hits is wrong in these forms too.
    PlantedKinds<Habit::yes> yes;
    const FamilyCount count =
        count_of("turns-needle", cast_of(yes.cast, StartContact::counts), form, drawn(40, 20));
    EXPECT_GT(count.silent(), 0) << to_string(form);
  }
}

}  // namespace
}  // namespace touchstone
