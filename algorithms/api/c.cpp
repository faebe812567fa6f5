// The interface in C, on that in C++. No exception leaves it.
#include <touchstone/touchstone.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <new>
#include <string>
#include <touchstone/touchstone.hpp>
#include <vector>

namespace v1 = touchstone::v1;

struct touchstone_shape {
  v1::Shape shape;
};
struct touchstone_solver {
  v1::Solver solver;
};
struct touchstone_world {
  v1::World world;
};

namespace {

thread_local std::string last_error;

int fail(int code, const char* message) {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();
  }
  return code;
}

// Calls the function, whose exceptions become numbers.
template <class Function>
int guarded(const Function& function) noexcept {
  try {
    function();
    return TOUCHSTONE_OK;
  } catch (const v1::Error& error) {
    return fail(TOUCHSTONE_INVALID, error.what());
  } catch (const std::bad_alloc&) {
    return fail(TOUCHSTONE_NO_MEMORY, "there is not enough memory");
  } catch (const std::exception& error) {
    return fail(TOUCHSTONE_FAILED, error.what());
  } catch (...) {
    return fail(TOUCHSTONE_FAILED, "something was thrown that is no std::exception");
  }
}

template <class... Pointer>
void check_there(Pointer... pointers) {
  if ((!pointers || ...)) throw v1::Error("found NULL; expected a pointer to something");
}

v1::Vec3 vec(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }
void write(const v1::Vec3& v, double* numbers) {
  numbers[0] = v.x;
  numbers[1] = v.y;
  numbers[2] = v.z;
}

// Both are twelve doubles: the matrix column by column, then the translation.
static_assert(sizeof(v1::Pose) == sizeof(touchstone_pose));
const v1::Pose& pose_of(const touchstone_pose& pose) {
  return reinterpret_cast<const v1::Pose&>(pose);
}
v1::Motion motion_of(const touchstone_motion& motion) {
  return {vec(motion.displacement), vec(motion.rotation_vector)};
}

// The least size that a structure had in any version.
template <class Struct>
constexpr std::size_t first_size = sizeof(Struct);
template <>
constexpr std::size_t first_size<touchstone_result> = offsetof(touchstone_result, iterations);

template <class Struct>
void check_size(const Struct& given) {
  if (given.struct_size >= first_size<Struct>) return;
  throw v1::Error("found " + std::to_string(given.struct_size) +
                  " as struct_size; expected at least " + std::to_string(first_size<Struct>) +
                  ", as the structure's _INIT sets it");
}

// A result of today's size has that of C++ in it, which is written in place. The answer and the status are numbers of another
// width in the same eight bytes.
constexpr std::size_t inner_result = offsetof(touchstone_result, answer);
static_assert(inner_result + offsetof(v1::Result, distance) ==
                  offsetof(touchstone_result, distance) &&
              inner_result + offsetof(v1::Result, upper) == offsetof(touchstone_result, upper) &&
              inner_result + offsetof(v1::Result, normal) == offsetof(touchstone_result, normal) &&
              inner_result + offsetof(v1::Result, on_b) == offsetof(touchstone_result, on_b) &&
              inner_result + offsetof(v1::Result, support_calls) ==
                  offsetof(touchstone_result, support_calls) &&
              inner_result + sizeof(v1::Result) == sizeof(touchstone_result) &&
              offsetof(v1::Result, distance) == 2 * sizeof(std::int32_t));

void write_words(v1::Answer answer, v1::Status status, touchstone_result& result) {
  result.answer = static_cast<std::int32_t>(answer);
  result.status = static_cast<std::int32_t>(status);
}

template <class Make>
int make_shape(touchstone_shape** shape, const Make& make) {
  return guarded([&] {
    check_there(shape);
    *shape = nullptr;
    *shape = new touchstone_shape{make()};
  });
}

std::string text(const char* name) { return name == nullptr ? "" : name; }

v1::Box box_of(const double* box) { return {vec(box), vec(box + 3)}; }
v1::Handle handle_of(touchstone_handle handle) { return {handle.slot, handle.generation}; }
touchstone_handle handle_of(const v1::Handle& handle) { return {handle.slot, handle.generation}; }

}  // namespace

const char* touchstone_version() { return v1::version(); }
const char* touchstone_last_error() { return last_error.c_str(); }

int touchstone_pose_from_rows(const double* rows, const double* translation,
                              touchstone_pose* pose) {
  return guarded([&] {
    check_there(rows, translation, pose);
    for (int i = 0; i < 9; ++i) pose->rotation[3 * (i % 3) + i / 3] = rows[i];
    for (int i = 0; i < 3; ++i) pose->translation[i] = translation[i];
  });
}

