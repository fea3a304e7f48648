/*
 * An instance of a mechanism, as fmi3_functions.c has it. What the mechanism has is in
 * fmi3_model.h, which is written for each.
 *
 * An instance counts coordinates and velocities as joints do, and angles over all turns. The
 * program has cosines and sines, and in a run of parallel axes sums: `put` and `read_back` are
 * between them.
 */
#ifndef FMI3_MECHANISM_H
#define FMI3_MECHANISM_H

#include "fmi3Functions.h"
#include "fmi3_model.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define AT_LEAST_ONE(count) ((count) > 0 ? (count) : 1)
#define COLUMNS (FMU_STATES + FMU_PARAMETERS + FMU_INPUTS)
#define INDICATORS (2 * FMU_LIMITED + FMU_SWITCHES)
#define TIMES 2
/* The status of a state in which a joint is open. */
#define STATUS_OPEN 6
#define TURN 6.28318530717958647692

typedef enum { TIME, STATE, DERIVATIVE, PARAMETER, INPUT, READING, INDICATOR } kind;

/* A variable, by its value reference: which numbers it has. */
typedef struct {
    kind kind;
    size_t first;
    size_t count;
} variable;

/* A coordinate or velocity: in the program +-(of the joint) + offset + that which it is against. */
typedef struct {
    double sign;
    double offset;
    int against;
} coordinate;

/* Equations of a joint, and by how much they may be open at a start. */
typedef struct {
    const char *joint;
    const char *unit;
    double accepted;
} opening;

/* A part of an angle over all turns: the state that counts it, what that is in the described
 * configuration, and how much of a joint is added. Parts of one state are side by side. */
typedef struct {
    size_t state;
    double described;
    size_t joint;
    double factor;
} part;

static const variable variables[] = {FMU_VARIABLES};
static const opening openings[] = {FMU_OPENS};
static const coordinate coordinates[] = {FMU_COORDINATES};
/* The coordinates, each behind that which it is against. */
static const size_t order[] = {FMU_ORDER};
static const part parts[] = {FMU_TURNED};

/* A variable, which may be compared with zero. */
static const size_t angles = FMU_ANGLES;
static const size_t opening_count = FMU_OPENINGS;
static const size_t part_count = FMU_PARTS;

#define VARIABLES (sizeof variables / sizeof *variables)

/* What determines everything else: the state that an importer saves. */
typedef struct {
    double x[FMU_STATES];
    fmu_state state;
    fmu_parameters parameters;
    fmu_inputs inputs;
    /* The fastest approach of each joint to a limit (rad/s, m/s). */
    double fastest[AT_LEAST_ONE(FMU_LIMITED)];
    /* Not zero where a joint has been within its limits since the last impact. */
    double is_within[AT_LEAST_ONE(FMU_LIMITED)];
    /* At how many events each joint has been leaving a limit since then, and the last one (s). */
    double idle[AT_LEAST_ONE(FMU_LIMITED)];
    double idle_at[AT_LEAST_ONE(FMU_LIMITED)];
    /* Not zero where an importer has set a state by its name. */
    double is_set[FMU_STATES];
} values;

typedef enum { NOTHING, INPUTS, PARAMETERS } changed;

typedef struct {
    values now;
    fmu_constants constants;
    changed changed;
    bool has_rates;
    bool has_derivatives;
    double rates[FMU_STATES];
    double reading;
    double indicators[AT_LEAST_ONE(INDICATORS)];
    fmu_jacobian jacobian;
    fmu_sensitivities sensitivities;
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log;
    bool is_logging;
} mechanism;

static fmi3Status failed(const mechanism *m, fmi3Status status, const char *message)
{
    if (m->log && m->is_logging) {
        const char *category = status == fmi3Warning ? "logStatusWarning" : "logStatusError";
        m->log(m->environment, status, category, message);
    }
    return status;
}

static fmi3Status discarded(const mechanism *m, int status)
{
    static const char *const messages[] = {
        "", "a step that is not positive",
        "equations depend on each other in this state: their solution has no digit left",
        "a number is not finite",
        "a joint passes a limit, and is not at it after any part of the step"};
    return failed(m, fmi3Discard, messages[status > 0 && status < 5 ? status : 3]);
}

/* Says by how much the joint is open that is farthest beyond what is accepted; if none is, how
 * fast one opens. */
