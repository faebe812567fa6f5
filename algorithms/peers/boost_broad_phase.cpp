// Boost.Geometry's R-tree, bulk-loaded and queried once with each of its boxes.
// Paper:   Guttman, "R-trees: a dynamic index structure for spatial searching", SIGMOD 1984; packed
//          as in Garcia, Lopez, Leutenegger, "A greedy algorithm for bulk loading R-trees", GIS
//          1998. Boost 1.74, geometry::index::rtree (A. Wulkiewicz) with linear<8>. Of the node
//          sizes 4, 8 and 16 it is the fastest, but for 4, which loads and queries as fast and
//          changes more slowly; the splitting rule makes no difference to a packed tree.
// Departs: the boxes are of floats, and Boost's `intersects` treats them as closed. The tree has no
//          query of all pairs: each box is a query, in the order of the tree, which uses the cache
//          better than the order of the ids, and a pair counts when the smaller id is the query's.
//          Bodies that moved, came or went are removed and inserted one by one, which makes the
//          tree worse, until a quarter as many have changed as there are bodies; then the tree is
//          loaded anew. (If few bodies move, a frame takes 0.8 to 0.93 of the time of one that
//          loads the tree; limits from a tenth to all of the bodies differ by a few hundredths.)
//          It is compiled without vector instructions beyond SSE2: with AVX2 or AVX-512, as our
//          kernels use them, it is no faster.
// Fails:   every pair is found twice, and every box finds itself.
// Cost:    O(n log n) to load, O(log n) to insert or remove; a query O(log n + its pairs) if boxes
//          are small.
#include "algorithms/broad_phase.h"
#ifdef TOUCHSTONE_HAS_BOOST
#define BOOST_ALLOW_DEPRECATED_HEADERS  // Boost's own headers include some and warn
#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>
#include <utility>

namespace touchstone {
namespace {

using Point = boost::geometry::model::point<float, 3, boost::geometry::cs::cartesian>;
using Box = boost::geometry::model::box<Point>;
using Value = std::pair<Box, std::uint32_t>;  // a box and its body's id
using Rtree = boost::geometry::index::rtree<Value, boost::geometry::index::linear<8>>;

Box to_boost(const Aabb& box) {
  return {Point(box.min[0], box.min[1], box.min[2]), Point(box.max[0], box.max[1], box.max[2])};
}

// True for the box of an empty slot.
bool is_empty(const Box& box) { return box.min_corner().get<0>() > box.max_corner().get<0>(); }

class BoostRtree final : public PeerBroadPhase {
 public:
  void build(std::span<const Aabb> boxes) override {
    boxes_.resize(boxes.size());
    values_.clear();
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      boxes_[id] = to_boost(boxes[id]);
      if (boxes[id].is_empty()) continue;
      values_.emplace_back(boxes_[id], id);
    }
    tree_ = Rtree(values_);
    changes_ = 0;
  }

  void update(const FrameChange& change) override {
    changes_ += change.moved.size() + change.inserted.size() + change.removed.size();
    if (4 * changes_ > boxes_.size()) return build(change.boxes);
    boxes_.resize(change.boxes.size());
    const auto insert = [&](std::uint32_t id) {
      boxes_[id] = to_boost(change.boxes[id]);
      tree_.insert(Value(boxes_[id], id));
    };
    for (const std::uint32_t id : change.removed) {
      tree_.remove(Value(boxes_[id], id));
      boxes_[id] = to_boost(Aabb::empty());
    }
    for (const std::uint32_t id : change.moved) {
      tree_.remove(Value(boxes_[id], id));
      insert(id);
    }
    for (const std::uint32_t id : change.inserted) insert(id);
  }

  Status find_pairs(PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    candidates_ = 0;
    for (const auto& [box, id] : tree_) {
      const auto take = [&, a = id](const Value& found) {
        ++candidates_;
        if (a < found.second) out.push(a, found.second);
      };
      tree_.query(boost::geometry::index::intersects(box),
                  boost::make_function_output_iterator(std::ref(take)));
    }
    return Status::ok;
  }

  // Queries for these bodies alone; a pair of two of them counts at the smaller id.
  Status find_pairs_of(std::span<const std::uint32_t> bodies, PairSink& sink) override {
    sink.start(1);
    PairBuffer& out = sink.chunk(0);
    asked_.set(bodies);
    for (const std::uint32_t a : bodies) {
      if (is_empty(boxes_[a])) continue;
      const auto take = [&](const Value& found) {
        const std::uint32_t b = found.second;
        if (a < b || (a > b && !asked_.has(b))) out.push(a, b);
      };
      tree_.query(boost::geometry::index::intersects(boxes_[a]),
                  boost::make_function_output_iterator(std::ref(take)));
    }
    return Status::ok;
  }

  void discard() override { tree_.clear(); }
  void prepare(std::size_t slots) override {
    boxes_.reserve(slots);
    values_.reserve(slots);
  }

  void convert(std::span<const Aabb> boxes) override {
    converted_.clear();
    for (std::uint32_t i = 0; i < boxes.size(); ++i) converted_.emplace_back(to_boost(boxes[i]), i);
  }

  BroadPhaseWork work() const override { return {.candidates = candidates_}; }

 private:
  std::vector<Box> boxes_;        // indexed by id, as in the tree
  std::vector<Value> values_;     // scratch
  std::vector<Value> converted_;  // scratch
  Rtree tree_;
  BodyMarks asked_;          // scratch
  std::size_t changes_ = 0;  // bodies changed since the tree was loaded
  std::int64_t candidates_ = 0;
};

std::unique_ptr<BroadPhase> make(Executor&) { return std::make_unique<BoostRtree>(); }

}  // namespace
}  // namespace touchstone
#else
#include "algorithms/peers/not_built.h"
using namespace touchstone::not_built;
#endif

namespace touchstone::entries {

std::vector<BroadPhaseEntry> peers_boost_broad_phase() {
  return {{.info = {.name = "boost-rtree",
                    .citation = "Boost.Geometry 1.74, index::rtree, linear<8>, packing constructor "
                                "(Guttman, SIGMOD 1984; Garcia, Lopez, Leutenegger, GIS 1998)",
                    .origin = Origin::peer},
           .make = make}};
}

}  // namespace touchstone::entries
