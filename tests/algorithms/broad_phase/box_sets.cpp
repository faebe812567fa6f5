#include "tests/algorithms/broad_phase/box_sets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace touchstone {
namespace {

Aabb cube(float x, float y, float z, float side) {
  return {{x, y, z}, {x + side, y + side, z + side}};
}

std::vector<Aabb> shifted(std::vector<Aabb> boxes, float scale, float offset) {
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = box.min[axis] * scale + offset;
      box.max[axis] = box.max[axis] * scale + offset;
    }
  }
  return boxes;
}

std::vector<Aabb> clusters(Random& random) {
  std::vector<Aabb> boxes;
  for (int cluster = 0; cluster < 12; ++cluster) {
    const float spread = std::exp2(uniform(random, -10, -3));
    const float x = uniform(random, 0, 1), y = uniform(random, 0, 1), z = uniform(random, 0, 1);
    for (int i = 0; i < 70; ++i) {
      boxes.push_back(cube(x + uniform(random, 0, spread), y + uniform(random, 0, spread),
                           z + uniform(random, 0, spread), 0.15f * spread));
    }
  }
  return boxes;
}

// Around a corner, where they are denser and smaller by up to 2^depth.
std::vector<Aabb> ever_denser(Random& random, std::size_t count, float depth) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const float scale = std::exp2(-uniform(random, 0, depth));
    boxes.push_back(cube(scale * uniform(random, 0, 1), scale * uniform(random, 0, 1),
                         scale * uniform(random, 0, 1), 0.2f * scale));
  }
  return boxes;
}

// Most in a cluster that is `width` times narrower than the world where the others are, in that
// again a few hundred in one `width` times narrower, with sides to suit.
std::vector<Aabb> crowd_in_crowd(Random& random, float width, float side_outside) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 2000; ++i) {
    const float scale = i % 20 == 0 ? width * width : i % 5 == 0 ? 1 : width;
    const float side = (scale > width ? side_outside : 0.1f) * scale;
    boxes.push_back(cube(scale * uniform(random, 0, 1), scale * uniform(random, 0, 1),
                         scale * uniform(random, 0, 1), side * uniform(random, 0.5f, 1)));
  }
  return boxes;
}

// Thin plates one above the other, and such turned to the other axes.
std::vector<Aabb> piles_of_plates(Random& random) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 1800; ++i) {
    Aabb box =
        cube(uniform(random, 0, 0.1f), uniform(random, 0, 0.1f), uniform(random, 0, 0.1f), 10);
    const std::size_t axis = static_cast<std::size_t>(i) / 600;
    box.min[axis] = uniform(random, 0, 10) + 20 * static_cast<float>(axis);
    box.max[axis] = box.min[axis] + 0.02f;
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<Aabb> sizes_over_orders(Random& random, float orders) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 900; ++i) {
    const float side = 0.3f * std::pow(10.0f, -uniform(random, 0, orders));
    boxes.push_back(
        cube(uniform(random, 0, 1), uniform(random, 0, 1), uniform(random, 0, 1), side));
  }
  return boxes;
}

// Sides shrink to zero on the given axes.
std::vector<Aabb> flattened(std::vector<Aabb> boxes, std::size_t axes, bool same_place) {
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < axes; ++axis) {
      if (same_place) box.min[axis] = 0.5f;
      box.max[axis] = box.min[axis];
    }
  }
  return boxes;
}

// Unit cubes that touch their 26 neighbours exactly.
std::vector<Aabb> lattice(Random& random, int count) {
  std::vector<Aabb> boxes;
  for (int x = 0; x < count; ++x) {
    for (int y = 0; y < count; ++y) {
      for (int z = 0; z < count; ++z) {
        boxes.push_back(cube(static_cast<float>(x - count / 2), static_cast<float>(y - count / 2),
                             static_cast<float>(z - count / 2), 1));
      }
    }
  }
  std::ranges::shuffle(boxes, random);
  return boxes;
}

// Every extent is one of a few values, so that all kinds of ties come up.
std::vector<Aabb> from_values(Random& random, std::size_t count, std::vector<float> values) {
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float p = values[random() % values.size()];
      const float q = values[random() % values.size()];
      box.min[axis] = q < p ? q : p;
      box.max[axis] = q < p ? p : q;
    }
  }
  return boxes;
}