static fmi3Status is_open(const mechanism *m)
{
    fmu_openings sizes;
    char message[300];
    size_t worst = 0, rate = 0;
    double most = 1.0;
    memset(&sizes, 0, sizeof sizes);
    fmu_get_openings(&m->constants, &m->now.state, &sizes);
    for (size_t part = 0; part < 2 && most <= 1.0; ++part) {
        for (size_t k = 0; k < opening_count; ++k) {
            const double size = sizes.number[2 * k + part] / openings[k].accepted;
            if (size > most) {
                most = size;
                worst = k;
                rate = part;
            }
        }
    }
    snprintf(message, sizeof message,
        rate ? "the bodies of joint `%s` move against it at %.3g %s/s at the start: set rates that "
               "keep it closed"
             : "joint `%s` is open by %.3g %s at the start: set values that close it, for the "
               "lengths that are set",
        openings[worst].joint, sizes.number[2 * worst + rate], openings[worst].unit);
    return failed(m, fmi3Error, message);
}

/* The numbers of joints as those of the program. */
static void sums(const double *x, double *y)
{
    for (size_t i = 0; i < FMU_STATES; ++i) {
        const size_t k = order[i];
        const coordinate *of = &coordinates[k];
        y[k] = of->sign * x[k] + of->offset + (of->against < 0 ? 0.0 : y[of->against]);
    }
}

static double of_joint(size_t k, const double *y)
{
    const coordinate *of = &coordinates[k];
    return of->sign * (y[k] - of->offset - (of->against < 0 ? 0.0 : y[of->against]));
}

static void forget(mechanism *m)
{
    m->has_rates = false;
    m->has_derivatives = false;
}

/* Puts the numbers of the joints into the state of the program. */
static void put(mechanism *m)
{
    double y[FMU_STATES], *number = m->now.state.number + TIMES;
    sums(m->now.x, y);
    for (size_t k = 0; k < FMU_STATES; ++k) {
        if (k < angles) {
            *number++ = cos(y[k]);
            *number++ = sin(y[k]);
        } else {
            *number++ = y[k];
        }
    }
    forget(m);
}

/* Counts turns along with the joints that an importer has set, unless it has set the count as well. */
static void count_turns(mechanism *m)
{
    for (size_t i = 0; i < part_count;) {
        const size_t state = parts[i].state;
        double angle = parts[i].described;
        bool is_moved = false;
        for (; i < part_count && parts[i].state == state; ++i) {
            angle += parts[i].factor * m->now.x[parts[i].joint];
            is_moved = is_moved || m->now.is_set[parts[i].joint] > 0.0;
        }
        if (is_moved && !(m->now.is_set[state] > 0.0)) {
            m->now.x[state] = angle;
        }
    }
}

/* Reads them of it, where angles have turned by less than half a turn since. */
static void read_back(mechanism *m)
{
    double y[FMU_STATES];
    const double *number = m->now.state.number + TIMES;
    sums(m->now.x, y);
    for (size_t k = 0; k < FMU_STATES; ++k) {
        if (k < angles) {
            const double angle = atan2(number[1], number[0]);
            y[k] = angle + TURN * round((y[k] - angle) / TURN);
            number += 2;
        } else {
            y[k] = *number++;
        }
    }
    for (size_t k = 0; k < FMU_STATES; ++k) {
        m->now.x[k] = of_joint(k, y);
    }
    forget(m);
}

static void set_time(mechanism *m, double time)
{
    m->now.state.number[0] = time;
    m->now.state.number[1] = 0.0;
    forget(m);
}

static void start(mechanism *m)
{
    static const double x[] = {FMU_START};
    fmu_start(&m->now.state, &m->now.parameters, &m->now.inputs);
    memcpy(m->now.x, x, sizeof x);
    for (size_t k = 0; k < AT_LEAST_ONE(FMU_LIMITED); ++k) {
        m->now.fastest[k] = 0.0;
        m->now.is_within[k] = 1.0;
        m->now.idle[k] = 0.0;
        m->now.idle_at[k] = 0.0;
    }
    memset(m->now.is_set, 0, sizeof m->now.is_set);
    m->changed = PARAMETERS;
    forget(m);
}

static void prepare(mechanism *m)
{
    if (m->changed == PARAMETERS) {
        fmu_prepare(&m->now.parameters, &m->now.inputs, &m->constants);
    } else if (m->changed == INPUTS) {
        fmu_set_inputs(&m->now.parameters, &m->now.inputs, &m->constants);
    }
    m->changed = NOTHING;
}

/* Refuses a start at which a joint is open. */
static fmi3Status unless_open(mechanism *m)
{
    prepare(m);
    const int status = fmu_check_joints(&m->constants, &m->now.state);
    return status == STATUS_OPEN ? is_open(m) : status != 0 ? discarded(m, status) : fmi3OK;
}

