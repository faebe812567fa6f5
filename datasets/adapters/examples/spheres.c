/* A peer that answers pairs of spheres by a closed form, and says how long it took where repeats are asked for. It is
   sent no other shapes, since it offers none, and reads the keys in the order in which they are sent. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static char line[1 << 20];

static double seconds(void) {
  struct timespec now;
  timespec_get(&now, TIME_UTC);
  return now.tv_sec + 1e-9 * now.tv_nsec;
}

static char *after(char *text, const char *key) { return strstr(text, key) + strlen(key); }

static char *read_sphere(char *at, double *radius, double centre[3]) {
  *radius = strtod(after(at, "\"radius\":"), NULL);
  at = after(at, "\"translation\":");
  for (int i = 0; i < 3; ++i) centre[i] = strtod(at + 1, &at); /* behind '[' or ',' */
  return at;
}

int main(void) {
  if (fgets(line, sizeof line, stdin) == NULL) return 1; /* what the program says of itself */
  puts("{\"protocol\":1,\"name\":\"spheres-in-c\",\"version\":\"1.0\",\"kinds\":{\"pair\":{\"shapes\":[\"sphere\"],"
       "\"tasks\":[\"intersect\",\"distance\",\"penetration\",\"signed\"]}}}");
  for (fflush(stdout); fgets(line, sizeof line, stdin) != NULL; fflush(stdout)) {
    double ra, rb, a[3], b[3], n[3] = {0, 0, 1};
    read_sphere(read_sphere(line, &ra, a), &rb, b);
    const double d[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, start = seconds();
    const long times = strstr(line, "\"repeat\":") != NULL ? strtol(after(line, "\"repeat\":"), NULL, 10) : 0;
    volatile double apart = hypot(hypot(d[0], d[1]), d[2]);
    for (long i = 1; i < times; ++i) apart = hypot(hypot(d[0], d[1]), d[2]);
    const double took = seconds() - start;
    for (int i = 0; apart > 0 && i < 3; ++i) n[i] = d[i] / apart;
    printf("{\"id\":\"%.16s\",\"status\":\"ok\",", after(line, "\"id\":\""));
    if (times > 0) printf("\"seconds\":%.9g,", took);
    printf("\"distance\":%.17g,\"normal\":[%.17g,%.17g,%.17g],", apart - (ra + rb), n[0], n[1], n[2]);
    printf("\"a\":[%.17g,%.17g,%.17g],", a[0] + ra * n[0], a[1] + ra * n[1], a[2] + ra * n[2]);
    printf("\"b\":[%.17g,%.17g,%.17g]}\n", b[0] - rb * n[0], b[1] - rb * n[1], b[2] - rb * n[2]);
  }
  return 0;
}
