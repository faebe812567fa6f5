// The R-tree of libspatialindex (Debian: libspatialindex-dev) as a broad phase: a module that wraps a library.
// It bulk-loads a tree of all boxes in each frame, and asks it for the partners of each.
#include <spatialindex/SpatialIndex.h>
#include <touchstone_module.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace {

using SpatialIndex::IData;
using SpatialIndex::Region;
using SpatialIndex::RTree::Data;

Region region_of(const TouchstoneModuleBox& box) {
  const double low[] = {box.min[0], box.min[1], box.min[2]};
  const double high[] = {box.max[0], box.max[1], box.max[2]};
  return {low, high, 3};
}

bool is_empty(const TouchstoneModuleBox& box) { return box.min[0] > box.max[0]; }

// The boxes of a frame, for the bulk loader.
class Boxes final : public SpatialIndex::IDataStream {
 public:
  Boxes(const TouchstoneModuleBox* boxes, std::size_t count) : boxes_(boxes), count_(count) {
    rewind();
  }

  IData* getNext() override {
    if (!hasNext()) return nullptr;
    Region region = region_of(boxes_[at_]);
    auto data = std::make_unique<Data>(0, nullptr, region, static_cast<SpatialIndex::id_type>(at_));
    ++at_;
    skip_empty();
    return data.release();  // the loader's
  }
  bool hasNext() override { return at_ < count_; }
  std::uint32_t size() override { return static_cast<std::uint32_t>(count_); }
  void rewind() override {
    at_ = 0;
    skip_empty();
  }

 private:
  void skip_empty() {
    while (at_ < count_ && is_empty(boxes_[at_])) ++at_;
  }

  const TouchstoneModuleBox* boxes_;
  std::size_t count_, at_ = 0;
};

// Keeps the partners that come after the box that asks.
class Partners final : public SpatialIndex::IVisitor {
 public:
  explicit Partners(TouchstoneModuleSink& sink) : sink_(sink) {}
  void ask_for(std::uint32_t box) { box_ = box; }
  void visitNode(const SpatialIndex::INode& /*node*/) override {}
  void visitData(const IData& data) override {
    const auto other = static_cast<std::uint32_t>(data.getIdentifier());
    if (other > box_) touchstone_module_push(&sink_, box_, other);
  }
  void visitData(std::vector<const IData*>& /*pair*/) override {}

 private:
  TouchstoneModuleSink& sink_;
  std::uint32_t box_ = 0;
};

class Tree {
 public:
  void build(const TouchstoneModuleBox* boxes, std::size_t count) {
    boxes_ = boxes;
    count_ = count;
    tree_.reset();
    Boxes stream(boxes, count);
    if (!stream.hasNext()) return;  // the library wants a box at least
    storage_.reset(SpatialIndex::StorageManager::createNewMemoryStorageManager());
    SpatialIndex::id_type id = 0;
    tree_.reset(SpatialIndex::RTree::createAndBulkLoadNewRTree(SpatialIndex::RTree::BLM_STR, stream,
                                                               *storage_, 0.9, 32, 32, 3,
                                                               SpatialIndex::RTree::RV_RSTAR, id));
  }

  void find_pairs(TouchstoneModuleSink& sink) const {
    if (!tree_) return;
    Partners partners(sink);
    for (std::size_t i = 0; i < count_; ++i) {
      if (is_empty(boxes_[i])) continue;
      partners.ask_for(static_cast<std::uint32_t>(i));
      tree_->intersectsWithQuery(region_of(boxes_[i]), partners);
    }
  }

 private:
  const TouchstoneModuleBox* boxes_ = nullptr;
  std::size_t count_ = 0;
  std::unique_ptr<SpatialIndex::IStorageManager> storage_;
  std::unique_ptr<SpatialIndex::ISpatialIndex> tree_;  // ends before its storage
};

TouchstoneModuleBoxes table() {
  TouchstoneModuleBoxes made{};
  made.struct_size = sizeof made;
  made.name = "spatialindex-rtree";
  made.citation =
      "libspatialindex: RTree::createAndBulkLoadNewRTree (STR, R*) and intersectsWithQuery.";
  made.create = [](const TouchstoneModuleBoxSettings*) -> void* { return new Tree; };
  made.destroy = [](void* instance) { delete static_cast<Tree*>(instance); };
  made.build = [](void* instance, const TouchstoneModuleBox* boxes, std::size_t count) {
    static_cast<Tree*>(instance)->build(boxes, count);
  };
  made.find_pairs = [](void* instance, TouchstoneModuleSink* sink) -> std::uint32_t {
    static_cast<Tree*>(instance)->find_pairs(*sink);
    return TOUCHSTONE_MODULE_OK;
  };
  return made;
}

}  // namespace

const TouchstoneModule* touchstone_module(std::uint32_t abi) {
  static const TouchstoneModuleBoxes rtree = table();
  static const TouchstoneModuleBoxes* const boxes[] = {&rtree, nullptr};
  static const TouchstoneModule offer = [] {
    TouchstoneModule made{};
    made.struct_size = sizeof made;
    made.abi = TOUCHSTONE_MODULE_ABI;
    made.boxes = boxes;
    return made;
  }();
  return abi == TOUCHSTONE_MODULE_ABI ? &offer : nullptr;
}
