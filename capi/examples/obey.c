/* A robot that only obeys: the lift of a world file, with learned parameters. `goodbot parameters lift.model --c --out lift_parameters.h`
   writes lift_parameters.h. */
#include "lift_world.h"
#include "lift_parameters.h"

/* LIFT_BYTES_32 is for pointers of four bytes, as controllers have them. */
GOODBOT_ALIGNED static unsigned char memory[LIFT_BYTES_32 * (sizeof(void *) / 4)];
static goodbot *robot;

#define TRY(call)                                                                                                                          \
    do {                                                                                                                                   \
        goodbot_status tried = (call);                                                                                                     \
        if (tried != GOODBOT_STATUS_OK) return tried;                                                                                      \
    } while (0)

static goodbot_status make(void) {
    goodbot_capacities capacities = lift_capacities;
    /* These tables would keep lessons. */
    for (int table = GOODBOT_CAPACITY_COMMANDS; table <= GOODBOT_CAPACITY_PAIRS; table++) capacities.entries[table] = 0;
    TRY(goodbot_init_table(memory, sizeof memory, &capacities, &lift_table, &robot));
    return goodbot_restore_parameters(robot, parameters, sizeof parameters);
}

/* Carries a command out. */
static goodbot_status obey(const char *command) {
    goodbot_status status;
    uint8_t action = GOODBOT_NOOP;
    TRY(goodbot_hear(robot, command));
    do {
        while ((status = goodbot_plan(robot, 20)) == GOODBOT_STATUS_WORKING) {
            /* the rest of the control loop */
        }
        TRY(status);
        TRY(goodbot_decide(robot, &action, NULL));
        TRY(goodbot_acted(robot, action));
    } while (action != GOODBOT_NOOP);
    return GOODBOT_STATUS_OK;
}

int main(void) {
    uint32_t state = 0;
    TRY(make());
    /* No lesson said it like this. As lift_world.h says, the roof is floor 3, and the garage floor 0. */
    TRY(obey("up to the roof please"));
    TRY(goodbot_table_state(robot, &state));
    if (state % 4 != 3) return 1;
    TRY(obey("the garage"));
    TRY(goodbot_table_state(robot, &state));
    return state % 4 != 0;
}
