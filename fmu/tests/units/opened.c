/* Sets a variable of a unit that was linked with it, before the end of initialisation, to a value that
 * is refused, then to one that is not. Logs what the unit says. */
#include "fmi3Functions.h"

#include <stdio.h>
#include <stdlib.h>

#define CHECK(what)                                                                                \
    do {                                                                                           \
        if (!(what)) {                                                                             \
            fprintf(stderr, "line %d: %s\n", __LINE__, #what);                                     \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

#define OK(call) CHECK((call) == fmi3OK)

static void logged(
    fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category, fmi3String message)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

/* A token, a value reference, and by how much the variable is changed for either. */
int main(int count, char **arguments)
{
    CHECK(count == 5);
    const fmi3ValueReference reference = (fmi3ValueReference)atoi(arguments[2]);
    for (int is_exchange = 0; is_exchange < 2; ++is_exchange) {
        fmi3Instance unit = is_exchange
            ? fmi3InstantiateModelExchange("a", arguments[1], "", false, true, NULL, logged)
            : fmi3InstantiateCoSimulation("a", arguments[1], "", false, true, false, false, NULL, 0,
                  NULL, logged, NULL);
        CHECK(unit);
        OK(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0));
        double before, changed;
        OK(fmi3GetFloat64(unit, &reference, 1, &before, 1));
        changed = before + atof(arguments[3]);
        OK(fmi3SetFloat64(unit, &reference, 1, &changed, 1));
        CHECK(fmi3ExitInitializationMode(unit) == fmi3Error);
        changed = before + atof(arguments[4]);
        OK(fmi3SetFloat64(unit, &reference, 1, &changed, 1));
        OK(fmi3ExitInitializationMode(unit));
        fmi3FreeInstance(unit);
    }
    return 0;
}
