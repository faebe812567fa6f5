// Part of link-pairs: sixteen configurations at once, whose balls are compared in lanes first.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/configuration/link_pairs/ball_lanes.h"
#include "algorithms/configuration/link_pairs/link_groups.h"
#include "algorithms/configuration/link_pairs/pair_search.h"

namespace touchstone {

class PoseLanes final : public PairSearch {
 public:
  using PairSearch::PairSearch;

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    if (!is_bounded_) {
      PairSearch::solve(task, configurations, answers);
    } else if (task == ConfigurationTask::free) {
      for (std::size_t first = 0; first < answers.size(); first += pose_lanes) {
        const std::size_t count = std::min(pose_lanes, answers.size() - first);
        find_block(configurations, first, answers.subspan(first, count));
      }
    } else {
      for (std::size_t i = 0; i < answers.size(); ++i) answers[i] = first_of(configurations, i);
    }
  }

 private:
  // --- bind ---

  void prepare(const ConfigurationModel& model) override {
    groups_ = LinkGroups(model_, model);
    is_bounded_ = true;
    uses_lanes_ = false;
    for (const LinkGroup& link : groups_.links()) {
      is_bounded_ = is_bounded_ && std::isfinite(link.radius);
    }
    if (!is_bounded_) return;
    unbounded_.clear();
    for (const IndexPair& pair : model_.pairs()) {
      if (!is_bounded(pair.a) || !is_bounded(pair.b)) unbounded_.push_back(pair);
    }
    place_world(model.parts.size());
    number_balls();
    list_rows();
    lanes_of_links_.resize(model.links);
    placed_.assign(model.links, 0);
    block_ = 0;
  }

  bool is_bounded(std::uint32_t part) const { return std::isfinite(model_.bounds(part).radius); }

  void place_world(std::size_t parts) {
    reach_ = 0;
    boxes_.clear();
    world_place_.assign(parts, 0);
    for (const std::uint32_t part : groups_.world()) {
      if (!is_bounded(part)) continue;
      const PartBounds& bounds = model_.bounds(part);
      reach_ = std::max(reach_, bounds.centre.norm() + bounds.radius);
      world_place_[part] = static_cast<std::uint32_t>(boxes_.size());
      LaneBox& box = boxes_.emplace_back();
      box.is_level = bounds.axes == Mat3d::Identity();
      box.centre = to_floats(bounds.centre);
      box.half = to_floats(bounds.half);
      for (int axis = 0; axis < 3; ++axis) {
        const auto along = to_floats(bounds.axes.col(axis));
        std::ranges::copy(along, box.axes.begin() + 3 * axis);
      }
    }
  }

  // The ball of a link comes first, and those of its parts behind it. Behind all links are the balls of the world.
  void number_balls() {
    centres_.clear();
    first_ball_.clear();
    ball_of_.assign(model_.parts(), 0);
    for (const LinkGroup& link : groups_.links()) {
      first_ball_.push_back(static_cast<std::uint32_t>(centres_.size()));
      centres_.push_back(to_floats(link.centre));
      reach_ = std::max(reach_, link.centre.norm() + link.radius);
      for (const std::uint32_t part : link.parts) {
        ball_of_[part] = static_cast<std::uint32_t>(centres_.size());
        centres_.push_back(to_floats(model_.bounds(part).centre));
      }
    }
    first_ball_.push_back(static_cast<std::uint32_t>(centres_.size()));
    balls_.assign(centres_.size() + groups_.world().size(), LaneBall{});
    for (const std::uint32_t part : groups_.world()) {
      if (!is_bounded(part)) continue;
      ball_of_[part] = static_cast<std::uint32_t>(centres_.size()) + world_place_[part];
      const auto centre = to_floats(model_.bounds(part).centre);
      LaneBall& ball = balls_[ball_of_[part]];
      ball.x.fill(centre[0]);
      ball.y.fill(centre[1]);
      ball.z.fill(centre[2]);
    }
  }

  // First those of whole links; then, for each of them, those of parts.
  void list_rows() {
    rows_.clear();
    pairs_.clear();
    link_of_row_.clear();
    const auto links = static_cast<std::uint32_t>(groups_.links().size());
    for (std::uint32_t link = 0; link < links; ++link) {
      if (groups_.links()[link].parts.empty()) continue;
      for (const std::uint32_t part : groups_.world()) {
        if (!is_bounded(part) || !groups_.asks_link(link, part)) continue;
        add_row(first_ball_[link], world_place_[part], true, groups_.links()[link].radius, false,
                {link, part});
        link_of_row_.push_back({link, link});
      }
    }
    const auto world_rows = static_cast<std::uint32_t>(rows_.size());
    for (const LinkPairs& pair : groups_.pairs()) {
      add_row(first_ball_[pair.a], first_ball_[pair.b], false,
              groups_.links()[pair.a].radius + groups_.links()[pair.b].radius, false,
              {pair.a, pair.b});
      link_of_row_.push_back({pair.a, pair.b});
    }
    roots_ = static_cast<std::uint32_t>(rows_.size());
    for (std::uint32_t row = 0; row < roots_; ++row) {
      const auto first = static_cast<std::uint32_t>(rows_.size());
      std::uint32_t last = 0;
      if (row < world_rows) {
        const auto [link, other] = pairs_[row];
        for (const std::uint32_t part : groups_.links()[link].parts) {
          if (groups_.asks(part, other)) add_parts(part, other, true);
        }
        last = static_cast<std::uint32_t>(rows_.size());
      } else {
        last = list_parts(groups_.pairs()[row - world_rows]);
      }
      rows_[row].first = first;
      rows_[row].last = last;
    }
  }

