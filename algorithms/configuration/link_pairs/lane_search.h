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
    if (task == ConfigurationTask::distance || !is_bounded_) {
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
  static constexpr float unknown = -1;

  // --- bind ---

  void prepare(const ConfigurationModel& model) override {
    groups_ = LinkGroups(model_, model);
    const std::size_t links = model.links, parts = model.parts.size();
    balls_.assign(links + parts, LaneBall{});
    boxes_.clear();
    box_of_.assign(parts, 0);
    rows_.clear();
    pair_of_row_.clear();
    // What is rounded to floats is off by a part of this (metres): lanes tell only what holds by more.
    is_bounded_ = true;
    for (std::uint32_t part = 0; part < parts; ++part) {
      if (!std::isfinite(model_.bounds(part).radius) && model_.bounds(part).radius > 0) {
        is_bounded_ = false;
      }
    }
    if (!is_bounded_) return;
    reach_ = 0;
    for (const std::uint32_t part : groups_.world()) {
      const PartBounds& bounds = model_.bounds(part);
      reach_ = std::max(reach_, bounds.centre.norm() + bounds.radius);
      box_of_[part] = static_cast<std::uint32_t>(boxes_.size());
      boxes_.push_back(lane_box(bounds));
      set_all(balls_[links + part], bounds.centre);
    }
    for (const LinkGroup& link : groups_.links()) {
      reach_ = std::max(reach_, link.centre.norm() + link.radius);
    }
    for (std::uint32_t link = 0; link < links; ++link) {
      if (groups_.links()[link].parts.empty()) continue;
      for (const std::uint32_t part : groups_.world()) {
        if (!groups_.asks_link(link, part)) continue;
        rows_.push_back(
            {link, box_of_[part], true, static_cast<float>(groups_.links()[link].radius), unknown});
        pair_of_row_.push_back({link, part});
      }
    }
    for (std::uint32_t i = 0; i < groups_.pairs().size(); ++i) {
      const LinkPairs& pair = groups_.pairs()[i];
      rows_.push_back(
          {pair.a, pair.b, false,
           static_cast<float>(groups_.links()[pair.a].radius + groups_.links()[pair.b].radius),
           unknown});
      pair_of_row_.push_back({i, LaneRow::none});
    }
    widest_.resize(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) widest_[i] = rows_[i].may;
    placed_links_.assign(links, 0);
  }

  static LaneBox lane_box(const PartBounds& bounds) {
    LaneBox box;
    for (int i = 0; i < 3; ++i) {
      box.centre[static_cast<std::size_t>(i)] = static_cast<float>(bounds.centre[i]);
      box.half[static_cast<std::size_t>(i)] = static_cast<float>(bounds.half[i]);
      for (int k = 0; k < 3; ++k) {
        box.axes[static_cast<std::size_t>(3 * i + k)] = static_cast<float>(bounds.axes(k, i));
      }
    }
    box.is_level = bounds.axes == Mat3d::Identity();
    return box;
  }

  static void set(LaneBall& ball, std::size_t lane, const Vec3d& centre) {
    ball.x[lane] = static_cast<float>(centre.x());
    ball.y[lane] = static_cast<float>(centre.y());
    ball.z[lane] = static_cast<float>(centre.z());
  }
  static void set_all(LaneBall& ball, const Vec3d& centre) {
    for (std::size_t lane = 0; lane < pose_lanes; ++lane) set(ball, lane, centre);
  }

  // --- ask ---

  // The first step in contact, found block by block.
  ConfigurationAnswer first_of(const Configurations& all, std::size_t motion) {
    const std::span<const Pose> poses =
        all.poses.subspan(motion * all.steps * all.links, std::size_t{all.steps} * all.links);
    const Configurations steps = {poses, all.links, 1};
    std::array<ConfigurationAnswer, pose_lanes> block;
    bool is_known = true;
    ConfigurationAnswer found;
    for (std::size_t first = 0; first < all.steps; first += pose_lanes) {
      const std::size_t count = std::min<std::size_t>(pose_lanes, all.steps - first);
      find_block(steps, first, std::span(block).first(count));
      for (std::size_t i = 0; i < count; ++i) {
        found = block[i];
        is_known = is_known && found.answer != Answer::unknown;
        if (found.answer != Answer::overlapping) continue;
        found.step = static_cast<std::uint32_t>(first + i);
        if (!is_known) found.answer = Answer::unknown;
        return found;
      }
    }
    if (!is_known) found.answer = Answer::unknown;
    return found;
  }

  void find_block(const Configurations& all, std::size_t first,
                  std::span<ConfigurationAnswer> answers) {
    const std::size_t count = answers.size();
    double furthest = 0;
    for (const Pose& pose : all.poses.subspan(first * all.links, count * all.links)) {
      furthest = std::max(furthest, pose.translation.cwiseAbs().maxCoeff());
    }
    slack_ = static_cast<float>(0x1p-19 * (furthest + reach_));
    ++block_;
    for (std::uint32_t link = 0; link < all.links; ++link) {
      const LinkGroup& group = groups_.links()[link];
      if (group.parts.empty()) continue;
      for (std::size_t lane = 0; lane < count; ++lane) {
        set(balls_[link], lane, all.of(first + lane)[link](group.centre));
      }
    }
    for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].may = widest_[i] + slack_;
    hits_.clear();
    const auto every = static_cast<std::uint32_t>((std::uint64_t{1} << count) - 1);
    scan_rows(rows_, balls_, boxes_, every, hits_);
    list_parts(all, first, count);
    for (std::size_t lane = 0; lane < count; ++lane) {
      answers[lane] = ConfigurationAnswer{};
      answers[lane].answer = Answer::separated;
      answers[lane].status = Status::ok;
    }
    part_hits_.clear();
    std::uint32_t alive = scan_rows(part_rows_, balls_, boxes_, every, part_hits_);
    for (auto& list : near_) list.clear();
    for (const LaneHit& hit : part_hits_) {
      const IndexPair& pair = part_pairs_[hit.row];
      for (std::uint32_t lanes = hit.may & ~hit.sure; lanes != 0; lanes &= lanes - 1) {
        near_[static_cast<std::size_t>(std::countr_zero(lanes))].push_back(pair);
      }
      for (std::uint32_t lanes = hit.sure; lanes != 0; lanes &= lanes - 1) {
        ConfigurationAnswer& answer = answers[static_cast<std::size_t>(std::countr_zero(lanes))];
        answer.answer = Answer::overlapping;
        answer.pair = pair;
      }
    }
    for (; alive != 0; alive &= alive - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(alive));
      if (near_[lane].empty()) continue;
      asked_ = near_[lane];
      answers[lane] = find(all.of(first + lane));
    }
  }

  // The rows of the parts of links that may be near something.
  void list_parts(const Configurations& all, std::size_t first, std::size_t count) {
    part_rows_.clear();
    part_pairs_.clear();
    const auto links = static_cast<std::uint32_t>(groups_.links().size());
    const auto add = [&](std::uint32_t part, std::uint32_t other, bool is_box) {
      const PartBounds &one = model_.bounds(part), &two = model_.bounds(other);
      const double radius = one.radius + (is_box ? 0 : two.radius);
      const bool decides = one.is_ball && (is_box ? two.is_box : two.is_ball);
      part_rows_.push_back({links + part, is_box ? box_of_[other] : links + other, is_box,
                            static_cast<float>(radius) + slack_,
                            decides ? static_cast<float>(radius) - slack_ : unknown});
      part_pairs_.push_back({std::min(part, other), std::max(part, other)});
    };
    for (const LaneHit& hit : hits_) {
      const IndexPair& of = pair_of_row_[hit.row];
      if (of.b != LaneRow::none) {
        place_parts(of.a, all, first, count);
        for (const std::uint32_t part : groups_.links()[of.a].parts) {
          if (groups_.asks(part, of.b)) add(part, of.b, !model_.bounds(of.b).is_ball);
        }
        continue;
      }
      const LinkPairs& links_pair = groups_.pairs()[of.a];
      place_parts(links_pair.a, all, first, count);
      place_parts(links_pair.b, all, first, count);
      for (const IndexPair& pair : links_pair.pairs) add(pair.a, pair.b, false);
    }
  }

  void place_parts(std::uint32_t link, const Configurations& all, std::size_t first,
                   std::size_t count) {
    if (placed_links_[link] == block_) return;
    placed_links_[link] = block_;
    const std::size_t links = groups_.links().size();
    for (const std::uint32_t part : groups_.links()[link].parts) {
      const Vec3d& centre = model_.bounds(part).centre;
      for (std::size_t lane = 0; lane < count; ++lane) {
        set(balls_[links + part], lane, all.of(first + lane)[link](centre));
      }
    }
  }

  // Of the lane at hand the pairs that its balls left.
  IndexPair search(std::span<const Pose>) override {
    if (!is_bounded_) {
      for (const IndexPair& pair : model_.pairs()) {
        if (is_some(settle(pair))) return pair;
      }
      return nothing;
    }
    for (const IndexPair& pair : asked_) {
      if (is_some(settle(pair))) return pair;
    }
    return nothing;
  }

  LinkGroups groups_;
  bool is_bounded_ = true;
  double reach_ = 0;
  float slack_ = 0;
  // Of links by their numbers, and behind them those of parts; the world's stay.
  std::vector<LaneBall> balls_;
  std::vector<LaneBox> boxes_;
  std::vector<std::uint32_t> box_of_;  // by part of the world
  // Links with parts of the world, and link pairs; `pair_of_row_` has the link and the part, or the number of the pair.
  std::vector<LaneRow> rows_, part_rows_;
  std::vector<float> widest_;
  std::vector<IndexPair> pair_of_row_, part_pairs_;
  std::vector<LaneHit> hits_, part_hits_;
  std::uint64_t block_ = 0;
  std::vector<std::uint64_t> placed_links_;
  std::array<std::vector<IndexPair>, pose_lanes> near_;
  std::vector<IndexPair> asked_;
};

}  // namespace touchstone
