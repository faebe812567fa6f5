// A module with one fault, which FAULT names. The tests compile it once for each: its headers are few, which takes less
// than half of the time.
// Without a fault it is right: a broad phase, `mine-boxes`, and a narrow phase of two spheres, `mine-spheres`. Faults of
// answers come with spheres whose centres are 4 m apart, those of boxes in frames of three boxes or more.
#include <pthread.h>
#include <touchstone_module.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#define TEXT_OF(word) #word
#define TEXT(word) TEXT_OF(word)

namespace {

bool fault_is(const char* name) { return std::strcmp(TEXT(FAULT), name) == 0; }

struct Thrown : std::exception {
  const char* what() const noexcept override { return "thrown by the module"; }
};

// Ends or stops the process in the way of the fault.
void misbehave(const char* where) {
  const auto is = [&](const char* what) {
    const std::size_t length = std::strlen(what);
    return std::strncmp(TEXT(FAULT), what, length) == 0 &&
           std::strcmp(TEXT(FAULT) + length, where) == 0;
  };
  if (is("throws")) throw Thrown();
  if (is("throws_number")) throw 1;
  if (is("crashes")) std::raise(SIGSEGV);
  if (is("exits")) std::exit(0);
  if (is("hangs")) {
    for (;;) sleep(1);
  }
  if (is("prints")) {
    std::printf("printed by the module\n");
    std::fflush(stdout);
  }
}

struct Spheres {
  const TouchstoneModuleShape* const* shapes = nullptr;
};

void solve(void* instance, const TouchstoneModulePairBatch* batch,
           TouchstoneModuleOutcome* outcomes) {
  const Spheres& mine = *static_cast<const Spheres*>(instance);
  for (std::size_t pair = 0; pair < batch->count; ++pair) {
    const auto a = batch->first[pair], b = batch->second[pair];
    const double* at_a = batch->poses[a].translation;
    const double* at_b = batch->poses[b].translation;
    const double radius_a = mine.shapes[batch->shape_of[a]]->radius;
    const double radius_b = mine.shapes[batch->shape_of[b]]->radius;
    const double between = std::hypot(at_b[0] - at_a[0], at_b[1] - at_a[1], at_b[2] - at_a[2]);
    const bool is_faulty = between == 4;
    if (is_faulty) misbehave("");
    TouchstoneModuleOutcome& out = outcomes[pair];
    touchstone_module_clear(&out);
    out.status = TOUCHSTONE_MODULE_OK;
    out.distance = between - radius_a - radius_b;
    out.answer = out.distance > 0 ? TOUCHSTONE_MODULE_SEPARATED : TOUCHSTONE_MODULE_OVERLAPPING;
    for (int i = 0; i < 3; ++i) {
      out.normal[i] = between > 0 ? (at_b[i] - at_a[i]) / between : (i == 0 ? 1 : 0);
      out.witness_a[i] = at_a[i] + radius_a * out.normal[i];
      out.witness_b[i] = at_b[i] - radius_b * out.normal[i];
    }
    if (fault_is("off")) out.distance += 1e-3 * (std::abs(out.distance) + radius_a + radius_b);
    if (is_faulty && fault_is("garbage")) out.answer = 77;
  }
}

struct Boxes {
  const TouchstoneModuleBox* boxes = nullptr;
  std::size_t count = 0;
};

std::uint32_t find_pairs(void* instance, TouchstoneModuleSink* sink) {
  const Boxes& mine = *static_cast<const Boxes*>(instance);
  const bool is_faulty = mine.count >= 3;
  if (is_faulty) misbehave("_boxes");
  if (is_faulty && fault_is("status")) return 77;
  bool has_dropped = false;
  for (std::uint32_t a = 0; a < mine.count; ++a) {
    for (std::uint32_t b = a + 1; b < mine.count; ++b) {
      const TouchstoneModuleBox &x = mine.boxes[a], &y = mine.boxes[b];
      bool overlap = true;
      for (int i = 0; i < 3; ++i) overlap = overlap && x.min[i] <= y.max[i] && y.min[i] <= x.max[i];
      if (!overlap) continue;
      if (fault_is("drops") && !has_dropped) {
        has_dropped = true;
        continue;
      }
      touchstone_module_push(sink, a, b);
    }
  }
  if (is_faulty && fault_is("wild")) touchstone_module_push(sink, 4000000000u, 4000000001u);
  return TOUCHSTONE_MODULE_OK;
}

TouchstoneModuleBoxes box_table() {
  TouchstoneModuleBoxes table{};
  table.struct_size = fault_is("small") ? 12 : fault_is("cut") ? sizeof table - 4 : sizeof table;
  table.name = fault_is("bad_name")     ? "My Boxes"
               : fault_is("group_name") ? "ours"
               : fault_is("taken")      ? "naive"
                                        : "mine-boxes";
  table.citation = fault_is("no_citation") ? nullptr : "a test";
  table.create = [](const TouchstoneModuleBoxSettings*) -> void* {
    return fault_is("no_instance") ? nullptr : new Boxes;
  };
  table.destroy = [](void* instance) { delete static_cast<Boxes*>(instance); };
  table.build = [](void* instance, const TouchstoneModuleBox* boxes, std::size_t count) {
    *static_cast<Boxes*>(instance) = {boxes, count};
  };
  if (!fault_is("null_function")) table.find_pairs = find_pairs;
  return table;
}

TouchstoneModulePairs pair_table() {
  TouchstoneModulePairs table{};
  table.struct_size = sizeof table;
  table.tasks = fault_is("bad_tasks") ? 64 : 15;
  table.scalars = TOUCHSTONE_MODULE_DOUBLE;
  table.name = "mine-spheres";
  table.citation = "a test";
  table.create = [](const TouchstoneModulePairSettings*) -> void* { return new Spheres; };
  table.destroy = [](void* instance) { delete static_cast<Spheres*>(instance); };
  table.supports = [](std::uint32_t a, std::uint32_t b, std::uint32_t) {
    misbehave("_at_supports");
    return a == TOUCHSTONE_MODULE_SPHERE && b == TOUCHSTONE_MODULE_SPHERE ? 1 : 0;
  };
  table.bind = [](void* instance, const TouchstoneModuleShape* const* shapes, std::size_t) {
    static_cast<Spheres*>(instance)->shapes = shapes;
  };
  table.solve = solve;
  return table;
}

[[gnu::constructor]] void at_load() { misbehave("_at_load"); }

}  // namespace

