// What CasADi's functions take, compiled with the file that `casadi_arm.py` has written.
//
// Prints a line `quantity nanoseconds` for each round over random states. Functions of `angles` have
// sines and cosines inside; the others are given them.

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "clock.h"

#include GENERATED

enum { REPEATS = 100 };

typedef int function(const casadi_real **, casadi_real **, casadi_int *, casadi_real *, int);

// Angles, cosines and sines, rates, accelerations or torques.
static double angles[STATES][AXES], pairs[STATES][2 * AXES], rates[STATES][AXES],
    others[STATES][AXES];
static double results[3][AXES * AXES], sum;

static void measure(const char *name, function *evaluate, int of_angles) {
  // The first round warms up.
  for (int round = 0; round <= ROUNDS; ++round) {
    const double start = processor_time();
    for (int repeat = 0; repeat < REPEATS; ++repeat)
      for (int state = 0; state < STATES; ++state) {
        const casadi_real *in[] = {of_angles ? angles[state] : pairs[state], rates[state],
                                   others[state]};
        casadi_real *out[] = {results[0], results[1], results[2]};
        evaluate(in, out, 0, 0, 0);
        sum += results[0][0];
      }
    if (round > 0)
      printf("%s %.2f\n", name, (processor_time() - start) / (REPEATS * STATES));
  }
}

int main(void) {
  srand(1);
  for (int state = 0; state < STATES; ++state)
    for (int k = 0; k < AXES; ++k) {
      angles[state][k] = 2.0 * rand() / RAND_MAX - 1.0;
      rates[state][k] = 2.0 * rand() / RAND_MAX - 1.0;
      others[state][k] = 2.0 * rand() / RAND_MAX - 1.0;
      pairs[state][2 * k] = cos(angles[state][k]);
      pairs[state][2 * k + 1] = sin(angles[state][k]);
    }
  measure("mass", mass, 0);
  measure("mass-angles", mass_angles, 1);
  measure("inverse", inverse, 0);
  measure("inverse-angles", inverse_angles, 1);
  measure("forward", forward, 0);
  measure("forward-angles", forward_angles, 1);
  measure("linearise-angles", linearise_angles, 1);
  return sum == 0.123;
}
