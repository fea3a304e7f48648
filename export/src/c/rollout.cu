/*
 * A rollout of the mechanism MECHANISM, written by holonom-export VERSION: many worlds at once, one
 * a thread of a GPU (CUDA, HIP), or one after the other where this file is C99 or C++. It includes
 * @.c, which is then not linked beside it.
 *
 *     @_rollout_init(worlds, states)
 *     @_rollout(worlds, steps, dt, parameters, inputs, hold, states, every, results, taken,
 *         statuses)
 *
 * Number k of world w is at [k * worlds + w], in the order of the structs of @.h.
 *
 *   worlds      how many there are; threads beyond do nothing (128 a block are a good number)
 *   steps       how many each of them takes
 *   dt          the step (s)
 *   parameters  [%_ROLLOUT_PARAMETERS][worlds], or 0 for those of the export
 *   inputs      [sets][%_ROLLOUT_INPUTS][worlds], or 0 for those of the export
 *   hold        for how many steps a set of inputs is held; 0: there is one set for all steps
 *   states      [%_ROLLOUT_STATE][worlds]: read, then written. The first number is the time. The
 *               function @_rollout_init fills them with the start of the export.
 *   every       results are written after every so many steps; 0: never
 *   results     [steps / every][%_ROLLOUT_STATE][worlds], or 0 where they are never written
 *   taken       [worlds]: how many steps each has taken
 *   statuses    [worlds]: what became of each, as @_status
 *
 * A world whose step fails stops. Its state, and what is left of its results, are its last good
 * state, with its time.
 *
O|  * A world that begins with an open joint, as after a change of a length, takes no step. Its status
O|  * is %_OPEN.
O|  *
I|  * A feedback is a macro that is there before this file is included. It is called before each
I|  * step:
I|  *
I|  *     %_FEEDBACK(constants, state, inputs, world, step)
I|  *
I|  * It may write to *inputs (@_inputs): those of the step before, or of a new set. It may read
I|  * *state (@_state), *constants (@_constants, for readings), and the numbers world and step.
I|  *
 * The numbers are those of @_step. On a GPU, a product and a sum are rounded at once unless the
 * compiler is told -fmad=false, and sines have last digits of their own.
 */
#if !defined(__CUDACC_RTC__) && !defined(__HIPCC_RTC__)
#include <stddef.h>
#endif

#include "@.c"

SIZES

#if defined(__CUDACC__) || defined(__HIPCC__)
#define %_KERNEL extern "C" __global__
#define %_WORLDS(worlds, world) \
    const size_t world = (size_t)blockIdx.x * blockDim.x + threadIdx.x; \
    if (world < (worlds))
#else
#ifdef __cplusplus
#define %_KERNEL extern "C"
#else
#define %_KERNEL
#endif
#define %_WORLDS(worlds, world) \
    size_t world; \
    for (world = 0; world < (worlds); world++)
#endif

MOVES
/* Takes the steps of one world. */
static %_FUNCTION void @_rollout_world(
    size_t world, size_t worlds, size_t steps, @_real dt,
    const @_real *parameters, const @_real *inputs, size_t hold,
    @_real *states, size_t every, @_real *results,
    size_t *taken, int *statuses)
{
P|     @_parameters own_parameters;
I|     @_inputs own_inputs;
I|     size_t next_inputs = hold;
K|     @_constants constants;
    @_state state;
    @_status status = %_OK;
    size_t step, next_result = every;
p|     (void)parameters;
i|     (void)inputs;
i|     (void)hold;
    @_rollout_load_state(&state, states, worlds, world);
P|     if (parameters) {
P|         @_rollout_load_parameters(&own_parameters, parameters, worlds, world);
P|     } else {
P|         @_default_parameters(&own_parameters);
P|     }
I|     if (inputs) {
I|         @_rollout_load_inputs(&own_inputs, inputs, worlds, world);
I|     } else {
I|         @_default_inputs(&own_inputs);
I|     }
K|     @_prepare(PREPARED&constants);
    for (step = 0; step < steps; step++) {
I|         if (inputs && hold > 0 && step == next_inputs) {
I|             inputs += %_ROLLOUT_INPUTS * worlds;
I|             next_inputs += hold;
I|             @_rollout_load_inputs(&own_inputs, inputs, worlds, world);
I| #ifndef %_FEEDBACK
I|             @_set_inputs(PREPARED&constants);
I| #endif
I|         }
I| #ifdef %_FEEDBACK
I|         %_FEEDBACK(&constants, &state, &own_inputs, world, step);
I|         @_set_inputs(PREPARED&constants);
I| #endif
O|         /* Within the loop it takes no registers beside those of a step. */
O|         if (step == 0) {
O|             status = @_check_joints(STEPPED&state);
O|             if (status != %_OK) {
O|                 break;
O|             }
O|         }
        status = @_step(STEPPED&state, dt);
        if (status != %_OK) {
            break;
        }
        if (step + 1 == next_result) {
            @_rollout_store_state(&state, results, worlds, world);
            results += %_ROLLOUT_STATE * worlds;
            next_result += every;
        }
    }
    taken[world] = step;
    statuses[world] = (int)status;
    @_rollout_store_state(&state, states, worlds, world);
    while (every > 0 && next_result <= steps) {
        @_rollout_store_state(&state, results, worlds, world);
        results += %_ROLLOUT_STATE * worlds;
        next_result += every;
    }
}

%_KERNEL void @_rollout_init(size_t worlds, @_real *states)
{
    %_WORLDS(worlds, world) {
        @_state state;
        @_init(&state);
        @_rollout_store_state(&state, states, worlds, world);
    }
}

%_KERNEL void @_rollout(
    size_t worlds, size_t steps, @_real dt,
    const @_real *parameters, const @_real *inputs, size_t hold,
    @_real *states, size_t every, @_real *results,
    size_t *taken, int *statuses)
{
    %_WORLDS(worlds, world) {
        @_rollout_world(
            world, worlds, steps, dt, parameters, inputs, hold, states, every, results, taken,
            statuses);
    }
}