int touchstone_pose_from_quaternion(double w, double x, double y, double z,
                                    const double* translation, touchstone_pose* pose) {
  return guarded([&] {
    check_there(translation, pose);
    const v1::Pose inner = v1::Pose::from_quaternion(w, x, y, z, vec(translation));
    std::memcpy(pose, static_cast<const void*>(&inner), sizeof inner);
  });
}

int touchstone_sphere(double radius, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::sphere(radius); });
}
int touchstone_capsule(double radius, double half_length, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::capsule(radius, half_length); });
}
int touchstone_box(double x, double y, double z, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::box({x, y, z}); });
}
int touchstone_cylinder(double radius, double half_length, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::cylinder(radius, half_length); });
}
int touchstone_cone(double radius, double half_length, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::cone(radius, half_length); });
}
int touchstone_ellipsoid(double x, double y, double z, touchstone_shape** shape) {
  return make_shape(shape, [&] { return v1::Shape::ellipsoid({x, y, z}); });
}
int touchstone_hull(const double* points, std::size_t count, touchstone_shape** shape) {
  return make_shape(shape, [&] {
    if (count != 0) check_there(points);
    std::vector<v1::Vec3> all;
    all.reserve(count);
    for (std::size_t i = 0; i < count; ++i) all.push_back(vec(points + 3 * i));
    return v1::Shape::hull(all);
  });
}
int touchstone_halfspace(const double* normal, double offset, touchstone_shape** shape) {
  return make_shape(shape, [&] {
    check_there(normal);
    return v1::Shape::halfspace(vec(normal), offset);
  });
}
void touchstone_shape_destroy(touchstone_shape* shape) { delete shape; }

int touchstone_solver_create(const touchstone_solver_options* options, touchstone_solver** solver) {
  return guarded([&] {
    check_there(solver);
    *solver = nullptr;
    v1::SolverOptions inner;
    if (options != nullptr) {
      check_size(*options);
      inner.algorithm = text(options->algorithm);
      inner.cast_algorithm = text(options->cast_algorithm);
      if (!(options->tolerance < 0)) inner.tolerance = options->tolerance;
      if (!(options->margin < 0)) inner.margin = options->margin;
    }
    *solver = new touchstone_solver{v1::Solver(inner)};
  });
}
void touchstone_solver_destroy(touchstone_solver* solver) { delete solver; }

int touchstone_solver_prepare(touchstone_solver* solver, const touchstone_shape* const* shapes,
                              std::size_t count) {
  return guarded([&] {
    check_there(solver);
    if (count != 0) check_there(shapes);
    std::vector<v1::Shape> all;
    all.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      check_there(shapes[i]);
      all.push_back(shapes[i]->shape);
    }
    solver->solver.prepare(all);
  });
}

int touchstone_solver_ask(touchstone_solver* solver, int question, const touchstone_shape* shape_a,
                          const touchstone_pose* pose_a, const touchstone_shape* shape_b,
                          const touchstone_pose* pose_b, touchstone_result* result) {
  return guarded([&] {
    check_there(solver, shape_a, pose_a, shape_b, pose_b, result);
    check_size(*result);
    if (question < TOUCHSTONE_INTERSECT || question > TOUCHSTONE_SIGNED_DISTANCE) [[unlikely]] {
      throw v1::Error("found the question " + std::to_string(question) + "; expected 0 to 3");
    }
    const auto ask = [&] {
      return solver->solver.ask(static_cast<v1::Question>(question), shape_a->shape,
                                pose_of(*pose_a), shape_b->shape, pose_of(*pose_b));
    };
    if (result->struct_size >= sizeof *result) [[likely]] {
      const auto* answer =
          new (reinterpret_cast<std::byte*>(result) + inner_result) v1::Result(ask());
      write_words(answer->answer, answer->status, *result);
    } else {
      const v1::Result answer = ask();
      std::memcpy(&result->distance, &answer.distance,
                  first_size<touchstone_result> - offsetof(touchstone_result, distance));
      write_words(answer.answer, answer.status, *result);
    }
  });
}

int touchstone_solver_cast(touchstone_solver* solver, const touchstone_shape* shape_a,
                           const touchstone_pose* pose_a, const touchstone_motion* motion_a,
                           const touchstone_shape* shape_b, const touchstone_pose* pose_b,
                           const touchstone_motion* motion_b, touchstone_cast_result* result) {
  return guarded([&] {
    check_there(solver, shape_a, pose_a, motion_a);
    check_there(shape_b, pose_b, motion_b, result);
    check_size(*result);
    const v1::CastResult answer =
        solver->solver.cast({shape_a->shape, pose_of(*pose_a)}, motion_of(*motion_a),
                            {shape_b->shape, pose_of(*pose_b)}, motion_of(*motion_b));
    result->answer = answer.answer == v1::CastAnswer::hit    ? TOUCHSTONE_TOUCHING
                     : answer.answer == v1::CastAnswer::miss ? TOUCHSTONE_SEPARATED
                                                             : TOUCHSTONE_UNKNOWN;
    result->status = static_cast<std::int32_t>(answer.status);
    result->time = answer.time;
    result->lower = answer.lower;
    result->upper = answer.upper;
    write(answer.normal, result->normal);
    write(answer.point, result->point);
  });
}

