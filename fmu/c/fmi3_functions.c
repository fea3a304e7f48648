/*
 * A mechanism behind the functions of the Functional Mock-up Interface 3.0, for model exchange and
 * for co-simulation: https://fmi-standard.org/docs/3.0/. Functions that no mechanism needs are in
 * fmi3_absent.c.
 *
 * A step of co-simulation is made of equal steps of the Runge-Kutta method of order 4 that are not
 * longer than FMU_INTERNAL_STEP. If it fails, everything is as it was before.
 *
 * Limits of joints and laws that switch are in fmi3_events.h.
 */
#include "fmi3_events.h"

#include <stdlib.h>

fmi3Status fmi3SetDebugLogging(
    fmi3Instance instance, fmi3Boolean on, size_t count, const fmi3String categories[])
{
    (void)count;
    (void)categories;
    ((mechanism *)instance)->is_logging = on;
    return fmi3OK;
}

static fmi3Instance instantiated(fmi3String token, fmi3Boolean is_logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log)
{
    mechanism *m = calloc(1, sizeof *m);
    if (!m) {
        return NULL;
    }
    m->environment = environment;
    m->log = log;
    m->is_logging = true;
    if (!token || strcmp(token, FMU_TOKEN) != 0) {
        failed(m, fmi3Error, "the instantiation token is not that of the model description");
        free(m);
        return NULL;
    }
    m->is_logging = is_logging;
    start(m);
    return m;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean is_logging, fmi3InstanceEnvironment environment,
    fmi3LogMessageCallback log)
{
    (void)name;
    (void)resources;
    (void)visible;
    return instantiated(token, is_logging, environment, log);
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
    fmi3Boolean visible, fmi3Boolean is_logging, fmi3Boolean has_events,
    fmi3Boolean may_return_early, const fmi3ValueReference intermediate[], size_t count,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback update)
{
    (void)name;
    (void)resources;
    (void)visible;
    (void)has_events;
    (void)may_return_early;
    (void)intermediate;
    (void)count;
    (void)update;
    return instantiated(token, is_logging, environment, log);
}

void fmi3FreeInstance(fmi3Instance instance)
{
    free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean has_tolerance,
    fmi3Float64 tolerance, fmi3Float64 first, fmi3Boolean has_end, fmi3Float64 last)
{
    (void)has_tolerance;
    (void)tolerance;
    (void)has_end;
    (void)last;
    set_time(instance, first);
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance)
{
    start(instance);
    return fmi3OK;
}

/* Where the numbers of a variable are; NULL if they cannot be computed. */
static const double *numbers_of(mechanism *m, const variable *of, fmi3Status *status)
{
    switch (of->kind) {
    case TIME:
        return m->now.state.number;
    case STATE:
        return m->now.x + of->first;
    case DERIVATIVE:
        *status = rates(m);
        return *status == fmi3OK ? m->rates + of->first : NULL;
    case PARAMETER:
        return m->now.parameters.number + of->first;
    case INPUT:
        return m->now.inputs.number + of->first;
    case INDICATOR:
        indicate(m);
        return m->indicators + of->first;
    default:
        prepare(m);
        m->reading = fmu_reading(&m->constants, &m->now.state, of->first);
        return &m->reading;
    }
}

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
    size_t count, fmi3Float64 numbers[], size_t length)
{
    mechanism *m = instance;
    size_t next = 0;
    for (size_t i = 0; i < count; ++i) {
        if (references[i] >= VARIABLES || next + variables[references[i]].count > length) {
            return failed(m, fmi3Error, "there is no such variable, or not this many numbers");
        }
        const variable *of = &variables[references[i]];
        fmi3Status status = fmi3OK;
        const double *from = numbers_of(m, of, &status);
        if (!from) {
            return status;
        }
        memcpy(numbers + next, from, of->count * sizeof *from);
        next += of->count;
    }
    return fmi3OK;
}

