// Counts grades.
#include "harness/kinds/grade.h"

namespace touchstone::kinds {

void GradeCount::add(const Graded& graded, std::int64_t index) {
  if (graded.grade == Grade::not_asked) return;
  ++cases;
  contacts += graded.is_contact ? 1 : 0;
  bool is_bad = false;
  switch (graded.grade) {
    case Grade::not_asked: break;
    case Grade::unresolved: ++unresolved; break;
    case Grade::right: ++right; break;
    case Grade::near: ++near; break;
    case Grade::bound: ++bound; break;
    case Grade::gave_up: ++gave_up; break;
    case Grade::missed: ++missed, is_bad = true; break;
    case Grade::false_hit: ++false_hits, is_bad = true; break;
    case Grade::inexact: ++inexact, is_bad = true; break;
    case Grade::failed: ++failed, is_bad = true; break;
  }
  if (is_bad && first_wrong < 0) first_wrong = index;
}

void GradeCount::add(const GradeCount& other) {
  cases += other.cases;
  contacts += other.contacts;
  unresolved += other.unresolved;
  right += other.right;
  near += other.near;
  missed += other.missed;
  false_hits += other.false_hits;
  inexact += other.inexact;
  bound += other.bound;
  gave_up += other.gave_up;
  failed += other.failed;
  if (first_wrong < 0) first_wrong = other.first_wrong;
}

}  // namespace touchstone::kinds
