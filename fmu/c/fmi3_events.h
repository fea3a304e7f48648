/*
 * Limits of joints and laws that switch. An event indicator is a distance to a limit, or an
 * expression whose sign decides in a law.
 *
 * At a limit the rate of the joint turns back by the restitution of the limit. An approach that is
 * slower than REST times the fastest one so far has none. A unit has no mode for a joint that a limit
 * holds: the simulation ends where a joint does not move there and is pressed against it, and where
 * an importer sees nothing of a bounce between two impacts, or sees its start again and again.
 */
#ifndef FMI3_EVENTS_H
#define FMI3_EVENTS_H

#include "fmi3_mechanism.h"

/* A joint is at a limit that is not farther away (rad, m). */
#define AT_LIMIT 1e-9
#define REST 1e-4
/* A time (s) in which accelerations do not change. */
#define MOMENT 1e-7
/* The status of a step that would pass a limit. */
#define STATUS_LIMIT 4
/* So many impacts in one step are without end. */
#define MOST_IMPACTS 1000
/* So many events while a joint leaves a limit say that an importer does not resolve its flight: one
 * is where its distance passes zero upwards. */
#define MOST_IDLE 3

/* Variables, which comparisons with zero may be of. */
static const size_t limited = FMU_LIMITED, switching = FMU_SWITCHES;
static const char *const gap_names[] = {FMU_GAPS};

static void get_gaps(mechanism *m, fmu_gaps *gaps)
{
    prepare(m);
    fmu_get_gaps(&m->constants, &m->now.state, gaps);
}

static void indicate(mechanism *m)
{
    fmu_gaps gaps;
    fmu_switches switches;
    get_gaps(m, &gaps);
    fmu_get_switches(&m->constants, &m->now.state, &switches);
    for (size_t k = 0; k < 2 * limited; ++k) {
        m->indicators[k] = gaps.number[3 * (k / 2) + k % 2];
    }
    for (size_t k = 0; k < switching; ++k) {
        m->indicators[2 * limited + k] = switches.number[k];
    }
}

/* The nearer limit of a joint: its place, and how fast the joint approaches it. */
static size_t nearer(const fmu_gaps *gaps, size_t joint, double *approach)
{
    const double *of = gaps->number + 3 * joint;
    const bool is_upper = !(of[0] < of[1]);
    *approach = is_upper ? of[2] : -of[2];
    return 3 * joint + (is_upper ? 1 : 0);
}

static const char *gap_name(size_t place)
{
    return gap_names[2 * (place / 3) + place % 3];
}

/* Refuses a state beyond a limit. */
static fmi3Status unless_beyond(mechanism *m)
{
    fmu_gaps gaps;
    get_gaps(m, &gaps);
    for (size_t joint = 0; joint < limited; ++joint) {
        double approach;
        const size_t place = nearer(&gaps, joint, &approach);
        if (!(gaps.number[place] >= -AT_LIMIT)) {
            char message[200];
            snprintf(message, sizeof message, "the start is beyond a limit: %s is negative",
                gap_name(place));
            return failed(m, fmi3Error, message);
        }
    }
    return fmi3OK;
}

/* Notes which joints are within their limits, as an importer has seen it: behind a step, or by event
 * indicators within one. Whether a joint is beyond a limit and goes farther. */
static bool is_leaving(mechanism *m)
{
    fmu_gaps gaps;
    bool any = false;
    get_gaps(m, &gaps);
    for (size_t joint = 0; joint < limited; ++joint) {
        double approach;
        const size_t place = nearer(&gaps, joint, &approach);
        if (gaps.number[place] > AT_LIMIT) {
            m->now.is_within[joint] = 1.0;
        }
        any = any || (!(gaps.number[place] >= 0.0) && approach > 0.0);
    }
    return any;
}

/* Says that a joint comes to rest at a limit. */
static bool is_at_rest(const mechanism *m, size_t place)
{
    char message[200];
    snprintf(message, sizeof message,
        "a joint comes to rest at a limit (%s is zero): the simulation ends here",
        gap_name(place));
    failed(m, fmi3Warning, message);
    return true;
}