  // Each part of the first link with the ball of the second, and below it with the parts of that. Returns the end of the
  // first of these rows; those below them come behind.
  std::uint32_t list_parts(const LinkPairs& links) {
    std::vector<std::uint32_t> parts;
    for (const IndexPair& pair : links.pairs) parts.push_back(of_link(pair, links.a).first);
    std::ranges::sort(parts);
    parts.erase(std::ranges::unique(parts).begin(), parts.end());
    const auto first = static_cast<std::uint32_t>(rows_.size());
    for (const std::uint32_t part : parts) {
      add_row(ball_of_[part], first_ball_[links.b], false,
              model_.bounds(part).radius + groups_.links()[links.b].radius, false, {});
    }
    const auto last = static_cast<std::uint32_t>(rows_.size());
    for (std::uint32_t i = 0; i < parts.size(); ++i) {
      rows_[first + i].first = static_cast<std::uint32_t>(rows_.size());
      for (const IndexPair& pair : links.pairs) {
        const auto [one, other] = of_link(pair, links.a);
        if (one == parts[i]) add_parts(one, other, false);
      }
      rows_[first + i].last = static_cast<std::uint32_t>(rows_.size());
    }
    return last;
  }

  // The part of this link, and the other part.
  std::pair<std::uint32_t, std::uint32_t> of_link(const IndexPair& pair, std::uint32_t link) const {
    return model_.link_of(pair.a) == link ? std::pair(pair.a, pair.b) : std::pair(pair.b, pair.a);
  }

  void add_parts(std::uint32_t part, std::uint32_t other, bool of_world) {
    const PartBounds &one = model_.bounds(part), &two = model_.bounds(other);
    const bool is_box = of_world && !two.is_ball;
    const bool decides = one.is_ball && (is_box ? two.is_box : two.is_ball);
    add_row(ball_of_[part], is_box ? world_place_[other] : ball_of_[other], is_box,
            one.radius + (is_box ? 0 : two.radius), decides,
            {std::min(part, other), std::max(part, other)});
  }

  void add_row(std::uint32_t ball, std::uint32_t other, bool is_box, double reach, bool decides,
               const IndexPair& pair) {
    rows_.push_back({.ball = ball,
                     .other = other,
                     .reach = static_cast<float>(reach),
                     .is_box = is_box,
                     .decides = decides});
    pairs_.push_back(pair);
  }

  static std::array<float, 3> to_floats(const Vec3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }

  // --- ask ---

  // The first step that is not free, or not known to be, found block by block.
  ConfigurationAnswer first_of(const Configurations& all, std::size_t motion) {
    const std::span<const Pose> poses =
        all.poses.subspan(motion * all.steps * all.links, std::size_t{all.steps} * all.links);
    const Configurations steps = {poses, all.links, 1};
    std::array<ConfigurationAnswer, pose_lanes> block;
    ConfigurationAnswer found;
    for (std::size_t first = 0; first < all.steps; first += pose_lanes) {
      const std::size_t count = std::min<std::size_t>(pose_lanes, all.steps - first);
      find_block(steps, first, std::span(block).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        found = block[i];
        if (found.answer == Answer::separated) continue;
        found.step = static_cast<std::uint32_t>(first + i);
        return found;
      }
    }
    return found;
  }

  void find_block(const Configurations& all, std::size_t first,
                  std::span<ConfigurationAnswer> answers) {
    ++block_;
    uses_lanes_ = begin(all, first, answers.size());
    if (!uses_lanes_) {
      for (std::size_t lane = 0; lane < answers.size(); ++lane) {
        answers[lane] = find(all.of(first + lane));
      }
      return;
    }
    std::ranges::fill(answers, free_so_far());
    for (auto& list : near_) list.clear();
    sure_.clear();
    const auto every = static_cast<std::uint32_t>((std::uint64_t{1} << answers.size()) - 1);
    alive_ = every;
    descend(0, roots_, every, 0);
    for (const LaneHit& hit : sure_) {
      for (std::uint32_t lanes = hit.lanes; lanes != 0; lanes &= lanes - 1) {
        ConfigurationAnswer& answer = answers[static_cast<std::size_t>(std::countr_zero(lanes))];
        answer.answer = Answer::overlapping;
        answer.pair = pairs_[hit.row];
      }
    }
    for (std::uint32_t lanes = alive_; lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      if (near_[lane].empty() && unbounded_.empty()) continue;
      asked_ = near_[lane];
      asked_.insert(asked_.end(), unbounded_.begin(), unbounded_.end());
      answers[lane] = find(all.of(first + lane));
    }
  }

