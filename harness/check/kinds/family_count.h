// Grades of answers to the cases of families, and their counts.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <string_view>

namespace touchstone::check {

// The same case in another form, which has the same exact answer. A form is asked where it is exact; turning
// casts are also reversed and split, where rounding may decide otherwise, and are then graded by that answer.
enum class CaseForm : std::uint8_t {
  as_drawn,
  swapped,   // the bodies, or features, in the other order
  scaled,    // all lengths times a power of two
  moved,     // by a rotation that permutes axes, and a translation that rounds nothing
  reversed,  // the motion, from its end to its start
  split,     // the motion, in two halves that are asked one after the other
};
inline constexpr std::array all_case_forms = {CaseForm::as_drawn, CaseForm::swapped,
                                              CaseForm::scaled,   CaseForm::moved,
                                              CaseForm::reversed, CaseForm::split};
std::string_view to_string(CaseForm form);

enum class CaseGrade : std::uint8_t {
  not_asked,   // it does not take such cases, or the form would round them
  unresolved,  // the exact answer is not known
  right,
  near,       // a contact where there is none, but the bodies come within the tolerance
  missed,     // no contact where there is one
  false_hit,  // a contact where there is none
  wrong,      // the side of contact is right, and a number, a pair, a triangle or a bound is not
  honest,     // it does not stand by its answer, or gives none
  lost,       // crashed, or no answer in time
};

struct GradedCase {
  CaseGrade grade = CaseGrade::not_asked;
  bool is_contact = false;  // the exact answer
};

// Counts of what one contestant answers to the cases of one family in one form.
struct FamilyCount {
  std::uint32_t family = 0, contestant = 0;  // places in the request
  std::uint64_t round = 0;
  CaseForm form{};
  std::int64_t cases = 0;     // that it was asked
  std::int64_t contacts = 0;  // of these, by the exact answer
  std::int64_t unresolved = 0, right = 0, near = 0, missed = 0, false_hits = 0, wrong = 0;
  std::int64_t honest = 0, lost = 0;
  std::int64_t first_wrong = -1;  // index of the first case that is missed, false or wrong, or lost

  void add(const GradedCase& graded, std::int64_t index);
  void add(const FamilyCount& other);
  // What nothing tells: missed, false or wrong.
  std::int64_t silent() const { return missed + false_hits + wrong; }
};

// The sums over all rounds.
struct FamilyCountKey {
  std::uint32_t contestant, family;
  CaseForm form;
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 sees a pointer in the comparison with 0
  friend auto operator<=>(const FamilyCountKey&, const FamilyCountKey&) = default;
};
using FamilyCounts = std::map<FamilyCountKey, FamilyCount>;
void add_to(FamilyCounts& sums, const FamilyCount& count);

}  // namespace touchstone::check