std::vector<Aabb> stacks(Random& random) {
  std::vector<Aabb> boxes;
  for (int stack = 0; stack < 8; ++stack) {
    const float x = uniform(random, 0, 50);
    for (int level = 0; level < 100; ++level) {
      boxes.push_back(cube(x, x, static_cast<float>(level), 1));
    }
  }
  return boxes;
}

std::vector<Aabb> with_giants(std::vector<Aabb> boxes, std::size_t every, float side) {
  for (std::size_t i = every / 2; i < boxes.size(); i += every) {
    boxes[i] = cube(-side / 2, -side / 2, -side / 2, side);
  }
  return boxes;
}

std::vector<Aabb> with_outliers(std::vector<Aabb> boxes, std::size_t every, float distance) {
  for (std::size_t i = every / 2; i < boxes.size(); i += every) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float shift = (i / every + axis) % 2 == 0 ? distance : -distance;
      boxes[i].min[axis] += shift;
      boxes[i].max[axis] += shift;
    }
  }
  return boxes;
}

std::vector<Aabb> with_empties(Random& random, std::vector<Aabb> boxes, float fraction) {
  for (Aabb& box : boxes) {
    if (uniform(random, 0, 1) < fraction) box = Aabb::empty();
  }
  return boxes;
}

std::vector<Aabb> nested(int count) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < count; ++i) {
    const float half = std::exp2(static_cast<float>(i % 200 - 100) * 0.25f);
    boxes.push_back({{-half, -half, -half}, {half, half, half}});
  }
  return boxes;
}

}  // namespace

float uniform(Random& random, float low, float high) {
  const auto unit = static_cast<float>(random() >> 40) * 0x1p-24f;
  return low + (high - low) * unit;
}

std::vector<Aabb> uniform_boxes(Random& random, std::size_t count, float side) {
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = uniform(random, 0, 1);
      box.max[axis] = box.min[axis] + uniform(random, 0.5f * side, side);
    }
  }
  return boxes;
}

