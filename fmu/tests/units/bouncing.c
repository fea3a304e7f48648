/* Runs a unit with limits that was linked with it, by co-simulation or by model exchange with steps of
 * the Runge-Kutta method of order 4 and bisection. Writes time and states after each step, until
 * the unit asks to end. */
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
#define MOST 16

static fmi3Instance unit;
static size_t states, indicators;
/* Whether there is an event again and again where a joint leaves its limit. */
static bool is_idle;

static void logged(
    fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

static void written(double time, const double *x)
{
    fwrite(&time, sizeof time, 1, stdout);
    fwrite(x, sizeof *x, states, stdout);
}

static void rates(double time, const double *x, double *slope)
{
    OK(fmi3SetTime(unit, time));
    OK(fmi3SetContinuousStates(unit, x, states));
    OK(fmi3GetContinuousStateDerivatives(unit, slope, states));
}

/* A step from x, and the event indicators behind it. */
static void step(double time, const double *x, double h, double *next, double *z)
{
    static const double parts[] = {0.0, 0.5, 0.5, 1.0}, weights[] = {1.0, 2.0, 2.0, 1.0};
    double slope[MOST] = {0.0}, at[MOST];
    memcpy(next, x, states * sizeof *x);
    for (size_t stage = 0; stage < 4; ++stage) {
        for (size_t k = 0; k < states; ++k) {
            at[k] = x[k] + parts[stage] * h * slope[k];
        }
        rates(time + parts[stage] * h, at, slope);
        for (size_t k = 0; k < states; ++k) {
            next[k] += h * weights[stage] / 6.0 * slope[k];
        }
    }
    OK(fmi3SetTime(unit, time + h));
    OK(fmi3SetContinuousStates(unit, next, states));
    OK(fmi3GetEventIndicators(unit, z, indicators));
}

static bool crossed(const double *a, const double *b)
{
    bool any = false;
    for (size_t k = 0; k < indicators; ++k) {
        any = any || (a[k] > 0.0) != (b[k] > 0.0);
    }
    return any;
}

/* Event mode; whether the unit asks to end. */
static bool event(double *x, bool *changed)
{
    bool again, terminate, nominals, has_next;
    double instant;
    OK(fmi3EnterEventMode(unit));
    OK(fmi3UpdateDiscreteStates(
        unit, &again, &terminate, &nominals, changed, &has_next, &instant));
    CHECK(!again && !nominals && !has_next);
    OK(fmi3GetContinuousStates(unit, x, states));
    return terminate;
}

/* Steps up to an end; whether the unit asks to end. */
static bool moved(double *time, double end, double *x)
{
    double z[MOST], after[MOST], next[MOST];
    OK(fmi3SetContinuousStates(unit, x, states));
    OK(fmi3GetEventIndicators(unit, z, indicators));
    while (*time < end) {
        double h = end - *time;
        step(*time, x, h, next, after);
        bool is_event = crossed(z, after), enter = false, terminate = false;
        if (is_event) {
            double least = 0.0, most = h;
            for (int k = 0; k < 60; ++k) {
                h = 0.5 * (least + most);
                step(*time, x, h, next, after);
                if (crossed(z, after)) {
                    most = h;
                } else {
                    least = h;
                }
            }
            h = most;
            step(*time, x, h, next, after);
        }
        *time = is_event ? *time + h : end;
        memcpy(x, next, states * sizeof *x);
        OK(fmi3CompletedIntegratorStep(unit, true, &enter, &terminate));
        if (is_event || enter) {
            bool changed;
            terminate = event(x, &changed);
            /* As an importer that takes a whole flight for one step of the first order. */
            for (int k = 0; is_idle && changed && !terminate; ++k) {
                CHECK(k < 10);
                OK(fmi3EnterContinuousTimeMode(unit));
                OK(fmi3SetTime(unit, *time += 1e-9));
                bool is_struck;
                terminate = event(x, &is_struck);
                CHECK(!is_struck);
            }
            if (terminate) {
                return true;
            }
            OK(fmi3EnterContinuousTimeMode(unit));
            OK(fmi3GetEventIndicators(unit, after, indicators));
        }
        memcpy(z, after, sizeof z);
    }
    return false;
}

/* A token, a count of steps, their length (s), and the kind: by model exchange if it is `exchange` or
 * `idle`. */
int main(int count, char **arguments)
{
    CHECK(count == 5);
    const int steps = atoi(arguments[2]);
    const double length = atof(arguments[3]);
    is_idle = strcmp(arguments[4], "idle") == 0;
    const bool is_exchange = is_idle || strcmp(arguments[4], "exchange") == 0;
    double x[MOST], time = 0.0;
    unit = is_exchange
        ? fmi3InstantiateModelExchange("a", arguments[1], "", false, true, NULL, logged)
        : fmi3InstantiateCoSimulation("a", arguments[1], "", false, true, false, false, NULL, 0, NULL,
              logged, NULL);
    CHECK(unit);
    OK(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0));
    OK(fmi3GetNumberOfContinuousStates(unit, &states));
    OK(fmi3GetNumberOfEventIndicators(unit, &indicators));
    CHECK(states <= MOST && indicators <= MOST && indicators > 0);
    /* A start beyond a limit is refused. */
    const fmi3ValueReference first = 1;
    double before, far = 100.0;
    OK(fmi3GetFloat64(unit, &first, 1, &before, 1));
    OK(fmi3SetFloat64(unit, &first, 1, &far, 1));
    CHECK(fmi3ExitInitializationMode(unit) == fmi3Error);
    OK(fmi3SetFloat64(unit, &first, 1, &before, 1));
    OK(fmi3ExitInitializationMode(unit));
    OK(fmi3GetContinuousStates(unit, x, states));
    bool terminate = false;
    if (is_exchange) {
        OK(fmi3EnterContinuousTimeMode(unit));
    }
    for (int k = 1; k <= steps && !terminate; ++k) {
        if (is_exchange) {
            terminate = moved(&time, k * length, x);
        } else {
            bool events, early;
            OK(fmi3DoStep(unit, time, length, true, &events, &terminate, &early, &time));
            CHECK(!events && !early);
            OK(fmi3GetContinuousStates(unit, x, states));
        }
        written(time, x);
    }
    fmi3FreeInstance(unit);
    return 0;
}
