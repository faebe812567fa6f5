/* Pairs in C99: a distance with its witness points, a cast, and an error. */
#include <stdio.h>
#include <touchstone/touchstone.h>

int main(void) {
  touchstone_shape *box = NULL, *ball = NULL, *none = NULL;
  touchstone_solver* solver = NULL;
  touchstone_result result = TOUCHSTONE_RESULT_INIT;
  touchstone_cast_result cast = TOUCHSTONE_CAST_RESULT_INIT;
  const touchstone_pose origin = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  const touchstone_pose beside = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {3, 0, 0}};
  const touchstone_motion rest = {{0, 0, 0}, {0, 0, 0}}, left = {{-3, 0, 0}, {0, 0, 0}};
  if (touchstone_box(1, 1, 1, &box) || touchstone_sphere(0.5, &ball) ||
      touchstone_solver_create(NULL, &solver) ||
      touchstone_solver_ask(solver, TOUCHSTONE_DISTANCE, box, &origin, ball, &beside, &result) ||
      touchstone_solver_cast(solver, box, &origin, &rest, ball, &beside, &left, &cast)) {
    fprintf(stderr, "%s\n", touchstone_last_error());
    return 1;
  }
  printf("distance %.3f from x = %.3f to x = %.3f\n", result.distance, result.on_a[0],
         result.on_b[0]);
  printf("they touch at time %.3f\n", cast.time);
  if (touchstone_sphere(-1, &none) != TOUCHSTONE_INVALID) return 1;
  printf("%s\n", touchstone_last_error());
  touchstone_solver_destroy(solver);
  touchstone_shape_destroy(ball);
  touchstone_shape_destroy(box);
  return 0;
}
