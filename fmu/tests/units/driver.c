/* Calls a unit that was linked with it: co-simulation from bytes of a saved state, model exchange,
 * and what is to be refused. Writes the states and their derivatives. */
#include "fmi3Functions.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(what)                                                                                \
    do {                                                                                           \
        if (!(what)) {                                                                             \
            fprintf(stderr, "line %d: %s\n", __LINE__, #what);                                     \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

#define OK(call) CHECK((call) == fmi3OK)

static int messages = 0;

static void logged(
    fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment;
    CHECK(status != fmi3OK && category && message);
    ++messages;
}

/* A token, a count of steps and their length (s). */
int main(int count, char **arguments)
{
    CHECK(count == 4);
    const char *token = arguments[1];
    const int steps = atoi(arguments[2]);
    const double step = atof(arguments[3]);
    CHECK(!fmi3InstantiateModelExchange("a", "another", "", false, true, NULL, logged));
    CHECK(messages == 1);
    CHECK(strcmp(fmi3GetVersion(), "3.0") == 0);

    fmi3Instance cs = fmi3InstantiateCoSimulation(
        "a", token, "", false, true, false, false, NULL, 0, NULL, logged, NULL);
    CHECK(cs);
    OK(fmi3EnterInitializationMode(cs, false, 0.0, 0.0, false, 0.0));
    OK(fmi3ExitInitializationMode(cs));
    fmi3FMUState saved = NULL;
    size_t size = 0;
    OK(fmi3GetFMUState(cs, &saved));
    OK(fmi3SerializedFMUStateSize(cs, saved, &size));
    fmi3Byte *bytes = malloc(size);
    OK(fmi3SerializeFMUState(cs, saved, bytes, size));
    OK(fmi3FreeFMUState(cs, &saved));
    CHECK(!saved);
    for (int pass = 0; pass < 2; ++pass) {
        double time = 0.0;
        OK(fmi3DeserializeFMUState(cs, bytes, size, &saved));
        OK(fmi3SetFMUState(cs, saved));
        for (int k = 0; k < steps; ++k) {
            bool events, terminate, early;
            OK(fmi3DoStep(cs, time, step, true, &events, &terminate, &early, &time));
            CHECK(!events && !terminate && !early);
        }
    }
    OK(fmi3FreeFMUState(cs, &saved));
    free(bytes);
    bool flag;
    double last;
    CHECK(fmi3DoStep(cs, 0.0, step, true, &flag, &flag, &flag, &last) == fmi3Error);
    CHECK(messages == 2);

    /* Model exchange begins where co-simulation has ended. */
    fmi3Instance me = fmi3InstantiateModelExchange("b", token, "", false, false, NULL, logged);
    size_t states = 0, indicators = 1;
    OK(fmi3GetNumberOfContinuousStates(me, &states));
    OK(fmi3GetNumberOfEventIndicators(me, &indicators));
    CHECK(states > 0 && indicators == 0);
    double *x = malloc(2 * states * sizeof *x), *rates = x + states;
    OK(fmi3GetContinuousStates(cs, x, states));
    OK(fmi3EnterInitializationMode(me, false, 0.0, 0.0, false, 0.0));
    OK(fmi3ExitInitializationMode(me));
    OK(fmi3EnterContinuousTimeMode(me));
    OK(fmi3SetTime(me, steps * step));
    OK(fmi3SetContinuousStates(me, x, states));
    OK(fmi3GetContinuousStateDerivatives(me, rates, states));
    CHECK(fmi3GetContinuousStateDerivatives(me, rates, states + 1) == fmi3Error);
    const fmi3ValueReference time = 0, nobody = 100000, derivative = (unsigned)states + 1;
    double number = 1.0;
    OK(fmi3GetFloat64(me, &derivative, 1, &number, 1));
    CHECK(number == rates[0]);
    CHECK(fmi3SetFloat64(me, &time, 1, &number, 1) == fmi3Error);
    CHECK(fmi3GetFloat64(me, &nobody, 1, &number, 1) == fmi3Error);
    CHECK(fmi3SetInt32(me, &time, 1, NULL, 0) == fmi3Error);
    fwrite(x, sizeof *x, 2 * states, stdout);
    /* What is reset begins again. */
    OK(fmi3Reset(cs));
    OK(fmi3GetFloat64(cs, &time, 1, &number, 1));
    CHECK(number == 0.0);
    /* A state that is no number has no rates. */
    const double zero = 0.0;
    x[0] = 0.0 / zero;
    OK(fmi3SetContinuousStates(me, x, states));
    CHECK(fmi3GetContinuousStateDerivatives(me, rates, states) == fmi3Discard);
    free(x);
    fmi3FreeInstance(cs);
    fmi3FreeInstance(me);
    return 0;
}
