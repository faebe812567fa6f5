// Part of link-pairs: a bound model, where its parts are in a configuration, and what is known of a pair of them.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "algorithms/configuration_query.h"

namespace touchstone {

// A ball and a box around a part, in the frame of its link, or in the world.
struct PartBounds {
  Vec3d centre = Vec3d::Zero();  // of both
  double radius = 0;  // metres; infinite for a half-space, negative for a part without points
  Mat3d axes = Mat3d::Identity();
  Vec3d half = Vec3d::Zero();            // of the box, along its axes
  bool is_ball = false, is_box = false;  // the part is no less than that
  // Of a half-space: the points with normal . x <= offset, and the normal of unit length; else zero.
  Vec3d normal = Vec3d::Zero();
  double offset = 0;

  bool is_plane() const { return normal != Vec3d::Zero(); }
};

// Whether a distance, whose square is given, is more than `reach`. False where squares underflow, for it is not known.
inline bool is_beyond(double squared, double reach) {
  return squared > reach * reach && squared >= std::numeric_limits<double>::min();
}

// By so many times the orthonormal error and the reach, bounds of parts that are turned by such matrices are off, or less.
inline constexpr double slack_of_error = 64;

class BoundModel {
 public:
  // What bounds say of a pair: certain, whatever was rounded, but for `open`.
  enum class Bound : std::uint8_t { apart, touch, open };
  struct Verdict {
    Answer answer;
    Status status;
  };

  // `model` stays alive and unchanged.
  void bind(const ConfigurationModel& model, const ConfigurationSettings& settings);
  // The pairs of the model of which both parts have points.
  std::span<const IndexPair> pairs() const { return pairs_; }
  const PartBounds& bounds(std::uint32_t part) const { return bounds_[part]; }
  std::uint32_t link_of(std::uint32_t part) const { return model_->parts[part].link; }
  std::size_t parts() const { return bounds_.size(); }

  // Begins a configuration; the poses live until the next one.
  void place(std::span<const Pose> links);
  // The orthonormal error of the poses of parts; `place` adds that of the links.
  double orthonormal_error_of_parts() const { return error_of_parts_; }
  // By how much bounds are wider than they state, in this configuration (metres).
  double slack() const { return slack_; }
  const Vec3d& centre(std::uint32_t part) {
    if (placed_centres_[part] < now_) place_centre(part);
    return centres_[part];
  }

  bool balls_are_apart(std::uint32_t a, std::uint32_t b) {
    const double reach = bounds_[a].radius + bounds_[b].radius + slack_;
    return is_beyond((centre(a) - centre(b)).squaredNorm(), reach);
  }
  // Balls first, then boxes.
  Bound bound(const IndexPair& pair);
  // The distance is no less, but for the slack; and whether it is the distance up to rounding (metres).
  struct Gap {
    double least;
    bool is_exact;
  };
  Gap gap(const IndexPair& pair);

  // Asks the narrow phase, or the concave phase.
  Verdict decide(const IndexPair& pair);
  // Their distance too; 0 where they share a point.
  Outcome measure(const IndexPair& pair);

 private:
  void place_centre(std::uint32_t part);
  const Mat3d& axes(std::uint32_t part);
  const Pose& pose(std::uint32_t part);
  // How far a point is from the box around a part (metres), squared.
  double squared_gap_of_box(const Vec3d& point, std::uint32_t part);
  bool boxes_are_apart(std::uint32_t a, std::uint32_t b);
  // Whether a part is a half-space that stands still.
  bool is_ground(std::uint32_t part) const {
    return bounds_[part].is_plane() && link_of(part) == ModelPart::world;
  }
  // How far the ball around a part is above such a half-space (metres), negative if it reaches into it.
  double height(std::uint32_t part, std::uint32_t ground) {
    const PartBounds& plane = bounds_[ground];
    return plane.normal.dot(centre(part)) - plane.offset - bounds_[part].radius;
  }
  // An outcome is kept, and holds until a part of the pair moves.
  const Outcome& ask(Task task, const IndexPair& pair);
  void solve(Task task, const IndexPair& pair, Outcome& outcome);
  // The number of the configuration since which a part is where it is.
  std::uint64_t still_since(std::uint32_t part) const {
    return link_of(part) == ModelPart::world ? 0 : still_since_[link_of(part)];
  }

  const ConfigurationModel* model_ = nullptr;
  std::vector<IndexPair> pairs_;
  std::vector<PartBounds> bounds_;
  std::vector<char> is_convex_;
  std::vector<Shape> shapes_;  // one a part; without a meaning where it is not convex
  std::vector<ConcaveBody> bodies_;
  std::vector<std::uint32_t> own_number_;  // 0, 1, 2...
  std::unique_ptr<NarrowPhase> narrow_;
  std::unique_ptr<ConcavePhase> concave_;  // null if all parts are convex
  double error_of_parts_ = 0;
  double reach_ = 0;  // no part reaches further from its link, or the origin (metres)

  struct Known {
    std::uint64_t since = 0;  // the number of the configuration that was asked; 0: none was
    Outcome outcome;
  };
  std::vector<Pose> placed_links_;          // of the configuration before
  std::vector<std::uint64_t> still_since_;  // by link
  // By pair: the outcomes of pairs that stood still when they were asked.
  std::unordered_map<std::uint64_t, Known> known_of_contact_, known_of_distance_;

  // In this configuration, those whose number is `now_`; the world's have the greatest number.
  std::span<const Pose> links_;
  double slack_ = 0;
  bool is_rigid_ = true;  // all poses are rotations up to rounding
  std::uint64_t now_ = 0;
  std::vector<std::uint64_t> placed_centres_, placed_axes_, placed_poses_;
  std::vector<Vec3d> centres_;
  std::vector<Mat3d> axes_;
  std::vector<Pose> poses_;
  Outcome outcome_;
  std::vector<IndexPair> touching_;
};

}  // namespace touchstone
