// Touchstone's C++ interface: collision queries of convex bodies, and worlds of bodies.
//
//   #include <touchstone/touchstone.hpp>
//   touchstone::Body a{touchstone::Shape::box({1, 1, 1}), {}};
//   touchstone::Body b{touchstone::Shape::sphere(0.5), touchstone::Pose::at({3, 0, 0})};
//   double gap = touchstone::distance(a, b).distance;  // 1.5
//
// Units:     metres and radians. Times of motions and rays have no unit: they are parts of a motion, and
//            lengths of a ray's direction.
// Frames:    a shape has coordinates of its own; a pose takes them to the world. Answers are in the world.
// Errors:    wrong arguments throw touchstone::Error and change nothing: NaN, infinity, a negative size, a name
//            that no algorithm has, a handle of a body that was removed. What an algorithm cannot answer is no
//            error: the result has a status and the answer `unknown`. std::bad_alloc may come from any call that
//            is not noexcept.
// Threads:   a Shape may be used by many threads at once. A Solver or a World is used by one thread at a
//            time; different ones share nothing. Free functions may be called by any threads.
// Lifetime:  everything is a value. What is copied or kept holds the shape's data as long as it needs it. What was
//            moved from can be assigned to or destroyed; its other functions throw.
// Versions:  names are in the inline namespace v1. A release that breaks it has another one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#ifndef TOUCHSTONE_API
#define TOUCHSTONE_API __attribute__((visibility("default")))
#endif
// Touchstone's own sources have other types of these names in the namespace touchstone.
#ifndef TOUCHSTONE_NAMESPACE_V1
#define TOUCHSTONE_NAMESPACE_V1 inline namespace v1
#endif

