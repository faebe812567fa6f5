// Part of link-pairs: the tasks, for what searches one configuration for a pair in contact.
#pragma once

#include <algorithm>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "algorithms/configuration/link_pairs/bound_model.h"
#include "algorithms/configuration_query.h"

namespace touchstone {

class PairSearch : public ConfigurationQuery {
 public:
  explicit PairSearch(ConfigurationSettings settings) : settings_(std::move(settings)) {}

  void bind(const ConfigurationModel& model) override {
    model_.bind(model, settings_);
    hits_.assign(model.parts.size(), 0);
    last_ = nothing;
    prepare(model);
  }

  void solve(ConfigurationTask task, const Configurations& configurations,
             std::span<ConfigurationAnswer> answers) override {
    answer_steps(task, configurations, answers, [&](std::span<const Pose> links) {
      return task == ConfigurationTask::distance ? measure(links) : find(links);
    });
  }

 protected:
  // For what a model needs beside BoundModel.
  virtual void prepare(const ConfigurationModel& model) = 0;
  // Settles the pairs that may be in contact. Returns one that shares a point for certain, or none.
  virtual IndexPair search(std::span<const Pose> links) = 0;

  static constexpr IndexPair nothing = {ConfigurationAnswer::none, ConfigurationAnswer::none};
  static ConfigurationAnswer free_so_far() {
    ConfigurationAnswer answer;
    answer.answer = Answer::separated;
    answer.status = Status::ok;
    return answer;
  }
  static bool is_some(const IndexPair& pair) { return pair.a != ConfigurationAnswer::none; }

  // What one configuration is. The pair that was in contact last is asked first, and then those whose parts were most
  // often.
  ConfigurationAnswer find(std::span<const Pose> links) {
    ConfigurationAnswer found = free_so_far();
    model_.place(links);
    const IndexPair before = std::exchange(last_, nothing);
    bool was_apart = false;
    if (is_some(before)) {
      const Answer now = ask(before);
      if (now == Answer::overlapping) return in_contact(before, found);
      was_apart = now == Answer::separated;
    }
    open_.clear();
    const IndexPair sure = search(links);
    if (is_some(sure)) return in_contact(sure, found);
    if (open_.size() > 1) {
      std::ranges::stable_sort(open_, std::greater{}, [&](const IndexPair& pair) {
        return hits_[pair.a] + hits_[pair.b];
      });
    }
    for (const IndexPair& pair : open_) {
      if (was_apart && pair == before) continue;
      const BoundModel::Verdict verdict = model_.decide(pair);
      if (verdict.answer == Answer::overlapping) return in_contact(pair, found);
      if (verdict.answer == Answer::separated) continue;
      found.answer = Answer::unknown;
      found.status = verdict.status;
    }
    return found;
  }

  // Settles the pairs that bounds decide, and keeps others. Returns the first that shares a point for certain, or none.
  IndexPair settle(std::span<const IndexPair> pairs) {
    for (const IndexPair& pair : pairs) {
      const BoundModel::Bound bound = model_.bound(pair);
      if (bound == BoundModel::Bound::touch) return pair;
      if (bound == BoundModel::Bound::open) open_.push_back(pair);
    }
    return nothing;
  }

  BoundModel model_;
  std::vector<IndexPair> open_;

 private:
  Answer ask(const IndexPair& pair) {
    switch (model_.bound(pair)) {
      case BoundModel::Bound::apart: return Answer::separated;
      case BoundModel::Bound::touch: return Answer::overlapping;
      case BoundModel::Bound::open: break;
    }
    return model_.decide(pair).answer;
  }

  ConfigurationAnswer in_contact(const IndexPair& pair, ConfigurationAnswer& found) {
    ++hits_[pair.a];
    ++hits_[pair.b];
    last_ = pair;
    found.answer = Answer::overlapping;
    found.status = Status::ok;
    found.pair = pair;
    return found;
  }

  // Measures pairs in the order of their lower bounds, until these are beyond the least distance.
  ConfigurationAnswer measure(std::span<const Pose> links) {
    ConfigurationAnswer answer = free_so_far();
    model_.place(links);
    answer.distance = std::numeric_limits<double>::infinity();
    gaps_.clear();
    for (const IndexPair& pair : model_.pairs()) {
      const BoundModel::Gap gap = model_.gap(pair);
      // What is far from contact is exact up to rounding, and what is near it is asked.
      if (gap.is_exact && gap.least > 2 * model_.slack()) {
        take(pair, gap.least, answer);
      } else if (gap.least - model_.slack() < answer.distance) {
        gaps_.push_back({gap.least - model_.slack(), pair});
      }
    }
    std::ranges::make_heap(gaps_, std::greater{}, &Near::least);
    while (!gaps_.empty() && !(gaps_.front().least >= answer.distance)) {
      std::ranges::pop_heap(gaps_, std::greater{}, &Near::least);
      const IndexPair pair = gaps_.back().pair;
      gaps_.pop_back();
      const Outcome outcome = model_.measure(pair);
      if (outcome.answer == Answer::overlapping) {
        answer.answer = Answer::overlapping;
        answer.status = Status::ok;
        take(pair, 0, answer);
        return answer;
      }
      if (outcome.answer != Answer::separated || outcome.status != Status::ok) {
        answer.answer = Answer::unknown;
        answer.status = outcome.status;
      } else {
        take(pair, outcome.distance, answer);
      }
    }
    if (answer.answer == Answer::unknown) answer.distance = Outcome::none;
    return answer;
  }

  static void take(const IndexPair& pair, double distance, ConfigurationAnswer& answer) {
    if (distance >= answer.distance) return;
    answer.distance = distance;
    answer.pair = pair;
  }

  struct Near {
    double least;
    IndexPair pair;
  };

  ConfigurationSettings settings_;
  std::vector<std::uint32_t> hits_;  // by part: how often it was in contact
  IndexPair last_ = nothing;
  std::vector<Near> gaps_;
};

}  // namespace touchstone