int touchstone_certificate(const touchstone_shape* shape_a, const touchstone_pose* pose_a,
                           const touchstone_shape* shape_b, const touchstone_pose* pose_b,
                           char** text) {
  return guarded([&] {
    check_there(shape_a, pose_a, shape_b, pose_b, text);
    *text = nullptr;
    const std::string proof =
        v1::certificate({shape_a->shape, pose_of(*pose_a)}, {shape_b->shape, pose_of(*pose_b)});
    *text = new char[proof.size() + 1];
    std::memcpy(*text, proof.c_str(), proof.size() + 1);
  });
}
void touchstone_text_destroy(char* text) { delete[] text; }

int touchstone_world_create(const touchstone_world_options* options, touchstone_world** world) {
  return guarded([&] {
    check_there(world);
    *world = nullptr;
    v1::WorldOptions inner;
    if (options != nullptr) {
      check_size(*options);
      if (options->broad_phase != nullptr) inner.broad_phase = options->broad_phase;
      inner.threads = options->threads;
    }
    *world = new touchstone_world{v1::World(inner)};
  });
}
void touchstone_world_destroy(touchstone_world* world) { delete world; }

int touchstone_world_insert(touchstone_world* world, const touchstone_shape* shape,
                            const touchstone_pose* pose, touchstone_handle* handle) {
  return guarded([&] {
    check_there(world, shape, pose, handle);
    *handle = handle_of(world->world.insert(shape->shape, pose_of(*pose)));
  });
}
int touchstone_world_insert_box(touchstone_world* world, const double* box,
                                touchstone_handle* handle) {
  return guarded([&] {
    check_there(world, box, handle);
    *handle = handle_of(world->world.insert(box_of(box)));
  });
}
int touchstone_world_move(touchstone_world* world, touchstone_handle body,
                          const touchstone_pose* pose) {
  return guarded([&] {
    check_there(world, pose);
    world->world.move(handle_of(body), pose_of(*pose));
  });
}
int touchstone_world_move_box(touchstone_world* world, touchstone_handle body, const double* box) {
  return guarded([&] {
    check_there(world, box);
    world->world.move(handle_of(body), box_of(box));
  });
}
int touchstone_world_remove(touchstone_world* world, touchstone_handle body) {
  return guarded([&] {
    check_there(world);
    world->world.remove(handle_of(body));
  });
}
int touchstone_world_update(touchstone_world* world) {
  return guarded([&] {
    check_there(world);
    world->world.update();
  });
}

int touchstone_world_for_each_pair(touchstone_world* world,
                                   int (*visit)(void* context, touchstone_handle a,
                                                touchstone_handle b),
                                   void* context) {
  return guarded([&] {
    check_there(world, visit);
    const v1::World::Pairs pairs = world->world.pairs();
    for (const auto chunk : pairs.chunks) {
      for (const v1::IndexPair& pair : chunk) {
        if (visit(context, {pair.a, pairs.generations[pair.a]},
                  {pair.b, pairs.generations[pair.b]}) != 0)
          return;
      }
    }
  });
}

int touchstone_world_for_each_change(touchstone_world* world,
                                     int (*visit)(void* context, int began, touchstone_handle a,
                                                  touchstone_handle b),
                                     void* context) {
  return guarded([&] {
    check_there(world, visit);
    const v1::World::Changes changes = world->world.changes();
    for (const auto& [pairs, began] : {std::pair(changes.began, 1), std::pair(changes.ended, 0)}) {
      for (const v1::HandlePair& pair : pairs) {
        if (visit(context, began, handle_of(pair.a), handle_of(pair.b)) != 0) return;
      }
    }
  });
}

int touchstone_world_ray(touchstone_world* world, const double* origin, const double* direction,
                         double t_max, touchstone_ray_hit* hit) {
  return guarded([&] {
    check_there(world, origin, direction, hit);
    check_size(*hit);
    const v1::RayHit found = world->world.ray({vec(origin), vec(direction), t_max});
    hit->hit = found.hit ? 1 : 0;
    hit->status = static_cast<std::int32_t>(found.status);
    hit->body = handle_of(found.body);
    hit->t = found.t;
    write(found.normal, hit->normal);
  });
}
