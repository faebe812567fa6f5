// The registry: the words of the kinds, and what an entry offers.
#include "algorithms/registry.h"

namespace touchstone {
namespace {

template <class Value>
bool has(const std::vector<Value>& list, Value value) {
  return std::ranges::find(list, value) != list.end();
}

}  // namespace

std::optional<KindWords> registry::kind_named(std::string_view word) {
  std::optional<KindWords> found;
  if (word.empty()) return found;
  for_each_kind([&]<class Entry>() {
    const KindWords& kind = kind_words<Entry>;
    if (kind.word == word || std::ranges::find(kind.other, word) != kind.other.end()) found = kind;
  });
  return found;
}

bool offers(const NarrowPhaseEntry& entry, Task task) { return has(entry.tasks, task); }
bool offers(const NarrowPhaseEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task) {
  if (!offers(entry, task)) return false;
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b), task);
}

bool offers(const ManifoldEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const ManifoldEntry& entry, ShapeKind a, ShapeKind b) {
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b));
}

bool offers(const RayCastEntry& entry, RayTask task) { return has(entry.tasks, task); }
bool offers(const RayCastEntry& entry, Precision scalar) { return has(entry.scalars, scalar); }

bool offers(const ConcaveEntry& entry, ConcaveTask task, Precision scalar) {
  return has(entry.tasks, task) && has(entry.scalars, scalar);
}

bool offers(const CastEntry& entry, const CastSettings& settings) {
  return has(entry.scalars, settings.scalar) &&
         (settings.start == StartContact::counts || entry.approach);
}

bool offers(const CastEntry& entry, ShapeKind a, ShapeKind b, bool turns) {
  if (turns && !entry.rotation) return false;
  return entry.supports == nullptr || entry.supports(std::min(a, b), std::max(a, b), turns);
}

Encoding encoding_of(const NarrowPhaseEntry& entry, ShapeKind a, ShapeKind b, Task task,
                     Precision scalar) {
  if (entry.encoding == nullptr) return Encoding::as_given;
  return entry.encoding(std::min(a, b), std::max(a, b), task, scalar);
}

}  // namespace touchstone