fmi3Status fmi3SetFloat64(fmi3Instance instance, const fmi3ValueReference references[],
    size_t count, const fmi3Float64 numbers[], size_t length)
{
    mechanism *m = instance;
    size_t next = 0;
    bool are_states = false;
    for (size_t i = 0; i < count; ++i) {
        if (references[i] >= VARIABLES || next + variables[references[i]].count > length) {
            return failed(m, fmi3Error, "there is no such variable, or not this many numbers");
        }
        const variable *of = &variables[references[i]];
        double *to = of->kind == STATE ? m->now.x
            : of->kind == PARAMETER    ? m->now.parameters.number
            : of->kind == INPUT        ? m->now.inputs.number
                                       : NULL;
        if (!to) {
            return failed(m, fmi3Error, "states, parameters and inputs can be set, no others");
        }
        memcpy(to + of->first, numbers + next, of->count * sizeof *to);
        next += of->count;
        if (of->kind == STATE) {
            are_states = true;
            m->now.is_set[of->first] = 1.0;
        }
        if (of->kind == PARAMETER) {
            m->changed = PARAMETERS;
        } else if (of->kind == INPUT && m->changed == NOTHING) {
            m->changed = INPUTS;
        }
    }
    if (are_states) {
        count_turns(m);
        put(m);
    }
    forget(m);
    return fmi3OK;
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *saved)
{
    if (!*saved) {
        *saved = malloc(sizeof(values));
    }
    if (!*saved) {
        return failed(instance, fmi3Error, "there is no memory for a state");
    }
    memcpy(*saved, &((mechanism *)instance)->now, sizeof(values));
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState saved)
{
    mechanism *m = instance;
    memcpy(&m->now, saved, sizeof(values));
    m->changed = PARAMETERS;
    forget(m);
    return fmi3OK;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *saved)
{
    (void)instance;
    if (saved) {
        free(*saved);
        *saved = NULL;
    }
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState saved, size_t *size)
{
    (void)instance;
    (void)saved;
    *size = sizeof(values);
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(
    fmi3Instance instance, fmi3FMUState saved, fmi3Byte bytes[], size_t size)
{
    if (size < sizeof(values)) {
        return failed(instance, fmi3Error, "a state has more bytes");
    }
    memcpy(bytes, saved, sizeof(values));
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(
    fmi3Instance instance, const fmi3Byte bytes[], size_t size, fmi3FMUState *saved)
{
    if (size != sizeof(values)) {
        return failed(instance, fmi3Error, "a state has another number of bytes");
    }
    const fmi3Status status = fmi3GetFMUState(instance, saved);
    if (status == fmi3OK) {
        memcpy(*saved, bytes, sizeof(values));
    }
    return status;
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
    size_t of_unknowns, const fmi3ValueReference knowns[], size_t of_knowns,
    const fmi3Float64 seed[], size_t seeds, fmi3Float64 result[], size_t results)
{
    return product(
        instance, unknowns, of_unknowns, knowns, of_knowns, seed, seeds, result, results, false);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
    size_t of_unknowns, const fmi3ValueReference knowns[], size_t of_knowns,
    const fmi3Float64 seed[], size_t seeds, fmi3Float64 result[], size_t results)
{
    return product(
        instance, unknowns, of_unknowns, knowns, of_knowns, seed, seeds, result, results, true);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time)
{
    set_time(instance, time);
    return fmi3OK;
}

static fmi3Status unless_all(fmi3Instance instance, size_t count)
{
    return count == FMU_STATES ? fmi3OK
                                 : failed(instance, fmi3Error, "not this many continuous states");
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 x[], size_t count)
{
    mechanism *m = instance;
    const fmi3Status status = unless_all(instance, count);
    if (status == fmi3OK) {
        memcpy(m->now.x, x, sizeof m->now.x);
        put(m);
    }
    return status;
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 x[], size_t count)
{
    const mechanism *m = instance;
    const fmi3Status status = unless_all(instance, count);
    if (status == fmi3OK) {
        memcpy(x, m->now.x, sizeof m->now.x);
    }
    return status;
}

fmi3Status fmi3GetContinuousStateDerivatives(
    fmi3Instance instance, fmi3Float64 derivatives[], size_t count)
{
    mechanism *m = instance;
    fmi3Status status = unless_all(instance, count);
    if (status == fmi3OK) {
        status = rates(m);
    }
    if (status == fmi3OK) {
        memcpy(derivatives, m->rates, sizeof m->rates);
    }
    return status;
}

fmi3Status fmi3GetNominalsOfContinuousStates(
    fmi3Instance instance, fmi3Float64 nominals[], size_t count)
{
    for (size_t k = 0; k < count; ++k) {
        nominals[k] = 1.0;
    }
    return unless_all(instance, count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *count)
{
    (void)instance;
    *count = FMU_STATES;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 time, fmi3Float64 step,
    fmi3Boolean no_earlier_state, fmi3Boolean *events, fmi3Boolean *terminate,
    fmi3Boolean *early, fmi3Float64 *last)
{
    mechanism *m = instance;
    const values before = m->now;
    const double count = fmax(1.0, ceil(step / FMU_INTERNAL_STEP * (1.0 - 1e-9)));
    (void)no_earlier_state;
    *events = *terminate = *early = false;
    *last = time;
    if (!(step > 0.0) || fabs(time - before.state.number[0]) > 1e-6 * step + 1e-9 * fabs(time)) {
        return failed(m, fmi3Error, "a step that is not positive, or does not begin at the time");
    }
    prepare(m);
    for (double k = 0.0; k < count && !*terminate; k += 1.0) {
        const fmi3Status status = step_between_limits(m, step / count, terminate);
        if (status != fmi3OK) {
            m->now = before;
            forget(m);
            return status;
        }
    }
    *last = m->now.state.number[0];
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance)
{
    const fmi3Status status = unless_open(instance);
    return status == fmi3OK ? unless_beyond(instance) : status;
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *need_update,
    fmi3Boolean *terminate, fmi3Boolean *nominals_changed, fmi3Boolean *states_changed,
    fmi3Boolean *has_next, fmi3Float64 *next)
{
    *need_update = *terminate = *nominals_changed = *states_changed = *has_next = false;
    *next = 0.0;
    return strike(instance, states_changed, terminate);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance, fmi3Boolean no_earlier_state,
    fmi3Boolean *enter_event_mode, fmi3Boolean *terminate)
{
    (void)no_earlier_state;
    *terminate = false;
    *enter_event_mode = is_leaving(instance);
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *count)
{
    (void)instance;
    *count = INDICATORS;
    return fmi3OK;
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 indicators[], size_t count)
{
    mechanism *m = instance;
    if (count != INDICATORS) {
        return failed(m, fmi3Error, "not this many event indicators");
    }
    indicate(m);
    (void)is_leaving(m);
    memcpy(indicators, m->indicators, count * sizeof *indicators);
    return fmi3OK;
}
