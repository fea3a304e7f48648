/* Starts a unit that was linked with it from an angle, with a count of turns that follows it, then with
 * one that is set. Writes the count at the start, and angle and count after 0.1 s, of both. */
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

/* A token, the value references of the angle and of the count, and a number for each. */
int main(int count, char **arguments)
{
    CHECK(count == 6);
    const fmi3ValueReference references[]
        = {(fmi3ValueReference)atoi(arguments[2]), (fmi3ValueReference)atoi(arguments[3])};
    const double angle = atof(arguments[4]), set = atof(arguments[5]);
    fmi3Instance unit = fmi3InstantiateCoSimulation(
        "a", arguments[1], "", false, false, false, false, NULL, 0, NULL, NULL, NULL);
    CHECK(unit);
    for (int pass = 0; pass < 2; ++pass) {
        bool events, terminate, early;
        double last, turned, after[2];
        /* The second pass sets the count first: what is set later does not move it. */
        if (pass == 1) {
            OK(fmi3Reset(unit));
            OK(fmi3SetFloat64(unit, &references[1], 1, &set, 1));
        }
        OK(fmi3EnterInitializationMode(unit, false, 0.0, 0.0, false, 0.0));
        OK(fmi3SetFloat64(unit, &references[0], 1, &angle, 1));
        OK(fmi3GetFloat64(unit, &references[1], 1, &turned, 1));
        OK(fmi3ExitInitializationMode(unit));
        OK(fmi3DoStep(unit, 0.0, 0.1, true, &events, &terminate, &early, &last));
        OK(fmi3GetFloat64(unit, references, 2, after, 2));
        fwrite(&turned, sizeof turned, 1, stdout);
        fwrite(after, sizeof *after, 2, stdout);
    }
    fmi3FreeInstance(unit);
    return 0;
}