/* How fast a joint approaches a limit a moment from now. */
static fmi3Status approach_ahead(mechanism *m, size_t place, double *approach)
{
    fmu_gaps gaps;
    const values now = m->now;
    const fmi3Status status = rates(m);
    if (status != fmi3OK) {
        return status;
    }
    for (size_t k = 0; k < FMU_STATES; ++k) {
        m->now.x[k] += MOMENT * m->rates[k];
    }
    put(m);
    set_time(m, now.state.number[0] + MOMENT);
    get_gaps(m, &gaps);
    *approach = place % 3 == 0 ? -gaps.number[place + 2] : gaps.number[place + 1];
    m->now = now;
    forget(m);
    return fmi3OK;
}

/* Whether a joint that does not move is pressed against a limit. */
static fmi3Status find_rest(mechanism *m, bool *rests)
{
    fmu_gaps gaps;
    get_gaps(m, &gaps);
    for (size_t joint = 0; joint < limited && !*rests; ++joint) {
        double approach, ahead;
        const size_t place = nearer(&gaps, joint, &approach);
        const double slow = REST * m->now.fastest[joint];
        if (gaps.number[place] > AT_LIMIT || fabs(approach) > slow) {
            continue;
        }
        const fmi3Status status = approach_ahead(m, place, &ahead);
        if (status != fmi3OK) {
            return status;
        }
        if (!(ahead <= approach)) {
            *rests = is_at_rest(m, place);
        }
    }
    return fmi3OK;
}

/* Impacts of the joints that are at limits, and whether one of them comes to rest there. */
static fmi3Status strike(mechanism *m, bool *are_struck, bool *rests)
{
    fmu_gaps gaps;
    double rest = 0.0;
    const double now = m->now.state.number[0];
    get_gaps(m, &gaps);
    for (size_t joint = 0; joint < limited; ++joint) {
        double approach, *fastest = &m->now.fastest[joint];
        const size_t place = nearer(&gaps, joint, &approach);
        if (gaps.number[place] <= AT_LIMIT && approach < 0.0 && now > m->now.idle_at[joint]) {
            m->now.idle_at[joint] = now;
            m->now.idle[joint] += 1.0;
            if (m->now.idle[joint] > MOST_IDLE) {
                *rests = is_at_rest(m, place);
                return fmi3OK;
            }
        }
        if (gaps.number[place] <= AT_LIMIT && approach > 0.0) {
            if (m->now.is_within[joint] == 0.0) {
                *rests = is_at_rest(m, place);
                return fmi3OK;
            }
            m->now.is_within[joint] = 0.0;
            m->now.idle[joint] = 0.0;
            m->now.idle_at[joint] = now;
            *fastest = fmax(*fastest, approach);
            rest = fmax(rest, REST * *fastest);
            *are_struck = true;
        }
    }
    if (*are_struck) {
        const int status = fmu_impact(&m->constants, &m->now.state, AT_LIMIT, rest);
        if (status != 0) {
            return discarded(m, status);
        }
        read_back(m);
    }
    return find_rest(m, rests);
}

/* A step up to limits, with impacts there, unless a joint comes to rest. */
static fmi3Status step_between_limits(mechanism *m, double step, bool *rests)
{
    int impacts = 0;
    bool are_struck = false;
    while (step > 0.0) {
        int status = fmu_step(&m->constants, &m->now.state, step);
        if (status == 0) {
            read_back(m);
            return fmi3OK;
        }
        if (status != STATUS_LIMIT || ++impacts > MOST_IMPACTS) {
            return discarded(m, status);
        }
        /* The longest part that a limit leaves, to the last bits of the time. */
        for (double part = 0.5 * step; part > 1e-15 * (1.0 + m->now.state.number[0]); part *= 0.5) {
            status = fmu_step(&m->constants, &m->now.state, part);
            if (status == 0) {
                step -= part;
                read_back(m);
            } else if (status != STATUS_LIMIT) {
                break;
            }
        }
        are_struck = false;
        for (size_t joint = 0; joint < limited; ++joint) {
            m->now.is_within[joint] = 1.0;
            m->now.idle[joint] = 0.0;
        }
        const fmi3Status struck = strike(m, &are_struck, rests);
        if (struck != fmi3OK || *rests) {
            return struck;
        }
        if (!are_struck) {
            return discarded(m, STATUS_LIMIT);
        }
    }
    return fmi3OK;
}

#endif