  // The poses of links as lanes of floats, and the balls of links. What is rounded to floats is off by less than the slack.
  // False if squares of floats may overflow or underflow.
  bool begin(const Configurations& all, std::size_t first, std::size_t count) {
    double furthest = 0, error = model_.orthonormal_error_of_parts();
    const std::span<const Pose> poses = all.poses.subspan(first * all.links, count * all.links);
    for (std::uint32_t link = 0; link < all.links; ++link) {
      if (groups_.links()[link].parts.empty()) continue;
      const PoseReach reach = spread_poses(&poses[link], all.links, count, lanes_of_links_[link]);
      furthest = std::max(furthest, reach.furthest);
      error = std::max(error, reach.error);
      place(link, 0, 1);
    }
    const double furthest_point = furthest + reach_;
    if (!(furthest_point > 1e-12 && furthest_point < 1e15)) return false;
    slack_ = static_cast<float>((0x1p-19 + slack_of_error * error) * furthest_point);
    return true;
  }

  // Places balls of a link: of itself, the first, and of its parts.
  void place(std::uint32_t link, std::uint32_t first, std::uint32_t count) {
    const std::uint32_t from = first_ball_[link] + first;
    place_balls(lanes_of_links_[link], std::span(centres_).subspan(from, count),
                std::span(balls_).subspan(from, count));
  }
  void place_parts(std::uint32_t link) {
    if (placed_[link] == block_) return;
    placed_[link] = block_;
    place(link, 1, first_ball_[link + 1] - first_ball_[link] - 1);
  }

  // Asks rows, and below those that may meet further ones in the lanes in which they may.
  void descend(std::uint32_t first, std::uint32_t last, std::uint32_t lanes, std::size_t depth) {
    std::vector<LaneHit>& hits = hits_[depth];
    hits.clear();
    const std::uint32_t left =
        scan_rows(rows_, first, last, balls_, boxes_, slack_, lanes, hits, sure_);
    alive_ &= ~(lanes & ~left);
    for (const LaneHit& hit : hits) {
      const LaneRow& row = rows_[hit.row];
      const std::uint32_t within = hit.lanes & alive_;
      if (within == 0) continue;
      if (row.first == row.last) {
        for (std::uint32_t rest = within; rest != 0; rest &= rest - 1) {
          near_[static_cast<std::size_t>(std::countr_zero(rest))].push_back(pairs_[hit.row]);
        }
        continue;
      }
      if (depth == 0) {
        place_parts(link_of_row_[hit.row].a);
        place_parts(link_of_row_[hit.row].b);
      }
      descend(row.first, row.last, within, depth + 1);
    }
  }

  // Of the lane at hand the pairs that its balls left.
  IndexPair search(std::span<const Pose>) override {
    return settle(uses_lanes_ ? std::span<const IndexPair>(asked_) : model_.pairs());
  }

  LinkGroups groups_;
  bool is_bounded_ = true;
  double reach_ = 0;
  std::vector<LaneBox> boxes_;                 // of the world
  std::vector<std::uint32_t> world_place_;     // by part: its place among them
  std::vector<std::array<float, 3>> centres_;  // of balls, in the frames of their links
  std::vector<std::uint32_t> first_ball_;      // by link, and behind the last one
  std::vector<std::uint32_t> ball_of_;         // by part
  std::vector<IndexPair> unbounded_;           // pairs with half-spaces, which no lane has
  std::vector<LaneRow> rows_;
  std::vector<IndexPair> pairs_;        // of rows that have none below them: the parts
  std::vector<IndexPair> link_of_row_;  // of the first rows: the links that they are of
  std::uint32_t roots_ = 0;             // the number of the first rows

  // Of the block at hand.
  std::uint64_t block_ = 0;
  std::vector<std::uint64_t> placed_;  // by link: the block in which its parts were placed
  std::vector<LanePose> lanes_of_links_;
  std::vector<LaneBall> balls_;
  bool uses_lanes_ = false;  // else the plain search is asked
  float slack_ = 0;
  std::uint32_t alive_ = 0;
  std::array<std::vector<LaneHit>, 3> hits_;
  std::vector<LaneHit> sure_;
  std::array<std::vector<IndexPair>, pose_lanes> near_;
  std::vector<IndexPair> asked_;
};

}  // namespace touchstone
