/*
 * Functions of the Functional Mock-up Interface 3.0 that no mechanism needs. Most changes of mode are
 * nothing. Of what no mechanism has, variables of other types, clocks,
 * structural parameters and scheduled execution, they return fmi3Error unless nothing is asked.
 */
#include "fmi3Functions.h"

const char *fmi3GetVersion(void)
{
    return fmi3Version;
}

#define NAMES const fmi3ValueReference references[], size_t count
#define NONE ((void)instance, (void)references, count == 0 ? fmi3OK : fmi3Error)

#define OF_TYPE(type)                                                                              \
    fmi3Status fmi3Get##type(                                                                      \
        fmi3Instance instance, NAMES, fmi3##type values[], size_t length)                          \
    {                                                                                              \
        (void)values;                                                                              \
        (void)length;                                                                              \
        return NONE;                                                                               \
    }                                                                                              \
    fmi3Status fmi3Set##type(                                                                      \
        fmi3Instance instance, NAMES, const fmi3##type values[], size_t length)                    \
    {                                                                                              \
        (void)values;                                                                              \
        (void)length;                                                                              \
        return NONE;                                                                               \
    }

OF_TYPE(Float32)
OF_TYPE(Int8)
OF_TYPE(UInt8)
OF_TYPE(Int16)
OF_TYPE(UInt16)
OF_TYPE(Int32)
OF_TYPE(UInt32)
OF_TYPE(Int64)
OF_TYPE(UInt64)
OF_TYPE(Boolean)
OF_TYPE(String)

fmi3Status fmi3GetBinary(
    fmi3Instance instance, NAMES, size_t sizes[], fmi3Binary values[], size_t length)
{
    (void)sizes;
    (void)values;
    (void)length;
    return NONE;
}

fmi3Status fmi3SetBinary(fmi3Instance instance, NAMES, const size_t sizes[],
    const fmi3Binary values[], size_t length)
{
    (void)sizes;
    (void)values;
    (void)length;
    return NONE;
}

fmi3Status fmi3GetClock(fmi3Instance instance, NAMES, fmi3Clock values[])
{
    (void)values;
    return NONE;
}

fmi3Status fmi3SetClock(fmi3Instance instance, NAMES, const fmi3Clock values[])
{
    (void)values;
    return NONE;
}

fmi3Status fmi3GetIntervalDecimal(
    fmi3Instance instance, NAMES, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
{
    (void)intervals;
    (void)qualifiers;
    return NONE;
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance, NAMES, fmi3UInt64 counters[],
    fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
{
    (void)counters;
    (void)resolutions;
    (void)qualifiers;
    return NONE;
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, NAMES, fmi3Float64 shifts[])
{
    (void)shifts;
    return NONE;
}

fmi3Status fmi3GetShiftFraction(
    fmi3Instance instance, NAMES, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)counters;
    (void)resolutions;
    return NONE;
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance, NAMES, const fmi3Float64 intervals[])
{
    (void)intervals;
    return NONE;
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance, NAMES, const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)counters;
    (void)resolutions;
    return NONE;
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, NAMES, const fmi3Float64 shifts[])
{
    (void)shifts;
    return NONE;
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance, NAMES, const fmi3UInt64 counters[],
    const fmi3UInt64 resolutions[])
{
    (void)counters;
    (void)resolutions;
    return NONE;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance, NAMES, const fmi3Int32 orders[],
    fmi3Float64 values[], size_t length)
{
    (void)orders;
    (void)values;
    (void)length;
    return NONE;
}

fmi3Status fmi3GetNumberOfVariableDependencies(
    fmi3Instance instance, fmi3ValueReference reference, size_t *count)
{
    (void)instance;
    (void)reference;
    (void)count;
    return fmi3Error;
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
    size_t elements[], fmi3ValueReference independents[], size_t elements_of_independents[],
    fmi3DependencyKind kinds[], size_t count)
{
    (void)instance;
    (void)dependent;
    (void)elements;
    (void)independents;
    (void)elements_of_independents;
    (void)kinds;
    (void)count;
    return fmi3Error;
}

#define OF_MODE(function, status)                                                                  \
    fmi3Status function(fmi3Instance instance)                                                     \
    {                                                                                              \
        (void)instance;                                                                            \
        return status;                                                                             \
    }

OF_MODE(fmi3EnterConfigurationMode, fmi3Error)
OF_MODE(fmi3ExitConfigurationMode, fmi3Error)
OF_MODE(fmi3EnterEventMode, fmi3OK)
OF_MODE(fmi3EnterContinuousTimeMode, fmi3OK)
OF_MODE(fmi3EnterStepMode, fmi3OK)
OF_MODE(fmi3EvaluateDiscreteStates, fmi3OK)
OF_MODE(fmi3Terminate, fmi3OK)

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String name, fmi3String token,
    fmi3String resources, fmi3Boolean visible, fmi3Boolean is_logging,
    fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock)
{
    (void)name;
    (void)token;
    (void)resources;
    (void)visible;
    (void)is_logging;
    (void)environment;
    (void)log;
    (void)update;
    (void)lock;
    (void)unlock;
    return NULL;
}

fmi3Status fmi3ActivateModelPartition(
    fmi3Instance instance, fmi3ValueReference clock, fmi3Float64 time)
{
    (void)instance;
    (void)clock;
    (void)time;
    return fmi3Error;
}
