/*
 * The balancer of the guide in C, on the board mps2-an386 of QEMU: prints what `counted` in
 * src/lib.rs prints of a trial, then the angles that ../balancer prints.
 */
#include "balancer.h"

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#define REGISTER(address) (*(volatile uint32_t *)(address))
#define SYST_CSR REGISTER(0xe000e010u)
#define SYST_RVR REGISTER(0xe000e014u)
#define SYST_CVR REGISTER(0xe000e018u)
#define CPACR REGISTER(0xe000ed88u)

enum { REPETITIONS = 1000, INSTRUCTIONS_PER_TICK = 40, PAINTED = 4096 };

static balancer_constants constants;
static balancer_state state;
static balancer_state begin;

/* Inputs for a period, and a step (s). */
static __attribute__((noinline)) balancer_status tick(balancer_state *moved, float torque, float dt)
{
    balancer_inputs inputs;
    inputs.torque = torque;
    balancer_set_inputs(&inputs, &constants);
    return balancer_step(&constants, moved, dt);
}

static void evaluate(void)
{
    balancer_slope slope;
    balancer_rates(&constants, &state, &slope);
}

static void step(void)
{
    tick(&state, 0.01f, 1e-3f);
}

static void second(void)
{
    balancer_state copy = begin;
    tick(&copy, 0.01f, 1.0f);
}

static void refused(void)
{
    balancer_state copy = begin;
    tick(&copy, 0.01f, 1e30f);
}

static void longest(void)
{
    second();
    refused();
}

static void steps(void)
{
    int k;
    for (k = 0; k < REPETITIONS; k++) {
        step();
    }
}

/* The instructions of some work, on average. */
static unsigned instructions(void (*work)(void))
{
    int k;
    const uint32_t before = SYST_CVR;
    for (k = 0; k < REPETITIONS; k++) {
        work();
    }
    return ((before - SYST_CVR) & 0xffffffu) * INSTRUCTIONS_PER_TICK / REPETITIONS;
}

/* The bytes of stack of some work. */
static __attribute__((noinline)) unsigned stack(void (*work)(void))
{
    volatile uint32_t *top;
    unsigned unused = 0;
    int k;
    __asm volatile("mov %0, sp" : "=r"(top));
    for (k = 1; k <= PAINTED; k++) {
        top[-k] = 0xa5a5a5a5u;
    }
    work();
    while (unused < PAINTED && top[(int)unused - PAINTED] == 0xa5a5a5a5u) {
        unused++;
    }
    return (PAINTED - unused) * (unsigned)sizeof *top;
}

static unsigned most(unsigned a, unsigned b)
{
    return a < b ? b : a;
}

static void count(void)
{
    unsigned of_evaluation, of_step, at_most;
    of_evaluation = instructions(evaluate);
    of_step = instructions(step);
    at_most = most(of_step, most(instructions(second), instructions(refused)));
    state = begin;
    printf("balancer in C, joints | StandardLagrange | f32 | %u | %u | %u | %u | %u |  | \n",
        of_evaluation, of_step, at_most, stack(steps), stack(longest));
}

static void balance(void)
{
    int period;
    for (period = 0; period < 1000; period++) {
        const float angle = balancer_angle(&constants, &state);
        const float torque = 2.0f * angle + 0.2f * balancer_angle_rate(&constants, &state);
        if (period % 100 == 0) {
            printf("%.1f s: %.5f rad\n", (double)state.time, (double)angle);
        }
        if (tick(&state, torque, 1e-3f) != BALANCER_OK) {
            printf("a step was refused\n");
        }
    }
}

void initialise_monitor_handles(void);

static __attribute__((noinline, noreturn)) void run(void)
{
    balancer_inputs inputs;
    initialise_monitor_handles();
    SYST_RVR = 0xffffffu;
    SYST_CVR = 0;
    SYST_CSR = 5;
    balancer_default_inputs(&inputs);
    balancer_prepare(&inputs, &constants);
    balancer_init(&begin);
    state = begin;
    count();
    state = begin;
    balance();
    fflush(stdout);
    _Exit(0);
}

/* Lets the coprocessor compute, before anything else. */
__attribute__((noreturn)) void reset(void)
{
    CPACR |= 0xfu << 20;
    __asm volatile("dsb\n\tisb");
    run();
}

extern uint32_t stack_top;
__attribute__((section(".vectors"), used)) static const uintptr_t vectors[] = {
    (uintptr_t)&stack_top,
    (uintptr_t)reset,
};
