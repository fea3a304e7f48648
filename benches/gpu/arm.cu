/*
 * Kernels beside those of a rollout: an evaluation of the equations of motion, and their
 * derivatives, each of many arms with torques of their own. As C, the same for a processor.
 */
#include "ur5_rollout.cu"

static UR5_FUNCTION void prepared(
    const ur5_real *inputs, size_t worlds, size_t world, ur5_constants *constants)
{
    ur5_inputs own_inputs;
    ur5_rollout_load_inputs(&own_inputs, inputs, worlds, world);
    ur5_prepare(&own_inputs, constants);
}

/* The accelerations, [6][worlds]. */
UR5_KERNEL void arm_evaluation(
    size_t worlds, const ur5_real *states, const ur5_real *inputs, ur5_real *accelerations)
{
    UR5_WORLDS(worlds, world) {
        ur5_constants constants;
        ur5_state state;
        ur5_slope slope;
        prepared(inputs, worlds, world, &constants);
        ur5_rollout_load_state(&state, states, worlds, world);
        ur5_rates(&constants, &state, &slope);
        accelerations[0 * worlds + world] = slope.pan_acceleration;
        accelerations[1 * worlds + world] = slope.lift_acceleration;
        accelerations[2 * worlds + world] = slope.elbow_acceleration;
        accelerations[3 * worlds + world] = slope.wrist_1_acceleration;
        accelerations[4 * worlds + world] = slope.wrist_2_acceleration;
        accelerations[5 * worlds + world] = slope.wrist_3_acceleration;
    }
}

/* Their derivatives by angles, rates and torques, [6][18][worlds]. */
UR5_KERNEL void arm_derivatives(
    size_t worlds, const ur5_real *states, const ur5_real *inputs, ur5_real *derivatives)
{
    UR5_WORLDS(worlds, world) {
        ur5_constants constants;
        ur5_state state;
        ur5_joint_jacobian jacobian;
        size_t row, column;
        prepared(inputs, worlds, world, &constants);
        ur5_rollout_load_state(&state, states, worlds, world);
        ur5_joint_derivatives(&constants, &state, &jacobian);
        /* The last six columns of a row are by inputs, which are torques once more. Without loops
         * the derivatives stay in registers. */
#pragma unroll
        for (row = 0; row < 6; row++) {
#pragma unroll
            for (column = 0; column < 18; column++) {
                derivatives[(18 * row + column) * worlds + world] = jacobian.value[24 * row + column];
            }
        }
    }
}
