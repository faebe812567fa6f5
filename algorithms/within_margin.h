// Gives the outcomes of bodies beyond the margin (NarrowPhaseSettings) the same form, whatever the
// algorithm knows of them. The registry alone includes this.
#pragma once

#include <memory>
#include <span>
#include <utility>

#include "algorithms/narrow_phase.h"

namespace touchstone {

// Another narrow phase, whose numbers beyond the margin it takes away. An algorithm with bounds is
// believed from its lower bound on, another from its distance on.
class WithinMargin final : public NarrowPhase {
 public:
  // `margin` is in metres.
  WithinMargin(std::unique_ptr<NarrowPhase> narrow_phase, double margin)
      : narrow_phase_(std::move(narrow_phase)), margin_(margin) {}

  void bind(std::span<const Shape> shapes) override { narrow_phase_->bind(shapes); }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    narrow_phase_->solve(task, batch, outcomes);
    for (std::size_t i = 0; i < batch.size(); ++i) cut(task, outcomes[i]);
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    narrow_phase_->solve_alone(task, batch, i, outcome);
    cut(task, outcome);
  }

 private:
  void cut(Task task, Outcome& outcome) const {
    if (!asks_distance(task) || outcome.answer != Answer::separated) return;
    const bool has_bounds = outcome.lower == outcome.lower;
    if (!((has_bounds ? outcome.lower : outcome.distance) > margin_)) return;
    const Status status = outcome.status;
    write_beyond(outcome.lower, outcome);
    if (!has_bounds) outcome.status = status;
  }

  std::unique_ptr<NarrowPhase> narrow_phase_;
  double margin_;
};

}  // namespace touchstone