#if defined(WITHOUT_SYMBOL)
#define touchstone_module another_symbol
extern "C" const TouchstoneModule* another_symbol(std::uint32_t);
#endif

const TouchstoneModule* touchstone_module(std::uint32_t) {
  misbehave("_at_call");
  static const TouchstoneModuleBoxes of_boxes = box_table();
  static const TouchstoneModulePairs of_pairs = pair_table();
  static const TouchstoneModuleBoxes* const boxes[] = {&of_boxes, nullptr};
  static const TouchstoneModulePairs* const pairs[] = {&of_pairs, nullptr};
  static TouchstoneModule offer{};
  offer.struct_size = fault_is("tiny") ? 4 : sizeof offer;
  offer.abi = fault_is("wrong_version") ? 77 : TOUCHSTONE_MODULE_ABI;
  static const auto* const wild = reinterpret_cast<const TouchstoneModuleBoxes*>(16);
  if (!fault_is("empty")) {
    offer.boxes = fault_is("wild_table") ? &wild : boxes;
    offer.pairs = pairs;
  }
  if (fault_is("starts_thread")) {
    pthread_t started;
    pthread_create(
        &started, nullptr,
        [](void*) -> void* {
          for (;;) sleep(1);
        },
        nullptr);
  }
  return fault_is("no_offer") ? nullptr : &offer;
}
