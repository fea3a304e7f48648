// What CasADi's inverse dynamics takes, compiled with the file that `casadi_arm.py` has written.
//
// Prints a line `inverse nanoseconds`: the median of rounds over random states.

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include GENERATED

enum { STATES = 64, REPEATS = 400, ROUNDS = 21 };

static double now(void) {
  struct timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

static int order(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static double states[STATES][3][AXES];

int main(void) {
  srand(1);
  for (int state = 0; state < STATES; ++state)
    for (int k = 0; k < 3 * AXES; ++k)
      states[state][k / AXES][k % AXES] = 2.0 * rand() / RAND_MAX - 1.0;
  double times[ROUNDS], torques[AXES], sum = 0.0;
  // The first round warms up.
  for (int round = -1; round < ROUNDS; ++round) {
    const double start = now();
    for (int repeat = 0; repeat < REPEATS; ++repeat)
      for (int state = 0; state < STATES; ++state) {
        const casadi_real *in[] = {states[state][0], states[state][1], states[state][2]};
        casadi_real *out[] = {torques};
        inverse(in, out, 0, 0, 0);
        sum += torques[0];
      }
    if (round >= 0)
      times[round] = (now() - start) / (REPEATS * STATES);
  }
  qsort(times, ROUNDS, sizeof *times, order);
  printf("inverse %.2f\n", times[ROUNDS / 2]);
  return sum == 0.123;
}
