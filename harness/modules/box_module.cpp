// A broad phase of a module.
#include "algorithms/registry.h"
#include "harness/modules/layouts.h"
#include "harness/modules/module_sink.h"
#include "harness/modules/table.h"

namespace touchstone::modules {
namespace {

TouchstoneModuleBoxSettings settings_of(Executor& executor) {
  return {.struct_size = sizeof(TouchstoneModuleBoxSettings),
          .threads = static_cast<std::uint32_t>(executor.width()),
          .run =
              [](void* host, std::size_t tasks,
                 void (*body)(void* data, std::size_t task, std::uint32_t worker), void* data) {
                static_cast<Executor*>(host)->run(tasks, [=](std::size_t task, int worker) {
                  body(data, task, static_cast<std::uint32_t>(worker));
                });
              },
          .host = &executor};
}

class BoxModule final : public BroadPhase {
 public:
  BoxModule(const Offer<TouchstoneModuleBoxes>& offer, Executor& executor)
      : instance_(offer, settings_of(executor)) {}

  void build(std::span<const Aabb> boxes) override {
    count_ = boxes.size();
    instance_.table().build(instance_.made(), theirs(boxes.data()), boxes.size());
  }

  void update(const FrameChange& change) override {
    if (instance_.table().update == nullptr) return build(change.boxes);
    count_ = change.boxes.size();
    const TouchstoneModuleFrame frame = {.struct_size = sizeof frame,
                                         .reserved = 0,
                                         .boxes = theirs(change.boxes.data()),
                                         .box_count = change.boxes.size(),
                                         .moved = change.moved.data(),
                                         .inserted = change.inserted.data(),
                                         .removed = change.removed.data(),
                                         .moved_count = change.moved.size(),
                                         .inserted_count = change.inserted.size(),
                                         .removed_count = change.removed.size()};
    instance_.table().update(instance_.made(), &frame);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    ModuleSink pairs(sink.chunk(0));
    const std::uint32_t status = instance_.table().find_pairs(instance_.made(), pairs.get());
    pairs.finish(instance_.name());
    if (status > most_status) {
      throw process::Garbage(
          fmt::format("{}: find_pairs returned {}; expected a status", instance_.name(), status));
    }
    // Whoever is handed the pairs looks up their bodies. One pass over numbers that were just written: a comparison each.
    std::uint32_t greatest = 0;
    for (const IndexPair& pair : sink.chunk(0).pairs()) {
      greatest = std::max({greatest, pair.a, pair.b});
    }
    if (greatest >= std::max<std::size_t>(count_, 1)) {
      throw process::Garbage(fmt::format("{}: found a pair with box {}; expected less than {}",
                                         instance_.name(), greatest, count_));
    }
    return static_cast<Status>(status);
  }

  void discard() override {
    if (instance_.table().discard != nullptr) instance_.table().discard(instance_.made());
  }

 private:
  Instance<TouchstoneModuleBoxes> instance_;
  std::size_t count_ = 0;  // boxes
};

}  // namespace

void add(Offer<TouchstoneModuleBoxes> offer, AlgorithmInfo info, TrialAnswers&) {
  expect_functions(*offer, {{"build", offer->table.build != nullptr},
                            {"find_pairs", offer->table.find_pairs != nullptr}});
  registry::add(BroadPhaseEntry{.info = std::move(info),
                                .make =
                                    [offer](Executor& executor) {
                                      return std::make_unique<BoxModule>(offer, executor);
                                    }},
                registry::Timed::yes, offer->object->file().string());
}

}  // namespace touchstone::modules
