// The representations of a scene's bodies in a configuration: parts, and a tree over them where
// there are several.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/trade/configuration.h"
#include "harness/trade/pipeline/part_tree.h"
#include "harness/trade/pipeline/scene_frames.h"

namespace touchstone::trade {

// The functions that represent bodies: those of harness/proxies, or a test's own.
struct Representing {
  std::function<std::vector<proxies::Part>(const Shape&, const geometry::Mesh*,
                                           const proxies::Representation&)>
      represent;
  std::function<proxies::RepresentationError(const Shape&, const geometry::Mesh*,
                                             const std::vector<proxies::Part>&)>
      error;
};

// The representation of the bodies of one shape.
struct StandIn {
  StandIn(std::vector<proxies::Part> from, const Shape& body);

  std::vector<proxies::Part> parts;
  PartTree tree;
  bool plain = false;      // one part, in the body's own frame
  std::int64_t hulls = 0;  // that were built for it: those of the scene's own shapes are not
  // Parts with the same tight box as all parts, in the body's frame; for one part that part.
  std::vector<proxies::Part> outline;
  double reach = 0;  // metres: of loose boxes, from the only part's origin, or the body's
};

// The representations of all bodies. Parts are numbered through: those of body k are
// [first[k], first[k + 1]).
struct StandIns {
  std::vector<const StandIn*> of;  // of each body
  std::vector<std::uint32_t> first;
  std::vector<Shape> shapes;            // distinct; what narrow phases are bound to
  std::vector<std::uint32_t> shape_of;  // of each part
  bool plain = true;                    // of every body: its parts are where it is
  bool single = true;                   // of every body: one part
  std::int64_t hulls = 0;
  // Pairs of kinds, kind_a <= kind_b, that two bodies of the scene can have.
  std::vector<std::pair<ShapeKind, ShapeKind>> kind_pairs;

 private:
  friend class StandInLibrary;
  std::vector<std::shared_ptr<const StandIn>> kept_;
};

// Makes each representation of each shape once, however many configurations have it.
class StandInLibrary {
 public:
  // The frames outlive it. A representation whose making takes longer than `seconds` for all bodies
  // together is none.
  StandInLibrary(const SceneFrames& frames, Representing representing,
                 double seconds = std::numeric_limits<double>::infinity());

  // The same with as_given for kinds that the scene has and that were left open, and without those
  // that it has not, or that are the body itself: those that mean the same for the scene are equal.
  Representations complete(Representations representations) const;
  // Of complete ones, as all below. Throws InputError where some body cannot be represented so.
  std::shared_ptr<const StandIns> get(const Representations& representations);
  // Errors of what stands for bodies: of all, or of about 48, evenly picked; half-spaces, which
  // have no size, are left out.
  std::vector<proxies::RepresentationError> errors(const Representations& representations);
  // Seconds that it took to make them.
  double seconds(const Representations& representations) const;
  // Built so far, for whatever was asked for.
  std::int64_t hulls() const;

 private:
  struct Made {
    std::shared_ptr<const StandIn> stand_in;
    std::string fault;
    double seconds = 0;
    bool has_error = false;
    proxies::RepresentationError error;
  };
  using Key = std::pair<std::uint32_t, std::string>;  // shape, representation
  proxies::Representation wanted(const Representations& representations, std::size_t body) const;
  Made& made(std::uint32_t shape, const proxies::Representation& representation);

  const SceneFrames* frames_;
  Representing representing_;
  double most_seconds_;
  std::map<Key, Made> made_;
  std::map<std::string, std::shared_ptr<const StandIns>> whole_;
};

}  // namespace touchstone::trade
