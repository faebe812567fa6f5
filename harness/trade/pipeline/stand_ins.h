// The proxies of a scene's bodies in a configuration, with a tree if they have several parts, and the bodies as mesh
// algorithms take them.
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

#include "algorithms/core/mesh/concave_body.h"
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
  bool plain = false;      // true for one part, in the body's own frame
  std::int64_t hulls = 0;  // the number built for it; those of the scene's own shapes do not count
  // Parts with the same tight box as all parts, in the body's frame; for one part that part.
  std::vector<proxies::Part> outline;
  // metres: radius of loose boxes, from the origin of the only part, or of the body
  double reach = 0;
};

// The representations of all bodies. Parts are numbered through: body k has the parts [first[k],
// first[k + 1]).
struct StandIns {
  std::vector<const StandIn*> of;  // one for each body
  std::vector<std::uint32_t> first;
  std::vector<Shape> shapes;            // distinct shapes, to which narrow phases are bound
  std::vector<std::uint32_t> shape_of;  // the index of each part's shape
  bool plain = true;                    // true if the parts of every body have its pose
  bool single = true;                   // true if every body has one part
  std::int64_t hulls = 0;
  // Pairs of kinds, kind_a <= kind_b, that two bodies of the scene can have.
  std::vector<std::pair<ShapeKind, ShapeKind>> kind_pairs;

 private:
  friend class StandInLibrary;
  std::vector<std::shared_ptr<const StandIn>> kept_;
};

// Makes each representation of each shape once, for all configurations that use it.
class StandInLibrary {
 public:
  // The frames outlive it. A representation is rejected if its making takes longer than `seconds`
  // for all bodies together.
  StandInLibrary(const SceneFrames& frames, Representing representing,
                 double seconds = std::numeric_limits<double>::infinity());

  // Completes representations: kinds of the scene without one become as_given, and kinds that the
  // scene does not have, or whose representation is the body itself, are removed. So
  // representations that mean the same for the scene are equal.
  Representations complete(Representations representations) const;
  // Takes complete representations, as the functions below do. Throws InputError if some body
  // cannot be represented so.
  std::shared_ptr<const StandIns> get(const Representations& representations);
  // Errors of the representations of all bodies, or of about 48, evenly picked; half-spaces, which
  // have no size, are left out, and so are bodies with a part so thin that the faces of its hull are
  // not known.
  std::vector<proxies::RepresentationError> errors(const Representations& representations);
  // The time to make them, in seconds.
  double seconds(const Representations& representations) const;
  // The number built so far, for all representations.
  std::int64_t hulls() const;

 private:
  struct Made {
    std::shared_ptr<const StandIn> stand_in;
    std::string fault;
    double seconds = 0;
    bool has_error = false;
    bool is_measured = true;  // false if its error cannot be measured
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

// For each shape of the scene: its mesh, a solid if that is closed, where the configuration
// represents it by `mesh` or leaves it as it is given; else a compound of its stand-in's parts. Shapes without a body are empty.
std::vector<ConcaveBody> whole_bodies(const SceneFrames& frames, const StandIns& stand_ins,
                                      const Configuration& configuration);

}  // namespace touchstone::trade
