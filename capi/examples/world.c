/* A robot from a world file: lift_world.h is the output of `goodbot table docs/examples/worlds/lift.json --c --sessions 6`. */
#include "lift_world.h"
#include <stdio.h>
#include <string.h>

#define TRY(call)                                                                                                                          \
    do {                                                                                                                                   \
        goodbot_status tried = (call);                                                                                                     \
        if (tried != GOODBOT_STATUS_OK) {                                                                                                  \
            printf("%s: %s\n", #call, goodbot_status_text(tried));                                                                         \
            return 1;                                                                                                                      \
        }                                                                                                                                  \
    } while (0)

/* On a controller LIFT_BYTES_32 is enough; on this machine pointers are wider. */
GOODBOT_ALIGNED static unsigned char memory[2 * LIFT_BYTES_32];

/* As lift_world.h says: the floor, and whether the door is open. */
static uint32_t floor_of(uint32_t state) { return state % 4; }
static bool is_open(uint32_t state) { return state / 4; }

/* A trainer's judgement of an action, by its name. */
static bool is_right(uint32_t state, uint8_t action, uint32_t target) {
    const char *name = action == GOODBOT_NOOP ? "noop" : lift_actions[action].name;
    if (floor_of(state) == target) return !strcmp(name, "noop");
    if (is_open(state)) return !strcmp(name, "close");
    return !strcmp(name, floor_of(state) < target ? "up" : "down");
}

static int lesson(goodbot *robot, const char *command, uint32_t target) {
    goodbot_status status;
    TRY(goodbot_table_set_state(robot, lift_table.start));
    TRY(goodbot_hear(robot, command));
    for (int turns = 0, rests = 0; turns < 100 && rests < 3; turns++) {
        uint8_t action = GOODBOT_NOOP;
        uint32_t state = 0, evidence;
        while ((status = goodbot_plan(robot, 20)) == GOODBOT_STATUS_WORKING) {
        }
        TRY(status);
        TRY(goodbot_decide(robot, &action, NULL));
        TRY(goodbot_table_state(robot, &state));
        bool right = is_right(state, action, target);
        rests = floor_of(state) == target && right ? rests + 1 : 0;
        TRY(goodbot_acted(robot, action));
        TRY(goodbot_feedback(robot, right ? GOODBOT_REWARD : GOODBOT_PUNISH, &evidence));
    }
    TRY(goodbot_finish(robot, NULL));
    while ((status = goodbot_learn(robot, 100)) == GOODBOT_STATUS_WORKING) {
    }
    TRY(status);
    return 0;
}

int main(void) {
    goodbot *robot = NULL;
    uint32_t task = 0;
    char text[40];
    TRY(goodbot_explain_table(memory, sizeof memory, &lift_capacities, &lift_table, text, sizeof text));
    TRY(goodbot_init_table(memory, sizeof memory, &lift_capacities, &lift_table, &robot));
    for (int round = 0; round < 2; round++) {
        if (lesson(robot, "to the roof please", 3)) return 1;
        if (lesson(robot, "to the garage please", 0)) return 1;
        if (lesson(robot, "to the office", 2)) return 1;
    }
    TRY(goodbot_table_set_state(robot, lift_table.start));
    TRY(goodbot_hear(robot, "to the roof"));
    TRY(goodbot_most_likely(robot, &task));
    TRY(goodbot_task_text(robot, task, text, sizeof text));
    printf("\"to the roof\": %s\n", text);
    if (strcmp(text, "liftAtFloor(lift0,floor3)")) return 1;
    printf("world: passed\n");
    return 0;
}