static fmi3Status rates(mechanism *m)
{
    if (!m->has_rates) {
        fmu_slope slope;
        prepare(m);
        const int status = fmu_rates(&m->constants, &m->now.state, &slope);
        if (status != 0) {
            return discarded(m, status);
        }
        for (size_t k = 0; k < FMU_STATES; ++k) {
            const coordinate *of = &coordinates[k];
            const double against = of->against < 0 ? 0.0 : slope.number[of->against];
            m->rates[k] = of->sign * (slope.number[k] - against);
        }
        m->has_rates = true;
    }
    return fmi3OK;
}

/* Derivatives by what joints have, from those by the numbers of the program. */
static void by_joints(double *row)
{
    for (size_t i = FMU_STATES; i-- > 0;) {
        const coordinate *of = &coordinates[order[i]];
        if (of->against >= 0) {
            row[of->against] += row[order[i]];
        }
        row[order[i]] *= of->sign;
    }
}

static void derive(mechanism *m)
{
    double *jacobian = m->jacobian.number, *sensitivities = m->sensitivities.number;
    if (m->has_derivatives) {
        return;
    }
    fmu_derivatives(&m->now.parameters, &m->now.inputs, &m->now.state, &m->jacobian);
    fmu_reading_derivatives(
        &m->now.parameters, &m->now.inputs, &m->now.state, &m->sensitivities);
    for (size_t i = FMU_STATES; i-- > 0;) {
        const coordinate *of = &coordinates[order[i]];
        double *row = jacobian + order[i] * COLUMNS;
        for (size_t column = 0; column < COLUMNS; ++column) {
            if (of->against >= 0) {
                row[column] -= jacobian[(size_t)of->against * COLUMNS + column];
            }
            row[column] *= of->sign;
        }
    }
    for (size_t row = 0; row < FMU_STATES; ++row) {
        by_joints(jacobian + row * COLUMNS);
    }
    for (size_t row = 0; row < AT_LEAST_ONE(FMU_READINGS); ++row) {
        by_joints(sensitivities + row * COLUMNS);
    }
    m->has_derivatives = true;
}

/* A number of a variable by a number of another one. */
static double partial(
    const mechanism *m, const variable *of, size_t number, const variable *by, size_t column)
{
    number += of->first;
    column += by->first;
    if (of->kind == STATE) {
        return by->kind == STATE && column == number ? 1.0 : 0.0;
    }
    column += by->kind == STATE ? 0 : FMU_STATES;
    column += by->kind == INPUT ? FMU_PARAMETERS : 0;
    return of->kind == DERIVATIVE ? m->jacobian.number[number * COLUMNS + column]
                                  : m->sensitivities.number[number * COLUMNS + column];
}

/* How many numbers these variables have, if all are of these kinds; else zero. */
static size_t numbers(const fmi3ValueReference references[], size_t count, const kind kinds[3])
{
    size_t sum = 0;
    for (size_t i = 0; i < count; ++i) {
        if (references[i] >= VARIABLES) {
            return 0;
        }
        const variable *of = &variables[references[i]];
        if (of->kind != kinds[0] && of->kind != kinds[1] && of->kind != kinds[2]) {
            return 0;
        }
        sum += of->count;
    }
    return sum;
}

/* The product of derivatives with a seed: from the left if `is_adjoint`, else from the right. */
static fmi3Status product(mechanism *m, const fmi3ValueReference unknowns[], size_t of_unknowns,
    const fmi3ValueReference knowns[], size_t of_knowns, const double seed[], size_t seeds,
    double result[], size_t results, bool is_adjoint)
{
    const kind of[] = {STATE, DERIVATIVE, READING}, by[] = {STATE, PARAMETER, INPUT};
    const size_t rows = numbers(unknowns, of_unknowns, of);
    const size_t columns = numbers(knowns, of_knowns, by);
    size_t row = 0;
    if (rows == 0 || columns == 0 || seeds != (is_adjoint ? rows : columns)
        || results != (is_adjoint ? columns : rows)) {
        return failed(m, fmi3Error,
            "derivatives are there of states, their rates and outputs, by states, parameters and "
            "inputs");
    }
    derive(m);
    memset(result, 0, results * sizeof *result);
    for (size_t i = 0; i < of_unknowns; ++i) {
        const variable *unknown = &variables[unknowns[i]];
        for (size_t k = 0; k < unknown->count; ++k, ++row) {
            size_t column = 0;
            for (size_t j = 0; j < of_knowns; ++j) {
                const variable *known = &variables[knowns[j]];
                for (size_t l = 0; l < known->count; ++l, ++column) {
                    const double entry = partial(m, unknown, k, known, l);
                    result[is_adjoint ? column : row] += entry * seed[is_adjoint ? row : column];
                }
            }
        }
    }
    return fmi3OK;
}

#endif