std::vector<BoxSet> box_sets() {
  constexpr float largest = std::numeric_limits<float>::max();
  constexpr float smallest = std::numeric_limits<float>::denorm_min();
  Random random(20240229);
  std::vector<BoxSet> sets;
  const auto add = [&](std::string name, std::vector<Aabb> boxes) {
    sets.push_back({.name = std::move(name), .boxes = std::move(boxes)});
  };
  const auto add_degenerate = [&](std::string name, std::vector<Aabb> boxes) {
    sets.push_back({.name = std::move(name), .boxes = std::move(boxes), .degenerate = true});
  };
  const auto add_extreme = [&](std::string name, std::vector<Aabb> boxes) {
    sets.push_back(
        {.name = std::move(name), .boxes = std::move(boxes), .degenerate = true, .extreme = true});
  };

  for (const std::size_t count : {0, 1, 2, 15, 16, 17, 33}) {
    add("uniform " + std::to_string(count), uniform_boxes(random, count, 0.5f));
  }
  for (const float side : {0.01f, 0.05f, 0.12f, 0.4f}) {
    add("uniform, sides up to " + std::to_string(side), uniform_boxes(random, 1000, side));
  }
  add("clusters", clusters(random));
  add("ever denser", ever_denser(random, 1000, 30));
  add("dense cluster", with_outliers(shifted(uniform_boxes(random, 1000, 0.1f), 1e-4f, 0), 40, 1));
  add("a crowd in a crowd", crowd_in_crowd(random, 3e3f, 1e-5f));
  add("a crowd in a crowd among large ones", crowd_in_crowd(random, 1e2f, 0.2f));
  add("piles of plates", piles_of_plates(random));
  add("sizes over 3 orders", sizes_over_orders(random, 3));
  add("sizes over 6 orders", sizes_over_orders(random, 6));
  auto flat = uniform_boxes(random, 1000, 0.05f);
  for (Aabb& box : flat) {
    box.max[2] = 0.01f * box.min[2] + 0.05f;
    box.min[2] *= 0.01f;
  }
  add("flat", flat);
  add("one giant with dust", with_giants(uniform_boxes(random, 1000, 0.01f), 1000, 10));
  add("a giant in ten", with_giants(uniform_boxes(random, 500, 0.01f), 10, 3));
  add("half of the slots empty", with_empties(random, uniform_boxes(random, 1000, 0.1f), 0.5f));
  add("nearly all empty", with_empties(random, uniform_boxes(random, 1000, 0.9f), 0.99f));
  add("all empty", std::vector<Aabb>(40, Aabb::empty()));

  add_degenerate("stacks", stacks(random));
  add_degenerate("nested", nested(300));
  add_degenerate("coincident", std::vector<Aabb>(500, cube(1, 2, 3, 0.25f)));
  add_degenerate("touching lattice", lattice(random, 9));
  add_degenerate("no thickness", flattened(uniform_boxes(random, 1000, 0.2f), 1, false));
  add_degenerate("on a plane", flattened(uniform_boxes(random, 1000, 0.05f), 1, true));
  add_degenerate("on a line", flattened(uniform_boxes(random, 600, 0.01f), 2, true));
  add_degenerate("on a point", flattened(uniform_boxes(random, 200, 0.01f), 3, true));
  add_degenerate("points", flattened(uniform_boxes(random, 1000, 0.01f), 3, false));
  add_degenerate("points on a lattice",
                 flattened(from_values(random, 500, {0, 1, 2, 3, 4}), 3, false));
  add_degenerate("two points", {cube(0, 0, 0, 0), cube(0, 0, 0, 0)});
  add_degenerate("signed zeros", from_values(random, 400, {-1.0f, -0.0f, 0.0f, 1.0f}));
  add_degenerate("ties", from_values(random, 400, {-3, -2, -1, 0, 1, 2, 3, 10}));
  add_degenerate("at 1e7", shifted(uniform_boxes(random, 1000, 0.1f), 100, 1e7f));
  add_degenerate("coarse at 1e7", shifted(uniform_boxes(random, 400, 0.3f), 8, 1e7f));
  add_degenerate("at -1e7", shifted(uniform_boxes(random, 1000, 0.1f), 1000, -1e7f));
  add_degenerate("scale 1e-7", shifted(uniform_boxes(random, 1000, 0.1f), 1e-7f, 0));
  add_degenerate("scale 1e-7 at 1", shifted(uniform_boxes(random, 400, 0.3f), 1e-6f, 1));

  add_extreme("outliers", with_outliers(uniform_boxes(random, 1000, 0.1f), 100, 1e30f));
  add_extreme("many outliers", with_outliers(uniform_boxes(random, 1000, 0.1f), 5, 1e4f));
  add_extreme("giants and outliers",
              with_giants(with_outliers(uniform_boxes(random, 1000, 0.1f), 31, 1e5f), 50, 3e5f));
  add_extreme(
      "greatest floats",
      from_values(random, 400, {-largest, -3e38f, -1e38f, -1, -0.0f, 0, 1, 1e38f, 3e38f, largest}));
  add_extreme("scale 1e38", shifted(uniform_boxes(random, 800, 0.1f), 1e38f, -5e37f));
  add_extreme("smallest floats",
              from_values(random, 400, {-3 * smallest, -smallest, 0, smallest, 5 * smallest}));
  add_extreme("scale 1e-44", shifted(uniform_boxes(random, 500, 0.1f), 1e-43f, 0));
  add_extreme("all orders", from_values(random, 600,
                                        {-1e38f, -1e10f, -1, -1e-10f, -1e-38f, -0.0f, 0, 1e-38f,
                                         1e-10f, 1e-3f, 1, 1e3f, 1e10f, 1e38f}));
  return sets;
}

std::vector<IndexPair> sorted(const PairSink& sink) {
  std::vector<IndexPair> pairs = sink.gather();
  std::ranges::sort(pairs);
  return pairs;
}

std::vector<IndexPair> true_pairs(std::span<const Aabb> boxes) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
    }
  }
  return pairs;
}

}  // namespace touchstone