namespace touchstone {
TOUCHSTONE_NAMESPACE_V1 {
  class TOUCHSTONE_API Error : public std::runtime_error {
   public:
    explicit Error(const std::string& message);
    Error(const Error&) noexcept;
    ~Error() override;
  };

  // Returns "0.1.0" or alike: that of the library that runs.
  TOUCHSTONE_API const char* version() noexcept;

  struct Vec3 {
    double x = 0, y = 0, z = 0;
  };

  // Maps a body's coordinates to the world's: p -> p.x * x_axis + p.y * y_axis + p.z * z_axis + translation. The axes
  // are the columns of the rotation matrix. They are taken as they are given: nothing makes them orthonormal.
  struct Pose {
    Vec3 x_axis = {1, 0, 0}, y_axis = {0, 1, 0}, z_axis = {0, 0, 1};
    Vec3 translation;  // metres

    static Pose at(const Vec3& translation) {
      return {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, translation};
    }
    // `rows` has the rotation matrix row by row.
    static Pose from_rows(const double (&rows)[9], const Vec3& translation) {
      return {{rows[0], rows[3], rows[6]},
              {rows[1], rows[4], rows[7]},
              {rows[2], rows[5], rows[8]},
              translation};
    }
    // The quaternion is normalised here. Throws if it is zero or not finite.
    TOUCHSTONE_API static Pose from_quaternion(double w, double x, double y, double z,
                                               const Vec3& translation);
  };

  // From time 0 to 1 a body moves by `displacement` and turns evenly about its origin: at time t its rotation is
  // exp(t * rotation_vector) times that of its pose. Both are in world axes, in metres and radians.
  struct Motion {
    Vec3 displacement, rotation_vector;
  };

  enum class Kind : std::uint8_t {
    sphere,
    capsule,
    box,
    cylinder,
    cone,
    ellipsoid,
    hull,
    halfspace
  };

  // A convex shape. It never changes, and a copy costs a counter: copies are one shape to all that prepares for it.
  // The functions that make one throw on sizes that are negative or not finite. Size zero is allowed.
  class TOUCHSTONE_API Shape {
   public:
    static Shape sphere(double radius);
    // Capsule, cylinder and cone lie along z, from -half_length to half_length. A capsule has a half ball beyond
    // both ends. A cone has its base at -half_length and its tip at half_length.
    static Shape capsule(double radius, double half_length);
    static Shape box(const Vec3& half_extents);
    static Shape cylinder(double radius, double half_length);
    static Shape cone(double radius, double half_length);
    static Shape ellipsoid(const Vec3& radii);
    // The convex hull of at least one point. They may lie in a plane, on a line or inside of the hull.
    static Shape hull(std::span<const Vec3> points);
    // All points p with normal . p <= offset. The normal is not zero and need not have unit length.
    static Shape halfspace(const Vec3& normal, double offset);

    Kind kind() const;
    // What the function of its kind was given, in its order, a vector as three numbers: {radius, half_length} of a
    // capsule. Of a hull the vertices, one behind the other; points that are none may be missing.
    std::vector<double> numbers() const;

    struct Data;  // Touchstone's own
    // Null after this shape was moved from.
    const Data* data() const noexcept { return data_.get(); }

   private:
    explicit Shape(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
    std::shared_ptr<const Data> data_;
  };

  struct Body {
    Shape shape;
    Pose pose;
  };

  enum class Answer : std::uint8_t {
    separated,    // no common point
    touching,     // common points and no common interior, as far as the bounds say
    overlapping,  // common interior points
    unknown,      // the status says why
  };

  enum class Status : std::uint8_t {
    ok,             // the algorithm stands by its answer
    not_converged,  // it ended before it was sure
    degenerate,     // the input is beyond what it can decide
    capacity,       // a fixed store was full
    unsupported,    // it does not take these kinds, or this question
  };

  // Numbers that were not asked for, or are not known, are NaN.
  struct Result {
    static constexpr double none = std::numeric_limits<double>::quiet_NaN();

    Answer answer = Answer::unknown;
    Status status = Status::unsupported;
    double distance = none;  // metres: > 0 the gap, < 0 minus the depth
    // Where the algorithm has bounds, the signed distance surely lies between these. `certified` and `exact` have
    // proven ones for whatever asks for a number; those of others allow for rounding as their authors know it.
    double lower = none, upper = none;
    // Unit vector from a to b. Overlapping: b moved by depth * normal is free of a.
    Vec3 normal{none, none, none};
    // Separated: the closest points. Overlapping: on_a - on_b = depth * normal.
    Vec3 on_a{none, none, none}, on_b{none, none, none};
    std::int32_t iterations = -1, support_calls = -1;  // -1: not counted

    // Closed bodies that touch share a point.
    bool shares_point() const {
      return answer == Answer::touching || answer == Answer::overlapping;
    }
  };

  enum class Question : std::uint8_t {
    intersect,        // the answer alone
    distance,         // and the distance, if separated
    penetration,      // and the depth, if overlapping
    signed_distance,  // and whichever of the two it is
  };

  enum class CastAnswer : std::uint8_t { hit, miss, unknown };

  struct CastResult {
    CastAnswer answer = CastAnswer::unknown;
    Status status = Status::unsupported;
    double time = Result::none;  // the first at which the bodies share a point, in [0, 1]
    double lower = Result::none,
           upper = Result::none;  // on that time, where the algorithm has bounds
    Vec3 normal{Result::none, Result::none, Result::none};  // unit vector from a to b at that time
    Vec3 point{Result::none, Result::none, Result::none};   // where they touch at that time
  };

  struct SolverOptions {
    // The name of one algorithm (algorithm_names("pair")). Empty: for each two kinds the one that Touchstone's tables
    // of times recommend, and `certified` for what that leaves open.
    std::string algorithm = {};
    std::string cast_algorithm =
        {};  // the same for casts (algorithm_names("cast")), without the second step
    // How far off a distance or depth may be, as a part of the size of the pair; without it, the algorithm's own.
    std::optional<double> tolerance = {};
    // Metres. Bodies further apart than this are `separated` without number, normal and points: an early end.
    std::optional<double> margin = {};
  };

  // Two bodies of a list, by their places.
  struct IndexPair {
    std::uint32_t a, b;
  };

  // Asks algorithms about pairs of bodies. Algorithms prepare each shape once, and a solver keeps what they prepared:
  //  - Shapes that `prepare` was given are prepared by an algorithm when it is first asked, all of them at once. From
  //    then on they cost a look into a table.
  //  - Another shape is prepared at the first call that meets it, and with it the others that were met so:
  //    microseconds. When more than 64 were met, all these are forgotten, and met again.
  // A call with shapes that its algorithm has prepared allocates no memory. It costs the algorithm's time, a look at each shape and a
  // copy of each pose.
  class TOUCHSTONE_API Solver {
   public:
    // Throws if there is no algorithm of that name, with all names.
    explicit Solver(const SolverOptions& options = {});
    ~Solver();
    Solver(Solver&&) noexcept;
    Solver& operator=(Solver&&) noexcept;

    // Keeps these shapes, in place of those of the last call, until the next call or the end. A pair of one of them and
    // of another shape counts as two other shapes.
    void prepare(std::span<const Shape> shapes);

    Result ask(Question question, const Shape& shape_a, const Pose& pose_a, const Shape& shape_b,
               const Pose& pose_b);
    Result ask(Question question, const Body& a, const Body& b) {
      return ask(question, a.shape, a.pose, b.shape, b.pose);
    }
    bool intersects(const Body& a, const Body& b);  // throws if the answer is unknown
    Result distance(const Body& a, const Body& b) { return ask(Question::distance, a, b); }
    Result penetration(const Body& a, const Body& b) { return ask(Question::penetration, a, b); }
    Result signed_distance(const Body& a, const Body& b) {
      return ask(Question::signed_distance, a, b);
    }

    // Answers pair i in results[i]. Many pairs of the same two kinds take vector instructions together, and so less
    // time each. `results` is as long as `pairs`.
    void ask(Question question, std::span<const Body> bodies, std::span<const IndexPair> pairs,
             std::span<Result> results);

    // When the bodies first touch. A miss is proven.
    CastResult cast(const Body& a, const Motion& motion_a, const Body& b, const Motion& motion_b);

   private:
    struct Parts;
    Parts& parts();
    std::unique_ptr<Parts> parts_;
  };

  // The same by a solver of the calling thread with the default options. It lives as long as the thread does.
  TOUCHSTONE_API bool intersects(const Body& a, const Body& b);
  TOUCHSTONE_API Result distance(const Body& a, const Body& b);
  TOUCHSTONE_API Result penetration(const Body& a, const Body& b);
  TOUCHSTONE_API Result signed_distance(const Body& a, const Body& b);
  TOUCHSTONE_API CastResult cast(const Body& a, const Motion& motion_a, const Body& b,
                                 const Motion& motion_b);

  // The exact answer about the bodies and its proof, which whoever multiplies fractions can verify: one line of JSON
  // in the format of results/certificates.md, without a line break. The bounds in it are on the distance of the
  // bodies without their balls. Tenths of a millisecond for simple bodies, more for hulls of many points.
  TOUCHSTONE_API std::string certificate(const Body& a, const Body& b);

  // Names for SolverOptions and WorldOptions. `kind` is "pair", "cast" or "box".
  TOUCHSTONE_API std::vector<std::string> algorithm_names(std::string_view kind);

  // Axis-aligned, closed: boxes that touch are a pair. min <= max.
  struct Box {
    Vec3 min, max;
  };

  // A body of a world. A handle of a removed body is never that of another.
  struct Handle {
    std::uint32_t slot = std::numeric_limits<std::uint32_t>::max();
    std::uint32_t generation = 0;
    friend bool operator==(const Handle&, const Handle&) = default;
  };

  struct HandlePair {
    Handle a, b;
  };

  // The points origin + t * direction, 0 <= t <= t_max.
  struct Ray {
    Vec3 origin, direction{1, 0, 0};  // the direction is not zero
    double t_max = std::numeric_limits<double>::infinity();
  };

  struct RayHit {
    bool hit = false;
    Status status = Status::unsupported;
    Handle body;
    double t = Result::none;  // in lengths of the direction; 0 if the ray begins in the body
    Vec3 normal{Result::none, Result::none,
                Result::none};  // unit vector towards the origin's side; NaN if t is 0
  };

  struct WorldOptions {
    std::string broad_phase = "auto";  // one of algorithm_names("box")
    int threads = 1;                   // that update and pairs may use, at least 1
  };

  // Bodies, and which of their boxes overlap. Boxes are rounded outward to floats, so a pair is never missed. Pairs
  // are those of the last `update`; rays meet the bodies where they are now.
  class TOUCHSTONE_API World {
   public:
    // Throws if there is no broad phase of that name, with all names.
    explicit World(const WorldOptions& options = {});
    ~World();
    World(World&&) noexcept;
    World& operator=(World&&) noexcept;

    // A body with a shape has the least box around it. One without is its box, and no ray meets it. A half-space
    // throws, since no box holds it: keep it beside the world. So does a box beyond the range of floats.
    Handle insert(const Shape& shape, const Pose& pose);
    Handle insert(const Box& box);
    void move(Handle body, const Pose& pose);
    void move(Handle body, const Box& box);
    void remove(Handle body);

    bool contains(Handle body) const noexcept;
    std::size_t size() const noexcept;
    // The shape and the newest pose, until the next call that is not const. Throws for a body without a shape.
    const Body& body(Handle body) const;

    void update();

    // Calls f(Handle, Handle) once for each pair of boxes that overlap, as of the last update. f may move bodies, which
    // changes no pair before the next update; it must not update, insert or remove.
    template <class F>
    void for_each_pair(F&& f) {
      const Pairs found = pairs();
      for (const std::span<const IndexPair> chunk : found.chunks) {
        for (const IndexPair& pair : chunk) {
          f(Handle{pair.a, found.generations[pair.a]}, Handle{pair.b, found.generations[pair.b]});
        }
      }
    }
    // The same as the broad phase writes it, until the next call that is not const, but for `move`.
    struct Pairs {
      std::span<const std::span<const IndexPair>> chunks;  // slots of handles
      const std::uint32_t* generations;                    // of each slot
    };
    Pairs pairs();

    struct Changes {
      std::span<const HandlePair> began, ended;
    };
    // The pairs that began and ended since the last call; at the first, all have begun. A pair of a removed body
    // ends. Whoever calls it once calls it after each update: slots of removed bodies wait until it said so. The lists are there until the next call that is not const.
    Changes changes();

    // The first body with a shape that the ray meets. Bodies are solid. While the matrix of one has no inverse, every ray
    // is `unsupported`. The first ray after bodies came or went costs a
    // build of a tree, and after bodies moved its refit.
    RayHit ray(const Ray& ray);
    void rays(std::span<const Ray> rays, std::span<RayHit> hits);  // of the same length

   private:
    struct Parts;
    Parts& parts();
    const Parts& parts() const;
    std::unique_ptr<Parts> parts_;
  };

}  // TOUCHSTONE_NAMESPACE_V1
}  // namespace touchstone
